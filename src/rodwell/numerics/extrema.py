"""Where the contact pressure of a state is highest, and how high: also between grid points."""

from __future__ import annotations

import numpy as np

from rodwell.jit import contact, kernel
from rodwell.numerics.bsplines import basis_derivatives, combine, find_span

MOST_MAXIMA = 64
SETTLED = 1e-4
"""Part of the stencil's width below which a Newton step is the last one: the next would be about its square."""


@kernel
def _contact_at(model, knots, degree, c, parameters, s, basis, u):
    """Contact pressure at ``s``; a little beyond the ends the polynomial pieces are continued."""
    span = find_span(knots, degree, s)
    basis_derivatives(knots, span, degree, s, basis)
    u[:] = 0.0
    for d in range(4):
        for a in range(degree + 1):
            u[d] += basis[d, a] * c[span - degree + a]
    return contact(model, s, u, parameters)


@kernel
def _vertex(x, f):
    """Place of the maximum of the parabola through three points, the middle one the highest."""
    before, after = (f[1] - f[0]) / (x[1] - x[0]), (f[2] - f[1]) / (x[2] - x[1])
    bend = (after - before) / (x[2] - x[0])
    slope = before + bend * (x[1] - x[0])
    return x[1] if bend >= 0.0 else min(max(x[1] - 0.5 * slope / bend, x[0]), x[2])


@kernel
def contact_maxima(model, local_tag, knots, degree, grid, table, c, parameters, margin):
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
    per_element = (m - 1) // (c.size - degree)
    basis, u = np.empty((4, degree + 1)), np.empty(4)
    sample = np.empty(m)
    highest, lowest = -np.inf, np.inf
    for j in range(m):
        first = min(j // per_element, c.size - degree - 1)
        combine(local_tag, table, j, c, first, u)
        sample[j] = contact(model, grid[j], u, parameters)
        highest, lowest = max(highest, sample[j]), min(lowest, sample[j])
    threshold = highest - margin * (highest - lowest)
    places, values = np.empty(MOST_MAXIMA), np.empty(MOST_MAXIMA)
    count = 0
    f = np.empty(5)
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
        for _ in range(12):
            for k in range(5):
                f[k] = _contact_at(model, knots, degree, c, parameters, place + (k - 2) * delta, basis, u)
            slope = (8.0 * (f[3] - f[1]) - (f[4] - f[0])) / (12.0 * delta)
            bend = (16.0 * (f[3] + f[1]) - 30.0 * f[2] - (f[4] + f[0])) / (12.0 * delta * delta)
            uphill = high if slope > 0.0 else low
            target = place - slope / bend if bend < 0.0 else uphill
            target = min(max(target, low), high)
            step = abs(target - place)
            place = target
            if step <= SETTLED * delta:
                break
        refined = _contact_at(model, knots, degree, c, parameters, place, basis, u)
        if refined < value:  # a maximum at an end, or one too flat to refine
            place, refined = grid[j], value
        places[count], values[count] = place, refined
        count += 1
    return places[:count], values[:count], lowest
