"""States of a rod in a curved hole with every cross-section at its own place S(s) on the hole's axis.

Branches are followed with the hole taken where the undeformed rod is (:mod:`rodwell.analysis.discrete.curved`). Here
one state is solved with S(s) = S(0) + ∫ cos η/h ds of itself, and with the force N(s) that goes with it: stationary
points of the energy in which S is eliminated have

    N′ = ∂e/∂S − N ∂q/∂S,   q = cos η/h,   N(1) = (1 + Δk₁) F,

e with the height of the rod. Solving with S and N of the last state and taking them anew converges, by the product of
curvature and end shortening a time. What changes is the error of the branch.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rodwell.analysis.discrete.choices import MOST_ELEMENTS_OF_BRANCH
from rodwell.analysis.discrete.curved import (
    HoleAlong,
    along_rod,
    hole_along,
    hole_at,
    rates_at,
)
from rodwell.analysis.discrete.measures import Measured, measured_meshes
from rodwell.analysis.discrete.pieces import PiecewisePolynomial
from rodwell.analysis.state.in_hole import InHole, curvature
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, FORCE, TWIST
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

MOST_ROUNDS = 40

SETTLED = 1e-12
"""Change of the shape, in radians around the hole, below which it has settled: in a round, or as the last two foretell
of the next one."""

BESIDE = 1e-9
"""Distance along the rod, in L, within which a kink of the mesh is beside a station: by about that part of the jump of
the contact its balance is off."""


def drive_rate(shape: InHole, s: FloatArray) -> FloatArray:
    """N′, and q T·k, (2, m) with the hole at the rod's own places."""
    y, y1, y2 = shape.shape(s, 3)
    places, d, problem = shape.place(s), shape.clearance, shape.problem
    (k1, k2, _, _), climb = hole_at(problem, places)
    stiffness, climb = problem.rod.stiffness(s), problem.rod.weight(s) * climb
    k1_rate, k2_rate = rates_at(problem, places)
    angle = y / d
    sin_a, cos_a = np.sin(angle), np.cos(angle)
    normal, geodesic, cos, _, h = curvature(angle, y1, y2, k1, k2, d)
    around = k1 * sin_a + k2 * cos_a
    inwards_rate, around_rate = k1_rate * cos_a - k2_rate * sin_a, k1_rate * sin_a + k2_rate * cos_a
    weight, twist = shape.parameters[AXIAL_WEIGHT], shape.parameters[TWIST]
    bent = normal * cos**2 * inwards_rate / h**2 + geodesic * cos * (around_rate - d * around * inwards_rate / h) / h
    turned = -twist * y1 * cos * inwards_rate / h**2
    drive = weight * climb * h + stiffness * bent + turned + shape.drive(s) * cos * d * inwards_rate / h**2
    return np.stack([drive, climb])


def tables_of(shape: InHole) -> HoleAlong:
    """The hole at the rod's own places, and the force that goes with it, as kernels take them."""
    p, breaks, problem = shape.parameters, shape.state.space.breaks, shape.problem
    rates = PiecewisePolynomial.each(breaks, lambda s: drive_rate(shape, s))
    driven, rise = (rate.integral_above() for rate in rates)
    last = 1.0 + shape.clearance * float(hole_at(problem, shape.place(np.array([1.0])))[0][0, 0])

    def functions(s: FloatArray) -> FloatArray:
        here, _ = hole_at(problem, shape.place(s))
        here[2:] *= problem.rod.weight(s)
        lift = rise(s)
        drive = last * p[FORCE] - driven(s)
        offset = drive / (1.0 + shape.clearance * here[0]) - p[FORCE] + p[AXIAL_WEIGHT] * lift
        return np.concatenate([here, lift[None], offset[None]])

    return hole_along(problem.rod, breaks, functions)


def with_own_places(
    problem: Problem, meshes: TwoMeshes, point: MeshedState, *, near: bool = False
) -> tuple[TwoMeshes, MeshedState]:
    """Solve a state of a curved hole with every cross-section at its own place; its energy is that of the rod there.

    The stability index counts directions in which the places stay. ``near``: not at the same end force, but on the
    plane through the state normal to its branch, which exists next to a critical load, too.

    Raises
    ------
    InputError
        If the hole is straight: places along it do not matter.
    NotConvergedError
        If that does not settle.
    """
    if problem.hole is None:
        raise InputError("build", problem.build, "must not be 0: along a straight hole every place is like another")
    if not point.fine.c.any():  # the rod on θ = 0 lies where the tables have it
        return meshes, point
    there, state, tables = _at_own_places(problem, meshes.fine, point.fine, near)
    coarse, space = meshes.coarse, there.space
    if space is not meshes.fine.space:
        coarse = coarse.on(SplineSpace(space.breaks[::2], space.degree, space.per_element, space.kinks))
    own = measured_meshes(_given(coarse, tables), meshes.rtol, MOST_ELEMENTS_OF_BRANCH)
    both = ((own.coarse, _solved(own.coarse, point.coarse, near)), (own.fine, state))
    states = (replace(x, energy=_energy(problem, f, x)) for f, x in both)
    return own, own.point(*states)


def _beside_stations(rod: InHole) -> SplineSpace:
    """The finer mesh of a rod, moved a little: its kinks beside stations where the rod itself has them.

    Those at steps of a string stay where they are.
    """
    space, hole, steps = rod.state.space, rod.problem.hole, rod.problem.rod.breaks
    beside = np.setdiff1d(space.kinks, steps)
    if hole is None or not beside.size:
        return space
    places = rod.place(beside)
    stations = hole.stations[np.argmin(np.abs(hole.stations[:, None] - places), axis=0)]
    for _ in range(3):  # Newton's method
        beside = beside - (rod.place(beside) - stations) / rod.step(beside)
    moved = space.kinks.copy()
    moved[~np.isin(moved, steps)] = beside
    if np.max(np.abs(moved - space.kinks)) <= BESIDE:
        return space
    before, after = (np.concatenate([[0.0], kinks, [1.0]]) for kinks in (space.kinks, moved))
    breaks = np.interp(space.breaks[::2], before, after)
    if not np.all(np.diff(breaks) > 0.0):
        return space
    return SplineSpace(breaks, space.degree, space.per_element, moved).refined()


def _at_own_places(problem: Problem, family: Family, state: State, near: bool) -> tuple[Family, State, HoleAlong]:
    """The state on the finer mesh, with the equations and the tables of the hole that it solves."""
    change = np.inf
    for _ in range(MOST_ROUNDS):
        before = change
        rod = InHole(problem, family, state)
        space = _beside_stations(rod)
        if space is not state.space:
            family, state = family.on(space), replace(state, space=space)
            rod = InHole(problem, family, state)
        tables = tables_of(rod)
        family = _given(family, tables)
        solved = _solved(family, state, near)
        change = float(np.max(np.abs(solved.c - state.c))) / family.scale_c
        state = solved
        if change <= SETTLED or (np.isfinite(before) and change**2 <= SETTLED * before):
            return family, state, tables
    raise NotConvergedError(
        f"the places of the rod in the hole did not settle: the shape still changes by {change:.1e} rad a round; "
        "the curvature is too large for this shortening"
    )


def near_by(problem: Problem, family: Family, state: State) -> tuple[Family, State]:
    """Solve for own places near a state of a branch, a little further on where the state is a branch point.

    There it is singular, and the places, which know no symmetry, leave nothing of it in its vicinity.

    Raises
    ------
    NotConvergedError
        As :func:`with_own_places` does.
    """
    if not state.c.any():
        return family, state
    try:
        return _at_own_places(problem, family, state, near=True)[:2]
    except NotConvergedError:
        further = family.step(state, FURTHER)
        if further is None:
            raise
        return _at_own_places(problem, family, further, near=True)[:2]


FURTHER = 0.02
"""How far along a branch from its branch point, in radians around the hole, about."""


def _given(family: Family, tables: HoleAlong) -> Family:
    """The family with other tables of the hole, in which no symmetry is exact."""
    return replace(family, given=tables, parity=0, reflections=())


def _solved(family: Family, state: State, near: bool) -> State:
    """The equilibrium next to a state, at its end force or on the plane normal to its branch."""
    target = float(state.row @ state.c) + state.row_lam * state.lam
    plane = (state.row, state.row_lam, target) if near else (np.zeros_like(state.c), 1.0, state.lam)
    outcome, solved, _ = family.correct(state.c, state.lam, *plane)
    if solved is None:
        reason = family.advice(outcome)
        raise NotConvergedError(f"the state could not be solved at its own places in the hole: {reason}")
    return solved


def _energy(problem: Problem, family: Family, state: State) -> float:
    """Energy relative to the undeformed rod."""
    still = replace(state, c=np.zeros_like(state.c))
    resting = replace(family, given=along_rod(problem))
    return InHole(problem, family, state).energy() - InHole(problem, resting, still).energy()


def lift_off_with_own_places(problem: Problem, meshes: TwoMeshes, point: MeshedState) -> Value:
    """End force of lift-off with every cross-section at its own place, by the secant rule on the contact pressure.

    ``point`` is a state of the branch at or near its lift-off. The error is that of the contact pressure on the two
    meshes, and the last step.

    Raises
    ------
    NotConvergedError
        If it is not found near that state.
    """

    def highest(force: float) -> tuple[float, float]:
        there = meshes.at(point, force)
        if there is None:
            raise NotConvergedError(f"no state at F = {force:.8g} B/L² on the branch: lift-off lies beyond its end")
        own = with_own_places(problem, meshes, there)[1]
        return float(own.values[Measured.P_MAX]), float(own.error[Measured.P_MAX])

    before, after = point.lam, point.lam * (1.0 + FIRST_CHANGE) + FIRST_CHANGE
    (p_before, _), (p_after, error) = highest(before), highest(after)
    for _ in range(MOST_ROUNDS):
        slope = (p_after - p_before) / (after - before)
        if slope == 0.0 or not np.isfinite(slope):
            break
        before, p_before, after = after, p_after, after - p_after / slope
        p_after, error = highest(after)
        if abs(after - before) <= CLOSE * abs(after):
            return Value(after, abs(after - before) + error / abs(slope))
    raise NotConvergedError("lift-off with every cross-section at its own place was not found near that of the branch")


FIRST_CHANGE, CLOSE = 1e-6, 1e-10
"""Parts of the load: the first step of the secant rule, and the last."""
