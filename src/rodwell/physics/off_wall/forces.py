"""Tangent, curvature and internal force of a rod in space, from its position across the hole: plain formulas.

With the tangent t, moment balance of an inextensible rod of bending stiffness b that carries the torque −T₁ about its
tangent (the sign of T₁ is the paper's, M⁽¹⁾ = (−T₁, ω₂, ω₃)),

    b t″ = −n + (t·n − b|t′|²) t − b′ t′ − T₁ t × t′,

gives the part of the internal force n across the rod; the part along it follows from n·k = N(s) = F + wₐ h(s), the
axial resultant (h = s − 1 of a uniform rod), since nothing but the weight acts along the hole without friction. Along
a free stretch n′ = wₗ i + wₐ k remains to be met, i pointing up across the hole: none of these is used by the solver.
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
