"""The numbers that every state of a branch is measured by, and the scales of their errors."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import Any

import numpy as np

from rodwell.compiling.kernels import kernel
from rodwell.compiling.second_process import wait_for
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.maxima import maxima
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import TwoMeshes
from rodwell.numerics.splines.assembly import SHARED, at_points
from rodwell.numerics.splines.basis import combine
from rodwell.numerics.splines.lanes import on_lanes
from rodwell.physics.on_wall.parameters import CLEARANCE, LATERAL_WEIGHT, RAMP, TWIST
from rodwell.quantities.arrays import FloatArray

NEAR_THE_TOP = 0.05
"""Sampled maxima of the contact pressure within this part of its range from the highest are refined."""


HALF = 0.5
"""Part of the tolerance to which the highest pressure is held: the certificate looks at the pressure everywhere."""

COEFFICIENT_NOISE = 4.0 * float(np.finfo(float).eps)
"""Round-off in the coefficients of a state, relative to the largest: some units in the last place."""


class Measured(IntEnum):
    """Position of each measured number. Units B = L = 1; signs as in the nomenclature."""

    P_MAX = 0  # largest contact pressure p₂⁽¹⁾ over s, (55)
    ENERGY = 1  # relative to the straight rod
    SHORTENING = 2  # 1 − z(1), (44)
    OMEGA2_0 = 3  # ω₂(0), (20)₂
    OMEGA2_1 = 4
    ANGLE_MID = 5  # y(½)/Δ = ξ₂(½) − ξ₂ of the straight rod
    TORQUE_0 = 6  # T₂(0), (33): what the support of the cylinder at s = 0 must provide


STEEPEST = len(Measured)
"""Position, after the measured numbers, of max |sin η| over the quadrature points: a guard, not reported."""


TOTALS = 7


def _added(rows: Any, parameters: Any) -> Sequence[Any]:
    """Totals over the points of an element, added to those that follow what is known at the points in ``rows``."""
    s, weight, y, y1, y2, *totals = (rows[i] for i in range(SHARED + 3 + TOTALS))
    clearance, ramp = parameters[CLEARANCE], parameters[RAMP]
    y, y1 = y + ramp * s, y1 + ramp
    cos_eta = np.sqrt(1.0 - y1 * y1)
    omega2 = y2 / cos_eta
    lateral = clearance * parameters[LATERAL_WEIGHT] * np.sin(y / clearance)
    integrands = y1 * y1 / (1.0 + cos_eta), -lateral, 0.5 * omega2 * omega2, np.absolute(lateral)
    sizes = omega2, y / clearance, y1
    sums = [total + weight * x for total, x in zip(totals, integrands, strict=False)]
    return [*sums, *(np.maximum(total, np.absolute(x)) for total, x in zip(totals[4:], sizes, strict=True))]


_add = on_lanes(lambda _: _added)


@kernel
def _totals(mesh, c, parameters):
    """∫(1 − cos η), T₂(0) = −∫ Δ wₗ sin ξ₂, and scales: ½∫ω₂², ∫Δ wₗ |sin ξ₂|, max |ω₂|, |ξ₂|, |sin η|."""
    rows = np.zeros((SHARED + 3 + TOTALS, len(mesh.per_element)))
    totals = rows[SHARED + 3 :]
    uniforms = (parameters,)
    for element in range(mesh.starts.size):
        at_points(mesh, c, element, rows)
        _add(mesh.model, mesh.per_element, rows, uniforms, totals)
    shortening, torque, bending, torque_size = totals[0].sum(), totals[1].sum(), totals[2].sum(), totals[3].sum()
    return shortening, torque, bending, torque_size, totals[4].max(), totals[5].max(), totals[6].max()


@kernel
def _numbers(mesh, landmarks, marks, c, parameters, energy, highest, lowest, smallest):
    """Rows of (3, 8): the :class:`Measured` numbers, the scales of their errors, and what round-off leaves in them.

    ``landmarks`` (3, 3, p+1) are the basis functions at both ends and in the middle, in the elements ``marks`` (3,);
    ``highest`` and ``lowest`` are contact pressures, ``smallest`` is the length of the smallest element.
    """
    clearance, ramp = parameters[CLEARANCE], parameters[RAMP]
    shortening, torque, bending, torque_size, sharpest, widest, steepest = _totals(mesh, c, parameters)
    u = np.empty((3, 3))  # place, derivative
    for i in range(3):
        combine(mesh.local, landmarks, i, c, marks[i], u[i])
        u[i, 1] += ramp
    out = np.zeros((3, STEEPEST + 1))
    numbers, scales, noise = out
    numbers[Measured.P_MAX], scales[Measured.P_MAX] = highest, HALF * max(abs(highest), abs(lowest))
    numbers[Measured.ENERGY], scales[Measured.ENERGY] = energy, max(abs(energy), bending)
    numbers[Measured.SHORTENING] = scales[Measured.SHORTENING] = shortening
    numbers[Measured.OMEGA2_0] = -u[0, 2] / np.sqrt(1.0 - u[0, 1] ** 2)
    numbers[Measured.OMEGA2_1] = -u[2, 2] / np.sqrt(1.0 - u[2, 1] ** 2)
    # the scale is ω₂, or ω₃ where that is larger: a helix has ω₂ = 0
    scales[Measured.OMEGA2_0] = scales[Measured.OMEGA2_1] = max(sharpest, steepest**2 / clearance)
    numbers[Measured.ANGLE_MID], scales[Measured.ANGLE_MID] = (u[1, 0] + 0.5 * ramp) / clearance, widest
    numbers[Measured.TORQUE_0], scales[Measured.TORQUE_0] = torque, torque_size
    numbers[STEEPEST], scales[STEEPEST] = steepest, np.inf
    for k in range(STEEPEST):
        if scales[k] == 0.0:  # numbers that vanish identically: the straight rod, no lateral weight
            scales[k] = 1.0
    lever = 4.0 * steepest / clearance + abs(parameters[TWIST])
    noise[Measured.P_MAX] = COEFFICIENT_NOISE * np.max(np.abs(c)) / smallest**3 * lever
    return out


GROUPS = ((int(Measured.OMEGA2_0), int(Measured.OMEGA2_1)),)
"""Measured numbers of one kind: the end curvatures."""


def shape(family: Family, state: State, s: FloatArray, orders: int, c: FloatArray | None = None) -> FloatArray:
    """Y and its derivatives at ``s`` (m,), (orders, m): the spline (with coefficients ``c``, if given) and the ramp."""
    out = state.space.evaluate(state.c if c is None else c, s, orders)
    ramp = family.parameters(state.lam)[RAMP]
    out[0] += ramp * s
    if orders > 1:
        out[1] += ramp
    return out


def measured_meshes(family: Family, rtol: float, most_elements: int) -> TwoMeshes:
    """Return the meshes on which states of ``family`` are measured to a tolerance."""
    return TwoMeshes(family, measure, rtol, most_elements, GROUPS)


def measure(family: Family, state: State) -> FloatArray:
    """Return the :class:`Measured` numbers of a state, the scales of their errors and what round-off leaves, (3, 8).

    STEEPEST stands last. A spline's third derivative is its coefficients' third difference over h³: round-off in them
    comes out of it enlarged by h⁻³, and enters the contact pressure with the lever 3ω₁ + T₁ + ω₁, (53)–(55).
    """
    space, p = state.space, family.parameters(state.lam)
    _, values, lowest = pressure_maxima(family, state, p)
    return np.asarray(
        _numbers(family.mesh, *space.landmarks, state.c, p, state.energy, values.max(), lowest, space.smallest)
    )


def pressure_maxima(
    family: Family, state: State, parameters: FloatArray | None = None
) -> tuple[FloatArray, FloatArray, float]:
    """Places and values of the highest maxima of the contact pressure, and its lowest sampled value."""
    space, p = state.space, family.parameters(state.lam) if parameters is None else parameters
    wait_for("maxima")
    places, values, lowest = maxima(family.mesh, space.knots, *space.samples, state.c, p, NEAR_THE_TOP)
    return places, values, float(lowest)
