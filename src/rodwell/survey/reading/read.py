"""Reading survey files of any kind: text, workbook or LAS; one well, or all of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rodwell.errors import InputError
from rodwell.survey.reading.header import Asked, checked_asked, find_header, sighted
from rodwell.survey.reading.las import is_las, las_table
from rodwell.survey.reading.source import ZIP, read_bytes, text_of
from rodwell.survey.reading.stations import Reading, Stations, body_of, reading_of, stations_of, wells_of
from rodwell.survey.reading.tables import RawTable, Row, shown
from rodwell.survey.reading.text import text_table
from rodwell.survey.reading.workbook import workbook_tables

MOST_WELLS = 1000


@dataclass(frozen=True)
class Options:
    """What users say beside a file: units, columns by meaning, decimal mark ("point", "comma")."""

    depth_unit: str | None = None
    angle_unit: str | None = None
    force_unit: str | None = None
    columns: Mapping[str, str | int] | None = None
    decimal: str | None = None


def read_well(path: Path, options: Options, well: str | None = None) -> Stations:
    """The stations of the only well of a file, or of the one that is named.

    Raises
    ------
    InputError
        Naming line and column, what was found, and what to do; if there are several wells, their names.
    """
    found = _wells(path, options)
    if well is None:
        if len(found) > 1:
            what = f"holds {len(found)} wells: {_names(found)}; pick one with --well NAME, or take --all-wells"
            raise InputError(path.name, None, f"{what} (Python: well=, read_surveys)")
        name = next(iter(found))
    else:
        wanted = " ".join(well.lower().split())
        fitting = [name for name in found if " ".join(name.lower().split()) == wanted]
        if not fitting:
            named = [name for name in found if name]
            what = f"is not in {path.name}; its wells are {_names(found)}" if named else (
                f"is asked for, but {path.name} names no wells")  # fmt: skip
            raise InputError("--well", well, what)
        name = fitting[0]
    reading, rows = found[name]
    return stations_of(reading, name, rows, len(found) > 1)


def read_wells(path: Path, options: Options) -> list[Stations]:
    """The stations of all wells of a file, in its order. Errors as in :func:`read_well`."""
    found = _wells(path, options)
    return [stations_of(reading, name, rows, len(found) > 1) for name, (reading, rows) in found.items()]


def _names(found: Mapping[str, object]) -> str:
    names = [shown(name) for name in found]
    return ", ".join(names[:20]) + (f" and {len(names) - 20} more" if len(names) > 20 else "")


def _wells(path: Path, options: Options) -> dict[str, tuple[Reading, list[Row]]]:
    """Rows by well, over all tables of a file, each with how it is read."""
    asked = checked_asked(options.columns)
    given = {"md": options.depth_unit, "inclination": options.angle_unit, "azimuth": options.angle_unit,
             "force": options.force_unit}  # fmt: skip
    out: dict[str, tuple[Reading, list[Row]]] = {}
    tables = _tables(path, asked)
    for table in tables:
        header = find_header(table, asked)
        body, below = body_of(table, header)
        reading = reading_of(table, header, body, below, given, options.decimal)
        for name, rows in wells_of(table, header, body).items():
            full = name
            if len(tables) > 1:
                sheet = table.name.removeprefix(f"{path.name}, sheet ")
                full = f"{sheet}: {name}" if name else sheet
            out[full] = (reading, rows)
    if len(out) > MOST_WELLS:
        raise InputError(path.name, None, f"holds {len(out)} wells; at most {MOST_WELLS} are read")
    return out


def _tables(path: Path, asked: Asked) -> list[RawTable]:
    """The tables of a file; of the sheets of a workbook those that hold a survey, or the first."""
    data = read_bytes(path)
    if data.startswith(ZIP):
        tables = workbook_tables(path.name, data)
        seen = [(table, sighted(table.rows, asked)) for table in tables]
        return [table for table, sight in seen if sight is not None and sight.complete] or tables[:1]
    text = text_of(data, path.name)
    return [las_table(path.name, text) if is_las(text) else text_table(path.name, text, asked)]
