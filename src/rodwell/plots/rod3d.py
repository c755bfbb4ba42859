"""The rod in its cylinder, in three dimensions, coloured by contact pressure."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap, Normalize, TwoSlopeNorm
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Line3DCollection

from rodwell.analysis.solution import Solution
from rodwell.plots.style import RC, minus
from rodwell.plots.units import axis
from rodwell.practice.scales import Scales

ASPECT = 4.0
"""Length of the picture against its width; the lateral exaggeration that follows is written into it."""


def plot_rod(solution: Solution, scales: Scales | None = None, ax: Any = None) -> Any:
    """Draw the rod's centreline on the cylinder of radius Δ, coloured by contact pressure; return the axes.

    The lateral scale is exaggerated: the factor stands in the picture. Gravity's lateral part points down.
    """
    s = np.linspace(0.0, 1.0, 801)
    fields = solution.fields(s)
    fs, us = axis("z", scales, 1.0)
    fp, up = axis("contact_pressure", scales, float(np.max(np.abs(fields["contact_pressure"]))))
    clearance = solution.problem.clearance
    with mpl.rc_context(RC):
        if ax is None:
            ax = _wide_axes()
        _cylinder(ax, fs)
        x, y = np.sin(fields["xi2"]), -np.cos(fields["xi2"])  # sideways, up; in units of the clearance
        line = np.stack([fields["z"] * fs, x, y], axis=1)
        pressure = fields["contact_pressure"] * fp
        low, high = float(pressure.min()), float(pressure.max())
        cmap, norm = _colors(low, high)
        rod = Line3DCollection(np.stack([line[:-1], line[1:]], axis=1), cmap=cmap, norm=norm, lw=3.4)
        rod.set_array(0.5 * (pressure[1:] + pressure[:-1]))
        rod.set_capstyle("round")
        ax.add_collection3d(rod)
        ff, uf = axis("force", scales, solution.force)
        bar = ax.figure.colorbar(rod, cax=ax.figure.add_axes((0.88, 0.2, 0.02, 0.6)))
        bar.ax.set_yscale("linear")
        bar.ax.grid(visible=False)
        bar.set_label(f"contact pressure p  [{up}]")
        ax.set_box_aspect((ASPECT, 1.0, 1.0), zoom=0.88)
        ax.view_init(elev=18, azim=-68)
        ax.set_xlim(0.0, fs)
        ax.set_ylim(-1.0, 1.0)
        ax.set_zlim(-1.0, 1.0)
        ax.set_axis_off()
        for place in (0.0, 1.0):
            ax.text(place * fs, 0.0, -1.6, f"s = {place:g}", ha="center", fontsize=9)
        exaggeration = 1.0 / (2.0 * clearance * ASPECT)
        length = f", length {fs:g} {us}" if scales is not None else ""
        ax.figure.text(
            0.02, 0.03,
            minus(f"F = {solution.force * ff:.4g} {uf} at s = 1 (tension positive){length}; "
                  f"across the axis {exaggeration:.3g} times enlarged"),
            fontsize=8.5,
        )  # fmt: skip
    return ax


def _wide_axes() -> Any:
    """Axes for a long object: the scene is square, so a square larger than the figure is laid behind it."""
    width, height, side = 7.6, 2.9, 6.7
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    box = (-0.02, 0.5 * (1.0 - side / height) + 0.03, side / width, side / height)
    return figure.add_axes(box, projection="3d")


def _colors(low: float, high: float) -> tuple[Any, Any]:
    """Blue where pressed on the wall, white at none, red where the wall would have to pull."""
    if high <= 1e-3 * abs(low):
        return LinearSegmentedColormap.from_list("pressed", ["#08306b", "#2171b5", "#9ecae1"]), Normalize(low, 0.0)
    return mpl.colormaps["coolwarm"], TwoSlopeNorm(0.0, min(low, -1e-3 * high), high)


def _cylinder(ax: Any, length: float) -> None:
    """The cylinder on which the rod's centreline lies, translucent, with its lowest generator."""
    angle = np.linspace(0.0, 2.0 * np.pi, 61)
    ends = np.array([0.0, length])
    z, a = np.meshgrid(ends, angle)
    ax.plot_surface(z, np.sin(a), -np.cos(a), color="#9fb3c8", alpha=0.16, lw=0, shade=False)
    for end in ends:
        ax.plot(np.full_like(angle, end), np.sin(angle), -np.cos(angle), color="#627d98", lw=0.9)
    ax.plot(ends, [0.0, 0.0], [-1.0, -1.0], color="#627d98", lw=0.8, ls=":")
