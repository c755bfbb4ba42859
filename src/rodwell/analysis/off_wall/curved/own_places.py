"""States of partial contact in a curved hole with every cross-section at its own place S(s) on the hole's axis.

Paths take the hole where the undeformed rod is (:mod:`rodwell.analysis.off_wall.curved.model`). Here a state is solved
with S(s) = S(0) + ∫ q ds of itself, q = a/h, and with the force that goes with it, as on the wall
(:mod:`rodwell.analysis.state.own_places`): N′ = ∂e/∂S − N ∂q/∂S, which is w T·k h where the curvature is constant, and
N(1) = (1 + Δk₁) F.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rodwell.analysis.discrete.curved import (
    HoleAlong,
    ends_of_lying_rod,
    height_of_rod,
    hole_along,
    hole_at,
    lifted,
    rates_at,
    undeformed_place,
    wall_side,
)
from rodwell.analysis.discrete.pieces import PiecewisePolynomial
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.curved.model import STEP, RodOffCurvedWall
from rodwell.analysis.off_wall.pattern import chain, pieces_of
from rodwell.numerics.stretches.bordered import Row, fixed_load
from rodwell.numerics.stretches.carry import fields_at
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.newton import solve
from rodwell.numerics.stretches.walk import row_of, tangent_in_load
from rodwell.physics.off_wall._curved_density import curved_hole_density
from rodwell.problem.lying import lying_rod_beside, places_of_lying_rod
from rodwell.problem.problem import Problem
from rodwell.problem.rod import Rod
from rodwell.problem.sections import PLAIN
from rodwell.quantities.arrays import FloatArray

MOST_ROUNDS = 25

SETTLED = 1e-12
"""Change of the nodes' coordinates below which the places have settled: in a round, or as two foretell of the next."""

ROUND_OFF, STALLED = 1e-5, 0.1
"""Changes below the first that do not shrink to this part in a round are round-off, as in gaps that have just opened:
places settle by the product of curvature and shortening a round."""

PIECES = 64
"""Pieces of the rod, at least, in each of which the hole is a polynomial."""

CLOSER = 4
"""Steps of Newton's method to the place of a station."""

APART = 1e-6
"""Ends of pieces nearer to each other, in L, make no piece."""


def step_along(state: PatternedState, s: FloatArray) -> FloatArray:
    """S′ = q, and h, (2, k) at places (k,) in order."""
    model = state.model
    assert isinstance(model, RodOffCurvedWall)
    (x, x1, _), (y, y1, _) = model.problem.clearance * fields_at(state.solved.shape, s)[0][:, :3]
    k1, k2 = model.beside(s)[:2]
    h = 1.0 - k1 * x - k2 * y
    return np.stack([np.sqrt(1.0 - x1**2 - y1**2) / h, h])


def places_along(state: PatternedState) -> PiecewisePolynomial:
    """S(s): the place of each cross-section on the hole's axis; the end s = 0 stays where it is undeformed."""
    ahead = lifted(_pieces(state), lambda s: step_along(state, s)[0])
    place = -ahead.coefficients
    place[0] += ends_of_lying_rod(state.problem)[0] + float(ahead(np.array([0.0]))[0])
    return PiecewisePolynomial(ahead.breaks, place)


def in_fixed_axes(state: PatternedState, s: FloatArray, vectors: FloatArray) -> FloatArray:
    """Vectors (3, k) at places (k,) in axes that do not turn along the hole: x, y, z of a straight one as they are.

    Those of a curved hole are along N₁, N₂, T beside the rod, and are returned in space, z vertically up.
    """
    hole = state.problem.hole
    if hole is None:
        return vectors
    return np.asarray(np.einsum("kij,ik->jk", hole.frame(places_along(state)(s)), vectors))


def bends_along(state: PatternedState, s: FloatArray) -> FloatArray:
    """k₁ and k₂ of the hole beside places (k,), (2, k): zero of a straight one."""
    model = state.model
    return model.beside(s)[:2] if isinstance(model, RodOffCurvedWall) else np.zeros((2, s.size))


def weight_axes(state: PatternedState) -> FloatArray:
    """What n gains along the rod by its weight, for a weight ratio of 1, in these axes, (3,)."""
    problem = state.problem
    if problem.hole is None:
        return np.array([problem.foundation, 0.0, problem.axial_weight])
    return np.array([0.0, 0.0, problem.weight])


def has_own_places(state: PatternedState) -> bool:
    """Whether it was solved with tables of its own places."""
    return isinstance(state.model, RodOffCurvedWall) and state.model.along is not None


def _pieces(state: PatternedState) -> FloatArray:
    """Ends of pieces within which the state is smooth, rising from 0 to 1."""
    ends = np.union1d(np.linspace(0.0, 1.0, PIECES + 1), state.solved.shape.places)
    inner = ends[1:-1]
    return np.concatenate([[0.0], inner[(np.diff(ends)[:-1] > APART) & (1.0 - inner > APART)], [1.0]])


def _energy(state: PatternedState, s: FloatArray, bends: FloatArray, drive: FloatArray) -> FloatArray:
    """Bending and torque less N S′ per length of the rod at places (k,), beside k₁, k₂ (2, k), with N (k,)."""
    problem, none = state.problem, np.zeros_like(s)
    b, radius = problem.rod.stiffness(s), problem.clearance * problem.rod.clearance(s)
    fields = (problem.clearance * fields_at(state.solved.shape, s)[0][:, :3]).reshape(6, s.size)
    loads = drive / b, none, none
    above = curved_hole_density(fields, bends, radius, problem.twist / b, loads, (0.0, 0.0, 0.0))[0]
    return np.asarray(b * (above + _bending_at_rest(bends, radius)) - drive / (1.0 + radius * bends[0]))


def _bending_at_rest(bends: FloatArray, radius: FloatArray) -> FloatArray:
    """Bending energy per length, over the stiffness, of the rod that lies still beside k₁, k₂ (2, k)."""
    return np.asarray(0.5 * (bends[0] ** 2 + bends[1] ** 2) / (1.0 + radius * bends[0]) ** 2)


def _by_bends(state: PatternedState, s: FloatArray, places: FloatArray) -> FloatArray:
    """∂e/∂S − N ∂q/∂S at places (k,) without that of the height: by k₁ and k₂, with a complex step."""
    model, problem = state.model, state.problem
    assert isinstance(model, RodOffCurvedWall)
    bends = hole_at(problem, places)[0][:2] + 1j * STEP * rates_at(problem, places)
    return np.asarray(np.imag(_energy(state, s, bends, model.drive(s, state.load))) / STEP)


def _tables_of(state: PatternedState) -> HoleAlong:
    """The hole at the rod's own places, and the force that goes with it."""
    problem, model, place = state.problem, state.model, places_along(state)
    assert isinstance(model, RodOffCurvedWall)

    def climb(s: FloatArray) -> FloatArray:
        return np.asarray(problem.rod.weight(s) * hole_at(problem, place(s))[1])

    def rate(s: FloatArray) -> FloatArray:
        return np.asarray(problem.weight * climb(s) * step_along(state, s)[1] + _by_bends(state, s, place(s)))

    rise, driven = lifted(place.breaks, climb), lifted(place.breaks, rate)
    last = model.farther_at_end(hole_at(problem, place(np.array([1.0])))[0][0])

    def functions(s: FloatArray) -> FloatArray:
        here, lift = hole_at(problem, place(s))[0], rise(s)
        offset = (last * state.load - driven(s)) / model.farther(s, here[0]) - state.load + problem.weight * lift
        return np.concatenate([here, lift[None], offset[None]])

    return hole_along(Rod(PLAIN), place.breaks, functions)  # sections do the rest


def with_own_places(state: PatternedState, *, near: bool = False) -> PatternedState | None:
    """The state with every cross-section at its own place; None if it was not found.

    At the same end force; or, ``near``, on the plane through the state normal to its path, which exists at a limit
    point, too, or with its shortest stretch as long as it is: with its own places a gap opens at another load. The rod
    that lies still has its places where the tables have them.
    """
    shape = state.solved.shape
    if state.pattern.full and not np.any(shape.nodes[:, 1]):
        return state
    rows = [_normal(state), _same_length(state)] if near else [fixed_load(shape.chain, shape.load)]
    return next((found for row in rows if (found := _settled(state, row)) is not None), None)


def _settled(state: PatternedState, row: Row) -> PatternedState | None:
    """The state with its own places for which a row holds; None if they do not settle."""
    found, change = state, np.inf
    for _ in range(MOST_ROUNDS):
        assert isinstance(state.model, RodOffCurvedWall)
        model = replace(state.model, along=_tables_of(found))
        solved = solve(model, _at_stations(found), row)[1]
        if solved is None or not solved.shape.in_order:
            return None
        before, change = change, float(np.max(np.abs(solved.shape.nodes - found.solved.shape.nodes)))
        found = PatternedState(state.pattern, state.elements, solved)
        small = change <= SETTLED or (np.isfinite(before) and change**2 <= SETTLED * before)
        if small or STALLED * before <= change <= ROUND_OFF:
            return found
    return None


def _at_stations(state: PatternedState) -> Shape:
    """The shape of a state on elements that end where the stations of the hole are beside it."""
    problem, shape = state.problem, state.solved.shape
    corners, section = pieces_of(problem)
    stations = np.diff(section) == 0
    if not stations.any():
        return shape
    place, s = places_along(state), corners[stations]
    there = undeformed_place(problem, s)
    for _ in range(CLOSER):
        s = s + (there - place(s)) / step_along(state, s)[0]
    corners = corners.copy()
    corners[stations] = s
    links, _ = chain(problem, state.model.given, state.pattern, state.elements, shape.chain.degree, corners)
    return replace(shape, chain=links)


def _same_length(state: PatternedState) -> Row:
    """The row that holds the length of the shortest stretch; of a single one the load."""
    shape = state.solved.shape
    if not shape.breaks.size:
        return fixed_load(shape.chain, shape.load)
    shortest, weights = int(np.argmin(np.diff(state.bounds))), np.zeros(shape.breaks.size + 2)
    weights[[shortest, shortest + 1]] = -1.0, 1.0  # of all bounds; those of the rod's ends are fixed
    return Row(np.zeros_like(shape.nodes), weights[1:-1], 0.0, float(weights[1:-1] @ shape.breaks))


def _normal(state: PatternedState) -> Row:
    shape = state.solved.shape
    row = row_of(tangent_in_load(state.solved, -1.0), shape.chain, shape.load)
    return replace(row, target=row.of(shape.nodes, shape.breaks, shape.load))


def in_space(state: PatternedState, s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Centre of the rod in L (k, 3) at places (k,), and N₁, N₂, T of the hole beside it (k, 3, 3), z vertically up."""
    hole = state.problem.hole
    assert hole is not None
    _, frames, points = hole.at(places_along(state)(s))
    x, y = state.problem.clearance * fields_at(state.solved.shape, s)[0][:, 0]
    return points + x[:, None] * frames[:, 0] + y[:, None] * frames[:, 1], frames


def _lying_place(problem: Problem, s: FloatArray) -> FloatArray:
    """The place S₀ (k,) on the axis beside the rod that lies along it; of each section at its clearance."""
    rod = problem.rod
    if not rod.clearance_steps.size:
        return undeformed_place(problem, s)
    hole, place, out = problem.hole, ends_of_lying_rod(problem)[0], np.empty_like(s)
    assert hole is not None
    ends = list(zip(rod.breaks[:-1], rod.breaks[1:], rod.clearance.coefficients[:, 0], strict=True))
    for k, (first, last, ratio) in enumerate(ends):
        reach = wall_side(problem) * problem.clearance * ratio
        ahead = float(lying_rod_beside(hole, reach, np.array([place]))[0]) - first
        here = rod.clearance.piece_of(s) == k
        if np.any(here):
            out[here] = places_of_lying_rod(hole, reach, ahead + s[here])
        place = float(places_of_lying_rod(hole, reach, np.array([ahead + last]))[0])
    return out


def energy_in_space(state: PatternedState) -> float:
    """Bending, height and torque less the work of the end force, of a state that has its own places, in B/L.

    Relative to the rod that lies still, from whose end S₀(1) on the end force works.
    """
    problem, model = state.problem, state.model
    breaks, (nodes, gauss) = places_along(state).breaks, np.polynomial.legendre.leggauss(10)
    half = 0.5 * np.diff(breaks)
    s = (breaks[:-1, None] + half[:, None] * (nodes + 1.0)).ravel()
    weights = (half[:, None] * gauss).ravel()
    assert isinstance(model, RodOffCurvedWall)
    none, b, radius = np.zeros_like(s), problem.rod.stiffness(s), problem.clearance * problem.rod.clearance(s)
    undeformed = _lying_place(problem, s)
    (k1, k2, up, _), _ = hole_at(problem, undeformed)
    lying = height_of_rod(problem, undeformed, none) + (problem.clearance - radius) * up
    risen = problem.weight * problem.rod.weight(s) * (in_space(state, s)[0][:, 2] - lying)
    bent = _energy(state, s, model.beside(s)[:2], none) - b * _bending_at_rest(np.stack([k1, k2]), radius)
    end = np.array([1.0])
    start, last = float(_lying_place(problem, end)[0]), float(places_along(state)(end)[0])
    along = start + 0.5 * (last - start) * (nodes + 1.0)
    travel = 0.5 * (last - start) * float(gauss @ model.farther_at_end(hole_at(problem, along)[0][0]))
    return float(weights @ (bent + risen)) - state.load * travel
