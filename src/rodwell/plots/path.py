"""A load path: load against shortening, with events, snaps and the loop."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.off_wall.state import STRAIGHT
from rodwell.analysis.path.events import CRITICAL, LIFT_OFF, SNAP, UNLOADING, PathPoint
from rodwell.analysis.path.load_path import LoadPath
from rodwell.plots.style import GREY, INK, MODES, WARN, new_axes
from rodwell.problem.problem import ends_text
from rodwell.quantities.text import minus

MARKS = {CRITICAL: ("o", INK, "buckles"), LIFT_OFF: ("^", MODES[1], "lifts off")}
"""Marker, colour and word of events that are named; other changes of contact are small dots."""

LOADED, UNLOADED = MODES[0], MODES[2]


def plot_path(result: LoadPath, ax: Any = None) -> Any:
    """Draw compression at s = 1 against shortening; snaps are arrows. Returns the axes."""
    ax = new_axes() if ax is None else ax
    curve, names = result.curve, _legs(result)
    for run in np.unique(curve["run"]):
        here = curve["run"] == run
        unloading = names[int(run)] == UNLOADING if int(run) < len(names) else True
        ax.plot(
            1e3 * curve["shortening"][here], -curve["force"][here], color=UNLOADED if unloading else LOADED,
            lw=1.8, ls="--" if unloading else "-",
        )  # fmt: skip
    ax.plot([], [], color=LOADED, lw=1.8, label="load grows")
    if result.unload_to is not None:
        ax.plot([], [], color=UNLOADED, lw=1.8, ls="--", label="load is taken off")
    seen: set[str] = set()
    for event in result.events:
        _mark(ax, event, seen)
    _snaps(ax, result)
    ax.set_xlabel("shortening of the rod's span  [10⁻³ L]")
    ax.set_ylabel("end compression −F at s = 1  [B/L²]")
    problem = result.problem
    twist = f", T₁ = {problem.twist:g} B/L" if problem.twist else ""
    title = f"γ = {problem.weight:g}, α = {problem.alpha:g}°, Δ/L = {problem.clearance:g}{twist}, {ends_text(problem)}"
    ax.set_title(minus(title), loc="left", fontsize=9.5)
    ax.margins(x=0.03, y=0.05)
    ax.legend(loc="best")
    return ax


def _legs(result: LoadPath) -> list[str]:
    """The leg that each run belongs to, in the order of the curve."""
    return [leg.name for leg in result.legs for _ in leg.runs]


def _mark(ax: Any, event: PathPoint, seen: set[str]) -> None:
    if event.kind == SNAP:
        return
    shortening = 0.0 if event.state is None else event.state.shortening.value
    marker, colour, word = MARKS.get(event.kind, (".", GREY, "contact changes"))
    if event.kind in ("fold", "branch_point"):
        marker, colour, word = "s", WARN, "loses stability"
    label = word if word not in seen else None
    seen.add(word)
    ax.plot(
        1e3 * shortening, -event.force.value, marker, color=colour, ms=6 if marker != "." else 7, zorder=5, label=label
    )


def _snaps(ax: Any, result: LoadPath) -> None:
    """An arrow from where the rod gives way to where it comes to rest, at the same load."""
    runs = [run for leg in result.legs for run in leg.runs]
    square = result.problem.clearance**2
    lasts = {run[-1].load: run[-1].solved.out.energy_by_load * square for run in runs if run}
    for event in result.snaps:
        if event.state is None or event.to is None or not lasts:
            continue
        start = lasts[min(lasts, key=lambda load: abs(load - event.force.value))]
        end, load = event.state.shortening.value, -event.force.value
        ax.annotate(
            "", xy=(1e3 * end, load), xytext=(1e3 * start, load),
            arrowprops={"arrowstyle": "-|>", "color": WARN, "lw": 1.3, "shrinkA": 3, "shrinkB": 0},
        )  # fmt: skip
        turns = f", {abs(event.to.turns)} turn{'s' if abs(event.to.turns) > 1 else ''}" if event.to.turns else ""
        name = "falls back" if event.to.kind == STRAIGHT else f"snaps: {event.to.kind}{turns}"
        ax.annotate(
            name, xy=(1e3 * 0.5 * (start + end), load), xytext=(0, 4), textcoords="offset points",
            ha="center", fontsize=8.5, color=WARN,
        )  # fmt: skip
