"""Paths in the parameters that are given as functions of λ: Chebyshev series, which compiled loops evaluate.

Such a path has, below the four rows of any path (:mod:`rodwell.numerics.equilibria.family`), one with ``x₀, x₁``, and
then the coefficients of the Chebyshev polynomials in ``x = x₀ + x₁ λ``. Between x = −1 and 1 the series is the function
to round-off; beyond, where steps go and no state is kept, it goes on straight.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.quantities.arrays import FloatArray

DEGREES = (4, 8, 16, 32, 64, 128, 256)
"""Degrees tried, one after the other."""

SMOOTH = 1e-13
"""Relative size of the last quarter of the coefficients, and of what the series misses in between, at most."""

LEFT_OUT = 1e-17
"""Relative size of coefficients that are not kept."""


def series_path(function: Callable[[float], FloatArray], first: float, last: float) -> FloatArray | None:
    """Return the path (5 + n, k) on which the parameters are ``function`` of λ, a (k,), from ``first`` to ``last``.

    None if the function is not smooth: if no series of the largest degree meets it.
    """
    middle, half = 0.5 * (first + last), 0.5 * (last - first)

    def at(x: FloatArray) -> FloatArray:
        return np.array([function(float(middle + half * value)) for value in x])

    for degree in DEGREES:
        angles = np.pi * np.arange(degree + 1) / degree
        values = at(np.cos(angles))
        terms = np.cos(np.outer(np.arange(degree + 1), angles))
        terms[:, [0, -1]] *= 0.5
        coefficients = 2.0 / degree * terms @ values
        coefficients[[0, -1]] *= 0.5
        size = np.max(np.abs(values), axis=0)
        between = np.cos(angles[:-1] + 0.5 * np.pi / degree)
        missed = np.max(np.abs(at(between) - np.polynomial.chebyshev.chebval(between, coefficients).T), axis=0)
        tail = np.max(np.abs(coefficients[1 + 3 * degree // 4 :]), axis=0)
        if np.all(np.maximum(tail, missed) <= SMOOTH * size):
            return _laid_out(coefficients, values[0], np.ptp(values, axis=0) == 0.0, middle, half)
    return None


def _laid_out(
    coefficients: FloatArray, value: FloatArray, constant: FloatArray, middle: float, half: float
) -> FloatArray:
    """The path of a series; what is constant stands in its first row, to the last bit."""
    coefficients[:, constant] = 0.0
    size = np.maximum(np.max(np.abs(coefficients), axis=0), np.finfo(float).tiny)
    kept = np.flatnonzero(np.any(np.abs(coefficients) > LEFT_OUT * size, axis=1))
    count = 1 + int(kept[-1]) if kept.size else 1
    out = np.zeros((5 + count, coefficients.shape[1]))
    out[0, constant] = value[constant]
    out[4, :2] = -middle / half, 1.0 / half
    out[5:] = coefficients[:count]
    return out
