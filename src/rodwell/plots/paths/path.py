"""A load path: load against shortening, with events, snaps and the loop."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.off_wall.state import STRAIGHT
from rodwell.analysis.path.events import CRITICAL, LIFT_OFF, SNAP, UNLOADING, PathPoint
from rodwell.analysis.path.load_path import LoadPath
from rodwell.case.case import Case
from rodwell.plots.paths.axes import Units, across_of, units_of
from rodwell.plots.style import GREY, INK, MODES, WARN, bends, new_axes
from rodwell.problem.words import ends_text
from rodwell.quantities.text import minus

MARKS = {CRITICAL: ("o", INK, "buckles"), LIFT_OFF: ("^", MODES[1], "lifts off")}
"""Marker, colour and word of events that are named; other changes of contact are small dots."""

LOADED, UNLOADED = MODES[0], MODES[2]


def plot_path(result: LoadPath, ax: Any = None, case: Case | None = None) -> Any:
    """Draw compression against the shortening of the span, or where the driven end stands if something gives way.

    Snaps are arrows. Returns the axes. Without a case compression at s = 1 in B/L²; with one in its units, at the end
    at which it says forces.
    """
    ax = new_axes() if ax is None else ax
    curve, names, units = result.curve, _legs(result), units_of(result, case)
    across = across_of(result, curve["shortening"], curve["force"])
    for run in np.unique(curve["run"]):
        here = curve["run"] == run
        unloading = names[int(run)] == UNLOADING if int(run) < len(names) else True
        loads = [units.load(force) for force in curve["force"][here]]
        ax.plot(
            units.shortening * across[here], loads, color=UNLOADED if unloading else LOADED,
            lw=1.8, ls="--" if unloading else "-",
        )  # fmt: skip
    ax.plot([], [], color=LOADED, lw=1.8, label="load grows")
    if result.unload_to is not None:
        ax.plot([], [], color=UNLOADED, lw=1.8, ls="--", label="load is taken off")
    seen: set[str] = set()
    for event in result.events:
        _mark(ax, result, event, seen, units)
    _snaps(ax, result, units)
    ax.set_xlabel(units.across)
    ax.set_ylabel(units.up)
    problem = result.problem
    more = [f"T₁ = {problem.twist:g} B/L"] if problem.twist else []
    parts = [f"γ = {problem.weight:g}, α = {problem.alpha:g}°, Δ/L = {problem.clearance:g}", *more]
    title = ", ".join([*parts, *bends(problem).values(), ends_text(problem)])
    ax.set_title(minus(title), loc="left", fontsize=9.5)
    ax.margins(x=0.03, y=0.05)
    ax.legend(loc="best")
    return ax


def _legs(result: LoadPath) -> list[str]:
    """The leg that each run belongs to, in the order of the curve."""
    return [leg.name for leg in result.legs for _ in leg.runs]


def _mark(ax: Any, result: LoadPath, event: PathPoint, seen: set[str], units: Units) -> None:
    if event.kind == SNAP:
        return
    shortening = 0.0 if event.state is None else event.state.shortening.value
    marker, colour, word = MARKS.get(event.kind, (".", GREY, "contact changes"))
    if event.kind in ("fold", "branch_point"):
        marker, colour, word = "s", WARN, "loses stability"
    label = word if word not in seen else None
    seen.add(word)
    ax.plot(
        units.shortening * across_of(result, shortening, event.force.value),
        units.load(event.force.value),
        marker,
        color=colour,
        ms=6 if marker != "." else 7,
        zorder=5 if marker == "." else 6,  # a change of contact close by does not hide what has a name
        label=label,
    )


def _snaps(ax: Any, result: LoadPath, units: Units) -> None:
    """An arrow from where the rod gives way to where it comes to rest: at the same load, or as driven."""
    runs = [run for leg in result.legs for run in leg.runs]
    square = result.problem.clearance**2
    lasts = {
        run[-1].load: across_of(result, run[-1].solved.out.energy_by_load * square, run[-1].load) for run in runs if run
    }
    for event in result.snaps:
        if event.state is None or event.to is None or not lasts:
            continue
        start = lasts[min(lasts, key=lambda load: abs(load - event.force.value))]
        end = across_of(result, event.state.shortening.value, event.to.force.value)
        load, rests = map(units.load, (event.force.value, event.to.force.value))
        ax.annotate(
            "", xy=(units.shortening * end, rests), xytext=(units.shortening * start, load),
            arrowprops={"arrowstyle": "-|>", "color": WARN, "lw": 1.3, "shrinkA": 3, "shrinkB": 0},
        )  # fmt: skip
        turns = f", {abs(event.to.turns)} turn{'s' if abs(event.to.turns) > 1 else ''}" if event.to.turns else ""
        name = "falls back" if event.to.kind == STRAIGHT else f"snaps: {event.to.kind}{turns}"
        ax.annotate(
            name, xy=(units.shortening * 0.5 * (start + end), 0.5 * (load + rests)), xytext=(0, 4),
            textcoords="offset points", ha="center", fontsize=8.5, color=WARN,
        )  # fmt: skip
