"""B-spline basis functions on a knot vector: values, derivatives, knot insertion.

Knots ``t`` (n + p + 1,) are open (the end knots stand p + 1 times); an element is a knot span
``[t[i+p], t[i+p+1])`` that is not empty and carries the basis functions i … i+p, which it ``starts`` with number i:
its own number, where no knot inside is repeated. The matrix form of the recurrence is that
of T. Lyche and K. Mørken, *Spline Methods* (2018), section 2.4; the derivative formula is (2.7) of
L. Piegl and W. Tiller, *The NURBS Book* (1997).
"""

from __future__ import annotations

import numpy as np

from rodwell.compiling.kernels import kernel

SPACING = 4.0 * np.finfo(np.float64).eps
"""Round-off in the difference of two knots, which are numbers from 0 to 1."""


@kernel
def _step(knots, span, k, x, row):
    """Turn weights of degree k−1 in ``row`` into weights of degree k, with the argument ``x``."""
    row[k] = 0.0
    for j in range(k - 1, -1, -1):
        left = knots[span - k + 1 + j]
        share = (x - left) / (knots[span + 1 + j] - left)
        row[j + 1] += share * row[j]
        row[j] *= 1.0 - share


@kernel
def blossom(knots, span, degree, places, out):
    """Write to ``out`` (≥ degree+1,) the weights of the polar form on the span [t[span], t[span+1]).

    ``f(x₁, …, x_k) = Σ_a out[a] c[span−degree+a]`` with the arguments ``places`` (≥ degree,). All
    arguments equal to s: the values at s of the basis functions. Consecutive knots of a finer mesh: the
    weights of knot insertion (the Oslo algorithm).
    """
    out[0] = 1.0
    for k in range(1, degree + 1):
        _step(knots, span, k, places[k - 1], out)


@kernel
def basis_derivatives(knots, span, degree, s, out):
    """Write to ``out`` (orders, degree+1) the derivatives 0 … orders−1 at ``s`` of the basis functions.

    Row d first gets the values of degree p − d, on the way of the recurrence up to degree p; it is then
    raised d times by ``N'_{i,q} = q N_{i,q−1}/(t_{i+q}−t_i) − q N_{i+1,q−1}/(t_{i+q+1}−t_{i+1})``.
    """
    orders = out.shape[0]
    row = out[orders - 1]
    row[0] = 1.0
    for k in range(1, degree - orders + 2):
        _step(knots, span, k, s, row)
    for order in range(orders - 2, -1, -1):
        k = degree - order
        for j in range(k):
            out[order, j] = out[order + 1, j]
        _step(knots, span, k, s, out[order])
    for order in range(1, orders):
        for q in range(degree - order + 1, degree + 1):
            first = span - q
            out[order, q] = 0.0
            for j in range(q - 1, -1, -1):
                slope = q * out[order, j] / (knots[first + 1 + j + q] - knots[first + 1 + j])
                out[order, j + 1] += slope
                out[order, j] = -slope


@kernel(fastmath={"contract", "reassoc", "nsz"})
def combine(local_tag, table, place, coefficients, first, out):
    """Write to ``out`` (orders,) the sums of the functions at a ``place`` of ``table`` (m, ≥ orders, p+1).

    The first of them is number ``first``. ``local_tag`` is a tuple of p + 1 zeros, whose length the compiler knows,
    and the terms are added in any order: both let it use vector registers.
    """
    for d in range(out.size):
        total = 0.0
        for a in range(len(local_tag)):
            total += table[place, d, a] * coefficients[first + a]
        out[d] = total


@kernel
def combine_all(local_tag, table, first, coefficients):
    """Sums of the functions at all places of ``table`` (m, orders, p+1): (orders, m); see :func:`combine`."""
    orders = table.shape[1]
    values, u = np.empty((orders, first.size)), np.empty(orders)
    for q in range(first.size):
        combine(local_tag, table, q, coefficients, first[q], u)
        for d in range(orders):
            values[d, q] = u[d]
    return values


@kernel
def find_span(knots, degree, s):
    """Index of the knot span that holds ``s``; the last one for the right end."""
    low, high = degree, knots.size - degree - 1
    while high - low > 1:
        middle = (low + high) // 2
        if s < knots[middle]:
            high = middle
        else:
            low = middle
    return low


@kernel
def element_of(starts, first):
    """Number of the element whose first function is number ``first``; ``starts`` (elements,) are all of these."""
    low, high = 0, starts.size
    while high - low > 1:
        middle = (low + high) // 2
        if first < starts[middle]:
            high = middle
        else:
            low = middle
    return low


@kernel
def _copy(table, known, first, count):
    """Copy the basis functions at ``count`` places; an assignment of slices would take seconds to compile."""
    for q in range(count):
        for order in range(table.shape[1]):
            for a in range(table.shape[2]):
                table[first + q, order, a] = table[known + q, order, a]


@kernel
def tabulate(knots, degree, starts, places, per_element, orders):
    """Basis functions at ``places``, ``per_element`` of them in each element in turn: (m, orders, degree+1).

    ``starts`` (elements,) are the first functions of the elements. One place more than that counts as the right end of
    the last element. The places must divide all elements alike: where knots are evenly spaced, the table of one element
    is copied to the next.
    """
    table = np.empty((places.size, orders, degree + 1))
    known, spacing = -1, 0.0  # first place of the last element that was tabulated among evenly spaced knots
    elements = starts.size
    for element in range(elements):
        span, first = degree + starts[element], element * per_element
        even = _evenly_spaced(knots, span, degree)
        width = knots[span + 1] - knots[span]
        if even and known >= 0 and abs(width - spacing) <= SPACING:
            _copy(table, known, first, per_element)
            continue
        for q in range(first, first + per_element):
            basis_derivatives(knots, span, degree, places[q], table[q])
        if even:
            known, spacing = first, width
    for q in range(elements * per_element, places.size):
        basis_derivatives(knots, knots.size - degree - 2, degree, places[q], table[q])
    return table


@kernel
def tabulate_anywhere(knots, degree, places, orders):
    """Basis functions at ``places`` (m,): (m, orders, degree+1), and the knot spans in which they lie, (m,)."""
    table, spans = np.empty((places.size, orders, degree + 1)), np.empty(places.size, np.int64)
    for q in range(places.size):
        spans[q] = find_span(knots, degree, places[q])
        basis_derivatives(knots, spans[q], degree, places[q], table[q])
    return table, spans


@kernel
def _evenly_spaced(knots, span, degree):
    """Whether all knots that the functions on a span depend on are evenly spaced, to round-off."""
    width = knots[span + 1] - knots[span]
    for k in range(span - degree, span + degree + 1):  # noqa: SIM110 - compiled
        if abs(knots[k + 1] - knots[k] - width) > SPACING:
            return False
    return True


@kernel
def insertion_weights(coarse, fine, degree):
    """Weights (n_fine, degree+1) and first indices (n_fine,) that carry coefficients to nested finer knots."""
    n = fine.size - degree - 1
    weights = np.empty((n, degree + 1))
    first = np.empty(n, np.int64)
    for i in range(n):
        span = find_span(coarse, degree, fine[i])
        blossom(coarse, span, degree, fine[i + 1 : i + 1 + degree], weights[i])
        first[i] = span - degree
    return first, weights


@kernel
def insert(first, weights, coefficients):
    """Apply the weights of :func:`insertion_weights`."""
    out = np.zeros(first.size)
    for i in range(first.size):
        for a in range(weights.shape[1]):
            out[i] += weights[i, a] * coefficients[first[i] + a]
    return out
