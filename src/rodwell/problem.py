"""The dimensionless problem: what the mathematics needs, and nothing else."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from rodwell.errors import InputError, checked_number, checked_whole

LARGEST_WEIGHT = 1e9
LARGEST_TWIST = 1e4
LARGEST_TURNS = 1000
SMALLEST_CLEARANCE = 1e-7


@dataclass(frozen=True)
class Problem:
    """A heavy rod, clamped at both ends, on a cylinder of any inclination.

    Units: bending stiffness B = 1 and rod length L = 1. Forces are in B/L², moments in B/L, lengths in L.
    Tension is positive.

    Parameters
    ----------
    weight
        γ = mg L³/B ≥ 0, weight of the whole rod (paper, section 4).
    alpha
        Angle α between the cylinder and the vertical in degrees, 0 (vertical) to 90 (horizontal).
    clearance
        Δ/L, distance between the axes of rod and cylinder, 0 < Δ < 1.
    poisson
        Poisson's ratio ν, which sets the torsional stiffness C/B = 1/(1 + ν); −1 < ν ≤ 0.5.
    twist
        Dead end twisting moment T₁ in B/L.
    turns
        Whole turns n of the end s = 1 around the cylinder: ξ₂(1) = ξ₂(0) + 2πn. 0 in the paper.
    on_top
        The rod lies on top of the cylinder's inner wall, ξ₂(0) = π (paper, section 4.3), not at the bottom.

    Notes
    -----
    Both ends are clamped: y and y' are held, which are (B2), (B4), (B7), (B8) of the paper. The end force
    acts at s = 1, the upper end of an inclined cylinder; the axial resultant is N(s) = F + γ cos α (s − 1).

    Raises
    ------
    InputError
        For values outside the ranges above, NaN and infinities included.
    """

    weight: float
    alpha: float = 90.0
    clearance: float = 0.01
    poisson: float = 0.3
    twist: float = 0.0
    turns: int = 0
    on_top: bool = False

    def __post_init__(self) -> None:
        limits = (
            ("weight", 0.0, LARGEST_WEIGHT, f"from 0 to {LARGEST_WEIGHT:g}, γ = mg L³/B"),
            ("alpha", 0.0, 90.0, "from 0 (vertical) to 90 (horizontal), in degrees"),
            ("clearance", 0.0, 1.0, "above 0 and below 1: Δ/L, a part of the length"),
            ("poisson", -1.0, 0.5, "above -1 and at most 0.5"),
            ("twist", -LARGEST_TWIST, LARGEST_TWIST, f"from -{LARGEST_TWIST:g} to {LARGEST_TWIST:g}, in B/L"),
        )
        for name, low, high, allowed in limits:
            object.__setattr__(self, name, checked_number(name, getattr(self, name), low, high, allowed))
        object.__setattr__(self, "turns", checked_whole("turns", self.turns, -LARGEST_TURNS, LARGEST_TURNS))
        if not isinstance(self.on_top, bool):
            raise InputError("on_top", self.on_top, "must be True or False")
        if not SMALLEST_CLEARANCE <= self.clearance < 1.0:
            allowed = f"must be above 0 and below 1: Δ/L, a part of the length (at least {SMALLEST_CLEARANCE:g})"
            raise InputError("clearance", self.clearance, allowed)
        if self.poisson == -1.0:
            raise InputError("poisson", self.poisson, "must be above -1 and at most 0.5")
        if abs(2.0 * math.pi * self.turns * self.clearance) >= 1.0:
            raise InputError(
                "turns", self.turns, f"a rod of this length cannot wind around so often at clearance {self.clearance:g}"
            )

    @property
    def axial_weight(self) -> float:
        """wₐ = γ cos α, exactly zero for a horizontal cylinder."""
        return self.weight * (0.0 if self.alpha == 90.0 else math.cos(math.radians(self.alpha)))

    @property
    def lateral_weight(self) -> float:
        """wₗ = γ sin α, exactly zero for a vertical cylinder; the sense of ξ₂ is in :attr:`foundation`."""
        return self.weight * math.sin(math.radians(self.alpha))

    @property
    def foundation(self) -> float:
        """wₗ with the sign of its effect: negative for a rod on top, where weight helps buckling."""
        return -self.lateral_weight if self.on_top else self.lateral_weight

    @property
    def torsional_stiffness(self) -> float:
        """C/B = 1/(1 + ν)."""
        return 1.0 / (1.0 + self.poisson)

    def but(self, **changes: Any) -> Problem:
        """Return this problem with some values changed."""
        return replace(self, **changes)
