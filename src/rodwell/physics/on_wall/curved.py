"""The rod in a curved hole as a model that numerics can solve, and the forces in it, place by place.

What the hole is at s comes as polynomials in s, piece by piece: k₁, k₂ and the parts g₁, g₂ of the weight along N₁,
N₂, as ratios to w, at the place S that the cross-section has on the hole's axis, and A(s) and C(s) of the force N =
(1 + Δk₁)(F − w A + C) that drives the rod there, reduced to the axis. Formulas are generated: see
:mod:`rodwell.physics.on_wall.curved_energy`.

They are written for a rod of stiffness 1. A piece of a string lies in one section: with its stiffness b the energy is
b times that of a rod of stiffness 1 under 1/b of the loads, N among them, as in a straight hole
(:mod:`rodwell.physics.on_wall.sections`). Of another weight q(s) the hole is given q g₁, q g₂ and A = ∫ₛ¹ q T·k ds.

Where b varies along a section the energy at s is that of a section with b(s): no derivative of b enters. The balance of
moments and of forces has more (unit vectors as in :mod:`rodwell.physics.on_wall.tapered`):

    F₂ less b′ω₃,   F₃ more b′ω₂,   F₁ more b′ω₂ tan η,   p more 2b′(F₂ + T₁ω₂)/b + b′ω₂ω₃ tan η − b″ω₃,

the last with F₂ as of a section of one stiffness. In a straight hole that F₂ is −ω₂(3bω₁ + T₁).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rodwell.physics.on_wall._curved_density import curved_density, curved_strand
from rodwell.physics.on_wall.model import RodOnCylinder
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, SIDE, TWIST
from rodwell.physics.on_wall.sections import of_section, times

FUNCTIONS = ("k1", "k2", "g1", "g2", "lift", "offset")
LIFT, OFFSET = (FUNCTIONS.index(name) for name in ("lift", "offset"))
DEGREE = 6
TERMS = DEGREE + 1

GIVEN = ("stiffness", "centre", "scale", *(f"{name}_{j}" for name in FUNCTIONS for j in range(TERMS)))
"""Of a piece: B(s)/B, where x = (s − centre)·scale is zero and its scale, coefficients of each function in xʲ."""

STIFFNESS, CENTRE, SCALE, FIRST = range(4)

BENDING = len(FUNCTIONS)
"""Which function of s the stiffness is where it varies."""

GIVEN_OF_TAPERS = (*GIVEN, *(f"stiffness_{j}" for j in range(TERMS)))
"""Of a piece of a string that tapers somewhere: B(s)/B as a polynomial, too."""


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
    x = (s - given[CENTRE]) * given[SCALE]
    return tuple(_horner(given, which, x) for which in range(len(FUNCTIONS)))


def bends_at(s: Any, given: Any) -> tuple[Any, Any]:
    """K₁, k₂ at ``s``: what the way along the hole takes."""
    x = (s - given[CENTRE]) * given[SCALE]
    return _horner(given, 0, x), _horner(given, 1, x)


def here_at(s: Any, given: Any) -> Here:
    """Return the hole at ``s`` with the derivatives of its curvatures."""
    x, scale = (s - given[CENTRE]) * given[SCALE], given[SCALE]
    first = [scale * _derivative(given, which, x, 1) for which in (0, 1)]
    second = [scale * scale * _derivative(given, which, x, 2) for which in (0, 1)]
    return Here(hole_at(s, given), (*first, *second))


def strand(s: Any, u: Any, given: Any, parameters: Any) -> Any:
    """ω₁, ω₂, ω₃, F₁, F₂, F₃ and the contact pressure p, from y and three derivatives.

    Components along t₁, d₁, u₁ as in :mod:`rodwell.physics.on_wall.strand`; p < 0 presses a rod inside on the wall.
    Arrays of either kind may be ``given``: :data:`GIVEN`, or :data:`GIVEN_OF_TAPERS`.
    """
    of_one = _strand_of_tapers if len(given) > len(GIVEN) else _strand_of_sections
    return of_one(s, u, given, parameters)


def _tapering(s: Any, given: Any) -> Any:
    return _horner(given, BENDING, (s - given[CENTRE]) * given[SCALE])


def _strand_of_sections(s: Any, u: Any, given: Any, parameters: Any) -> Any:
    return _strand(s, u, given, parameters, given[STIFFNESS])


def _strand_of_tapers(s: Any, u: Any, given: Any, parameters: Any) -> Any:
    x, scale, stiffness = (s - given[CENTRE]) * given[SCALE], given[SCALE], _tapering(s, given)
    rate = scale * _derivative(given, BENDING, x, 1)
    bend = scale * scale * _derivative(given, BENDING, x, 2)
    omega1, omega2, omega3, f1, f2, f3, p = _strand(s, u, given, parameters, stiffness)
    tilt = u[1] / np.sqrt((1.0 - u[1]) * (1.0 + u[1]))
    more = 2.0 * rate * (f2 + parameters[TWIST] * omega2) / stiffness + rate * omega2 * omega3 * tilt - bend * omega3
    return omega1, omega2, omega3, f1 + rate * omega2 * tilt, f2 - rate * omega3, f3 + rate * omega2, p + more


def _strand(s: Any, u: Any, given: Any, parameters: Any, stiffness: Any) -> Any:
    """The same with a stiffness at s, whose derivatives are left out."""
    here = here_at(s, given)
    own = _own_loads(stiffness, parameters)
    omega1, omega2, omega3, *forces = curved_strand(
        u[0], u[1], u[2], u[3], _own_hole(stiffness, here.hole), here.rates, own[CLEARANCE], own[TWIST], own[FORCE],
        own[AXIAL_WEIGHT],
    )  # fmt: skip
    return omega1, omega2, omega3, *(stiffness * force for force in forces)


def step_loads(s: Any, shapes: Any, given: Any, stiffness: Any, parameters: Any) -> tuple[Any, Any]:
    """Couple about u₁ and force along d₁ (towards the axis), (k,) each, of the wall on the rod at k steps of b.

    ``shapes``, ``given`` and ``stiffness`` b are those on the sides towards s = 0 and s = 1. From the balance of
    moments and of forces: −[b] ω₃ and −[F₂], which holds −(b ω₃)′ and so the rate of the curvature of the hole. In a
    bend ω₃ is not zero of a rod that lies still.
    """
    (_, f2_below), (bend, f2_above) = (
        strand(s, u, rows, parameters)[2:5:2] for u, rows in zip(shapes, given, strict=True)
    )
    return (stiffness[0] - stiffness[1]) * bend, f2_below - f2_above


def _own_loads(stiffness: Any, parameters: Any) -> list[Any]:
    """Parameters of a rod of stiffness 1, in their order: 1/b of the loads."""
    return of_section((stiffness, 1.0, 0.0), parameters, 1.0 / stiffness)


def _own_hole(stiffness: Any, hole: Any) -> tuple[Any, ...]:
    """The hole of that rod: C is a force."""
    k1, k2, g1, g2, lift, offset = hole
    return k1, k2, g1, g2, lift, offset / stiffness


def _density(s: Any, u: Any, given: Any, parameters: Any, rates: Any, stiffness: Any) -> Any:
    hole, own, along = (
        _own_hole(stiffness, hole_at(s, given)), _own_loads(stiffness, parameters), _own_loads(stiffness, rates)
    )  # fmt: skip
    return times(stiffness, curved_density(u[0], u[1], u[2], hole, parameters[CLEARANCE], own, along))


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
        return _density(s, u, given, parameters, rates, given[STIFFNESS])

    @staticmethod
    def observed(s: Any, u: Any, given: Any, parameters: Any) -> Any:
        """Return the contact pressure, negative in contact, at ``s``, from ``u`` with the third derivative."""
        return parameters[SIDE] * _strand_of_sections(s, u, given, parameters)[-1]


class TaperedRodInCurvedHole(RodInCurvedHole):
    """The same of a string that tapers somewhere."""

    @staticmethod
    def given() -> tuple[str, ...]:
        """Names of the coefficients that vary along s, by pieces."""
        return GIVEN_OF_TAPERS

    @staticmethod
    def density(s: Any, u: Any, given: Any, parameters: Any, rates: Any) -> Any:
        """Energy density and its derivatives at ``s``, where y has the value and derivatives ``u``."""
        return _density(s, u, given, parameters, rates, _tapering(s, given))

    @staticmethod
    def observed(s: Any, u: Any, given: Any, parameters: Any) -> Any:
        """Return the contact pressure, negative in contact, at ``s``, from ``u`` with the third derivative."""
        return parameters[SIDE] * _strand_of_tapers(s, u, given, parameters)[-1]


def model_of(given: Any) -> type[RodInCurvedHole]:
    """The model to which arrays of what is given belong."""
    return TaperedRodInCurvedHole if len(given) > len(GIVEN) else RodInCurvedHole
