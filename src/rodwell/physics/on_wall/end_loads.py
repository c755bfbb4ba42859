"""What acts on the rod at s = 1 besides the end force and the end torque. Units B = L = 1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rodwell.physics.on_wall.parameters import CLEARANCE, TWIST

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class EndForce:
    """What acts on the rod at s = 1 besides F and T₁, and where that is.

    ``shear`` is the circumferential force, F₃(1) = ω₂'(1) at a clamped end, (B12); ``moment`` the bending moment b ω₂
    there, (B13)–(B14); ``angle`` and ``slope`` are y(1)/Δ and sin η(1), both zero at a clamped end of a rod that does
    not wind; ``stiffness`` is b, ``stiffness_rate`` b′.
    """

    shear: float
    moment: float
    angle: float = 0.0
    slope: float = 0.0
    stiffness: float = 1.0
    stiffness_rate: float = 0.0

    @property
    def across(self) -> tuple[float, float]:
        """Components of the circumferential force F₃(1) u₂(1) along i and j: along j where the end is at ξ₂ = 0."""
        return self.shear * float(np.sin(self.angle)), self.shear * float(np.cos(self.angle))


def end_force(
    moment: float,
    reaction: float,
    y: float,
    y1: float,
    parameters: FloatArray,
    stiffness: tuple[float, float] = (1.0, 0.0),
) -> EndForce:
    """Shear and bending moment at the end s = 1 from the natural boundary terms of the energy.

    ``moment`` is ∂e/∂y″ = b y″/cos²η, so b ω₂(1) = −moment cos η; ``reaction`` is ∂e/∂y′ − (∂e/∂y″)′, which at a
    clamped end is −y‴(1) = ω₂′(1). At an end that holds y but can turn, the end torque −T₁ t₁ has a part T₁ (cos η −
    1)/Δ in it. They come from virtual work, which knows them far better than the derivatives of a spline at its end.
    ``stiffness`` is b and b′ there.
    """
    clearance, twist = float(parameters[CLEARANCE]), float(parameters[TWIST])
    cos_eta = float(np.sqrt(1.0 - y1 * y1))
    return EndForce(reaction - twist * (cos_eta - 1.0) / clearance, -moment * cos_eta, y / clearance, y1, *stiffness)
