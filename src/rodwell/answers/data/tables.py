"""The key figures and special points of an answer as tables of numbers, for CSV and XLSX."""

from __future__ import annotations

from rodwell.answers.result.answer import Answer
from rodwell.answers.result.figure import Figure
from rodwell.quantities.table import Cell, Table

NOTES = (
    "Tension positive, compression negative; forces are those at the end s = 1.",
    "Units B = L = 1: B bending stiffness, L length of the rod. Errors are estimates from two nested meshes.",
)


def answer_tables(answer: Answer) -> tuple[Table, Table]:
    """Return key figures and special points, with all digits: as in answer.json, and in the reader's units."""
    return key_figures(answer), special_points(answer)


def key_figures(answer: Answer) -> Table:
    """One row for each key figure."""
    physical = answer.case.scales is not None
    columns = ["name", "quantity", "value (B = L = 1)", "± error", "unit"]
    columns += ["value", "± error", "unit of value"] if physical else []
    rows = tuple(_row(answer, figure) for figure in answer.figures.values())
    return Table("Key figures", (*columns, "remark"), rows, notes=NOTES)


def _row(answer: Answer, figure: Figure) -> tuple[Cell, ...]:
    plain = figure.as_dict(answer.case)
    cells: list[Cell] = [figure.name, figure.label, figure.value, figure.error, plain["unit"]]
    scales = answer.case.scales
    if scales is not None:
        shown = scales.shown(figure.value, figure.error, figure.dimension)
        cells += [shown["value"], shown["error"], shown["unit"]]
    return (*cells, figure.note or None)


def special_points(answer: Answer) -> Table:
    """One row for each special point of each branch, in order of travel."""
    scales = answer.case.scales
    columns = ["mode", "kind", "end force F at s = 1 [B/L^2]", "± error [B/L^2]"]
    if scales is not None:
        unit = scales.system.unit("force")[1]
        columns += [f"end force F at s = 1 [{unit}]", f"± error [{unit}]"]
    columns += ["stability index before", "stability index after", "places s/L"]
    rows: list[tuple[Cell, ...]] = []
    for branch in answer.branches:
        for point in branch.special_points:
            cells: list[Cell] = [branch.mode.number if branch.mode else None, point.kind, point.force, point.error]
            if scales is not None:
                shown = scales.shown(point.force, point.error, "force")
                cells += [shown["value"], shown["error"]]
            places = ", ".join(f"{s:.10g}" for s in point.s) or None
            rows.append((*cells, point.index_before, point.index_after, places))
    notes = (
        *NOTES,
        "Stability index: number of unstable ways under dead loads, for a rod kept on the wall; 0 is stable.",
        "An end of a branch is where it was asked to end: it has no error.",
    )
    return Table("Special points", tuple(columns), tuple(rows), notes=notes)
