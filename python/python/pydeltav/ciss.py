"""Real crashes with a recorder: from NHTSA's tables to pairs of vehicles, and from these to ΔV with intervals.

The Crash Investigation Sampling System (CISS) of the U.S. National Highway Traffic Safety Administration publishes
a folder of tables a year, as SAS files and as CSV. ``pairs`` makes of it one table of the crashes that ``judge``
holds against their recorders, and ``case`` makes a case of one of them. ``deltav validate --field`` makes the same
table of the same CSV files; the rules are in the engine.

>>> pairs = pydeltav.ciss.pairs(folder)
>>> pairs
<pydeltav.ciss.Pairs: 3 pairs of vehicles>
>>> case = pydeltav.ciss.case(pairs[0])
>>> case.title
'Crash 1 of 2017, event 1'

The tables, and what was checked of them, are in the README of the package.
"""

import csv
import io
import json
import os
import pathlib
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, overload

from pydeltav import _pydeltav
from pydeltav._pydeltav import Case, Drawing
from pydeltav._record import Record
from pydeltav.results import _Coverage

__all__ = ["Coverage", "Pairs", "case", "judge", "pairs", "read", "records"]

_Cell = int | float | str | None
_Row = dict[str, _Cell]

# Names and kinds of cells, in the order of the table of pairs.
_COLUMNS = _pydeltav._ciss_columns()
_NAMES = [name for name, _ in _COLUMNS]


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
    >>> pairs = pydeltav.ciss.pairs(folder)
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
            If it cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp(), "pairs.csv")
        >>> pydeltav.ciss.pairs(folder).save(path)
        >>> pydeltav.ciss.read(path) == pydeltav.ciss.pairs(folder)
        True
        """
        pathlib.Path(path).write_text(_as_csv(self._rows), encoding="utf-8", newline="")

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        columns = [[row[name] for row in self._rows] for name in _NAMES]
        rows = _pydeltav._columns_of_pairs([(*of, cells) for of, cells in zip(_COLUMNS, columns, strict=True)])
        return rows.__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        return f"<pydeltav.ciss.Pairs: {len(self)} pairs of vehicles>"

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
            For an unknown drawing.

        Examples
        --------
        >>> coverage.draw("ranks").svg()[:4]
        '<svg'
        """
        return self._judged.draw(what)  # type: ignore[no-any-return]

    def __str__(self) -> str:
        return self._judged.text()  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return f"<pydeltav.ciss.Coverage: {len(self.judged)} recorders>"

    def _repr_html_(self) -> str:
        return self._judged.html() + self.draw()._repr_html_()  # type: ignore[no-any-return]

    def __reduce__(self) -> tuple[Any, ...]:
        return (Coverage, (self._judged,))


def pairs(source: str | os.PathLike[str]) -> Pairs:
    """Makes pairs of vehicles of NHTSA's tables of a year, as downloaded: a folder, or the ZIP file itself.

    It reads CRASH, GV, CDC and EDREVENT of CISS, from files of CSV or of SAS (``.sas7bdat``), CSV first where there
    are both; upper and lower case of names do not matter. A pair are two vehicles with damage by one event that
    each name the other as what they struck (OBJCONT), in the order of crash, event and vehicle. It is kept where
    the damage of both is on front, back, left or right with all of C1 to C6, a length and a PDOF, where both have
    a curb weight, and where a recorder of one has a ΔV of this event (CDCEVENT): of several records the one with
    the largest. ``Pairs.left_out`` counts the others. NHTSA's codes for
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
        If a table or a column is missing; the text says what there is instead.

    Examples
    --------
    >>> pydeltav.ciss.pairs(folder)
    <pydeltav.ciss.Pairs: 3 pairs of vehicles>
    """
    rows, left_out = _pydeltav._ciss_pairs(str(source), *_files(pathlib.Path(source)))
    return Pairs(_named(rows), left_out)


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
        If it is not such a file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp(), "pairs.csv")
    >>> pydeltav.ciss.pairs(folder).save(path)
    >>> len(pydeltav.ciss.read(path))
    3
    """
    return Pairs(_named(_pydeltav._read_pairs(str(path), pathlib.Path(path).read_bytes())))


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
        If a cell of the pair is not a number, or the recorder has none.

    Examples
    --------
    >>> pair = pydeltav.ciss.pairs(folder)[0]
    >>> text = pydeltav.ciss.case(pair).text
    >>> "[vehicle1.crush]" in text, "recorder" in text
    (True, False)
    """
    name = f"Crash {pair.get('CASEID')} of {pair.get('YEAR')}, event {pair.get('EVENTNO')}"
    return _pydeltav._case_of_pair(_as_csv([pair]), name, recorder)


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
        If a table or a column is missing, or the vehicle has no record.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> tables = pathlib.Path(tempfile.mkdtemp())
    >>> head = "CASEID,VEHNO,EDREVENTNO,PCODE,PTIME,PVALUE"
    >>> rows = "7,1,1,1010,-1,58\\n7,1,1,1010,0,58"
    >>> _ = (tables / "EDRPRECRASH.csv").write_text(f"{head}\\n{rows}")
    >>> _ = (tables / "EDRPOSTCRASH.csv").write_text(head)
    >>> [record] = pydeltav.ciss.records(tables, crash=7, vehicle=1)
    >>> case = pydeltav.Case.from_dict({"vehicle1": {"recorder": record}, "vehicle2": {"fixed": True}})
    >>> print(f"{case.recorder()['vehicles'][0]['speed_at_impact']['stored'] * 3.6:.0f} km/h")
    58 km/h
    """
    found = _pydeltav._ciss_records(str(source), *_files(pathlib.Path(source)), crash, vehicle)
    return [{name: {"text": text} for name, text in record.items()} for record in found]


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
        By default one for each processor. The bits do not depend on it.

    Returns
    -------
    Coverage
        In SI units.

    Raises
    ------
    ValueError
        If a pair is wrong, or there is none.

    Examples
    --------
    >>> coverage = pydeltav.ciss.judge(pydeltav.ciss.pairs(folder)[:1])
    >>> [judged] = [judged for judged in coverage.judged if judged.vehicle == 1]
    >>> judged.interval95[0] < judged.median < judged.interval95[1]
    True
    """
    return Coverage(_pydeltav._judge_pairs(_as_csv(pairs), other, prior, particles, seed, threads))


def _named(rows: Iterable[Sequence[_Cell]]) -> Iterator[_Row]:
    return (dict(zip(_NAMES, row, strict=True)) for row in rows)


def _as_csv(rows: Iterable[Mapping[str, _Cell]]) -> str:
    lines = io.StringIO()
    writer = csv.DictWriter(lines, _NAMES, extrasaction="ignore", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return lines.getvalue()


def _files(source: pathlib.Path) -> tuple[list[str], Callable[[int], bytes]]:
    """The names of the files of a folder or a ZIP file, those of folders with / at the end, and what reads one."""
    if source.is_dir():
        entries = sorted(source.iterdir())
        names = [entry.name + "/" * entry.is_dir() for entry in entries]
        return names, lambda place: entries[place].read_bytes()
    if not source.exists():
        raise FileNotFoundError(f"there is no folder {source}: give that of NHTSA's tables, or their ZIP file")
    if not zipfile.is_zipfile(source):
        raise ValueError(f"{source} is neither a folder nor a ZIP file: give that of NHTSA's tables")

    def read(place: int) -> bytes:
        with zipfile.ZipFile(source) as archive:
            return archive.read(members[place])

    with zipfile.ZipFile(source) as archive:
        members = sorted(archive.namelist())
    return members, read
