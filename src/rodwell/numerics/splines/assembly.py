"""From an energy density to value, gradient and banded Hessian on a spline space.

A *model* is a named tuple with one entry for each field. Its class gives the energy density as a plain formula,

    ``density(s, u, given, parameters, rates)`` → energy, rate, gradient, mixed, hessian,

where ``u[3 f + d]`` is derivative d of field f; the derivatives by u are ``gradient`` (3 nf) and ``hessian``
(3 nf, 3 nf), and ``rate`` and ``mixed`` (3 nf) are those of energy and gradient along ``rates``, a direction in the
space of the ``parameters``. ``given`` are the coefficients that vary along s, in the order in which the class's
``given()`` names them. What is looked at along s, and maximised, is ``observed(s, u, given, parameters)``, from a field
and three derivatives. Both formulas are compiled into the kernels: see :mod:`rodwell.numerics.splines.lanes`. And
``out_of_range()`` says in words what it means where the energy is no number.

Coefficients are ordered basis function by basis function, fields inside: unknown ``i nf + f``; the half-bandwidth is
``(p + 1) nf − 1``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rodwell.compiling.kernels import formula, inlined, kernel
from rodwell.numerics.splines.basis import combine
from rodwell.numerics.splines.lanes import on_lanes
from rodwell.numerics.splines.products import HESSIAN_OF_ONE, ROWS_OF_ONE, add_element, congruence, dots


def _weighted(model: Any) -> Callable[..., Sequence[Any]]:
    """The formula of :data:`_density_terms` for a model."""
    size = 3 * len(model._fields)

    def formula(rows: Any, parameters: Any, rates: Any) -> Sequence[Any]:
        u = [rows[SHARED + k] for k in range(size)]
        given = [rows[SHARED + size + k] for k in range(len(model.given()))]
        energy, rate, gradient, mixed, hessian = model.density(rows[PLACE], u, given, parameters, rates)
        return [rows[WEIGHT] * x for x in (energy, rate, *gradient, *mixed, *(x for row in hessian for x in row))]

    return formula


PLACE, WEIGHT, SHARED = 0, 1, 2
"""Rows of what is known at the points of an element: place and weight; fields and derivatives come after them, and then
coefficients that vary along s."""

_density_terms = on_lanes(_weighted)
"""Energy density and its derivatives at the points of an element, times their weights; the order of the rows is that of
:mod:`rodwell.numerics.splines.products`."""


@kernel
def assemble(mesh, c, parameters, rates, gradient, mixed, band):
    """Energy of the fields with coefficients ``c``, and its rate; write ``gradient``, ``mixed``, ``band``.

    ``mesh`` is a :class:`rodwell.numerics.splines.records.Discretisation`. Written: ``gradient`` and ``mixed`` (n,),
    ``band`` (n, width).
    """
    fields, local, per_element = len(mesh.model), len(mesh.local), len(mesh.per_element)
    size = 3 * fields
    tags = mesh.local, mesh.per_element
    known = np.empty((SHARED + size + mesh.given.shape[1], per_element))
    terms = np.empty((2 + size * (size + 2), per_element))
    product = np.empty((local + 2, local))
    uniforms = parameters, rates
    gradient[:] = 0.0
    mixed[:] = 0.0
    band[:] = 0.0
    energy = rate = 0.0
    for element in range(mesh.starts.size):
        start, first = mesh.starts[element] * fields, element * per_element
        at_points(mesh, c, element, known)
        _density_terms(mesh.model, mesh.per_element, known, uniforms, terms)
        for i in range(per_element):
            energy += terms[0, i]
            rate += terms[1, i]
        for e in range(fields):
            for f in range(fields):
                congruence(mesh.model, tags, mesh.table, first, terms, e, f, product)
                _scatter(mesh.model, tags, product, start, e, f, gradient, mixed, band)
    return energy, rate


@inlined
def at_points(mesh, c, element, known):
    """Write to ``known`` place, weight, fields, two derivatives, and what is given, at the points of an element."""
    fields, per_element = len(mesh.model), len(mesh.per_element)
    first, start = element * per_element, mesh.starts[element] * fields
    for i in range(per_element):
        known[PLACE, i], known[WEIGHT, i] = mesh.points[first + i], mesh.weights[first + i]
    for f in range(fields):
        for d in range(3):
            row = (SHARED + 3 * f + d) * per_element
            dots(mesh.model, mesh.local, mesh.per_element, mesh.table, 3 * first + d, 3, c, start + f, known, row)
    for k in range(mesh.given.shape[1]):
        for i in range(per_element):
            known[SHARED + 3 * fields + k, i] = mesh.given[first + i, k]


@formula
def _scatter(model, tags, product, start, e, f, gradient, mixed, band):
    """Add the block of fields ``e`` and ``f`` of an element to gradient, mixed derivatives and lower band."""
    fields, local = len(model), len(tags[0])
    if fields == 1:
        add_element(tags, product, start, gradient, mixed, band)
        return
    for b in range(local):
        j = start + b * fields + e
        if e == f:
            gradient[j] += product[local, b]
            mixed[j] += product[local + 1, b]
        for a in range(b if f >= e else b + 1, local):
            band[j, (a - b) * fields + f - e] += product[b, a]


@kernel
def variation(mesh, c, parameters, rates, v):
    """Second variation of the energy at ``c`` along ``v``, the size of its terms, and ∫ v'² ds; for one field.

    Products are formed at the points: unlike those with the Hessian, they do not cancel.
    """
    per_element = len(mesh.per_element)
    known, terms = np.empty((SHARED + 3 + mesh.given.shape[1], per_element)), np.empty((ROWS_OF_ONE, per_element))
    uniforms, du = (parameters, rates), np.empty(3)
    total = size = square = 0.0
    for element in range(mesh.starts.size):
        first = element * per_element
        at_points(mesh, c, element, known)
        _density_terms(mesh.model, mesh.per_element, known, uniforms, terms)
        for i in range(per_element):
            combine(mesh.local, mesh.table, first + i, v, mesh.starts[element], du)
            for d in range(3):
                for e in range(3):
                    term = du[d] * terms[HESSIAN_OF_ONE + 3 * d + e, i] * du[e]
                    total += term
                    size += abs(term)
            square += mesh.weights[first + i] * du[1] * du[1]
    return total, size, square


ONE = (0,)
"""Stands for a model of one field, where only their number counts."""


@kernel
def assemble_form(local_tag, table, weights, starts, factors):
    """Band (n, p+1) of the quadratic form Σ_d ∫ factors[d] φᵢ⁽ᵈ⁾ φⱼ⁽ᵈ⁾ ds, ``factors`` (3, m) at the points.

    ``starts`` (elements,) are the first functions of the elements.
    """
    local, tags = len(local_tag), (local_tag, ONE)  # point by point: for any number of them in an element
    elements = starts.size
    band = np.zeros((starts[elements - 1] + local, local))
    unused, terms, product = np.empty(band.shape[0]), np.zeros((ROWS_OF_ONE, 1)), np.empty((local + 2, local))
    for q in range(weights.size):
        for d in range(3):
            terms[HESSIAN_OF_ONE + 4 * d, 0] = weights[q] * factors[d, q]
        congruence(ONE, tags, table, q, terms, 0, 0, product)
        _scatter(ONE, tags, product, starts[q * elements // weights.size], 0, 0, unused, unused, band)
    return band


@kernel
def values_at_points(tags, table, starts, block, start, elements):
    """Functions with coefficients (k, n), and two derivatives, at the points of some elements: (k, 3, points).

    ``starts`` (all elements,) are the first functions of the elements; those wanted begin with number ``start``.
    """
    per_element = len(tags[1])
    out = np.empty((block.shape[0], 3, elements * per_element))
    for i in range(block.shape[0]):
        for element in range(elements):
            for d in range(3):
                row, at = 3 * (start + element) * per_element + d, (3 * i + d) * elements * per_element
                dots(
                    ONE,
                    tags[0],
                    tags[1],
                    table,
                    row,
                    3,
                    block[i],
                    starts[start + element],
                    out,
                    at + element * per_element,
                )
    return out
