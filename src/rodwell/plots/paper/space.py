"""Fig. 8 and the shapes of Fig. 5: the rod in its cylinder."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure

from rodwell.analysis.branch.solution import Solution
from rodwell.plots.paper.frame import context, new_figure
from rodwell.plots.rod3d import draw_rod
from rodwell.studies.paper.shapes import Shape

PLACES = 181
"""Places along the rod; faces of these small pictures are not counted in files, since they are drawn as an image."""


def shape_in_space(part: Any, state: Solution, title: str, lift: float = 0.0) -> None:
    """Draw a state on a whole (sub)figure, enlarged across the axis; the surfaces as an image.

    The scene is square, so a square as wide as the part is laid behind it, ``lift`` of the part's height above its
    middle.
    """
    box = part.bbox
    side = box.width / box.height
    ax = part.add_axes((0.0, 0.5 * (1.0 - side) + lift, 1.0, side), projection="3d")
    ax.patch.set_alpha(0.0)
    draw_rod(ax, state.geometry(PLACES, radial_scale=None), zoom=0.95)
    for thing in ax.collections:
        thing.set_rasterized(True)
    part.text(0.5, 0.97, title, ha="center", va="top", fontsize=8)


def draw_fig8(shapes: Sequence[Shape]) -> Figure:
    """Draw Fig. 8: shapes at γ = 140 for α = π/3, π/6 and 0."""
    names = {"60": "α = π/3, at lift-off", "30": "α = π/6, at lift-off", "0": "α = 0"}
    with context():
        figure = new_figure(7.4, 1.75)
        figure.set_layout_engine("none")
        parts: Any = figure.subfigures(1, len(shapes))
        for part, shape in zip(parts, shapes, strict=True):
            part.set_facecolor("none")
            shape_in_space(part, shape.state, f"{names[shape.label]}\n$-F$ = {-shape.state.force:.6g} $B/L^2$", -0.06)
        words = "Enlarged across the axis; lateral part of gravity downwards. "
        words += "Red: the wall would have to pull; rings: lift-off."
        figure.text(0.5, 0.03, words, ha="center", fontsize=7.5)
        return figure
