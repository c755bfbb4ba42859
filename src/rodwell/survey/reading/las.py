"""Surveys in LAS files (Log ASCII Standard 1.2 and 2.0): curves of depth, inclination and azimuth.

The header is read by lasio, which knows its many spellings. The lines of numbers are read here: messages name their
lines, and nothing in them is mended silently, as lasio does with numbers that have run together.
"""

from __future__ import annotations

import io
import logging
import math
from typing import Any

from rodwell.errors import InputError
from rodwell.survey.reading.numbers import is_number
from rodwell.survey.reading.tables import MOST_COLUMNS, Cell, Declared, RawTable, Row

LONGEST_LINE = 1000
MOST_HEADER_LINES = 200
"""lasio takes the third power of their number where many have one name."""

SECTIONS = "VWC"
"""Sections that are needed: version, well, curves."""


def is_las(text: str) -> bool:
    """Whether a text begins like a LAS file: its first line that is no comment names a section."""
    for line in text[:20_000].splitlines():
        if line.strip() and not line.lstrip().startswith("#"):
            return line.lstrip()[:2].lower() == "~v"
    return False


def las_table(name: str, text: str) -> RawTable:
    """The curves of a LAS file as a table, with units, null value and well of its header.

    Raises
    ------
    InputError
        If the header cannot be read, or there are no curves.
    """
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    start = next((i for i, line in enumerate(lines) if line.lstrip()[:2].lower() == "~a"), len(lines))
    header = _header(name, lines[:start])
    if str(_value(header.version, "VERS")).startswith("3"):
        raise InputError("survey", name, "is LAS 3; export the survey as LAS 2.0 or CSV")
    curves = list(header.curves)
    if not curves or len(curves) > MOST_COLUMNS:
        raise InputError("survey", name, f"names {len(curves)} curves in its section ~Curve; from 1 to {MOST_COLUMNS}")
    names: list[Cell] = [f"{c.original_mnemonic} [{c.unit}]" if c.unit else c.original_mnemonic for c in curves]
    also = {i: str(c.descr) for i, c in enumerate(curves) if c.descr}
    wrapped = str(_value(header.version, "WRAP")).upper().startswith("Y")
    rows = _data(lines, start + 1, len(names) if wrapped else 0)
    well = str(_value(header.well, "WELL") or _value(header.well, "UWI") or "").strip()
    declared = Declared(well[:60], null=_null(_value(header.well, "NULL")))
    return RawTable(name, [(start + 1, names), *rows], fixed=True, also=also, separator=" ", declared=declared)


def _header(name: str, lines: list[str]) -> Any:
    """What lasio makes of the sections above the numbers."""
    import lasio  # noqa: PLC0415 - loaded when used

    kept, section = [], ""
    for line in lines:
        if line.lstrip().startswith("~"):
            section = line.lstrip()[1:2].upper()
        if section in SECTIONS and line.strip() and not line.lstrip().startswith("#"):
            kept.append(line)
    if len(kept) > MOST_HEADER_LINES or any(len(line) > LONGEST_LINE for line in kept):
        what = (f"has more than {MOST_HEADER_LINES} lines in ~Version, ~Well, ~Curve, or a line of more than "
                f"{LONGEST_LINE} letters; a survey has few curves")  # fmt: skip
        raise InputError("survey", name, what)
    log = logging.getLogger("lasio")
    level = log.level
    log.setLevel(logging.CRITICAL)
    try:
        text = "\n".join(kept) + "\n"
        return lasio.read(io.StringIO(text), ignore_data=True, ignore_header_errors=True, mnemonic_case="preserve")
    except Exception as error:  # lasio raises many kinds for damaged headers
        what = f"is not a LAS file that can be read: {type(error).__name__}; export it anew, or as CSV"
        raise InputError("survey", name, what) from None
    finally:
        log.setLevel(level)


def _value(section: Any, name: str) -> Any:
    """Value of a line of the header, in whatever case its name is written; "" if there is none."""
    return next((item.value for item in section if item.original_mnemonic.upper() == name), "")


def _null(value: Any) -> float | None:
    try:
        null = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return null if math.isfinite(null) else None


def _data(lines: list[str], start: int, wrapped: int) -> list[Row]:
    """Lines of numbers; with ``wrapped`` curves, one station runs over several lines and is called by its first."""
    rows: list[Row] = []
    number = 0
    cells: list[Cell] = []
    for i, line in enumerate(lines[start:], start=start + 1):
        if line.lstrip().startswith("~"):
            break
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        words = line.split() if "," not in line else _by_commas(line)
        if not wrapped:
            rows.append((i, list(words)))
            continue
        number = number if cells else i
        cells += words
        if len(cells) >= wrapped:
            rows.append((number, list(cells)))
            cells = []
    return [*rows, (number, list(cells))] if cells else rows


def _by_commas(line: str) -> list[str]:
    """Cells separated by commas, unless words are numbers with decimal commas."""
    words = line.split()
    return words if len(words) > 1 and all(is_number(word) for word in words) else [c.strip() for c in line.split(",")]
