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

    ``table`` (m, ≥3, p+1), ``points`` and ``weights`` (m,) belong to the quadrature of the space; ``local_tag`` is a
    tuple of p + 1 zeros, whose length the compiler knows, so that the inner loops are unrolled. The
    element matrices K[f, e] = Σ_q w Bᵀ h[f, e] B, with B (3, p+1) the basis at a point, are summed with the
    innermost loop over memory that lies together; of those on the diagonal, the lower half.
    """
    local, fields = len(local_tag), len(model)
    elements = c.size // fields - local + 1
    per_element = points.size // elements
    size = 3 * fields
    u, g, m = np.empty(size), np.empty(size), np.empty(size)
    h = np.empty((size, size))
    matrix = np.empty((fields, fields, local, local))
    gradient[:] = 0.0
    mixed[:] = 0.0
    band[:] = 0.0
    energy = 0.0
    for element in range(elements):
        start = element * fields
        matrix[:] = 0.0
        for q in range(element * per_element, (element + 1) * per_element):
            w = weights[q]
            u[:] = 0.0
            for a in range(local):
                for f in range(fields):
                    value = c[start + a * fields + f]
                    u[3 * f] += table[q, 0, a] * value
                    u[3 * f + 1] += table[q, 1, a] * value
                    u[3 * f + 2] += table[q, 2, a] * value
            energy += w * density(model, points[q], u, parameters, rates, g, h, m)
            for f in range(fields):
                i = 3 * f
                for a in range(local):
                    k = start + a * fields + f
                    b0, b1, b2 = w * table[q, 0, a], w * table[q, 1, a], w * table[q, 2, a]
                    gradient[k] += b0 * g[i] + b1 * g[i + 1] + b2 * g[i + 2]
                    mixed[k] += b0 * m[i] + b1 * m[i + 1] + b2 * m[i + 2]
                    for e in range(f + 1):
                        j = 3 * e
                        t0 = b0 * h[i, j] + b1 * h[i + 1, j] + b2 * h[i + 2, j]
                        t1 = b0 * h[i, j + 1] + b1 * h[i + 1, j + 1] + b2 * h[i + 2, j + 1]
                        t2 = b0 * h[i, j + 2] + b1 * h[i + 1, j + 2] + b2 * h[i + 2, j + 2]
                        for b in range(a + 1 if e == f else local):
                            matrix[f, e, a, b] += t0 * table[q, 0, b] + t1 * table[q, 1, b] + t2 * table[q, 2, b]
        _scatter(matrix, start, fields, band)
    return energy


@kernel
def _scatter(matrix, start, fields, band):
    """Add the element matrices to the lower band; ``matrix[f, e]`` is known for e ≤ f only."""
    local = matrix.shape[2]
    for a in range(local):
        for f in range(fields):
            i = start + a * fields + f
            for b in range(a + 1):
                for e in range(fields if b < a else f + 1):
                    value = matrix[f, e, a, b] if e <= f else matrix[e, f, b, a]
                    j = start + b * fields + e
                    band[j, i - j] += value


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
