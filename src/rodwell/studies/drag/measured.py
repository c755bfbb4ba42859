"""Measured hook loads and torques, read from a CSV file."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rodwell.case.file import decoded, first_bytes
from rodwell.case.well.schema import KINDS_OF_OPERATION
from rodwell.errors import InputError
from rodwell.quantities.units import to_si
from rodwell.studies.drag.well_case import Operation, Well

LARGEST_FILE, MOST_ROWS = 2_000_000, 5000

COLUMNS = {"bit_depth": ("bit_depth", "depth", "md"), "kind": ("kind", "operation"),
           "hook_load": ("hook_load", "hookload"), "torque": ("torque", "surface_torque"),
           "bit_force": ("bit_force", "wob"), "bit_torque": ("bit_torque", "torque_on_bit", "tob")}  # fmt: skip


@dataclass(frozen=True)
class Measured:
    """A measured hook load in N (of the string, block taken off) or torque in N m, or both; NaN where not measured."""

    operation: Operation
    hook_load: float
    torque: float
    line: int


def read_measured(path: Path, well: Well) -> tuple[Measured, ...]:
    """Read measured loads: CSV with bit depth, kind, hook load and (or) torque, units in the header in brackets.

    A hook load is that of the string, as everywhere here: the weight of the block is taken off before.

    Raises
    ------
    InputError
        Naming file, line and column.
    """
    try:
        with path.open("rb") as opened:
            raw = first_bytes(opened, LARGEST_FILE)
    except OSError as error:
        raise InputError("--calibrate", str(path), f"cannot be read: {error.strerror}") from None
    text = decoded(raw, "--calibrate", str(path), "give a CSV file of measured hook loads", LARGEST_FILE)
    rows = [(i, row) for i, row in enumerate(csv.reader(text.splitlines()), 1) if any(c.strip() for c in row)]
    rows = [(i, row) for i, row in rows if not row[0].lstrip().startswith("#")]
    if len(rows) < 2:
        raise InputError("--calibrate", str(path), "has no measurements: a header and a line for each are needed")
    if len(rows) > MOST_ROWS:
        raise InputError("--calibrate", str(path), f"has more than {MOST_ROWS} lines: thin them out")
    columns = _columns(rows[0][1], path)
    return tuple(_measured(row, columns, line, path, well) for line, row in rows[1:])


def _columns(head: Sequence[str], path: Path) -> dict[str, tuple[int, str]]:
    """Number and unit of each column by meaning."""
    found: dict[str, tuple[int, str]] = {}
    for i, title in enumerate(head):
        name, _, unit = title.partition("[")
        plain = name.strip().lower().replace(" ", "_").replace("-", "_")
        meaning = next((key for key, names in COLUMNS.items() if plain in names), None)
        if meaning is None:
            raise InputError(f"{path.name}, column {i + 1}", title.strip(), "is not known; columns are bit_depth [m], "
                             "kind, hook_load [kN], torque [kN m], bit_force [kN], bit_torque [kN m]")  # fmt: skip
        found[meaning] = (i, unit.rstrip("] ").strip())
    for need in ("bit_depth", "kind"):
        if need not in found:
            raise InputError(f"{path.name}, column {need}", None, "is missing")
    if "hook_load" not in found and "torque" not in found:
        raise InputError(f"{path.name}, column hook_load", None, "is missing: give it, or torque, or both")
    for name, (_, unit) in found.items():
        if not unit and name != "kind":
            raise InputError(
                f"{path.name}, column {name}", None, 'has no unit: write it in the header, "hook_load [kN]"'
            )
    return found


_KIND = {"bit_depth": "length", "hook_load": "force", "torque": "moment", "bit_force": "force",
         "bit_torque": "moment"}  # fmt: skip


def _measured(row: Sequence[str], columns: dict[str, tuple[int, str]], line: int, path: Path, well: Well) -> Measured:
    where = f"{path.name}, line {line}"

    def cell(name: str) -> str:
        return row[columns[name][0]].strip() if name in columns and columns[name][0] < len(row) else ""

    def number(name: str) -> float:
        text = cell(name)
        if not text:
            return math.nan
        try:
            return to_si(f"{float(text)!r} {columns[name][1]}", _KIND[name])
        except ValueError as error:
            raise InputError(f"{where}, {name}", text, f"is not a number in {columns[name][1]}: {error}") from None

    kind = cell("kind").lower().replace(" ", "-").replace("_", "-")
    if kind not in KINDS_OF_OPERATION or kind in ("ream", "back-ream"):
        raise InputError(f"{where}, kind", cell("kind"), "must be run-in, pull-out, rotate-off-bottom, slide or drill")
    depth, force = number("bit_depth"), number("bit_force")
    if not 0.0 < depth <= well.end * (1.0 + 1e-12):
        raise InputError(f"{where}, bit_depth", cell("bit_depth"), f"must be above 0 and at most {well.end:g} m")
    _check_bit_force(f"{where}, bit_force", cell("bit_force"), kind, force)
    hook, torque, bit_torque = number("hook_load"), number("torque"), number("bit_torque")
    if kind == "drill" and not math.isnan(torque) and math.isnan(bit_torque):
        what = "is missing: the torque at surface is that of the bit and that of friction; give a column bit_torque, " \
               "or leave the torque of this line empty"  # fmt: skip
        raise InputError(f"{where}, bit_torque", None, what)
    if (kind != "drill" and bit_torque > 0.0) or bit_torque < 0.0:
        what = "must be 0 or more, and is given where the string drills only"
        raise InputError(f"{where}, bit_torque", cell("bit_torque"), what)
    if math.isnan(hook) and math.isnan(torque):
        raise InputError(where, None, "measures nothing: give a hook load or a torque, or remove the line")
    at_bit = (0.0 if math.isnan(value) else value for value in (force, bit_torque))
    return Measured(Operation(kind, kind, depth, *at_bit), hook, torque, line)


def _check_bit_force(field: str, written: str, kind: str, force: float) -> None:
    """Raise an InputError for a force at the bit that the operation cannot have; NaN is none."""
    if kind == "pull-out":
        if force < 0.0:
            raise InputError(field, written, "pushes the bit while the string is pulled out: an overpull is positive")
    elif force > 0.0:
        raise InputError(field, written, "puts the bit in tension: weight on bit is negative")
    elif kind in ("run-in", "rotate-off-bottom") and force < 0.0:
        raise InputError(field, written, "has no meaning off bottom: the bit is free; take slide or drill")
