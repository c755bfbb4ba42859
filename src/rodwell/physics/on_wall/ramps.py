"""A wall whose clearance varies along it: how the straight-lying rod is pressed to it, and what that does to buckling.

The rod lies on the generator θ = 0 at the distance Δ(s) from the axis of the hole, and v = Δθ is its displacement
around it. To the second order in v the cross-section moves inwards by v²/(2Δ), against the contact force per length

    P = wₗ q + (N Δ′)′ − (b Δ″)″,   N = F + wₐ h,   h′ = q,

of the rod that lies there, so that the second variation of the energy is

    ∫ b v″² + N v′² + (P/Δ) v² ds = K + F G,   G = ∫ v′² + (Δ″/Δ) v² ds = ∫ (v′ − (Δ′/Δ) v)² ds + [(Δ′/Δ) v²].

Terms of the order of Δ′² of these are left out: the slope of the wall is taken as small. Where v or Δ′ vanishes at both
ends, G is positive definite. Where bΔ″ jumps the wall must exert a couple, where (bΔ″)′ does a force at one place.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rodwell.quantities.arrays import FloatArray


def contact_parts(
    lateral: float,
    axial: float,
    stiffness: Sequence[FloatArray],
    clearance: Sequence[FloatArray],
    weight: FloatArray,
    lever: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """P at F = 0, and by F, at places (m,): the force per length towards the axis of the hole.

    Parameters
    ----------
    lateral, axial
        wₗ, negative for a rod on top, and wₐ.
    stiffness, clearance
        b and two derivatives by s, Δ and four, (m,) each.
    weight, lever
        q and h, (m,).
    """
    b, b1, b2 = stiffness
    _, d1, d2, d3, d4 = clearance
    of_stiffness = b * d4 + 2.0 * b1 * d3 + b2 * d2
    return lateral * weight + axial * (weight * d1 + lever * d2) - of_stiffness, d2


def variation_factors(
    contact: tuple[FloatArray, FloatArray], stiffness: FloatArray, axial: FloatArray, clearance: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Factors (3, m) of v², v′², v″² in K and in G, from :func:`contact_parts`, b, N at F = 0 and Δ, (m,) each."""
    one, none = np.ones_like(stiffness), np.zeros_like(stiffness)
    return np.array([contact[0] / clearance, axial, stiffness]), np.array([contact[1] / clearance, one, none])
