"""Writes REFERENCE.md: the classes and functions of the package, by their signatures and docstrings.

Run it where the package is installed: ``python reference.py``. A test holds the page against the package.
"""

import ast
import inspect
from pathlib import Path

import pydeltav

FOLDER = Path(__file__).parent
PAGE = FOLDER / "REFERENCE.md"
STUB = FOLDER / "python/pydeltav/_pydeltav.pyi"

HEAD = """# Python reference

The classes and functions of the package `pydeltav`, as `help()` shows them. What results hold, attribute by attribute, is in
`pydeltav.results`; [the package's page](README.md) shows how all of it is used.
"""

Definition = ast.FunctionDef | ast.AsyncFunctionDef


def signature(definition: Definition) -> str:
    """The signature as the stub has it, without ``self``."""
    arguments = ast.unparse(definition.args)
    for own in ("self, /, ", "self, ", "self"):
        arguments = arguments.removeprefix(own)
    result = "" if definition.returns is None else f" -> {ast.unparse(definition.returns)}"
    return f"{definition.name}({arguments}){result}"


def is_property(definition: Definition) -> bool:
    return any(isinstance(one, ast.Name) and one.id == "property" for one in definition.decorator_list)


def text(docstring: str) -> str:
    """A docstring as Markdown: its sections in bold, its examples in fences."""
    lines, page, is_fenced = docstring.splitlines(), [], False
    for line, below in zip(lines, [*lines[1:], ""], strict=True):
        is_example = line.startswith(">>>")
        if is_fenced and not line.strip():
            page += ["```"]
            is_fenced = False
        elif is_example and not is_fenced:
            page += ["```pycon"]
            is_fenced = True
        if line and set(line) == {"-"}:
            continue
        if line and below and set(below) == {"-"}:
            page += [f"**{line}**", ""]
        elif is_fenced or not line.startswith("    "):
            named, _, kind = line.partition(" : ")
            is_entry = not is_fenced and below.startswith("    ")
            page += [f"- `{named}`" + (f": {kind}" if kind else "") if is_entry else line.replace("``", "`")]
        else:
            page += [f"  {line.strip()}".replace("``", "`")]
    return "\n".join([*page, "```"] if is_fenced else page)


def entry(level: int, title: str, thing: object) -> list[str]:
    docstring = inspect.getdoc(thing)
    if not docstring:
        raise ValueError(f"{title} has no docstring")
    return [f"{'#' * level} {title}", "", text(docstring), ""]


def members(definition: ast.ClassDef) -> list[Definition]:
    """The public methods and properties, each once."""
    found = {one.name: one for one in definition.body if isinstance(one, Definition) and one.name[0] != "_"}
    return list(found.values())


def page() -> str:
    """The whole page."""
    stub = ast.parse(STUB.read_text(encoding="utf-8"))
    parts = [HEAD]
    for definition in stub.body:
        name = getattr(definition, "name", "_")
        if name.startswith("_") or name not in pydeltav.__all__:
            continue
        thing = getattr(pydeltav, name)
        if isinstance(definition, ast.ClassDef):
            parts += entry(2, f"class `{name}`", thing)
            for member in members(definition):
                title = member.name if is_property(member) else signature(member)
                parts += entry(3, f"`{name}.{title}`", getattr(thing, member.name))
        elif isinstance(definition, Definition):
            parts += entry(2, f"`{signature(definition)}`", thing)
    return "\n".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
