"""Which function draws which figure."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from matplotlib.figure import Figure

from rodwell.plots.paper import bifurcations, shapes, space, stability

DRAW: dict[str, Callable[[Any], Figure]] = {
    "fig3": bifurcations.draw_fig3,
    "fig4": shapes.draw_fig4,
    "fig5": stability.draw_fig5,
    "fig6": stability.draw_fig6,
    "fig7": shapes.draw_fig7,
    "fig8": space.draw_fig8,
    "fig9": bifurcations.draw_fig9,
    "fig10": shapes.draw_fig10,
    "fig11": stability.draw_fig11,
    "fig12": stability.draw_fig12,
    "fig13": stability.draw_fig13,
}
"""By name of the item; what each takes is what the item's ``figure`` computes."""
