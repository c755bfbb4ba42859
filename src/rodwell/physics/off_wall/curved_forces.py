"""Tangent, curvature and internal force of a uniform rod anywhere in a curved hole, from its position across it.

In N₁, N₂, T of the hole beside the rod, which turn with it: a vector v has the derivative v′ + q Ω × v along the rod,
with Ω = k₁N₂ − k₂N₁ and S′ = q = a/h of :mod:`rodwell.physics.off_wall.curved_energy`. Moment balance with M = t × t′ −
T₁t gives the part of the internal force n across the rod, as in a straight hole
(:mod:`rodwell.physics.off_wall.forces`); the part along it follows from the force that drives the rod along the hole,

    N = h n·T + M·Ω :

a step along the hole moves the cross-section by h, and turns it with T. Along a free stretch n′ = w k, k pointing
vertically up, remains to be met.
"""

from __future__ import annotations

import numpy as np

from rodwell.physics.off_wall.forces import InSpace
from rodwell.quantities.arrays import FloatArray


def in_curved_hole(
    x: FloatArray, y: FloatArray, bends: FloatArray, rates: FloatArray, drive: FloatArray, twist: float | FloatArray
) -> InSpace:
    """Tangent and internal force by N₁, N₂, T, from x and y with three derivatives, (4, k) each, and N(s), (k,).

    ``bends`` are k₁, k₂ there, ``rates`` their derivatives along the rod, (2, k) each.
    """
    (k1, k2), (k1_rate, k2_rate) = bends, rates
    a = np.sqrt(1.0 - x[1] ** 2 - y[1] ** 2)
    a1 = -(x[1] * x[2] + y[1] * y[2]) / a
    a2 = -(x[2] ** 2 + y[2] ** 2 + a1**2 + x[1] * x[3] + y[1] * y[3]) / a
    h = 1.0 - k1 * x[0] - k2 * y[0]
    h1 = -(k1 * x[1] + k2 * y[1] + k1_rate * x[0] + k2_rate * y[0])
    q, q1 = a / h, (a1 - a * h1 / h) / h
    across, across1 = k1 * x[1] + k2 * y[1], k1 * x[2] + k2 * y[2] + k1_rate * x[1] + k2_rate * y[1]
    along, along1 = a * q, a1 * q + a * q1
    t = np.stack([x[1], y[1], a])
    t1 = np.stack([x[2] + along * k1, y[2] + along * k2, a1 - q * across])
    changes = np.stack([
        x[3] + along1 * k1 + along * k1_rate, y[3] + along1 * k2 + along * k2_rate, a2 - q1 * across - q * across1
    ])  # fmt: skip
    omega = np.stack([-k2, k1, np.zeros_like(a)])
    t2 = changes + q * np.cross(omega, t1, axis=0)
    square = np.sum(t1**2, axis=0)
    n = -(t2 + square * t) - twist * np.cross(t, t1, axis=0)
    moment = np.cross(t, t1, axis=0) - twist * t
    tension = ((drive - np.sum(moment * omega, axis=0)) / h - n[2]) / a
    return InSpace(t, n + tension * t, np.sqrt(square), tension)


def radially_at_curved_wall(
    shape: tuple[FloatArray, FloatArray, FloatArray],
    bends: FloatArray,
    bend_rates: FloatArray,
    radius: float | FloatArray,
    twist: float | FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """Radial moment at a cut of a rod on the wall, its derivatives by φ, φ′ and the place, and the outward force, (k,).

    ``shape`` is φ, φ′, φ″; ``bends`` and ``bend_rates`` as of :func:`in_curved_hole`. As
    :func:`rodwell.physics.off_wall.forces.radially_at_wall`, with the energy in a curved hole: with κₙ, κₜ, h of
    :mod:`rodwell.physics.on_wall.curved_energy`, a² = 1 − Δ²φ′², q = a/h and the geodesic curvature K = Δφ″/a + qκₜ,

        M = −Δφ′² − a²κₙ/h + T₁Δφ′/(1 + a),
        R = K (Δφ′ [Δφ′²/a + qκₙ] − 2φ′/a) + T₁ [Δφ″/(1 + a) + qκₜ] + M′.

    Weight and end force do not enter.
    """
    angle, rate, bend = shape
    cos, sin = np.cos(angle), np.sin(angle)
    inwards, around = bends[0] * cos - bends[1] * sin, bends[0] * sin + bends[1] * cos
    y1 = radius * rate
    a = np.sqrt(1.0 - y1**2)
    h = 1.0 + radius * inwards
    q, half = a / h, 1.0 / (1.0 + a)
    moment = -y1 * rate - a * q * inwards + twist * y1 * half
    by_angle = q**2 * around
    by_rate = -2.0 * y1 * (1.0 - radius * inwards / h) + twist * radius * half / a
    by_place = -(q**2) * (bend_rates[0] * cos - bend_rates[1] * sin)
    geodesic = radius * bend / a + q * around
    outward = geodesic * (y1 * (y1 * rate / a + q * inwards) - 2.0 * rate / a)
    outward = outward + twist * (radius * bend * half + q * around) + by_angle * rate + by_rate * bend + by_place
    return moment, by_angle, by_rate, by_place, outward
