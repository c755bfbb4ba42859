"""Polynomials of an element: four that carry value and slope at the ends, and bubbles that vanish with theirs.

On [0, 1] the first four are Hermite's cubics, in the order value at 0, slope at 0, value at 1, slope at 1. The bubbles
are the second integrals of Legendre polynomials P₂, P₃, …: both they and their slopes vanish at the ends, and their
second derivatives are orthogonal to each other and to those of the cubics. So a linear beam's matrix is diagonal in
them whatever the degree, elements of degree 12 are as well-conditioned as cubics, and a state is carried over to a
higher degree by appending zeros.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Polynomial, legendre

from rodwell.quantities.arrays import FloatArray

ENDS = 4
"""Functions that carry values and slopes at the two ends."""


class ReferenceElement(NamedTuple):
    """An element's functions at its Gauss points: ``table`` (3, q, p+1), ``points``, ``weights`` (q,) on [0, 1].

    ``bending`` (3, q, p+1) is the table for coefficients as :func:`bent` has them, and ``end_bends`` (2, p+1) that of
    second derivatives at the two ends. ``products`` (9q, (p+1)²): derivatives of two functions, each of three orders,
    place by place, multiplied.
    """

    degree: int
    table: FloatArray
    bending: FloatArray
    end_bends: FloatArray
    products: FloatArray
    points: FloatArray
    weights: FloatArray


@lru_cache(maxsize=32)
def reference_element(degree: int) -> ReferenceElement:
    """Return the functions of an element of this degree; the rule is exact to degree 2p + 3."""
    points, weights = legendre.leggauss(degree + 2)
    places = 0.5 * (points + 1.0)
    table, bending = (tabulate(degree, places, 3, rigid=rigid) for rigid in (False, True))
    ends = tabulate(degree, np.array([0.0, 1.0]), 3, rigid=True)[2]
    products = (table[:, None, :, :, None] * table[:, :, None, :]).reshape(9 * places.size, (degree + 1) ** 2)
    return ReferenceElement(degree, table, bending, ends, products, places, 0.5 * weights)


@lru_cache(maxsize=32)
def _coefficients(degree: int) -> FloatArray:
    """Legendre coefficients in t = 2ξ − 1 of all functions, (p+1, p+1), one function a column."""
    out = np.zeros((degree + 1, degree + 1))
    cubics = np.array([[1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1]], dtype=float)
    for i, cubic in enumerate(cubics):  # in powers of ξ = (t + 1)/2
        out[:ENDS, i] = legendre.poly2leg(Polynomial(cubic)(Polynomial([0.5, 0.5])).coef)
    for i in range(ENDS, degree + 1):
        j, scale = i - 2, 0.25 * np.sqrt(2.0 * i - 3.0)
        out[j + 2, i] = scale / ((2 * j + 1) * (2 * j + 3))
        out[j, i] = -2.0 * scale / ((2 * j - 1) * (2 * j + 3))
        out[j - 2, i] = scale / ((2 * j - 1) * (2 * j + 1))
    return out


@lru_cache(maxsize=64)
def _derivatives(degree: int, orders: int, rigid: bool) -> FloatArray:
    """Legendre coefficients of all functions and their derivatives by ξ, (orders, p+1, p+1)."""
    out = np.zeros((orders, degree + 1, degree + 1))
    out[0] = _coefficients(degree)
    if rigid:
        out[0, :ENDS, :2] = np.array([[1.0, 0.5], [0.0, 0.5], [0.0, 0.0], [0.0, 0.0]])
    for order in range(1, orders):
        out[order, :-1] = 2.0 * legendre.legder(out[order - 1])
    return out


def bent(a: FloatArray) -> FloatArray:
    """Coefficients (…, p+1) of the functions with 1 and ξ in place of the first two cubics.

    Value and slope at 0 move and turn the element; what it is bent by are the differences of those at 1. In an element
    of length h a derivative of order d is a sum of values over h^d that cancel: in one that is a thousandth of the rod
    the third would be round-off times 1e9 and the sum of all functions' derivatives. Differences are exact.
    """
    out = a.copy()
    out[..., 2:ENDS] -= a[..., :2]
    out[..., 2] -= a[..., 1]
    return out


def tabulate(degree: int, places: FloatArray, orders: int, *, rigid: bool = False) -> FloatArray:
    """All functions and their first ``orders`` − 1 derivatives by ξ at ``places`` (k,): (orders, k, p+1).

    With ``rigid`` those that belong to the coefficients of :func:`bent`.
    """
    return np.asarray(_legendre(degree, places) @ _derivatives(degree, orders, rigid))


def _legendre(degree: int, places: FloatArray) -> FloatArray:
    """Legendre polynomials of 2ξ − 1 at ``places`` (k,): (k, p+1)."""
    t = 2.0 * np.asarray(places, dtype=float) - 1.0
    values = np.ones((degree + 1, t.size))
    if degree:
        values[1] = t
    for n in range(2, degree + 1):  # by their recurrence
        values[n] = (2 - 1 / n) * t * values[n - 1] - (1 - 1 / n) * values[n - 2]
    return values.T


def sampled(a: FloatArray, places: FloatArray, orders: int) -> FloatArray:
    """What functions with coefficients ``a`` (k, fields, p+1), as :func:`bent` has them, are at ``places`` (k, n).

    With their first ``orders`` − 1 derivatives by ξ: (fields, orders, k, n).
    """
    k, fields, size = a.shape
    table = _legendre(size - 1, places.ravel()).reshape(*places.shape, size)
    series = a @ _derivatives(size - 1, orders, True).transpose(2, 0, 1).reshape(size, orders * size)
    values = series.reshape(k, fields * orders, size) @ table.transpose(0, 2, 1)
    return values.reshape(k, fields, orders, -1).transpose(1, 2, 0, 3)


@lru_cache(maxsize=32)
def bubble_projection(degree: int) -> tuple[FloatArray, FloatArray]:
    """Gauss points on [0, 1], and the matrix (p−3, q) that makes bubbles of second derivatives by ξ there."""
    points, weights = legendre.leggauss(degree + 2)
    rows = [np.sqrt(2.0 * j + 1.0) * legendre.legval(points, np.eye(j + 1)[j]) for j in range(2, degree - 1)]
    return 0.5 * (points + 1.0), np.array(rows).reshape(-1, points.size) * (0.5 * weights)
