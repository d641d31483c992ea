"""Tables: a row in, a row out, with the bits of a case."""

import decimal
import functools
import pathlib
import random
import re
import struct
from collections.abc import Iterator
from typing import Any

import pydeltav
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
from conftest import FIXTURES, ROOT, cases

TEMPLATE = pydeltav.Case.example().text
SPEED = "vehicle2.speed [mph]"


def table(speeds: list[float | None]) -> pa.Table:
    return pa.table({"id": pa.array(range(len(speeds))), SPEED: pa.array(speeds, pa.float64())})


def flat(document: Any, path: str = "") -> dict[str, Any]:
    """The values of a document by their keys, with ``_`` between."""
    if isinstance(document, dict):
        parts = [flat(value, f"{path}_{key}" if path else key) for key, value in document.items()]
        return {key: value for part in parts for key, value in part.items()}
    return {path: document}


@pytest.mark.parametrize("path", [path for path in cases() if "invalid" not in path.parts], ids=str)
def test_a_row_has_the_bits_of_the_case(path: pathlib.Path) -> None:
    case = pydeltav.Case.read(path)
    for ask, solve in [
        (functools.partial(case.reconstruct, exact=True), pydeltav.reconstruct_table),
        (case.impact, pydeltav.impact_table),
        (case.crush, pydeltav.crush_table),
    ]:
        [row] = pa.table(solve(pa.table({"id": [7], "seed": pa.nulls(1)}), template=case)).to_pylist()
        assert row["id"] == 7
        try:
            document = flat(ask().to_dict())
        except ValueError:
            assert row["error"]
            continue
        assert row["error"] is None
        numbers = {key: value for key, value in row.items() if isinstance(value, float) and key in document}
        assert len(numbers) >= 3
        for key, value in numbers.items():
            assert repr(value) == repr(float(document[key])), key


def test_what_a_row_gives_stands_before_the_template() -> None:
    rows = pa.table(pydeltav.reconstruct_table(table([10.0, None, 20.0]), template=TEMPLATE)).to_pylist()
    faster = pydeltav.Case.parse(TEMPLATE.replace('"10 mph"', '"20 mph"')).reconstruct()
    example = pydeltav.Case.example().reconstruct()
    assert [row["found_value"] for row in rows] == [example.found.value, example.found.value, faster.found.value]


def test_a_wrong_row_costs_nothing_else() -> None:
    solved = pydeltav.reconstruct_table(table([10.0, 1e9, float("nan"), 10.0]), template=TEMPLATE)
    rows = pa.table(solved).to_pylist()
    assert len(solved) == 4 and [row["id"] for row in rows] == [0, 1, 2, 3]
    assert [row["error"] is None for row in rows] == [True, False, False, True]
    assert "implausibly large" in rows[1]["error"] and rows[1]["found_value"] is None
    assert rows[0] | {"id": 3} == rows[3]


def test_bits_depend_neither_on_partitions_nor_on_threads() -> None:
    text = (FIXTURES / "sae-980025-uncertain.toml").read_text("utf-8")
    speeds = pa.table({"vehicle2.heading [deg]": [60.0 + place / 10 for place in range(20)]})
    whole = pa.table(pydeltav.reconstruct_table(speeds, template=text, samples=640, seed=5))
    for threads in (1, 2):
        assert pa.table(pydeltav.reconstruct_table(speeds, template=text, samples=640, seed=5, threads=threads)).equals(whole)
    stream = pa.RecordBatchReader.from_batches(speeds.schema, speeds.to_batches(max_chunksize=7))
    assert pa.table(pydeltav.reconstruct_table(stream, template=text, samples=640, seed=5)).equals(whole)
    assert len(set(whole["vehicle1_delta_v_p975"].to_pylist())) > 1
    with_seed = speeds.append_column("seed", pa.array([5] * 20))
    assert pa.table(pydeltav.reconstruct_table(with_seed, template=text, samples=640)).equals(whole)


def test_whatever_speaks_arrow_goes_in_and_out() -> None:
    of_arrow = pa.table(pydeltav.reconstruct_table(table([10.0, 12.0]), template=TEMPLATE))
    frame = pl.DataFrame({"id": [0, 1], SPEED: [10.0, 12.0]})
    found = pl.DataFrame(pydeltav.reconstruct_table(frame, template=TEMPLATE))
    assert found["found_value"].to_list() == of_arrow["found_value"].to_pylist()
    texts = pl.DataFrame({"vehicle2.speed": ["10 mph", "12 mph"]})
    assert pl.DataFrame(pydeltav.reconstruct_table(texts, template=TEMPLATE))["error"].is_null().all()
    of_pandas = pydeltav.reconstruct_table(pd.DataFrame({SPEED: [10.0, 12.0]}), template=TEMPLATE)
    assert pd.DataFrame.from_arrow(of_pandas)["found_value"].tolist() == of_arrow["found_value"].to_pylist()
    for batch in table([10.0, 12.0]).to_batches():
        assert pa.table(pydeltav.reconstruct_table(batch, template=TEMPLATE)).equals(of_arrow)


def test_the_template_is_a_text_a_dict_or_a_path() -> None:
    wanted = pa.table(pydeltav.reconstruct_table(table([11.0]), template=TEMPLATE))
    path = ROOT / "crates" / "case" / "sae-980025.toml"
    for template in (pydeltav.Case.example().to_dict(), path, str(path.read_text("utf-8"))):
        assert pa.table(pydeltav.reconstruct_table(table([11.0]), template=template)).equals(wanted)
    with pytest.raises(pydeltav.CaseError, match='unknown key "restituton"'):
        pydeltav.reconstruct_table(table([11.0]), template={"impact": {"restituton": 0.1}})


def test_a_template_is_a_case_or_the_path_of_one(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    example = pydeltav.Case.example()
    wanted = pa.table(pydeltav.reconstruct_table(table([11.0]), template=TEMPLATE))
    (tmp_path / "a b.toml").write_text(TEMPLATE, "utf-8")
    (tmp_path / "case.txt").write_text(TEMPLATE, "utf-8")
    monkeypatch.chdir(tmp_path)
    for template in (example, "a b.toml", str(tmp_path / "a b.toml"), pathlib.Path("case.txt")):
        assert pa.table(pydeltav.reconstruct_table(table([11.0]), template=template)).equals(wanted)
    stream = pydeltav.stream_table("reconstruct", table([11.0]), template=example)
    assert pa.RecordBatchReader.from_stream(stream).read_all().equals(wanted)
    # A text on one line is a text.
    for template in ("[impact]", "title = 'a.toml'", "title = 'a'"):
        assert len(pydeltav.crush_table(table([11.0]), template=template)) == 1


@pytest.mark.parametrize(
    "template, error, says",
    [
        ("none.toml", FileNotFoundError, "none.toml"),
        (pathlib.Path("none.toml"), FileNotFoundError, "none.toml"),
        ("case.txt", ValueError, r'neither the text of a case file nor a path that ends in .toml; .*Path\("case.txt"\)'),
        (7, TypeError, "takes a Case, a dict, a text or the path of a case file, not int"),
        (pd.DataFrame({"a": [1]}), TypeError, "not DataFrame"),
        (pathlib.Path("latin.toml"), ValueError, "latin.toml is not UTF-8"),
    ],
)
def test_a_template_that_is_none_is_refused(
    template: Any, error: type[Exception], says: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "latin.toml").write_bytes(b"title = 'caf\xe9'")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error, match=says):
        pydeltav.crush_table(table([11.0]), template=template)


def test_a_dict_of_columns_is_a_table() -> None:
    speeds = [10.0, 12.0, 14.0]
    wanted = pa.table(pydeltav.reconstruct_table(table(list(speeds)), template=TEMPLATE))
    for column in (
        speeds,
        tuple(speeds),
        [10, 12, 14.0],
        np.array(speeds),
        np.array([10, 12, 14]),
        np.array(speeds, np.float32),
        [np.float64(10), np.int64(12), np.float32(14)],
        range(10, 16, 2),
        pd.Series(speeds),
        pl.Series(speeds),
        pa.array(speeds),
    ):
        of_dict = pydeltav.reconstruct_table({"id": range(3), SPEED: column}, template=TEMPLATE)
        assert pa.table(of_dict).equals(wanted), type(column)
    stream = pydeltav.stream_table("reconstruct", {"id": [0, 1, 2], SPEED: speeds}, template=TEMPLATE)
    assert pa.RecordBatchReader.from_stream(stream).read_all().equals(wanted)
    speeds_as_texts = np.array(["10 mph", "12 mph", "14 mph"])
    texts = {"id": ["a", None, "c"], "vehicle2.speed": speeds_as_texts, "kept": [True, None, False]}
    rows = pa.table(pydeltav.reconstruct_table(texts, template=TEMPLATE))
    assert rows["found_value"].to_pylist() == wanted["found_value"].to_pylist()
    assert rows["id"].to_pylist() == ["a", None, "c"] and rows["kept"].to_pylist() == [True, None, False]
    gaps = {SPEED: [None, 10.0, float("nan")], "none": [None] * 3}
    assert pa.table(pydeltav.reconstruct_table(gaps, template=TEMPLATE))["error"].is_null().to_pylist() == [True, True, False]


def test_a_column_of_lists_is_one_of_depths() -> None:
    name = "vehicle1.crush.depths [cm]"
    for depths in ([[30.0, 20.0], (10, 20), None], [np.array([30.0, 20.0]), [10, 20], None]):
        of_dict = pa.table(pydeltav.reconstruct_table({"id": [1, 2, 3], name: depths}, template=TEMPLATE))
        of_arrow = pa.table({"id": [1, 2, 3], name: pa.array([[30.0, 20.0], [10.0, 20.0], None])})
        assert of_dict.equals(pa.table(pydeltav.reconstruct_table(of_arrow, template=TEMPLATE)))
        assert of_dict["error"].null_count == 3
    square = {"id": [1, 2], name: np.array([[30.0, 20.0], [10.0, 20.0]])}
    found = pa.table(pydeltav.reconstruct_table(square, template=TEMPLATE))["vehicle1_crush_energy"].to_pylist()
    assert found == of_dict["vehicle1_crush_energy"].to_pylist()[:2] and found[0] > found[1] > 0.0


ITSELF: list[Any] = []
ITSELF.append(ITSELF)


@pytest.mark.parametrize(
    "given, error, says",
    [
        ({"id": [1, 2], SPEED: [1.0]}, ValueError, '"id" and "vehicle2.speed .mph." have 2 and 1 rows'),
        ({SPEED: 10.0}, TypeError, 'column "vehicle2.speed .mph." is one float: give a list'),
        ({"id": "abc"}, TypeError, "is one str"),
        ({"id": b"abc"}, TypeError, "is one bytes"),
        ({"vehicle1": {"mass": 3.0}}, TypeError, 'column "vehicle1" is one dict'),
        ({"id": np.float64(3.0)}, TypeError, "is one float64"),
        ({"id": [1, "a"]}, TypeError, 'column "id" has numbers, and in row 2 texts'),
        ({"id": [None, object()]}, TypeError, 'column "id", row 2: a object is not a number, text'),
        ({"id": [[[1.0]]]}, TypeError, "a list is not a number"),
        ({"id": [["a"]]}, TypeError, "a list is not a number"),
        ({"id": ITSELF}, TypeError, "a list is not a number"),
        ({"id": np.zeros((2, 2, 2))}, TypeError, "a list is not a number"),
        ({1: [1]}, TypeError, "the name of a column is a text, not 1"),
        ({}, ValueError, "the dict has no columns: give a table of pyarrow"),
        ([{"id": 1}], TypeError, "a list is not a table: give a table of pyarrow, Polars"),
        ("crashes.csv", TypeError, "a str is not a table"),
        (None, TypeError, "a NoneType is not a table"),
        (np.zeros((2, 2)), TypeError, "a ndarray is not a table"),
        (pydeltav.Case.example(), TypeError, "a Case is not a table"),
        (pa.array([1.0]), TypeError, "the DoubleArray is not a table of columns"),
        (pl.Series([1.0]), TypeError, "the Series is not a table of columns"),
        ({"vehicle2.sped [mph]": [10.0]}, ValueError, "is not a key of a case"),
    ],
)
def test_what_is_no_table_is_refused_in_words_of_this_package(given: Any, error: type[Exception], says: str) -> None:
    for solve in (pydeltav.crush_table, lambda table, **of: pydeltav.stream_table("crush", table, **of)):
        with pytest.raises(error) as raised:
            solve(given, template=TEMPLATE)
        assert re.search(says, str(raised.value)), raised.value


def test_nested_rows_are_cases_of_their_own() -> None:
    vehicle = {"mass": 1500.0, "yaw_inertia": 2500.0, "heading": 0.0, "contact": {"x": 2.0, "y": 0.0}}
    crush = {"side": "front", "width": 1.5, "depths": [0.3, 0.2], "stiffness": {"category": 3}}
    crushed = vehicle | {"crush": crush | {"pdof": {"value": 0.0}}}
    rows = [
        {"id": "a", "vehicle1": crushed, "vehicle2": {"fixed": True}},
        {"id": "b", "vehicle1": vehicle, "vehicle2": {"fixed": True}},
    ]
    found = pa.table(pydeltav.crush_table(pa.Table.from_pylist(rows))).to_pylist()
    with_units = {
        "mass": "1500 kg",
        "yaw_inertia": "2500 kg m^2",
        "heading": "0 deg",
        "contact": {"x": "2 m", "y": "0 m"},
        "crush": crush | {"width": "1.5 m", "depths": "0.3 0.2 m", "pdof": "0 deg"},
    }
    case = pydeltav.Case.from_dict({"vehicle1": with_units, "vehicle2": {"fixed": True}})
    assert found[0]["error"] is None
    assert repr(found[0]["vehicle1_crash3_delta_v"]) == repr(case.crush().crash3.delta_v[0])
    assert "crush" in found[1]["error"]


def test_schemas_are_known_without_data() -> None:
    result = pa.schema(pydeltav.result_schema("reconstruct", samples=1000))
    solved = pydeltav.reconstruct_table(table([10.0]), template=TEMPLATE, samples=1000)
    assert pa.table(solved).schema.names == ["id", *result.names] == solved.names
    assert [field.type for field in pa.table(solved).schema][1:] == [field.type for field in result]
    assert not any("." in name for name in result.names)
    assert not any(pa.types.is_unsigned_integer(field.type) for field in result)
    cases_of = pa.schema(pydeltav.case_schema())
    assert pa.types.is_list(cases_of.field("vehicle1").type.field("crush").type.field("depths").type)
    ranges = pa.schema(pydeltav.case_schema(ranges=True))
    assert pa.types.is_struct(ranges.field("vehicle1").type.field("mass").type)


def test_an_empty_table_has_the_columns_of_its_results() -> None:
    solved = pa.table(pydeltav.reconstruct_table(table([]), template=TEMPLATE))
    assert solved.num_rows == 0 and "found_value" in solved.schema.names


def test_an_estimate_of_a_row_is_that_of_the_case() -> None:
    path = FIXTURES / "estimate.toml"
    [row] = pa.table(pydeltav.estimate_table(pa.table({"seed": [1]}), template=path, particles=128)).to_pylist()
    estimated = pydeltav.Case.read(path).estimate(particles=128, pieces=False)
    assert row["vehicle1_speed_median"] == estimated.outputs["vehicle1.speed"].median


@pytest.mark.parametrize(
    "columns, options, says",
    [
        ({"vehicle1.mas [kg]": [1.0]}, {}, 'the column "vehicle1.mas [kg]" is not a key of a case'),
        ({"vehicle1.mass [m]": [1.0]}, {}, 'has the unit "m"'),
        ({"error": ["x"], SPEED: [10.0]}, {}, 'the column "error" has the name of a result: rename it'),
        ({"seed": [1]}, {"samples": 3}, "64"),
        ({"seed": [1]}, {"threads": 0}, "from 1 to 1024"),
    ],
)
def test_a_table_that_cannot_be_read_is_refused(columns: dict[str, Any], options: dict[str, Any], says: str) -> None:
    with pytest.raises(ValueError) as raised:
        pydeltav.reconstruct_table(pa.table(columns), template=TEMPLATE, **options)
    assert says in str(raised.value)


def test_a_stream_has_the_rows_of_the_table_and_solves_no_more_than_was_read() -> None:
    read = []

    def parts() -> Iterator[pa.RecordBatch]:
        for place in range(4):
            read.append(place)
            yield from table([10.0 + place, 1e9]).to_batches()

    def stream(**options: Any) -> pa.RecordBatchReader:
        crashes = pa.RecordBatchReader.from_batches(table([0.0]).schema, parts())
        solved = pydeltav.stream_table("reconstruct", crashes, template=TEMPLATE, **options)
        return pa.RecordBatchReader.from_stream(solved)

    reader = stream(samples=640, seed=5, threads=1)
    assert read == []
    reader.read_next_batch()
    assert read == [0]
    whole = pa.Table.from_batches(parts(), table([0.0]).schema)
    wanted = pa.table(pydeltav.reconstruct_table(whole, template=TEMPLATE, samples=640, seed=5))
    assert stream(samples=640, seed=5).read_all().combine_chunks().equals(wanted.combine_chunks())


def test_a_stream_cuts_a_large_batch_and_ends() -> None:
    rows = 20_001
    crashes = pa.table({"id": range(rows), SPEED: [10.0] * rows}).combine_chunks()
    solved = pydeltav.stream_table("crush", crashes, template=TEMPLATE)
    reader = pa.RecordBatchReader.from_stream(solved)
    sizes, identifiers = [], []
    for batch in reader:
        sizes.append(batch.num_rows)
        identifiers += batch.column("id").to_pylist()
    assert sizes == [10_000, 10_000, 1]
    assert identifiers == list(range(rows))
    with pytest.raises(ValueError, match="have been read"):
        pa.RecordBatchReader.from_stream(solved)


def test_a_stream_refuses_a_wrong_table_at_once() -> None:
    with pytest.raises(ValueError, match='job="reconstuct": give one of'):
        pydeltav.stream_table("reconstuct", table([10.0]), template=TEMPLATE)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="is not a key of a case"):
        pydeltav.stream_table("reconstruct", pa.table({"vehicle2.sped [mph]": [10.0]}), template=TEMPLATE)
    with pytest.raises(ValueError, match="64"):
        pydeltav.stream_table("reconstruct", table([10.0]), template=TEMPLATE, samples=3)


def arrow_text(values: list[bytes], kind: pa.DataType) -> pa.Array:
    """Text that nobody has checked, as pyarrow reads it from a file."""
    places = [0]
    for value in values:
        places.append(places[-1] + len(value))
    offsets = struct.pack(f"<{len(places)}{'q' if kind == pa.large_string() else 'i'}", *places)
    return pa.Array.from_buffers(kind, len(values), [None, pa.py_buffer(offsets), pa.py_buffer(b"".join(values))])


@pytest.mark.parametrize("kind", [pa.string(), pa.large_string()])
@pytest.mark.parametrize("column", ["vehicle2.speed", "vehicle1.name", "note"])
def test_text_in_another_encoding_is_refused(column: str, kind: pa.DataType) -> None:
    """Latin-1, an end in the middle of a letter, and bytes that begin no letter."""
    for value in (b"10\xa0mph", b"caf\xe9", b"10 mph\xc3", b"\xff"):
        speeds = pa.array([10.0, 12.0])
        table = pa.table([arrow_text([b"10 mph", value], kind), speeds], names=[column, "vehicle1.mass [kg]"])
        with pytest.raises(ValueError, match="UTF-8"):
            pydeltav.reconstruct_table(table, template=TEMPLATE)
        stream = pydeltav.stream_table("reconstruct", table, template=TEMPLATE)
        with pytest.raises(Exception, match="UTF-8"):
            pa.RecordBatchReader.from_stream(stream).read_all()


def test_a_thousand_random_tables_leave_the_interpreter_alive() -> None:
    """Types, nulls, dictionaries, views, bytes that are no text, also within others: a result or a sentence."""
    draw = random.Random(11)
    names = ["vehicle2.speed", "vehicle2.speed [mph]", "vehicle1.name", "note", "vehicle1.crush.depths", "vehicle1", "seed"]
    exact = pa.decimal128(9, 2)

    def bytes_as(kind: pa.DataType, rows: int) -> pa.Array:
        """Bytes that a library calls text without having looked."""
        return arrow_text([draw.randbytes(draw.randrange(5)) for _ in range(rows)], kind)

    def views(rows: int) -> pa.Array:
        """Views of text: short ones hold their bytes, long ones name a place, which need not be there."""
        values = [draw.choice([b"10 mph", draw.randbytes(5), draw.randbytes(30)]) for _ in range(rows)]
        wild, content, views = draw.random() < 0.3, b"", b""
        for value in values:
            if len(value) <= 12:
                views += struct.pack("<i12s", len(value), value)
                continue
            place = draw.randrange(-9, 99) if wild else len(content)
            views += struct.pack("<i4sii", len(value), value[:4], 0, place)
            content += value
        return pa.Array.from_buffers(pa.string_view(), rows, [None, pa.py_buffer(views), pa.py_buffer(content)])

    def column(rows: int, depth: int = 0) -> pa.Array:
        kind = draw.randrange(17 if depth < 2 else 9)
        numbers = [draw.choice([None, 1e300, -5.0, 0.0, 7.0, float("nan")]) for _ in range(rows)]
        texts = [draw.choice([None, "10 mph", "", "\u202e", "-", "a\u0000b"]) for _ in range(rows)]
        if kind == 0:
            return pa.array(numbers, draw.choice([pa.float64(), pa.float32()]))
        if kind == 1:
            return pa.array(texts, draw.choice([pa.string(), pa.large_string(), pa.string_view()]))
        if kind == 2:
            return bytes_as(draw.choice([pa.string(), pa.large_string()]), rows)
        if kind == 3:
            return views(rows)
        if kind == 4:
            return pa.nulls(rows)
        if kind == 5:
            return pa.array([draw.choice([None, True, False]) for _ in range(rows)])
        if kind == 6:
            whole = [draw.choice([None, draw.randrange(-9, 2**7)]) for _ in range(rows)]
            kinds = [pa.int64(), pa.int8(), pa.timestamp("s"), pa.duration("ms"), pa.date32()]
            return pa.array(whole, draw.choice(kinds))
        if kind == 7:
            return pa.array([draw.choice([None, decimal.Decimal("7.25")]) for _ in range(rows)], exact)
        if kind == 8:
            return pa.array([draw.choice([None, draw.randbytes(3)]) for _ in range(rows)], pa.binary())
        if kind in (9, 10):
            words = column(3, 2)
            places = pa.array([draw.choice([None, 0, 1, 2]) for _ in range(rows)], pa.int32())
            # A place that is not there is what a damaged file has.
            if kind == 10 and rows and draw.random() < 0.3:
                places = pa.array([draw.choice([-1, 3, 2**31 - 1]) for _ in range(rows)], pa.int32())
            return pa.DictionaryArray.from_arrays(places, words, safe=False)
        if kind in (11, 12):
            offsets = pa.array(sorted(draw.randrange(4) for _ in range(rows + 1)), pa.int32())
            return pa.ListArray.from_arrays(offsets, column(3, depth + 1))
        if kind == 13:
            return pa.FixedSizeListArray.from_arrays(column(2 * rows, depth + 1), 2)
        if kind == 14:
            inner = [draw.choice(["value", "mass"]), draw.choice(["low", "name"])]
            return pa.StructArray.from_arrays([column(rows, depth + 1) for _ in inner], inner)
        if kind == 15:
            return pa.array(numbers, pa.float64()).cast(pa.float16())
        return pa.array([[number] for number in numbers], pa.list_(pa.float64()))

    answered, refused = 0, 0
    for _ in range(1500):
        rows = draw.randrange(4)
        chosen = draw.sample(names, draw.randrange(1, 4))
        table = pa.table([column(rows) for _ in chosen], names=chosen)
        solve = draw.choice([pydeltav.crush_table, pydeltav.impact_table, pydeltav.reconstruct_table])
        try:
            if draw.random() < 0.2:
                stream = pydeltav.stream_table("crush", table, template=TEMPLATE)
                result = pa.RecordBatchReader.from_stream(stream).read_all()
            else:
                result = pa.table(solve(table, template=TEMPLATE))
        except (ValueError, OSError):
            refused += 1
            continue
        assert result.num_rows == rows
        answered += 1
    assert answered > 100 and refused > 100, (answered, refused)
