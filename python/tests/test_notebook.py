"""The notebook runs, and its stored outputs are those of a run. ``UPDATE=1 pytest tests/test_notebook.py`` stores new ones."""

import os
import pathlib
from typing import Any

import nbformat
import pytest
from conftest import ROOT
from nbclient import NotebookClient

EXAMPLES = ROOT / "python" / "examples"
NOTEBOOK = EXAMPLES / "ciss.ipynb"
# Neither the version of Python nor the machine, so that the same notebook is the same file.
METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def executed(path: pathlib.Path) -> Any:
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(path.parent)}}).execute()
    notebook.metadata = nbformat.from_dict(METADATA)
    for place, cell in enumerate(notebook.cells, 1):
        cell.id = f"cell-{place}"
        cell.metadata = nbformat.from_dict({})
    return notebook


def said(notebook: Any) -> list[list[str]]:
    """What each cell says, without its pictures."""
    return [
        [output.get("text") or output["data"].get("text/plain", "") for output in cell.outputs]
        for cell in notebook.cells
        if cell.cell_type == "code"
    ]


def test_the_notebook_runs_and_has_the_outputs_of_a_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CISS_FOLDER", raising=False)
    run = executed(NOTEBOOK)
    if os.environ.get("UPDATE"):
        nbformat.write(run, NOTEBOOK)
    text = NOTEBOOK.read_text(encoding="utf-8")
    stored = nbformat.reads(text, as_version=4)
    assert said(run) == said(stored)
    assert stored.metadata == METADATA and text == nbformat.writes(stored) + "\n"
    assert "data:image/svg+xml" in text and "simulated" in text
    for place in (str(ROOT), str(pathlib.Path.home()), "/tmp"):
        assert place not in text, place
