"""From tables like NHTSA's to pairs of vehicles, and from these to intervals of ΔV held against recorders."""

import csv
import doctest
import hashlib
import json
import math
import os
import pathlib
import pickle
import random
import shutil
import sys
import zipfile
from collections.abc import Callable
from typing import Any

import pydeltav
import pandas
import polars
import pyarrow
import pytest
from conftest import ROOT, run

sys.path.insert(0, str(ROOT / "python" / "examples"))
import simulated_ciss

Rows = list[dict[str, Any]]
# Pairs of real crashes are not in the repository.
PUBLISHED = pathlib.Path(os.environ.get("CISS_PAIRS", ROOT.parent / "shared" / "data" / "ciss-2017-pairs.csv"))


@pytest.fixture(scope="module")
def simulated(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    folder = tmp_path_factory.mktemp("CISS_2017_CSV_files")
    simulated_ciss.write(folder, crashes=12, seed=1)
    return folder


@pytest.fixture
def folder(simulated: pathlib.Path, tmp_path: pathlib.Path) -> pathlib.Path:
    return pathlib.Path(shutil.copytree(simulated, tmp_path / "tables"))


def rows_of(folder: pathlib.Path, table: str) -> Rows:
    with open(folder / f"{table}.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write(folder: pathlib.Path, table: str, rows: Rows) -> None:
    with open(folder / f"{table}.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def changed(folder: pathlib.Path, table: str, change: Callable[[dict[str, Any]], None]) -> None:
    rows = rows_of(folder, table)
    for row in rows:
        change(row)
    write(folder, table, rows)


def of(row: dict[str, Any], crash: int, vehicle: int) -> bool:
    return (int(row["CASEID"]), int(row["VEHNO"])) == (crash, vehicle)


def test_the_examples_of_the_docstrings_run(tmp_path: pathlib.Path) -> None:
    simulated_ciss.write(tmp_path, crashes=3, seed=1)
    coverage = pydeltav.ciss.judge(pydeltav.ciss.pairs(tmp_path)[:1])
    names = {"pydeltav": pydeltav, "folder": tmp_path, "coverage": coverage}
    found = doctest.testmod(pydeltav.ciss, extraglobs=names, optionflags=doctest.ELLIPSIS)
    assert found.failed == 0 and found.attempted >= 9


def test_everything_that_is_offered_says_what_it_is() -> None:
    for name in pydeltav.ciss.__all__:
        offered = getattr(pydeltav.ciss, name)
        assert offered.__doc__ and offered.__module__ == "pydeltav.ciss", name


def test_pairs_have_the_columns_and_the_numbers_of_the_tables(simulated: pathlib.Path) -> None:
    pairs = pydeltav.ciss.pairs(simulated)
    assert len(pairs) == 12 and len(pairs.names) == 61
    damages = {(row["CASEID"], row["VEHNO"]): row for row in rows_of(simulated, "CDC") if row["EVENTNO"] == "1"}
    vehicles = {(row["CASEID"], row["VEHNO"]): row for row in rows_of(simulated, "GV")}
    for pair in pairs:
        for vehicle in ("1", "2"):
            key = (str(pair["CASEID"]), vehicle)
            for name in ("C1", "C6", "PDOF", "DIRECTD", "DVTOTAL"):
                assert pair[f"{name}_{vehicle}"] == float(damages[key][name]), (key, name)
            assert pair[f"CURBWT_{vehicle}"] == int(vehicles[key]["CURBWT"])
            assert pair[f"CDC_{vehicle}"] == damages[key]["CDC"]
    assert [pair["CASEID"] for pair in pairs] == list(range(1, 13))


def test_the_simulated_crashes_are_possible(tmp_path: pathlib.Path) -> None:
    simulated_ciss.write(tmp_path, crashes=9, seed=2, incomplete=4)
    pairs = pydeltav.ciss.pairs(tmp_path)
    assert len(pairs) == 9
    assert pairs.left_out == {"without PDOF of both": 2, "without a recorder's ΔV of this event": 2}
    sides = {"F": (300, 60), "B": (120, 240), "L": (210, 330)}
    for pair in pairs:
        for vehicle in (1, 2):
            least, most = sides[str(pair[f"CDCPLANE_{vehicle}"])]
            turned = (int(pair[f"PDOF_{vehicle}"]) - least) % 360  # type: ignore[arg-type]
            assert turned <= (most - least) % 360, "the force comes from the side that was hit"


def test_codes_of_what_is_not_known_are_left_empty(folder: pathlib.Path) -> None:
    codes = [
        ("CDC", "CMAX", ["888", "997", "998", "999"]),
        ("CDC", "FIELDLD", ["888", "-999"]),
        ("CDC", "DVTOTAL", ["999"]),
        ("CDC", "DVENERGY", ["999999", "9999997", "8888888"]),
        ("CDC", "HEADINGANG", ["361", "888", "-1"]),
        ("GV", "DVANGTHIS", ["997", "361"]),
        ("GV", "CARGOWT", ["9999", "9997", ".", " "]),
        ("GV", "MODELYR", ["9999"]),
    ]
    for table, column, values in codes:
        for value in values:
            changed(folder, table, lambda row, column=column, value=value: row.update({column: value}))
            pairs = pydeltav.ciss.pairs(folder)
            assert len(pairs) == 12
            assert {pair[f"{column}_{vehicle}"] for pair in pairs for vehicle in (1, 2)} == {None}, (column, value)
    # The same digits where they are a measurement, and codes that are to be told.
    changed(folder, "CDC", lambda row: row.update(CMAX="88", HEADINGANG="360", DVENERGY="88500"))
    changed(folder, "GV", lambda row: row.update(MAKE="99", MODEL="999", BODYTYPE="88", CARGOWT="0"))
    pair = pydeltav.ciss.pairs(folder)[0]
    kept = ["CMAX", "HEADINGANG", "DVENERGY", "MAKE", "MODEL", "BODYTYPE", "CARGOWT"]
    assert [pair[f"{name}_1"] for name in kept] == [88, 360, 88500, 99, 999, 88, 0]


@pytest.mark.parametrize(
    ("table", "change", "why"),
    [
        ("CDC", {"C4": "999"}, "without crush profiles of both"),
        ("CDC", {"FIELDL": "", "DIRECTL": "888"}, "without crush profiles of both"),
        ("CDC", {"PDOF": "888"}, "without PDOF of both"),
        ("CDC", {"CDCPLANE": "T"}, "without damage to front, back or side of both"),
        ("GV", {"CURBWT": "9999"}, "without masses of both"),
        ("GV", {"CURBWT": "0"}, "without masses of both"),
    ],
)
def test_a_pair_that_lacks_something_is_left_out_and_counted(
    folder: pathlib.Path, table: str, change: dict[str, str], why: str
) -> None:
    changed(folder, table, lambda row: row.update(change) if of(row, 3, 2) else None)
    pairs = pydeltav.ciss.pairs(folder)
    assert len(pairs) == 11 and pairs.left_out == {why: 1}
    assert 3 not in [pair["CASEID"] for pair in pairs]
    assert why in pairs._repr_html_()


def test_a_recorder_counts_only_for_the_event_that_it_stored(folder: pathlib.Path) -> None:
    recorders = [row for row in rows_of(folder, "EDREVENT") if row["CASEID"] != "5"]
    base = dict(recorders[0], CASEID="5", VEHNO="1", CDCEVENT="1", MAXDVLONG="-20", MAXDVLAT="997")

    def stored(*changes: dict[str, str]) -> pydeltav.ciss.Pairs:
        write(folder, "EDREVENT", recorders + [base | change for change in changes])
        return pydeltav.ciss.pairs(folder)

    # Another event, one that is not told (97), and none of both parts.
    for change in ({"CDCEVENT": "2"}, {"CDCEVENT": "97"}, {"MAXDVLONG": "888"}):
        assert stored(change).left_out == {"without a recorder's ΔV of this event": 1}
    assert stored({})[4] | {"MAXDVLONG_1": -20.0, "MAXDVLAT_1": None} == stored({})[4]
    # Of several records of the event, the largest; of one part only, that.
    both = stored({"MAXDVLONG": "-9"}, {"MAXDVLONG": "-8", "MAXDVLAT": "12.5"}, {"MAXDVLONG": "-10"})[4]
    assert (both["MAXDVLONG_1"], both["MAXDVLAT_1"]) == (-8.0, 12.5)


def test_of_three_vehicles_in_one_event_those_are_a_pair_that_name_each_other(folder: pathlib.Path) -> None:
    damages = rows_of(folder, "CDC")
    [second] = [row for row in damages if of(row, 2, 2)]
    write(folder, "GV", rows_of(folder, "GV") + [dict(rows_of(folder, "GV")[0], CASEID="2", VEHNO="3")])
    # Vehicle 3 struck vehicle 1 in the same event, which names vehicle 2.
    write(folder, "CDC", [*damages, dict(second, VEHNO="3", OBJCONT="1")])
    assert len(pydeltav.ciss.pairs(folder)) == 12
    # Where vehicle 1 struck vehicle 3 as well, it has two damages by the event: which is which is not told.
    [first] = [row for row in damages if of(row, 2, 1)]
    write(folder, "CDC", [*damages, dict(second, VEHNO="3", OBJCONT="1"), dict(first, OBJCONT="3")])
    pairs = pydeltav.ciss.pairs(folder)
    assert len(pairs) == 11 and pairs.left_out == {"with several damaged areas of one vehicle from the event": 2}
    # Who names nobody of the event is no pair, and nothing that was left out.
    changed(folder, "CDC", lambda row: row.update(OBJCONT="42"))
    assert len(pairs := pydeltav.ciss.pairs(folder)) == 0 and pairs.left_out == {}


def test_the_lower_number_is_vehicle_1_in_any_order_of_the_rows(folder: pathlib.Path) -> None:
    expected = pydeltav.ciss.pairs(folder)
    for table in ("CRASH", "GV", "CDC", "EDREVENT"):
        rows = rows_of(folder, table)
        random.Random(table).shuffle(rows)
        write(folder, table, rows)
    assert pydeltav.ciss.pairs(folder) == expected
    # The same crashes with the labels of the vehicles exchanged.
    other = {"1": "2", "2": "1"}
    for table in ("GV", "CDC", "EDREVENT"):
        changed(folder, table, lambda row: row.update(VEHNO=other.get(row["VEHNO"], row["VEHNO"])))
    changed(folder, "CDC", lambda row: row.update(OBJCONT=other.get(row["OBJCONT"], row["OBJCONT"])))
    for before, after in zip(expected, pydeltav.ciss.pairs(folder), strict=True):
        for name in ("CURBWT", "C3", "CDC", "MAXDVLONG"):
            assert (before[f"{name}_1"], before[f"{name}_2"]) == (after[f"{name}_2"], after[f"{name}_1"])


def test_contacts_stand_in_event_where_the_damages_name_none(folder: pathlib.Path) -> None:
    expected = pydeltav.ciss.pairs(folder)
    damages = rows_of(folder, "CDC")
    write(folder, "CDC", [{name: cell for name, cell in row.items() if name != "OBJCONT"} for row in damages])
    assert pydeltav.ciss.pairs(folder) == expected
    changed(folder, "EVENT", lambda row: row.update(OBJCONT="3") if row["CASEID"] == "4" else None)
    assert len(pydeltav.ciss.pairs(folder)) == 11
    (folder / "EVENT.csv").unlink()
    with pytest.raises(ValueError, match=r"there is no table EVENT \(EVENT.csv or event.sas7bdat\); there are CDC.csv, "):
        pydeltav.ciss.pairs(folder)


def test_names_are_read_in_upper_and_lower_case_and_from_a_zip(simulated: pathlib.Path, tmp_path: pathlib.Path) -> None:
    expected = pydeltav.ciss.pairs(simulated)
    lower = tmp_path / "lower"
    lower.mkdir()
    for file in simulated.iterdir():
        header, rest = file.read_text(encoding="utf-8").split("\n", 1)
        (lower / file.name.lower()).write_text("\ufeff" + header.lower() + "\n" + rest, encoding="utf-8")
    assert pydeltav.ciss.pairs(lower) == expected
    with zipfile.ZipFile(tmp_path / "CISS_2017_CSV_files.zip", "w") as archive:
        for file in simulated.iterdir():
            archive.write(file, f"CISS_2017/{file.name}")
    assert pydeltav.ciss.pairs(tmp_path / "CISS_2017_CSV_files.zip") == expected
    with zipfile.ZipFile(tmp_path / "CISS_2017_CSV_files.zip", "a") as archive:
        archive.write(simulated / "GV.csv", "CISS_2018/GV.csv")
    with pytest.raises(ValueError, match="table GV appears twice: CISS_2017/GV.csv and CISS_2018/GV.csv; give the tables of one year"):
        pydeltav.ciss.pairs(tmp_path / "CISS_2017_CSV_files.zip")


def test_what_is_missing_is_named_with_what_there_is_instead(folder: pathlib.Path, tmp_path: pathlib.Path) -> None:
    def refusal(source: pathlib.Path) -> str:
        with pytest.raises((ValueError, FileNotFoundError)) as raised:
            pydeltav.ciss.pairs(source)
        return str(raised.value)

    assert "there is no folder" in refusal(tmp_path / "nowhere")
    (tmp_path / "note.txt").write_text("no table")
    assert "is neither a folder nor a ZIP file" in refusal(tmp_path / "note.txt")
    above = refusal(tmp_path)
    assert "there is no table CRASH (CRASH.csv or crash.sas7bdat); there are note.txt, tables/" in above
    damages = rows_of(folder, "CDC")
    write(folder, "CDC", [{name.replace("C4", "AVGC4"): cell for name, cell in row.items()} for row in damages])
    said = refusal(folder)
    assert "the table CDC (CDC.csv) has no column C4; it has CASEID, EVENTNO, VEHNO, " in said and "AVGC4" in said
    write(folder, "CDC", damages)
    changed(folder, "CDC", lambda row: row.update(C4="deep") if of(row, 3, 2) else None)
    assert "CDC.csv, line 7, column C4: \"deep\" is not a number" in refusal(folder)
    write(folder, "CDC", damages)
    write(folder, "GV", rows_of(folder, "GV") * 2)
    assert "the table GV has two rows of CASEID 1, VEHNO 1: give the tables of one year" in refusal(folder)
    nass = tmp_path / "nass"
    nass.mkdir()
    for name in ("accident", "event", "gv", "ve"):
        (nass / f"{name}.sas7bdat").touch()
    assert "the tables are those of NASS-CDS (ACCIDENT, VE): they have no ΔV of a recorder" in refusal(nass)


def test_sas_files_give_the_pairs_of_csv(tmp_path: pathlib.Path) -> None:
    """Those of the program's tests, which ReadStat wrote: crash 7 has a pair, and that of crash 8 no PDOF."""
    download = ROOT / "crates" / "cli" / "tests" / "ciss-sas.zip"
    pairs = pydeltav.ciss.pairs(download)
    assert len(pairs) == 1
    assert pairs.left_out == {"without PDOF of both": 1}
    pair = pairs[0]
    assert (pair["CASEID"], pair["YEAR"], pair["CDC_1"], pair["C3_1"], pair["C6_1"]) == (7, 2017, "01FDEW02", 31.0, 40.0)
    assert (pair["MAXDVLONG_1"], pair["MAXDVLAT_1"], pair["CMAX_1"], pair["MAXDVLONG_2"]) == (-20.0, 5.25, None, None)
    with zipfile.ZipFile(download) as archive:
        archive.extractall(tmp_path)
    assert pydeltav.ciss.pairs(tmp_path) == pairs
    cut = tmp_path / "gv.sas7bdat"
    cut.write_bytes(cut.read_bytes()[:5000])
    with pytest.raises(ValueError, match=r"gv.sas7bdat: it cannot be read as a SAS file: .*; download it again"):
        pydeltav.ciss.pairs(tmp_path)


def test_libraries_read_pairs_and_a_saved_file_has_them(simulated: pathlib.Path, tmp_path: pathlib.Path) -> None:
    pairs = pydeltav.ciss.pairs(simulated)
    table = pyarrow.table(pairs)
    assert table.column_names == pairs.names and table.to_pylist() == list(pairs)
    assert [str(table.schema.field(name).type) for name in ("CASEID", "CDC_1", "C1_2")] == ["int64", "string", "double"]
    assert polars.DataFrame(pairs).rows(named=True) == list(pairs)
    assert len(pandas.DataFrame.from_arrow(pairs)) == 12
    pairs.save(tmp_path / "pairs.csv")
    assert pydeltav.ciss.read(tmp_path / "pairs.csv") == pairs
    assert pickle.loads(pickle.dumps(pairs)) == pairs
    assert pairs[2:5] == pydeltav.ciss.Pairs(list(pairs)[2:5]) != pairs
    (tmp_path / "other.csv").write_text("CASEID\n1\n")
    with pytest.raises(ValueError, match="there is no column YEAR; give a file that Pairs.save wrote"):
        pydeltav.ciss.read(tmp_path / "other.csv")


def test_the_program_makes_the_same_pairs_of_the_tables(simulated: pathlib.Path, tmp_path: pathlib.Path) -> None:
    pairs = pydeltav.ciss.pairs(simulated)
    pairs.save(tmp_path / "pairs.csv")
    archive = shutil.make_archive(str(tmp_path / "CISS_2017"), "zip", simulated)
    saved = hashlib.sha256((tmp_path / "pairs.csv").read_bytes()).hexdigest()
    for source in (tmp_path / "pairs.csv", simulated, archive):
        said = run("validate", "--field", source, "--format", "json", "--judge", "DVTOTAL")
        assert said.returncode == 0, said.stderr
        assert json.loads(said.stdout)["data"]["sha256"] == saved, "the same bytes"


def test_the_judgement_is_that_of_the_program(simulated: pathlib.Path, tmp_path: pathlib.Path) -> None:
    pairs = pydeltav.ciss.pairs(simulated)[1:3]
    pairs.save(tmp_path / "pairs.csv")
    for other in (False, True):
        said = run("validate", "--field", tmp_path / "pairs.csv", "--format", "json", *(["--other"] if other else []))
        assert said.returncode == 0, said.stderr
        coverage = pydeltav.ciss.judge(pairs, other=other, threads=1)
        assert json.loads(said.stdout) == coverage.to_dict()
    assert "Recorders inside the intervals" in str(coverage)
    assert "<svg" in coverage.draw().svg() and "<svg" in coverage.draw("ranks").svg()
    assert "<img" in coverage._repr_html_()
    again = pickle.loads(pickle.dumps(coverage))
    assert again == coverage and again.draw().svg() == coverage.draw().svg()
    with pytest.raises(ValueError, match='what="both": give one of "estimates", "ranks"'):
        coverage.draw("both")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="line 2, column CURBWT_1: \"-5.0\" is not a mass above 0 kg|CURBWT_1"):
        pydeltav.ciss.judge([pairs[0] | {"CURBWT_1": -5.0}])


def test_a_case_says_what_the_judgement_assumes(simulated: pathlib.Path) -> None:
    pairs = pydeltav.ciss.pairs(simulated)[:3]
    judged = pydeltav.ciss.judge(pairs).judged
    for pair in pairs:
        case = pydeltav.ciss.case(pair)
        assert case.title == f"Crash {pair['CASEID']} of 2017, event 1" and "recorder" not in case.text
        outputs = case.estimate(particles=128, pieces=False).outputs
        for found in judged:
            if found.case != str(pair["CASEID"]):
                continue
            part = "longitudinal_delta_v" if found.longitudinal else "delta_v"
            known = next(outputs[key] for key in outputs if key.startswith(f"vehicle{found.vehicle}.") and part in key)
            # The medians of both are those of the same collision: their sampling errs by some percent.
            assert abs(math.log(abs(known.median) / found.median)) < 0.08, (found, known.median)


def test_the_recorder_of_a_case_is_the_one_that_is_asked_for(simulated: pathlib.Path) -> None:
    pair = next(
        pair for pair in pydeltav.ciss.pairs(simulated) if pair["MAXDVLONG_2"] is not None and pair["MAXDVLAT_2"] is not None
    )
    given = pydeltav.ciss.case(pair, recorder=2).to_dict()
    assert "recorder" not in given["vehicle1"]
    assert given["vehicle2"]["recorder"]["delta_v_longitudinal"] == f"{pair['MAXDVLONG_2']:.3f} km/h"
    none = pair | {"MAXDVLONG_2": None, "MAXDVLAT_2": None}
    with pytest.raises(ValueError, match="recorder=2: that vehicle has no usable ΔV from a recorder"):
        pydeltav.ciss.case(none, recorder=2)
    with pytest.raises(ValueError, match="recorder: give 1 or 2"):
        pydeltav.ciss.case(pair, recorder=3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='CDCPLANE_2 of the pair is "T", not F, B, L or R'):
        pydeltav.ciss.case(pair | {"CDCPLANE_2": "T"})
    with pytest.raises(ValueError, match="C3_1 of the pair is nothing, not a number"):
        pydeltav.ciss.case(pair | {"C3_1": None})


@pytest.mark.skipif(not PUBLISHED.exists(), reason="the pairs of 2017 are not in the repository")
def test_the_pairs_of_2017_come_back_from_tables_that_have_them(tmp_path: pathlib.Path) -> None:
    expected = pydeltav.ciss.read(PUBLISHED)
    assert len(expected) == 329
    general = ("MAKE", "MODEL", "MODELYR", "BODYTYPE", "CURBWT", "CARGOWT", "DVANGTHIS")
    recorder = ("MAXDVLONG", "MAXDVLAT")
    tables: dict[str, Rows] = {"CRASH": [], "GV": [], "CDC": [], "EDREVENT": []}
    seen = set()
    for pair in expected:
        crash = {"CASEID": pair["CASEID"]}
        if crash["CASEID"] not in seen:
            tables["CRASH"].append(crash | {"CRASHYEAR": pair["YEAR"]})
        seen.add(crash["CASEID"])
        for place in (1, 2):
            of_vehicle = {
                name[:-2]: value for name, value in pair.items() if name.endswith(f"_{place}")
            }
            key = crash | {"VEHNO": of_vehicle.pop("VEHNO")}
            row = key | {name: of_vehicle[name] for name in general}
            if row not in tables["GV"]:
                tables["GV"].append(row)
            damage = {name: value for name, value in of_vehicle.items() if name not in (*general, *recorder)}
            event = {"EVENTNO": pair["EVENTNO"]}
            tables["CDC"].append(key | event | {"OBJCONT": pair[f"VEHNO_{3 - place}"]} | damage)
            stored = {name: 997 if of_vehicle[name] is None else of_vehicle[name] for name in recorder}
            tables["EDREVENT"].append(key | {"CDCEVENT": pair["EVENTNO"]} | stored)
    for name, rows in tables.items():
        write(tmp_path, name, rows)
    pairs = pydeltav.ciss.pairs(tmp_path)
    ordered = sorted(expected, key=lambda pair: (pair["CASEID"], pair["EVENTNO"]))
    assert list(pairs) == ordered and pairs.left_out == {}


def long_tables(folder: pathlib.Path) -> None:
    before, during = [], []
    for event, speeds in ((1, (60, 52)), (2, (41, 33))):
        key = {"CASEID": 7, "VEHNO": 1, "EDRSUMMNO": 1, "EDREVENTNO": event}
        before += [key | {"PCODE": 1010, "PTIME": time, "PVALUE": speed} for time, speed in zip((-1.0, 0.0), speeds)]
        before += [key | {"PCODE": 1050, "PTIME": 0.0, "PVALUE": 888}]
    for time, change in ((0, 0), (50, -12), (100, -15), (150, -15)):
        during.append(key | {"PCODE": 2010, "PTIME": time, "PVALUE": change})
    during.append(key | {"VEHNO": 2, "PCODE": 2010, "PTIME": 0, "PVALUE": 0})
    write(folder, "EDRPRECRASH", before)
    write(folder, "EDRPOSTCRASH", during)


def test_records_of_a_recorder_come_from_the_zip_as_downloaded(tmp_path: pathlib.Path) -> None:
    folder = tmp_path / "tables"
    folder.mkdir()
    long_tables(folder)
    archive = pathlib.Path(shutil.make_archive(str(tmp_path / "CISS_2020"), "zip", folder))
    records = pydeltav.ciss.records(archive, 7, 1)
    assert records == pydeltav.ciss.records(folder, 7, 1)
    assert [sorted(record) for record in records] == [["pre_crash"], ["pre_crash", "pulse"]]
    # 888 rev/min is a number, and no code.
    assert "1050,0.0,888" in records[0]["pre_crash"]["text"]
    vehicles = {"vehicle1": {"recorder": {"records": records}}, "vehicle2": {"fixed": True}}
    [found, _] = pydeltav.Case.from_dict(vehicles).recorder()["vehicles"]
    stored = [one["speed_at_impact"]["stored"] * 3.6 for one in (found, *found["other_records"])]
    assert sorted(round(speed) for speed in stored) == [33, 52]
    with pytest.raises(ValueError, match="vehicle 3 in crash 7 has no record"):
        pydeltav.ciss.records(folder, 7, 3)
