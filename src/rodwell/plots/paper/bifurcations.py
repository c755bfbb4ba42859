"""Fig. 3, 9 and 12(a): end curvature against end compression, both arms, with the modes in insets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.discrete.measures import Measured
from rodwell.plots.paper.frame import (
    COMPRESSION,
    CURVATURE,
    CYAN,
    ORANGE,
    context,
    insets,
    letter,
    new_figure,
    style,
)
from rodwell.plots.smooth import smooth
from rodwell.plots.style import INK
from rodwell.studies.paper.diagrams import Panel

BOXES = tuple((0.03 + 0.245 * i, 0.03, 0.215, 0.2) for i in range(4))
"""Insets in a row along the bottom."""


def draw_fig3(panels: Sequence[Panel]) -> Figure:
    """Draw Fig. 3: panels (a) to (d)."""
    with context():
        figure = new_figure(7.4, 6.4)
        axes = figure.subplots(2, 2)
        for ax, panel in zip(axes.ravel(), panels, strict=True):
            bifurcation(ax, panel)
        _legend(figure, 5, ("between modes 1 and 2", "between modes 3 and 4"))
        return figure


def draw_fig9(panel: Panel) -> Figure:
    """Draw Fig. 9, the vertical column."""
    with context():
        figure = new_figure(5.0, 3.9)
        bifurcation(figure.subplots(), panel)
        _legend(figure, 4, ())
        return figure


def bifurcation(ax: Any, panel: Panel) -> None:
    """Draw ω₂(1) against −F: branches and their images, diamonds at critical loads, triangles at secondary ones."""
    starts = [-mode.force for mode in panel.diagram.critical]
    left = min(0.0, starts[0]) - (0.06 * (panel.until - min(0.0, starts[0])) if starts[0] < 0.0 else 0.0)
    top = 0.0
    for branch in panel.diagram.branches:
        look = _look(branch)
        for image in branch.images:
            values = image.numbers({m: branch.numbers(m) for m in Measured})[Measured.OMEGA2_1]
            x, y = smooth(-branch.force, values)
            ax.plot(x, y, **look)
            top = max(top, float(np.max(np.abs(y[x <= panel.until]), initial=0.0)))
        _triangles(ax, branch)
    for number, start in enumerate(starts, start=1):
        ax.plot(start, 0.0, "D", ms=4.2, color=style(number)["color"], mec="white", mew=0.5, zorder=6)
    ax.axhline(0.0, color=INK, lw=0.6, zorder=0)
    ax.set_xlim(left, panel.until)
    ax.set_ylim(-1.75 * top, 1.12 * top)
    ax.set_xlabel(COMPRESSION)
    ax.set_ylabel(CURVATURE)
    letter(ax, panel.label)
    insets(ax, panel.shapes, BOXES)


def _look(branch: Branch) -> dict[str, Any]:
    if branch.mode is not None:
        return {"lw": 1.3, **style(branch.mode.number)}
    return {"lw": 1.5, "color": ORANGE if branch.origin.parent in ("mode 1", "mode 2") else CYAN}


def _triangles(ax: Any, branch: Branch) -> None:
    if branch.mode is None:
        return
    for point in branch.special_points:
        if point.kind == "branch_point":
            values = {m: np.array([point.solution.number(m).value]) for m in Measured}
            for image in branch.images:
                y = float(image.numbers(values)[Measured.OMEGA2_1][0])
                ax.plot(-point.force, y, "^", ms=5, color="white", mec=INK, mew=1.0, zorder=7)


def _legend(figure: Figure, modes: int, secondary: Sequence[str]) -> None:
    from matplotlib.lines import Line2D  # noqa: PLC0415

    marks = [Line2D([], [], lw=1.3, **style(k), label=f"mode {k}") for k in range(1, modes + 1)]
    marks += [Line2D([], [], lw=1.5, color=c, label=t) for c, t in zip((ORANGE, CYAN), secondary, strict=False)]
    marks.append(Line2D([], [], marker="D", ls="none", ms=4.2, color=INK, label="critical load"))
    if secondary:
        marks.append(Line2D([], [], marker="^", ls="none", ms=5, color="white", mec=INK, label="secondary bifurcation"))
    figure.legend(handles=marks, loc="outside lower center", ncols=5)
