"""Force and stress along the rod: against the local limits, and against the strength.

Measured depth grows downwards where the hole is inclined and the case has dimensions; else the rod lies along the
horizontal axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from rodwell.answers.data.along import Along
from rodwell.plots.sections import mark_steps
from rodwell.plots.style import ACTS, BUCKLES, GREY, INK, LIFTS_OFF, LIMIT, MODES, SIZE, new_axes, parameters
from rodwell.plots.units import axis
from rodwell.problem.problem import Problem
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain
from rodwell.strength.local import LocalLimits

COLOURS = {
    "at rest": GREY, "at buckling": BUCKLES, "at lift-off": LIFTS_OFF, "where it leaves the wall": LIFTS_OFF,
    "where it loses its stability": BUCKLES, "at the last load followed": INK,
}  # fmt: skip
PARTS = (MODES[2], MODES[3], MODES[4], GREY)
"""Parts of the stress: colours that mean no state."""


WORTH_A_LINE = 0.01
"""Parts of the stress below this part of the largest are not drawn."""


def upright(problem: Problem, scales: Scales | None) -> bool:
    """Whether depth is drawn downwards: an inclined or vertical hole, and a case with dimensions."""
    return scales is not None and problem.alpha < 90.0


def plot_force(
    states: Sequence[Along], scales: Scales | None = None, local: LocalLimits | None = None, ax: Any = None
) -> Any:
    """Draw the effective axial force along the rod in several states against the local limits; return the axes.

    With ``scales`` compression is positive, without them tension.
    """
    ax = new_axes() if ax is None else ax
    problem = states[0].state.problem
    down = upright(problem, scales)
    largest = max(float(np.max(np.abs(one.fields["rod_F1"]))) for one in states)
    ff, uf = axis("force", scales, largest)
    said, sign = Forces(scales, problem.hung_weight), 1.0 if scales is None else -1.0
    applied = 0
    for one in states:
        look: dict[str, Any] = {"color": COLOURS.get(one.state.name, ACTS), "lw": 1.4}
        if one.state.name not in COLOURS:
            mark = ("", "o", "s", "^")[applied % 4]
            look |= {"lw": 2.4, "marker": mark, "markevery": 0.2, "ms": 5.0}
            applied += 1
        label = f"{one.state.name}: {said.label(one.state.force)}{said.at_end}"
        _draw(ax, _places(one.s, scales, down), sign * one.fields["rod_F1"] * ff, down, label=label, **look)
    if local is not None and local.applies and scales is not None:
        for limit, label, colour in (
            (local.critical, "local: an endless rod buckles", BUCKLES),
            (local.lift_off, "local: an endless rod lifts off", LIFTS_OFF),
        ):
            if limit.compression is not None:
                line = ax.axvline if down else ax.axhline
                line(limit.compression.value / scales.factor("force") * ff, color=colour, lw=1.4, ls=LIMIT, label=label)
    mark_steps(ax, problem, axis("z", scales, 1.0)[0], down=down)
    _zero(ax, down)
    counted = "axial force" if scales is None else "compression"
    positive = "\n(tension positive)" if scales is None else "\n(below 0: tension)"
    _dress(ax, problem, scales, f"effective {counted}  [{uf}]{positive}")
    return ax


def plot_stress(one: Along, scales: Scales, strength: float | None = None, ax: Any = None) -> Any:
    """Draw axial, bending, hoop and torsion stress and the largest von Mises stress along the rod; return the axes.

    ``strength`` is the yield strength in Pa, the least of a string's; what the state has at each place is drawn. It
    must have stresses.
    """
    ax = new_axes() if ax is None else ax
    t, problem = one.stresses, one.state.problem
    if t is None:
        raise ValueError("the state has no stresses: the rod's section is not known")
    down = upright(problem, scales)
    size = max(float(np.max(np.abs(t.von_mises))), float(np.max(np.abs(t.axial))))
    unit, text = scales.system.unit("stress", size)
    place = _places(one.s, scales, down)
    shown = strength is not None and strength < 4.0 * size
    lines = [
        (t.axial, "axial (real force)", PARTS[0], "-"),
        (t.bending, "bending, outer surface, ±", PARTS[1], "-"),
        (t.torsion, "torsion (shear)", PARTS[2], "-"),
        (t.hoop_inner, "hoop, inner surface", PARTS[3], "-"),
    ]
    for values, label, colour, dashes in lines:
        if float(np.max(np.abs(values))) > WORTH_A_LINE * size:
            _draw(ax, place, values / unit, down, color=colour, lw=1.3, ls=dashes, label=label)
    peak = float(np.max(t.von_mises))
    mark_steps(ax, problem, axis("z", scales, 1.0)[0], down=down)
    label = f"von Mises, up to {plain(peak / unit, 3)} {text}"
    _draw(ax, place, t.von_mises / unit, down, color=INK, lw=2.4, label=label)
    if strength is not None and shown:
        values = np.full(one.s.shape, strength) if one.strength is None else one.strength
        _draw(ax, place, values / unit, down, color=INK, lw=1.6, ls=LIMIT, label="yield strength")
    elif strength is not None:
        label = f"yield strength, not shown: {plain(strength / unit, 3)} {text}"
        ax.plot([], [], color=INK, lw=1.6, ls=LIMIT, label=label)
    _zero(ax, down)
    _dress(ax, problem, scales, f"stress in the rod {one.state.name}  [{text}]\n(tension positive)")
    return ax


def plot_along(
    states: Sequence[Along],
    shown: Along,
    scales: Scales | None = None,
    local: LocalLimits | None = None,
    strength: float | None = None,
) -> Any:
    """Draw force, and stress in the state ``shown`` where it is known, in one figure; return the first axes."""
    problem = states[0].state.problem
    stressed = scales is not None and shown.stresses is not None
    down = upright(problem, scales)
    count = 2 if stressed else 1
    figure = Figure(figsize=(8.6, 6.4) if down else (SIZE[0], 3.4 * count), layout="constrained")
    FigureCanvasAgg(figure)
    axes = np.atleast_1d(figure.subplots(1, count, sharey=True) if down else figure.subplots(count, 1, sharex=True))
    plot_force(states, scales, local, ax=axes[0])
    if stressed:
        assert scales is not None
        plot_stress(shown, scales, strength, ax=axes[1])
        if down:
            axes[1].set_ylabel("")
            axes[0].child_axes[0].set_visible(False)  # the scale at the right stands once, at the right of both
        else:
            axes[0].set_xlabel("")
    axes[0].set_title(parameters(problem, scales), loc="left", fontsize=8.5)
    return axes[0]


def _places(s: Any, scales: Scales | None, down: bool) -> Any:
    """Depth below the upper end, or distance from the lower one."""
    factor = axis("z", scales, 1.0)[0]
    return (1.0 - s) * factor if down else s * factor


def _draw(ax: Any, place: Any, values: Any, down: bool, **style: Any) -> None:
    values = np.broadcast_to(values, place.shape)
    ax.plot(*((values, place) if down else (place, values)), **style)


def _zero(ax: Any, down: bool) -> None:
    (ax.axvline if down else ax.axhline)(0.0, color=GREY, lw=0.8)


def _dress(ax: Any, problem: Problem, scales: Scales | None, label: str) -> None:
    """Label the axes, the rod's end to end, and the legend below or beside."""
    length, unit = axis("z", scales, 1.0)
    if upright(problem, scales):
        ax.set_ylim(length, 0.0)
        ax.set_ylabel(f"depth along the hole, below the top s = 1  [{unit}]")
        beside = ax.secondary_yaxis("right", functions=(lambda y: length - y, lambda y: length - y))
        beside.set_ylabel(f"above the bottom s = 0  [{unit}]")
        beside.spines["right"].set_visible(True)
        ax.set_xlabel(label.replace("\n", " "))
        ax.locator_params(axis="x", nbins=6)
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=1)
        return
    ax.set_xlim(0.0, length)
    ax.set_xlabel(f"distance along the rod from s = 0  [{unit}]")
    ax.set_ylabel(label)
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
