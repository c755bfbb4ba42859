"""Where a map jumps: edges of the grid across which mode, place or outcome change, and the change located on them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rodwell.quantities.arrays import FloatArray
from rodwell.studies.maps.axes import Axis
from rodwell.studies.maps.block import Block, computed_cell
from rodwell.studies.maps.cells import CONVERGED, FAILED, IMPOSSIBLE, MISSES_TOLERANCE, NOT_COMPUTED
from rodwell.studies.maps.question import Question
from rodwell.studies.maps.rods import Rods

KINDS = ("not_computed", "place", "mode", "outcome", "smooth", "lost")
"""What changes at a jump, by number; "smooth": looked at more closely, nothing jumps; "lost": could not be located."""

NOT_LOCATED, PLACE, MODE, OUTCOME, SMOOTH, LOST = range(len(KINDS))

LEAST = {"place": 0.01, "wavenumber": 0.01}
"""Changes below are never jumps: of the place in L, of the wavenumber relative to itself."""

STANDS_OUT = 2.5
"""A change is looked at if it is this much larger than one beside it on the same line of the grid."""

STILL_THERE = 0.5
"""A jump is one if this part of the change is left when its edge has been halved again and again."""

HALVINGS = 6
"""How often an edge is halved: to 1/64 of its length."""

MOST_CELLS = 10**7
"""Cells of a map whose jumps are sought: its columns must fit into memory."""

CHUNKS, SMALLEST, LARGEST = 64, 4, 512
"""Chunks of jumps, and jumps in one."""


@dataclass(frozen=True)
class Side:
    """What is known on one side of a jump."""

    outcome: int
    value: float
    place: float
    wavenumber: float


@dataclass(frozen=True)
class Edge:
    """An edge of the grid.

    Attributes
    ----------
    axis
        Number of the axis along which it runs.
    values
        Values of all parameters at its lower end.
    ends
        Numbers of the axis at both ends.
    sides
        What was found there.
    """

    axis: int
    values: tuple[Any, ...]
    ends: tuple[float, float]
    sides: tuple[Side, Side]


def columns(question: Question) -> dict[str, tuple[str, Any, str]]:
    """Columns of jumps as those of ``block.COLUMNS``; the last is written last."""
    out: dict[str, tuple[str, Any, str]] = {
        "axis": ("u1", 255, "number of the parameter along which the jump was located"),
        "low": ("f8", np.nan, "that parameter on one side"),
        "high": ("f8", np.nan, "and on the other: the jump lies between them"),
        "value_low": ("f8", np.nan, "the number of the map on the side of low"),
        "value_high": ("f8", np.nan, "and on the side of high"),
    }
    for axis in question.axes:
        out[f"at_{axis.name}"] = ("f8", np.nan, f"{axis.name} of the jump")
    return out | {"outcome": ("u1", 0, "what jumps")}


def edges(question: Question, cells: Block) -> list[Edge]:
    """Edges across which something may jump, axis by axis, in the order of the grid."""
    if question.distributions or question.size > MOST_CELLS:
        return []
    out = []
    for number, axis in enumerate(question.axes):
        if axis.numbers is None or len(axis.numbers) < 2:
            continue
        for index in np.argwhere(_suspicious(cells, number)).tolist():
            after = [*index]
            after[number] += 1
            values = tuple(one.values[i] for one, i in zip(question.axes, index, strict=True))
            ends = axis.numbers[index[number]], axis.numbers[after[number]]
            out.append(Edge(number, values, ends, (_side(cells, index), _side(cells, after))))
    return out


def _side(cells: Block, index: Sequence[int]) -> Side:
    at = tuple(index)
    return Side(int(cells["outcome"][at]), *(float(cells[name][at]) for name in ("value", "place", "wavenumber")))


def _suspicious(cells: Block, axis: int) -> np.ndarray:
    """Whether something may jump between neighbours along an axis: an array one shorter in that axis."""
    kind = _kinds(cells["outcome"])
    ends = [np.take(kind, range(start, kind.shape[axis] - 1 + start), axis) for start in (0, 1)]
    unknown = [np.isin(end, (NOT_COMPUTED, FAILED, IMPOSSIBLE)) for end in ends]
    out = (ends[0] != ends[1]) | _stands_out(cells["place"], axis, LEAST["place"])
    size = np.maximum(np.abs(cells["wavenumber"]), 1e-9)
    relative = _stands_out(np.log(np.maximum(size, 1e-3)), axis, LEAST["wavenumber"])
    return np.asarray((out | relative) & ~unknown[0] & ~unknown[1])


def _kinds(outcome: np.ndarray) -> np.ndarray:
    return np.where(outcome == MISSES_TOLERANCE, CONVERGED, outcome)


def _stands_out(field: FloatArray, axis: int, least: float) -> np.ndarray:
    """Whether the change between neighbours is larger than one beside it; False where a value is missing."""
    change = np.moveaxis(np.abs(np.diff(field, axis=axis)), axis, -1)
    left, right = np.full_like(change, np.inf), np.full_like(change, np.inf)
    left[..., 1:], right[..., :-1] = change[..., :-1], change[..., 1:]
    beside = np.fmin(left, right)
    beside[~np.isfinite(beside)] = 0.0
    with np.errstate(invalid="ignore"):
        return np.moveaxis((change > least) & (change > STANDS_OUT * beside), -1, axis)


def located_block(rods: Rods, axes: Sequence[Axis], chunk: Sequence[Edge], halvings: int) -> Block:
    """Locate jumps on edges, as columns."""
    rows = [_located(rods, axes, edge, halvings) for edge in chunk]
    return {name: np.array([row[name] for row in rows]) for name in rows[0]} if rows else {}


def lost_row(axes: Sequence[Axis], edge: Edge) -> dict[str, Any]:
    """The row of an edge on which nothing could be computed."""
    return _row(axes, edge, edge.ends, edge.sides, LOST)


def _located(rods: Rods, axes: Sequence[Axis], edge: Edge, halvings: int) -> dict[str, Any]:
    axis, (low, high), sides = axes[edge.axis], edge.ends, edge.sides
    kind, first = _what_jumps(*sides)
    size, smaller = first, 0
    for _ in range(halvings):
        middle = _middle(axis, low, high)
        values = (*edge.values[: edge.axis], axis.value(middle), *edge.values[edge.axis + 1 :])
        found = computed_cell(rods, values)
        if found.outcome in (FAILED, IMPOSSIBLE):
            return _row(axes, edge, (low, high), sides, LOST)
        there = Side(found.outcome, found.value.value, found.place, found.wavenumber)
        gaps = _gap(kind, sides[0], there), _gap(kind, there, sides[1])
        if gaps[1] > gaps[0]:
            low, sides = middle, (there, sides[1])
        else:
            high, sides = middle, (sides[0], there)
        smaller = smaller + 1 if max(gaps) < 0.75 * size else 0
        size = max(gaps)
        if smaller == 2:
            return _row(axes, edge, (low, high), sides, SMOOTH)
    return _row(axes, edge, (low, high), sides, kind if size > STILL_THERE * first else SMOOTH)


def _middle(axis: Axis, low: float, high: float) -> float:
    return math.sqrt(low * high) if axis.logarithmic else 0.5 * (low + high)


def _what_jumps(low: Side, high: Side) -> tuple[int, float]:
    """What changes most between two sides, and by how much."""
    if _gap(OUTCOME, low, high) > 0.0:
        return OUTCOME, 1.0
    place, mode = _gap(PLACE, low, high), _gap(MODE, low, high)
    return (MODE, mode) if mode / LEAST["wavenumber"] >= place / LEAST["place"] else (PLACE, place)


def _gap(kind: int, low: Side, high: Side) -> float:
    if kind == OUTCOME:
        pair = [CONVERGED if side.outcome == MISSES_TOLERANCE else side.outcome for side in (low, high)]
        return float(pair[0] != pair[1])
    if kind == PLACE:
        gap = abs(low.place - high.place)
    else:
        gap = abs(math.log(max(low.wavenumber, 1e-3)) - math.log(max(high.wavenumber, 1e-3)))
    return gap if math.isfinite(gap) else 0.0


def _row(
    axes: Sequence[Axis], edge: Edge, ends: tuple[float, float], sides: tuple[Side, Side], kind: int
) -> dict[str, Any]:
    """A jump as a row; where it lies is the middle of what is left of its edge."""
    numbers = [math.nan] * len(axes)
    for i, (axis, value) in enumerate(zip(axes, edge.values, strict=True)):
        numbers[i] = axis.numbers[axis.values.index(value)] if axis.numbers is not None else math.nan
    numbers[edge.axis] = _middle(axes[edge.axis], *ends)
    row: dict[str, Any] = {"axis": edge.axis, "low": ends[0], "high": ends[1]}
    row |= {"value_low": sides[0].value, "value_high": sides[1].value}
    row |= {f"at_{axis.name}": number for axis, number in zip(axes, numbers, strict=True)}
    return row | {"outcome": kind}
