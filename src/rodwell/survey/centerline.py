"""The centre line of a vessel, a pipe or a hole: points x, y, z in a file, as other programs write them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.units import in_unit_of
from rodwell.survey.reading.numbers import is_number, number
from rodwell.survey.reading.source import read_bytes, text_of
from rodwell.survey.reading.tables import shown

AXES = ("x", "y", "z")
UNITS = {"m": "m", "cm": "cm", "mm": "mm", "µm": "µm", "um": "µm", "μm": "µm", "in": "in", "ft": "ft"}
EXAMPLE = "x [mm],y [mm],z [mm]"

_NAME = re.compile(r"\s*\"?\s*([xyzXYZ])\s*(?:[\[(]\s*([^\])\s]+)\s*[\])])?\s*\"?\s*")
_SEPARATORS = (";", "\t", ",", None)
"""None: any white space. A comma comes late, for it may be a decimal mark."""


def read_centerline(path: Path) -> FloatArray:
    """Points (n, 3) in m of a text file: a header with x, y, z and their unit, then one point on each line.

    Columns may stand in any order and beside others; they are separated by commas, semicolons, tabs or blanks. Empty
    lines and what begins with # is left out. z is upwards.

    Raises
    ------
    InputError
        Naming the line, what was found, and what to do.
    """
    text = text_of(read_bytes(path), path.name)
    lines = [
        (i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise InputError("centerline", path.name, f"is empty: the first line names the columns, {EXAMPLE}")
    at, head = lines[0]
    for separator in _SEPARATORS:
        columns = _columns(head.split(separator))
        if columns is not None:
            break
    else:
        what = f"does not name x, y and z with one unit each: write {EXAMPLE}"
        raise InputError(f"{path.name}, line {at}", shown(head), what)
    points = [_point(path.name, line, text_, separator, columns) for line, text_ in lines[1:]]
    return np.array(points, dtype=float).reshape(-1, 3)


def _columns(cells: list[str]) -> list[tuple[int, float]] | None:
    """Number of the column of x, y and z, and its unit in m; None where one is missing, or has no unit of length."""
    found: dict[str, tuple[int, float]] = {}
    for i, cell in enumerate(cells):
        match = _NAME.fullmatch(cell)
        unit = UNITS.get(match[2] or "") if match is not None else None
        if match is not None and unit is not None:
            found.setdefault(match[1].lower(), (i, in_unit_of(1.0, unit, "m")))
    return [found[axis] for axis in AXES] if all(axis in found for axis in AXES) else None


def _point(
    name: str, line: int, text: str, separator: str | None, columns: list[tuple[int, float]]
) -> tuple[float, ...]:
    cells = text.split(separator)
    out = []
    for axis, (i, unit) in zip(AXES, columns, strict=True):
        cell = cells[i].strip(' "') if i < len(cells) else ""
        value = number(cell, "." if separator == "," or "," not in cell else ",") if is_number(cell) else None
        if value is None:
            what = f"must be a number: each line holds {', '.join(AXES)} of a point, as the header names them"
            raise InputError(f"{name}, line {line}, {axis}", shown(cell) or None, what)
        out.append(value * unit)
    return tuple(out)
