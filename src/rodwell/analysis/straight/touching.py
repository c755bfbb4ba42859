"""The straight rod that lies at the wall without being pressed to it: it can move inwards, not outwards.

Second variation on the cone x(s) ≥ 0: the load with the wall's help is the first at which it is not positive for some u
of the cone. It lies between the load without the wall, which it equals if a mode of that moves inwards only, and the
load of a rod kept on the wall, x = 0. A mode u of a rod whose ends hold x and y alike may be turned, exp(iφ)u: it moves
inwards if, as a curve, it stays within a half-plane.

Otherwise contact is found as in :mod:`rodwell.numerics.equilibria.one_sided`, on meshes that are refined where the wall
pushes: displacements have a jump of the third derivative there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from rodwell.analysis.straight.pencil import Pencil
from rodwell.numerics.equilibria.one_sided import OneSided
from rodwell.numerics.splines import pair
from rodwell.numerics.splines.held import Held
from rodwell.numerics.splines.spaces import Prolongation, SplineSpace
from rodwell.quantities.arrays import BoolArray, ComplexArray, FloatArray, IntArray

HALF_PLANE = 5e-3
"""Radians by which a mode may leave a half-plane: that changes the load by less than TURN times the cube of it."""

TURN = 0.5

INWARD = 1e-8
"""Part of the largest x that may be negative by round-off."""

NEAR_END = 1e-4
PLACES = 4001

STARTS, SHARES = 8, (0.0, 0.5, 1.0)
"""Phases of the first mode from which the cone is searched, and shares of the second that are added."""

MANY, ROUGHLY = 20.0, 1e-7
"""Twist in B/L from which contact in several places competes; relative change with which a start has settled."""

BELOW = 0.02
"""How far below the first eigenvalue the shift lies, as a part of the distance to the next."""

ROUNDS, STRONG, STEADY = 12, 1e-3, 0.25
"""Refinements at most; part of the largest multiplier from which the mesh is refined; part of its predecessor that
a change is not believed to be below: how it falls depends on where mesh points happen to lie."""


@dataclass(frozen=True)
class Touching:
    """λ = −F of the first mode on the cone, its error, whether the wall is not needed, contacts, and the mode."""

    value: float
    error: float
    moves_inward: bool
    contacts: tuple[tuple[float, float], ...]
    space: SplineSpace
    coefficients: ComplexArray


def first_inwards(pencil: Pencil, space: SplineSpace, turns: bool, tolerance: float) -> Touching:
    """The first mode with x ≥ 0.

    Parameters
    ----------
    pencil
        The two-field problem.
    space
        A mesh on which the load without the wall has converged; the search starts on it.
    turns
        Whether exp(iφ)u is a mode with u.
    tolerance
        Absolute tolerance of λ.
    """
    values, modes = pencil.lowest(space, 4, None)
    inward = _inward_mode(pencil, space, modes[0], turns)
    if inward is not None:
        mode, excess = inward
        return Touching(float(values[0]), TURN * excess**3, True, (), space, mode)
    return _search(pencil, space, (values, modes), tolerance)


def _inward_mode(
    pencil: Pencil, space: SplineSpace, mode: ComplexArray, turns: bool
) -> tuple[ComplexArray, float] | None:
    """The mode turned or reversed so that x ≥ 0, and by how many radians it misses that; None if it cannot be."""
    if pencil.twist == 0.0:  # x and y are independent, and x = 0 is held no less: the first load is that of y
        whole = turns and np.linalg.norm(mode.real) > np.linalg.norm(mode.imag)  # then both are multiples of one mode
        part = mode.real if whole else mode.imag
        return np.asarray(1j * part, dtype=np.complex128), 0.0
    inner = np.linspace(0.0, 1.0, PLACES)[1:-1]
    u = pair.evaluate(space, mode, np.concatenate([[NEAR_END], inner, [1.0 - NEAR_END]]), 1)[0]
    if turns:
        angles = np.unwrap(np.angle(u))
        low, high = float(np.min(angles)), float(np.max(angles))
        excess = max(0.0, high - low - np.pi)
        return (mode * np.exp(-0.5j * (low + high)), excess) if excess <= HALF_PLANE else None
    for sign in (1.0, -1.0):
        if np.min(sign * u.real) >= -INWARD * np.max(np.abs(u.real)):
            return sign * mode, 0.0
    return None


def _search(pencil: Pencil, space: SplineSpace, modes: tuple[FloatArray, ComplexArray], tolerance: float) -> Touching:
    values, vectors = modes
    shift = float(values[0] - BELOW * (values[-1] - values[0])) + pencil.lift
    cone, held, places = _cone(pencil, space, shift)
    quotient = partial(_quotient, pencil, space, held)
    many = abs(pencil.twist) > MANY
    starts = [pair.as_real(start)[held.free] for start in _starts(vectors, SHARES if many else SHARES[:1])]
    found = [cone.lowest(start, quotient, ROUGHLY) for start in starts]
    value, z, active, forces = min(found, key=lambda result: result[0])
    before = change = np.inf
    for _ in range(ROUNDS):
        finer = space.refined(_marked(space, places[active], forces))
        up, coarse = Prolongation(space, finer), _full(held, z)
        moved = up(np.ascontiguousarray(coarse.real)) + 1j * up(np.ascontiguousarray(coarse.imag))
        space = finer
        cone, held, places = _cone(pencil, space, shift)
        better, z, active, forces = cone.lowest(pair.as_real(moved)[held.free], partial(_quotient, pencil, space, held))
        before, change, value = change, abs(better - value), better
        if change <= 0.1 * tolerance:
            break
    mode = _full(held, z)
    error = 2.0 * max(change, STEADY * min(before, 10.0 * tolerance))
    return Touching(value, error, False, _contacts(space, mode, places, active), space, mode)


def _quotient(pencil: Pencil, space: SplineSpace, held: Held, z: FloatArray) -> float:
    return pencil.quotient(space, _full(held, z))


def _full(held: Held, z: FloatArray) -> ComplexArray:
    return pair.as_complex(held.spread(z))


def _cone(pencil: Pencil, space: SplineSpace, shift: float) -> tuple[OneSided, Held, FloatArray]:
    """The cone on a mesh, with x looked at in a few places of each element."""
    held = pencil.held(space)
    places = space.samples[0][1:]
    table, first = space.tabulated(places, 1)
    rows = np.zeros((places.size, 2 * space.size))
    for a in range(space.degree + 1):
        rows[np.arange(places.size), 2 * (first + a)] = table[:, 0, a]
    free = rows[:, held.free]  # no coefficient of x follows another: ends hold x, x and x′, or nothing
    looked = np.max(np.abs(free), axis=1) > 0.0  # not where an end holds x
    stiffness, gram = (held.free_part(band) for band in pencil.bands(space))
    return OneSided(stiffness, gram, free[looked], shift), held, places[looked]


def _starts(vectors: ComplexArray, shares: tuple[float, ...]) -> Iterator[ComplexArray]:
    """Combinations of the first modes: every phase, alone and with the next modes."""
    for share in shares:
        for k in range(STARTS):
            turn = 2.0 * np.pi * k / STARTS
            first = np.cos(turn) * vectors[0] + np.sin(turn) * vectors[1]
            for other in (0.0, 1.0, 2.0, 3.0) if share else (0.0,):
                angle = 0.5 * np.pi * other
                yield first + share * (np.cos(angle) * vectors[2] + np.sin(angle) * vectors[3])


def _marked(space: SplineSpace, places: FloatArray, forces: FloatArray) -> BoolArray:
    """Elements in and beside which the wall pushes with more than a little force."""
    marked = np.zeros(space.elements, dtype=np.bool_)
    if not forces.size:
        marked[:] = True
        return marked
    for s in places[forces > STRONG * np.max(forces)]:
        element = int(np.clip(np.searchsorted(space.breaks, s, side="right") - 1, 0, space.elements - 1))
        marked[max(0, element - 2) : element + 3] = True
    return marked


def _contacts(
    space: SplineSpace, mode: ComplexArray, places: FloatArray, active: IntArray
) -> tuple[tuple[float, float], ...]:
    """Stretches in contact: active places with nothing to speak of between them, ends of the rod included."""
    fine = np.linspace(0.0, 1.0, PLACES)
    x = pair.evaluate(space, mode, fine, 1)[0].real
    flat = 1e-6 * np.max(np.abs(x))
    stretches: list[tuple[float, float]] = []
    for s in places[active]:
        last = stretches[-1] if stretches else (0.0, 0.0)
        between = x[(fine > last[1]) & (fine < s)]
        if (stretches or s < 0.5) and (not between.size or np.max(between) < flat):
            stretches[-1:] = [(last[0], float(s))]
        else:
            stretches.append((float(s), float(s)))
    if stretches and stretches[-1][0] > 0.5 and np.max(x[fine > stretches[-1][1]], initial=0.0) < flat:
        stretches[-1] = (stretches[-1][0], 1.0)
    return tuple(stretches)
