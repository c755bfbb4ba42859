"""From an energy density to value, gradient and banded Hessian on a spline space.

A *model* is a named tuple with one entry for each field. Its class gives the energy density as a plain formula,

    ``density(s, u, parameters, rates)`` → energy, rate, gradient, mixed, hessian,

where ``u[3 f + d]`` is derivative d of field f; the derivatives by u are ``gradient`` (3 nf) and ``hessian``
(3 nf, 3 nf), and ``rate`` and ``mixed`` (3 nf) are those of energy and gradient along ``rates``, a direction in the
space of the ``parameters``. Where contact is looked at, ``contact(s, u, parameters)`` is the contact pressure from the
fields and three derivatives. Both are compiled into the kernels: see :mod:`rodwell.numerics.splines.lanes`.

Coefficients are ordered basis function by basis function, fields inside: unknown ``i nf + f``; the half-bandwidth is
``(p + 1) nf − 1``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rodwell.compiling.kernels import formula, kernel
from rodwell.numerics.splines.basis import combine
from rodwell.numerics.splines.lanes import on_lanes
from rodwell.numerics.splines.products import congruence, dots


def _weighted(model: Any) -> Callable[..., Sequence[Any]]:
    """The formula of :data:`_density_terms` for a model."""
    size = 3 * len(model._fields)

    def formula(rows: Any, parameters: Any, rates: Any) -> Sequence[Any]:
        u = [rows[SHARED + k] for k in range(size)]
        energy, rate, gradient, mixed, hessian = model.density(rows[PLACE], u, parameters, rates)
        return [rows[WEIGHT] * x for x in (energy, rate, *gradient, *mixed, *(x for row in hessian for x in row))]

    return formula


PLACE, WEIGHT, SHARED = 0, 1, 2
"""Rows of what is known at the points of an element: place and weight; fields and derivatives come after them."""

_density_terms = on_lanes(_weighted)
"""Energy density and its derivatives at the points of an element, times their weights; the order of the rows is that of
:mod:`rodwell.numerics.splines.products`."""


@kernel
def assemble(model, tags, table, points, weights, c, parameters, rates, gradient, mixed, band):
    """Energy of the fields with coefficients ``c``, and its rate; write ``gradient``, ``mixed``, ``band``.

    Written: ``gradient`` and ``mixed`` (n,), ``band`` (n, width). ``table`` (m, 3, p+1), ``points`` and ``weights``
    (m,) belong to the quadrature of the space, and ``tags`` holds two tuples of zeros whose lengths the compiler
    knows: p + 1 local functions, and the points of an element.
    """
    fields, local, per_element = len(model), len(tags[0]), len(tags[1])
    size = 3 * fields
    known = np.empty((SHARED + size, per_element))
    terms = np.empty((2 + size * (size + 2), per_element))
    product = np.empty((local + 2, local))
    uniforms = parameters, rates
    gradient[:] = 0.0
    mixed[:] = 0.0
    band[:] = 0.0
    energy = rate = 0.0
    for element in range(c.size // fields - local + 1):
        start, first = element * fields, element * per_element
        at_points(model, tags, table, points, weights, first, c, start, known)
        _density_terms(model, tags[1], known, uniforms, terms)
        for i in range(per_element):
            energy += terms[0, i]
            rate += terms[1, i]
        for e in range(fields):
            for f in range(fields):
                congruence(model, tags, table, first, terms, e, f, product)
                _scatter(model, tags, product, start, e, f, gradient, mixed, band)
    return energy, rate


@formula
def at_points(model, tags, table, points, weights, first, c, start, known):
    """Write to ``known`` place, weight, fields and two derivatives at the points of an element."""
    per_element = len(tags[1])
    for i in range(per_element):
        known[PLACE, i], known[WEIGHT, i] = points[first + i], weights[first + i]
    for f in range(len(model)):
        for d in range(3):
            row = (SHARED + 3 * f + d) * per_element
            dots(model, tags[0], tags[1], table, 3 * first + d, 3, c, start + f, known, row)


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
    """Second variation of the energy at ``c`` along ``v``, the size of its terms, and ∫ v'² ds; for one field.

    Products are formed at the points: unlike those with the Hessian, they do not cancel.
    """
    local_tag, per_element = tags[0], len(tags[1])
    known, terms, du = np.empty((SHARED + 3, per_element)), np.empty((17, per_element)), np.empty(3)
    uniforms = parameters, rates
    total = size = square = 0.0
    for element in range(c.size - len(local_tag) + 1):
        first = element * per_element
        at_points(model, tags, table, points, weights, first, c, element, known)
        _density_terms(model, tags[1], known, uniforms, terms)
        for i in range(per_element):
            combine(local_tag, table, first + i, v, element, du)
            for d in range(3):
                for e in range(3):
                    term = du[d] * terms[8 + 3 * d + e, i] * du[e]
                    total += term
                    size += abs(term)
            square += weights[first + i] * du[1] * du[1]
    return total, size, square


ONE = (0,)
"""Stands for a model of one field, where only their number counts."""


@kernel
def assemble_form(local_tag, table, weights, elements, factors):
    """Band (n, p+1) of the quadratic form Σ_d ∫ factors[d] φᵢ⁽ᵈ⁾ φⱼ⁽ᵈ⁾ ds, ``factors`` (3, m) at the points."""
    local, tags = len(local_tag), (local_tag, ONE)  # point by point: for any number of them in an element
    band = np.zeros((elements + local - 1, local))
    unused, terms, product = np.empty(band.shape[0]), np.zeros((17, 1)), np.empty((local + 2, local))
    for q in range(weights.size):
        for d in range(3):
            terms[8 + 4 * d, 0] = weights[q] * factors[d, q]
        congruence(ONE, tags, table, q, terms, 0, 0, product)
        _scatter(ONE, tags, product, q * elements // weights.size, 0, 0, unused, unused, band)
    return band


@kernel
def values_at_points(tags, table, block, start, elements):
    """Functions with coefficients (k, n), and two derivatives, at the points of some elements: (k, 3, points)."""
    per_element = len(tags[1])
    out = np.empty((block.shape[0], 3, elements * per_element))
    for i in range(block.shape[0]):
        for element in range(elements):
            for d in range(3):
                row, at = 3 * (start + element) * per_element + d, (3 * i + d) * elements * per_element
                dots(ONE, tags[0], tags[1], table, row, 3, block[i], start + element, out, at + element * per_element)
    return out
