"""The load path of a case with its states as small pictures: the rod as seen along the hole, and gaps along it."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from rodwell.analysis.off_wall.state import STRAIGHT
from rodwell.analysis.path.events import LIFT_OFF, LOADING, SNAP
from rodwell.analysis.path.words import is_gradual
from rodwell.analysis.space.geometry import upwards
from rodwell.answers.result.beyond import Beyond, StateBeyond
from rodwell.answers.words.wording import forces_of
from rodwell.case.case import Case
from rodwell.plots.paths.axes import across_of, units_of
from rodwell.plots.paths.path import LOADED, UNLOADED, plot_path
from rodwell.plots.style import GREY, INK

MOST = 5
"""States that are drawn."""

LETTERS = "abcde"


def plot_beyond(case: Case, found: Beyond) -> Figure:
    """Draw load against shortening with the loop, and below it states: seen along the hole, and their gaps.

    Letters on the curve name the states. Returns the figure.
    """
    assert found.path is not None
    states = pictured(found)
    figure = Figure(figsize=(7.6, 7.4), layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(3, max(len(states), 1), height_ratios=(3.4, 1.0, 0.7))
    path = plot_path(found.path, figure.add_subplot(grid[0, :]), case)
    units = units_of(found.path, case)
    for i, one in enumerate(states):
        x = units.shortening * across_of(found.path, one.state.shortening.value, one.load.value)
        y = units.load(one.load.value)
        path.annotate(LETTERS[i], (x, y), xytext=(5, -11), textcoords="offset points", fontsize=9.5, fontweight="bold")
        _along_the_hole(figure.add_subplot(grid[1, i]), case, one, LETTERS[i])
        _gaps(figure.add_subplot(grid[2, i]), one)
    path.set_title(case.title, loc="left", fontsize=10)
    return figure


def pictured(found: Beyond) -> list[StateBeyond]:
    """Lift-off, and around each snap the state just before it and that after it, unless that is the straight rod.

    Of a rod that nothing presses to the wall, what happens without a jump as the load grows. Where nothing snaps,
    lift-off and the last change of contact as the load grows: on the way back the rod comes by there again.
    """
    chosen: list[StateBeyond] = []
    last: StateBeyond | None = None
    snaps = any(one.event.kind == SNAP for one in found.events)
    for one in found.events if snaps else [one for one in found.events if one.event.leg == LOADING]:
        if one.event.kind == SNAP and not one.before and last is not None and last not in chosen:
            chosen.append(last)
        there = one.state
        taken = one.before or one.event.kind == SNAP or (one.event.kind == LIFT_OFF and not chosen)
        steady = found.path is not None and is_gradual(found.path.problem, one.event)
        taken |= steady and one.event.leg == LOADING
        if there is not None and taken and there.state.kind != STRAIGHT:
            chosen.append(there)
        last = there
    if last is not None and last not in chosen and last.state.kind != STRAIGHT:
        chosen.append(last)
    return chosen[:MOST]


def _along_the_hole(ax: Any, case: Case, one: StateBeyond, letter: str) -> None:
    """The rod's axis as seen along the hole, in the circle that the wall leaves it."""
    s = np.linspace(0.0, 1.0, 401)
    f, size = one.state.fields(s), case.problem.clearance
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    ax.plot(np.cos(turn), np.sin(turn), color=GREY, lw=0.9)
    x, y = (upwards(case.problem) * f[name] / size for name in "xy")
    ax.plot(y, x, color=_colour(one), lw=1.7)
    ax.plot(y[[0, -1]], x[[0, -1]], "o", color=INK, ms=3)
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.set_title(f"{letter}  {forces_of(case).label(one.load.value)}\n{one.state.kind}", fontsize=8.5)


def _gaps(ax: Any, one: StateBeyond) -> None:
    """Gap between rod and wall along the rod, as a part of the clearance."""
    f = one.state.fields(401)
    if not one.state.gaps:
        ax.set_axis_off()
        ax.text(0.5, 0.5, "no gap", ha="center", va="center", fontsize=8.5, transform=ax.transAxes)
        return
    ax.fill_between(f["s"], np.maximum(f["gap"], 0.0), color=_colour(one), alpha=0.35, lw=0)
    ax.plot(f["s"], np.maximum(f["gap"], 0.0), color=_colour(one), lw=1.1)
    ax.set_ylim(0.0, 1.15 * max(gap.largest.value for gap in one.state.gaps))
    ax.set_xlim(0.0, 1.0)
    ax.set_xticks([0.0, 1.0])
    ax.tick_params(labelsize=7.5)
    ax.set_xlabel("s/L", fontsize=8, labelpad=-6)
    ax.set_ylabel("gap/Δ", fontsize=8)


def _colour(one: StateBeyond) -> str:
    return LOADED if one.leg == "loading" else UNLOADED
