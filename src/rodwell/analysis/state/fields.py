"""Fields along the rod, from the spline of one state on one mesh: at any places, and at Gauss points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

import numpy as np

from rodwell.analysis.discrete.family import given_of, shape
from rodwell.analysis.state.on_ramps import beside_wall, on_even_wall
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall import braid, end_loads
from rodwell.physics.on_wall.parameters import CLEARANCE, LATERAL_WEIGHT
from rodwell.physics.on_wall.sections import of_section, step_jumps, step_loads
from rodwell.problem.problem import Problem
from rodwell.problem.rod import Rod
from rodwell.quantities.arrays import FloatArray, IntArray

GRID = 201
"""Places along the rod at which fields are reported by default."""

ZOOMS = 5
"""Times that the search for the largest value of a field looks ten times closer: nine digits of the value."""

CLOSER = 21
"""Places of each closer look."""

NEAR, MOST_PEAKS = 0.05, 12
"""Peaks on the grid within this part of the largest are looked at closely, at most so many of them."""

EQUAL_PEAKS, EQUAL_VALUES = 1e-10, 1e-13
"""Peaks, and values, that differ by less than this part count as equal: the largest is then at the first of them."""

PLACES = 10
"""Gauss points in each element of :func:`element_fields`; polynomials through them give derivatives and integrals."""

_GAUSS = {count: np.polynomial.legendre.leggauss(count) for count in (3, 6)}

Rates = Callable[[FloatArray, FloatArray], FloatArray]


@dataclass(frozen=True)
class Local:
    """What the rod is at some places (m,): parameters in their order, the ratios of B and C, the section of each place.

    Of a uniform rod these are single numbers, and there is no section to tell.
    """

    parameters: Sequence[Any] | FloatArray
    stiffness: float | FloatArray
    torsion: float | FloatArray
    piece: IntArray | None
    taper: braid.Taper | None = None


def local(rod: Rod, parameters: FloatArray, s: FloatArray) -> Local:
    """The rod at places ``s`` (m,), with ``parameters`` as kernels take them; C as a ratio."""
    if rod.plain:
        return Local(parameters, 1.0, 1.0, None)
    own, taper = given_of(rod)(s).T, None
    if rod.tapered:
        rate = rod.stiffness.derivative
        lateral = parameters[LATERAL_WEIGHT] * rod.weight.derivative(s)
        taper = braid.Taper(rate(s), rate.derivative(s), lateral)
    return Local(of_section(own, parameters), own[0], rod.torsion(s), rod.stiffness.piece_of(s), taper)


def end_force(problem: Problem, family: Family, state: State) -> end_loads.EndForce:
    """What acts on the rod at s = 1, and where that is."""
    if not on_even_wall(problem):
        last = beside_wall(problem, family, state).fields(np.array([1.0]))
        shear, moment, angle, eta = (float(last[name][0]) for name in ("rod_F3", "rod_M2", "xi2", "eta"))
        return end_loads.EndForce(shear, moment, angle, float(np.sin(eta)))
    y, y1 = shape(family, state, np.array([1.0]), 2)[:, 0]
    profile = problem.rod.stiffness
    stiffness, rate = (float(along(np.ones(1))[0]) for along in (profile, profile.derivative))
    moment, reaction = _end_reactions(family, state)
    return end_loads.end_force(moment, reaction, float(y), float(y1), family.parameters(state.lam), (stiffness, rate))


def _end_reactions(family: Family, state: State) -> tuple[float, float]:
    """Natural boundary terms at s = 1 from virtual work: ∂e/∂y″, and ∂e/∂y′ − (∂e/∂y″)′.

    The gradient with respect to the two held coefficients there is the work of these terms on the last two
    basis functions, whose values at the end are 0 and 1 and whose slopes are ∓p/h. The error is
    of the order of the energy's, 2(p − 1), not of the derivatives'.
    """
    _, gradient, _ = family.assemble(state.c, state.lam)
    slope = state.space.degree / (state.space.breaks[-1] - state.space.breaks[-2])
    return float(-gradient[-2] / slope), float(gradient[-1] + gradient[-2])


def pressure_at(rod: Rod, parameters: FloatArray, s: FloatArray, u: FloatArray) -> FloatArray:
    """Contact pressure (m,) at ``s`` (m,) from y and three derivatives there, (4, m)."""
    here = local(rod, parameters, s)
    return np.asarray(braid.wall_pressure(s, u, here.parameters, here.stiffness, here.taper))


def total_wall_force(problem: Problem, family: Family, state: State) -> float:
    """∫|p| ds in B/L², and of a string the forces of the wall at single places, at steps of the stiffness."""
    space, parameters = state.space, family.parameters(state.lam)
    if not on_even_wall(problem):
        pressure = beside_wall(problem, family, state).strand(space.points)["contact_pressure"]
    else:
        pressure = pressure_at(problem.rod, parameters, space.points, shape(family, state, space.points, 4))
    total = float(space.weights @ np.abs(pressure))
    if problem.sections:
        total += float(np.sum(np.abs(steps_of(problem, family, state)[1])))
    return total


def steps_of(problem: Problem, family: Family, state: State) -> tuple[FloatArray, FloatArray]:
    """Couple about u₁ and force along d₁, (k,) each, of the wall on the rod at the k steps between sections."""
    if not on_even_wall(problem):
        return beside_wall(problem, family, state).steps()
    return _steps_and_jumps(problem, family, state)[:2]


def _steps_and_jumps(problem: Problem, family: Family, state: State) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The same in a straight hole, and by how much the rod's force jumps, (2, k).

    See :func:`rodwell.physics.on_wall.sections.step_loads` and :func:`~rodwell.physics.on_wall.sections.step_jumps`.
    """
    rod, parameters = problem.rod, family.parameters(state.lam)
    y, y1, y2 = shape(family, state, rod.breaks[1:-1], 3)
    stiffness = rod.stiffness_sides
    moment = -stiffness[1] * y2 / np.sqrt(1.0 - y1**2)
    couple, radial = step_loads(y1, moment, stiffness, parameters, rod.stiffness_rate_sides)
    return couple, radial, step_jumps(y, y1, (couple, radial), float(parameters[CLEARANCE]))


def _with_steps(
    problem: Problem, family: Family, state: State, s: FloatArray, integrals: tuple[FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Integrals from 0 to s and from s to 1 with what jumps at steps above s: the rod's force along i and j."""
    if not problem.sections:
        return integrals
    left, right = integrals
    jumps = _steps_and_jumps(problem, family, state)[2]
    above = np.concatenate([np.cumsum(jumps[:, ::-1], axis=1)[:, ::-1], np.zeros((2, 1))], axis=1)
    right = right.copy()
    right[6:8] += above[:, problem.rod.stiffness.piece_of(s)]
    return left, right


def fields_at(
    problem: Problem, family: Family, state: State, s: FloatArray, *, balance: bool = True
) -> dict[str, FloatArray]:
    """All fields at ``s`` (m,), in units B = L = 1; of a curved hole or a varying clearance those of the rod.

    There ``balance`` says whether "tangential_balance" is wanted, which takes as long as all the others.
    """
    if not on_even_wall(problem):
        return beside_wall(problem, family, state).fields(s, balance)
    space, end, p = state.space, end_force(problem, family, state), family.parameters(state.lam)
    rates = _rates(problem, p, end)
    integrals = _running_integrals(lambda places: rates(places, shape(family, state, places, 4)), s, space)
    integrals = _with_steps(problem, family, state, s, integrals)
    return _rebuilt(problem, s, shape(family, state, s, 4), integrals, p, end)


def element_fields(problem: Problem, family: Family, state: State) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Half lengths of the elements (e, 1), and all fields at s = 0, at the Gauss points in turn, and at s = 1.

    One evaluation of the spline serves everything: the integrals are those of polynomials through the Gauss points.
    """
    space, end, p = state.space, end_force(problem, family, state), family.parameters(state.lam)
    _, weights, running, _ = gauss_calculus()
    half = 0.5 * np.diff(space.breaks)[:, None]
    inside = gauss_places(space)
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
    integrals = _with_steps(problem, family, state, s, (from_left, from_right))
    return half, _rebuilt(problem, s, u, integrals, p, end)


def gauss_places(space: SplineSpace) -> FloatArray:
    """Gauss points of :func:`element_fields` in each element in turn."""
    half = 0.5 * np.diff(space.breaks)[:, None]
    return np.asarray(space.breaks[:-1, None] + half * (gauss_calculus()[0] + 1.0)).ravel()


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
    size = partial(_field_at, problem, family, state, name)
    return largest_of(lambda s: np.abs(size(s)), state.space)


def _field_at(problem: Problem, family: Family, state: State, name: str, s: FloatArray) -> FloatArray:
    """One field at ``s`` (m,): what follows from y and its derivatives alone needs none of the integrals of others."""
    if on_even_wall(problem) and name in ("contact_pressure", "xi2"):
        u, parameters = shape(family, state, s, 4), family.parameters(state.lam)
        if name == "contact_pressure":
            return pressure_at(problem.rod, parameters, s, u)
        return np.asarray(u[0] / parameters[CLEARANCE] + (np.pi if problem.on_top else 0.0))
    return fields_at(problem, family, state, s, balance=name == "tangential_balance")[name]


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
    if space is not None and space.kinks.size:  # just below a step fields have other values than just above
        s = np.union1d(s, np.concatenate([space.kinks, np.nextafter(space.kinks, 0.0)]))
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


def _rates(problem: Problem, parameters: FloatArray, end: end_loads.EndForce) -> Rates:
    def rates(s: FloatArray, u: FloatArray) -> FloatArray:
        here = local(problem.rod, parameters, s)
        torsion = problem.torsional_stiffness * here.torsion
        return braid.rates(s, u, here.parameters, torsion, end, here.stiffness, here.taper)

    return rates


def _rebuilt(
    problem: Problem,
    s: FloatArray,
    u: FloatArray,
    integrals: tuple[FloatArray, FloatArray],
    parameters: FloatArray,
    end: end_loads.EndForce,
) -> dict[str, FloatArray]:
    here = local(problem.rod, parameters, s)
    torsion = problem.torsional_stiffness * here.torsion
    out = braid.reconstruct(s, u, *integrals, here.parameters, torsion, end, here.stiffness, here.piece, here.taper)
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
