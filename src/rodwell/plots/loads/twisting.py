"""What twist does to a rod that is about to lift off."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.loads.torsion import Torsion
from rodwell.analysis.state.fields import GRID
from rodwell.plots.style import ACTS, BUCKLES, GREY, INK, LIFTS_OFF, new_axes, parameters
from rodwell.quantities.text import plain, signed

STATES = 4
"""How many twisted states are drawn."""


def plot_torsion(result: Torsion, ax: Any = None) -> Any:
    """Draw the contact pressure along the rod at its lift-off load, without twist and with it; return the axes.

    Tension is positive: the rod presses on the wall where the pressure is below 0.
    """
    ax = new_axes() if ax is None else ax
    lift, branch = result.prepared, result.branch
    s = np.linspace(0.0, 1.0, GRID)
    ax.plot(s, lift.solution.fields(s)["contact_pressure"], color=INK, lw=2.2, label="T₁ = 0")
    if branch is not None:
        end = float(branch.values[-1]) if result.again is None else result.again.value
        for number in range(1, STATES + 1):
            value = end * number / STATES
            last = number == STATES and result.again is not None
            state = result.again.solution if last and result.again is not None else branch.at(value)
            colour = LIFTS_OFF if last else BUCKLES
            label = f"T₁ = {signed(value, 4)}" + (": lifts off again" if last else "")
            pressure = state.fields(s)["contact_pressure"]
            ax.plot(
                s, pressure, color=colour, lw=2.2 if last else 1.0, ls=(0, (5, 2)) if last else "-",
                alpha=1.0 if last else 0.25 + 0.75 * number / STATES, label=label,
            )  # fmt: skip
    for place in lift.s:
        ax.axvline(place, color=GREY, lw=0.8, ls=(0, (2, 2)), zorder=0)
    ax.axhline(0.0, color=ACTS, lw=1.0)
    ax.set_xlim(0.0, 1.0)
    ax.set_xlabel("distance along the rod from s = 0  [L]")
    ax.set_ylabel("contact pressure p, below 0 where the rod\npresses on the wall  [B/L³]")
    title = f"{parameters(result.problem)},  F = {plain(lift.force, 7)} B/L² at s = 1"
    ax.set_title(title, loc="left", fontsize=8.5)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=5, title="twisting moment at s = 1  [B/L]")
    return ax
