"""How much loads change with each input."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rodwell.analysis.loads.derivatives import Sensitivity
from rodwell.plots.style import BUCKLES, INK, LIFTS_OFF, new_axes, parameters
from rodwell.quantities.text import signed

INPUTS = {
    "weight_per_length": "1 % more weight\nper length",
    "clearance": "1 % more\nclearance Δ",
    "stiffness": "1 % more\nstiffness B",
    "length": "1 % more\nlength L",
    "alpha": "1° more from\nthe vertical",
    "build": "1 % more curvature\nof the hole",
    "walk": "1 % more turn\nof the hole",
}
"""What is changed, the other inputs constant, where a load has a change by it."""

BAR = 0.38
"""Height of a bar, the inputs being 1 apart."""


def plot_sensitivities(loads: Sequence[Sensitivity], ax: Any = None) -> Any:
    """Draw the change of each load in percent for a little more of each input, as bars; return the axes.

    A load that is zero has no change in percent: it is left out, and the title says so.
    """
    ax = new_axes() if ax is None else ax
    shown = [load for load in loads if load.force != 0.0]
    told = [name for name in INPUTS if all(name in load.elasticities() for load in shown)]
    places = np.arange(len(told), dtype=float)
    bars = []
    for number, load in enumerate(shown):
        changes = load.elasticities()
        values = [changes[name].value for name in told]
        colour = LIFTS_OFF if load.name.startswith("lift-off") else BUCKLES
        at = places + (number - 0.5 * (len(shown) - 1)) * BAR
        hatch = "" if number == 0 else "///"  # a second cue beside the colour
        label = f"{load.name}, F = {signed(load.force, 6)} B/L²"
        bars.append(ax.barh(at, values, 0.92 * BAR, color=colour, alpha=0.85, hatch=hatch, ec="white", label=label))
    for group in bars:
        ax.bar_label(group, [signed(bar.get_width(), 3) for bar in group], padding=4, fontsize=8.5)
    ax.axvline(0.0, color=INK, lw=0.8)
    ax.margins(x=0.16)
    ax.set_axisbelow(True)
    ax.set_yticks(places, [INPUTS[name] for name in told])
    ax.invert_yaxis()
    ax.grid(visible=False, axis="y")
    ax.set_xlabel("change of the end force at s = 1 in percent; above 0 it grows in size")
    ax.set_title(parameters(loads[0].problem), loc="left", fontsize=8.5)
    if shown:
        ax.legend(loc="upper center", bbox_to_anchor=(0.4, -0.14), ncols=1)
    if len(shown) < len(loads):
        names = " and ".join(load.name for load in loads if load.force == 0.0)
        ax.text(0.5, 0.5, f"{names}: zero, so no change in percent", transform=ax.transAxes, ha="center")
    return ax
