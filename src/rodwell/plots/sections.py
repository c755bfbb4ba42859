"""A string of sections: drawn as it is, and marked in figures along the rod."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from rodwell.case.case import Case
from rodwell.plots.style import GREY, INK, MODES, new_axes
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

HEIGHT = 2.4
"""Of the figure in inches."""

SHORTEST = 0.05
"""Part of the length below which a section's name does not fit beside it."""

WALL = 0.08
"""Thickness of the hole's wall in the drawing, as a part of its diameter."""

MOST_NAMES = 14

HOLLOW: dict[str, Any] = {"facecolor": "white", "alpha": 0.75, "lw": 0}
CORE: dict[str, Any] = {"facecolor": INK, "alpha": 0.35, "lw": 0}


def mark_steps(ax: Any, problem: Problem, factor: float, *, down: bool = False) -> None:
    """Mark the ends of sections in a figure along the rod; ``factor`` turns L into the axis' unit.

    ``down``: the axis is depth below s = 1, drawn downwards.
    """
    if not problem.sections:
        return
    for s in problem.rod.breaks[1:-1]:
        line = ax.axhline if down else ax.axvline
        line((1.0 - s if down else s) * factor, color=GREY, lw=0.8, ls=(0, (2, 2)), zorder=0)


def name_sections(ax: Any, case: Case, factor: float, *, down: bool = False) -> None:
    """Write the names of a string's sections along the edge of a figure along the rod, as far as they fit."""
    if case.string is None or len(case.string.members) > MOST_NAMES:
        return
    plain = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
    for member, (start, end) in zip(case.string.members, case.string.ends, strict=True):
        if end - start < SHORTEST:
            continue
        middle = 0.5 * (start + end)
        if down:
            ax.text(0.99, (1.0 - middle) * factor, member.name, color=GREY, fontsize=8, ha="right", va="center",
                    bbox=plain, transform=ax.get_yaxis_transform())  # fmt: skip
        else:
            ax.text(middle * factor, 1.0, member.name, color=GREY, fontsize=8, ha="center", va="bottom",
                    transform=ax.get_xaxis_transform())  # fmt: skip


def _along(x: FloatArray, middle: FloatArray, wide: FloatArray, look: dict[str, Any]) -> Polygon:
    """A part of the rod between two places x (2,), with its axis and its width at both."""
    edges = np.concatenate([middle - 0.5 * wide, (middle + 0.5 * wide)[::-1]])
    return Polygon(np.stack([np.concatenate([x, x[::-1]]), edges], axis=1), closed=True, **look)


def plot_string(case: Case, ax: Any = None) -> Any:
    """Draw the sections of a string in their hole, from the bottom at the left; return the axes.

    Lengths and diameters have scales of their own. A section without an outer diameter is drawn as a line.
    """
    ax = new_axes((7.2, HEIGHT)) if ax is None else ax
    string, scales = case.string, case.scales
    assert string is not None
    assert scales is not None
    length, unit = scales.system.unit("length", string.length)
    widest = max((rod.outer_diameter or 0.0) for one in string.members for rod in one.rods)
    clearance = case.problem.clearance * scales.length
    hole = widest + 2.0 * clearance
    across, across_unit = scales.system.unit("length", 0.1 * hole)
    for side in (-1.0, 1.0):
        base = 0.5 * hole if side > 0.0 else -(0.5 + WALL) * hole
        patch = Rectangle((0.0, base / across), string.length / length, WALL * hole / across, color="#d9dee3", lw=0)
        ax.add_patch(patch)
    for number, (one, (start, end)) in enumerate(zip(string.members, string.ends, strict=True)):
        outer = np.array([one.rods[i].outer_diameter or 0.0 for i in (0, -1)]) / across
        low = 0.5 * hole / across - outer if case.problem.floats else -0.5 * hole / across  # the side that it lies on
        x, middle = np.array([start, end]) * string.length / length, low + 0.5 * outer
        body: dict[str, Any] = {"facecolor": MODES[number % len(MODES)], "alpha": 0.55, "edgecolor": INK, "lw": 1.0}
        ax.add_patch(_along(x, middle, outer, body))
        for within, look in zip(one.within, (HOLLOW, CORE), strict=True):
            if np.any(within):
                ax.add_patch(_along(x, middle, within / across, look))
        if end - start >= SHORTEST and len(string.members) <= MOST_NAMES:
            ax.text(float(np.mean(x)), float(np.mean(middle)), one.name, ha="center", va="center", fontsize=8.5)
    ax.axhline(0.0, color=GREY, lw=0.8, ls=(0, (8, 3, 1, 3)))
    ax.set_xlim(0.0, string.length / length)
    ax.set_ylim(-(0.5 + WALL) * hole / across, (0.5 + WALL) * hole / across)
    ax.grid(visible=False)
    ax.set_xlabel(f"distance along the rod from s = 0, its lower end  [{unit}]")
    ax.set_ylabel(f"across the hole  [{across_unit}]")
    return ax
