"""Tangent, curvature and internal force of a rod in space, from its position across the hole: plain formulas.

With the tangent t, moment balance of an inextensible rod of bending stiffness b that carries the torque −T₁ about its
tangent (the sign of T₁ is the paper's, M⁽¹⁾ = (−T₁, ω₂, ω₃)),

    b t″ = −n + (t·n − b|t′|²) t − b′ t′ − T₁ t × t′,

gives the part of the internal force n across the rod; the part along it follows from n·k = N(s) = F + wₐ h(s), the
axial resultant (h = s − 1 of a uniform rod), since nothing but the weight acts along the hole without friction. Along
a free stretch n′ = wₗ i + wₐ k remains to be met, i pointing up across the hole: none of these is used by the solver,
which takes only what a rod on the wall exerts radially where it is cut (:func:`radially_at_wall`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rodwell.quantities.arrays import FloatArray


class InSpace(NamedTuple):
    """Along the rod: tangent ``t`` and internal force ``n``, (3, k) by x, y, z; curvature and tension (k,)."""

    t: FloatArray
    n: FloatArray
    curvature: FloatArray
    tension: FloatArray


def in_space(
    x: FloatArray, y: FloatArray, axial_resultant: FloatArray, twist: float, stiffness: FloatArray, rate: FloatArray
) -> InSpace:
    """Tangent and internal force from x and y with three derivatives, (4, k) each, from N(s), b(s) and b′(s), (k,)."""
    z1 = np.sqrt(1.0 - x[1] ** 2 - y[1] ** 2)
    z2 = -(x[1] * x[2] + y[1] * y[2]) / z1
    z3 = -(x[2] ** 2 + y[2] ** 2 + z2**2 + x[1] * x[3] + y[1] * y[3]) / z1
    t, t1, t2 = (np.stack(rows) for rows in ((x[1], y[1], z1), (x[2], y[2], z2), (x[3], y[3], z3)))
    square = np.sum(t1**2, axis=0)
    across = -stiffness * (t2 + square * t) - rate * t1 - twist * np.cross(t, t1, axis=0)
    tension = (axial_resultant - across[2]) / z1
    return InSpace(t, across + tension * t, np.sqrt(square), tension)


def radially_at_wall(
    rate: FloatArray, bend: FloatArray, radius: FloatArray, twist: float, stiffness: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Radial moment at a cut of a rod on the wall, its derivative by φ′, and the outward force there, (k,) each.

    From φ′ and φ″, with Δ, T₁ and b there. Seen from the place itself, φ = 0, r̂ = (−1, 0) and θ̂ = (0, 1), the rod has
    x′ = 0, y′ = Δφ′, x″ = Δφ′², y″ = Δφ″, x‴ = 3Δφ′φ″. What a variation of r and r′ does at the cut is M = ∂e/∂u″ · r̂
    and −R = Q · r̂ + φ′ ∂e/∂u″ · θ̂ with Q = ∂e/∂u′ − (∂e/∂u″)′ and the energy e off the wall (``energy``): with
    z′² = 1 − y′²

        M = −bΔφ′² + T₁Δφ′/(1 + z′),    R = T₁Δφ″/z′ − bΔφ′φ″ (3 + 1/z′²).

    Weight and end force do not enter.
    """
    y1 = radius * rate
    square = 1.0 - y1**2
    z1 = np.sqrt(square)
    moment = y1 * (twist / (1.0 + z1) - stiffness * rate)
    by_rate = radius * (twist / (z1 * (1.0 + z1)) - 2.0 * stiffness * rate)
    outward = radius * bend * (twist / z1 - stiffness * rate * (3.0 + 1.0 / square))
    return moment, by_rate, outward
