"""Formulas of practice beside exact loads: error charts, Fig. 13 of the paper, the numbers of the vertical string."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from rodwell.formulas import FORMULAS
from rodwell.formulas.record import Place
from rodwell.plots.style import FORMULA, GREY, INK, LIMIT, MODES, RC, new_axes
from rodwell.problem.words import ends_text
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.text import minus, plain
from rodwell.studies.audit.error_map import PANELS, ErrorMap

LEVELS = (-75.0, -50.0, -25.0, -10.0, 0.0, 10.0, 25.0, 50.0, 100.0)
COLOURS = ("#08427a", "#2f79b5", "#6fa9d2", "#aacde5", "#dcebf4", "#fde8d8", "#f8bf98", "#ec8b5e", "#cf4a32", "#8f1014")
"""Blue: the formula's load is below the exact one; red: above; one colour below, between and above the levels."""

CLIP = 150.0
"""Errors above are drawn as this, so that lines between grid points lie where they should."""

PLACE = {"top": "top, s = 1", "middle": "middle", "bottom": "bottom, s = 0"}
SHORT = {"dawson_paslay": "Dawson–Paslay", "dellinger": "Dellinger (89)", "paslay_bogy": "Paslay–Bogy",
         "chen_lin_cheatham": "Chen, helical"}  # fmt: skip


def plot_error_map(chart: ErrorMap, panels: Sequence[tuple[str, Place]] = PANELS) -> Figure:
    """Draw the error of formulas as onset loads over weight and inclination, a panel each. Returns the figure.

    Blue: the formula's load is below the exact first critical load at its place; red: above it. The case is marked.
    """
    with mpl.rc_context(RC):
        rows = (len(panels) + 2) // 3
        figure = Figure(figsize=(9.6, 2.9 * rows + 0.7), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(rows, min(3, len(panels)), sharex=True, sharey=True, squeeze=False).ravel()
        colours = mpl.colors.ListedColormap(COLOURS[1:-1]).with_extremes(under=COLOURS[0], over=COLOURS[-1])
        norm = mpl.colors.BoundaryNorm(LEVELS, len(COLOURS) - 2)
        shown: Any = None
        for ax, (key, place) in zip(axes, panels, strict=False):
            percent = np.minimum(chart.percent(key, place), CLIP)
            shown = ax.contourf(chart.weights, chart.alphas, percent, LEVELS, cmap=colours, norm=norm, extend="both")
            if percent.min() < 0.0 < percent.max():
                ax.contour(chart.weights, chart.alphas, percent, [0.0], colors=INK, linewidths=1.2)
            _mark(ax, chart)
            ax.set_xscale("log")
            ax.set_title(f"{SHORT.get(key, FORMULAS[key].name)}, force at {PLACE[place]}", loc="left", fontsize=8.5)
        for ax in axes[len(panels) :]:
            ax.set_visible(False)
        for ax in axes[:: min(3, len(panels))]:
            ax.set_ylabel("α from the vertical  [°]")
        for ax in axes[max(0, len(panels) - 3) : len(panels)]:
            ax.set_xlabel("weight γ = mg L³/B")
            ax.tick_params(labelbottom=True)
        bar = figure.colorbar(shown, ax=axes.tolist(), ticks=LEVELS, shrink=0.9, aspect=30, pad=0.015)
        bar.set_label("formula / exact first critical load − 1  [%]\n← below it          above it, unsafe →")
        bar.ax.set_yticklabels([minus(f"{level:+.0f}").replace("+0", "0") for level in LEVELS])
        figure.suptitle(
            f"Δ/L = {plain(chart.problem.clearance)},  {ends_text(chart.problem)}", x=0.01, ha="left", fontsize=9.5
        )
        return figure


def _mark(ax: Any, chart: ErrorMap) -> None:
    """Mark the case where it lies in the chart."""
    ax.grid(visible=False)
    ax.set_xlim(chart.weights[0], chart.weights[-1])
    ax.set_ylim(chart.alphas[0], chart.alphas[-1])
    ax.set_yticks([t for t in (0, 15, 30, 45, 60, 75, 90) if chart.alphas[0] <= t <= chart.alphas[-1]])
    if chart.weights[0] <= chart.problem.weight <= chart.weights[-1]:
        ax.plot(chart.problem.weight, chart.problem.alpha, marker="*", ms=13, color="#ffd23f", mec=INK, mew=0.9,
                clip_on=False, zorder=6)  # fmt: skip


def plot_dellinger(chart: ErrorMap, ax: Any = None) -> Any:
    """Draw Fig. 13 of the paper: critical compression −F at s = 1 over weight (solid), Dellinger's fit (89) dashed.

    One colour for each inclination of ``chart``. Returns the axes.
    """
    ax = new_axes() if ax is None else ax
    for i in reversed(range(len(chart.alphas))):
        colour, alpha = MODES[i % len(MODES)], float(chart.alphas[i])
        exact = chart.exact("top")[i]
        fit = [FORMULAS["dellinger"].function(1.0, w, alpha, chart.problem.clearance) for w in chart.weights]
        ax.plot(chart.weights, exact, color=colour, lw=1.8, label=f"exact, α = {plain(alpha)}°")
        ax.plot(chart.weights, fit, color=colour, lw=1.4, ls=FORMULA, label=f"(89), α = {plain(alpha)}°")
    ax.axhline(0.0, color=INK, lw=0.8)
    ax.set_xlabel("weight γ = mg L³/B")
    ax.set_ylabel("critical compression −F at s = 1  [B/L²]")
    ax.set_title(f"Δ/L = {plain(chart.problem.clearance)},  {ends_text(chart.problem)}", loc="left", fontsize=9.5)
    ax.margins(x=0.01)
    ax.legend(ncols=1, loc="center left", bbox_to_anchor=(1.01, 0.5))
    return ax


def plot_hanging(
    curves: Mapping[str, tuple[FloatArray, FloatArray]], lines: Mapping[str, float], ax: Any = None
) -> Any:
    """Draw the coefficient of (B w²)^⅓ in the bit load over the length X of the string. Returns the axes.

    Parameters
    ----------
    curves
        X (n,) and coefficient (n,) by label.
    lines
        Numbers of practice by label, drawn across.
    ax
        Axes; new if not given.
    """
    ax = new_axes() if ax is None else ax
    for i, (label, (size, coefficient)) in enumerate(curves.items()):
        ax.plot(size, coefficient, color=MODES[i % len(MODES)], lw=1.8, label=label)
    for label, value in lines.items():
        ax.axhline(value, color=GREY, lw=1.0, ls=LIMIT)
        ax.annotate(label, (1.0, value), xycoords=("axes fraction", "data"), xytext=(4, 0), textcoords="offset points",
                    va="center", fontsize=8.5, color=INK, annotation_clip=False)  # fmt: skip
    ax.set_xscale("log")
    ax.set_xlabel(r"length of the string $X = L/(B/w)^{1/3}$")
    ax.set_ylabel(r"compression at the bit / $(B w^2)^{1/3}$")
    ax.legend(loc="upper right")
    return ax
