"""States of the endless rod over the load."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.endless.endless import Endless, states_over
from rodwell.analysis.endless.following import BUCKLING
from rodwell.analysis.endless.state import NUMBERS, PeriodicState
from rodwell.analysis.endless.waves import HELICAL, KINDS, SINUSOIDAL
from rodwell.errors import InputError
from rodwell.plots.style import GREY, INK, MODES, new_axes
from rodwell.quantities.value import Value

COLOURS = {SINUSOIDAL: MODES[0], HELICAL: MODES[1]}
FARTHEST, STEPS = 5.0, 76
"""Largest load drawn, unless the state asked for lies beyond, and how many loads."""

AT_LIFT_OFF = 1e-9
"""Least contact force in q that counts as none."""

LABELS = {
    "contact": "contact force per length  [q]",
    "frequency": "angular frequency along the rod  [1/ℓ]",
    "amplitude": "largest angle (helix: ripple)  [rad]",
    "energy": "energy per length  [qD]",
    "contact_mean": "mean contact force per length  [q]",
    "contact_largest": "largest contact force per length  [q]",
    "contact_least": "least contact force per length  [q]",
    "rate_largest": "largest rate of the angle  [rad/ℓ]",
    "curvature_largest": "largest curvature  [√(qD/B)]",
    "stress_factor": "largest curvature over DP/(2B)",
    "shortening": "shortening per length  [√(qD³/B)]",
}
STRAIGHT = {"energy": -1.0, "contact": 1.0, "contact_mean": 1.0, "contact_largest": 1.0, "contact_least": 1.0}
"""Numbers of the straight rod; the others vanish."""


def plot_endless(result: Endless, ax: Any = None, number: str = "contact") -> Any:
    """Draw a number of both states over β, or the range of the contact force; return the axes.

    Where the wall would have to pull, on paper only, lines are dotted. Thin lines mark the loads at which something
    happens; a state asked for is a dot.

    Raises
    ------
    InputError
        If there is no such number.
    """
    if number not in LABELS:
        raise InputError("number", number, f"must be one of {', '.join(LABELS)}")
    ax = new_axes() if ax is None else ax
    last = max(FARTHEST, 1.15 * (result.beta or 0.0))
    ax.plot([0.0, BUCKLING], [STRAIGHT.get(number, 0.0)] * 2, color=INK, lw=2.0, label="straight")
    ends = [load.value for load in (result.loads.sinusoidal_lift_off, result.loads.helix_lift_off) if load is not None]
    places = np.unique([BUCKLING + 1e-3, *np.linspace(BUCKLING, last, STEPS)[1:], *ends])
    for kind in KINDS:
        states = states_over(kind, result.slope, places)
        if states:
            _draw(ax, states, number, COLOURS[kind])
    for kind, state in result.states.items():
        ax.plot(state.beta, _value(state, number), "o", color=COLOURS[kind], mec=INK, ms=7, zorder=6)
    _mark(ax, result)
    ax.set_xlim(1.0, last)
    ax.set_xlabel("load  β = P/√(Bq/D),  compression positive")
    ax.set_ylabel(LABELS[number])
    slope = "small slopes" if result.slope == 0.0 else f"slope ε = {result.slope:g}"
    ax.set_title(f"Endless rod on the wall, {slope}", loc="left", fontsize=9.5)
    ax.legend(loc="upper left", frameon=True, facecolor="white", edgecolor="none", framealpha=1.0)
    return ax


def _draw(ax: Any, states: list[PeriodicState], number: str, colour: str) -> None:
    beta = np.array([state.beta for state in states])
    values = np.array([_value(state, number) for state in states])
    least = np.array([state.contact_least.value for state in states])
    pressed = least > -AT_LIFT_OFF
    ax.plot(beta, np.where(pressed, values, np.nan), color=colour, lw=2.0, label=states[0].kind)
    ax.plot(beta, np.where(pressed & (np.abs(least) > AT_LIFT_OFF), np.nan, values), color=colour, lw=1.2, ls=":")
    if number == "contact":
        largest = np.array([state.contact_largest.value for state in states])
        ax.fill_between(beta, least, largest, where=pressed, color=colour, alpha=0.15, lw=0)
        ax.axhline(0.0, color=GREY, lw=0.8)


def _value(state: PeriodicState, number: str) -> float:
    assert number == "contact" or number in NUMBERS
    known: Value = getattr(state, "contact_mean" if number == "contact" else number)
    return known.value


def _mark(ax: Any, result: Endless) -> None:
    """Lines at the loads at which something happens, named in the legend."""
    loads = result.loads
    for load, text, colour, dashes in (
        (loads.buckling, "buckles", INK, (4, 3)),
        (loads.helix_lift_off, "helix lifts off", COLOURS[HELICAL], (4, 3)),
        (loads.sinusoidal_helix_equal_energy, "both cost the same", GREY, (1, 1.5)),
        (loads.sinusoidal_lift_off, "sinusoidal lifts off", COLOURS[SINUSOIDAL], (4, 3)),
    ):
        if load is not None:
            ax.axvline(load.value, color=colour, lw=1.0, ls=(0, dashes), label=f"{text}, β = {load.value:.4g}")
