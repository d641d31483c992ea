"""Samples and draws for Arrow and NumPy."""

import csv
import gc
import pathlib
import pickle

import pydeltav
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
from conftest import FIXTURES, UNCERTAIN, run


@pytest.fixture(scope="module")
def uncertain() -> pydeltav.Uncertainty:
    return pydeltav.Case.read(UNCERTAIN).uncertainty(1000, seed=3)


def test_the_samples_are_those_that_the_program_writes(tmp_path: pathlib.Path) -> None:
    path = FIXTURES / "wide-ranges.toml"
    written = tmp_path / "samples.csv"
    run("uncertainty", path, "--samples", "1000", "--seed", "3", "--samples-out", written, "-o", tmp_path / "x.txt")
    rows = list(csv.DictReader(written.open(encoding="utf-8")))
    columns = pydeltav.Case.read(path).uncertainty(1000, seed=3).columns()
    assert columns.rows == len(rows) == 1000
    failed = pa.record_batch(columns).column("failed").to_pylist()
    assert failed == [row["failed"] or None for row in rows]
    assert 0 < sum(reason is not None for reason in failed) < 1000, "some samples of this case fail"
    for key, name in zip(columns, columns.names[1:], strict=True):
        wanted = [float(row[key]) if row[key] else None for row in rows]
        assert pa.record_batch(columns).column(name).to_pylist() == wanted
        found = [None if np.isnan(value) else value for value in columns[key].tolist()]
        assert found == wanted


def test_a_view_of_numpy_is_on_the_memory_of_the_result(uncertain: pydeltav.Uncertainty) -> None:
    columns = uncertain.columns()
    view = columns["vehicle1.speed"]
    assert view.dtype == np.float64 and view.shape == (1000,)
    address = view.ctypes.data
    # Of the same result it is the same memory, and Arrow hands out that, too.
    assert columns["vehicle1.speed"].ctypes.data == uncertain.columns()["vehicle1.speed"].ctypes.data == address
    of_arrow = pa.record_batch(columns).column("vehicle1_speed").buffers()[1]
    assert of_arrow is not None and of_arrow.address == address
    assert np.mean(view) == pytest.approx(uncertain.outputs["vehicle1.speed"].mean, rel=1e-12)


def test_a_view_cannot_be_written_to(uncertain: pydeltav.Uncertainty) -> None:
    view = uncertain.columns()["vehicle1.speed"]
    assert not view.flags.writeable and not view.flags.owndata
    with pytest.raises(ValueError, match="read-only"):
        view[0] = 0.0
    with pytest.raises(ValueError, match="WRITEABLE"):
        view.flags.writeable = True


def test_a_view_outlives_the_result() -> None:
    case = pydeltav.Case.read(UNCERTAIN)
    kept = case.uncertainty(1000, seed=3).columns()["vehicle1.speed"]
    copy = kept.copy()
    gc.collect()
    # What is freed is soon overwritten.
    others = [case.uncertainty(1000, seed=seed).columns()["vehicle1.speed"] for seed in range(10, 30)]
    assert np.array_equal(kept, copy)
    assert len({other.ctypes.data for other in others} | {kept.ctypes.data}) == 21


def test_whatever_speaks_arrow_takes_the_columns(uncertain: pydeltav.Uncertainty) -> None:
    columns = uncertain.columns()
    speeds = columns["vehicle1.speed"]
    for table in (pa.table(columns), pa.record_batch(columns), pa.RecordBatchReader.from_stream(columns).read_all()):
        assert table.schema.names == columns.names
        assert table.schema.field("vehicle1_speed").metadata == {b"key": b"vehicle1.speed"}
        assert np.array_equal(table.column("vehicle1_speed").to_numpy(), speeds)
    assert np.array_equal(pl.DataFrame(columns)["vehicle1_speed"].to_numpy(), speeds)
    assert np.array_equal(pd.DataFrame.from_arrow(columns)["vehicle1_speed"].to_numpy(), speeds)
    assert not any(set(name) & set(".[]") for name in columns.names)
    types = {field.type for field in pa.table(columns).schema}
    assert types == {pa.string(), pa.float64()}


def test_columns_are_asked_for_by_their_keys(uncertain: pydeltav.Uncertainty) -> None:
    columns = uncertain.columns()
    assert list(columns) == columns.keys() == list(uncertain.outputs)
    assert len(columns) == len(columns.names) - 1
    assert "vehicle1.speed" in columns and "vehicle9.speed" not in columns
    with pytest.raises(KeyError, match="the columns are vehicle1.speed, vehicle1.delta_v"):
        columns["vehicle9.speed"]


def test_pickled_columns_are_the_same() -> None:
    columns = pydeltav.Case.read(FIXTURES / "wide-ranges.toml").uncertainty(1000).columns()
    again = pickle.loads(pickle.dumps(columns))
    assert pa.table(again).equals(pa.table(columns), check_metadata=True)


def test_the_draws_of_an_estimate_are_those_that_the_program_writes(tmp_path: pathlib.Path) -> None:
    path = FIXTURES / "estimate.toml"
    written = tmp_path / "draws.csv"
    options = ["--particles", "128", "--no-pieces", "--samples-out", written, "-o", tmp_path / "x.txt"]
    assert run("estimate", path, *options).returncode == 0
    rows = list(csv.DictReader(written.open(encoding="utf-8")))
    estimated = pydeltav.Case.read(path).estimate(particles=128, pieces=False)
    columns = estimated.columns()
    assert columns.rows == len(rows) == estimated.draws
    assert columns.keys() == list(rows[0])[1:]
    for key in columns:
        assert columns[key].tolist() == [float(row[key]) for row in rows]
    again = pickle.loads(pickle.dumps(estimated))
    assert again.to_json() == estimated.to_json()
    assert pa.table(again.columns()).equals(pa.table(columns))


def test_columns_read_as_a_dict(uncertain: pydeltav.Uncertainty) -> None:
    columns = uncertain.columns()
    assert [key for key, _ in columns.items()] == columns.keys()
    for (key, of_item), value in zip(columns.items(), columns.values(), strict=True):
        assert of_item.ctypes.data == value.ctypes.data == columns[key].ctypes.data
    assert list(dict(columns)) == columns.keys() and {**columns}.keys() == dict(columns).keys()
    assert columns.get("vehicle9.speed") is None and columns.get("vehicle9.speed", 3.0) == 3.0
    assert columns.get("vehicle1.speed") is not None and columns.get(1, "none") == "none"
    assert 1 not in columns


def test_columns_know_their_names_of_arrow(uncertain: pydeltav.Uncertainty) -> None:
    columns = uncertain.columns()
    for key, name in zip(columns, columns.names[1:], strict=True):
        assert name in columns
        assert columns[name].ctypes.data == columns[key].ctypes.data
    with pytest.raises(KeyError, match=r'failed is a column of texts: pyarrow.table\(columns\)'):
        columns["failed"]
    for name in ("vehicle1_speed_", "vehicle1-speed", ""):
        assert name not in columns


def test_pandas_gets_all_rows_with_their_names_or_a_sentence(uncertain: pydeltav.Uncertainty) -> None:
    columns = uncertain.columns()
    # A table of keys, or numbers without names, would be neither.
    for make in (pd.DataFrame, np.asarray, np.array):
        with pytest.raises(TypeError, match=r"would lose the names of the columns: use pandas.DataFrame.from_arrow"):
            make(columns)
    frame = pd.DataFrame(dict(columns))
    assert frame.shape == (1000, len(columns)) and list(frame) == columns.keys()
    assert np.array_equal(frame["vehicle1.speed"].to_numpy(), columns["vehicle1.speed"])
    assert list(pd.DataFrame.from_arrow(columns)) == columns.names
    stacked = np.column_stack(columns.values())
    assert stacked.shape == (1000, len(columns))
    assert np.array_equal(stacked[:, 0], columns["vehicle1.speed"])
