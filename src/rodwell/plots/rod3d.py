"""The rod in its cylinder, in three dimensions, coloured by contact pressure."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.space.geometry import Geometry
from rodwell.analysis.space.scene import NO_PULL, WALL, InSpace, drawn, enlarged, limits, load_of, palette, scene
from rodwell.analysis.space.surfaces import straight_contact, wall_places, wall_rings
from rodwell.plots.style import RC
from rodwell.plots.units import axis
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain
from rodwell.quantities.value import Value

ELEVATION, AZIMUTH = 20.0, -66.0
FLAT = 0.26
"""Height against length for which there is room: what is bent up and down is drawn smaller."""

LIGHT = np.array([0.25, -0.55, 0.8]) / np.linalg.norm([0.25, -0.55, 0.8])
PLACES, SIDES, LINES = 321, 20, 4
"""Places along the rod and around it; more would only cost time."""


def plot_rod(
    solution: InSpace,
    scales: Scales | None = None,
    ax: Any = None,
    *,
    rod_radius: float | None = None,
    radial_scale: float | None = None,
) -> Any:
    """Draw the rod as a tube in its translucent cylinder, coloured by contact pressure; return the axes.

    Two material lines, one dark and one light, show how the rod turns; red rings mark places of lift-off. Everything
    across the axis is enlarged: by how much stands in the picture, as does the radius drawn. Gravity's lateral part
    points down. Arguments as in :meth:`rodwell.Solution.geometry`; with ``scales`` of a case that gives the rod's
    diameter, that is drawn, otherwise a radius of 0.2 Δ.
    """
    elements = 0 if isinstance(solution, PatternedState) else solution.meshes.fine.space.breaks.size
    places = min(max(PLACES, 2 * elements), 4 * PLACES)
    rod = drawn(solution, scales, places, rod_radius, radial_scale)
    with mpl.rc_context(RC):
        if ax is None:
            ax = wide_axes()
        draw_rod(ax, rod)
        low, high = _box(rod)
        below = max(1.55 * _reach(rod), _reach(rod) + 0.05 * (high - low)[0])
        for end, place in zip((0, 1), _axes_of(rod.axis[[0, -1]] - below * rod.across[[0, -1], 0]), strict=True):
            ax.text(*place, f"s = {end}", ha="center", fontsize=9)
        _colour_bar(ax, rod, scales)
        ax.figure.text(0.02, 0.93, enlarged(rod), fontsize=9.5, fontweight="bold")
        ax.figure.text(0.02, 0.03, _caption(solution, rod, scales), fontsize=8.5, linespacing=1.5)
    return ax


def draw_rod(ax: Any, rod: Geometry, zoom: float = 0.8) -> None:
    """Draw rod, rings and wall on axes in three dimensions, without words."""
    low, high = _box(rod)
    size = high - low
    ax.set_proj_type("persp", focal_length=2.0)
    ax.view_init(elev=ELEVATION, azim=AZIMUTH)
    ax.set_box_aspect(tuple(size), zoom=zoom * min(1.0, FLAT * size[0] / size[2]) if rod.bent else zoom)
    for limit, start, end in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), low, high, strict=True):
        limit(start, end)
    ax.set_axis_off()
    _bodies(ax, rod)
    _wall(ax, rod)


def _box(rod: Geometry) -> tuple[FloatArray, FloatArray]:
    """Lowest and highest coordinates (3,) of what is drawn, in the axes of the picture."""
    axis, beside = _axes_of(rod.axis), np.array([0.0, _reach(rod), _reach(rod)])
    return axis.min(axis=0) - beside, axis.max(axis=0) + beside


def _axes_of(points: FloatArray) -> FloatArray:
    """From i, j, k to the axes of the picture: along the cylinder, sideways, up."""
    return np.asarray(points[..., [2, 1, 0]] * np.array([1.0, -1.0, 1.0]))


def _reach(rod: Geometry) -> float:
    return max(rod.wall_radius, rod.radial_scale * (rod.clearance + rod.rod_radius))


def _bodies(ax: Any, rod: Geometry) -> None:
    """Rod, material lines and rings as one collection, so that they hide each other; what faces away is left out."""
    faces, colours = [], []
    e, a = np.radians(ELEVATION), np.radians(AZIMUTH)
    eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    sides = max(8, SIDES * PLACES // rod.s.size)  # thin as a long rod looks, fewer will do
    for part in scene(rod, sides, LINES):
        if part.opacity < 1.0:
            continue
        corners = _axes_of(part.mesh.vertices)[part.mesh.triangles]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        seen = normal @ eye > -0.15  # perspective shows a little more than a view from afar
        colour = np.broadcast_to(part.colour, part.mesh.vertices.shape)[part.mesh.triangles].mean(axis=1)
        faces.append(corners[seen])
        colours.append(np.clip(colour * (0.62 + 0.42 * np.maximum(normal @ LIGHT, 0.0))[:, None], 0.0, 1.0)[seen])
    shown = np.concatenate(colours)
    ax.add_collection3d(Poly3DCollection(np.concatenate(faces), facecolors=shown, edgecolors=shown, linewidths=0.25))


def _wall(ax: Any, rod: Geometry) -> None:
    """The cylinder that the rod's surface touches, translucent, with the line where the straight rod lies."""
    rings = _axes_of(wall_rings(rod, np.linspace(0.0, 2.0 * np.pi, 61), wall_places(rod)))
    ax.plot_surface(*np.moveaxis(rings, 2, 0).transpose(0, 2, 1), color=WALL, alpha=0.16, lw=0, shade=False,
                    rcount=61, ccount=len(rings))  # fmt: skip
    for ring in rings[[0, -1]]:
        ax.plot(*ring.T, color="#627d98", lw=0.9)
    line = _axes_of(straight_contact(rod))
    ax.plot(*line.T, color="#627d98", lw=0.8, ls=":")


def _colour_bar(ax: Any, rod: Geometry, scales: Scales | None) -> None:
    """The scale of colours, in the reader's units; p > 0 is contact where the rod lies outside."""
    low, high = limits(rod.pull)
    factor, unit = axis("contact_pressure", scales, max(-low, high))
    sign = (-1.0 if rod.outside else 1.0) * (1.0 if scales is None else -1.0)  # engineers count the push on the wall
    p = np.linspace(low, high, 256)
    below, above = np.minimum(p, 0.0) / (-low or 1.0), np.maximum(p, 0.0) / (high or 1.0)
    colours = palette(below + above)
    ends = sorted((sign * low * factor, sign * high * factor))
    if ends[0] == ends[1]:
        ends[1] = NO_PULL
    mappable = ScalarMappable(Normalize(ends[0], ends[1]), ListedColormap(colours if sign > 0.0 else colours[::-1]))
    bar = ax.figure.colorbar(mappable, cax=ax.figure.add_axes((0.885, 0.24, 0.018, 0.6)))
    bar.ax.grid(visible=False)
    bar.outline.set_visible(False)
    bar.formatter.set_powerlimits((-3, 4))
    name = "contact pressure p" if scales is None else "push on the wall"
    bar.set_label(f"{name}  [{unit}]")


def _caption(solution: InSpace, rod: Geometry, scales: Scales | None) -> str:
    said = Forces(scales, solution.problem.hung_weight)
    length = "" if scales is None else f", length {scales.text(1.0, 'length')}"
    radius = f"{plain(rod.rod_radius / rod.clearance, 3)} Δ"
    if scales is not None:
        radius = scales.text(rod.rod_radius, "length")
    marks = f"; red rings: {'ends of contact' if rod.may_leave else 'lift-off'}" if rod.lift_off else ""
    load = said.load(Value(load_of(solution)))
    drawn_as = f"rod radius drawn {radius}; thin lines: material lines{marks}"
    return f"{load[:1].upper()}{load[1:]}{length}\n{drawn_as}"


WIDE = (7.6, 3.0)
"""Size of the figure of a long object."""


def wide_axes(figure: Figure | None = None) -> Any:
    """Axes for a long object, on a figure of that size: the scene is square, so a larger square lies behind it."""
    (width, height), side = WIDE, WIDE[0]
    if figure is None:
        figure = Figure(figsize=WIDE)
        FigureCanvasAgg(figure)
    box = (-0.06, 0.5 * (1.0 - side / height) + 0.06, side / width, side / height)
    axes: Any = figure.add_axes(box, projection="3d")
    axes.get_tightbbox = lambda *_given, **_options: figure.bbox  # the square that lies beyond the figure is empty
    return axes
