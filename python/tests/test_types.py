"""The types of results are those of the documents, and type checkers refuse what is not there."""

import collections
import functools
import pathlib
import re
import shutil
import subprocess
import sys
import types
from collections.abc import Callable, Iterator
from typing import Any, Union, get_args, get_origin, get_type_hints

import pydeltav
import pytest
from conftest import FIXTURES, ROOT, UNCERTAIN, cases
from pydeltav import results
from pydeltav._record import Keyed, Record

# What no case here has; their types are those of `crates/report/src/data`. What occurs may not stand here.
NOT_IN_FIXTURES = {
    # A run that does not converge, a warned sample that is of one vehicle, and a recorder that is doubtful.
    "Doubt.code",
    "Doubt.key",
    "Doubtful.vehicle",
    "LeftOut.case",
    "LeftOut.vehicle",
    # A law that tells its regime beside speeds by momentum, and a share that only the root finder solves.
    "LawCheck.regime",
    "Iteration.crush_work",
    # Weighed evidence that contradicts other evidence.
    "Headline.contradicting",
    "Headline.doubtful",
    # Evidence that an estimate cannot use.
    "Unused.key",
    "Unused.reason",
}


def known(of: Any) -> dict[str, Any]:
    return {name: kind for name, kind in get_type_hints(of).items() if not name.startswith("_")}


def looked_up(value: Any, of: Any, path: str, seen: set[str]) -> Iterator[str]:
    """Where a value of a document is not of its type; ``seen`` gets the attributes that occur."""
    if get_origin(of) in (Union, types.UnionType):
        kinds = get_args(of)
        if of == results.Found | Any:
            kinds = (results.Found, tuple[results.Found, results.Found])
        tries = [(list(looked_up(value, kind, path, found := set[str]())), found) for kind in kinds]
        wrong, found = min(tries, key=lambda tried: len(tried[0]))
        seen |= found
        yield from wrong
    elif get_origin(of) is tuple:
        parts = get_args(of)
        if not isinstance(value, list):
            yield f"{path} is {value!r}, not a list"
            return
        if parts[-1] is ...:
            parts = parts[:1] * len(value)
        if len(parts) != len(value):
            yield f"{path} has {len(value)} elements, not {len(parts)}"
        for element, part in zip(value, parts, strict=False):
            yield from looked_up(element, part, f"{path}[]", seen)
    elif get_origin(of) is Keyed:
        for key, element in value.items():
            yield from looked_up(element, get_args(of)[0], f"{path}[{key}]", seen)
    elif isinstance(value, dict):
        if not isinstance(of, type) or of in (float, int, str, bool):
            yield f"{path} is a table, not {of}"
            return
        attributes = known(of)
        for key, element in value.items():
            seen.add(f"{of.__name__}.{key}")
            if key in attributes:
                yield from looked_up(element, attributes[key], f"{path}.{key}", seen)
            else:
                yield f"{path}.{key} has no type"
    elif type(value) is not of and not (value is None and of is type(None)):
        yield f"{path} is {value!r}, not {of}"


def asked(path: pathlib.Path) -> Iterator[Callable[[], pydeltav.Result]]:
    case = pydeltav.Case.read(path)
    yield functools.partial(case.reconstruct, exact=True)
    yield from (case.impact, case.motion, case.crush, case.check, case.compare)
    yield lambda: case.sensitivity(pdof_step=10.0, pdof_steps=1)
    # Rows of indices take some hundred samples each.
    yield lambda: case.uncertainty(64, sobol=64)


def documents(simulated: pathlib.Path) -> Iterator[tuple[str, str, Any, dict[str, Any]]]:
    """Documents of every class: where from, the class, its types, and the data."""
    for path in cases():
        if "invalid" in path.parts:
            continue
        for ask in asked(path):
            try:
                result = ask()
            except ValueError:
                continue
            of = results._DOCUMENTS[type(result).__name__]
            yield f"{path}: {type(result).__name__}", type(result).__name__, of, result.to_dict()
    held = pydeltav.Case.read(FIXTURES / "barrier.toml").to_dict()
    held["vehicle1"]["crush"] |= {"moment_arm": "0.3 m", "oblique_angle": "3 deg"}
    swept = pydeltav.Case.from_dict(held).sensitivity(pdof_steps=1).to_dict()
    yield "held: Sensitivity", "Sensitivity", results._SensitivityDocument, swept
    passed = pydeltav.Case.read(FIXTURES / "motion" / "ricsac-6.toml").to_dict()
    passed["vehicle1"]["after"]["points"] = [
        {"x": "-5 m", "y": "1 m", "heading": "170 deg"},
        {"x": "-4 m", "y": "1 m", "wheel": "front left"},
    ]
    followed = pydeltav.Case.from_dict(passed).motion().to_dict()
    yield "points: Analysis", "Analysis", results._AnalysisDocument, followed
    weighed = pydeltav.Case.read(FIXTURES / "t-bone-category.toml").reconstruct().to_dict()
    yield "weighed: Analysis", "Analysis", results._AnalysisDocument, weighed
    for name in ("pole.toml", "sae-980025.toml"):
        result = pydeltav.Case.read(FIXTURES / name).estimate(particles=128, above=["vehicle1.speed 50 km/h"])
        yield f"{name}: Estimate", "Estimate", results._EstimateDocument, result.to_dict()
    for name in ("pedestrian", "skid", "sight", "recorder", "behind"):
        avoided = pydeltav.Case.read(FIXTURES / "avoid" / f"{name}.toml").avoid(samples=1000)
        yield f"{name}: Avoidance", "Avoidance", results._AvoidanceDocument, avoided.to_dict()
    judged = pydeltav.ciss.judge(pydeltav.ciss.pairs(simulated)[:1])
    yield "ciss: Coverage", "Coverage", results._Coverage, judged.to_dict()


@pytest.fixture(scope="module")
def simulated(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    sys.path.insert(0, str(ROOT / "python" / "examples"))
    import simulated_ciss

    folder = tmp_path_factory.mktemp("CISS_2017_CSV_files")
    simulated_ciss.write(folder, crashes=12, seed=1)
    return folder


def test_every_document_is_of_its_types_and_every_type_occurs(simulated: pathlib.Path) -> None:
    seen: set[str] = set()
    wrong: dict[str, str] = {}
    count: collections.Counter[str] = collections.Counter()
    for name, kind, of, document in documents(simulated):
        count[kind] += 1
        for problem in looked_up(document, of, kind, seen):
            wrong.setdefault(re.sub("[0-9.e+-]{4,}", "#", problem), name)
    assert not wrong, wrong
    assert set(count) == {*results._DOCUMENTS, "Coverage"}, count
    parts = [getattr(results, name) for name in results.__all__ if name != "Keyed"]
    parts += [*results._DOCUMENTS.values(), results._Coverage]
    of_all = {f"{of.__name__}.{key}" for of in parts for key in known(of)}
    assert of_all - seen == NOT_IN_FIXTURES, "an attribute of the types occurs in no document"


def test_a_document_with_another_shape_is_found() -> None:
    document = pydeltav.Case.example().reconstruct().to_dict()
    of = results._AnalysisDocument
    assert list(looked_up(document, of, "", set())) == []
    for change in (
        {"axes": 1.0},
        {"left_asides": []},
        {"crash3": None},
        {"checks": {}},
        {"found": [document["found"]]},
        {"vehicle1": {**document["vehicle1"], "delta_vv": 1.0}},
        {"vehicle1": {**document["vehicle1"], "velocity": [1.0]}},
        {"vehicle1": {**document["vehicle1"], "fixed": "yes"}},
    ):
        assert len(list(looked_up(document | change, of, "", set()))) == 1, change


def test_parts_are_of_their_classes() -> None:
    result = pydeltav.Case.example().reconstruct()
    assert type(result.vehicle1) is results.Vehicle and type(result.found) is results.Found
    assert type(result.headline.vehicle1.speed) is results.HeadlineFigure
    assert type(result.program) is results.Program
    uncertain = pydeltav.Case.read(UNCERTAIN).uncertainty(1000)
    assert {type(output) for output in uncertain.outputs.values()} == {results.UncertainOutput}
    assert type(dict(uncertain.outputs.items())["vehicle1.speed"].tornado[0]) is results.Bar
    both = pydeltav.Case.read(FIXTURES / "rear-end-rest.toml").reconstruct(exact=True)
    assert [type(found) for found in both.found] == [results.Found, results.Found]


def test_every_attribute_has_its_unit_in_front() -> None:
    """Numbers that are no counts of a vehicle begin with their unit."""
    text = pathlib.Path(results.__file__).read_text("utf-8")
    entries = re.findall(r'^    (\w+): (.+)\n    """(.+)"""$', text, re.M)
    assert len(entries) > 350
    said = {(name, kind) for name, kind, _ in entries}
    annotated = set(re.findall(r"^    (\w+): (.+)$", text.partition("# Of every result.")[2], re.M))
    assert said == annotated, "each has a docstring"
    for name, kind, says in entries:
        if name != "vehicle" and re.search(r"\b(float|int|_Pair|_MaybePair)\b", kind):
            assert re.match(r"\((–|SI|US|SI/SI|J|N|N s|N m s|m|m/s|m/s²|rad|rad/s|s)\) |In the unit", says), (name, says)


RIGHT = """
import pydeltav
import numpy as np
import numpy.typing as npt
from pydeltav.results import Found, UncertainOutput, Vehicle

case: pydeltav.Case = pydeltav.Case.from_dict({"vehicle1": {}})
result: pydeltav.Analysis = case.reconstruct()
speed: float = result.vehicle1.delta_v
also: float = result.found.value
several: tuple[float, ...] = result.found.roots
vehicle: Vehicle = result.vehicle2
x, y = vehicle.final_velocity
codes: list[str] = [warning.code for warning in result.warnings]
version: str = result.program.version
if isinstance(result.found, tuple):
    first, second = result.found

uncertain = case.uncertainty(1000, seed=1)
output: UncertainOutput = uncertain.outputs["vehicle1.speed"]
medians: dict[str, float | None] = {key: output.median for key, output in uncertain.outputs.items()}
if output.interval95 is not None:
    low, high = output.interval95
samples: npt.NDArray[np.float64] = uncertain.columns()["vehicle1.speed"]
arrays: dict[str, npt.NDArray[np.float64]] = dict(uncertain.columns())

estimated = case.estimate()
probability: float | None = estimated.questions[0].probability
runs: list[bool] = [command.runs for command in case.check().commands]
found: float = case.compare().rows[0].found
influence: float = case.sensitivity().derivatives[0].influence
rows = pydeltav.crush_table({"id": [1, 2], "vehicle1.mass [kg]": np.array([1500.0, 1600.0])}, template=case)
coverage: float = pydeltav.ciss.judge([]).groups["all"].coverage["95"]
"""

# Each line is wrong.
WRONG = """
result.vehicle1.delta_vv
result.vehicle3
result.found.valu
result.delta_v
speed: str = result.vehicle1.delta_v
result.vehicle1.path[0].hight
result.warnings[0].text
case.crush().crash3.delta_w
case.check().commands[0].run
case.compare().rows[0].speed
case.sensitivity().derivatives[0].influense
uncertain.outputs["vehicle1.speed"].medain
[output.medain for output in uncertain.outputs.values()]
low: float = uncertain.outputs["vehicle1.speed"].median
case.estimate().pieces[0].verdikt
case.draw("picture")
case.uncertainty("many")
pydeltav.crush_table(1)
pydeltav.ciss.judge([]).judged[0].recorded
"""

BEGINS = """import pydeltav

case = pydeltav.Case.example()
result = case.reconstruct()
uncertain = case.uncertainty(1000)
"""


def refused(errors: list[int], checked: str) -> None:
    before = BEGINS.count("\n")
    wanted = {before + 1 + line for line in range(WRONG.strip().count("\n") + 1)}
    assert set(errors) == wanted, checked


@pytest.fixture
def written(tmp_path: pathlib.Path) -> pathlib.Path:
    (tmp_path / "right.py").write_text(RIGHT, "utf-8")
    (tmp_path / "wrong.py").write_text(BEGINS + WRONG.lstrip(), "utf-8")
    return tmp_path


def test_mypy_refuses_what_is_not_there(written: pathlib.Path) -> None:
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(written / "cache"), "right.py", "wrong.py"]
    checked = subprocess.run(command, capture_output=True, encoding="utf-8", cwd=written).stdout
    assert "right.py" not in checked, checked
    refused([int(line) for line in re.findall(r"^wrong.py:(\d+): error", checked, re.M)], checked)


def test_pyright_refuses_what_is_not_there(written: pathlib.Path) -> None:
    pytest.importorskip("pyright", reason="there is no pyright: in the folder python, pip install '.[test]'")
    if shutil.which("node") is None:
        pytest.skip("there is no Node.js, by which pyright runs")
    command = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, "right.py", "wrong.py"]
    checked = subprocess.run(command, capture_output=True, encoding="utf-8", cwd=written).stdout
    assert "right.py:" not in checked, checked
    refused([int(line) for line in re.findall(r"wrong.py:(\d+):\d+ - error", checked)], checked)


def test_a_part_that_is_no_record_stays_what_it_is() -> None:
    assert Keyed({"a": 1}, int)["a"] == 1
    assert list(Keyed({"a": {"median": 1.0}}, results.Interval).values())[0].median == 1.0
    assert isinstance(Record({"a": {"b": [1, {"c": 2}]}})["a"]["b"][1], Record)
