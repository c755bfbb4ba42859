"""Numbers of a state of partial contact on one chain: energy, forces on the wall, gaps."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState, pressure_on
from rodwell.analysis.off_wall.curved.own_places import energy_in_space, has_own_places, places_along
from rodwell.analysis.off_wall.depth import depth
from rodwell.numerics.stretches.basis import reference_element
from rodwell.numerics.stretches.carry import elements_at, fields_at
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.minima import lowest
from rodwell.quantities.arrays import FloatArray, IntArray

SAMPLES = 16
"""Places in an element among which the largest gap and the largest pressure are first sought."""

_RULE = np.polynomial.legendre.leggauss(4)


class Numbers(NamedTuple):
    """Numbers of a state, in units B = L = 1, gaps in Δ.

    ``bounds``: ends of the stretches; ``point_places``, ``points``: concentrated forces, from s = 0; ``stretches``:
    contact force of each stretch, ∫|p| ds; ``gaps``: the largest gap of each stretch and where.
    """

    energy: float
    shortening: float
    bounds: FloatArray
    point_places: FloatArray
    points: FloatArray
    stretches: FloatArray
    gaps: FloatArray
    gap_places: FloatArray
    largest_pressure: float
    largest_pressure_at: float


def measured(state: PatternedState) -> Numbers:
    """Numbers of a state."""
    if state.model.soft:
        return _behind_soft_wall(state)
    d, shape, out = state.model.problem.clearance, state.solved.shape, state.solved.out
    count = len(state.pattern.touching)
    forces, gaps, places = np.zeros((3, count))
    highest, at = 0.0, float("nan")
    element = reference_element(shape.chain.degree)
    for i, on in enumerate(state.pattern.touching):
        elements = np.array(state.elements_of(i))
        left, length = shape.places[elements], np.diff(shape.places)[elements]
        function = pressure_on(state, elements) if on else _inside(state, elements)
        low, xi = lowest(function, np.broadcast_to(np.linspace(0.0, 1.0, SAMPLES + 1), (elements.size, SAMPLES + 1)))
        k = int(np.argmin(low))
        largest, where = float(-low[k]), float(left[k] + length[k] * xi[k])
        if on:
            pressure = function(np.broadcast_to(element.points, (elements.size, element.points.size)))
            forces[i] = float(length @ np.abs(pressure) @ element.weights)
            if largest > highest:
                highest, at = largest, where
        elif largest > 0.0:
            gaps[i], places[i] = largest, where
    energy = energy_in_space(state) if has_own_places(state) else out.energy * d**2
    at_points = np.array([one[:2] for one in state.point_forces]).reshape(-1, 2)
    return Numbers(
        energy, out.energy_by_load * d**2, state.bounds, at_points[:, 0], d * at_points[:, 1], forces, gaps, places,
        highest, at,
    )  # fmt: skip


def _behind_soft_wall(state: PatternedState) -> Numbers:
    """Numbers of a rod that a soft wall pushes by its stiffness times the depth."""
    model, shape, out = state.model, state.solved.shape, state.solved.out
    d, per_depth = model.problem.clearance, model.problem.clearance * model.stiffness
    bounds, nodes = state.bounds, np.unique(np.concatenate([shape.places, state.bounds]))
    element = reference_element(shape.chain.degree)
    forces, gaps, places = np.zeros((3, bounds.size - 1))
    highest, at = 0.0, float("nan")
    for i, on in enumerate(state.touching):
        ends = nodes[(nodes >= bounds[i]) & (nodes <= bounds[i + 1])]
        left, length = ends[:-1, None], np.diff(ends)[:, None]
        function = _farther(shape, left, length, on)
        low, xi = lowest(function, np.broadcast_to(np.linspace(0.0, 1.0, SAMPLES + 1), (left.size, SAMPLES + 1)))
        k = int(np.argmin(low))
        largest, where = float(-low[k]), float(left[k, 0] + length[k, 0] * xi[k])
        if on:
            pressed = -function(np.broadcast_to(element.points, (left.size, element.points.size)))
            forces[i] = per_depth * float(length[:, 0] @ pressed @ element.weights)
            if per_depth * largest > highest:
                highest, at = per_depth * largest, where
        else:
            gaps[i], places[i] = largest, where
    none = np.zeros(0)
    return Numbers(out.energy * d**2, out.energy_by_load * d**2, bounds, none, none, forces, gaps, places, highest, at)


def _farther(shape: Shape, left: FloatArray, length: FloatArray, on: bool) -> Callable[[FloatArray], FloatArray]:
    """The negative depth in a soft wall (in contact), or gap, of pieces (k, 1) of the rod as a function of ξ (k, n)."""
    sign = -1.0 if on else 1.0
    return lambda xi: sign * depth(shape, (left + length * xi).ravel()).reshape(xi.shape)


def along_axis(state: PatternedState, places: FloatArray) -> FloatArray:
    """z(s) in L at ``places`` (k,), by Gauss's rule on a fine grid; in a curved hole S(s) − S(0) of its axis."""
    if state.problem.hole is not None:
        place = places_along(state)
        return np.asarray(place(places) - place(np.zeros(1)))
    return np.asarray(np.interp(places, *_axis(state)))


@lru_cache(maxsize=4)
def _axis(state: PatternedState) -> tuple[FloatArray, FloatArray]:
    """Places (k,) of the grid and z there: a search for the largest stress asks for z again and again."""
    grid = np.unique(np.concatenate([np.linspace(0.0, 1.0, 401), state.bounds, state.problem.rod.breaks]))
    points, weights = _RULE
    s = (grid[:-1, None] + 0.5 * np.diff(grid)[:, None] * (points + 1.0)).ravel()
    x1, y1 = state.model.across(s, fields_at(state.solved.shape, s)[0])[:, 1]
    rate = np.sqrt(1.0 - x1**2 - y1**2).reshape(-1, 4) @ (0.5 * weights) * np.diff(grid)
    return grid, np.concatenate([[0.0], np.cumsum(rate)])


def _inside(state: PatternedState, elements: IntArray) -> Callable[[FloatArray], FloatArray]:
    """How far beyond the wall elements (k,) are, in Δ (negative: a gap), as a function of ξ (k, n)."""

    def inside(xi: FloatArray) -> FloatArray:
        shape = state.solved.shape
        x, y = shape.along(elements, xi, 1)[:, 0]
        beyond = np.hypot(x, y) - shape.chain.radii[elements, None]
        return np.asarray(beyond * state.model.unit(shape.places[elements, None] + shape.lengths[elements, None] * xi))

    return inside


def position(state: PatternedState, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Position x and y in L with three derivatives, (4, k) each, and contact pressure (k,), 0 where free."""
    d, shape = state.model.problem.clearance, state.solved.shape
    fields, angle = fields_at(shape, s, 4)
    on = np.isfinite(angle[0])
    pressure = np.zeros(s.size)
    if on.any():
        _, phi1, phi2, phi3 = angle[:, on]
        sin, cos = np.sin(angle[0, on]), np.cos(angle[0, on])
        around, radial = phi3 - phi1**3, -3.0 * phi1 * phi2
        elements = elements_at(shape, s[on])
        given, radii = shape.chain.given[elements].T, shape.chain.radii[elements]
        fields[:, 3, on] = radii * (around * sin - radial * cos), radii * (around * cos + radial * sin)
        pressure[on] = state.model.pressure(s[on], angle[:, on], shape.load, given)
    if state.model.soft:
        pressure = -d * state.model.stiffness * np.maximum(np.hypot(fields[0, 0], fields[1, 0]) - 1.0, 0.0)
    x, y = state.model.across(s, fields)
    return x, y, pressure


def fields_of(state: PatternedState, places: FloatArray) -> dict[str, FloatArray]:
    """Fields of a state on one set of elements at ``places`` (k,)."""
    x, y, pressure = position(state, places)
    problem = state.problem
    rod, stiffness = state.model.in_space(places, x, y, state.load), problem.rod.stiffness(places)
    gap = problem.rod.clearance(places) - np.hypot(x[0], y[0]) / problem.clearance
    return {
        "x": x[0], "y": y[0], "z": along_axis(state, places), "gap": gap, "angle": np.arctan2(y[0], -x[0]),
        "curvature": rod.curvature, "tension": rod.tension, "bending_moment": stiffness * rod.curvature,
        "contact_pressure": pressure,
    }  # fmt: skip


def left_out(state: PatternedState) -> dict[str, float]:
    """Where the clearance varies, what its wall does along the hole, which is left out: "axial_force", "energy".

    A wall inclined by Δ′ pushes the rod along the hole by p Δ′ per length, so N is off by ∫|p Δ′| ds at most, in B/L².
    A place that has moved along the hole by s − z finds a wall that is Δ′(s − z) nearer or farther: the energy is off
    by ∫|p Δ′| (s − z) ds to first order, in B/L. Forces at single places count likewise.
    """
    shape, slope = state.solved.shape, state.problem.rod.clearance.derivative
    points, weights = _RULE
    weights = np.tile(0.5 * weights, shape.lengths.size)
    s = (shape.places[:-1, None] + 0.5 * shape.lengths[:, None] * (points + 1.0)).ravel()
    push = np.abs(position(state, s)[2]) * np.repeat(shape.lengths, points.size) * weights
    single = [(place, abs(state.problem.clearance * force)) for place, force, _ in state.point_forces]
    s = np.concatenate([s, [place for place, _ in single]])
    along: FloatArray = np.concatenate([push, [force for _, force in single]])
    along = along * np.abs(state.problem.clearance * slope(s))
    return {"axial_force": float(np.sum(along)), "energy": float(along @ np.abs(s - along_axis(state, s)))}
