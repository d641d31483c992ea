"""Real crashes with a recorder: from NHTSA's tables to pairs of vehicles, and from these to ΔV with intervals.

The Crash Investigation Sampling System (CISS) of the U.S. National Highway Traffic Safety Administration publishes
a folder of tables a year, as SAS files and as CSV. ``pairs`` makes of it one table of the crashes that ``judge``
and ``deltav validate --field`` hold against their recorders, and ``case`` makes a case of one of them.

>>> pairs = deltav.ciss.pairs(folder)
>>> pairs
<deltav.ciss.Pairs: 3 pairs of vehicles>
>>> case = deltav.ciss.case(pairs[0])
>>> case.title
'Crash 1 of 2017, event 1'

The tables, and what was checked of them, are in the README of the package.
"""

import csv
import io
import json
import math
import os
import pathlib
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, NoReturn, overload

from deltav import _deltav
from deltav._deltav import Case, Drawing
from deltav._record import Record
from deltav.results import _Coverage

__all__ = ["Coverage", "Pairs", "case", "judge", "pairs", "read", "records"]

_Cell = int | float | str | None
_Row = dict[str, _Cell]

_KEYS = ("YEAR", "CASEID", "EVENTNO")
# Of each vehicle, in the order of the table of pairs.
_OF_GV = ("MAKE", "MODEL", "MODELYR", "BODYTYPE", "CURBWT", "CARGOWT", "DVANGTHIS")
_CRUSH = ("C1", "C2", "C3", "C4", "C5", "C6")
_OF_CDC = ("CDCPLANE", "CDC", "PDOF", "HEADINGANG", "FIELDL", "FIELDLD", "DIRECTL", "DIRECTD", *_CRUSH, "CMAX")
_WINSMASH = ("DVTOTAL", "DVLONG", "DVLAT", "DVENERGY")
_RECORDER = ("MAXDVLONG", "MAXDVLAT")
_OF_VEHICLE = (
    ("VEHNO", *_OF_GV[:-1], "CDCPLANE", "CDC", "PDOF", "HEADINGANG", "DVANGTHIS")
    + ("FIELDL", "FIELDLD", "DIRECTL", "DIRECTD", *_CRUSH, "CMAX", *_WINSMASH, *_RECORDER)
)
_NAMES = [*_KEYS, *(f"{name}_{vehicle}" for vehicle in (1, 2) for name in _OF_VEHICLE)]

# The tables that are read, the columns that each must have, and those that it may have.
_TABLES: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "CRASH": (("CASEID", "CRASHYEAR"), ()),
    "GV": (("CASEID", "VEHNO", *_OF_GV), ()),
    "CDC": (("CASEID", "EVENTNO", "VEHNO", *_OF_CDC, *_WINSMASH), ("OBJCONT",)),
    "EDREVENT": (("CASEID", "VEHNO", "CDCEVENT", *_RECORDER), ()),
}
# The long tables of recorders, the keys of a case that take them, and the codes without which those have nothing.
_LONG = {"EDRPRECRASH": ("pre_crash", {1010}), "EDRPOSTCRASH": ("pulse", {2010, 2020})}
_OF_VALUE = ("PCODE", "PTIME", "PVALUE")
_ENDINGS = (".csv", ".sas7bdat")
# A value of a recorder is kept as it is: the case file knows the codes of each quantity.
_TEXTS = {"CDCPLANE", "CDC", "PTIME", "PVALUE"}
_ANGLES = {"PDOF", "HEADINGANG", "DVANGTHIS"}
# Numbers that are codes or counted: what is not known is a code among others.
_CODES = {"YEAR", "CRASHYEAR", "CASEID", "EVENTNO", "VEHNO", "CDCEVENT", "OBJCONT", "VEHNUM"} | {
    "MAKE",
    "MODEL",
    "BODYTYPE",
    "EDRSUMMNO",
    "EDREVENTNO",
    "PCODE",
}
_MISSING = {
    float(code)
    for digits in range(3, 8)
    for code in (int("8" * digits), *range(10**digits - 5, 10**digits))
}


class Pairs(Sequence[_Row]):
    """Pairs of vehicles that collided: a row is a crash, a dict with NHTSA's names and ``_1`` and ``_2``.

    It speaks Arrow: ``polars.DataFrame(pairs)``, ``pyarrow.table(pairs)`` and
    ``pandas.DataFrame.from_arrow(pairs)`` take it as it is. ``save`` writes what ``deltav validate --field`` reads.
    ``left_out`` says how many pairs the tables have that are not here, and why.

    Parameters
    ----------
    rows : iterable of Mapping
        A pair each, with NHTSA's names and units: cm, kg, km/h and degrees.
    left_out : Mapping, optional
        Numbers of pairs that are left out, by why.

    Examples
    --------
    >>> pairs = deltav.ciss.pairs(folder)
    >>> len(pairs), pairs[:1][0]["CASEID"]
    (3, 1)
    """

    def __init__(self, rows: Iterable[Mapping[str, _Cell]], left_out: Mapping[str, int] | None = None) -> None:
        self._rows = [{name: row.get(name) for name in _NAMES} for row in rows]
        self.left_out: dict[str, int] = dict(left_out or {})

    @property
    def names(self) -> list[str]:
        """The names of the columns."""
        return list(_NAMES)

    @overload
    def __getitem__(self, place: int) -> _Row: ...
    @overload
    def __getitem__(self, place: slice) -> "Pairs": ...
    def __getitem__(self, place: int | slice) -> "_Row | Pairs":
        if isinstance(place, slice):
            return Pairs(self._rows[place])
        return dict(self._rows[place])

    def __len__(self) -> int:
        return len(self._rows)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Pairs) and self._rows == other._rows

    __hash__ = None  # type: ignore[assignment]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes them as CSV, for ``deltav validate --field``.

        Parameters
        ----------
        path : str or os.PathLike
            The file.

        Raises
        ------
        OSError
            Where it cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp(), "pairs.csv")
        >>> deltav.ciss.pairs(folder).save(path)
        >>> deltav.ciss.read(path) == deltav.ciss.pairs(folder)
        True
        """
        pathlib.Path(path).write_text(_as_csv(self._rows), encoding="utf-8", newline="")

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        columns = [[row[name] for row in self._rows] for name in _NAMES]
        kinds = [_kind(name) for name in _NAMES]
        rows = _deltav._columns_of_pairs(list(zip(_NAMES, kinds, columns, strict=True)))
        return rows.__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        return f"<deltav.ciss.Pairs: {len(self)} pairs of vehicles>"

    def _repr_html_(self) -> str:
        cells = [("", len(self), "pairs"), *(("left out: ", count, why) for why, count in self.left_out.items())]
        return "<ul>" + "".join(f"<li>{of}{count} {why}</li>" for of, count, why in cells) + "</ul>"


class Coverage(_Coverage, Record):
    """How often intervals of ΔV contain what recorders stored: the document of ``deltav validate --field``.

    Its keys are attributes, in SI units: ``judged`` has a vehicle an entry, with ``recorder``, ``median`` and
    ``interval95``; ``groups`` has figures by kind of collision, ``groups["all"].coverage["95"]`` among them.
    ``judge`` makes it.

    Parameters
    ----------
    judged
        What the engine has found.

    Examples
    --------
    >>> coverage.groups["all"].n == len(coverage.judged)
    True
    """

    __slots__ = ("_judged",)
    _judged: Any

    def __init__(self, judged: Any) -> None:
        object.__setattr__(self, "_judged", judged)
        super().__init__(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """The JSON document of the program as a dict.

        Returns
        -------
        dict
            In SI units; a new one at each call.

        Examples
        --------
        >>> coverage.to_dict()["pairs"]
        1
        """
        return json.loads(self._judged.json())  # type: ignore[no-any-return]

    def draw(self, what: Literal["estimates", "ranks"] = "estimates") -> Drawing:
        """A drawing: estimates against recorders, or the ranks of the recorders among what was expected.

        Parameters
        ----------
        what : {"estimates", "ranks"}
            What to draw.

        Returns
        -------
        Drawing

        Raises
        ------
        ValueError
            For a drawing that there is not.

        Examples
        --------
        >>> coverage.draw("ranks").svg()[:4]
        '<svg'
        """
        return self._judged.draw(what)  # type: ignore[no-any-return]

    def __str__(self) -> str:
        return self._judged.text()  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return f"<deltav.ciss.Coverage: {len(self.judged)} recorders>"

    def _repr_html_(self) -> str:
        return self._judged.html() + self.draw()._repr_html_()  # type: ignore[no-any-return]

    def __reduce__(self) -> tuple[Any, ...]:
        return (Coverage, (self._judged,))


def pairs(source: str | os.PathLike[str]) -> Pairs:
    """Makes pairs of vehicles of NHTSA's tables of a year, as downloaded: a folder, or the ZIP file itself.

    It reads CRASH, GV, CDC and EDREVENT of CISS, from files of CSV or of SAS (``.sas7bdat``; with
    ``pip install pyreadstat``), CSV first where there are both; upper and lower case of names do not matter. A pair are two
    vehicles with damage by one event that each name the other as what they struck (OBJCONT), in the order of
    crash, event and vehicle. It is kept where the damage of both is on front, back, left or right with all of C1
    to C6, a length and a PDOF, where both have a curb weight, and where a recorder of one has a ΔV of this event
    (CDCEVENT): of several records the one with the largest. ``Pairs.left_out`` counts the others. NHTSA's codes for
    what is not known are left empty.

    Parameters
    ----------
    source : str or os.PathLike
        The folder or the ZIP file.

    Returns
    -------
    Pairs
        In NHTSA's units: cm, kg, km/h and degrees.

    Raises
    ------
    ValueError
        Where a table or a column is missing; the text says what there is instead.
    ImportError
        Where the tables are of SAS, and pyreadstat is not installed.

    Examples
    --------
    >>> deltav.ciss.pairs(folder)
    <deltav.ciss.Pairs: 3 pairs of vehicles>
    """
    tables = {name: _table(source, name, *columns) for name, columns in _TABLES.items()}
    years = _by_key(tables["CRASH"], "CRASH", ("CASEID",))
    vehicles = _by_key(tables["GV"], "GV", ("CASEID", "VEHNO"))
    struck = _struck(source, tables["CDC"])
    damages: dict[tuple[_Cell, ...], dict[_Cell, list[_Row]]] = {}
    for row in tables["CDC"]:
        of_event = damages.setdefault((row["CASEID"], row["EVENTNO"]), {})
        of_event.setdefault(row["VEHNO"], []).append(row)
    recorders = _recorders(tables["EDREVENT"])

    kept: list[_Row] = []
    left_out: dict[str, int] = {}
    for (crash, event), by_vehicle in sorted(damages.items(), key=lambda entry: _order(entry[0])):
        for one, two in _couples(by_vehicle, lambda vehicle, other: struck((crash, event), vehicle, other)):
            both = [by_vehicle[vehicle] for vehicle in (one, two)]
            general = [vehicles.get((crash, vehicle)) for vehicle in (one, two)]
            stored = [recorders.get((crash, vehicle, event), {}) for vehicle in (one, two)]
            why = _why_not(both, general, stored)
            if why is not None:
                left_out[why] = left_out.get(why, 0) + 1
                continue
            if (crash,) not in years:
                raise ValueError(f"{source}: the table CRASH has no row of crash {crash}, which CDC has")
            pair: _Row = {"YEAR": years[(crash,)]["CRASHYEAR"], "CASEID": crash, "EVENTNO": event}
            for place, (damage, of_vehicle, recorder) in enumerate(zip(both, general, stored, strict=True), 1):
                known = {**(of_vehicle or {}), **damage[0], **recorder}
                pair |= {f"{name}_{place}": known.get(name) for name in _OF_VEHICLE}
            kept.append(pair)
    return Pairs(kept, left_out)


def read(path: str | os.PathLike[str]) -> Pairs:
    """Reads pairs that ``Pairs.save`` wrote.

    Parameters
    ----------
    path : str or os.PathLike
        The file.

    Returns
    -------
    Pairs

    Raises
    ------
    ValueError
        Where it is another file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp(), "pairs.csv")
    >>> deltav.ciss.pairs(folder).save(path)
    >>> len(deltav.ciss.read(path))
    3
    """
    text = _decoded(pathlib.Path(path).read_bytes())
    rows = list(csv.DictReader(io.StringIO(text)))
    if rows and (missing := [name for name in _NAMES if name not in rows[0]]):
        raise ValueError(f"{path}: there is no column {missing[0]}; give a file that Pairs.save wrote")
    cells = [
        {name: _cell(_of(name), row[name], f"{path}, line {line}") for name in _NAMES}
        for line, row in enumerate(rows, 2)
    ]
    return Pairs(cells)


def case(pair: Mapping[str, _Cell], *, recorder: Literal[1, 2] | None = None) -> Case:
    """Makes a case of a pair, with both speeds unknown: for ``estimate()``, or to be looked at and changed.

    What it says of the collision is what ``judge`` assumes of it: ``docs/calibration.md`` has the model. No
    recorder is evidence, so that ΔV can be held against it; with ``recorder=2`` that of vehicle 2 is.

    Parameters
    ----------
    pair : Mapping
        An element of ``Pairs``.
    recorder : {1, 2}, optional
        The vehicle whose recorder is evidence.

    Returns
    -------
    Case

    Raises
    ------
    ValueError
        Where a cell of the pair is no number, or the recorder has none.

    Examples
    --------
    >>> pair = deltav.ciss.pairs(folder)[0]
    >>> text = deltav.ciss.case(pair).text
    >>> "[vehicle1.crush]" in text, "recorder" in text
    (True, False)
    """
    name = f"Crash {pair.get('CASEID')} of {pair.get('YEAR')}, event {pair.get('EVENTNO')}"
    return _deltav._case_of_pair(_as_csv([pair]), name, recorder)


def records(source: str | os.PathLike[str], crash: int, vehicle: int) -> list[dict[str, dict[str, str]]]:
    """The records of the recorder of a vehicle, for ``records`` of ``recorder`` in a case.

    It reads the long tables EDRPRECRASH and EDRPOSTCRASH of NHTSA's tables of a year, as downloaded: a folder, or
    the ZIP file itself. A record is an event of the recorder (EDRSUMMNO, EDREVENTNO); one without a speed and
    without a ΔV is left out.

    Parameters
    ----------
    source : str or os.PathLike
        The folder or the ZIP file.
    crash : int
        CASEID.
    vehicle : int
        VEHNO.

    Returns
    -------
    list of dict
        In the order of the recorder's numbers, which need not be that of time: ``{"pre_crash": {"text": ...},
        "pulse": {"text": ...}}``, the one or the other where there is one.

    Raises
    ------
    ValueError
        Where a table or a column is missing, or the vehicle has no record.
    ImportError
        Where the tables are of SAS, and pyreadstat is not installed.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> tables = pathlib.Path(tempfile.mkdtemp())
    >>> head = "CASEID,VEHNO,EDREVENTNO,PCODE,PTIME,PVALUE"
    >>> rows = "7,1,1,1010,-1,58\\n7,1,1,1010,0,58"
    >>> _ = (tables / "EDRPRECRASH.csv").write_text(f"{head}\\n{rows}")
    >>> _ = (tables / "EDRPOSTCRASH.csv").write_text(head)
    >>> [record] = deltav.ciss.records(tables, crash=7, vehicle=1)
    >>> case = deltav.Case.from_dict({"vehicle1": {"recorder": record}, "vehicle2": {"fixed": True}})
    >>> print(f"{case.recorder()['vehicles'][0]['speed_at_impact']['stored'] * 3.6:.0f} km/h")
    58 km/h
    """
    found: dict[tuple[float, ...], dict[str, dict[str, str]]] = {}
    for table, (key, codes) in _LONG.items():
        wanted = ("CASEID", "VEHNO", "EDREVENTNO", *_OF_VALUE)
        of_record: dict[tuple[float, ...], list[_Row]] = {}
        for row in _table(source, table, wanted, ("EDRSUMMNO",)):
            if (row["CASEID"], row["VEHNO"]) == (crash, vehicle):
                number = _order((row.get("EDRSUMMNO"), row["EDREVENTNO"]))
                of_record.setdefault(number, []).append(row)
        for number, rows in of_record.items():
            if any(row["PCODE"] in codes for row in rows):
                lines = [",".join("" if row[name] is None else str(row[name]) for name in _OF_VALUE) for row in rows]
                found.setdefault(number, {})[key] = {"text": "\n".join([",".join(_OF_VALUE), *lines])}
    if not found:
        raise ValueError(f"{source}: the recorder of vehicle {vehicle} in crash {crash} has no record with a speed or a ΔV")
    return [found[number] for number in sorted(found)]


def judge(
    pairs: Iterable[Mapping[str, _Cell]],
    *,
    other: bool = False,
    prior: Literal["field", "serious-injury"] = "field",
    particles: int = 128,
    seed: int = 1,
    threads: int | None = None,
) -> Coverage:
    """Estimates the ΔV of each vehicle with a recorder from all but that recorder, and holds it against it.

    It is ``deltav validate --field``, with the same bits. An interval is of what the recorder is expected to
    store, with its own error; ``other=True`` gives the recorder of one vehicle and judges the other. A vehicle
    takes some hundred milliseconds; 128 particles are those of the program.

    Parameters
    ----------
    pairs : iterable of Mapping
        ``Pairs``, or some of them.
    other : bool
        Whether the recorder of the other vehicle is evidence.
    prior : {"field", "serious-injury"}
        How severe such crashes are before the evidence: as those after which a vehicle was towed, or as those
        of them in which somebody was seriously hurt, as in CIREN.
    particles : int
        (–) of each of 16 islands, a multiple of 128.
    seed : int
        (–) of the random numbers; the same seed gives the same bits.
    threads : int, optional
        Without it one for each processor. The bits do not depend on it.

    Returns
    -------
    Coverage
        In SI units.

    Raises
    ------
    ValueError
        Where a pair is wrong, or there is none.

    Examples
    --------
    >>> coverage = deltav.ciss.judge(deltav.ciss.pairs(folder)[:1])
    >>> [judged] = [judged for judged in coverage.judged if judged.vehicle == 1]
    >>> judged.interval95[0] < judged.median < judged.interval95[1]
    True
    """
    return Coverage(_deltav._judge_pairs(_as_csv(pairs), other, prior, particles, seed, threads))


def _kind(name: str) -> str:
    """What a column of pairs holds."""
    of = _of(name)
    return "text" if of in _TEXTS else "integer" if of in _CODES else "number"


def _of(name: str) -> str:
    """NHTSA's name of a column of pairs."""
    return name if name in _KEYS else name[:-2]


def _as_csv(rows: Iterable[Mapping[str, _Cell]]) -> str:
    lines = io.StringIO()
    writer = csv.DictWriter(lines, _NAMES, extrasaction="ignore", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return lines.getvalue()


def _decoded(content: bytes) -> str:
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Names of makes and places are in Latin-1 in some years.
        return content.decode("latin-1")


def _order(key: tuple[_Cell, ...]) -> tuple[float, ...]:
    return tuple(float(part or 0) for part in key)


def _cell(name: str, given: Any, where: str) -> _Cell:
    """A cell without NHTSA's codes for what is not known."""
    if isinstance(given, bytes):
        given = given.decode("latin-1")
    if isinstance(given, str):
        given = given.strip()
    if given is None or given == "" or given == ".":
        return None
    if name in _TEXTS:
        return str(given)
    try:
        number = float(given)
    except ValueError:
        raise ValueError(f"{where}, column {name}: {given!r} is not a number") from None
    if not math.isfinite(number):
        return None
    if name in _CODES:
        if not number.is_integer():
            raise ValueError(f"{where}, column {name}: {given!r} is not a whole number")
        return int(number)
    if abs(number) in _MISSING:
        return None
    if name in _ANGLES and not 0.0 <= number <= 360.0:
        return None
    if name in _RECORDER or not number.is_integer():
        return number
    return int(number)


def _files(source: pathlib.Path) -> list[tuple[str, Callable[[], bytes]]]:
    """The files of a folder or a ZIP file: their names, and how to read each."""
    if source.is_dir():
        return [(path.name, path.read_bytes) for path in sorted(source.iterdir()) if path.is_file()]
    if not source.exists():
        raise FileNotFoundError(f"there is no folder {source}: give that of NHTSA's tables, or their ZIP file")
    if not zipfile.is_zipfile(source):
        raise ValueError(f"{source} is neither a folder nor a ZIP file: give that of NHTSA's tables")

    def reader(name: str) -> Callable[[], bytes]:
        def content() -> bytes:
            with zipfile.ZipFile(source) as archive:
                return archive.read(name)

        return content

    with zipfile.ZipFile(source) as archive:
        members = sorted(name for name in archive.namelist() if not name.endswith("/"))
    return [(pathlib.PurePosixPath(name).name, reader(name)) for name in members]


def _table(source: str | os.PathLike[str], name: str, wanted: Sequence[str], optional: Sequence[str]) -> list[_Row]:
    """The wanted columns of a table, and of the optional ones those that it has."""
    files = _files(pathlib.Path(source))
    for ending in _ENDINGS:
        found = [(file, read) for file, read in files if file.lower() == name.lower() + ending]
        if len(found) > 1:
            raise ValueError(
                f"{source} has the table {name} twice: {found[0][0]} and {found[1][0]}; give the tables of one year"
            )
        if found:
            break
    else:
        _no_table(source, name, [file for file, _ in files])
    file, read = found[0]
    columns = _columns_of(read(), file, f"{source}/{file}")
    by_name = {column.upper(): column for column in columns}
    missing = [column for column in wanted if column not in by_name]
    if missing:
        raise ValueError(
            f"{source}: the table {name} ({file}) has no column {', '.join(missing)}; it has {', '.join(columns)}"
        )
    taken = [column for column in (*wanted, *optional) if column in by_name]
    of = [columns[by_name[column]] for column in taken]
    return [
        {
            column: _cell(column, cell, f"{source}/{file}, row {row}")
            for column, cell in zip(taken, cells, strict=True)
        }
        for row, cells in enumerate(zip(*of, strict=True), 1)
    ]


def _no_table(source: str | os.PathLike[str], name: str, files: list[str]) -> NoReturn:
    stems = {pathlib.PurePath(file).stem.upper() for file in files if file.lower().endswith(_ENDINGS)}
    if {"ACCIDENT", "VE"} <= stems:
        raise ValueError(
            f"{source} has tables of NASS-CDS (ACCIDENT, VE): they have no ΔV of a recorder, so nothing to hold an "
            f"estimate against, and the units of their masses changed over the years. Give a folder of CISS, which "
            f"follows NASS-CDS from 2017"
        )
    path = pathlib.Path(source)
    below = sorted(entry.name for entry in path.iterdir() if entry.is_dir()) if path.is_dir() else []
    has = f"it has {', '.join(sorted(files)[:40])}" if files else "it has no file"
    if below:
        has += f", and the folders {', '.join(below)}: give the one with the tables of a year"
    raise ValueError(f"{source} has no table {name} ({name}.csv or {name.lower()}.sas7bdat); {has}")


def _columns_of(content: bytes, file: str, where: str) -> dict[str, Sequence[Any]]:
    """The columns of a file by name."""
    if file.lower().endswith(".csv"):
        rows = csv.reader(io.StringIO(_decoded(content), newline=""))
        header = [name.strip() for name in next(rows, [])]
        body = [row for row in rows if row]
        for row in body:
            if len(row) != len(header):
                raise ValueError(f"{where}: a row has {len(row)} cells and the header {len(header)}: {row[:3]}")
        return {name: [row[place] for row in body] for place, name in enumerate(header)}
    try:
        import pyreadstat
    except ImportError:
        raise ImportError(
            f"{where} is a SAS file: pip install pyreadstat to read it, or download the tables as CSV"
        ) from None
    columns, _ = pyreadstat.read_sas7bdat(io.BytesIO(content), output_format="dict")
    return {str(name): list(column) for name, column in columns.items()}


def _by_key(rows: list[_Row], table: str, key: tuple[str, ...]) -> dict[tuple[_Cell, ...], _Row]:
    found: dict[tuple[_Cell, ...], _Row] = {}
    for row in rows:
        of_row = tuple(row[name] for name in key)
        if of_row in found:
            said = ", ".join(f"{name} {part}" for name, part in zip(key, of_row, strict=True))
            raise ValueError(f"the table {table} has two rows of {said}: give the tables of one year")
        found[of_row] = row
    return found


def _struck(
    source: str | os.PathLike[str], damages: list[_Row]
) -> Callable[[tuple[_Cell, _Cell], _Cell, _Cell], bool]:
    """Whether a vehicle names another as what it struck in an event: in CDC, or in EVENT."""
    if damages and "OBJCONT" in damages[0]:
        contacts = {(row["CASEID"], row["EVENTNO"], row["VEHNO"], row["OBJCONT"]) for row in damages}
        return lambda event, vehicle, other: (*event, vehicle, other) in contacts
    # A row of EVENT is the contact of both.
    events = _table(source, "EVENT", ("CASEID", "EVENTNO", "VEHNUM", "OBJCONT"), ())
    contacts = {(row["CASEID"], row["EVENTNO"], row["VEHNUM"], row["OBJCONT"]) for row in events}
    contacts |= {(crash, event, other, vehicle) for crash, event, vehicle, other in contacts}
    return lambda event, vehicle, other: (*event, vehicle, other) in contacts


def _couples(vehicles: Iterable[_Cell], names: Callable[[_Cell, _Cell], bool]) -> Iterator[tuple[_Cell, _Cell]]:
    """The vehicles of an event of which each names the other."""
    ordered = sorted(vehicles, key=lambda vehicle: _order((vehicle,)))
    for place, one in enumerate(ordered):
        for two in ordered[place + 1 :]:
            if names(one, two) and names(two, one):
                yield one, two


def _recorders(rows: list[_Row]) -> dict[tuple[_Cell, ...], _Row]:
    """What the recorder of a vehicle stored of an event: of several records the one with the largest ΔV."""
    found: dict[tuple[_Cell, ...], _Row] = {}

    def size(row: _Row) -> float:
        return math.hypot(*(float(row[name] or 0.0) for name in _RECORDER))

    for row in rows:
        if all(row[name] is None for name in _RECORDER):
            continue
        of_row = (row["CASEID"], row["VEHNO"], row["CDCEVENT"])
        if of_row not in found or size(row) > size(found[of_row]):
            found[of_row] = {name: row[name] for name in _RECORDER}
    return found


def _why_not(both: list[list[_Row]], general: list[_Row | None], stored: list[_Row]) -> str | None:
    """Why a pair is not kept, if it is not."""
    if any(len(damage) > 1 for damage in both):
        return "with several damages of one vehicle by the event"
    damages = [damage[0] for damage in both]
    if any(damage["CDCPLANE"] not in ("F", "B", "L", "R") for damage in damages):
        return "without damage to front, back or side of both"
    if any(damage[name] is None for damage in damages for name in _CRUSH) or any(
        damage["FIELDL"] is None and damage["DIRECTL"] is None for damage in damages
    ):
        return "without crush profiles of both"
    if any(damage["PDOF"] is None for damage in damages):
        return "without PDOF of both"
    if any(vehicle is None or not isinstance(mass := vehicle["CURBWT"], int | float) or mass <= 0 for vehicle in general):
        return "without masses of both"
    if not any(stored):
        return "without a recorder's ΔV of this event"
    return None
