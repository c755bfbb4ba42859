"""Colours and small helpers that all figures share."""

from __future__ import annotations

from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

INK = "#1f2933"
GREY = "#8a94a0"
WARN = "#b3261e"
MODES = ("#0b5fa5", "#c75b12", "#2d7d46", "#7b3fa0", "#a0862b", "#3a8f9e", "#b0436e", "#5a6b7b",
         "#0b5fa5", "#c75b12", "#2d7d46", "#7b3fa0")  # fmt: skip
"""One colour a mode; they differ in lightness too, so that they survive grey print."""

SIZE = (7.2, 4.4)

RC: Any = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.5,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e3e7eb",
    "grid.linewidth": 0.6,
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "svg.fonttype": "path",
    "svg.hashsalt": "rodwell",
}


def new_axes(size: tuple[float, float] = SIZE, nrows: int = 1, index: int = 1) -> Any:
    """Return axes of a new figure (no pyplot, no global state): number ``index`` of ``nrows`` below each other."""
    import matplotlib as mpl  # noqa: PLC0415

    with mpl.rc_context(RC):
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        return figure.add_subplot(nrows, 1, index)
