"""Fig. 4, 7 and 10: fields along the rod; the determinant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from rodwell.analysis.branch.solution import Solution
from rodwell.plots.paper.frame import ALONG, PLACES, WEIGHT, context, letter, new_figure
from rodwell.plots.style import INK, MODES
from rodwell.quantities.text import minus
from rodwell.studies.paper.scorer import Determinant
from rodwell.studies.paper.shapes import FIG7, Shape

DASHED: Any = (0, (5, 2))

INCLINATIONS: dict[str, Any] = {
    "90": ("α = π/2", "-"),
    "60": ("α = π/3", (0, (7, 2))),
    "30": ("α = π/6", (0, (3, 2))),
    "0": ("α = 0", (0, (1, 1.3))),
}
"""Line styles of Fig. 7: solid, long dashed, short dashed, dotted."""

FIELDS = (("y", "$y$  [$L$]"), ("T2", "$T_2$  [$B/L$]"), ("contact_pressure", "$p$  [$B/L^3$]"))


def draw_fig4(states: Sequence[Solution]) -> Figure:
    """Draw Fig. 4: y and T₂ along the branch without symmetry; first mode thick solid, second mode thick dashed."""
    import matplotlib as mpl  # noqa: PLC0415

    s = np.linspace(0.0, 1.0, PLACES)
    with context():
        figure = new_figure(7.4, 3.3)
        axes = figure.subplots(1, 2)
        colours = mpl.colormaps["viridis"](np.linspace(0.05, 0.85, len(states)))
        for number, state in enumerate(states):
            fields = state.fields(s)
            ends = number in (0, len(states) - 1)
            look: dict[str, Any] = {"color": INK if ends else colours[number], "lw": 2.4 if ends else 1.0}
            look["ls"] = DASHED if number == len(states) - 1 else "-"
            name = {0: "first mode, ", len(states) - 1: "second mode, "}.get(number, "")
            for ax, field in zip(axes, ("y", "T2"), strict=True):
                ax.plot(s, fields[field], **look, label=minus(f"{name}{state.force:.5g}"), zorder=3 if ends else 2)
        for ax, (_, label), text in zip(axes, FIELDS[:2], ("(a)", "(b)"), strict=True):
            ax.axhline(0.0, color=INK, lw=0.5, zorder=0)
            ax.set_xlim(0.0, 1.0)
            ax.set_xlabel(ALONG)
            ax.set_ylabel(label)
            letter(ax, text)
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside right center", title="$F$  [$B/L^2$]", title_fontsize=8)
        return figure


def draw_fig7(rows: Sequence[Sequence[Shape]]) -> Figure:
    """Draw Fig. 7: y, T₂ and p at four inclinations; a row for each weight."""
    s = np.linspace(0.0, 1.0, PLACES)
    with context():
        figure = new_figure(7.4, 4.6)
        axes = figure.subplots(len(rows), len(FIELDS))
        for line, shapes, (weight, force) in zip(axes, rows, FIG7, strict=True):
            for number, shape in enumerate(shapes):
                fields = shape.state.fields(s)
                text, ls = INCLINATIONS[shape.label]
                for ax, (name, _) in zip(line, FIELDS, strict=True):
                    ax.plot(s, fields[name], color=MODES[number], lw=1.3, ls=ls, label=text)
            for ax, (_, label) in zip(line, FIELDS, strict=True):
                ax.axhline(0.0, color=INK, lw=0.5, zorder=0)
                ax.set_xlim(0.0, 1.0)
                ax.set_xlabel(ALONG)
                ax.set_ylabel(label)
            letter(line[0], minus(f"mg = {weight:g},  F = {force:g}"))
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=4)
        return figure


def draw_fig10(data: Determinant) -> Figure:
    """Draw Fig. 10: D(0, mg), roots marked."""
    with context():
        figure = new_figure(4.8, 3.2)
        ax = figure.subplots()
        ax.plot(data.weights, data.values, color=INK, lw=1.6)
        ax.axhline(0.0, color=INK, lw=0.6)
        for root, place, side in zip(data.roots, ((5, 6), (6, -12), (-5, -12)), ("left", "left", "right"), strict=True):
            ax.plot(root, 0.0, "D", ms=5, color="white", mec=INK)
            ax.annotate(f"{root:.6f}", (root, 0.0), xytext=place, textcoords="offset points", ha=side, fontsize=7.5)
        ax.set_xlim(0.0, 350.0)
        ax.set_xlabel(WEIGHT)
        ax.set_ylabel("$D(0, mg)$")
        return figure
