"""A parameter study of torque and drag as a table and as plain data: one row for each point and operation."""

from __future__ import annotations

import math
from typing import Any

from rodwell._version import __version__
from rodwell.quantities.table import Cell, Table
from rodwell.quantities.text import plain
from rodwell.quantities.value import Value
from rodwell.studies.drag.plain import CONVENTION, UNIT, number
from rodwell.studies.drag.sweep.points import OperationAt, WellPoint
from rodwell.studies.drag.sweep.study import DragStudy
from rodwell.studies.drag.sweep.words import sentences
from rodwell.studies.drag.words import FAILS, units
from rodwell.studies.varied import Varied

NOTES = (
    "Forces effective, tension positive; hook load at surface, without the block. Depths measured along the hole.",
    "± is the estimate of the numerical error. Helix early and helix late are the bounds where two local states are "
    "stable; push left and depths are the worse of both.",
)


def points_table(study: DragStudy) -> Table:
    """One row for each point and operation; those that fail are marked."""
    by = units(study.well)
    (m, depth), (n, force), (nm, torque) = (by[k] for k in ("depth", "force", "torque"))
    (q, per), (pa, stress) = by["per_length"], by["stress"]
    columns = (
        "point", *(f"{v.name} [{v.unit}]" if v.unit else v.name for v in study.varied), "operation",
        f"bit depth [{depth}]", f"bit force [{force}]", f"hook load [{force}]", f"± error [{force}]",
        f"hook load, helix early [{force}]", f"hook load, helix late [{force}]",
        f"torque at surface [{torque}]", f"± error of it [{torque}]", f"push left [{force}]",
        f"locks up at bit depth [{depth}]", f"push ends at bit depth [{depth}]", f"sinusoidal [{depth}]",
        f"helical [{depth}]", f"largest contact force [{per}]", f"largest von Mises stress [{stress}]",
        "part of yield strength", "verdict", "remarks",
    )  # fmt: skip
    rows: list[tuple[Cell, ...]] = []
    marked = set()
    for point in study.points:
        inputs = (point.number + 1, *(cell(v, i) for v, i in zip(study.varied, point.at, strict=True)))
        if not point.operations:
            rows.append((*inputs, *([None] * (len(columns) - len(inputs) - 2)), "not computed", point.reason))
        for one in point.operations:
            if one.level == FAILS:
                marked.add(len(rows))
            rows.append((
                *inputs, one.operation.name, one.operation.bit_depth / m, one.operation.bit_force / n,
                *_both(one.hook_load, n), _cell(one.early, n), _cell(one.late, n), *_both(one.torque, nm),
                _cell(one.margin, n), _cell(one.lock_up, m), _cell(one.push_ends, m),
                *(one.buckled.get(state, 0.0) / m for state in ("sinusoidal", "helical")), _cell(one.contact, q),
                _cell(one.von_mises, pa), _cell(one.used, 1.0), one.level, one.why,
            ))  # fmt: skip
    return Table("Points", columns, tuple(rows), frozenset(marked), NOTES)


def cell(varied: Varied, i: int) -> Cell:
    """A value of a varied input: a number in its unit, or text."""
    return str(varied.values[i]) if varied.numbers is None else varied.numbers[i]


def _cell(value: Value | None, unit: float) -> Cell:
    return None if value is None or not math.isfinite(value.value) else value.value / unit


def _both(value: Value | None, unit: float) -> tuple[Cell, Cell]:
    return (None, None) if value is None else (_cell(value, unit), _cell(Value(value.error), unit))


def short_head(study: DragStudy) -> list[str]:
    """Columns of the table for reading."""
    by = units(study.well)
    depth, force, torque = (by[k][1] for k in ("depth", "force", "torque"))
    return [*(v.label for v in study.varied), "operation", f"hook load [{force}]", f"torque [{torque}]",
            f"push left [{force}]", f"locks up at [{depth}]", f"buckled [{depth}]", "verdict"]  # fmt: skip


def short_rows(study: DragStudy) -> list[tuple[tuple[str, ...], bool]]:
    """Rows of the table for reading, and whether the operation fails there."""
    by = units(study.well)
    (m, _), (n, _), (nm, _) = (by[k] for k in ("depth", "force", "torque"))
    out = []
    for point in study.points:
        inputs = tuple(
            str(v.values[i]) if v.numbers is None else plain(v.numbers[i], 6)
            for v, i in zip(study.varied, point.at, strict=True)
        )
        if not point.operations:
            out.append(((*inputs, "not computed", *["–"] * 6), True))
        for one in point.operations:
            pairs = ((one.hook_load, n), (one.torque, nm), (one.margin, n), (one.lock_up, m))
            numbers = tuple("–" if v is None else plain(v.value / unit, 5) for v, unit in pairs)
            length = sum(one.buckled.values()) / m
            cells = (*inputs, one.operation.name, *numbers, plain(length) if length else "no", one.level)
            out.append((cells, one.level == FAILS))
    return out


def drag_study_dict(study: DragStudy) -> dict[str, Any]:
    """Everything as plain data, for JSON: SI units."""
    return {
        "title": study.well.title,
        "rodwell_version": __version__,
        "unit": UNIT,
        "convention": f"{CONVENTION}; points are numbered from 1",
        "varied": [
            {"key": v.name, "written": v.written, "unit": v.unit, "values": list(v.numbers or v.values)}
            for v in study.varied
        ],
        "summary": sentences(study),
        "points": [_point(study, point) for point in study.points],
    }


def _point(study: DragStudy, point: WellPoint) -> dict[str, Any]:
    return {
        "point": point.number + 1,
        "inputs": {v.name: v.values[i] for v, i in zip(study.varied, point.at, strict=True)},
        "reason": point.reason or None,
        "missed": list(point.missed),
        "operations": [_operation(one) for one in point.operations],
    }


def _operation(one: OperationAt) -> dict[str, Any]:
    return {
        "name": one.operation.name, "kind": one.operation.kind, "bit_depth": one.operation.bit_depth,
        "bit_force": number(Value(one.operation.bit_force)), "hook_load": number(one.hook_load),
        "surface_torque": number(one.torque), "bounds": {"early": number(one.early), "late": number(one.late)},
        "margin": number(one.margin), "lock_up_depth": number(one.lock_up), "push_ends_depth": number(one.push_ends),
        "buckled_length": one.buckled, "largest_contact_force": number(one.contact),
        "largest_von_mises": number(one.von_mises), "largest_used": number(one.used),
        "not_judged": list(one.not_judged), "verdict": one.level, "why": one.why or None,
    }  # fmt: skip
