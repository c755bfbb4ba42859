"""A rod that may have left the wall, in space.

The centreline is r₁ = x i + y j + z k with z' = √(1 − x'² − y'²); in a curved hole X(z) + x N1 + y N2. Where the rod
crosses the hole's axis no direction towards the axis exists, so the frame {t₁, d₁, u₁} is here the one that does not
turn about its tangent; it begins with d₁ upwards, towards the axis, as the braid frame does. The material frame turns
against it by −T₁/C per length.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.curved.own_places import bends_along
from rodwell.analysis.off_wall.measured import along_axis, position
from rodwell.analysis.space.geometry import Geometry, beside, checked_places, checked_radius, checked_scale
from rodwell.errors import InputError
from rodwell.quantities.arrays import FloatArray

PLACES = 401
"""Places along the rod where none are asked for."""


def geometry_in_hole(
    state: PatternedState,
    places: int | None = None,
    *,
    rod_radius: float | None = None,
    radial_scale: float | None = 1.0,
) -> Geometry:
    """Return a rod that may have left the wall in space; arguments and errors as of :meth:`PathState.geometry`."""
    problem = state.model.problem
    if problem.bridges:
        raise InputError(
            "sections", f"{len(problem.sections)} of them", "must have one clearance: the rod in space is drawn in a "
            "hole of one diameter; seen from the side it is drawn by `rodwell path --out`",
        )  # fmt: skip
    s = np.linspace(0.0, 1.0, checked_places(PLACES if places is None else places))
    x, y, pressure = position(state, s)
    slope = np.hypot(x[1], y[1])
    rate, z = np.sqrt(1.0 - slope**2), along_axis(state, s)
    axis, across = beside(problem, z)
    there = np.concatenate([across, np.cross(across[:, 0], across[:, 1])[:, None]], axis=1)
    bends = bends_along(state, s)
    narrowed = bends[0] * x[0] + bends[1] * y[0]  # the rod is nearer to the centre of the bend than the axis is
    step = rate / (1.0 - narrowed)
    bend = np.stack([
        x[2] + rate * step * bends[0], y[2] + rate * step * bends[1],
        -(x[1] * x[2] + y[1] * y[2]) / rate - step * (bends[0] * x[1] + bends[1] * y[1]),
    ], axis=1)  # fmt: skip
    angle = np.unwrap(np.arctan2(y[0], -x[0]))
    fields = {
        "z": z, "eta": np.arcsin(slope), "curvature": np.linalg.norm(bend, axis=1),
        "xi2": angle, "y": problem.clearance * angle, "gap": 1.0 - np.hypot(x[0], y[0]) / problem.clearance,
        "contact_pressure": pressure,
    }  # fmt: skip
    radius = checked_radius(problem, rod_radius, fields["curvature"])
    sharpest = 0.0 if problem.hole is None else problem.hole.sharpest
    scale = checked_scale(fields["eta"], problem.clearance + radius, radial_scale, sharpest)
    off = np.einsum("ki,kij->kj", np.stack([x[0], y[0]], axis=1), across)
    centreline, up = axis + scale * off, across[0, 0]

    def in_space(vectors: FloatArray) -> FloatArray:
        return np.asarray(np.einsum("ki,kij->kj", vectors, there))

    drawn = np.stack([scale * x[1], scale * y[1], step * (1.0 - scale * narrowed)], axis=1)
    t1, d1 = _without_turning(centreline, in_space(drawn), up)
    u1 = np.cross(t1, d1)
    turn = -problem.twist / problem.torsional_stiffness
    turned, rates = turn * problem.rod.turned(s), turn / problem.rod.torsion(s)
    d0, v1 = _turned(d1, u1, turned)
    true_t1, true_d1 = _without_turning(axis + off, in_space(np.stack([x[1], y[1], rate], axis=1)), up)
    true_u1 = np.cross(true_t1, true_d1)
    bent = np.cross(true_t1, in_space(bend))  # the curvature vector t₁ × t₁'
    curvatures, material = (
        np.stack([about, *(np.sum(bent * vector, axis=1) for vector in frame)], axis=1)
        for about, frame in ((0.0 * s, (true_d1, true_u1)), (rates, _turned(true_d1, true_u1, turned)))
    )
    ends = tuple(float(end) for end in state.bounds[1:-1])
    return Geometry(
        s, centreline, t1, d1, u1, d0, v1, curvatures, material, fields, problem.clearance, radius, scale, False,
        axis, across, ends,
    )  # fmt: skip


def _turned(d1: FloatArray, u1: FloatArray, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two vectors (m, 3) across the rod, turned about the tangent from the first towards the second."""
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return cos * d1 + sin * u1, cos * u1 - sin * d1


def _without_turning(points: FloatArray, along: FloatArray, up: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit tangents (m, 3), and vectors across that do not turn about them, the first one upwards.

    By two reflections from place to place: Wang, Jüttler, Zheng and Liu, ACM Trans. Graph. 27(1), 2, 2008.
    """
    tangent = along / np.linalg.norm(along, axis=1, keepdims=True)
    first = up - (up @ tangent[0]) * tangent[0]
    step = np.diff(points, axis=0)
    mirror = _reflections(step)
    bend = tangent[1:] - (mirror @ tangent[:-1, :, None])[..., 0]
    vector = [first / np.linalg.norm(first)]
    for both in _reflections(bend) @ mirror:
        vector.append(both @ vector[-1])
    return tangent, np.array(vector)


def _reflections(normal: FloatArray) -> FloatArray:
    """Matrices (m, 3, 3) that reflect at planes with these normals (m, 3), of any length."""
    square = np.sum(normal**2, axis=1)[:, None, None]
    return np.asarray(np.eye(3) - 2.0 / square * normal[:, :, None] * normal[:, None, :])
