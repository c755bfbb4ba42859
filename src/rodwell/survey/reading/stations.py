"""From a table to the stations of its wells: units, numbers, missing values, with the line of each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.units import in_unit_of
from rodwell.survey.reading.azimuths import some, without_gaps
from rodwell.survey.reading.check import Written, check_stations
from rodwell.survey.reading.header import CALLED, NEEDED, Header
from rodwell.survey.reading.names import SPELT, unit_word
from rodwell.survey.reading.numbers import Found, decimal_mark, is_missing, is_number, number
from rodwell.survey.reading.tables import Cell, RawTable, Row, listed, shown

UNITS = {"md": "m", "inclination": "degree", "azimuth": "degree", "force": "N"}
OPTIONS = {"md": "--depth-unit", "inclination": "--angle-unit", "azimuth": "--angle-unit", "force": "--force-unit"}
SHORT = {"degree": "deg", "radian": "rad"}

MOST_STATIONS = 100_000


@dataclass(frozen=True)
class Stations:
    """The stations of one well in m, degrees and N; what its file is called, its unit of depth, what must be told."""

    well: str
    source: str
    values: dict[str, FloatArray]
    depth_unit: str
    ignored: tuple[str, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Reading:
    """How the cells of a table are read."""

    table: RawTable
    header: Header
    units: dict[str, str]
    factors: dict[str, float]
    mark: str
    angle_said: bool = True

    def found(self, row: Row, kind: str) -> Found:
        """A cell with where it stands."""
        number_, cells = row
        i = self.header.columns[kind]
        return self.table.at(number_), shown(self.header.names[i]), cells[i]

    def value(self, row: Row, kind: str) -> float:
        """The number in a cell in m, degrees or N; NaN if it is missing."""
        cell = row[1][self.header.columns[kind]]
        if is_missing(cell, kind, self.table.declared.null):
            return math.nan
        value = number(cell, self.mark)
        if value is None:
            where, column, _ = self.found(row, kind)
            raise InputError(f"{where}, {column}", shown(cell), "is not a number")
        if not math.isfinite(value) or not math.isfinite(value * self.factors[kind]):
            where, column, _ = self.found(row, kind)
            raise InputError(f"{where}, {column}", shown(cell), "must be finite")
        return value * self.factors[kind]


def body_of(table: RawTable, header: Header) -> tuple[list[Row], dict[str, str]]:
    """Rows below the header, each as long as its columns need, and the units of a line of units.

    Raises
    ------
    InputError
        If a row is too short, or has numbers that no name stands above.
    """
    rows = table.rows[header.index + header.depth :]
    units = _unit_row(header, rows[0][1]) if rows else {}
    head = table.rows[header.index][1]
    out = []
    for number_, cells in rows[1 if units else 0 :]:
        if header.depth and cells == head:
            continue  # printed again at the top of a page
        if wrong := _misfit(table, header, cells):
            raise InputError(table.at(number_), None, f"has {len(cells)} cells, {wrong}")
        out.append((number_, [*cells, *[""] * (len(header.names) - len(cells))]))
    return out, units


def _unit_row(header: Header, cells: list[Cell]) -> dict[str, str]:
    """Units by column, if the row below the header holds nothing but units in the columns that are used."""
    used = {kind: i for kind, i in header.columns.items() if kind != "well" and i < len(cells)}
    found = {kind: unit_word(kind, cells[i]) for kind, i in used.items()}
    blank = [kind for kind, i in used.items() if isinstance(cells[i], str) and not str(cells[i]).strip(" -")]
    if any(is_number(cell) for cell in cells) or not all(found[kind] or kind in blank for kind in used):
        return {}
    return {kind: unit for kind, unit in found.items() if unit}


def _misfit(table: RawTable, header: Header, cells: list[Cell]) -> str:
    """Why a row does not fit its header; "" if it does."""
    width, names = len(header.names), listed(header.names)
    if table.separator in (" ", "  ") and len(cells) != width:
        return (f"and the header {width} names: {names}; separate columns by tabs or semicolons, or put names of "
                "several words and empty cells in quotes")  # fmt: skip
    if table.separator == "," and any(is_number(cell) for cell in cells[width:]):
        return (f"and the header names {width}: are there decimal commas? Separate cells by semicolons, or write "
                "decimal points")  # fmt: skip
    if table.separator and len(cells) <= max(header.columns.values()):
        return f"fewer than the header names: {names}; begin a remark with #"
    return ""


def reading_of(
    table: RawTable, header: Header, body: Sequence[Row], below: Mapping[str, str], given: Mapping[str, str | None],
    decimal: str | None,
) -> Reading:  # fmt: skip
    """Units and decimal mark of a table.

    Raises
    ------
    InputError
        If a unit is unknown or missing, or numbers contradict each other.
    """
    for kind, text in given.items():
        if text and kind not in header.columns and kind != "azimuth":
            what = f"is given, but there is no column of {CALLED[kind]}; columns found: {listed(header.names)}"
            raise InputError(OPTIONS[kind], text, what)
    kinds = ("inclination", "azimuth")
    said = any(below.get(k) or header.units.get(k) or given.get(k) or table.declared.angle_unit for k in kinds)
    units, factors = {}, {}
    for kind in header.columns:
        if kind != "well":
            units[kind] = _unit(table, kind, below.get(kind) or header.units.get(kind), given.get(kind))
            factors[kind] = in_unit_of(1.0, units[kind], UNITS[kind])
    plain = Reading(table, header, units, factors, ".", said)
    texts = (str(row[1][header.columns[kind]]) for row in body for kind in units)
    if decimal is not None or any("," in text or text.count(".") > 1 for text in texts):
        cells = ((kind, plain.found(row, kind)) for row in body for kind in units)
        return replace(plain, mark=decimal_mark(cells, decimal))
    return plain


def _unit(table: RawTable, kind: str, named: str | None, given: str | None) -> str:
    """The unit of a column; angles are in degrees unless something else is said."""
    declared = {"md": table.declared.depth_unit, "force": ""}.get(kind, table.declared.angle_unit)
    for text in (given, named, declared):
        if text:
            unit = text if text is declared and text in UNITS.values() else SPELT[kind].get(text.lower())
            unit = "radian" if text == "radian" and kind != "md" else unit
            if unit is None:
                allowed = ", ".join(sorted(set(SPELT[kind])))
                name = OPTIONS[kind] if text is given else f"{table.name}, unit of {kind}"
                raise InputError(name, text, f"is not a unit known here; allowed are {allowed}")
            return unit
    if UNITS[kind] == "degree":
        return "degree"
    example = {"md": "MD [m] or MD [ft]", "force": "Force [kN] or Force [lbf]"}[kind]
    raise InputError(table.name, None, f"the unit of {kind} is not known: write it in the header, {example}, "
                     f"or give {OPTIONS[kind]}")  # fmt: skip


def wells_of(table: RawTable, header: Header, body: Sequence[Row]) -> dict[str, list[Row]]:
    """Rows by well, in the order of the file; an empty cell below a name means the same well."""
    if "well" not in header.columns:
        return {table.declared.well: list(body)}
    out: dict[str, list[Row]] = {}
    name = table.declared.well
    for row in body:
        cell = row[1][header.columns["well"]]
        name = shown(cell).strip() or name
        out.setdefault(name, []).append(row)
    return out


def stations_of(reading: Reading, well: str, rows: Sequence[Row], several: bool) -> Stations:
    """Stations of one well; those without depth or inclination are left out, and that is told.

    Raises
    ------
    InputError
        Naming the line and the column, what is allowed, and what to do.
    """
    table, header = reading.table, reading.header
    source = f"{table.name}, well {well}" if several else table.name
    if len(rows) > MOST_STATIONS:
        raise InputError(source, None, f"holds {len(rows)} stations; at most {MOST_STATIONS} are read")
    kept, notes = [], list(header.notes)
    values: dict[str, list[float]] = {kind: [] for kind in reading.units}
    lacking: dict[str, list[str]] = {}
    for row in rows:
        read = {kind: reading.value(row, kind) for kind in reading.units}
        lost = [kind for kind in NEEDED if math.isnan(read[kind])]
        if lost:
            column = shown(header.names[header.columns[lost[0]]])
            lacking.setdefault(column, []).append(f"{table.line} {row[0]}")
            continue
        kept.append(row)
        for kind, value in read.items():
            values[kind].append(value)
    left_out = [f"{len(lines)} of {len(rows)} stations are left out, {column} is missing: {some(len(lines), lines)}"
                for column, lines in lacking.items()]  # fmt: skip
    if len(kept) < 2:
        why = "".join(f"; {text}" for text in left_out)
        raise InputError(source, None, f"holds fewer than two stations below its header{why}")
    notes += [f"{text}." for text in left_out]
    wheres = [f"{table.line} {number_}" for number_, _ in kept]
    arrays = {kind: np.array(listed_) for kind, listed_ in values.items()}
    if np.all(np.diff(arrays["md"]) < 0.0):
        arrays = {kind: array[::-1].copy() for kind, array in arrays.items()}
        wheres.reverse()
        notes.append("Stations stand from the bottom up in the file, and were turned round.")
    if "force" in arrays and (gaps := np.flatnonzero(np.isnan(arrays["force"]))).size:
        what = (f"is missing at {some(gaps.size, [wheres[i] for i in gaps[:6]])}: fill it in, or leave the column "
                "aside with --column force=none")  # fmt: skip
        raise InputError(f"{source}, force", None, what)
    full = [f"{table.name}, {where}" for where in wheres]
    depth, angle = reading.units["md"], reading.units["inclination"]
    written = Written(depth, reading.factors["md"], SHORT[angle], reading.factors["inclination"])
    gone = np.nan_to_num(arrays["azimuth"]).tolist() if "azimuth" in arrays else None
    check_stations(arrays["md"].tolist(), arrays["inclination"].tolist(), gone, full, written)
    notes += list(_about_azimuths(source, arrays, wheres))
    if not reading.angle_said and _like_radians(arrays):
        notes.append("Angles are taken to be in degrees; if they are in radians, give --angle-unit rad.")
    return Stations(well, source if several else table.name, arrays, depth, header.ignored, tuple(notes))


def _about_azimuths(source: str, arrays: dict[str, FloatArray], wheres: list[str]) -> Iterator[str]:
    """Fill gaps of azimuths, in place; what must be told of it."""
    if "azimuth" not in arrays:
        yield "There is no column of azimuths: the well is taken to lie in one vertical plane."
        return
    filled, notes = without_gaps(source, arrays["md"], arrays["inclination"], arrays.pop("azimuth"), wheres)
    if filled is not None:
        arrays["azimuth"] = filled
    yield from notes


def _like_radians(arrays: dict[str, FloatArray]) -> bool:
    """Whether angles without a unit may be radians: none above a right angle, or a full turn, and yet not nothing."""
    steepest, widest = float(np.max(arrays["inclination"])), float(np.max(np.abs(arrays.get("azimuth", [1.0]))))
    return 0.1 < steepest < 0.55 * math.pi and 0.0 < widest <= 2.0 * math.pi
