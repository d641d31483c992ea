"""DuckDB and Polars: the code of the README, with the bits of one process."""

import doctest
import pathlib
from collections.abc import Iterator
from typing import Any

import pydeltav
import duckdb
import polars as pl
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from conftest import ROOT, UNCERTAIN

README = ROOT / "python" / "README.md"
ROWS = 100
OPTIONS: dict[str, Any] = {"template": UNCERTAIN, "samples": 64}


@pytest.fixture
def readme(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[dict[str, Any]]:
    """The names that its examples define."""
    # They write files.
    monkeypatch.chdir(tmp_path)
    test = doctest.DocTestParser().get_doctest(README.read_text(encoding="utf-8"), {}, "README.md", str(README), 0)
    assert doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, clear_globs=False).failed == 0
    yield test.globs


def crashes() -> pa.Table:
    weights = [3600.0 + row for row in range(ROWS)]
    weights[2] = -1.0
    return pa.table({"id": range(ROWS), "vehicle1.weight [lb]": weights})


def of_one_process(**options: Any) -> pa.Table:
    rows = pa.table(pydeltav.reconstruct_table(crashes(), **options, threads=1))
    assert rows["error"].null_count == ROWS - 1
    return rows


def texts(table: pa.Table) -> list[str]:
    """Each row with all digits: −0 is not 0 then, and NaN is NaN."""
    return [repr(row) for row in table.to_pylist()]


def test_duckdb_reads_and_writes_what_one_process_finds(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    pq.write_table(crashes(), tmp_path / "crashes.parquet", row_group_size=30)
    for at_once in (7, ROWS):
        reader = duckdb.connect().sql("from 'crashes.parquet'").to_arrow_reader(at_once)
        found = pa.RecordBatchReader.from_stream(pydeltav.stream_table("reconstruct", reader, **OPTIONS))
        writer = duckdb.connect()
        writer.register("found", found)
        writer.execute("copy (from found) to 'results.parquet'")
        rows = pq.read_table(tmp_path / "results.parquet").sort_by("id")
        assert texts(rows) == texts(of_one_process(**OPTIONS))


def test_polars_finds_what_one_process_finds(tmp_path: pathlib.Path, readme: dict[str, Any]) -> None:
    template = readme["case"].text
    for group in (9, ROWS):
        pq.write_table(crashes(), tmp_path / "crashes.parquet", row_group_size=group)
        lazy = pl.scan_parquet("crashes.parquet")
        solved = readme["solved"]
        found = lazy.map_batches(solved, schema=solved(lazy.head(0).collect()).schema, streamable=True)
        rows = found.collect(engine="streaming").sort("id")
        assert repr(rows.to_dicts()) == repr(pl.DataFrame(of_one_process(template=template)).to_dicts())
