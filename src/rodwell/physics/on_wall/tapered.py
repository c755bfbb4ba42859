"""A section of a string that tapers: stiffness and weight are polynomials of s along it.

Its energy per length at s is that of a section with the stiffness b(s), the weight q(s) and the axial resultant N(s) =
F + wₐ h(s), h(s) = −∫ₛ¹ q ds: no derivative of b enters. So the density is that of
:mod:`rodwell.physics.on_wall.sections` with d = h − q(s − 1). What the rod's force needs more than that follows from
the balance of moments with M⁽¹⁾ = (−T₁, b ω₂, b ω₃) and of forces, (48), with b′ and b″:

    F₂ less b′ω₃,   F₃ more b′ω₂,   F₁ more b′ω₂ tan η,   p more b′ω₂(ω₃ tan η − 6ω₁) − b″ω₃.

Where b′ has a step [b′], the wall exerts the force [b′] ω₃ along d₁: where the stiffness begins to fall towards s = 1,
it would have to pull.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from rodwell.physics.on_wall.model import RodOfSections
from rodwell.physics.on_wall.parameters import CLEARANCE, RAMP, SIDE
from rodwell.physics.on_wall.strand import curvatures

TERMS = 5
"""Coefficients of b and q; h has one more."""

GIVEN = (
    "origin", *(f"{name}_{j}" for name, terms in (("stiffness", TERMS), ("weight", TERMS), ("lever", TERMS + 1))
                for j in range(terms))
)  # fmt: skip
"""Of a section: where x = s − origin is zero, and coefficients of b, q and h in xʲ."""

STIFFNESS, WEIGHT, LEVER = 1, 1 + TERMS, 1 + 2 * TERMS


def _horner(given: Any, first: int, terms: int, x: Any) -> Any:
    value = given[first + terms - 1]
    for j in range(terms - 2, -1, -1):
        value = value * x + given[first + j]
    return value


def here(s: Any, given: Any) -> Any:
    """b, q and d at ``s``, as of a section."""
    x = s - given[0]
    weight = _horner(given, WEIGHT, TERMS, x)
    return _horner(given, STIFFNESS, TERMS, x), weight, _horner(given, LEVER, TERMS + 1, x) - weight * (s - 1.0)


def _slope(given: Any, start: int, x: Any) -> Any:
    first = 0.0 * x
    for j in range(TERMS - 1, 0, -1):
        first = first * x + float(j) * given[start + j]
    return first


def weight_rate(s: Any, given: Any) -> Any:
    """The derivative q′ at ``s``."""
    return _slope(given, WEIGHT, s - given[0])


def stiffness_rates(s: Any, given: Any) -> Any:
    """b′ and b″ at ``s``."""
    x = s - given[0]
    first, second = _slope(given, STIFFNESS, x), 0.0 * x
    for j in range(TERMS - 1, 1, -1):
        second = second * x + float(j * (j - 1)) * given[STIFFNESS + j]
    return first, second


def more_force(y1: Any, y2: Any, y3: Any, clearance: Any, rate: Any) -> Any:
    """What b′ adds to F₁, F₂, F₃."""
    cos_eta, _, omega2, omega3, _ = curvatures(y1, y2, y3, clearance)
    return rate * omega2 * y1 / cos_eta, -rate * omega3, rate * omega2


def more_pressure(y1: Any, y2: Any, y3: Any, clearance: Any, rate: Any, bend: Any) -> Any:
    """What b′ and b″ add to the contact pressure p."""
    cos_eta, omega1, omega2, omega3, _ = curvatures(y1, y2, y3, clearance)
    return rate * omega2 * (omega3 * y1 / cos_eta - 6.0 * omega1) - bend * omega3


class RodOfTapers(NamedTuple):
    """A rod of sections that may taper, kept on a cylinder. The entry only counts."""

    y: int = 0

    @staticmethod
    def given() -> tuple[str, ...]:
        """Names of the coefficients that vary along s, by steps: those of polynomials."""
        return GIVEN

    @staticmethod
    def out_of_range() -> str:
        """What an energy that is no number means."""
        return RodOfSections.out_of_range()

    @staticmethod
    def density(s: Any, u: Any, given: Any, parameters: Any, rates: Any) -> Any:
        """Energy density and its derivatives at ``s``, in the section whose polynomials are ``given``."""
        return RodOfSections.density(s, u, here(s, given), parameters, rates)

    @staticmethod
    def observed(s: Any, u: Any, given: Any, parameters: Any) -> Any:
        """Return the contact pressure, negative in contact, at ``s``, from ``u`` with the third derivative."""
        plain = RodOfSections.observed(s, u, here(s, given), parameters)
        more = more_pressure(u[1] + parameters[RAMP], u[2], u[3], parameters[CLEARANCE], *stiffness_rates(s, given))
        return plain + parameters[SIDE] * more
