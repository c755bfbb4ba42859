"""A rod that may have left the wall, in space.

The centreline is r₁ = x i + y j + z k with z' = √(1 − x'² − y'²). Where the rod crosses the hole's axis no direction
towards the axis exists, so the frame {t₁, d₁, u₁} is here the one that does not turn about its tangent; it begins with
d₁ upwards, towards the axis, as the braid frame does. The material frame turns against it by −T₁/C per length.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.measured import along_axis, position
from rodwell.analysis.space.geometry import Geometry, checked_places, checked_radius, checked_scale, upwards
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
    rate = np.sqrt(1.0 - slope**2)
    bend = np.stack([x[2], y[2], -(x[1] * x[2] + y[1] * y[2]) / rate], axis=1)
    angle = np.unwrap(np.arctan2(y[0], -x[0]))
    fields = {
        "z": along_axis(state, s), "eta": np.arcsin(slope), "curvature": np.linalg.norm(bend, axis=1),
        "xi2": angle, "y": problem.clearance * angle, "gap": 1.0 - np.hypot(x[0], y[0]) / problem.clearance,
        "contact_pressure": pressure,
    }  # fmt: skip
    radius = checked_radius(problem, rod_radius, fields["curvature"])
    scale = checked_scale(fields["eta"], problem.clearance + radius, radial_scale)
    axis = np.stack([0.0 * s, 0.0 * s, fields["z"]], axis=1)
    centreline = axis + scale * np.stack([x[0], y[0], 0.0 * s], axis=1)
    t1, d1 = _without_turning(centreline, np.stack([scale * x[1], scale * y[1], rate], axis=1))
    u1 = np.cross(t1, d1)
    turn = -problem.twist / problem.torsional_stiffness
    turned, rates = turn * problem.rod.turned(s), turn / problem.rod.torsion(s)
    d0, v1 = _turned(d1, u1, turned)
    true_t1, true_d1 = _without_turning(axis + (centreline - axis) / scale, np.stack([x[1], y[1], rate], axis=1))
    true_u1 = np.cross(true_t1, true_d1)
    turned_over = np.array([upwards(problem), upwards(problem), 1.0])
    across = np.cross(true_t1, bend)  # the curvature vector t₁ × t₁'
    curvatures, material = (
        np.stack([about, *(np.sum(across * vector, axis=1) for vector in frame)], axis=1)
        for about, frame in ((0.0 * s, (true_d1, true_u1)), (rates, _turned(true_d1, true_u1, turned)))
    )
    centreline, t1, d1, u1, d0, v1 = (turned_over * one for one in (centreline, t1, d1, u1, d0, v1))
    ends = tuple(float(end) for end in state.bounds[1:-1])
    return Geometry(
        s, centreline, t1, d1, u1, d0, v1, curvatures, material, fields, problem.clearance, radius, scale, False,
        axis, np.tile(upwards(problem) * np.eye(3)[:2], (s.size, 1, 1)), ends,
    )  # fmt: skip


def _turned(d1: FloatArray, u1: FloatArray, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two vectors (m, 3) across the rod, turned about the tangent from the first towards the second."""
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return cos * d1 + sin * u1, cos * u1 - sin * d1


def _without_turning(points: FloatArray, along: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit tangents (m, 3), and vectors across that do not turn about them, the first one upwards.

    By two reflections from place to place: Wang, Jüttler, Zheng and Liu, ACM Trans. Graph. 27(1), 2, 2008.
    """
    tangent = along / np.linalg.norm(along, axis=1, keepdims=True)
    up = np.array([1.0, 0.0, 0.0])
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
