"""Examples run, and the types are those of the real module."""

import doctest
import inspect
import pathlib
import re
import subprocess
import sys
from typing import Any

import pydeltav
import pytest
from conftest import ROOT, UNCERTAIN


def test_the_examples_of_the_docstrings_run() -> None:
    uncertain = pydeltav.Case.read(UNCERTAIN).uncertainty(1000)
    estimated = pydeltav.Case.example().estimate(particles=128, pieces=False)
    names = {"pydeltav": pydeltav, "uncertain": uncertain, "columns": uncertain.columns(), "estimated": estimated}
    for module, least in ((pydeltav, 60), (pydeltav.results, 3)):
        found = doctest.testmod(module, extraglobs=names, optionflags=doctest.ELLIPSIS)
        assert found.failed == 0
        assert found.attempted >= least, "docstrings of the Rust classes are among them"


def callables() -> dict[str, tuple[Any, list[str]]]:
    """Every class, function and method that is offered, with its parameters."""
    offered: dict[str, tuple[Any, list[str]]] = {}

    def add(name: str, of: Any) -> None:
        try:
            parameters = [name for name in inspect.signature(of).parameters if name != "self"]
        except ValueError:
            # A class of the engine, which nobody can make.
            parameters = []
        offered[name] = (of, [] if parameters == ["args", "kwargs"] else parameters)

    for module in (pydeltav, pydeltav.ciss, pydeltav.results):
        for name in module.__all__:
            of = getattr(module, name)
            # The parts of a result are read, not made: their attributes have docstrings.
            if not callable(of) or (module is pydeltav.results and name != "Keyed"):
                continue
            add(f"{module.__name__}.{name}", of)
            for method, function in vars(of).items() if isinstance(of, type) else ():
                if not method.startswith("_") and callable(getattr(of, method)):
                    add(f"{module.__name__}.{name}.{method}", getattr(of, method))
    return offered


def section(text: str, heading: str) -> str:
    """What stands below a heading, up to the next one."""
    found = re.search(rf"^{heading}\n-{{{len(heading)}}}\n(.*?)(?=^\w+\n---|\Z)", text, re.M | re.S)
    return found[1] if found else ""


@pytest.mark.parametrize("name", callables())
def test_a_docstring_names_parameters_units_errors_and_an_example(name: str) -> None:
    of, parameters = callables()[name]
    text = inspect.cleandoc(of.__doc__ or "")
    described = re.findall(r"^(\w+)(?: :.*)?$", section(text, "Parameters"), re.M)
    assert described == parameters
    if name != "pydeltav.NoAnswerError":
        assert ">>> " in section(text, "Examples"), text
    # Whoever passes something can pass what is wrong; what gives numbers says in which units.
    if parameters and not isinstance(of, type) and name.split(".")[-1] not in ("get", "case_schema"):
        assert re.search(r"^\w*Error$", section(text, "Raises"), re.M), text
    if re.search(r"ndarray|^(Analysis|Estimate|Uncertainty|Rows|Columns)$", section(text, "Returns"), re.M):
        assert re.search(r"SI|Rows$", section(text, "Returns"), re.M), text


def test_every_callable_is_among_them() -> None:
    names = callables()
    assert len(names) > 60, names
    for name in ("pydeltav.Case.uncertainty", "pydeltav.crush_table", "pydeltav.Columns.items", "pydeltav.ciss.Pairs.save"):
        assert name in names
    assert names["pydeltav.Case.estimate"][1] == ["particles", "seed", "prior", "pieces", "above", "threads"]


def test_the_examples_of_the_readme_run(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # It saves a drawing.
    monkeypatch.chdir(tmp_path)
    readme = ROOT / "python" / "README.md"
    found = doctest.testfile(str(readme), module_relative=False, optionflags=doctest.ELLIPSIS, encoding="utf-8")
    assert found.failed == 0 and found.attempted >= 5


def test_everything_that_is_offered_says_what_it_is() -> None:
    for name in pydeltav.__all__:
        offered = getattr(pydeltav, name)
        if name == "__version__":
            continue
        assert offered.__doc__ and offered.__module__ == "pydeltav", name
        for method in getattr(offered, "__dict__", {}):
            if not method.startswith("_"):
                assert getattr(offered, method).__doc__, f"{name}.{method}"


def test_the_stubs_are_those_of_the_module(tmp_path: pathlib.Path) -> None:
    allowed = pathlib.Path(__file__).with_name("stubtest-allowlist.txt")
    # From elsewhere, so that it looks at what is installed.
    command = [sys.executable, "-m", "mypy.stubtest", "pydeltav", "--ignore-disjoint-bases", "--allowlist", str(allowed)]
    run = subprocess.run(command, capture_output=True, encoding="utf-8", cwd=tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr


def test_the_reference_is_that_of_the_package() -> None:
    folder = pathlib.Path(__file__).parents[1]
    # The script is no part of the package.
    sys.path.insert(0, str(folder))
    import reference

    written = reference.PAGE.read_text(encoding="utf-8")
    assert written == reference.page(), "run `python python/reference.py` where the package is installed"
    for name in ("### `Case.estimate(*, particles: int=256", "## class `Columns`", "**Parameters**", "```pycon"):
        assert name in written
