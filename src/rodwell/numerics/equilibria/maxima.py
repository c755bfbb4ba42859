"""Where the contact pressure of a state is highest, and how high: also between grid points."""

from __future__ import annotations

import numpy as np

from rodwell.compiling.kernels import formula, kernel
from rodwell.numerics.splines.basis import basis_derivatives, find_span
from rodwell.numerics.splines.lanes import on_lanes
from rodwell.numerics.splines.products import dots

MOST_MAXIMA, MOST_STEPS = 64, 12
SETTLED = 1e-4
"""Part of the stencil's width below which a Newton step is the last one: the next would be about its square, and the
parabola gives the pressure at its end to round-off."""

SIDE_BY_SIDE = (0,) * 8
"""As long as there are samples whose pressures are computed at once."""

STENCIL, ORDERS = (0,) * 5, (0,) * 4
"""As long as the stencil of differences, and as many orders of derivatives as the pressure takes, with the field."""

_contacts = on_lanes(
    lambda model: lambda rows, parameters: [model.contact(rows[0], [rows[k] for k in range(1, 5)], parameters)]
)
"""Contact pressure at places side by side, from rows of place, field and three derivatives."""


@formula
def _sample(model, local_tag, grid, table, c, parameters, sample):
    """Write the contact pressure at all places of a grid."""
    m = grid.size
    per_element, last = (m - 1) // (c.size - len(local_tag) + 1), c.size - len(local_tag)
    count = len(SIDE_BY_SIDE)
    known, pressure, u = np.empty((5, count)), np.empty((1, count)), np.empty(4)
    for start in range(0, m, count):
        for i in range(count):
            j = min(start + i, m - 1)
            dots(model, local_tag, ORDERS, table, 4 * j, 1, c, min(j // per_element, last), u, 0)
            known[0, i], known[1, i], known[2, i], known[3, i], known[4, i] = grid[j], u[0], u[1], u[2], u[3]
        _contacts(model, SIDE_BY_SIDE, known, (parameters,), pressure)
        for i in range(min(count, m - start)):
            sample[start + i] = pressure[0, i]


@formula
def _around(model, local_tag, knots, c, parameters, place, delta, basis, known, f):
    """Write to ``f`` (1, 5) the contact pressure around a place, ``delta`` apart.

    A little beyond the ends the polynomial pieces are continued.
    """
    degree = len(local_tag) - 1
    for k in range(5):
        s = place + (k - 2) * delta
        span = find_span(knots, degree, s)
        basis_derivatives(knots, span, degree, s, basis)
        known[0, k] = s
        for d in range(4):
            total = 0.0
            for a in range(len(local_tag)):
                total += basis[d, a] * c[span - degree + a]
            known[1 + d, k] = total
    _contacts(model, STENCIL, known, (parameters,), f)


@kernel
def _vertex(x, f):
    """Place of the maximum of the parabola through three points, the middle one the highest."""
    before, after = (f[1] - f[0]) / (x[1] - x[0]), (f[2] - f[1]) / (x[2] - x[1])
    bend = (after - before) / (x[2] - x[0])
    slope = before + bend * (x[1] - x[0])
    return x[1] if bend >= 0.0 else min(max(x[1] - 0.5 * slope / bend, x[0]), x[2])


@kernel
def contact_maxima(model, local_tag, knots, grid, table, c, parameters, margin):
    """Local maxima of the contact pressure over s in [0, 1], both ends included.

    The pressure is sampled on ``grid`` (m,), several places per element, with basis ``table`` (m, 4, p+1). Each
    sampled maximum within ``margin`` times the range of the pressure from the highest is then refined: Newton's
    method on the derivative, which is taken from five-point differences that stay small against the element.

    Returns
    -------
    places, values
        Of the maxima, (k,) each, in order of place.
    lowest
        The smallest sampled pressure.
    """
    m = grid.size
    sample = np.empty(m)
    _sample(model, local_tag, grid, table, c, parameters, sample)
    highest, lowest = np.max(sample), np.min(sample)
    threshold = highest - margin * (highest - lowest)
    places, values = np.empty(MOST_MAXIMA), np.empty(MOST_MAXIMA)
    count = 0
    basis, known, f = np.empty((4, len(local_tag))), np.empty((5, 5)), np.empty((1, 5))
    for j in range(m):
        if (
            sample[j] < threshold
            or (j > 0 and sample[j - 1] > sample[j])
            or (j < m - 1 and sample[j + 1] >= sample[j])
            or count == MOST_MAXIMA
        ):
            continue
        low, high = grid[max(j - 1, 0)], grid[min(j + 1, m - 1)]
        place, value = grid[j], sample[j]
        delta = 0.05 * (high - low)
        if 0 < j < m - 1:
            place = _vertex(grid[j - 1 : j + 2], sample[j - 1 : j + 2])
        for _ in range(MOST_STEPS):
            _around(model, local_tag, knots, c, parameters, place, delta, basis, known, f)
            slope = (8.0 * (f[0, 3] - f[0, 1]) - (f[0, 4] - f[0, 0])) / (12.0 * delta)
            bend = (16.0 * (f[0, 3] + f[0, 1]) - 30.0 * f[0, 2] - (f[0, 4] + f[0, 0])) / (12.0 * delta * delta)
            uphill = high if slope > 0.0 else low
            target = place - slope / bend if bend < 0.0 else uphill
            step = min(max(target, low), high) - place
            place += step
            if abs(step) <= SETTLED * delta:
                refined = f[0, 2] + step * (slope + 0.5 * step * bend)
                break
        else:
            _around(model, local_tag, knots, c, parameters, place, 0.0, basis, known, f)
            refined = f[0, 2]
        if refined < value:  # a maximum at an end, or one too flat to refine
            place, refined = grid[j], value
        places[count], values[count] = place, refined
        count += 1
    return places[:count], values[:count], lowest
