"""A string that leaves the wall by itself, seen from the side: walls, rod, contact forces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rodwell.analysis.off_wall.state import ContactState
from rodwell.case.beside import Pair
from rodwell.plots.style import GREY, INK, MODES, WARN, new_axes
from rodwell.plots.units import axis
from rodwell.problem.problem import Problem
from rodwell.problem.profile import extremes
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.scales import Scales

HEIGHT = 3.0
"""Of the figure in inches."""

WALL, ARROW = 0.12, 0.35
"""Thickness of the wall that is drawn, and length of the arrow of the largest point force, in the drawn height."""


SAME = 1e-9
"""Places in L that differ by less are one."""


@dataclass(frozen=True)
class _Piece:
    """A piece between steps: its ends in L, and radii of hole and string in the unit of heights."""

    start: float
    end: float
    hole: float
    string: float


def plot_bridging(
    state: ContactState, ax: Any = None, *, scales: Scales | None = None, pairs: Sequence[Pair] = ()
) -> Any:
    """Draw the hole's lower side, that of the string, and point forces as arrows; return the axes.

    Where sections float, the upper side too.

    Height is drawn much larger than length. Without ``scales`` lengths are in L and heights in Δ. ``pairs`` have the
    diameters of hole and string; without them the string's axis is drawn, and the wall where the axis meets it.
    """
    ax = new_axes((7.2, HEIGHT)) if ax is None else ax
    problem = state.problem
    along, across, units = 1.0, 1.0 / problem.clearance, ("L", "Δ")
    if scales is not None:
        along, long_unit = axis("z", scales, 1.0)
        across, wide_unit = axis("z", scales, problem.clearance)
        units = (long_unit, wide_unit)
    pieces = _pieces(problem, across, None if scales is None else across / scales.length, pairs)
    lengths = np.array([end for piece in pieces for end in (piece.start, piece.end)]) * along
    floor = np.repeat([-piece.hole for piece in pieces], 2)
    s, height = _lower_side(state, pieces, across)
    both = problem.rod.mixed
    highest = -float(np.min(floor)) if both else float(np.max(height))
    room = highest - float(np.min(floor))
    base, top = float(np.min(floor)) - WALL * room, highest + (WALL + ARROW if both else 0.4) * room
    if both:
        ax.fill_between(lengths, -floor, highest + WALL * room, color="#d9dee3", lw=0)
        ax.plot(lengths, -floor, color=GREY, lw=1.0)
    ax.fill_between(lengths, base, floor, color="#d9dee3", lw=0)
    ax.plot(lengths, floor, color=GREY, lw=1.0)
    if pairs:
        ax.fill_between(s * along, height, top, color=MODES[0], alpha=0.12, lw=0)
    ax.plot(s * along, height, color=MODES[0], lw=1.8, label=f"{'lower side' if pairs else 'axis'} of the string")
    for contact in state.contacts:
        here = (s >= contact.start.value) & (s <= contact.end.value)
        ax.plot(s[here] * along, height[here], color=INK, lw=3.0, label="in contact")
    largest = max((point.force.value for point in state.point_forces), default=0.0)
    for point in state.point_forces:
        at = float(np.min(height[np.abs(s - point.s.value) < SAME]))
        size = ARROW * room * point.force.value / largest
        tail = at + (1.0 if both and at > 0.0 else -1.0) * max(size, 0.05 * room)
        ax.annotate("", xy=(point.s.value * along, at), xytext=(point.s.value * along, tail),
                    arrowprops={"arrowstyle": "-|>", "color": WARN, "lw": 1.4, "shrinkA": 0, "shrinkB": 0})  # fmt: skip
    ax.plot([], [], color=WARN, lw=1.4, label="point forces")
    handles, labels = ax.get_legend_handles_labels()
    named = dict(zip(labels, handles, strict=True))
    ax.legend(named.values(), named.keys(), loc="best")
    ax.set_xlim(0.0, along)
    ax.set_ylim(base - ARROW * room, top)
    ax.set_xlabel(f"distance along the rod from s = 0  [{units[0]}]")
    ax.set_ylabel(f"height above the hole's axis  [{units[1]}]")
    return ax


def _pieces(problem: Problem, across: float, per_metre: float | None, pairs: Sequence[Pair]) -> list[_Piece]:
    """Pieces between steps, with the hole's radius and the string's; without pairs that of the string is nil."""
    if pairs and per_metre is not None:
        radii = [(0.5 * extremes(pair.part.diameter or 0.0)[0], extremes(pair.clearance)[0]) for pair in pairs]
        return [
            _Piece(pair.start, pair.end, per_metre * hole, per_metre * (hole - clearance))
            for pair, (hole, clearance) in zip(pairs, radii, strict=True)
        ]
    breaks, ratios = problem.rod.breaks, problem.rod.clearance.coefficients[:, 0]
    return [
        _Piece(float(a), float(b), problem.clearance * across * float(ratio), 0.0)
        for a, b, ratio in zip(breaks[:-1], breaks[1:], ratios, strict=True)
    ]


def _lower_side(state: ContactState, pieces: Sequence[_Piece], across: float) -> tuple[FloatArray, FloatArray]:
    """Places and heights (n,) of the string's lower side, piece by piece: where it has a step a place comes twice."""
    forces = np.array([point.s.value for point in state.point_forces])
    parts = [
        np.unique(np.concatenate([
            np.linspace(piece.start, piece.end, max(9, round(801 * (piece.end - piece.start)))),
            forces[(forces >= piece.start) & (forces <= piece.end)],
        ]))
        for piece in pieces
    ]  # fmt: skip
    s = np.concatenate(parts)
    radius = np.repeat([piece.string for piece in pieces], [part.size for part in parts])
    return s, state.fields(s)["x"] * across - radius
