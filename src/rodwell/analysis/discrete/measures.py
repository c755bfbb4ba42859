"""The numbers that every state of a branch is measured by, and the scales of their errors."""

from __future__ import annotations

from enum import IntEnum
from weakref import WeakKeyDictionary

import numpy as np

from rodwell.analysis.discrete import by_arrays
from rodwell.analysis.discrete.pressures import (
    COEFFICIENT_NOISE,
    Tables,
    balanced,
    derivative,
    free_ends,
    tables_for,
    tabulate_places,
    totals,
)
from rodwell.compiling.kernels import direct, kernel
from rodwell.compiling.second_process import wait_for
from rodwell.errors import unknown_name
from rodwell.numerics.equilibria.error import larger
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.maxima import MOST_MAXIMA, maxima
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import TwoMeshes
from rodwell.numerics.splines.basis import combine
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.curved import RodInCurvedHole
from rodwell.physics.on_wall.parameters import CLEARANCE, RAMP, SIDE
from rodwell.physics.on_wall.ramps import RodOnRamps
from rodwell.physics.on_wall.tapered import RodOfTapers
from rodwell.quantities.arrays import FloatArray

NEAR_THE_TOP = 0.05
"""Sampled maxima of the contact pressure within this part of its range from the highest are refined."""

HALF = 0.5
"""Part of the tolerance to which the highest pressure is held: the certificate looks at the pressure everywhere."""

SOFT = 2e-12
"""Round-off in what a soft direction of the rod moves, relative to its scale: the angle at mid-length, the torque."""

ROOM = 3
"""Elements of the finer mesh that a rod in a curved hole may have, over those of its first coarse mesh: 2 of these it
has at first."""

OTHER_END = 4.0
"""How many times the moment that the spline has at an end that turns freely, where there is none, the error of the
curvature at the other end may be."""


BY_ARRAYS = RodInCurvedHole, RodOfTapers, RodOnRamps
"""Models that are measured by arrays: kernels know coefficients that are constant in each section."""


class Measured(IntEnum):
    """Position of each measured number. Units B = L = 1; signs as in the nomenclature."""

    P_MAX = 0  # largest contact pressure p₂⁽¹⁾ over s, (55)
    ENERGY = 1  # relative to the straight rod
    SHORTENING = 2  # 1 − z(1), (44)
    OMEGA2_0 = 3  # ω₂(0), (20)₂
    OMEGA2_1 = 4
    ANGLE_MID = 5  # y(½)/Δ = ξ₂(½) − ξ₂ of the straight rod
    TORQUE_0 = 6  # T₂(0), (33): what the support of the cylinder at s = 0 must provide


MEASURES = {
    Measured.P_MAX: "largest_pressure",
    Measured.ENERGY: "energy",
    Measured.SHORTENING: "end_shortening",
    Measured.OMEGA2_0: "omega2_at_0",
    Measured.OMEGA2_1: "omega2_at_1",
    Measured.ANGLE_MID: "angle_at_middle",
    Measured.TORQUE_0: "support_torque",
}
"""Names of the measured numbers, as in the nomenclature."""

SOFT_ONES = (int(Measured.ANGLE_MID), int(Measured.TORQUE_0))
"""Those that a soft direction of the rod moves, as plain numbers: kernels take no others as indices with Numba below
0.68."""

_NAMED = {name: which for which, name in MEASURES.items()}


def measured(which: Measured | str) -> Measured:
    """Return the measured number of a name in the nomenclature.

    Raises
    ------
    InputError
        If no measured number has that name.
    """
    if isinstance(which, int):
        return Measured(which)
    if which not in _NAMED:
        raise unknown_name("number", which, _NAMED)
    return _NAMED[which]


STEEPEST = len(Measured)
"""Position, after the measured numbers, of max |sin η| over the quadrature points: a guard, not reported."""

AS_FIELD = STEEPEST + 1
"""Position of the highest contact pressure as a field has it, from the spline's own third derivative: it is held to the
tolerance too, so that fields along the rod keep their digits, and the paper's equations are met. Of what is measured by
arrays, whose highest pressure is the field's anyway, it is the lowest: the largest contact force, often elsewhere."""

PROBED = AS_FIELD + 1
"""Position of the contact pressure at the first of the :data:`PROBES`."""

PROBES = (0.21, 0.46, 0.5, 0.78)
"""Places at which the contact pressure is compared on both meshes, where these may agree by chance on the largest."""


@kernel
def state_numbers(mesh, knots, landmarks, marks, tables, known, c, parameters, energy, places, sizes, lowest):
    """Return rows of (3, 13): the :class:`Measured` numbers, the scales of their errors, what round-off leaves in them.

    The second result is the contact pressure at ``places`` (k,), from the balance of forces.

    ``landmarks`` (3, 3, p+1) are the basis functions at both ends and in the middle, in the elements ``marks`` (3,).
    ``tables`` have room for the PROBES and then for the ``places`` (k,) of maxima of the contact pressure; the first
    ``known`` rows are filled. ``sizes`` (k,) is what the spline has at the places, ``lowest`` the least of that.
    """
    clearance, ramp = parameters[CLEARANCE], parameters[RAMP]
    first, count = len(PROBES), places.size
    shear, values, left = np.empty(mesh.starts.size + 1), np.empty(first + count), np.empty(first + count)
    for i in range(count):
        tables[0][first + i] = places[i]
    free = free_ends(mesh.starts[-1] + len(mesh.local) - 1, mesh.held, mesh.follows)
    shortening, torque, bending, torque_size, sharpest, widest, steepest = totals(
        mesh, knots, landmarks, free, c, parameters, shear
    )
    tabulate_places(mesh.local, knots, mesh.starts, mesh.points, tables, known, first + count)
    balanced(mesh, knots, free, c, parameters, shear, tables, values, left)
    highest = as_field = -np.inf
    unsure = 0.0
    for i in range(count):
        highest, as_field = larger(highest, values[first + i]), larger(as_field, sizes[i])
        unsure = larger(unsure, left[first + i])
    u, omega2, noise = np.empty((3, 3)), np.empty(3), np.empty(3)  # place, derivative
    for i in range(3):
        combine(mesh.local, landmarks, i, c, marks[i], u[i])
        bend, size = derivative(landmarks[i], 2, c, marks[i])
        omega2[i], noise[i] = -bend / np.sqrt(1.0 - (u[i, 1] + ramp) ** 2), COEFFICIENT_NOISE * size
        if i != 1 and free[i + 1]:  # no moment where the end turns: what the spline has there tells how far it is off
            omega2[i], noise[i] = 0.0, OTHER_END * abs(bend)
    numbers = (
        highest, energy, shortening, omega2[0], omega2[2], (u[1, 0] + 0.5 * ramp) / clearance, torque,
        steepest, as_field,
    )  # fmt: skip
    bent = max(sharpest, steepest**2 / clearance)  # ω₂, or ω₃ where that is larger: a helix has ω₂ = 0
    most = HALF * max(abs(highest), abs(lowest))
    scales = most, max(abs(energy), bending), shortening, bent, bent, widest, torque_size, np.inf, most
    left_in = unsure, 0.0, 0.0, noise[0], noise[2], 0.0, 0.0, 0.0, 0.0
    out = np.zeros((3, PROBED + len(PROBES)))
    for k in range(PROBED):
        # numbers that vanish identically (the straight rod, no lateral weight) have the scale 1
        out[0, k], out[1, k], out[2, k] = numbers[k], scales[k] if scales[k] != 0.0 else 1.0, left_in[k]
    for k in SOFT_ONES:
        out[2, k] = SOFT * out[1, k]
    for k in range(first):
        out[0, PROBED + k], out[1, PROBED + k] = values[k], np.inf
    return out, values[first:]


_quick_numbers, _quick_maxima = direct(state_numbers), direct(maxima)

_tables: WeakKeyDictionary[SplineSpace, Tables] = WeakKeyDictionary()
"""For each space, tables that are filled at the :data:`PROBES`: the states of a branch are all measured on a few."""

LINKS = tuple((int(Measured.P_MAX), PROBED + i) for i in range(len(PROBES)))
"""The error of the largest contact pressure is not much below that of the pressure at some places that stay
where they are."""

GROUPS = ((int(Measured.OMEGA2_0), int(Measured.OMEGA2_1)),)
"""Measured numbers of one kind: the end curvatures."""


def measured_meshes(family: Family, rtol: float, most_elements: int) -> TwoMeshes:
    """Return the meshes on which states of ``family`` are measured to a tolerance.

    A long string in a curved hole begins with more elements than are allowed; it may be refined where it is bent.
    """
    if isinstance(family.model, RodInCurvedHole):
        most_elements = max(most_elements, ROOM * family.space.elements)
    return TwoMeshes(family, measure, rtol, most_elements, GROUPS, LINKS)


def measure(family: Family, state: State) -> FloatArray:
    """Return the :class:`Measured` numbers of a state, the scales of their errors and what round-off leaves, (3, 13).

    Behind them stand STEEPEST, AS_FIELD, and the contact pressure at the :data:`PROBES`. Round-off in the terms of a
    spline's derivatives comes out of these enlarged by h⁻¹, h⁻².
    """
    p = family.parameters(state.lam)
    found = _maxima(family, state.c, p)
    if isinstance(family.model, BY_ARRAYS):
        return _by_arrays(family, state, found)
    return _by_loops(family, state, p, *found)[0]


def _by_loops(
    family: Family, state: State, parameters: FloatArray, places: FloatArray, sizes: FloatArray, lowest: float
) -> tuple[FloatArray, FloatArray]:
    """The same from compiled loops, and the contact pressure at ``places``."""
    space, room = family.space, len(PROBES) + places.size
    tables, known = _tables.get(space), len(PROBES)
    if tables is None or tables[0].size < room:
        tables, known = tables_for(space, max(room, len(PROBES) + MOST_MAXIMA)), 0
        tables[0][: len(PROBES)] = PROBES
        _tables[space] = tables
    wait_for("state_numbers")
    numbers, pressures = _quick_numbers(
        family.mesh, space.knots, *space.landmarks, tables, known, state.c, parameters, state.energy,
        *(places, sizes, lowest),
    )  # fmt: skip
    return numbers, pressures


def _by_arrays(family: Family, state: State, found: tuple[FloatArray, FloatArray, float]) -> FloatArray:
    """The same from plain arrays."""
    places, values, lowest = found
    clearance, ramp = (float(family.parameters(state.lam)[which]) for which in (CLEARANCE, RAMP))
    out = np.zeros((3, PROBED + len(PROBES)))
    numbers, scales, noise = out
    known = by_arrays.totals(family, state)
    probed, left = by_arrays.pressures(family, state, np.array([*PROBES, *places]))
    bends = by_arrays.end_curvatures(family, state)
    mesh = family.mesh
    _, turns_0, _, turns_1 = free_ends(mesh.starts[-1] + len(mesh.local) - 1, mesh.held, mesh.follows)
    numbers[Measured.P_MAX], scales[Measured.P_MAX] = np.max(values), HALF * max(abs(np.max(values)), abs(lowest))
    noise[Measured.P_MAX] = np.max(left[len(PROBES) :])
    numbers[Measured.ENERGY], scales[Measured.ENERGY] = state.energy, max(abs(state.energy), known["bending"])
    numbers[Measured.SHORTENING], scales[Measured.SHORTENING] = known["shortening"], known["shortening_size"]
    for which, bend, turns in ((Measured.OMEGA2_0, bends[0], turns_0), (Measured.OMEGA2_1, bends[1], turns_1)):
        # no moment where the end turns freely: what the spline has there tells how far it is off
        numbers[which], noise[which] = (0.0, OTHER_END * abs(bend)) if turns else (bend, 0.0)
        scales[which] = max(known["sharpest"], known["steepest"] ** 2 / clearance)
    middle = float(state.space.evaluate(state.c, np.array([0.5]), 1)[0, 0])
    middle += 0.5 * ramp
    numbers[Measured.ANGLE_MID], scales[Measured.ANGLE_MID] = middle / clearance, known["widest"]
    numbers[Measured.TORQUE_0], scales[Measured.TORQUE_0] = known["torque"], known["torque_size"]
    for soft in SOFT_ONES:
        noise[soft] = SOFT * scales[soft]
    numbers[STEEPEST], scales[STEEPEST] = known["steepest"], np.inf
    scales[:STEEPEST][scales[:STEEPEST] == 0.0] = 1.0
    numbers[AS_FIELD], scales[AS_FIELD] = _lowest_pressure(family, state), scales[Measured.P_MAX]
    numbers[PROBED:], scales[PROBED:] = probed[: len(PROBES)], np.inf
    return out


def _lowest_pressure(family: Family, state: State) -> float:
    """The lowest contact pressure: less the highest of a rod on the other side of the wall, where p counts reversed."""
    turned = family.parameters(state.lam)
    turned[SIDE] = -turned[SIDE]
    return -float(np.max(_maxima(family, state.c, turned)[1]))


def _maxima(family: Family, c: FloatArray, parameters: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Places and values (k,) of maxima of the contact pressure near its highest, and its lowest sample.

    Between steps of the stiffness, where the pressure jumps, each stretch has its own; at its upper end that is the
    value just below the step.
    """
    space, mesh = family.space, family.mesh
    if not space.kinks.size:
        places, values, lowest = _quick_maxima(mesh, space.knots, *space.samples, c, parameters, NEAR_THE_TOP)
        return places, values, lowest
    found = []
    for elements, functions, knots, grid, table in space.pieces:
        points = slice(elements.start * space.per_element, elements.stop * space.per_element)
        piece = mesh._replace(starts=space.starts[elements] - functions.start, given=mesh.given[points])
        found.append(_quick_maxima(piece, knots, grid, table, c[functions], parameters, NEAR_THE_TOP))
    places, values = (np.concatenate([one[k] for one in found]) for k in (0, 1))
    lowest = min(one[2] for one in found)
    high = values >= np.max(values) - NEAR_THE_TOP * (np.max(values) - lowest)
    return places[high], values[high], float(lowest)


def pressure_maxima(
    family: Family, state: State, parameters: FloatArray | None = None
) -> tuple[FloatArray, FloatArray, float]:
    """Places and values of the highest maxima of the contact pressure, and its lowest sampled value."""
    p = family.parameters(state.lam) if parameters is None else parameters
    places, _, lowest = _maxima(family, state.c, p)
    if isinstance(family.model, BY_ARRAYS):
        return places, by_arrays.pressures(family, state, places)[0], float(lowest)
    return places, balanced_pressures(family, state, p, places), float(lowest)


def balanced_pressures(family: Family, state: State, parameters: FloatArray, places: FloatArray) -> FloatArray:
    """Contact pressure (k,) at ``places`` (k,) from the balance of forces."""
    return _by_loops(family, state, parameters, places, np.zeros_like(places), 0.0)[1]
