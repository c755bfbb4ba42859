"""A section of a string: a uniform rod with its own constants.

Where bending stiffness b B and weight per length are constant, a rod is a uniform one. With N(s) = F + wₐ h(s) and
h(s) = d + q(s − 1) in a section of weight ratio q, it sees the end force F + wₐ d, the weights q wₐ and q wₗ; and,
since every other term of the energy is linear in these loads, its energy is b times that of a rod of stiffness 1 under
1/b of them. So nothing about the rod is stated a second time.

Between sections y and y′ are continuous, and so are, by the energy, the bending moment b ω₂ about d₁ and the
circumferential force ∂e/∂y′ − (∂e/∂y″)′. Across the wall no equation of y is left, and the reactions there follow: the
moment about u₁ is b ω₃ with ω₃ = sin²η/Δ continuous, so that at a step [b] of the stiffness the wall must exert

    the couple −[b] ω₃ about u₁, two opposite radial forces close together, and the force T₁ [ω₂] along d₁.

([x] is x on the side of s = 1 less x on that of s = 0.) The pair of forces is turned with the rod, which leaves of it
[b] ω₃ sin η/Δ along u₂.

The couple needs an end of the wall's contact that pulls: a string that is not held radially at the step leaves the wall
there, over a short stretch, as soon as it is buckled with a slope at the step (:func:`step_loads`).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, LATERAL_WEIGHT, RAMP, SIDE, TWIST
from rodwell.quantities.arrays import FloatArray

GIVEN = ("stiffness", "weight", "offset")
"""Of a section: b = B(s)/B, q = w(s)/w, and d in h(s) = d + q(s − 1), in L."""


def of_section(given: Any, parameters: Any, share: Any = 1.0) -> list[Any]:
    """Parameters of the uniform rod that a section is, in their order; loads times ``share``."""
    _, weight, offset = given
    out: list[Any] = [0.0] * (RAMP + 1)
    out[FORCE] = share * (parameters[FORCE] + offset * parameters[AXIAL_WEIGHT])
    out[AXIAL_WEIGHT] = share * (weight * parameters[AXIAL_WEIGHT])
    out[LATERAL_WEIGHT] = share * (weight * parameters[LATERAL_WEIGHT])
    out[TWIST] = share * parameters[TWIST]
    out[CLEARANCE], out[SIDE] = parameters[CLEARANCE], parameters[SIDE]
    return out


def section_density(s: Any, y: Any, y1: Any, y2: Any, given: Any, parameters: Any, rates: Any) -> Any:
    """Energy density in a section, and its derivatives: see :func:`rodwell.physics.on_wall._density.rod_density`."""
    stiffness = given[0]
    softness = 1.0 / stiffness
    own, along = of_section(given, parameters, softness), of_section(given, rates, softness)
    return times(stiffness, rod_density(s, y, y1, y2, own, along))


def times(stiffness: Any, density: Any) -> Any:
    """An energy density and its derivatives, each so many times."""
    energy, rate, gradient, mixed, hessian = density

    def row_times(row: Any) -> Any:
        return tuple(stiffness * x for x in row)

    return (
        stiffness * energy, stiffness * rate, row_times(gradient), row_times(mixed),
        tuple(row_times(row) for row in hessian),
    )  # fmt: skip


def step_loads(
    slope: FloatArray, moment: FloatArray, stiffness: FloatArray, parameters: FloatArray, rates: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Couple about u₁ and force along d₁ (towards the axis), (k,) each, of the wall on the rod at k steps of b.

    ``slope`` y′ and ``moment`` b ω₂ are (k,), ``stiffness`` b and its ``rates`` b′ (2, k) on the sides towards s = 0
    and s = 1. From the balance of moments, M₃ = b ω₃ and F₂ = −ω₂(3b ω₁ + T₁) − b′ω₃, and of forces.
    """
    below, above = stiffness
    curvature = slope**2 / parameters[CLEARANCE]
    force = parameters[TWIST] * moment * (1.0 / above - 1.0 / below) + (rates[1] - rates[0]) * curvature
    return (below - above) * curvature, np.asarray(force)


def step_jumps(y: FloatArray, slope: FloatArray, loads: tuple[FloatArray, FloatArray], clearance: float) -> FloatArray:
    """Jumps (2, k) of the rod's force along i and j at k steps of b, towards s = 1, where y and y′ are (k,).

    ``loads`` are those of :func:`step_loads`: the force along d₁, and the couple c
    about u₁, which leaves the force c d₁′ = c (ω₁ u₁ − ω₃ t₁) = −c sin η/Δ u₂.
    """
    couple, radial = loads
    sin_a, cos_a, around = np.sin(y / clearance), np.cos(y / clearance), -couple * slope / clearance
    return np.array([-(radial * cos_a + around * sin_a), -(-radial * sin_a + around * cos_a)])
