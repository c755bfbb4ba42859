"""A string that bridges steps of its clearance, seen from the side: walls, rod, contact forces."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.off_wall.state import ContactState
from rodwell.plots.style import GREY, INK, MODES, WARN, new_axes
from rodwell.plots.units import axis
from rodwell.quantities.scales import Scales

HEIGHT = 3.0
"""Of the figure in inches."""

WALL, ARROW = 0.12, 0.35
"""Thickness of the wall that is drawn, and length of the arrow of the largest point force, in the drawn height."""


def plot_bridging(state: ContactState, ax: Any = None, *, scales: Scales | None = None) -> Any:
    """Draw the hole's lower side as the rod's axis meets it, the axis, and point forces as arrows; return the axes.

    Height is drawn much larger than length. Without ``scales`` lengths are in L and heights in Δ.
    """
    ax = new_axes((7.2, HEIGHT)) if ax is None else ax
    problem, rod = state.problem, state.problem.rod
    s = np.unique(np.concatenate([np.linspace(0.0, 1.0, 801), [p.s.value for p in state.point_forces]]))
    along, across, units = 1.0, 1.0 / problem.clearance, ("L", "Δ")
    if scales is not None:
        along, long_unit = axis("z", scales, 1.0)
        across, wide_unit = axis("z", scales, problem.clearance)
        units = (long_unit, wide_unit)
    ratios = problem.clearance * across * rod.clearance.coefficients[:, 0]
    floor = np.repeat(-ratios, 2)
    lengths = np.repeat(rod.breaks, 2)[1:-1] * along
    room = float(np.ptp(ratios)) or float(ratios[0])
    base = float(np.min(floor)) - WALL * room
    ax.fill_between(lengths, base, floor, color="#d9dee3", lw=0)
    ax.plot(lengths, floor, color=GREY, lw=1.0)
    height = state.fields(s)["x"] * across
    ax.plot(s * along, height, color=MODES[0], lw=1.8, label="axis of the string")
    for contact in state.contacts:
        here = (s >= contact.start.value) & (s <= contact.end.value)
        ax.plot(s[here] * along, height[here], color=INK, lw=3.0, label="in contact")
    largest = max((point.force.value for point in state.point_forces), default=0.0)
    for point in state.point_forces:
        at = float(np.interp(point.s.value, s, height))
        size = ARROW * room * point.force.value / largest
        ax.annotate("", xy=(point.s.value * along, at), xytext=(point.s.value * along, at - max(size, 0.05 * room)),
                    arrowprops={"arrowstyle": "-|>", "color": WARN, "lw": 1.4, "shrinkA": 0, "shrinkB": 0})  # fmt: skip
    ax.plot([], [], color=WARN, lw=1.4, label="point forces")
    handles, labels = ax.get_legend_handles_labels()
    named = dict(zip(labels, handles, strict=True))
    ax.legend(named.values(), named.keys(), loc="best")
    ax.set_xlim(0.0, along)
    ax.set_ylim(base - ARROW * room, float(np.max(height)) + 0.4 * room)
    ax.set_xlabel(f"distance along the rod from s = 0  [{units[0]}]")
    ax.set_ylabel(f"height above the hole's axis  [{units[1]}]")
    return ax
