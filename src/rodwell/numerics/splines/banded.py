"""Symmetric banded matrices: factorisation with inertia, solution, product.

Storage: ``band[j, k] = A[j+k, j]``, the lower triangle column by column, so the inner loops run over
consecutive memory. For half-bandwidth 2::

        ⎡a00            ⎤            j  k=0  k=1  k=2
        ⎢a10 a11   sym. ⎥            0  a00  a10  a20
    A = ⎢a20 a21 a22    ⎥     band:  1  a11  a21  a31
        ⎢    a31 a32 a33⎥            2  a22  a32   ·
        ⎣        a42 …  ⎦            3  a33   ·    ·
"""

from __future__ import annotations

import numpy as np

from rodwell.compiling.kernels import kernel
from rodwell.numerics.splines.products import subtract

PIVOT_FLOOR = 1e-30
"""Smallest pivot, relative to the largest diagonal entry, before it is replaced."""


@kernel
def factorise(band):
    """Factorise A = L D Lᵀ in place, without pivoting; return the number of negative pivots.

    By Sylvester's law of inertia that is the number of negative eigenvalues of A, the stability index
    if A is the Hessian of an energy. A pivot that vanishes to round-off is replaced by a tiny positive
    one: the factors are then those of a matrix that differs from A in the last digit.
    """
    n, width = band.shape
    largest = 0.0
    for j in range(n):
        largest = max(largest, abs(band[j, 0]))
    floor = PIVOT_FLOOR * largest
    negative = 0
    for j in range(n):
        pivot = band[j, 0]
        if abs(pivot) <= floor:
            pivot = floor
            band[j, 0] = floor
        if pivot < 0.0:
            negative += 1
        reach = min(width, n - j)
        inverse = 1.0 / pivot
        for k in range(1, reach):
            subtract(band, (j + k) * width, band[j, k] * inverse, band, j * width + k, reach - k)
        for k in range(1, reach):
            band[j, k] *= inverse
    return negative


@kernel
def solve(factors, x):
    """Solve L D Lᵀ x = b in place: ``x`` (n,) holds b on entry and the solution on return."""
    n, width = factors.shape
    for j in range(n):
        xj = x[j]
        for k in range(1, min(width, n - j)):
            x[j + k] -= factors[j, k] * xj
    for j in range(n - 1, -1, -1):
        total = x[j] / factors[j, 0]
        for k in range(1, min(width, n - j)):
            total -= factors[j, k] * x[j + k]
        x[j] = total


@kernel
def solve_both(factors, x, y):
    """Solve A x = b and A y = d in place, as :func:`solve` does: each waits for its own sums only."""
    n, width = factors.shape
    for j in range(n):
        xj, yj = x[j], y[j]
        for k in range(1, min(width, n - j)):
            x[j + k] -= factors[j, k] * xj
            y[j + k] -= factors[j, k] * yj
    for j in range(n - 1, -1, -1):
        first, second = x[j] / factors[j, 0], y[j] / factors[j, 0]
        for k in range(1, min(width, n - j)):
            first -= factors[j, k] * x[j + k]
            second -= factors[j, k] * y[j + k]
        x[j], y[j] = first, second


@kernel
def multiply(band, x):
    """Return A x."""
    n, width = band.shape
    out = np.zeros(n)
    for j in range(n):  # row j from the diagonal on, then the column below it: two loops, which registers hold apart
        xj, reach = x[j], min(width, n - j)
        total = out[j] + band[j, 0] * xj
        for k in range(1, reach):
            total += band[j, k] * x[j + k]
        out[j] = total
        for k in range(1, reach):
            out[j + k] += band[j, k] * xj
    return out
