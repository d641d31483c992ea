"""A case from a file, a text and a dict, and what is said of one that is wrong."""

import pathlib
import pickle
from collections import OrderedDict
from types import MappingProxyType
from typing import Any

import pydeltav
import numpy as np
import pytest
from conftest import FIXTURES

SMALL: dict[str, Any] = {
    "vehicle1": {
        "mass": "1500 kg",
        "class": 3,
        "crush": {"ees": "36 km/h", "side": "front", "pdof": "0 deg", "moment_arm": "0 m"},
    },
    "vehicle2": {"fixed": True},
}

IMPACT: dict[str, Any] = {"crush_plane": "90 deg", "restitution": 0.1, "tangential": "critical"}


def test_a_dict_is_read_as_the_file_that_it_stands_for() -> None:
    text = pydeltav.Case.from_dict(SMALL | {"title": 'a "quoted"\\ line\nand \x07 another \x7f', "source": "ΔV"}).text
    case = pydeltav.Case.parse(text)
    assert case.title == 'a "quoted"\\ line\nand \x07 another \x7f'
    assert case.to_dict()["vehicle1"] == SMALL["vehicle1"]
    assert case.crush().vehicle1.ees == 10.0


def test_numbers_keep_their_bits() -> None:
    numbers = [0.1, 1 / 3, 5e-324, 0.30000000000000004, 2.5e-7, 1.0, 1e-17]
    for number in numbers:
        case = pydeltav.Case.from_dict(SMALL | {"impact": IMPACT | {"restitution": number, "tangential": {"friction": 1e22}}})
        assert repr(case.to_dict()["impact"]["restitution"]) == repr(number)
        assert repr(case.to_dict()["impact"]["tangential"]["friction"]) == repr(1e22)


def test_mappings_tuples_and_numbers_of_numpy_are_read() -> None:
    plain = SMALL | {"impact": IMPACT | {"restitution": {"speeds": "2 5 m/s", "values": [0.25, 0.5]}}}
    small = np.array([0.25, 0.5], dtype="float32")
    for values in [(0.25, 0.5), np.array([0.25, 0.5]), small, list(small)]:
        impact = IMPACT | {"restitution": {"speeds": "2 5 m/s", "values": values}}
        other = OrderedDict(SMALL) | {"impact": MappingProxyType(impact)}
        assert pydeltav.Case.from_dict(other).text == pydeltav.Case.from_dict(plain).text
    small = {"vehicle1": SMALL["vehicle1"] | {"class": np.int64(3)}, "vehicle2": {"fixed": np.bool_(True)}}
    assert pydeltav.Case.from_dict(small).text == pydeltav.Case.from_dict(SMALL).text


@pytest.mark.parametrize(
    "vehicle, key, says",
    [
        ({"mass": None}, "vehicle1.mass", "leave the key out"),
        ({"mass": 1j}, "vehicle1.mass", "of the type complex"),
        ({"crush": {"depths": ["1 in", {1}]}}, "vehicle1.crush.depths[1]", "of the type set"),
        ({5: "kg"}, "vehicle1", "the key 5 is not a text"),
        ({"mass": 1500}, "vehicle1.mass", "bare number 1500, but needs a unit"),
        ({"mass": "1500 kgg"}, "vehicle1.mass", 'unknown unit "kgg"'),
        ({"mass": float("nan")}, "vehicle1.mass", "bare number nan"),
        ({"wieght": "1500 kg"}, "vehicle1.wieght", 'did you mean "weight"?'),
        ({"heading": 10**30}, "vehicle1.heading", "bare number 1000000000000000000000000000000"),
        ({"crush": {"depths": "1 2 in", "width": "-3 in"}}, "vehicle1.crush.width", "3 in"),
    ],
)
def test_what_is_wrong_is_said_with_its_key(vehicle: dict[Any, Any], key: str, says: str) -> None:
    with pytest.raises(pydeltav.CaseError) as raised:
        pydeltav.Case.from_dict({"vehicle1": vehicle, "vehicle2": {"fixed": True}})
    assert says in str(raised.value)
    assert key in [problem.key for problem in raised.value.problems]
    again = pickle.loads(pickle.dumps(raised.value))
    assert str(again) == str(raised.value) and again.problems == raised.value.problems


def test_a_dict_that_holds_itself_is_refused() -> None:
    endless: dict[str, Any] = {"vehicle1": {}}
    endless["vehicle1"]["crush"] = endless
    with pytest.raises(pydeltav.CaseError, match="too deep"):
        pydeltav.Case.from_dict(endless)


def test_the_place_is_that_in_the_text() -> None:
    with pytest.raises(pydeltav.CaseError) as raised:
        pydeltav.Case.parse('[vehicle1]\nmass = "1500 kg"\nspeed = "ΔΔ", bad\n[vehicle2]\nfixed = true')
    assert raised.value.problems[0].line == 3
    case = pydeltav.Case.example()
    with pytest.raises(pydeltav.CaseError) as raised:
        case.impact()
    [problem] = raised.value.problems
    assert problem.key == "vehicle1.speed"
    assert problem.line is not None and case.text.splitlines()[problem.line - 1] == "[vehicle1]"
    assert problem.message == "`vehicle1.speed` is missing: `impact()` needs it"
    assert problem.help is not None and 'speed = "10 mph"' in problem.help


def test_a_file_that_cannot_be_read_is_an_error_of_python(tmp_path: pathlib.Path) -> None:
    with pytest.raises(FileNotFoundError, match="No such file or directory") as raised:
        pydeltav.Case.read(tmp_path / "none.toml")
    assert raised.value.filename == str(tmp_path / "none.toml")
    with pytest.raises(IsADirectoryError):
        pydeltav.Case.read(tmp_path)
    (tmp_path / "case.toml").write_bytes(b"title = '\xff'")
    with pytest.raises(pydeltav.CaseError, match="UTF-8"):
        pydeltav.Case.read(tmp_path / "case.toml")
    with pytest.raises(pydeltav.CaseError, match="larger than 1000000 bytes"):
        pydeltav.Case.parse("#" * 1_000_001)


def test_a_site_plan_lies_beside_the_file(tmp_path: pathlib.Path) -> None:
    text = (FIXTURES / "rear-end-rest.toml").read_text("utf-8")
    plan = 'site_plan = { file = "plan.png", corner = { x = "-20 m", y = "-15 m" }, width = "60 m" }\n'
    assert "\n[scene]\n" in text
    path = tmp_path / "case.toml"
    path.write_text(text.replace("\n[scene]\n", f"\n[scene]\n{plan}"), "utf-8")
    case = pydeltav.Case.read(path)
    with pytest.raises(pydeltav.CaseError, match="cannot read the site plan") as raised:
        case.draw("motion")
    assert raised.value.problems[0].key == "scene.site_plan.file"
    (tmp_path / "plan.png").write_bytes(pydeltav.Case.example().draw().png())
    assert "data:image/png" in case.draw("motion").svg()


@pytest.mark.parametrize(
    "ask, error, says",
    [
        (lambda case: case.uncertainty(-1), ValueError, "give a whole number from 0"),
        (lambda case: case.uncertainty(100.5), TypeError, "samples"),
        (lambda case: case.uncertainty(10), ValueError, "must be between 64"),
        (lambda case: case.uncertainty(seed=2**64), ValueError, "18446744073709551616"),
        (lambda case: case.uncertainty(threads=0), ValueError, "from 1 to 1024"),
        (lambda case: case.uncertainty(method="dice"), ValueError, '"monte-carlo", "latin-hypercube", "sobol"'),
        (lambda case: case.uncertainty(sobol=3), ValueError, "at least"),
        (lambda case: case.estimate(particles=100), ValueError, "multiple of 128"),
        (lambda case: case.estimate(prior="none"), ValueError, '"field", "serious-injury", "flat"'),
        (lambda case: case.estimate(above=["speed 3 m/s"]), ValueError, "its results are vehicle1.speed"),
        (lambda case: case.sensitivity(pdof_step=0), ValueError, "above 0"),
        (lambda case: case.sensitivity(pdof_step=float("nan")), ValueError, "above 0"),
        (lambda case: case.sensitivity(pdof_steps=181), ValueError, "0 to 180"),
        (lambda case: case.draw("picture"), ValueError, '"motion-curves"'),
        (lambda case: case.draw("energy", plain=True), ValueError, "plain=True"),
        (lambda case: case.draw(units="metric"), ValueError, '"si", "us"'),
        (lambda case: case.draw("motion"), pydeltav.CaseError, "motion()"),
        (lambda case: pydeltav.Case("case.toml"), TypeError, "Case.read"),
        (lambda case: pydeltav.Case.from_dict([]), TypeError, "takes a dict, not list"),
        (lambda case: pydeltav.Case.from_dict(case.text), TypeError, "Case.parse(text) a text"),
        (lambda case: pydeltav.Case.parse(pathlib.Path("a.toml")), TypeError, "Case.read(path) reads a file"),
        (lambda case: pydeltav.Case.parse(case.to_dict()), TypeError, "Case.from_dict(dict) a dict"),
        (lambda case: pydeltav.Case.parse("crashes/a.toml"), pydeltav.CaseError, 'Case.read("crashes/a.toml") reads'),
        (lambda case: pydeltav.Case.parse("A.TOML"), pydeltav.CaseError, "but the path of one"),
        (lambda case: pydeltav.Case.read(case.text), ValueError, "Case.parse(text) takes its text"),
    ],
)
def test_a_wrong_request_gets_a_sentence(ask: Any, error: type[Exception], says: str) -> None:
    case = pydeltav.Case.read(FIXTURES / "sae-980025-uncertain.toml")
    with pytest.raises(error) as raised:
        ask(case)
    # The name of the argument is a note of the exception.
    assert says in "\n".join([str(raised.value), *getattr(raised.value, "__notes__", [])])


def test_a_certain_case_has_nothing_to_propagate() -> None:
    with pytest.raises(pydeltav.CaseError, match="nothing is uncertain"):
        pydeltav.Case.example().uncertainty()


def test_a_site_plan_is_no_link(tmp_path: pathlib.Path) -> None:
    """A case comes from others: what it names lies in its folder, as for the program."""
    text = (FIXTURES / "rear-end-rest.toml").read_text("utf-8")
    plan = 'site_plan = { file = "plan.png", corner = { x = "-20 m", y = "-15 m" }, width = "60 m" }\n'
    folder = tmp_path / "case"
    folder.mkdir()
    (folder / "case.toml").write_text(text.replace("\n[scene]\n", f"\n[scene]\n{plan}"), "utf-8")
    (tmp_path / "elsewhere.png").write_bytes(pydeltav.Case.example().draw().png())
    (folder / "plan.png").symlink_to(tmp_path / "elsewhere.png")
    with pytest.raises(pydeltav.CaseError, match="the site plan plan.png: it is a link"):
        pydeltav.Case.read(folder / "case.toml").draw("motion")


def test_a_result_is_pickled_with_what_was_asked() -> None:
    case = pydeltav.Case.read(FIXTURES / "sae-980025-uncertain.toml")
    for result in [
        case.uncertainty(64, seed=2**64 - 1, method="sobol", sobol=64),
        case.sensitivity(pdof_step=2.5, pdof_steps=1),
        case.estimate(particles=128, prior="flat", pieces=False, above=["vehicle1.speed 50 km/h"]),
        case.check(),
    ]:
        again = pickle.loads(pickle.dumps(result))
        assert type(again) is type(result) and again.to_json() == result.to_json()
        # The text is not pickled: what was asked gives it again.
        assert again.text() == result.text()
