"""Loads of pairs of modes over the weight: where they cross, modes switch, (77), (78)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rodwell.analysis.straight.modes import ModePair
from rodwell.physics.exact.horizontal import pair_loads, switching
from rodwell.plots.style import ACTS, GREY, MODES, new_axes
from rodwell.quantities.text import plain

POINTS = 241
FARTHER = 1.15
"""How far beyond the next switching the loads are drawn."""


def plot_pairs(pairs: Sequence[ModePair], weight: float, clearance: float, ax: Any = None) -> Any:
    """Draw the critical loads of pairs of modes over the weight, and where they switch; return the axes.

    Horizontal rod, both ends clamped, rod at the bottom; F in B/L² at s = 1, tension positive.
    """
    ax = new_axes() if ax is None else ax
    last = FARTHER * max(*(pair.after.weight for pair in pairs), weight)
    weights = last * np.linspace(0.0, 1.0, POINTS) ** 2  # finer where there are more of them
    switched = "modes switch"
    for pair in pairs:
        loads = np.array([pair_loads(pair.pair, math.sqrt(w / clearance)) for w in weights])
        colour = MODES[(pair.pair - 1) % len(MODES)]
        for which, (name, dashes) in enumerate((("even", "-"), ("odd", (0, (5, 2))))):
            label = f"modes {2 * pair.pair - 1}, {2 * pair.pair}: {name}"
            ax.plot(weights, loads[:, which], color=colour, lw=1.6, ls=dashes, label=label)
        m = pair.pair + 1
        while (at := switching(m - pair.pair, m + pair.pair, clearance)).weight <= last:
            ax.plot(at.weight, at.force, "o", color="white", mec=colour, ms=6, zorder=5, label=switched)
            switched, m = "_", m + 1
    ax.axvline(weight, color=ACTS, lw=1.2, label=f"γ = {plain(weight)}")
    ax.axhline(0.0, color=GREY, lw=0.8)
    ax.set_xlim(0.0, last)
    ax.set_xlabel("weight γ = mg L³/B")
    ax.set_ylabel("critical end force F at s = 1,\ntension positive  [B/L²]")
    ax.set_title(f"α = 90°,  Δ/L = {plain(clearance)},  both ends clamped", loc="left", fontsize=8.5)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3)
    return ax
