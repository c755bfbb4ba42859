"""Limit lines of a well against depth, depth downwards."""

from __future__ import annotations

from itertools import cycle
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from rodwell.plots.style import ACTS, BUCKLES, FORMULA, GREY, INK, LIFTS_OFF, MODES, RC, WARN
from rodwell.quantities.text import plain
from rodwell.studies.well.screening import BESIDE, Screening
from rodwell.studies.well.verdict import units

LINES = ((MODES[2], FORMULA), (MODES[3], FORMULA), (MODES[4], FORMULA))
"""Colours and dashes of the formulas, in turn."""


def plot_screening(screening: Screening) -> Figure:
    """Draw inclination, and exact loads beside the formulas' and the string's force, against measured depth.

    Compression grows to the right, depth downwards, in the survey's unit of depth. Returns the figure.
    """
    depth, metre, force, newton = units(screening)
    md = screening.survey.md / metre
    with mpl.rc_context(RC):
        figure = Figure(figsize=(7.6, 7.0), layout="constrained")
        FigureCanvasAgg(figure)
        left, right = figure.subplots(1, 2, sharey=True, width_ratios=(1, 3.4))
        left.plot(screening.survey.inclination, md, color=INK, lw=1.5)
        left.set_xlabel("inclination from\nthe vertical  [°]")
        left.set_ylabel(f"measured depth  [{depth}]")
        left.set_xlim(left=0.0)
        _limit_lines(right, screening, md, newton)
        if screening.compression is not None:
            right.plot(screening.compression / newton, md, color=ACTS, lw=2.6, label="the string")
            right.axvline(0.0, color=GREY, lw=0.8)
        _mark(right, screening, md, newton)
        right.set_xlabel(f"compression  [{force}]")
        right.set_xlim(*_limits(screening, newton))
        right.set_ylim(float(md[-1]), float(md[0]))
        right.legend(loc="upper center", bbox_to_anchor=(0.38, -0.085), ncols=2)
        figure.suptitle(screening.case.title, x=0.01, ha="left", fontsize=10)
        return figure


def _limit_lines(ax: Any, screening: Screening, md: Any, newton: float) -> None:
    """Exact loads with bands of their errors, and the formulas."""
    for loads, label, colour in (
        (screening.critical, "exact: buckles", BUCKLES),
        (screening.lift_off, "exact: leaves the wall", LIFTS_OFF),
    ):
        values, errors = loads.values / newton, loads.errors / newton
        ax.fill_betweenx(md, values - errors, values + errors, color=colour, alpha=0.25, lw=0)
        ax.plot(values, md, color=colour, lw=2.0, label=label)
    if np.any(np.isfinite(screening.bent.values)):
        bent = screening.bent.values / newton
        ax.plot(bent, md, color=BUCKLES, lw=2.0, ls=(0, (1, 0.6)), marker=".", ms=3, label="exact, in the hole's build")
    for key, (colour, dashes) in zip(screening.formulas, cycle(LINES), strict=False):
        ax.plot(screening.formulas[key] / newton, md, color=colour, lw=1.3, ls=dashes, label=BESIDE[key].name)


def _mark(ax: Any, screening: Screening, md: Any, newton: float) -> None:
    """Mark the worst station: largest utilisation, or else the least critical load."""
    worst = screening.worst
    i, x, label = screening.weakest, screening.limit[0], "weakest station"
    if worst is not None and screening.compression is not None and screening.utilisation is not None:
        i, x = worst, screening.compression
        label = f"largest utilisation, {plain(100.0 * float(screening.utilisation[worst]), 3)} %"
    ax.plot(x[i] / newton, md[i], "o", color=WARN, mec=INK, ms=7, zorder=6, clip_on=False, label=label)


def _limits(screening: Screening, newton: float) -> tuple[float, float]:
    """Range of compression: what decides fills it; far tension, and formulas far beyond, are cut."""
    exact = np.concatenate([screening.critical.values, screening.lift_off.values, screening.bent.values])
    high = 1.15 * float(np.nanmax(exact))
    low = 0.0
    if screening.compression is not None:
        high = max(high, 1.05 * float(screening.compression.max()))
        low = max(min(0.0, 1.05 * float(screening.compression.min())), -0.6 * high)
    return low / newton, high / newton
