"""Minima of many smooth functions at once, each looked at ever more closely."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.quantities.arrays import FloatArray

CLOSER, ZOOMS = 17, 3
"""Places of each closer look at a minimum, and how many looks: the last are some thousandths of an element apart."""


def lowest(function: Callable[[FloatArray], FloatArray], xi: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least values (m,) of smooth functions over samples (m, n), looked at more closely, and where.

    A row for each function; a parabola is the last step.
    """
    rows = np.arange(xi.shape[0])
    for zoom in range(ZOOMS):
        values = function(xi)
        k = np.argmin(values, axis=1)
        low, high = np.maximum(k - 1, 0), np.minimum(k + 1, xi.shape[1] - 1)
        if zoom < ZOOMS - 1:
            xi = np.linspace(xi[rows, low], xi[rows, high], CLOSER, axis=1)
    a, b, c = values[rows, low], values[rows, k], values[rows, high]
    bend, tilt = a - 2.0 * b + c, 0.5 * (c - a)
    within = (high - low == 2) & (bend > 0.0)
    shift = np.where(within, tilt, 0.0) / np.where(within, bend, 1.0)
    return b - 0.5 * tilt * shift, xi[rows, k] - shift * (xi[rows, k] - xi[rows, low])
