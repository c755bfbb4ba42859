"""From an energy density to value, gradient and banded Hessian on a spline space.

The density is that of a *model* (:func:`rodwell.jit.density`) over any number of fields ``nf`` and their first
two derivatives. Coefficients are ordered basis function by basis function, fields inside: unknown
``i nf + f``; the half-bandwidth is ``(p + 1) nf − 1``.
"""

from __future__ import annotations

import numpy as np

from rodwell.jit import density, formula, kernel
from rodwell.numerics.bsplines import combine
from rodwell.numerics.congruence import congruence


@kernel
def assemble(model, tags, table, points, weights, c, parameters, rates, gradient, mixed, band):
    """Energy of the fields with coefficients ``c``, and its rate; write ``gradient``, ``mixed``, ``band``.

    Written: ``gradient`` and ``mixed`` (n,), ``band`` (n, width). ``table`` (m, 3, p+1), ``points`` and ``weights``
    (m,) belong to the quadrature of the space, and ``tags`` holds two tuples of zeros whose lengths the compiler
    knows: p + 1 local functions, and the points of an element.
    """
    fields, local, per_element = len(model), len(tags[0]), len(tags[1])
    size = 3 * fields
    u, g, m = np.empty((per_element, size)), np.empty(size), np.empty(size)
    h = np.empty((size, size))
    terms = np.empty((per_element, size + 2, size))
    product = np.empty((local + 2, local))
    gradient[:] = 0.0
    mixed[:] = 0.0
    band[:] = 0.0
    energy = rate = 0.0
    for element in range(c.size // fields - local + 1):
        start, first = element * fields, element * per_element
        _evaluate(model, tags, table, first, c, start, u)
        for i in range(per_element):
            w = weights[first + i]
            e, r = density(model, points[first + i], u[i], parameters, rates, g, h, m)
            energy += w * e
            rate += w * r
            for k in range(size):
                for j in range(size):
                    terms[i, j, k] = w * h[j, k]
                terms[i, size, k], terms[i, size + 1, k] = w * g[k], w * m[k]
        for e in range(fields):
            for f in range(fields):
                congruence(tags, table, first, terms, e, f, product)
                _scatter(model, tags, product, start, e, f, gradient, mixed, band)
    return energy, rate


@formula(fastmath={"contract", "reassoc", "nsz"})
def _evaluate(model, tags, table, first, c, start, u):
    """Fields and two derivatives at the points of an element: ``u`` (points, 3 nf). The sums may be reordered."""
    for i in range(len(tags[1])):
        for f in range(len(model)):
            for d in range(3):
                total = 0.0
                for a in range(len(tags[0])):
                    total += table[first + i, d, a] * c[start + a * len(model) + f]
                u[i, 3 * f + d] = total


@formula
def _scatter(model, tags, product, start, e, f, gradient, mixed, band):
    """Add the block of fields ``e`` and ``f`` of an element to gradient, mixed derivatives and lower band."""
    fields, local = len(model), len(tags[0])
    for b in range(local):
        j = start + b * fields + e
        if e == f:
            gradient[j] += product[local, b]
            mixed[j] += product[local + 1, b]
        for a in range(b if f >= e else b + 1, local):
            band[j, (a - b) * fields + f - e] += product[b, a]


@kernel
def variation(model, tags, table, points, weights, c, parameters, rates, v):
    """Second variation of the energy at ``c`` along ``v``, and ∫ v'² ds; one field, sums of pointwise squares."""
    local_tag, per_element = tags[0], len(tags[1])
    u, du, g, m = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    h = np.empty((3, 3))
    total = square = 0.0
    for q in range(points.size):
        start = q // per_element
        combine(local_tag, table, q, c, start, u)
        combine(local_tag, table, q, v, start, du)
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
    wide = (local + 3) // 4 * 4  # whole vector registers
    per_element = weights.size // elements
    band = np.zeros((elements + local - 1, local))
    block, basis = np.empty((local, wide)), np.zeros(wide)
    for element in range(elements):
        block[:] = 0.0
        for q in range(element * per_element, (element + 1) * per_element):
            for d in range(3):
                scale = weights[q] * factors[d, q]
                if scale != 0.0:
                    for a in range(local):
                        basis[a] = table[q, d, a]
                    for b in range(local):
                        column = scale * basis[b]
                        for a in range(wide):
                            block[b, a] += column * basis[a]
        for b in range(local):
            for a in range(b, local):
                band[element + b, a - b] += block[b, a]
    return band


@kernel
def grams(table, weights, elements, factors, block):
    """Matrices (k, k) of Σ_d ∫ factors[d] u⁽ᵈ⁾ v⁽ᵈ⁾ ds and of ∫ u'v' ds for functions with coefficients (k, n).

    Formed from values at the quadrature points: squares do not cancel as the entries of a stiffness matrix do.
    """
    count, local = block.shape[0], table.shape[2]
    wide = (count + 3) // 4 * 4  # whole vector registers; what is beyond the functions stays zero
    per_element = weights.size // elements
    energy, slope = np.zeros((count, wide)), np.zeros((count, wide))
    u = np.empty((3, wide))
    part = np.zeros((local, wide))
    for element in range(elements):
        for a in range(local):
            for i in range(count):
                part[a, i] = block[i, element + a]
        for q in range(element * per_element, (element + 1) * per_element):
            w = weights[q]
            w0, w1, w2 = w * factors[0, q], w * factors[1, q], w * factors[2, q]
            for d in range(3):
                for i in range(wide):
                    u[d, i] = 0.0
                for a in range(local):
                    value = table[q, d, a]
                    for i in range(wide):
                        u[d, i] += value * part[a, i]
            for i in range(count):
                f0, f1, f2, f3 = w0 * u[0, i], w1 * u[1, i], w2 * u[2, i], w * u[1, i]
                for j in range(wide):
                    energy[i, j] += f0 * u[0, j] + f1 * u[1, j] + f2 * u[2, j]
                    slope[i, j] += f3 * u[1, j]
    return energy[:, :count].copy(), slope[:, :count].copy()
