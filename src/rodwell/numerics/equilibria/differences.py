"""Derivatives of formulas by central differences: what moves along with a state is known by its tangent instead."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.quantities.arrays import FloatArray


def central_slope(function: Callable[[float], FloatArray | float], h: float) -> FloatArray:
    """Derivative at 0 from values at ±h and ±2h: its error is h⁴/30 of the fifth derivative."""
    far, near = (np.asarray(function(k * h)) - np.asarray(function(-k * h)) for k in (2.0, 1.0))
    return np.asarray((8.0 * near - far) / (12.0 * h))


def one_sided_slope(function: Callable[[float], FloatArray | float], h: float) -> FloatArray:
    """The same from values at 0, h, …, 4h, all to the side of h: the error is h⁴/5 of that derivative."""
    at = [np.asarray(function(k * h)) for k in range(5)]
    return np.asarray((-25.0 * at[0] + 48.0 * at[1] - 36.0 * at[2] + 16.0 * at[3] - 3.0 * at[4]) / (12.0 * h))
