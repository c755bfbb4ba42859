"""The key numbers and special points of an answer as tables of numbers, for CSV and XLSX."""

from __future__ import annotations

from collections.abc import Iterable

from rodwell.analysis.branch.branch import Branch
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.key_number import KeyNumber
from rodwell.quantities.names import UNITS
from rodwell.quantities.scales import Scales
from rodwell.quantities.table import Cell, Table

NOTES = (
    "Tension positive, compression negative; forces are those at the end s = 1.",
    "Units B = L = 1: B bending stiffness, L length of the rod. Errors are estimates from two nested meshes.",
)


MISSES = "misses the tolerance: its error says how well it is known"
"""Remark beside a special point."""


def answer_tables(answer: Answer) -> tuple[Table, Table]:
    """Return key numbers and special points, with all digits: as in answer.json, and in the reader's units."""
    scales = answer.case.scales
    return _key_numbers(answer.key_numbers.values(), scales), _special_points(answer.branches, scales)


def _key_numbers(numbers: Iterable[KeyNumber], scales: Scales | None) -> Table:
    """One row for each key number."""
    columns = ["name", "quantity", "value (B = L = 1)", "± error", "unit"]
    columns += ["value", "± error", "unit of value"] if scales is not None else []
    rows = tuple(_row(number, scales) for number in numbers)
    return Table("Key figures", (*columns, "remark"), rows, notes=NOTES)


def _row(key: KeyNumber, scales: Scales | None) -> tuple[Cell, ...]:
    cells: list[Cell] = [key.name, key.label, key.value, key.error, UNITS[key.dimension]]
    if scales is not None:
        shown = scales.shown(key.number, key.dimension)
        cells += [shown["value"], shown["error"], shown["unit"]]
    return (*cells, key.remark or None)


def _special_points(branches: Iterable[Branch], scales: Scales | None) -> Table:
    """One row for each special point of each branch, in order of travel."""
    columns = ["mode", "kind", "end force F at s = 1 [B/L^2]", "± error [B/L^2]"]
    if scales is not None:
        unit = scales.system.unit("force")[1]
        columns += [f"end force F at s = 1 [{unit}]", f"± error [{unit}]"]
    columns += ["stability index before", "stability index after", "places s/L"]
    rows: list[tuple[Cell, ...]] = []
    remarks: list[str | None] = []
    for branch in branches:
        for point in branch.special_points:
            cells: list[Cell] = [branch.mode.number if branch.mode else None, point.kind, point.force, point.error]
            if scales is not None:
                shown = scales.shown(point.load, "force")
                cells += [shown["value"], shown["error"]]
            places = ", ".join(f"{s:.10g}" for s in point.s) or None
            rows.append((*cells, point.index_before, point.index_after, places))
            remarks.append(None if branch.meets_tolerance(point) else MISSES)
    if any(remarks):
        columns.append("remark")
        rows = [(*row, remark) for row, remark in zip(rows, remarks, strict=True)]
    notes = (
        *NOTES,
        "Stability index: number of unstable ways under dead loads, for a rod kept on the wall; 0 is stable.",
        "An end of a branch is where it was asked to end: it has no error.",
    )
    return Table("Special points", tuple(columns), tuple(rows), notes=notes)
