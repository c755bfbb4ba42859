"""The endless rod on the wall: energy, contact, curvature and shortening per length, in the angle round the wall.

Far from its ends a rod under compression P and a normal load q per length, of weight and of the hole's curvature
together, depends on two numbers only: β = P/√(Bq/D), and the slope ε = (qD³/B)^¼ = D/ℓ. Lengths are in
ℓ = (BD/q)^¼, forces per length in q, energies per length in qD; θ(x) is the angle from the low side, and what is called
rate, bend, third here are θ', θ'', θ'''. With y = Dθ the energy is that of :mod:`rodwell.physics.on_wall.energy` for
P = −F, without twist and axial weight; written so, it has a limit for ε → 0: small slopes.

    e = ½θ''²/(1 − ε²θ'²) + ½θ'⁴ − cos θ + β (√(1 − ε²θ'²) − 1)/ε²

Here compression is positive, as usual for β; the axial force is constant (a dead load), and nothing holds the rod from
turning about the axis.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rodwell.quantities.arrays import FloatArray


class Density(NamedTuple):
    """Energy per length and its derivatives by θ, θ', θ'', each (m,); those of second order that are missing vanish."""

    energy: FloatArray
    by_angle: FloatArray
    by_rate: FloatArray
    by_bend: FloatArray
    angle_angle: FloatArray
    rate_rate: FloatArray
    rate_bend: FloatArray
    bend_bend: FloatArray


def density(fields: FloatArray, beta: float, slope: float) -> Density:
    """Energy per length, in qD, with its first and second derivatives, from θ, θ', θ'' (3, m)."""
    angle, rate, bend = fields
    square = slope * slope
    cosine = np.sqrt(1.0 - square * rate * rate)  # cos η = dz/dx
    secant2 = 1.0 / (cosine * cosine)
    slanted = square * rate * secant2 * secant2
    return Density(
        energy=0.5 * bend * bend * secant2 + 0.5 * rate**4 - np.cos(angle) - beta * shortening(rate, slope),
        by_angle=np.sin(angle),
        by_rate=bend * bend * slanted + 2.0 * rate**3 - beta * rate / cosine,
        by_bend=bend * secant2,
        angle_angle=np.cos(angle),
        rate_rate=square * bend * bend * secant2**2 * (1.0 + 4.0 * square * rate * rate * secant2)
        + 6.0 * rate * rate - beta / cosine**3,
        rate_bend=2.0 * bend * slanted,
        bend_bend=secant2,
    )  # fmt: skip


def load_derivative(rate: FloatArray, slope: float) -> FloatArray:
    """How ``by_rate`` of :class:`Density` changes with β, (m,)."""
    return np.asarray(-rate / np.sqrt(1.0 - (slope * rate) ** 2))


def contact(fields: FloatArray, beta: float, slope: float) -> FloatArray:
    """Force of the wall on the rod per length, in q, positive towards the axis, (m,), from θ to θ''' (4, m).

    ``n = cos θ + (β − z''') θ'²/z' − θ'⁴ + 4θ'θ''' + 3θ''²`` with ``z' = √(1 − ε²θ'²)``: the variation of the energy by
    the distance from the axis. It equals −p of :func:`rodwell.physics.on_wall.strand.contact_pressure`.
    """
    angle, rate, bend, third = fields
    square = slope * slope
    z1 = np.sqrt(1.0 - square * rate * rate)
    z2 = -square * rate * bend / z1
    z3 = -(square * (bend * bend + rate * third) + z2 * z2) / z1
    return np.asarray(np.cos(angle) + (beta - z3) * rate**2 / z1 - rate**4 + 4.0 * rate * third + 3.0 * bend**2)


def curvature(rate: FloatArray, bend: FloatArray, slope: float) -> FloatArray:
    """Curvature of the rod in D/ℓ² = √(qD/B), (m,): across the wall θ''/cos η, along its curve θ'²."""
    return np.asarray(np.hypot(bend / np.sqrt(1.0 - (slope * rate) ** 2), rate * rate))


def shortening(rate: FloatArray, slope: float) -> FloatArray:
    """Axial shortening per length in ε² = √(qD³/B), (m,): (1 − cos η)/ε², for small slopes ½θ'²."""
    return np.asarray(rate * rate / (1.0 + np.sqrt(1.0 - (slope * rate) ** 2)))
