"""Meshes of the rod and its cylinder: vertices and triangles, seen from outside in counter-clockwise order."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rodwell.analysis.space.geometry import Geometry
from rodwell.errors import checked_whole
from rodwell.quantities.arrays import FloatArray

IntArray = NDArray[np.int64]

SIDES = 24
"""Sides of the rod's cross-section; a multiple of four puts vertices on the wall and on all material lines."""

RAISED = 1.05
"""Radius of a material line against the rod's, so that it stays visible on flat sides; not beyond the wall."""

LINE_WIDTH = 0.13
"""Half the width of a material line in radians around the rod."""

RING = (1.35, 0.22)
"""Radii of a ring around the rod, and of its own cross-section, against the rod's radius; the wall flattens it."""


BENT_RINGS = 161
"""Rings that make the wall of a curved hole."""


@dataclass(frozen=True)
class Mesh:
    """Triangles in space.

    Attributes
    ----------
    vertices
        (n, 3) along i, j, k, in L.
    triangles
        Numbers of their vertices (k, 3).
    place
        Number of the place along the rod that each vertex belongs to (n,): index into the arrays of the Geometry.
    angle
        Material-line coordinate of each vertex (n,): angle around the cross-section from d₀ towards v₁, in radians.
    """

    vertices: FloatArray
    triangles: IntArray
    place: IntArray
    angle: FloatArray


def tube(geometry: Geometry, sides: int = SIDES) -> Mesh:
    """Surface of the rod with closed ends: watertight; columns of vertices are material lines.

    Raises
    ------
    InputError
        If ``sides`` is not a whole number from 3 to 720.
    """
    sides = checked_whole("sides", sides, 3, 720)
    count, phi = geometry.s.size, 2.0 * np.pi * np.arange(sides) / sides
    around = _around(geometry, phi, geometry.drawn_radius)
    vertices = np.concatenate([around.reshape(-1, 3), geometry.centreline[[0, -1]]])
    wall = _grid(count, sides, closed=True)
    first, last = count * sides, count * sides + 1
    k, following = np.arange(sides), np.roll(np.arange(sides), -1)
    top = (count - 1) * sides
    caps = np.concatenate(
        [
            np.stack([np.full(sides, first), following, k], axis=1),
            np.stack([np.full(sides, last), top + k, top + following], axis=1),
        ]
    )
    place = np.concatenate([np.repeat(np.arange(count), sides), [0, count - 1]])
    angle = np.concatenate([np.tile(phi, count), [0.0, 0.0]])
    return Mesh(vertices, np.concatenate([wall, caps]), place, angle)


def material_lines(geometry: Geometry, count: int = 2, width: float = LINE_WIDTH) -> list[Mesh]:
    """Ribbons on the rod's surface along material lines, evenly spaced around it from d₀."""
    out = []
    for middle in 2.0 * np.pi * np.arange(count) / count:
        phi = middle + np.array([-width, 0.0, width])
        count_ = geometry.s.size
        places = np.repeat(np.arange(count_), phi.size)
        raised = _around(geometry, phi, RAISED * geometry.drawn_radius).reshape(-1, 3)
        triangles = _grid(count_, phi.size, closed=False)
        out.append(Mesh(within_wall(geometry, raised, places), triangles, places, np.tile(phi, count_)))
    return out


def ring(geometry: Geometry, s: float, sides: int = 32, around: int = 10) -> Mesh:
    """A ring around the rod at ``s``, to mark a place."""
    nearest = int(np.argmin(np.abs(geometry.s - s)))
    centre = np.array([np.interp(s, geometry.s, geometry.centreline[:, i]) for i in range(3)])
    t1, d1, u1 = (getattr(geometry, name)[nearest] for name in ("t1", "d1", "u1"))
    large, small = (geometry.drawn_radius * part for part in RING)
    a, b = np.meshgrid(2.0 * np.pi * np.arange(sides) / sides, 2.0 * np.pi * np.arange(around) / around, indexing="ij")
    out = (large + small * np.cos(b))[..., None] * (np.cos(a)[..., None] * d1 + np.sin(a)[..., None] * u1)
    vertices = centre + out + small * np.sin(b)[..., None] * t1
    index = np.arange(sides * around).reshape(sides, around)
    i, j = np.roll(index, -1, axis=0), np.roll(index, -1, axis=1)
    triangles = _split(index, i, np.roll(i, -1, axis=1), j)
    places = np.full(sides * around, nearest)
    return Mesh(within_wall(geometry, vertices.reshape(-1, 3), places), triangles, places, np.zeros(sides * around))


def within_wall(geometry: Geometry, points: FloatArray, places: IntArray) -> FloatArray:
    """The points (n, 3), those beyond the wall that the rod touches put back onto it: nothing pierces the cylinder.

    ``places`` (n,) are the numbers of the places along the rod that they belong to.
    """
    across = geometry.across[places]
    off = np.einsum("nic,nc->ni", across, points - geometry.axis[places])
    away = np.hypot(off[:, 0], off[:, 1])
    beyond = away < geometry.wall_radius if geometry.outside else away > geometry.wall_radius
    back = np.where(beyond, geometry.wall_radius / np.maximum(away, 1e-300), 1.0) - 1.0
    return np.asarray(points + np.einsum("ni,nic->nc", off * back[:, None], across))


def wall_places(geometry: Geometry) -> IntArray:
    """Places along the rod at which rings make the wall: both ends, and more between where it is bent."""
    count = geometry.s.size
    return np.unique(np.linspace(0, count - 1, min(count, BENT_RINGS) if geometry.bent else 2).round().astype(int))


def wall_rings(geometry: Geometry, phi: FloatArray, places: IntArray) -> FloatArray:
    """Points (k, len(phi), 3) of the wall around the axis at ``places`` (k,), at angles ``phi`` from i towards j."""
    circle = geometry.wall_radius * np.stack([np.cos(phi), np.sin(phi)], axis=-1)
    return np.asarray(geometry.axis[places][:, None] + np.einsum("pi,kic->kpc", circle, geometry.across[places]))


def cylinder(geometry: Geometry, sides: int = 96) -> Mesh:
    """The wall that the rod's surface touches, an open tube from the rod's first to its last cross-section."""
    phi, places = 2.0 * np.pi * np.arange(sides) / sides, wall_places(geometry)
    vertices = wall_rings(geometry, phi, places).reshape(-1, 3)
    of_vertices = np.repeat(places, sides)
    return Mesh(vertices, _grid(places.size, sides, closed=True), of_vertices, np.zeros(of_vertices.size))


def straight_contact(geometry: Geometry) -> FloatArray:
    """Line on the wall along which the straight-lying rod touches it, (k, 3): its ends; between too where bent."""
    angle = geometry.fields["xi2"][0] - geometry.fields["y"][0] / geometry.clearance  # 0, or π for a rod on top
    return wall_rings(geometry, np.array([np.pi - angle]), wall_places(geometry))[:, 0]


def _around(geometry: Geometry, phi: FloatArray, radius: float) -> FloatArray:
    """Points around every cross-section, (m, len(phi), 3)."""
    d0, v1 = geometry.d0[:, None, :], geometry.v1[:, None, :]
    out = np.cos(phi)[:, None] * d0 + np.sin(phi)[:, None] * v1
    return np.asarray(geometry.centreline[:, None, :] + radius * out)


def _grid(rows: int, columns: int, *, closed: bool) -> IntArray:
    """Triangles between rows of vertices along an axis; columns go around it counter-clockwise."""
    index = np.arange(rows * columns).reshape(rows, columns)
    beside = np.roll(index, -1, axis=1)
    if not closed:
        index, beside = index[:, :-1], beside[:, :-1]
    return _split(index[:-1], beside[:-1], beside[1:], index[1:])


def _split(a: IntArray, b: IntArray, c: IntArray, d: IntArray) -> IntArray:
    """Two triangles for each quadrilateral a, b, c, d."""
    quads = np.stack([x.ravel() for x in (a, b, c, d)], axis=1)
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
