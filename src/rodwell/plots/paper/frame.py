"""What the figures of the paper share: boxed axes, line styles of the modes, insets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from rodwell.analysis.branch.solution import Solution
from rodwell.plots.style import INK, MODES, RC
from rodwell.quantities.arrays import FloatArray

PAPER_RC: Any = RC | {
    "font.size": 8.5,
    "axes.grid": False,
    "axes.spines.top": True,
    "axes.spines.right": True,
    "axes.linewidth": 0.7,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "legend.fontsize": 7.5,
    "pdf.fonttype": 42,
    "savefig.dpi": 200,
}

STYLES: tuple[Any, ...] = ("-", (0, (5, 2)), (0, (6, 2, 1, 2)), (0, (1, 1.3)), (0, (8, 2, 1, 2, 1, 2)))
"""Line style of a mode by number, in every figure; each also has a colour."""

ORANGE, CYAN = "#e08214", "#12a4b8"
"""Branches without symmetry between modes 1 and 2, and between modes 3 and 4."""

PLACES = 301

WEIGHT, COMPRESSION = "weight $mg$  [$B/L^3$]", "end compression $-F$  [$B/L^2$]"
CURVATURE, ALONG = r"end curvature $\omega_2(1)$  [$1/L$]", "$s$  [$L$]"


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure without global state."""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def style(number: int) -> dict[str, Any]:
    """Colour and line style of a mode."""
    return {"color": MODES[(number - 1) % len(MODES)], "ls": STYLES[(number - 1) % len(STYLES)]}


def letter(ax: Any, text: str) -> None:
    """Name a panel above its left corner."""
    ax.set_title(text, loc="left", fontsize=8.5, pad=4)


def insets(ax: Any, states: Sequence[Solution], places: Sequence[tuple[float, float, float, float]]) -> None:
    """Draw y against s of modes 1, 2, … in small boxes at ``places`` (left, bottom, width, height in axes)."""
    s = np.linspace(0.0, 1.0, PLACES)
    for number, (state, place) in enumerate(zip(states, places, strict=False), start=1):
        box = ax.inset_axes(place)
        y = circumferential(state, s)
        box.plot(s, y, lw=1.1, **style(number))
        box.axhline(0.0, color=INK, lw=0.4)
        box.set_xticks([])
        box.set_yticks([])
        top = 1.15 * float(np.max(np.abs(y)))
        box.set_xlim(0.0, 1.0)
        box.set_ylim(-top, top)
        box.text(0.03, 0.96, f"{number}", transform=box.transAxes, va="top", fontsize=7, color=style(number)["color"])
        for spine in box.spines.values():
            spine.set_linewidth(0.5)
        box.patch.set_alpha(0.9)


def circumferential(state: Solution, s: FloatArray) -> FloatArray:
    """y(s), from the line where the straight rod lies."""
    space = state.meshes.fine.space
    return np.asarray(space.evaluate(state.point.fine.c, s, 1)[0])


def context() -> Any:
    """The settings of these figures, for a ``with`` block."""
    return mpl.rc_context(PAPER_RC)
