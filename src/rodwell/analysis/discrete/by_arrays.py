"""The measured numbers of a rod in a curved hole, with sections that taper, or of varying clearance, by arrays.

They are those of :mod:`rodwell.analysis.discrete.measures`. The contact pressure is the field's own, from the third
derivative of the spline. In a curved hole ω₂ at the ends is the curvature −K_g about d₁, that of the hole included, and
T₂(0) is the torque about the hole's axis that the circumferential forces of both
ends make together, Δ∫∂e/∂y ds: in a straight hole, that of the lateral weight.
"""

from __future__ import annotations

import numpy as np

from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.curved import RodInCurvedHole, bends_at, strand
from rodwell.physics.on_wall.parameters import CLEARANCE, COUNT, RAMP
from rodwell.physics.on_wall.ramps import BY_FORCE, RodOnRamps, slack_of, wall_at
from rodwell.physics.on_wall.ramps import strand as along_wall
from rodwell.quantities.arrays import FloatArray

CHANGE = 1e-5
"""By which part of the size of its terms the third derivative is changed, to see what round-off leaves of it."""

NOISE = 2.0 * float(np.finfo(float).eps)
STEEP_ORDER = 4


def end_shortening(family: Family, state: State) -> tuple[float, FloatArray]:
    """How far the loaded end moves along its own tangent, in L, and the density of that at the quadrature points."""
    u = state.space.at_points(state.c)
    if isinstance(family.model, RodOnRamps):
        given = family.mesh.given.T
        slack = given[BY_FORCE] * slack_of(state.space.points, u, given, family.parameters(state.lam))
        return float(state.space.weights @ slack), slack
    if not isinstance(family.model, RodInCurvedHole):
        slope = u[1] + family.parameters(state.lam)[RAMP]
        slack = slope**2 / (1.0 + np.sqrt(1.0 - slope**2))
        return float(state.space.weights @ slack), slack
    given = family.mesh.given.T
    clearance = float(family.parameters(state.lam)[CLEARANCE])
    k1, k2 = bends_at(state.space.points, given)
    angle = u[0] / clearance
    versine, sine = 2.0 * np.sin(0.5 * angle) ** 2, np.sin(angle)
    slack = u[1] ** 2 / (1.0 + np.sqrt(1.0 - u[1] ** 2))
    lying = 1.0 + clearance * k1
    here = lying - clearance * (k1 * versine + k2 * sine)
    density = lying * (slack - clearance * (k1 * versine + k2 * sine) / lying) / here
    return float(state.space.weights @ density), density


def pressures(family: Family, state: State, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Contact pressure, negative in contact, (k,), at places (k,), and what round-off leaves of it."""
    p = family.parameters(state.lam)
    u = state.space.evaluate(state.c, places, STEEP_ORDER)
    assert family.given is not None
    given = family.given(places).T
    value = family.model.observed(places, u, given, p)
    table, first = state.space.tabulated(np.ascontiguousarray(places), STEEP_ORDER)
    rows = state.c[first[:, None] + np.arange(state.space.degree + 1)]
    noise = np.zeros_like(value)
    for order in (2, 3):
        size = np.sum(np.abs(table[:, order] * rows), axis=1)
        moved = u.copy()
        moved[order] += CHANGE * size
        noise += NOISE / CHANGE * np.abs(family.model.observed(places, moved, given, p) - value)
    return np.asarray(value), noise


def end_curvatures(family: Family, state: State) -> FloatArray:
    """ω₂ at s = 0 and s = 1, (2,)."""
    p, ends = family.parameters(state.lam), np.array([0.0, 1.0])
    u = state.space.evaluate(state.c, ends, STEEP_ORDER)
    if isinstance(family.model, RodOnRamps):
        assert family.given is not None
        return np.asarray(along_wall(ends, u, family.given(ends).T, p).omega[1])
    if not isinstance(family.model, RodInCurvedHole):
        return np.asarray(-u[2] / np.sqrt(1.0 - (u[1] + p[RAMP]) ** 2))
    assert family.given is not None
    return np.asarray(strand(ends, u, family.given(ends).T, p)[1])


def totals(family: Family, state: State) -> dict[str, float]:
    """Integrals over the rod and largest values at the quadrature points, by name."""
    p, space = family.parameters(state.lam), state.space
    u = space.at_points(state.c)
    given = family.mesh.given.T
    clearance = float(p[CLEARANCE])
    gradient = family.model.density(space.points, u, given, p, np.zeros(COUNT))[2]
    lateral = clearance * gradient[0]
    u[0], u[1] = u[0] + p[RAMP] * space.points, u[1] + p[RAMP]
    if isinstance(family.model, RodOnRamps):  # y is Δ₀θ
        own = wall_at(space.points, given).clearance[0] / clearance
        u[1:] = own * u[1:]
    bend = u[2] / np.sqrt(1.0 - u[1] ** 2)
    shortening, density = end_shortening(family, state)
    return {
        "shortening": shortening,
        "shortening_size": float(space.weights @ np.abs(density)),
        "torque": float(-space.weights @ lateral),
        "torque_size": float(space.weights @ np.abs(lateral)),
        "bending": float(0.5 * space.weights @ bend**2),
        "sharpest": float(np.max(np.abs(bend))),
        "widest": float(np.max(np.abs(u[0]))) / clearance,
        "steepest": float(np.max(np.abs(u[1]))),
    }
