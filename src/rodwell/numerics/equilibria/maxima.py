"""Where what a model observes of a state is highest along s, and how high: also between grid points.

The class of a model names it: ``observed(s, u, given, parameters)``, from the field and three derivatives. What is
given along s must be constant in each element.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rodwell.compiling.kernels import inlined, kernel
from rodwell.numerics.equilibria.error import larger
from rodwell.numerics.splines.basis import AT_ONCE, element_of, find_span, side_by_side
from rodwell.numerics.splines.lanes import on_lanes
from rodwell.numerics.splines.products import dots

MOST_MAXIMA, MOST_STEPS = 64, 12
SETTLED = 1e-4
"""Part of the stencil's width below which a Newton step is the last one: the next would be about its square, and the
parabola gives the value at its end to round-off."""

SIDE_BY_SIDE, ORDERS = (0,) * AT_ONCE, (0,) * 4
"""As long as there are samples that are computed at once, and as there are derivatives with the field."""


def _observing(model: Any) -> Callable[..., Sequence[Any]]:
    def formula(rows: Any, parameters: Any) -> Sequence[Any]:
        given = [rows[5 + k] for k in range(len(model.given()))]
        return [model.observed(rows[0], [rows[k] for k in range(1, 5)], given, parameters)]

    return formula


_observed = on_lanes(_observing)
"""What is observed, at places side by side, from rows of place, field, three derivatives, and what is given."""


@inlined
def _sample(mesh, grid, table, c, parameters, sample):
    """Write what is observed at all places of a grid."""
    m = grid.size
    elements = mesh.starts.size
    per_element, count = (m - 1) // elements, len(SIDE_BY_SIDE)
    known, values, u = np.empty((5 + mesh.given.shape[1], count)), np.empty((1, count)), np.empty(4)
    for start in range(0, m, count):
        for i in range(count):
            j = min(start + i, m - 1)
            element = min(j // per_element, elements - 1)
            dots(mesh.model, mesh.local, ORDERS, table, 4 * j, 1, c, mesh.starts[element], u, 0)
            for k in range(mesh.given.shape[1]):
                known[5 + k, i] = mesh.given[element * len(mesh.per_element), k]
            known[0, i] = grid[j]
            for d in range(4):
                known[1 + d, i] = u[d]
        _observed(mesh.model, SIDE_BY_SIDE, known, (parameters,), values)
        for i in range(min(count, m - start)):
            sample[start + i] = values[0, i]


@inlined
def _around(mesh, knots, c, parameters, place, delta, known, basis, f):
    """Write to ``f`` (1, 8) what is observed around a place, ``delta`` apart, in the first five.

    A little beyond the ends the polynomial pieces are continued.
    """
    local = len(mesh.local)
    for k in range(AT_ONCE):
        known[0, k] = place + (min(k, 4) - 2) * delta
    last = -1
    for k in range(5):
        span = find_span(knots, local - 1, known[0, k])
        if span != last:  # mostly, all five lie on one
            side_by_side(mesh.local, knots, span, known, basis)
            last = span
        for d in range(4):
            total = 0.0
            for a in range(local):
                total += basis[d, a, k] * c[span - local + 1 + a]
            known[1 + d, k] = total
        for j in range(mesh.given.shape[1]):
            known[5 + j, k] = mesh.given[element_of(mesh.starts, span - local + 1) * len(mesh.per_element), j]
    for k in range(5, AT_ONCE):  # not looked at: the last again
        for row in range(1, known.shape[0]):
            known[row, k] = known[row, 4]
    _observed(mesh.model, SIDE_BY_SIDE, known, (parameters,), f)


@inlined
def _vertex(x, f, j):
    """Place of the maximum of the parabola through three points of many, the middle one, number ``j``, the highest."""
    low, place, high = x[j - 1], x[j], x[j + 1]
    before, after = (f[j] - f[j - 1]) / (place - low), (f[j + 1] - f[j]) / (high - place)
    bend = (after - before) / (high - low)
    slope = before + bend * (place - low)
    return place if bend >= 0.0 else min(max(place - 0.5 * slope / bend, low), high)


@kernel
def maxima(mesh, knots, grid, table, c, parameters, margin):
    """Local maxima of what is observed over s in [0, 1], both ends included.

    It is sampled on ``grid`` (m,), several places per element, with basis ``table`` (m, 4, p+1). Each
    sampled maximum within ``margin`` times the range of the samples from the highest is then refined: Newton's
    method on the derivative, which is taken from five-point differences that stay small against the element.

    Returns
    -------
    places, values
        Of the maxima, (k,) each, in order of place.
    lowest
        The smallest sample.
    """
    m = grid.size
    sample = np.empty(m)
    _sample(mesh, grid, table, c, parameters, sample)
    highest, lowest = sample[0], sample[0]
    for value in sample:
        highest, lowest = larger(highest, value), -larger(-lowest, -value)
    threshold = highest - margin * (highest - lowest)
    places, values = np.empty(MOST_MAXIMA), np.empty(MOST_MAXIMA)
    count = 0
    known, f = np.empty((5 + mesh.given.shape[1], AT_ONCE)), np.empty((1, AT_ONCE))
    basis = np.empty((4, len(mesh.local), AT_ONCE))
    for j in range(m):
        before, after = max(j - 1, 0), min(j + 1, m - 1)
        place, value = grid[j], sample[j]
        if (
            value < threshold
            or (j > before and sample[before] > value)
            or (j < after and sample[after] >= value)
            or count == MOST_MAXIMA
        ):
            continue
        low, high = grid[before], grid[after]
        delta = 0.05 * (high - low)
        if 0 < j < m - 1:
            place = _vertex(grid, sample, j)
        for step_number in range(MOST_STEPS + 1):
            settled = step_number == MOST_STEPS  # enough of it: the value there
            _around(mesh, knots, c, parameters, place, 0.0 if settled else delta, known, basis, f)
            refined = f[0, 2]
            if settled:
                break
            two_down, down, up, two_up = f[0, 0], f[0, 1], f[0, 3], f[0, 4]
            slope = (8.0 * (up - down) - (two_up - two_down)) / (12.0 * delta)
            bend = (16.0 * (up + down) - 30.0 * refined - (two_up + two_down)) / (12.0 * delta * delta)
            uphill = high if slope > 0.0 else low
            target = place - slope / bend if bend < 0.0 else uphill
            step = min(max(target, low), high) - place
            place += step
            if abs(step) <= SETTLED * delta:
                refined += step * (slope + 0.5 * step * bend)
                break
        if refined < value:  # a maximum at an end, or one too flat to refine
            place, refined = grid[j], value
        places[count], values[count] = place, refined
        count += 1
    return places[:count], values[:count], lowest
