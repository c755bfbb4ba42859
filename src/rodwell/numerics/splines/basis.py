"""B-spline basis functions on a knot vector: values, derivatives, knot insertion.

Knots ``t`` (n + p + 1,) are open (the end knots stand p + 1 times); an element is a knot span
``[t[i+p], t[i+p+1])`` that is not empty and carries the basis functions i … i+p, which it ``starts`` with number i:
its own number, where no knot inside is repeated. The matrix form of the recurrence is that
of T. Lyche and K. Mørken, *Spline Methods* (2018), section 2.4; the derivative formula is (2.7) of
L. Piegl and W. Tiller, *The NURBS Book* (1997).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.compiling.kernels import inlined, kernel
from rodwell.numerics.splines.lanes import on_lanes

MOST_ORDERS, AT_ONCE = 4, 8
"""Values and derivatives that are known, and places at which they are computed side by side."""

LANES = (0,) * AT_ONCE
"""As long as these, for the compiler."""

SPACING = 4.0 * np.finfo(np.float64).eps
"""Round-off in the difference of two knots, which are numbers from 0 to 1."""


@inlined
def _step(knots, span, k, x, row):
    """Turn weights of degree k−1 in ``row`` into weights of degree k, with the argument ``x``."""
    row[k] = 0.0
    for j in range(k - 1, -1, -1):
        left = knots[span - k + 1 + j]
        share = (x - left) / (knots[span + 1 + j] - left)
        row[j + 1] += share * row[j]
        row[j] *= 1.0 - share


@inlined
def blossom(knots, span, degree, places, out):
    """Write to ``out`` (≥ degree+1,) the weights of the polar form on the span [t[span], t[span+1]).

    ``f(x₁, …, x_k) = Σ_a out[a] c[span−degree+a]`` with the arguments ``places`` (≥ degree,). All
    arguments equal to s: the values at s of the basis functions. Consecutive knots of a finer mesh: the
    weights of knot insertion (the Oslo algorithm).
    """
    out[0] = 1.0
    for k in range(1, degree + 1):
        _step(knots, span, k, places[k - 1], out)


def functions(x: Any, knots: Any, degree: int, orders: int) -> list[list[Any]]:
    """Derivatives 0 … orders−1 at ``x`` of the basis functions of an element: rows of degree + 1 each.

    ``knots`` (2 degree + 2,) are those from t[e] to t[e+2p+1], of element e. Row d first gets the values of degree
    p − d, on the way of the recurrence up to degree p; it is then raised d times by
    ``N'_{i,q} = q N_{i,q−1}/(t_{i+q}−t_i) − q N_{i+1,q−1}/(t_{i+q+1}−t_{i+1})``. Beyond the degree there are zeros.
    """
    rows: list[list[Any]] = []
    row: list[Any] = [1.0]
    for k in range(1, degree + 1):
        if k > degree - orders + 1:
            rows.append(row)
        row = _next(x, knots, degree, k, row)
    rows = [row, *reversed(rows)]
    for order in range(1, len(rows)):
        for q in range(degree - order + 1, degree + 1):
            slopes = [
                float(q) * value / (knots[degree - q + 1 + j + q] - knots[degree - q + 1 + j])
                for j, value in enumerate(rows[order])
            ]
            inside = [slopes[j - 1] + (-slopes[j]) for j in range(1, q)]
            rows[order] = [-slopes[0], *inside, slopes[-1]]
    return rows + [[0.0] * (degree + 1)] * (orders - len(rows))


def _next(x: Any, knots: Any, degree: int, k: int, row: list[Any]) -> list[Any]:
    """Values of degree k from those of degree k − 1."""
    left = [knots[degree - k + 1 + j] for j in range(k)]
    shares = [(x - left[j]) / (knots[degree + 1 + j] - left[j]) for j in range(k)]
    parts = [(row[j] * (1.0 - shares[j]), shares[j] * row[j]) for j in range(k)]
    return [parts[0][0], *(parts[j][0] + parts[j - 1][1] for j in range(1, k)), parts[-1][1]]


def _side_by_side(local_tag: Any) -> Any:
    degree = local_tag.count - 1
    return lambda rows, knots: [x for row in functions(rows[0], knots, degree, MOST_ORDERS) for x in row]


_apply = on_lanes(_side_by_side, flags=())


@kernel
def side_by_side(local_tag, knots, span, places, out):
    """Write to ``out`` (4, p+1, 8) values and three derivatives at places of the functions on a knot span.

    The first row of ``places`` (≥ 1, 8) has these; ``local_tag`` is a tuple of p + 1 zeros, whose length the compiler
    knows.
    """
    window = knots[span - len(local_tag) + 1 : span + len(local_tag) + 1]
    _apply(local_tag, LANES, places, (window,), out)


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
def tabulate(local_tag, knots, starts, places, per_element, orders):
    """Basis functions at ``places``, ``per_element`` of them in each element in turn: (m, orders, degree+1).

    ``starts`` (elements,) are the first functions of the elements. Further places count as the right end of the last
    element. The places must divide all elements alike: where knots are evenly spaced, the table of one element is
    copied to the next.
    """
    degree = len(local_tag) - 1
    table = np.empty((places.size, orders, degree + 1))
    x, out = np.empty((1, AT_ONCE)), np.empty((MOST_ORDERS, degree + 1, AT_ONCE))
    known, spacing = -1, 0.0  # first place of the last element that was tabulated among evenly spaced knots
    for first in range(0, places.size, per_element):
        span = degree + starts[min(first // per_element, starts.size - 1)]
        last = min(first + per_element, places.size)
        even, width = _evenly_spaced(knots, span, degree), knots[span + 1] - knots[span]
        whole = last - first == per_element
        if whole and even and known >= 0 and abs(width - spacing) <= SPACING:
            for q in range(per_element):
                for order in range(orders):  # an assignment of slices would take seconds to compile
                    for a in range(degree + 1):
                        table[first + q, order, a] = table[known + q, order, a]
            continue
        for begin in range(first, last, AT_ONCE):
            for q in range(AT_ONCE):
                x[0, q] = places[min(begin + q, last - 1)]
            side_by_side(local_tag, knots, span, x, out)
            for q in range(min(AT_ONCE, last - begin)):
                for order in range(orders):
                    for a in range(degree + 1):
                        table[begin + q, order, a] = out[order, a, q]
        if whole and even:
            known, spacing = first, width
    return table


@kernel
def tabulate_anywhere(local_tag, knots, places, orders):
    """Basis functions at ``places`` (m,): (m, orders, degree+1), and the knot spans in which they lie, (m,)."""
    local = len(local_tag)
    table, spans = np.empty((places.size, orders, local)), np.empty(places.size, np.int64)
    x, out = np.empty((1, AT_ONCE)), np.empty((MOST_ORDERS, local, AT_ONCE))
    begin = 0
    while begin < places.size:
        span, count = find_span(knots, local - 1, places[begin]), 1
        while count < min(AT_ONCE, places.size - begin) and knots[span] <= places[begin + count] < knots[span + 1]:
            count += 1  # neighbours on one span are computed side by side
        for q in range(AT_ONCE):
            x[0, q] = places[begin + min(q, count - 1)]
        side_by_side(local_tag, knots, span, x, out)
        for q in range(count):
            spans[begin + q] = span
            for order in range(orders):
                for a in range(local):
                    table[begin + q, order, a] = out[order, a, q]
        begin += count
    return table, spans


@inlined
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
