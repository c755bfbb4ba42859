"""Reading surveys from CSV files: which column is which, units, numbers, and what is wrong on which line."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rodwell.errors import InputError
from rodwell.quantities.units import in_unit_of

COLUMNS: dict[str, tuple[str, ...]] = {
    "md": ("md", "measured depth", "depth md", "md rkb", "mdrkb", "measured depth rkb", "meas depth"),
    "inclination": ("inc", "incl", "inclination", "inclin", "hole angle", "deviation", "dev", "angle", "incl angle"),
    "azimuth": ("azi", "az", "azm", "azim", "azimuth", "azi grid", "azi true", "azimuth grid", "azimuth true", "hazi"),
    "force": ("force", "axial force", "effective force", "axial load", "tension"),
}
"""What a column may be called; lower case, words separated by blanks, units left out."""

UNITS = {"md": "m", "inclination": "degree", "azimuth": "degree", "force": "N"}

SPELT = {
    "md": {"meter": "m", "meters": "m", "metre": "m", "metres": "m", "feet": "ft", "usft": "ft", "m": "m", "ft": "ft"},
    "inclination": {"deg": "degree", "degs": "degree", "degree": "degree", "degrees": "degree", "°": "degree",
                    "rad": "radian", "radians": "radian"},
    "force": {"n": "N", "kn": "kN", "lbf": "lbf", "klbf": "klbf", "klb": "klbf", "kip": "klbf", "kips": "klbf",
              "lb": "lbf", "tonf": "metric_ton*g_0"},
}  # fmt: skip
SPELT["azimuth"] = SPELT["inclination"]
"""Units as they are written in headers, and what they are."""

OPTIONS = {"md": "--depth-unit", "inclination": "--angle-unit", "azimuth": "--angle-unit", "force": "--force-unit"}

LARGEST_FILE = 20_000_000
MOST_STATIONS = 50_000

_HEAD = re.compile(r"^(.*?)[\s_]*(?:[\[(]\s*([^\])]*?)\s*[\])])?$")


@dataclass(frozen=True)
class Columns:
    """What was read: values by column as lists, in m, degrees and N; unit of the depth column; columns left aside."""

    values: dict[str, list[float]]
    lines: list[int]
    depth_unit: str
    ignored: tuple[str, ...]


def read_columns(path: Path, units: Mapping[str, str | None]) -> Columns:
    """Read the columns of a survey; ``units`` holds units given beside the file, by column.

    Raises
    ------
    InputError
        Naming file, line and column, what was found, and what is allowed.
    """
    lines = _lines(path)
    source = path.name
    number, head = lines[0]
    places, named, ignored = _header(source, number, head)
    body = lines[1:]
    if body and _is_unit_row(body[0][1], places):
        named = {**named, **{key: body[0][1][i].strip(" []()") for key, i in places.items() if body[0][1][i].strip()}}
        body = body[1:]
    factors, written = {}, {}
    for key in places:
        written[key] = _unit(source, key, named.get(key), units.get(key))
        factors[key] = in_unit_of(1.0, written[key], UNITS[key])
    if len(body) < 2:
        raise InputError(source, None, "holds fewer than two stations below its header")
    if len(body) > MOST_STATIONS:
        raise InputError(source, None, f"holds {len(body)} stations; at most {MOST_STATIONS} are read")
    values: dict[str, list[float]] = {key: [] for key in places}
    for line, cells in body:
        if len(cells) <= max(places.values()):
            raise InputError(f"{source}, line {line}", None, f"has {len(cells)} cells, fewer than the header names")
        for key, i in places.items():
            values[key].append(_number(source, line, head[i], cells[i]) * factors[key])
    return Columns(values, [line for line, _ in body], written["md"], ignored)


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """Lines with their numbers, split into cells; empty lines and comments (#) left out."""
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise InputError("survey", str(path), f"is larger than {LARGEST_FILE // 1_000_000} MB")
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError("survey", str(path), "does not exist; name a CSV file") from None
    except IsADirectoryError:
        raise InputError("survey", str(path), "is a folder; name a CSV file in it") from None
    except UnicodeDecodeError:
        raise InputError("survey", str(path), "is not text in UTF-8; export the survey as CSV in UTF-8") from None
    except OSError as error:
        raise InputError("survey", str(path), f"cannot be read: {error.strerror}") from None
    rows = text.splitlines()
    first = next((row for row in rows if row.strip() and not row.lstrip().startswith("#")), "")
    if not first:
        raise InputError(
            "survey", str(path), "is empty: the first line names the columns, for example MD [m],Inc [deg]"
        )
    delimiter = max(",;\t", key=first.count)
    out = []
    for number, row in enumerate(rows, start=1):
        if row.strip(" \t,;") and not row.lstrip().startswith("#"):
            try:
                out.append((number, next(csv.reader([row], delimiter=delimiter))))
            except csv.Error as error:
                raise InputError(f"{path.name}, line {number}", None, f"is not CSV: {error}") from None
    return out


def _header(source: str, line: int, head: list[str]) -> tuple[dict[str, int], dict[str, str], tuple[str, ...]]:
    """Which column is which, the units that the header names, and the columns that are left aside."""
    places: dict[str, int] = {}
    named: dict[str, str] = {}
    ignored = []
    for i, cell in enumerate(head):
        key, unit = _column(cell)
        if key is None:
            ignored.append(cell.strip())
            continue
        if key in places:
            raise InputError(f"{source}, line {line}", cell.strip(), f"is a second column for {key}: leave only one")
        places[key] = i
        if unit:
            named[key] = unit
    for key, word in (("md", "measured depth"), ("inclination", "inclination")):
        if key not in places:
            names = ", ".join(COLUMNS[key][:4])
            what = f"no column of {word}; name one of the columns {names}, for example MD [m],Inc [deg]"
            raise InputError(f"{source}, line {line}", ", ".join(c.strip() for c in head), what)
    return places, named, tuple(name for name in ignored if name)


def _column(cell: str) -> tuple[str | None, str]:
    """Meaning of a column and its unit from its header: "MD [ft]", "md_m", "Inclination (deg)"."""
    parts = _HEAD.match(cell.strip().lower())
    name, unit = (parts[1], parts[2] or "") if parts else (cell.strip().lower(), "")
    words = re.sub(r"[\s_.\-]+", " ", name).strip()
    for key, names in COLUMNS.items():
        if words in names:
            return key, unit
        first, _, last = words.rpartition(" ")
        if not unit and first in names and last in SPELT[key]:
            return key, last
    return None, ""


def _is_unit_row(cells: list[str], places: Mapping[str, int]) -> bool:
    """Whether a line holds units below the header, not a station."""
    texts = [(key, cells[i].strip(" []()").lower()) for key, i in places.items() if i < len(cells)]
    return bool(texts) and any(t for _, t in texts) and all(not t or t in SPELT[key] for key, t in texts)


def _unit(source: str, key: str, named: str | None, given: str | None) -> str:
    """The unit of a column; angles are in degrees unless something else is said."""
    for text in (given, named):
        if text:
            unit = SPELT[key].get(text.lower())
            if unit is None:
                allowed = ", ".join(sorted(set(SPELT[key])))
                name = OPTIONS[key] if text is given else f"{source}, unit of {key}"
                raise InputError(name, text, f"is not a unit known here; allowed are {allowed}")
            return unit
    if UNITS[key] == "degree":
        return "degree"
    example = {"md": "MD [m] or MD [ft]", "force": "Force [kN] or Force [lbf]"}[key]
    raise InputError(source, None, f"the unit of {key} is not known: write it in the header, {example}, "
                     f"or give {OPTIONS[key]}")  # fmt: skip


def _number(source: str, line: int, column: str, cell: str) -> float:
    text = cell.strip().replace("−", "-")
    try:
        value = float(text)
    except ValueError:
        hint = "; write a decimal point, not a comma" if re.fullmatch(r"[+-]?\d+,\d+", text) else ""
        what = "is not a number" if text else "is missing"
        name = f"{source}, line {line}, {column.strip()}"
        raise InputError(name, text or None, f"{what}{hint}") from None
    if not math.isfinite(value):
        raise InputError(f"{source}, line {line}, {column.strip()}", text, "must be finite")
    return value
