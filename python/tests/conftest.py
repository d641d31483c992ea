"""What the tests share: the fixtures of the repository, and the program of the same tree."""

import functools
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FIXTURES = ROOT / "fixtures"


@functools.cache
def program() -> str:
    """The program ``deltav``: that of the variable DELTAV_PROGRAM, or the one that cargo builds."""
    if given := os.environ.get("DELTAV_PROGRAM"):
        return str(ROOT / given)
    subprocess.run(["cargo", "build", "--quiet", "--package", "deltav-cli"], cwd=ROOT, check=True)
    return str(ROOT / "target" / "debug" / "deltav")


def run(*arguments: str | pathlib.Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([program(), *arguments], capture_output=True, encoding="utf-8", cwd=ROOT)


def cases() -> list[pathlib.Path]:
    """All fixtures that are cases, well formed or not."""
    found = [path for path in FIXTURES.rglob("*.toml") if path.name != "published.toml"]
    return sorted(path.relative_to(ROOT) for path in found)


@pytest.fixture(autouse=True)
def in_the_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    """The program and the package call a file as it was named: both get the same name."""
    monkeypatch.chdir(ROOT)


UNCERTAIN = FIXTURES / "sae-980025-uncertain.toml"
