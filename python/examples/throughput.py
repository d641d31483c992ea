"""How many rows a second, and what a call costs: ``python throughput.py``.

Each row is the example of SAE 980025 with other weights, angles and depths, as in the example of the same name in
``crates/tables``. With ``--write FOLDER`` it writes ``crashes.parquet`` and ``template.toml`` instead, for
``deltav table`` and for ``spark.py``.
"""

import argparse
import pathlib
import statistics
import time
from collections.abc import Callable

import pydeltav
import pyarrow as pa
import pyarrow.parquet as pq

# What is moved about: a column in its unit, its number in the example, and by how much.
COLUMNS = [
    ("vehicle1.weight [lb]", 3696.0, 200.0),
    ("vehicle2.weight [lb]", 3413.0, 200.0),
    ("vehicle2.heading [deg]", 67.0, 5.0),
    ("impact.crush_plane [deg]", -23.0, 3.0),
    *(
        (f"vehicle{vehicle}.crush.depths[{station}] [in]", depth, 1.0)
        for vehicle, depths in [(1, (21.3, 20.3, 13.8, 11.3, 5.3, 4.8)), (2, (3.0, 15.8, 13.5, 6.7, 3.3, 5.0))]
        for station, depth in enumerate(depths, 1)
    ),
]
GOLDEN = 0.6180339887498949
EXAMPLE = pydeltav.Case.example().text
# Speed, width of the crush and restitution are ranges.
UNCERTAIN = (
    EXAMPLE.replace('= "10 mph"', '= { value = "10 mph", sd = "1 mph" }')
    .replace('= "65 in"', '= { value = "65 in", sd = "1 in" }')
    .replace("restitution = 0.3", "restitution = { value = 0.3, sd = 0.05 }")
)


def crashes(rows: int, wrong: int | None = None) -> pa.Table:
    """So many rows; of every ``wrong`` rows one has a negative weight."""
    columns: dict[str, object] = {"id": pa.array(range(rows), pa.int64())}
    for place, (name, middle, spread) in enumerate(COLUMNS):
        # From −1 to 1, spread evenly: the fractional parts of the multiples of the golden ratio.
        shares = (2 * (GOLDEN * (row * len(COLUMNS) + place) % 1) - 1 for row in range(rows))
        columns[name] = [middle + spread * share for share in shares]
    if wrong is not None:
        columns["vehicle1.weight [lb]"][::wrong] = [-1.0] * len(range(0, rows, wrong))  # type: ignore[index]
    return pa.table(columns)


def seconds(work: Callable[[], object]) -> tuple[float, float]:
    """(s, s) on the clock, and of all processors."""
    clock, processors = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - clock, time.process_time() - processors


def loop(table: pa.Table) -> pa.Table:
    """What ``reconstruct_table`` does, as a loop over ``Case``."""
    numbers, rows = pydeltav.Case.example().to_dict(), []
    for row in table.to_pylist():
        numbers["vehicle1"]["weight"] = f"{row['vehicle1.weight [lb]']} lb"
        numbers["vehicle2"]["weight"] = f"{row['vehicle2.weight [lb]']} lb"
        numbers["vehicle2"]["heading"] = f"{row['vehicle2.heading [deg]']} deg"
        numbers["impact"]["crush_plane"] = f"{row['impact.crush_plane [deg]']} deg"
        for vehicle in ("vehicle1", "vehicle2"):
            depths = (row[f"{vehicle}.crush.depths[{station}] [in]"] for station in range(1, 7))
            numbers[vehicle]["crush"]["depths"] = " ".join(map(str, depths)) + " in"
        found = pydeltav.Case.from_dict(numbers).reconstruct().to_dict()
        rows.append({"id": row["id"], **{name: found[name] for name in ("found", "vehicle1", "vehicle2", "impact")}})
    return pa.Table.from_pylist(rows)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", type=int, default=100_000, help="rows of the table (default: %(default)s)")
    parser.add_argument("--samples", type=int, default=1000, help="samples of a row (default: %(default)s)")
    parser.add_argument("--rounds", type=int, default=5, help="of which the median is printed (default: %(default)s)")
    parser.add_argument("--wrong", type=int, help="of every so many rows one is wrong")
    parser.add_argument("--write", type=pathlib.Path, metavar="FOLDER", help="write table and template into this folder")
    given = parser.parse_args()
    table = crashes(given.rows, given.wrong)
    if given.write is not None:
        given.write.mkdir(parents=True, exist_ok=True)
        pq.write_table(table, given.write / "crashes.parquet")
        (given.write / "template.toml").write_text(UNCERTAIN, encoding="utf-8")
        return
    case, few = pydeltav.Case.example(), table.slice(0, max(given.rows // 50, 1))
    calls = max(given.rows // 10, 1)

    def solve(rows: pa.Table, template: str, threads: int, samples: int | None = None) -> Callable[[], object]:
        return lambda: pydeltav.reconstruct_table(rows, template=template, samples=samples, threads=threads)

    # What is done, of how many rows or calls.
    works: list[tuple[str, int, Callable[[], object]]] = [
        ("a call of case.reconstruct()", calls, lambda: [case.reconstruct() for _ in range(calls)]),
        ("Case.parse(text).reconstruct()", calls, lambda: [pydeltav.Case.parse(EXAMPLE).reconstruct() for _ in range(calls)]),
        ("a loop over Case", calls, lambda: loop(table.slice(0, calls))),
        ("reconstruct_table, 1 thread", given.rows, solve(table, EXAMPLE, 1)),
        ("reconstruct_table, 2 threads", given.rows, solve(table, EXAMPLE, 2)),
        (f"with {given.samples} samples, 1 thread", len(few), solve(few, UNCERTAIN, 1, given.samples)),
        (f"with {given.samples} samples, 2 threads", len(few), solve(few, UNCERTAIN, 2, given.samples)),
    ]
    # In turn, so that whatever else the machine does falls on all of them.
    times = [[seconds(work) for _, _, work in works] for _ in range(given.rounds)]
    for (name, rows, _), of_work in zip(works, zip(*times, strict=True), strict=True):
        clock, processors = ([time / rows * 1e6 for time in each] for each in zip(*of_work, strict=True))
        middle, most = statistics.median(clock), max(clock)
        print(f"{name}: {middle:.1f} µs ({min(clock):.1f} to {most:.1f}), {statistics.median(processors):.1f} µs of CPU")


if __name__ == "__main__":
    main()
