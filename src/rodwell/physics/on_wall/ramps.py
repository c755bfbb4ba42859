"""A wall whose clearance Δ(s) varies along it: the rod that lies straight there, and any other, as a model.

The rod lies on the generator θ = 0, at the distance Δ(s) from the axis k of the hole, with z₀′ = √(1 − Δ′²) and the
curvature κ₀ = Δ″/z₀′. The wall pushes along its normal: with R per length across the hole, so along it, too, with
RΔ′/z₀′ where the hole narrows or widens. Forces F₀ = λt − (bt′)′ and balance along t give, whatever the slope,

    λ′ = −2b′κ₀² − 3/2 b(κ₀²)′ − wₗ q Δ′ + wₐ q z₀′,   λ z₀′ − (bz₀″)′ = N,   N(1) = F,
    R = wₗ q + (λΔ′)′ − (bΔ″)″,

so that the axial resultant N(s) is F + wₐh more what the wall pushes above s, and λ = F/z₀′(1) + … . Where the rod
buckles and slides along the hole this push does work, to the first order that of the rod that lies: its energy per
length is that of :mod:`rodwell.physics.on_wall.ramped_energy` with this N(s). Critical loads are then those of a rod
each cross-section of which finds the wall where it gets to, exactly. A buckled rod takes with it the clearance that
each cross-section has in the rod that lies.

The field of the engine is y = Δ₀θ with the clearance Δ₀ of the problem, to which ratios refer.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rodwell.physics.on_wall._ramped_density import ramped_density
from rodwell.physics.on_wall.model import RodOnCylinder
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, LATERAL_WEIGHT, SIDE

TERMS = 5
"""Coefficients of b, q and Δ."""

DRIVE_TERMS = 16
"""Coefficients of each part of λ."""

PARTS = ("bending", "lateral", "axial")
"""Of λ less F/z₀′(1) and −3/2 bκ₀²: from b′ and from what is left at s = 1; by wₗ; by wₐ."""

GIVEN = (
    "centre", "scale", "by_force",
    *(f"{name}_{j}" for name in ("stiffness", "weight", "clearance") for j in range(TERMS)),
    *(f"{name}_{j}" for name in PARTS for j in range(DRIVE_TERMS)),
)  # fmt: skip
"""Of a section: where x = (s − centre)·scale is zero and its scale, 1/z₀′(1), coefficients of each function in xʲ."""

CENTRE, SCALE, BY_FORCE, STIFFNESS = range(4)
WEIGHT, OWN_CLEARANCE, BENDING = (STIFFNESS + k * TERMS for k in (1, 2, 3))
LATERAL, AXIAL = (BENDING + k * DRIVE_TERMS for k in (1, 2))


class Wall(NamedTuple):
    """Rod and wall at s: b and two derivatives by s, q, Δ and four; z₀′, z₀″, z₀‴."""

    stiffness: tuple[Any, Any, Any]
    weight: Any
    clearance: tuple[Any, Any, Any, Any, Any]
    lying: tuple[Any, Any, Any]


def _derivative(given: Any, first: int, terms: int, x: Any, order: int = 0) -> Any:
    """A polynomial, or a derivative of it by x."""
    value = 0.0 * x
    for j in range(terms - 1, order - 1, -1):
        factor = 1.0
        for k in range(order):
            factor *= float(j - k)
        value = value * x + factor * given[first + j]
    return value


def wall_at(s: Any, given: Any) -> Wall:
    """Rod and wall at ``s``."""
    scale = given[SCALE]
    x, powers = (s - given[CENTRE]) * scale, [1.0]
    for _ in range(TERMS - 1):
        powers.append(powers[-1] * scale)
    b, b1, b2 = (powers[k] * _derivative(given, STIFFNESS, TERMS, x, k) for k in range(3))
    d, d1, d2, d3, d4 = (powers[k] * _derivative(given, OWN_CLEARANCE, TERMS, x, k) for k in range(5))
    z1 = np.sqrt((1.0 - d1) * (1.0 + d1))
    z2 = -d1 * d2 / z1
    z3 = -(d2 * d2 + d1 * d3 + z2 * z2) / z1
    return Wall((b, b1, b2), _derivative(given, WEIGHT, TERMS, x), (d, d1, d2, d3, d4), (z1, z2, z3))


def _loaded(s: Any, given: Any, parameters: Any) -> Any:
    """What loads give to λ: all of it but what is due to bending."""
    x = (s - given[CENTRE]) * given[SCALE]
    by_lateral, by_axial = (_derivative(given, part, DRIVE_TERMS, x) for part in (LATERAL, AXIAL))
    return (
        given[BY_FORCE] * parameters[FORCE] + parameters[LATERAL_WEIGHT] * by_lateral
        + parameters[AXIAL_WEIGHT] * by_axial
    )  # fmt: skip


def tangential(s: Any, given: Any, wall: Wall, parameters: Any) -> Any:
    """λ at ``s`` of the rod that lies."""
    _, _, d2, *_ = wall.clearance
    bent = wall.stiffness[0] * (d2 / wall.lying[0]) * (d2 / wall.lying[0])
    own = _derivative(given, BENDING, DRIVE_TERMS, (s - given[CENTRE]) * given[SCALE])
    return _loaded(s, given, parameters) + own - 1.5 * bent


def axial_resultant(s: Any, given: Any, wall: Wall, parameters: Any) -> Any:
    """N(s) of the rod that lies: F + wₐh, and what the wall pushes along the hole above s."""
    (b, b1, _), (z1, z2, z3) = wall.stiffness, wall.lying
    return tangential(s, given, wall, parameters) * z1 - (b1 * z2 + b * z3)


def lying_push(s: Any, given: Any, wall: Wall, parameters: Any) -> Any:
    """R: the wall's force per length across the hole, towards its axis, on the rod that lies."""
    (b, b1, b2), (z1, z2, _) = wall.stiffness, wall.lying
    _, d1, d2, d3, d4 = wall.clearance
    lateral, axial = parameters[LATERAL_WEIGHT] * wall.weight, parameters[AXIAL_WEIGHT] * wall.weight
    bend = d2 / z1
    square_rate = 2.0 * bend * (d3 - bend * z2) / z1  # (κ₀²)′
    rate = -2.0 * b1 * bend * bend - 1.5 * b * square_rate - lateral * d1 + axial * z1  # λ′
    along = tangential(s, given, wall, parameters)
    return lateral + rate * d1 + along * d2 - (b * d4 + 2.0 * b1 * d3 + b2 * d2)


def slack_of(s: Any, u: Any, given: Any, parameters: Any) -> Any:
    """(z₀′ − z′) z₀′ at ``s``: how far a cross-section of the buckled rod comes along the wall, per length, and on k.

    It is that by which the energy changes with N, and to the order of sin⁴η Δ′² the slack 1 − cos η along the wall.
    """
    wall = wall_at(s, given)
    around, lying = wall.clearance[0] * u[1] / parameters[CLEARANCE], wall.lying[0]
    return around * around / (1.0 + np.sqrt(1.0 - (around / lying) * (around / lying)))


class Strand(NamedTuple):
    """The rod at s: curvatures, force along t₁, d₁, u₁ and contact pressure, as in a straight hole; and sin η, z′.

    d₁ is normal to the rod and to the direction around the hole, towards its axis.
    """

    sin_eta: Any
    ahead: Any
    omega: tuple[Any, Any, Any]
    force: tuple[Any, Any, Any]
    pressure: Any


def strand(s: Any, u: Any, given: Any, parameters: Any) -> Strand:
    """The rod at ``s`` from y and three derivatives: from its curve in space and the balance of forces.

    r″, r‴, r⁗ have components along eᵣ, e_θ, k; with F = λt − (bt′)′, F·k = N. The fourth derivative of y is left out
    of the pressure by the balance along e_θ and t.
    """
    wall = wall_at(s, given)
    (b, b1, b2), (d, d1, d2, d3, d4) = wall.stiffness, wall.clearance
    a, a1, a2, a3 = (one / parameters[CLEARANCE] for one in u[:4])
    lateral, axial = parameters[LATERAL_WEIGHT] * wall.weight, parameters[AXIAL_WEIGHT] * wall.weight
    resultant = axial_resultant(s, given, wall, parameters)
    pushed_along = lying_push(s, given, wall, parameters) * d1 / wall.lying[0]

    across = d * a1
    r2, t2 = d2 - across * a1, 2.0 * d1 * a1 + d * a2
    r3 = d3 - 3.0 * d1 * a1 * a1 - 3.0 * across * a2
    t3 = 3.0 * d2 * a1 + 3.0 * d1 * a2 + d * a3 - across * a1 * a1
    r4 = d4 - 6.0 * d2 * a1 * a1 - 12.0 * d1 * a1 * a2 - 3.0 * d * a2 * a2 - 4.0 * across * a3 + across * a1 * a1 * a1
    z1 = np.sqrt(1.0 - d1 * d1 - across * across)
    z2 = -(d1 * r2 + across * t2) / z1
    square = r2 * r2 + t2 * t2 + z2 * z2  # κ²
    z3 = -(square + d1 * r3 + across * t3) / z1
    square_rate = 2.0 * (r2 * r3 + t2 * t3 + z2 * z3)

    along = (resultant + b1 * z2 + b * z3) / z1  # λ
    bent_along = -2.0 * b1 * square - 1.5 * b * square_rate  # (bt′)″·t
    heavy = lateral * (d1 * np.cos(a) - across * np.sin(a))
    resultant_rate = axial - pushed_along
    push = (
        d1 * (bent_along - heavy + resultant_rate * z1) + along * r2 - (b * r4 + 2.0 * b1 * r3 + b2 * r2)
        + lateral * np.cos(a)
    ) / ((1.0 - d1) * (1.0 + d1))  # fmt: skip

    cos_eta = np.sqrt((1.0 - across) * (1.0 + across))
    up, ahead = (
        d1 / cos_eta,
        z1 / cos_eta,
    )  # t = cos η (up eᵣ + ahead k) + sin η e_θ
    tilt = d2 / cos_eta + d1 * across * (d1 * a1 + d * a2) / (cos_eta * cos_eta * cos_eta)
    turning = -cos_eta * ahead * a1 - across * tilt / ahead
    shear = tuple(b1 * second + b * third for second, third in ((r2, r3), (t2, t3), (z2, z3)))  # (bt′)′

    def inwards(vector: Any) -> Any:
        return up * vector[2] - ahead * vector[0]

    def sideways(vector: Any) -> Any:
        return cos_eta * vector[1] - across * (up * vector[0] + ahead * vector[2])

    curved = (r2, t2, z2)
    return Strand(
        across, z1, (turning, -sideways(curved), inwards(curved)),
        (along + b * square, -inwards(shear), -sideways(shear)),
        -(push * ahead + pushed_along * up),
    )  # fmt: skip


class RodOnRamps(NamedTuple):
    """A heavy rod kept on a wall whose clearance varies along it: one field, y = Δ₀θ. The entry only counts."""

    y: int = 0

    @staticmethod
    def given() -> tuple[str, ...]:
        """Names of the coefficients that vary along s, by steps: those of polynomials."""
        return GIVEN

    @staticmethod
    def out_of_range() -> str:
        """What an energy that is no number means."""
        return RodOnCylinder.out_of_range()

    @staticmethod
    def density(s: Any, u: Any, given: Any, parameters: Any, rates: Any) -> Any:
        """Energy density and its derivatives at ``s``, where y has the value and derivatives ``u``."""
        wall, over = wall_at(s, given), 1.0 / parameters[CLEARANCE]
        own = (axial_resultant(s, given, wall, parameters), wall.weight * parameters[LATERAL_WEIGHT])
        along = (_loaded(s, given, rates) * wall.lying[0], wall.weight * rates[LATERAL_WEIGHT])
        energy, rate, gradient, mixed, hessian = ramped_density(
            over * u[0], over * u[1], over * u[2], (wall.stiffness[0], *wall.clearance[:3]), own, along
        )

        def over_clearance(row: Any) -> Any:
            return tuple(over * x for x in row)

        rows = tuple(over_clearance(over_clearance(row)) for row in hessian)
        return energy, rate, over_clearance(gradient), over_clearance(mixed), rows

    @staticmethod
    def observed(s: Any, u: Any, given: Any, parameters: Any) -> Any:
        """Return the contact pressure, negative in contact, at ``s``, from ``u`` with the third derivative."""
        return parameters[SIDE] * strand(s, u, given, parameters).pressure
