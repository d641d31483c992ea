"""Every fixture gives what the program gives, to the last bit, through file, text and dict."""

import json
import pathlib
import re

import pydeltav
import pytest
from conftest import FIXTURES, cases, run

# Few samples and particles: the bits are the point.
COMMANDS = {
    # To weigh all the evidence takes seconds: one case below.
    "reconstruct": (["--exact"], {"exact": True}),
    "impact": ([], {}),
    "motion": ([], {}),
    "crush": ([], {}),
    "check": ([], {}),
    "compare": ([], {}),
    "sensitivity": (["--pdof-step", "10", "--pdof-steps", "1"], {"pdof_step": 10, "pdof_steps": 1}),
    "uncertainty": (
        ["--samples", "640", "--seed", "7", "--method", "sobol"],
        {"samples": 640, "seed": 7, "method": "sobol"},
    ),
    "estimate": (
        ["--particles", "128", "--seed", "7", "--prior", "flat", "--no-pieces", "--above", "vehicle1.speed 50 km/h"],
        {"particles": 128, "seed": 7, "prior": "flat", "pieces": False, "above": ["vehicle1.speed 50 km/h"]},
    ),
    "recorder": ([], {}),
    "avoid": (["--samples", "640", "--seed", "7"], {"samples": 640, "seed": 7}),
}

# An estimate takes seconds.
ESTIMATED = ["estimate.toml", "sae-980025.toml", "no-answer/drive-apart.toml", "pole.toml"]


def asked(path: pathlib.Path) -> list[str]:
    is_estimated = str(pathlib.Path(*path.parts[1:])) in ESTIMATED
    return [command for command in COMMANDS if command != "estimate" or is_estimated]


def in_words_of_python(text: str) -> str:
    """What the program says of its commands, said of the methods."""
    return re.sub(rf"`deltav ({'|'.join(COMMANDS)})`", r"`\1()`", text)


def without_pointers(text: str) -> str:
    """Without what points to other commands of the program, which Python does not have."""
    return "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("= help:"))


@pytest.mark.parametrize("path", [path for path in cases() if "invalid" not in path.parts], ids=str)
def test_every_fixture_has_the_bits_of_the_program(path: pathlib.Path) -> None:
    of_file = pydeltav.Case.read(path)
    of_text = pydeltav.Case.parse(of_file.text, name=str(path))
    of_dict = pydeltav.Case.from_dict(of_file.to_dict())
    answers = 0
    for command in asked(path):
        options, keywords = COMMANDS[command]
        printed = run(command, path, "--format", "json", *options)
        if not printed.stdout:
            wanted = pydeltav.NoAnswerError if printed.returncode == 1 else pydeltav.CaseError
            with pytest.raises(wanted) as raised:
                getattr(of_file, command)(**keywords)
            said = in_words_of_python(printed.stderr.strip().removeprefix("error: "))
            assert str(raised.value).removeprefix("error: ").split("= help")[0] == said.split("= help")[0]
            for other in (of_text, of_dict):
                with pytest.raises(wanted):
                    getattr(other, command)(**keywords)
            continue
        answers += 1
        result = getattr(of_file, command)(**keywords)
        assert result.to_json() == printed.stdout
        assert getattr(of_text, command)(**keywords).to_json() == printed.stdout
        # repr tells apart what == does not: -0.0, and a whole number from one with a point.
        wanted = json.loads(printed.stdout)
        assert repr(result.to_dict()) == repr(wanted)
        found = getattr(of_dict, command)(**keywords).to_dict()
        of_case = found.pop("case")
        assert of_case["file"] == "dict" and len(of_case["sha256"]) == 64
        del wanted["case"]
        assert repr(found) == repr(wanted)
    assert answers > 0, "check answers every case that is well formed"


@pytest.mark.parametrize("path", [path for path in cases() if "invalid" in path.parts], ids=str)
def test_every_invalid_fixture_is_refused_in_the_words_of_the_program(path: pathlib.Path) -> None:
    printed = run("check", path)
    if printed.returncode == 0:
        # The one that the others are made of.
        assert path.name == "base.toml"
        return
    with pytest.raises(pydeltav.CaseError) as raised:
        pydeltav.Case.read(path)
    assert without_pointers(str(raised.value)) == without_pointers(printed.stderr)
    # No more are shown.
    for problem in raised.value.problems[:20]:
        assert problem.message in str(raised.value)
        assert (problem.line is None) == (problem.column is None)


def test_all_the_evidence_is_weighed_as_by_the_program() -> None:
    path = FIXTURES / "t-bone-category.toml"
    result = pydeltav.Case.read(path).reconstruct()
    assert result.to_json() == run("reconstruct", path, "--format", "json").stdout
    assert result.headline.by == "estimate" and len(result.headline.vehicle1.speed.interval95) == 2
    assert str(result) == run("reconstruct", path, "-o", "/dev/stdout").stdout
    assert result.solutions[0].delta_v[0] > 0.0 and result.solution_warnings[0].code == "category-energy"


def test_text_html_and_drawing_are_those_of_the_program() -> None:
    path = FIXTURES / "sae-980025-uncertain.toml"
    case = pydeltav.Case.read(path)
    result = case.reconstruct()
    assert result.text() == str(result) == run("reconstruct", path, "--exact", "-o", "/dev/stdout").stdout
    assert result.text("si") == run("reconstruct", path, "--exact", "--units", "si", "-o", "/dev/stdout").stdout
    assert result.html() == run("reconstruct", path, "--exact", "--format", "html").stdout
    assert result.markdown("si") == run("reconstruct", path, "--exact", "--format", "markdown", "--units", "si").stdout
    for what in ("scene", "damage", "reconciliation", "energy"):
        drawn = run("draw", path, "--what", what).stdout
        assert case.draw(what).svg() == drawn
        assert result.draw(what).svg() == drawn
    assert case.draw(plain=True).svg() == run("draw", path, "--what", "scene", "--plain").stdout
    uncertain = case.uncertainty(640)
    assert uncertain.html() == run("uncertainty", path, "--samples", "640", "--format", "html").stdout


def test_a_motion_is_drawn_as_by_the_program() -> None:
    path = FIXTURES / "rear-end-rest.toml"
    for what in ("motion", "motion-curves"):
        assert pydeltav.Case.read(path).draw(what).svg() == run("draw", path, "--what", what).stdout
