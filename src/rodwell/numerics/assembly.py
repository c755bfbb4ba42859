"""From an energy density to value, gradient and banded Hessian on a spline space.

The density is that of a *model* (:func:`rodwell.jit.density`) over any number of fields ``nf`` and their first
two derivatives. Coefficients are ordered basis function by basis function, fields inside: unknown
``i nf + f``; the half-bandwidth is ``(p + 1) nf − 1``.
"""

from __future__ import annotations

import numpy as np

from rodwell.jit import density, kernel


@kernel
def assemble(model, local_tag, table, points, weights, c, parameters, rates, gradient, mixed, band):
    """Energy of the fields with coefficients ``c``; write ``gradient``, ``mixed`` (n,) and ``band`` (n, width).

    ``table`` (m, ≥3, p+1), ``points`` and ``weights`` (m,) belong to the quadrature of the space, p − 1 points in each
    element; ``local_tag`` is a tuple of p + 1 zeros, whose length the compiler knows, so that short loops are unrolled.

    With ``basis`` B (3 (p−1), p+1) the functions of an element at its points, its matrices are products LᵀB,
    L[e] = w h[e, f] B for each field f, and in the last two columns of L, w g and w m: the gradient comes with them.
    """
    local, fields = len(local_tag), len(model)
    wide = (table.shape[2] + 3) // 4 * 4  # whole vector registers; not a constant, or loops over it would be unrolled
    per_element = local - 2
    size = 3 * fields
    u, g, m = np.empty(size), np.empty(size), np.empty(size)
    h = np.empty((size, size))
    basis = np.zeros((3 * per_element, wide))
    left = np.empty((fields, 3 * per_element, fields * local + wide))
    blocks = np.empty((fields, fields * local + 2, wide))
    gradient[:] = 0.0
    mixed[:] = 0.0
    band[:] = 0.0
    energy = 0.0
    for element in range(c.size // fields - local + 1):
        start = element * fields
        for i in range(per_element):
            q = element * per_element + i
            for d in range(3):
                for a in range(local):
                    basis[3 * i + d, a] = table[q, d, a]
            for f in range(fields):
                u0 = u1 = u2 = 0.0
                for a in range(local):
                    value = c[start + a * fields + f]
                    u0 += table[q, 0, a] * value
                    u1 += table[q, 1, a] * value
                    u2 += table[q, 2, a] * value
                u[3 * f], u[3 * f + 1], u[3 * f + 2] = u0, u1, u2
            w = weights[q]
            energy += w * density(model, points[q], u, parameters, rates, g, h, m)
            for e in range(fields):
                for d in range(3):
                    row, k = 3 * i + d, 3 * e + d
                    for f in range(fields):
                        h0, h1, h2 = w * h[k, 3 * f], w * h[k, 3 * f + 1], w * h[k, 3 * f + 2]
                        for a in range(wide):
                            left[e, row, f * local + a] = (
                                h0 * basis[3 * i, a] + h1 * basis[3 * i + 1, a] + h2 * basis[3 * i + 2, a]
                            )  # beyond a = p these are zeros, overwritten in what follows
                    left[e, row, fields * local], left[e, row, fields * local + 1] = w * g[k], w * m[k]
        _multiply(model, local_tag, left, basis, blocks)
        _scatter(model, local_tag, blocks, start, gradient, mixed, band)
    return energy


@kernel(fastmath={"contract"})
def _multiply(model, local_tag, left, basis, product):
    """Write Lᵀ B to ``product`` for each field: the sum is unrolled, the columns go through vector registers."""
    for e in range(left.shape[0]):
        for i in range(len(model) * len(local_tag) + 2):
            for j in range(basis.shape[1]):
                total = 0.0
                for k in range(3 * (len(local_tag) - 2)):
                    total += left[e, k, i] * basis[k, j]
                product[e, i, j] = total


@kernel
def _scatter(model, local_tag, blocks, start, gradient, mixed, band):
    """Add the products of an element to gradient, mixed derivatives and lower band."""
    fields, last = len(model), len(model) * len(local_tag)
    for e in range(fields):
        for b in range(len(local_tag)):
            j = start + b * fields + e
            gradient[j] += blocks[e, last, b]
            mixed[j] += blocks[e, last + 1, b]
            for a in range(b, len(local_tag)):
                for f in range(e if a == b else 0, fields):
                    band[j, (a - b) * fields + f - e] += blocks[f, e * len(local_tag) + b, a]


@kernel
def variation(model, table, points, weights, c, parameters, rates, v):
    """Second variation of the energy at ``c`` along ``v``, and ∫ v'² ds; one field, sums of pointwise squares."""
    local = table.shape[2]
    per_element = points.size // (c.size - local + 1)
    u, du, g, m = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    h = np.empty((3, 3))
    total = square = 0.0
    for q in range(points.size):
        start = q // per_element
        for d in range(3):
            u[d] = du[d] = 0.0
            for a in range(local):
                u[d] += table[q, d, a] * c[start + a]
                du[d] += table[q, d, a] * v[start + a]
        density(model, points[q], u, parameters, rates, g, h, m)
        for d in range(3):
            for e in range(3):
                total += weights[q] * du[d] * h[d, e] * du[e]
        square += weights[q] * du[1] * du[1]
    return total, square


@kernel
def assemble_form(table, weights, elements, factors):
    """Band (n, p+1) of the quadratic form Σ_d ∫ factors[d] φᵢ⁽ᵈ⁾ φⱼ⁽ᵈ⁾ ds, ``factors`` (3, m) at the points."""
    local = table.shape[2]
    per_element = weights.size // elements
    band = np.zeros((elements + local - 1, local))
    for q in range(weights.size):
        start = q // per_element
        for d in range(3):
            scale = weights[q] * factors[d, q]
            if scale != 0.0:
                for a in range(local):
                    row = scale * table[q, d, a]
                    for b in range(a + 1):
                        band[start + b, a - b] += row * table[q, d, b]
    return band
