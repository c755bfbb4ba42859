"""Two fields as one complex function u = x + iy on a spline space: coefficients, what is held, bands, Gram matrices.

Unknowns are ordered function by function, x before y, as in :mod:`rodwell.numerics.splines.assembly`.
"""

from __future__ import annotations

import numpy as np

from rodwell.numerics.splines.held import Ends, Held
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import ComplexArray, FloatArray


def as_complex(vectors: FloatArray) -> ComplexArray:
    """Complex coefficients (…, n) from vectors of both fields (…, 2n)."""
    return np.asarray(vectors[..., 0::2] + 1j * vectors[..., 1::2])


def as_real(coefficients: ComplexArray) -> FloatArray:
    """Vectors of both fields (…, 2n) from complex coefficients (…, n)."""
    out = np.empty((*coefficients.shape[:-1], 2 * coefficients.shape[-1]))
    out[..., 0::2], out[..., 1::2] = coefficients.real, coefficients.imag
    return out


def held_pair(x: Ends, y: Ends, size: int) -> Held:
    """What end conditions of each field hold among 2 ``size`` coefficients."""
    held, follows = np.zeros(2 * size, dtype=np.bool_), np.arange(2 * size, dtype=np.int64)
    for field, ends in enumerate((x, y)):
        one = ends.among(size)
        held[field::2] = one.held
        follows[field::2] = 2 * one.follows + field
    return Held(held, follows)


def derivatives(space: SplineSpace, coefficients: ComplexArray) -> ComplexArray:
    """Values and two derivatives at the quadrature points, (…, 3, m)."""
    parts = (np.ascontiguousarray(part) for part in (coefficients.real, coefficients.imag))
    real, imaginary = (space.at_points(part) for part in parts)
    return np.asarray(real + 1j * imaginary)


def evaluate(space: SplineSpace, coefficients: ComplexArray, places: FloatArray, orders: int) -> ComplexArray:
    """Derivatives 0 … orders−1 at ``places`` (m,): (orders, m)."""
    real, imaginary = np.ascontiguousarray(coefficients.real), np.ascontiguousarray(coefficients.imag)
    return np.asarray(space.evaluate(real, places, orders) + 1j * space.evaluate(imaginary, places, orders))


def pair_band(space: SplineSpace, diagonal: FloatArray, coupling: float) -> FloatArray:
    """Band (2n, 2p + 2) of Σ_d ∫ diagonal[d] |u⁽ᵈ⁾|² ds + coupling ∫ Im(ū′u″) ds; ``diagonal`` (3, m) at the points."""
    one, degree = space.form(diagonal), space.degree
    band = np.zeros((2 * space.size, 2 * degree + 2))
    band[0::2, 0::2] = one
    band[1::2, 0::2] = one
    if coupling == 0.0:
        return band
    shape = (space.elements, -1, degree + 1)
    slope, bend = (space.table[:, d].reshape(shape) for d in (1, 2))
    local = np.einsum("eqa,eq,eqb->eab", slope, space.weights.reshape(space.elements, -1), bend)
    skew = 0.5 * coupling * (local - local.swapaxes(1, 2))  # entry of x with function a and y with function b
    for a in range(degree + 1):
        for b in range(degree + 1):
            row, column = 2 * (space.starts + b) + 1, 2 * (space.starts + a)
            first = np.minimum(row, column)
            np.add.at(band, (first, np.abs(row - column)), skew[:, a, b])
    return band
