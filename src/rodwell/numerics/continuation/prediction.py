"""Where the next point of a branch is to be expected: on the polynomial in arclength through the last points.

Newton's method begins the closer the higher the degree. Tangents are left out as soon as there are points enough: they
belong to the iterate before the last Newton step, and errors in them would grow from prediction to prediction.
"""

from __future__ import annotations

import numpy as np

from rodwell.compiling.kernels import kernel
from rodwell.numerics.equilibria.state import State
from rodwell.quantities.arrays import FloatArray

MOST_POINTS = 5
"""Points through which the polynomial goes at most: with more, round-off in them counts."""

PROJECTIONS = 3
"""Corrections that put the predicted point on the hyperplane: each leaves some hundredths of the gap."""


class Predictor:
    """The last points of a branch, all on one mesh, and the arclength at which they lie, that of the last being 0."""

    def __init__(self, state: State) -> None:
        self.restart(state)

    def restart(self, state: State) -> None:
        """Forget all points but ``state``."""
        self.last, self.count = state, 1
        self.places, self.lams = np.zeros(MOST_POINTS), np.full(MOST_POINTS, state.lam)
        self.coefficients = np.empty((MOST_POINTS, state.c.size))  # the last point stands last
        self.coefficients[-1] = state.c

    def add(self, state: State) -> None:
        """Add the next point, on the same mesh."""
        cosine = float(self.last.row @ state.tangent) + self.last.row_lam * state.tangent_lam
        arc = self.last.along(state) * (1.0 + (1.0 - cosine) / 3.0)  # longer than its projection, by θ²/6
        for values, new in ((self.places, 0.0), (self.lams, state.lam), (self.coefficients, state.c)):
            values[:-1] = values[1:]
            values[-1] = new
        self.places[:-1] -= arc
        self.last, self.count = state, min(self.count + 1, MOST_POINTS)

    def ahead(self, length: float) -> tuple[FloatArray, float]:
        """Coefficients and λ expected at the distance ``length`` from the last point, along its tangent."""
        here = self.last
        if self.count > 2:
            first = MOST_POINTS - self.count
            c, lam = expected(
                self.places[first:], self.lams[first:], self.coefficients[first:], here.row, here.row_lam, length
            )
            return np.asarray(c), float(lam)
        c, lam = here.c + length * here.tangent, here.lam + length * here.tangent_lam
        if self.count == 2:
            back = self.places[-2]
            share = (length / back) ** 2
            c += share * (self.coefficients[-2] - here.c - back * here.tangent)
            lam += share * (self.lams[-2] - here.lam - back * here.tangent_lam)
        return c, float(lam)


@kernel
def expected(places, lams, coefficients, row, row_lam, length):
    """Polynomial through points (k, n) at ``places`` (k,), ``length`` ahead of the last along the covector ``row``."""
    k, n = coefficients.shape
    along, shares = np.empty(k), np.empty(k)
    for i in range(k):
        along[i] = row_lam * (lams[i] - lams[k - 1])
        for j in range(n):
            along[i] += row[j] * (coefficients[i, j] - coefficients[k - 1, j])
    x = length
    for _ in range(PROJECTIONS + 1):
        for i in range(k):
            shares[i] = 1.0
            for j in range(k):
                if j != i:
                    shares[i] *= (x - places[j]) / (places[i] - places[j])
        x += length
        for i in range(k):
            x -= shares[i] * along[i]
    c, lam = np.zeros(n), 0.0
    for i in range(k):
        lam += shares[i] * lams[i]
        for j in range(n):
            c[j] += shares[i] * coefficients[i, j]
    return c, lam
