"""Numbers of a state of partial contact on one chain: energy, forces on the wall, gaps."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState, lowest
from rodwell.numerics.stretches.basis import reference_element
from rodwell.numerics.stretches.carry import elements_at, rim_fields
from rodwell.quantities.arrays import FloatArray

SAMPLES = 16
"""Places in an element among which the largest gap and the largest pressure are first sought."""


class Numbers(NamedTuple):
    """Numbers of a state, in units B = L = 1, gaps in Δ.

    ``bounds``: ends of the stretches; ``points``: concentrated forces at the breaks; ``stretches``: contact force of
    each stretch, ∫|p| ds; ``gaps``: the largest gap of each stretch and where.
    """

    energy: float
    shortening: float
    bounds: FloatArray
    points: FloatArray
    stretches: FloatArray
    gaps: FloatArray
    gap_places: FloatArray
    largest_pressure: float
    largest_pressure_at: float


def measured(state: PatternedState) -> Numbers:
    """Numbers of a state."""
    d, shape, out = state.model.problem.clearance, state.solved.shape, state.solved.out
    count = len(state.pattern.touching)
    forces, gaps, places = np.zeros((3, count))
    highest, at = 0.0, float("nan")
    element = reference_element(shape.chain.degree)
    for i, on in enumerate(state.pattern.touching):
        for e in state.elements_of(i):
            left, h = shape.places[e], shape.places[e + 1] - shape.places[e]
            if on:
                pressure = _pressure(state, e, left, h)
                forces[i] += h * float(element.weights @ np.abs(pressure(element.points)))
                low, xi = lowest(pressure, np.linspace(0.0, 1.0, SAMPLES + 1))
                if -low > highest:
                    highest, at = -low, left + h * xi
            else:
                low, xi = lowest(_inside(state, e), np.linspace(0.0, 1.0, SAMPLES + 1))
                if -low > gaps[i]:
                    gaps[i], places[i] = -low, left + h * xi
    return Numbers(
        out.energy * d**2, out.energy_by_load * d**2, state.bounds, d * state.solved.forces, forces, gaps, places,
        highest, at,
    )  # fmt: skip


def along_axis(state: PatternedState, places: FloatArray) -> FloatArray:
    """z(s) in L at ``places`` (k,), by Gauss's rule on a fine grid."""
    grid = np.unique(np.concatenate([np.linspace(0.0, 1.0, 401), state.bounds]))
    points, weights = np.polynomial.legendre.leggauss(4)
    s = (grid[:-1, None] + 0.5 * np.diff(grid)[:, None] * (points + 1.0)).ravel()
    x, y, _ = position(state, s)
    rate = np.sqrt(1.0 - x[1] ** 2 - y[1] ** 2).reshape(-1, 4) @ (0.5 * weights) * np.diff(grid)
    return np.asarray(np.interp(places, grid, np.concatenate([[0.0], np.cumsum(rate)])))


def _pressure(state: PatternedState, e: int, left: float, h: float) -> Callable[[FloatArray], FloatArray]:
    """Contact pressure of an element as a function of ξ."""
    shape = state.solved.shape

    def pressure(xi: FloatArray) -> FloatArray:
        return state.model.pressure(left + h * xi, shape.at(e, xi)[0], shape.load)

    return pressure


def _inside(state: PatternedState, e: int) -> Callable[[FloatArray], FloatArray]:
    """How far beyond the wall an element is, in Δ (negative: a gap), as a function of ξ."""

    def inside(xi: FloatArray) -> FloatArray:
        x, y = state.solved.shape.at(e, xi, 1)[:, 0]
        return np.asarray(np.hypot(x, y) - 1.0)

    return inside


def position(state: PatternedState, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Position x and y in L with three derivatives, (4, k) each, and contact pressure (k,), 0 where free."""
    d, shape = state.model.problem.clearance, state.solved.shape
    fields, pressure = np.zeros((2, 4, s.size)), np.zeros(s.size)
    elements = elements_at(shape, s)
    for e in np.unique(elements):
        here = elements == e
        left, h = shape.places[e], shape.places[e + 1] - shape.places[e]
        found = shape.at(int(e), (s[here] - left) / h)
        if shape.chain.touching[e]:
            phi, phi1, phi2, phi3 = found[0]
            fields[:, :3, here] = rim_fields(found[0, :3])
            sin, cos = np.sin(phi), np.cos(phi)
            around, radial = phi3 - phi1**3, -3.0 * phi1 * phi2
            fields[0, 3, here] = around * sin - radial * cos
            fields[1, 3, here] = around * cos + radial * sin
            pressure[here] = state.model.pressure(s[here], found[0], shape.load)
        else:
            fields[..., here] = found
    return d * fields[0], d * fields[1], pressure
