"""Shapes and contact pressure along the rod."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.plots.extent import drawn_places, shown_part, straight_beyond
from rodwell.plots.string import mark_steps
from rodwell.plots.style import GREY, INK, MODES, SIZE, WARN, new_axes
from rodwell.plots.units import axis
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import minus, plain

SHOWN = 5
"""States between buckling and lift-off of which the contact pressure is drawn."""


def plot_modes(critical: CriticalLoads, scales: Scales | None = None, ax: Any = None, most: int = 4) -> Any:
    """Draw the buckling modes y(s), each scaled to a largest deflection of 1; return the axes."""
    ax = new_axes() if ax is None else ax
    part = shown_part(critical[:most])
    s = drawn_places(critical[:most], part)
    fs, us = axis("z", scales, part)
    forces = critical.forces[:most]
    ff, uf = axis("force", scales, float(np.max(np.abs(forces))))
    for mode in critical[:most]:
        ax.plot(
            s * fs, mode.shape(s), color=MODES[mode.number - 1], lw=2.2 if mode.number == 1 else 1.3,
            label=minus(f"mode {mode.number}: F = {plain(mode.force * ff, 4)} {uf}"),
        )  # fmt: skip
    mark_steps(ax, critical[0].problem, fs)
    ax.axhline(0.0, color=INK, lw=0.8)
    ax.set_xlim(0.0, part * fs)
    ax.set_ylim(-1.25, 1.55)
    ax.set_xlabel(f"distance along the rod from s = 0{straight_beyond(part)}  [{us}]")
    ax.set_ylabel("sideways deflection y, scaled")
    ax.legend(loc="upper center", ncols=2)
    return ax


def states_to_lift_off(branch: Branch, count: int = SHOWN) -> list[Solution]:
    """States of a branch from buckling to lift-off, evenly spread in load; to its end if it has no lift-off."""
    lift = branch.lift_off
    if lift is None or branch.lift_off_at_buckling:
        picks = np.linspace(1, len(branch) - 1, min(count, len(branch) - 1)).round().astype(int)
        return [branch[int(i)] for i in dict.fromkeys(picks)]
    start = branch.force[0]
    forces = start + (lift.force - start) * np.linspace(0.0, 1.0, count)
    inner = [branch.at(float(f)) for f in forces[1:-1]]
    return [branch[0], *inner, lift.solution]


def plot_contact_pressure(
    branch: Branch, scales: Scales | None = None, ax: Any = None, states: Sequence[Solution] | None = None
) -> Any:
    """Draw the contact pressure p along the rod at several loads, from buckling to lift-off; return the axes."""
    ax = new_axes() if ax is None else ax
    states = states_to_lift_off(branch) if states is None else states
    part = shown_part(states)
    s = drawn_places(states, part)
    pressures = [state.fields(s)["contact_pressure"] for state in states]
    fs, us = axis("z", scales, part)
    fp, up = axis("contact_pressure", scales, max(float(np.max(np.abs(p))) for p in pressures))
    ff, uf = axis("force", scales, max(abs(state.force) for state in states))
    for state, pressure, color in zip(states, pressures, _shades(len(states)), strict=True):
        label = minus(f"F = {plain(state.force * ff, 4)} {uf}")
        ax.plot(s * fs, pressure * fp, color=color, lw=1.5, label=label)
    mark_steps(ax, branch.problem, fs)
    _lift_off_marks(ax, branch, fs, part)
    low, high = ax.get_ylim()
    high = max(high, -0.12 * low)
    ax.axhspan(0.0, 10.0 * abs(low) + 10.0 * high, color=WARN, alpha=0.07, lw=0)
    ax.axhline(0.0, color=WARN, lw=1.0)
    ax.set_ylim(low, high)
    ax.set_xlim(0.0, part * fs)
    place = _free_place(branch, part)
    ax.text(
        place * part * fs,
        0.5 * high,
        "the wall would have to pull",
        color=WARN,
        ha={0.005: "left", 0.5: "center", 0.995: "right"}[place],
        va="center",
        fontsize=8.5,
    )
    ax.set_xlabel(f"distance along the rod from s = 0{straight_beyond(part)}  [{us}]")
    ax.set_ylabel(f"contact pressure p  [{up}]\n(below 0: pressed on the wall)")
    _legend(ax)
    return ax


def _free_place(branch: Branch, part: float) -> float:
    """Where a remark stands farthest from lift-off, as a share of the ``part`` shown: at the right, if that will do."""
    lift = branch.lift_off
    marked = () if lift is None or branch.lift_off_at_buckling else [s / part for s in lift.s]
    return max((0.995, 0.005, 0.5), key=lambda place: min((min(abs(place - s), 0.3) for s in marked), default=1.0))


def _lift_off_marks(ax: Any, branch: Branch, fs: float, part: float) -> None:
    lift = branch.lift_off
    if lift is None or branch.lift_off_at_buckling:
        return
    for s in lift.s:
        ax.plot([s * fs], [0.0], "o", color=WARN, mec="white", ms=7, zorder=6, clip_on=False)
        side = "left" if s < 0.05 * part else "right" if s > 0.95 * part else "center"
        ax.annotate(
            "lift-off",
            (s * fs, 0.0),
            xytext=({"left": 4, "center": 0, "right": -4}[side], 9),
            textcoords="offset points",
            ha=side,
            color=WARN,
            fontsize=8.5,
        )


def plot_torque(states: Sequence[Solution], scales: Scales | None = None, ax: Any = None, legend: bool = True) -> Any:
    """Draw the twisting moment T₂ in the cylinder along its length (paper, Fig. 4(b)); return the axes."""
    ax = new_axes() if ax is None else ax
    part = shown_part(states)
    s = drawn_places(states, part)
    curves = [state.fields(s)["T2"] for state in states]
    fs, us = axis("z", scales, part)
    ft, ut = axis("T2", scales, max(float(np.max(np.abs(c))) for c in curves))
    ff, uf = axis("force", scales, max(abs(state.force) for state in states))
    for state, curve, color in zip(states, curves, _shades(len(states)), strict=True):
        ax.plot(s * fs, curve * ft, color=color, lw=1.5, label=minus(f"F = {plain(state.force * ff, 4)} {uf}"))
    mark_steps(ax, states[0].problem, fs)
    ax.axhline(0.0, color=GREY, lw=0.8)
    ax.set_xlim(0.0, part * fs)
    ax.set_xlabel(f"distance along the rod from s = 0{straight_beyond(part)}  [{us}]")
    ax.set_ylabel(f"twisting moment T₂\nin the cylinder  [{ut}]")
    if not any(np.any(curve) for curve in curves):
        ax.set_yticks([0.0])
        ax.text(0.5, 0.6, "none: no lateral weight", color=GREY, ha="center", transform=ax.transAxes)
    if legend:
        _legend(ax)
    return ax


def plot_wall_loads(branch: Branch, scales: Scales | None = None) -> Any:
    """Draw contact pressure above twisting moment in the cylinder, at the same loads; return the upper axes."""
    states = states_to_lift_off(branch)
    upper = new_axes(size=(SIZE[0], 6.2), nrows=2, index=1)
    lower = upper.figure.add_subplot(2, 1, 2, sharex=upper)
    plot_contact_pressure(branch, scales, ax=upper, states=states)
    plot_torque(states, scales, ax=lower, legend=False)
    upper.set_xlabel("")
    return upper


def _shades(count: int) -> Any:
    """Colours of successive states, light to dark."""
    return mpl.colormaps["viridis"](np.linspace(0.85, 0.0, count))


def _legend(ax: Any) -> None:
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), title="end force at s = 1\n(tension positive)")
