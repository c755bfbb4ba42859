"""What one family looks like on one mesh, as compiled loops take it: one record in place of a dozen arguments."""

from __future__ import annotations

from typing import Any, NamedTuple

from rodwell.quantities.arrays import FloatArray, IntArray


class Discretisation(NamedTuple):
    """A model on a spline space: m quadrature points, degree p, nf fields, n unknowns, k coefficients along s.

    Attributes
    ----------
    model
        A named tuple with an entry for each field; its class gives the formulas, see
        :mod:`rodwell.numerics.splines.assembly`.
    local, per_element
        Zeros, p + 1 and as many as there are quadrature points in an element: lengths that the compiler knows.
    table
        Basis functions and two derivatives at the quadrature points, (m, 3, p + 1).
    points, weights
        Of the quadrature, (m,) each.
    gram
        Band of the integrals of u′v′, (n, p + 1).
    held
        Unknowns that ends, or contact, hold, (h,).
    follows
        The unknown that each of these follows, or itself, (h,): see :mod:`rodwell.numerics.splines.held`.
    starts
        First basis function of each element, (elements,).
    given
        Coefficients that vary along s, at the quadrature points, (m, k); k may be 0.
    parity
        1 or −1 keeps increments even or odd about the middle, 0 leaves them.
    """

    model: Any
    local: tuple[int, ...]
    per_element: tuple[int, ...]
    table: FloatArray
    points: FloatArray
    weights: FloatArray
    gram: FloatArray
    held: IntArray
    follows: IntArray
    starts: IntArray
    given: FloatArray
    parity: int
