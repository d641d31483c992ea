"""Examples run, and the types are those of the real module."""

import doctest
import pathlib
import subprocess
import sys

import deltav
import pytest
from conftest import ROOT


def test_the_examples_of_the_docstrings_run() -> None:
    found = doctest.testmod(deltav, extraglobs={"deltav": deltav}, optionflags=doctest.ELLIPSIS)
    assert found.failed == 0
    assert found.attempted >= 25, "docstrings of the Rust classes are among them"


def test_the_examples_of_the_readme_run(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # It saves a drawing.
    monkeypatch.chdir(tmp_path)
    readme = ROOT / "python" / "README.md"
    found = doctest.testfile(str(readme), module_relative=False, optionflags=doctest.ELLIPSIS, encoding="utf-8")
    assert found.failed == 0 and found.attempted >= 5


def test_everything_that_is_offered_says_what_it_is() -> None:
    for name in deltav.__all__:
        offered = getattr(deltav, name)
        if name == "__version__":
            continue
        assert offered.__doc__ and offered.__module__ == "deltav", name
        for method in getattr(offered, "__dict__", {}):
            if not method.startswith("_"):
                assert getattr(offered, method).__doc__, f"{name}.{method}"


def test_the_stubs_are_those_of_the_module(tmp_path: pathlib.Path) -> None:
    allowed = pathlib.Path(__file__).with_name("stubtest-allowlist.txt")
    # From elsewhere, so that it looks at what is installed.
    command = [sys.executable, "-m", "mypy.stubtest", "deltav", "--ignore-disjoint-bases", "--allowlist", str(allowed)]
    run = subprocess.run(command, capture_output=True, encoding="utf-8", cwd=tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr


def test_the_types_are_those_that_an_editor_shows(tmp_path: pathlib.Path) -> None:
    right = """
import deltav
import numpy as np
import numpy.typing as npt

case: deltav.Case = deltav.Case.from_dict({"vehicle1": {}})
result: deltav.Analysis = case.reconstruct()
drawing: deltav.Drawing = result.draw("scene", units="si")
speed: float = result.vehicle1.delta_v
samples: npt.NDArray[np.float64] = case.uncertainty(1000, seed=1).columns()["vehicle1.speed"]
"""
    wrong = """
import deltav

deltav.Case.example().draw("picture")
deltav.Case.example().uncertainty("many")
deltav.Case("case.toml").text
"""
    (tmp_path / "right.py").write_text(right)
    (tmp_path / "wrong.py").write_text(wrong)

    def check(name: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), name]
        return subprocess.run(command, capture_output=True, encoding="utf-8", cwd=tmp_path)

    assert check("right.py").returncode == 0, check("right.py").stdout
    refused = check("wrong.py").stdout
    assert "wrong.py:4: error" in refused and "wrong.py:5: error" in refused
