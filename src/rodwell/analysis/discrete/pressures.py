"""The largest contact pressure from the balance of forces: without a third derivative of the spline.

The contact pressure takes y‴, and the third derivative of a spline enlarges round-off in its coefficients by h⁻³, at a
free end some hundred times more. But y‴ follows from y, y′, y″ and the natural boundary term V = ∂e/∂y′ − (∂e/∂y″)′,
and V from integrals: V′ = ∂e/∂y, and V = 0 where an end does not hold y. Where both ends hold it, V(0) follows from
the balance of moments,

    V(0) = ∫ ∂e/∂y′ ds − ∫ (1 − s) ∂e/∂y ds − [∂e/∂y″]₀¹.

Where the stiffness jumps, V and ∂e/∂y″ do not: nothing changes.

What is left of round-off is that of y″, enlarged by h⁻², and where an end does not hold y′ it is zero: y″ = 0 there.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rodwell.compiling.kernels import formula, inlined
from rodwell.numerics.equilibria.error import larger
from rodwell.numerics.splines.assembly import SHARED, at_points
from rodwell.numerics.splines.basis import AT_ONCE, MOST_ORDERS, element_of, find_span, side_by_side
from rodwell.numerics.splines.lanes import on_lanes
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.parameters import CLEARANCE, LATERAL_WEIGHT, RAMP
from rodwell.quantities.arrays import FloatArray

COEFFICIENT_NOISE = 2.0 * float(np.finfo(float).eps)
"""Round-off in derivatives of a spline, relative to the sum of the sizes of their terms: some units in the last
place."""

TOTALS, SUMS = 9, 6
"""Numbers gathered over the points, and how many of them, the first, are sums; the others are largest values."""

STIFFNESS, WEIGHT = 0, 1
"""Columns of what is given of a string of sections: constant in each element."""

CHANGED = (0,) * 5
"""As long as the stencil in which y′ and y″ are changed one at a time."""

CHANGE = 1e-5
"""By which part of the size of their terms."""


STILL = (0.0,) * (RAMP + 1)
"""No parameter changes."""

Tables = tuple[FloatArray, NDArray[np.int64], FloatArray, FloatArray, FloatArray]
"""What does not depend on a state at places (k,): the places; the element of each, and the part of that before it;
basis functions and two derivatives, (k, 3, p+1); basis functions at the element's Gauss points, moved to where only the
part before the place is integrated over, (k, points of an element, p+1)."""


def tables_for(space: SplineSpace, count: int) -> Tables:
    """Room for what is known at ``count`` places."""
    local = space.degree + 1
    basis, inner = np.zeros((count, 3, local)), np.zeros((count, space.per_element, local))
    return np.zeros(count), np.zeros(count, dtype=np.int64), np.zeros(count), basis, inner


def _adding(model: Any, rows: Any, parameters: Any) -> Sequence[Any]:
    """Totals over the points of an element, added to those that follow what is known at the points in ``rows``."""
    count = len(model.given())
    s, weight, y, y1, y2 = (rows[i] for i in range(SHARED + 3))
    given, totals = ([rows[SHARED + 3 + i] for i in part] for part in (range(count), range(count, count + TOTALS)))
    clearance, ramp = parameters[CLEARANCE], parameters[RAMP]
    _, _, gradient, _, _ = model.density(s, (y, y1, y2), given, parameters, STILL)
    y, y1 = y + ramp * s, y1 + ramp
    cos_eta = np.sqrt(1.0 - y1 * y1)
    omega2 = y2 / cos_eta
    stiffness = given[0] if given else 1.0
    lateral = clearance * gradient[0]
    sums = (
        y1 * y1 / (1.0 + cos_eta), -lateral, 0.5 * stiffness * omega2 * omega2, np.absolute(lateral),
        gradient[1], (1.0 - s) * gradient[0],
    )  # fmt: skip
    sizes = omega2, y / clearance, y1
    added = [total + weight * x for total, x in zip(totals, sums, strict=False)]
    return [*added, *(np.maximum(total, np.absolute(x)) for total, x in zip(totals[SUMS:], sizes, strict=True))]


_add = on_lanes(lambda model: lambda rows, parameters: _adding(model, rows, parameters))


def _pressed(model: Any, rows: Any, parameters: Any) -> Sequence[Any]:
    """Contact pressure, negative in contact, from s, y, y′, y″, V and what is given."""
    s, y, y1, y2, shear = (rows[i] for i in range(5))
    given = [rows[5 + i] for i in range(len(model.given()))]
    _, _, gradient, _, hessian = model.density(s, (y, y1, y2), given, parameters, STILL)
    y3 = (gradient[1] - shear - hessian[1][2] * y2) / hessian[2][2]
    return (model.observed(s, (y, y1, y2, y3), given, parameters),)


_pressure = on_lanes(lambda model: lambda rows, parameters: _pressed(model, rows, parameters))


@formula
def free_ends(last, held, follows):
    """Whether y, and whether y′, is free at s = 0, and the same at s = 1; ``last`` is the number of the last function.

    What is ``held`` (h,), and what ``follows`` what, is that of a :class:`Discretisation`.
    """
    loose_0 = turns_0 = loose_1 = turns_1 = True
    for k in range(held.size):
        i, tied = held[k], follows[k] != held[k]
        if i == 0:
            loose_0, turns_0 = tied, turns_0 and not tied
        elif i == last:
            loose_1, turns_1 = tied, turns_1 and not tied
        elif i == 1:
            turns_0 = False
        elif i == last - 1:
            turns_1 = False
    return loose_0, turns_0, loose_1, turns_1


@inlined
def _balance(mesh, knots, ends, free, c, ramp, push, lever, shear):
    """Turn integrals of ∂e/∂y up to mesh points, in ``shear``, into V there.

    ``push`` is ∫∂e/∂y′, ``lever`` ∫(1 − s) ∂e/∂y.
    """
    count, local = shear.size, len(mesh.local)
    loose_0, turns_0, loose_1, turns_1 = free
    whole = shear[count - 1]
    if loose_0 and loose_1:  # from the nearer end
        for i in range(count):
            if i == count - 1 or knots[local - 1 + mesh.starts[i]] > 0.5:
                shear[i] -= whole
        return
    start = 0.0
    if loose_1:
        start = -whole
    elif not loose_0:
        start = push - lever
        for end, turns, sign in ((0, turns_0, 1.0), (-1, turns_1, -1.0)):
            if not turns:
                slope, bend = ramp, 0.0
                for a in range(local):
                    slope += ends[end, 1, a] * c[mesh.starts[end] + a]
                    bend += ends[end, 2, a] * c[mesh.starts[end] + a]
                if mesh.given.shape[1] > 0:
                    bend *= mesh.given[end, STIFFNESS]
                start += sign * bend / (1.0 - slope * slope)
    for i in range(count):
        shear[i] += start


@inlined
def totals(mesh, knots, ends, free, c, parameters, shear):
    """Integrals over the rod and largest values; write to ``shear`` (elements + 1,) V at mesh points.

    ``ends`` has the basis functions and two derivatives at both ends, first and last; ``free`` is what
    :func:`free_ends` tells of them.

    Returns
    -------
    ∫(1 − cos η), T₂(0) = −∫ Δ wₗ sin ξ₂, ½∫ω₂², ∫Δ wₗ |sin ξ₂|, max |ω₂|, |ξ₂|, |sin η|
    """
    known = SHARED + 3 + mesh.given.shape[1]
    rows = np.zeros((known + TOTALS, len(mesh.per_element)))
    found, gathered = rows[known:], np.zeros(TOTALS)
    uniforms, clearance = (parameters,), parameters[CLEARANCE]
    shear[0] = 0.0
    for element in range(mesh.starts.size):
        at_points(mesh, c, element, rows)
        _add(mesh.model, mesh.per_element, rows, uniforms, found)
        pushed = 0.0
        for i in range(found.shape[1]):
            pushed += found[1, i]
        shear[element + 1] = -pushed / clearance
    for k in range(TOTALS):
        for i in range(found.shape[1]):
            gathered[k] = gathered[k] + found[k, i] if k < SUMS else larger(gathered[k], found[k, i])
    _balance(mesh, knots, ends, free, c, parameters[RAMP], gathered[4], gathered[5], shear)
    return (
        gathered[0], gathered[1], gathered[2], gathered[3],
        gathered[6], gathered[7], gathered[8],
    )  # fmt: skip


@inlined
def tabulate_places(local_tag, knots, starts, points, tables, begin, end):
    """Fill the rows from ``begin`` to ``end`` of tables whose places are known.

    ``starts`` are the first functions, ``points`` the Gauss points of all elements. ``local_tag`` is a tuple of p + 1
    zeros.
    """
    degree = len(local_tag) - 1
    per_element = points.size // starts.size
    places, elements, shares, basis, inner = tables
    x, out = np.empty((1, AT_ONCE)), np.empty((MOST_ORDERS, degree + 1, AT_ONCE))
    for k in range(begin, end):
        span = find_span(knots, degree, places[k])
        low, element = knots[span], element_of(starts, span - degree)
        elements[k], shares[k] = element, (places[k] - low) / (knots[span + 1] - low)
        for first in range(0, per_element + 1, AT_ONCE):  # the place itself, and then the points
            for i in range(AT_ONCE):
                point = points[element * per_element + min(max(first + i - 1, 0), per_element - 1)]
                x[0, i] = places[k] if first + i == 0 else low + (point - low) * shares[k]
            side_by_side(local_tag, knots, span, x, out)
            for i in range(min(AT_ONCE, per_element + 1 - first)):
                for a in range(degree + 1):
                    if first + i > 0:
                        inner[k, first + i - 1, a] = out[0, a, i]
                    for order in range(3 if first + i == 0 else 0):
                        basis[k, order, a] = out[order, a, 0]


@inlined
def _shear_at(mesh, knots, c, parameters, shear, element, share, inner):
    """V at a place: ∂e/∂y is integrated from the last mesh point, over a part ``share`` of the element."""
    degree, count = len(mesh.local) - 1, len(mesh.per_element)
    if share == 1.0:
        return shear[element + 1]
    total, low = shear[element], knots[degree + mesh.starts[element]]
    for i in range(count if share > 0.0 else 0):
        y = parameters[RAMP] * (low + (mesh.points[element * count + i] - low) * share)
        for a in range(degree + 1):
            y += inner[i, a] * c[mesh.starts[element] + a]
        rate = parameters[LATERAL_WEIGHT] * np.sin(y / parameters[CLEARANCE])
        if mesh.given.shape[1] > 0:
            rate *= mesh.given[element * count, WEIGHT]
        total += mesh.weights[element * count + i] * share * rate
    return total


@formula
def derivative(basis, order, c, first):
    """A derivative (1, 2 …) of a spline from its basis functions, and the size of what round-off enters: its terms.

    The functions' derivatives add up to zero: differences of the coefficients from one of them serve as well.
    """
    value = size = 0.0
    for a in range(basis.shape[1]):
        value += basis[order, a] * (c[first + a] - c[first])
        size += abs(basis[order, a] * c[first + a])
    return value, size


@inlined
def balanced(mesh, knots, free, c, parameters, shear, tables, values, noise):
    """Write to ``values`` (k,) the contact pressure at k places of tables, to ``noise`` (k,) what round-off leaves.

    ``shear`` (elements + 1,) is V at mesh points.
    """
    known, out = np.empty((5 + mesh.given.shape[1], len(CHANGED))), np.empty((1, len(CHANGED)))
    places, elements, shares, basis, inner = tables
    loose_0, turns_0, loose_1, turns_1 = free
    for i in range(values.size):
        s, first = places[i], mesh.starts[elements[i]]
        force = _shear_at(mesh, knots, c, parameters, shear, elements[i], shares[i], inner[i])
        y = 0.0
        for a in range(len(mesh.local)):
            y += basis[i, 0, a] * c[first + a]
        slope, size_1 = derivative(basis[i], 1, c, first)
        bend, size_2 = derivative(basis[i], 2, c, first)
        if (s == 0.0 and turns_0) or (s == 1.0 and turns_1):
            bend = size_2 = 0.0
        elif (s == 0.0 and loose_0) or (s == 1.0 and loose_1):  # guided: y′ is held, y is not
            slope = size_1 = 0.0
        for k in range(5):
            known[0, k], known[1, k], known[2, k], known[3, k], known[4, k] = s, y, slope, bend, force
            for j in range(mesh.given.shape[1]):
                known[5 + j, k] = mesh.given[elements[i] * len(mesh.per_element), j]
        known[2, 1] -= CHANGE * size_1
        known[2, 2] += CHANGE * size_1
        known[3, 3] -= CHANGE * size_2
        known[3, 4] += CHANGE * size_2
        _pressure(mesh.model, CHANGED, known, (parameters,), out)
        values[i] = out[0, 0]
        noise[i] = COEFFICIENT_NOISE / (2.0 * CHANGE) * (abs(out[0, 2] - out[0, 1]) + abs(out[0, 4] - out[0, 3]))
