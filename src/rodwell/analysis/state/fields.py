"""Fields along the rod, from the spline of one state on one mesh: at any places, and at Gauss points."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from rodwell.analysis.discrete.measures import shape
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall import braid
from rodwell.physics.on_wall.strand import contact_pressure
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

GRID = 201
"""Places along the rod at which fields are reported by default."""

ZOOMS = 5
"""Times that the search for the largest value of a field looks ten times closer: nine digits of the value."""

CLOSER = 21
"""Places of each closer look."""

NEAR, MOST_PEAKS = 0.05, 12
"""Peaks on the grid within this part of the largest are looked at closely, at most so many of them."""

EQUAL_PEAKS = 1e-10
"""Peaks that differ by less than this part count as equal: the largest value is then at the first of them."""

EQUAL_VALUES = 1e-13
"""Values that differ by less than this part count as equal: the largest value is then at the first of their places."""

PLACES = 10
"""Gauss points in each element of :func:`element_fields`; polynomials through them give derivatives and integrals."""

_GAUSS = {count: np.polynomial.legendre.leggauss(count) for count in (3, 6)}

Rates = Callable[[FloatArray, FloatArray], FloatArray]


def end_force(family: Family, state: State) -> braid.EndForce:
    """What acts on the rod at s = 1, and where that is."""
    y, y1 = shape(family, state, np.array([1.0]), 2)[:, 0]
    return braid.end_force(*family.end_reactions(state), float(y), float(y1), family.parameters(state.lam))


def total_wall_force(family: Family, state: State) -> float:
    """∫|p| ds in B/L²."""
    space = state.space
    u = shape(family, state, space.points, 4)
    pressure = contact_pressure(space.points, u[0], u[1], u[2], u[3], family.parameters(state.lam))
    return float(space.weights @ np.abs(pressure))


def fields_at(problem: Problem, family: Family, state: State, s: FloatArray) -> dict[str, FloatArray]:
    """All fields at ``s`` (m,), in units B = L = 1."""
    space, end, p = state.space, end_force(family, state), family.parameters(state.lam)
    rates = _rates(problem, p, end)
    integrals = _running_integrals(lambda places: rates(places, shape(family, state, places, 4)), s, space)
    return _rebuilt(problem, s, shape(family, state, s, 4), integrals, p, end)


def element_fields(problem: Problem, family: Family, state: State) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Half lengths of the elements (e, 1), and all fields at s = 0, at the Gauss points in turn, and at s = 1.

    One evaluation of the spline serves everything: the integrals are those of polynomials through the Gauss points.
    """
    space, end, p = state.space, end_force(family, state), family.parameters(state.lam)
    nodes, weights, running, _ = gauss_calculus()
    half = 0.5 * np.diff(space.breaks)[:, None]
    inside = (space.breaks[:-1, None] + half * (nodes + 1.0)).ravel()
    s = np.concatenate([[0.0], inside, [1.0]])
    u = shape(family, state, s, 4)
    values = _rates(problem, p, end)(inside, u[:, 1:-1])
    values = values.reshape(values.shape[0], half.size, PLACES)
    elements = values @ weights * half.T  # integral over each element
    before = np.concatenate([np.zeros((len(values), 1)), np.cumsum(elements, axis=1)], axis=1)
    after = np.concatenate([np.cumsum(elements[:, ::-1], axis=1)[:, ::-1], np.zeros((len(values), 1))], axis=1)
    part = values @ running.T * half  # from the element's start to each Gauss point
    left = (before[:, :-1, None] + part).reshape(len(values), -1)
    right = (after[:, :-1, None] - part).reshape(len(values), -1)
    from_left = np.concatenate([before[:, :1], left, before[:, -1:]], axis=1)
    from_right = np.concatenate([after[:, :1], right, after[:, -1:]], axis=1)
    return half, _rebuilt(problem, s, u, (from_left, from_right), p, end)


@lru_cache
def gauss_calculus() -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Gauss points (k,) on [−1, 1], weights (k,), and the matrices (k, k) of running integrals and of derivatives."""
    x, weights = np.polynomial.legendre.leggauss(PLACES)
    legendre = np.polynomial.legendre
    basis = np.linalg.inv(legendre.legvander(x, PLACES - 1))  # values → Legendre coefficients
    identity = np.eye(PLACES)
    integral = np.array([legendre.legval(x, legendre.legint(row, lbnd=-1.0)) for row in identity]).T
    derivative = np.array([legendre.legval(x, legendre.legder(row)) for row in identity]).T
    return x, weights, integral @ basis, derivative @ basis


def largest(problem: Problem, family: Family, state: State, name: str) -> tuple[float, float]:
    """Largest size of a field and its place."""
    return largest_of(lambda s: np.abs(fields_at(problem, family, state, s)[name]), state.space)


def largest_of(
    size: Callable[[FloatArray], FloatArray], space: SplineSpace | None = None, zooms: int = ZOOMS
) -> tuple[float, float]:
    """Largest value of a function along the rod and its (first) place: ever closer between neighbours on a grid.

    The grid is that of the samples of ``space``, if these are more: no half wave of a long rod is passed over. All
    peaks that come near the largest are looked at closely, since a grid does not tell which of them is the highest.
    """
    s = np.linspace(0.0, 1.0, GRID)
    if space is not None and space.samples[0].size > GRID:
        s = space.samples[0]
    s, sizes = s[None, :], size(s)[None, :]
    peaks = _peaks(sizes[0]) if zooms > 1 else np.argmax(sizes, axis=1)
    for _ in range(zooms - 1):
        rows = np.arange(s.shape[0]) if s.shape[0] > 1 else np.zeros(peaks.size, dtype=int)
        left, right = s[rows, np.maximum(peaks - 1, 0)], s[rows, np.minimum(peaks + 1, s.shape[1] - 1)]
        s = np.linspace(left, right, CLOSER, axis=1)
        sizes = size(s.ravel()).reshape(s.shape)
        peaks = np.argmax(sizes >= (1.0 - EQUAL_VALUES) * np.max(sizes, axis=1, keepdims=True), axis=1)
    values = np.max(sizes, axis=1)
    first = int(np.argmax(values >= (1.0 - EQUAL_PEAKS) * np.max(values)))
    return float(np.max(values)), float(s[first, peaks[first]])


def _peaks(sizes: FloatArray) -> FloatArray:
    """Numbers of the peaks of values on a grid that come near the largest, in order; of equal neighbours the first."""
    up = np.concatenate([[True], sizes[1:] > sizes[:-1]])
    down = np.concatenate([sizes[:-1] >= sizes[1:], [True]])
    peaks = np.flatnonzero(up & down & (sizes >= (1.0 - NEAR) * np.max(sizes)))
    return np.asarray(np.sort(peaks[np.argsort(-sizes[peaks], kind="stable")[:MOST_PEAKS]]))


def _rates(problem: Problem, parameters: FloatArray, end: braid.EndForce) -> Rates:
    return lambda s, u: braid.rates(s, u, parameters, problem.torsional_stiffness, end)


def _rebuilt(
    problem: Problem,
    s: FloatArray,
    u: FloatArray,
    integrals: tuple[FloatArray, FloatArray],
    parameters: FloatArray,
    end: braid.EndForce,
) -> dict[str, FloatArray]:
    out = braid.reconstruct(s, u, *integrals, parameters, problem.torsional_stiffness, end)
    if problem.on_top:
        out["xi2"] = out["xi2"] + np.pi
    return out


def _running_integrals(
    rates: Callable[[FloatArray], FloatArray], s: FloatArray, space: SplineSpace
) -> tuple[FloatArray, FloatArray]:
    """Integrals from 0 to ``s`` and from ``s`` to 1: Gauss quadrature between grid points and mesh points."""
    nodes = np.union1d(np.union1d(space.breaks, s), [0.0, 1.0])
    half = 0.5 * np.diff(nodes)
    gauss, weights = _GAUSS[3 if half.max() < 0.2 * np.diff(space.breaks).max() else 6]
    places = (nodes[:-1, None] + half[:, None] * (gauss + 1.0)).ravel()
    values = rates(places).reshape(-1, half.size, gauss.size)
    pieces = np.einsum("kpq,q,p->kp", values, weights, half)
    start = np.zeros((pieces.shape[0], 1))
    left = np.concatenate([start, np.cumsum(pieces, axis=1)], axis=1)
    right = np.concatenate([np.cumsum(pieces[:, ::-1], axis=1)[:, ::-1], start], axis=1)
    where = np.searchsorted(nodes, s)
    return left[:, where], right[:, where]
