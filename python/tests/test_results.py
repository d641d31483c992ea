"""Results as Python and notebooks see them."""

import base64
import copy
import pathlib
import re
from html.parser import HTMLParser

import pydeltav
import pytest
from conftest import FIXTURES, UNCERTAIN

EXAMPLE = pydeltav.Case.example()


def test_attributes_are_the_keys_of_the_document() -> None:
    result = EXAMPLE.reconstruct()
    document = result.to_dict()
    assert set(document) <= set(dir(result))
    for key, value in document.items():
        assert result[key] == getattr(result, key)
        if isinstance(value, dict):
            assert dict(getattr(result, key)).keys() == value.keys()
    assert result.vehicle1.delta_v == document["vehicle1"]["delta_v"]
    assert result.found.roots == tuple(document["found"]["roots"])
    assert result.program.name == "deltav" and result.program.version == pydeltav.__version__
    assert re.fullmatch("[0-9a-f]{64}", result.case.sha256)


def test_a_part_is_a_mapping_that_cannot_be_changed() -> None:
    part = EXAMPLE.reconstruct().vehicle1
    assert part == EXAMPLE.reconstruct().to_dict()["vehicle1"] or isinstance(part, pydeltav.Record)
    assert list(part) == list(EXAMPLE.reconstruct().to_dict()["vehicle1"])
    assert "delta_v" in dir(part) and "delta_v=12.15" in repr(part)
    with pytest.raises(AttributeError, match="cannot be changed"):
        part.delta_v = 1.0
    with pytest.raises(AttributeError, match="there is no 'speeed' here, but .*delta_v"):
        _ = part.speeed
    assert copy.deepcopy(part) == part


def test_a_dict_of_a_result_is_the_callers_own() -> None:
    result = EXAMPLE.reconstruct()
    result.to_dict()["vehicle1"]["delta_v"] = 0.0
    assert result.to_dict()["vehicle1"]["delta_v"] == result.vehicle1.delta_v > 0.0


@pytest.mark.parametrize("name", ["speed", "_repr_png_", "__wrapped__", "_ipython_display_"])
def test_what_is_not_there_is_an_attribute_error(name: str) -> None:
    with pytest.raises(AttributeError, match=f"'Analysis' object has no attribute '{name}'"):
        getattr(EXAMPLE.reconstruct(), name)
    with pytest.raises(KeyError):
        EXAMPLE.reconstruct()["speed"]


class Read(HTMLParser):
    """What stands in a piece of HTML, all of which is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.open: list[str] = []
        self.images: list[dict[str, str | None]] = []
        self.words = ""
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        assert tag != "script" and not any(name == "id" for name, _ in attrs)
        if tag == "img":
            self.images.append(dict(attrs))
        elif tag != "br":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words += data


def drawn(page: Read) -> str:
    [image] = page.images
    source, says = image["src"], image["alt"]
    assert source is not None and says
    return base64.b64decode(source.removeprefix("data:image/svg+xml;base64,")).decode()


def test_a_notebook_shows_headline_table_and_drawing() -> None:
    result = EXAMPLE.reconstruct()
    bundle = result._repr_mimebundle_()
    assert bundle["text/plain"].splitlines()[0] == "Speed of vehicle 1: 51.16 mph (75.03 ft/s)"
    page = Read(bundle["text/html"])
    assert bundle["text/html"] == result._repr_html_()
    assert "Speed of vehicle 1: 51.16 mph (75.03 ft/s)" in page.words and "table" in page.tags
    assert drawn(page) == result.draw("scene").svg()


def test_a_notebook_shows_every_result() -> None:
    uncertain = pydeltav.Case.read(UNCERTAIN).uncertainty(1000)
    assert drawn(Read(uncertain._repr_html_())) == uncertain.histogram("vehicle1.speed").svg()
    assert uncertain.tornado("vehicle1.speed").svg().startswith("<svg")
    crushed = pydeltav.Case.read(FIXTURES / "sae-980025-crush.toml").crush()
    assert drawn(Read(crushed._repr_html_())) == crushed.draw().svg() == crushed.draw("damage").svg()
    for result in (EXAMPLE.check(), EXAMPLE.compare(), EXAMPLE.sensitivity()):
        page = Read(result._repr_html_())
        assert "table" in page.tags and not page.images
        assert result._repr_mimebundle_()["text/plain"]


def test_what_others_wrote_cannot_act_in_a_notebook() -> None:
    text = EXAMPLE.text.replace("1994 GMC Jimmy", '<script>alert(1)</script>\\" onload=').replace("Intersection", "<b>")
    page = Read(pydeltav.Case.parse(text).reconstruct()._repr_html_())
    assert "<script>alert(1)</script>" in page.words


def test_a_drawing_is_saved_in_the_format_of_its_name(tmp_path: pathlib.Path) -> None:
    drawing = EXAMPLE.draw("scene", units="si")
    for ending, begins in {"svg": b"<svg", "PNG": b"\x89PNG", "pdf": b"%PDF"}.items():
        drawing.save(tmp_path / f"scene.{ending}")
        assert (tmp_path / f"scene.{ending}").read_bytes().startswith(begins)
    with pytest.raises(ValueError, match="must end in .svg, .png or .pdf"):
        drawing.save(tmp_path / "scene.jpg")
    with pytest.raises(FileNotFoundError):
        drawing.save(tmp_path / "none" / "scene.svg")
    assert drawn(Read(drawing._repr_html_())) == drawing.svg()


def test_a_case_without_an_answer_says_why() -> None:
    case = pydeltav.Case.read(FIXTURES / "no-answer" / "drive-apart.toml")
    with pytest.raises(pydeltav.NoAnswerError):
        case.impact()
    # It is a ValueError of Python, but no CaseError: the case is well formed.
    assert issubclass(pydeltav.NoAnswerError, ValueError) and issubclass(pydeltav.CaseError, ValueError)
    assert not issubclass(pydeltav.NoAnswerError, pydeltav.CaseError)
