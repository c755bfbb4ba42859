"""Shapes and contact pressure along the rod."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np

from rodwell.analysis.branch.branch import Branch, states_to_lift_off
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.plots.extent import drawn_places, shown_part, straight_beyond
from rodwell.plots.sections import mark_steps
from rodwell.plots.style import GREY, INK, SIZE, WARN, in_lines, marked, new_axes, parameters
from rodwell.plots.units import axis
from rodwell.problem.words import counted_around
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales


def plot_modes(critical: CriticalLoads, scales: Scales | None = None, ax: Any = None, most: int = 4) -> Any:
    """Draw the buckling modes y(s), each scaled to a largest deflection of 1; return the axes."""
    ax = new_axes() if ax is None else ax
    part = shown_part(critical[:most])
    s = drawn_places(critical[:most], part)
    fs, us = axis("z", scales, part)
    said = Forces(scales, critical[0].problem.hung_weight)
    for mode in critical[:most]:
        ax.plot(
            s * fs, mode.shape(s), lw=2.2 if mode.number == 1 else 1.3,
            label=f"mode {mode.number}: {said.label(mode.force)}", **marked(mode.number - 1),
        )  # fmt: skip
    mark_steps(ax, critical[0].problem, fs)
    ax.axhline(0.0, color=INK, lw=0.8)
    ax.set_xlim(0.0, part * fs)
    ax.set_ylim(-1.25, 1.55)
    ax.set_xlabel(f"distance along the rod from s = 0{straight_beyond(part)}  [{us}]")
    ax.set_ylabel("sideways deflection y, scaled")
    ax.legend(loc="upper center", ncols=2, title=said.legend.replace("\n", " "))
    ax.set_title(parameters(critical[0].problem, scales), loc="left", fontsize=8.5)
    return ax


def plot_contact_pressure(
    branch: Branch, scales: Scales | None = None, ax: Any = None, states: Sequence[Solution] | None = None
) -> Any:
    """Draw the contact pressure p along the rod at several loads, from buckling to lift-off; return the axes."""
    ax = new_axes() if ax is None else ax
    states = states_to_lift_off(branch) if states is None else states
    part = shown_part(states)
    s = drawn_places(states, part)
    sign = 1.0 if scales is None else -1.0  # engineers count the push on the wall
    pressures = [sign * state.fields(s)["contact_pressure"] for state in states]
    fs, us = axis("z", scales, part)
    fp, up = axis("contact_pressure", scales, max(float(np.max(np.abs(p))) for p in pressures))
    said = Forces(scales, branch.problem.hung_weight)
    for state, pressure, color in zip(states, pressures, _shades(len(states)), strict=True):
        ax.plot(s * fs, pressure * fp, color=color, lw=1.5, label=said.label(state.force))
    mark_steps(ax, branch.problem, fs)
    _lift_off_marks(ax, branch, fs, part, sign)
    low, high = sorted(sign * edge for edge in ax.get_ylim())  # pressed below, pulled above 0
    high = max(high, -0.12 * low)
    ax.axhspan(0.0, sign * (10.0 * abs(low) + 10.0 * high), color=WARN, alpha=0.07, lw=0)
    ax.axhline(0.0, color=WARN, lw=1.0)
    ax.set_ylim(*sorted((sign * low, sign * high)))
    ax.set_xlim(0.0, part * fs)
    place = _free_place(branch, part)
    ax.text(
        place * part * fs,
        sign * 0.5 * high,
        "the wall would have to pull",
        color=WARN,
        ha={0.005: "left", 0.5: "center", 0.995: "right"}[place],
        va="center",
        fontsize=8.5,
    )
    ax.set_xlabel(f"distance along the rod from s = 0{straight_beyond(part)}  [{us}]")
    name = "contact pressure p" if scales is None else "push on the wall"
    where = "below 0: pressed on the wall" if scales is None else "above 0: pressed on it"
    ax.set_ylabel(f"{name}  [{up}]\n({where})")
    _legend(ax, said)
    return ax


def _free_place(branch: Branch, part: float) -> float:
    """Where a remark stands farthest from lift-off, as a share of the ``part`` shown: at the right, if that will do."""
    lift = branch.lift_off
    marked = () if lift is None or branch.lift_off_at_buckling else [s / part for s in lift.s]
    return max((0.995, 0.005, 0.5), key=lambda place: min((min(abs(place - s), 0.3) for s in marked), default=1.0))


def _lift_off_marks(ax: Any, branch: Branch, fs: float, part: float, sign: float) -> None:
    lift = branch.lift_off
    if lift is None or branch.lift_off_at_buckling:
        return
    for s in lift.s:
        ax.plot([s * fs], [0.0], "o", color=WARN, mec="white", ms=7, zorder=6, clip_on=False)
        side = "left" if s < 0.05 * part else "right" if s > 0.95 * part else "center"
        ax.annotate(
            "lift-off",
            (s * fs, 0.0),
            xytext=({"left": 4, "center": 0, "right": -4}[side], 9 if sign > 0.0 else -17),
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
    said = Forces(scales, states[0].problem.hung_weight)
    for state, curve, color in zip(states, curves, _shades(len(states)), strict=True):
        ax.plot(s * fs, curve * ft, color=color, lw=1.5, label=said.label(state.force))
    mark_steps(ax, states[0].problem, fs)
    ax.axhline(0.0, color=GREY, lw=0.8)
    ax.set_xlim(0.0, part * fs)
    ax.set_xlabel(f"distance along the rod from s = 0{straight_beyond(part)}  [{us}]")
    ax.set_ylabel(f"twisting moment T₂\nin the cylinder  [{ut}]")
    if not any(np.any(curve) for curve in curves):
        ax.set_yticks([0.0])
        ax.text(0.5, 0.6, "none: no lateral weight", color=GREY, ha="center", transform=ax.transAxes)
    if legend:
        _legend(ax, said)
    return ax


def plot_around(states: Sequence[Solution], scales: Scales | None = None, ax: Any = None, legend: bool = True) -> Any:
    """Draw the angle around the hole at which the rod lies along its length; return the axes."""
    ax = new_axes() if ax is None else ax
    part = shown_part(states)
    s = drawn_places(states, part)
    fs, us = axis("z", scales, part)
    said = Forces(scales, states[0].problem.hung_weight)
    for state, color in zip(states, _shades(len(states)), strict=True):
        ax.plot(s * fs, np.degrees(state.fields(s)["xi2"]), color=color, lw=1.5, label=said.label(state.force))
    ax.axhline(180.0 if states[0].problem.on_top else 0.0, color=GREY, lw=0.8)
    ax.set_xlim(0.0, part * fs)
    ax.set_xlabel(f"distance along the rod from s = 0{straight_beyond(part)}  [{us}]")
    ax.set_ylabel(f"angle around the hole\nfrom the {counted_around(states[0].problem)[0]} side  [°]")
    if legend:
        _legend(ax, said)
    return ax


def plot_wall_loads(branch: Branch, scales: Scales | None = None, states: Sequence[Solution] | None = None) -> Any:
    """Draw contact pressure above twisting moment in the cylinder, at the same loads; return the upper axes.

    In a curved hole, or where the clearance varies, above the angle around the hole: which part of the wall bears it.
    """
    states = states_to_lift_off(branch) if states is None else states
    upper = new_axes(size=(SIZE[0], 6.2), nrows=2, index=1)
    lower = upper.figure.add_subplot(2, 1, 2, sharex=upper)
    plot_contact_pressure(branch, scales, ax=upper, states=states)
    in_cylinder = branch.problem.hole is None and not branch.problem.ramps
    below = plot_torque if in_cylinder else plot_around
    below(states, scales, ax=lower, legend=False)
    upper.set_xlabel("")
    upper.set_title(in_lines(parameters(branch.problem, scales), 100), loc="left", fontsize=8.5)
    return upper


def _shades(count: int) -> Any:
    """Colours of successive states, light to dark; not so dark that they vanish on a dark page."""
    return mpl.colormaps["viridis"](np.linspace(0.85, 0.22, count))


def _legend(ax: Any, said: Forces) -> None:
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), title=said.legend)
