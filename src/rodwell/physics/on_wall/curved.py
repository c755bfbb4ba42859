"""The rod in a curved hole as a model that numerics can solve, and the forces in it, place by place.

What the hole is at s comes as polynomials in s, piece by piece: k₁, k₂ and the parts g₁, g₂ of the vertical along N₁,
N₂, at the place S that the cross-section has on the hole's axis, and A(s) and C(s) of the force N = (1 + Δk₁)(F − w A
+ C) that drives the rod there, reduced to the axis. Formulas are generated: see
:mod:`rodwell.physics.on_wall.curved_energy`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from rodwell.physics.on_wall._curved_density import curved_density, curved_strand
from rodwell.physics.on_wall.model import RodOnCylinder
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, SIDE, TWIST

FUNCTIONS = ("k1", "k2", "g1", "g2", "lift", "offset")
DEGREE = 6
TERMS = DEGREE + 1

GIVEN = ("centre", "scale", *(f"{name}_{j}" for name in FUNCTIONS for j in range(TERMS)))
"""Of a piece: where x = (s − centre)·scale is zero and its scale, and coefficients of each function in xʲ."""

FIRST = 2


class Here(NamedTuple):
    """The hole at s: k₁, k₂, g₁, g₂, A, C; the first derivatives of k₁ and k₂ along s, and the second ones."""

    hole: tuple[Any, ...]
    rates: tuple[Any, ...]


def _horner(given: Any, which: int, x: Any) -> Any:
    first = FIRST + which * TERMS
    value = given[first + DEGREE]
    for j in range(DEGREE - 1, -1, -1):
        value = value * x + given[first + j]
    return value


def _derivative(given: Any, which: int, x: Any, order: int) -> Any:
    """First or second derivative by x."""
    first = FIRST + which * TERMS
    value = 0.0 * x
    for j in range(DEGREE, order - 1, -1):
        value = value * x + (float(j) if order == 1 else float(j * (j - 1))) * given[first + j]
    return value


def hole_at(s: Any, given: Any) -> tuple[Any, ...]:
    """K₁, k₂, g₁, g₂, A, C at ``s``."""
    x = (s - given[0]) * given[1]
    return tuple(_horner(given, which, x) for which in range(len(FUNCTIONS)))


def bends_at(s: Any, given: Any) -> tuple[Any, Any]:
    """K₁, k₂ at ``s``: what the way along the hole takes."""
    x = (s - given[0]) * given[1]
    return _horner(given, 0, x), _horner(given, 1, x)


def here_at(s: Any, given: Any) -> Here:
    """Return the hole at ``s`` with the derivatives of its curvatures."""
    x, scale = (s - given[0]) * given[1], given[1]
    first = [scale * _derivative(given, which, x, 1) for which in (0, 1)]
    second = [scale * scale * _derivative(given, which, x, 2) for which in (0, 1)]
    return Here(hole_at(s, given), (*first, *second))


def strand(s: Any, u: Any, given: Any, parameters: Any) -> Any:
    """ω₁, ω₂, ω₃, F₁, F₂, F₃ and the contact pressure p, from y and three derivatives.

    Components along t₁, d₁, u₁ as in :mod:`rodwell.physics.on_wall.strand`; p < 0 presses a rod inside on the wall.
    """
    here = here_at(s, given)
    return curved_strand(
        u[0], u[1], u[2], u[3], here.hole, here.rates, parameters[CLEARANCE], parameters[TWIST], parameters[FORCE],
        parameters[AXIAL_WEIGHT],
    )  # fmt: skip


class RodInCurvedHole(NamedTuple):
    """A heavy rod kept on the wall of a curved hole: one field, y = Δθ. The entry only counts.

    Of its parameters the axial weight is the whole weight per length, the lateral one does not enter.
    """

    y: int = 0

    @staticmethod
    def given() -> tuple[str, ...]:
        """Names of the coefficients that vary along s, by pieces."""
        return GIVEN

    @staticmethod
    def out_of_range() -> str:
        """What an energy that is no number means."""
        return RodOnCylinder.out_of_range()

    @staticmethod
    def density(s: Any, u: Any, given: Any, parameters: Any, rates: Any) -> Any:
        """Energy density and its derivatives at ``s``, where y has the value and derivatives ``u``."""
        return curved_density(u[0], u[1], u[2], hole_at(s, given), parameters[CLEARANCE], parameters, rates)

    @staticmethod
    def observed(s: Any, u: Any, given: Any, parameters: Any) -> Any:
        """Return the contact pressure, negative in contact, at ``s``, from ``u`` with the third derivative."""
        return parameters[SIDE] * strand(s, u, given, parameters)[-1]
