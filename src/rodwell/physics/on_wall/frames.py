"""The four frames of rod and cylinder as rotation matrices, and the curvatures of the rod's material frame."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

FRAMES = {
    "R11": ("t1", "d1", "u1"),
    "R01": ("t1", "d0", "v1"),
    "R12": ("t2", "d1", "u2"),
    "R22": ("t2", "d2", "v2"),
}
"""Frames of the paper, section 2.1, and the vectors that are their columns: braid and material frame of the rod (the
first strand), braid and material frame of the cylinder (the second)."""

AXES = ("i", "j", "k")
"""Components of the vectors: i points up across the cylinder (against the lateral weight), k along its axis."""


def frames(xi1: FloatArray, eta: FloatArray, xi2: FloatArray) -> dict[str, FloatArray]:
    """Return R₁₁, R₀₁, R₁₂ and R₂₂, each (m, 3, 3): component along i, j, k first, then the vector.

    From the cylinder outwards: R₂₂ = {k, i, j} is fixed, R₁₂ = R₂₂ R₁(ξ₂)ᵀ, R₁₁ = R₁₂ R₂(η)ᵀ, R₀₁ = R₁₁ R₁(ξ₁)ᵀ, (1).
    """
    fixed = np.broadcast_to(np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]), (xi1.size, 3, 3))
    r12 = fixed @ _about_first(-xi2)
    r11 = r12 @ _about_second(-eta)
    return {"R11": r11, "R01": r11 @ _about_first(-xi1), "R12": r12, "R22": fixed.copy()}


def _about_first(angle: FloatArray) -> FloatArray:
    """R₁(angle), (m, 3, 3)."""
    cos, sin, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.array([[one, zero, zero], [zero, cos, -sin], [zero, sin, cos]]).transpose(2, 0, 1)


def _about_second(angle: FloatArray) -> FloatArray:
    """R₂(angle), (m, 3, 3)."""
    cos, sin, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    return np.array([[cos, zero, sin], [zero, one, zero], [-sin, zero, cos]]).transpose(2, 0, 1)


def material_curvatures(
    xi1: FloatArray, omega2: FloatArray, omega3: FloatArray, twist: float, torsional_stiffness: float | FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """ω̃₁ = −T₁/C, (3), (32), and ω̃₂, ω̃₃, (4), (5): rotation of the material frame along the rod."""
    cos, sin = np.cos(xi1), np.sin(xi1)
    twisting = np.full_like(xi1, -twist / torsional_stiffness)
    return twisting, omega2 * cos - omega3 * sin, omega2 * sin + omega3 * cos
