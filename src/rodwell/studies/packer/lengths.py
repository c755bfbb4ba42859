"""How much longer or shorter tubing is in one state than free of load: piston, buckling, ballooning, temperature.

After A. Lubinski, W. S. Althouse and J. L. Logan, Helical Buckling of Tubing Sealed in Packers, *J. Petroleum
Technology* 14 (1962) 655, with the exact helix in place of their small slopes, and in inclined holes with the exact
states of a rod on the wall. The tubing slides in the seals of the packer; lengths are in one system of units with
forces, pressures and stiffness. No friction, no flow.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rodwell.analysis.endless.shortening import string_shortening
from rodwell.quantities.value import Value

KINDS = ("piston", "buckling", "ballooning", "temperature")
"""What changes the length."""


@dataclass(frozen=True)
class Tubing:
    """A string of one section from the packer to the surface.

    Attributes
    ----------
    length, angle
        L along the hole, and its inclination from the vertical in degrees.
    modulus, poisson, expansion
        Young's modulus, Poisson's ratio, coefficient of thermal expansion.
    inertia, area, inner_area, outer_area
        Second moment of area; areas of the section, of the bore and of the outer circle.
    clearance
        Distance of the axes of tubing and casing where the tubing lies at the wall.
    seal_area
        Area of the packer's bore, in which the seals slide.
    ratio
        Outer over inner diameter; None: from the areas. Only ballooning takes it.
    """

    length: float
    angle: float
    modulus: float
    poisson: float
    expansion: float
    inertia: float
    area: float
    inner_area: float
    outer_area: float
    clearance: float
    seal_area: float
    ratio: float | None = None

    @property
    def stiffness(self) -> float:
        """Bending stiffness B = EI."""
        return self.modulus * self.inertia

    @property
    def height(self) -> float:
        """Height of the upper end above the packer."""
        return self.length * _cosine(self.angle)


@dataclass(frozen=True)
class Conditions:
    """Fluids and temperature.

    Attributes
    ----------
    weight
        Effective weight per length: in air, and that of the fluid inside less that of the fluid displaced outside.
    inside, outside
        Pressures at the upper end.
    inside_gradient, outside_gradient
        By how much they grow per height.
    temperature
        Mean temperature of the tubing, from any zero.
    """

    weight: float
    inside: float
    outside: float
    inside_gradient: float
    outside_gradient: float
    temperature: float = 0.0

    def at(self, depth: float) -> tuple[float, float]:
        """Pressures inside and outside at a depth below the upper end."""
        return self.inside + self.inside_gradient * depth, self.outside + self.outside_gradient * depth


def end_compression(tubing: Tubing, state: Conditions, packer: float) -> float:
    """Real compression in the wall just above the packer, which pushes up with the force ``packer``."""
    inside, outside = state.at(tubing.height)
    return (
        packer
        + (tubing.seal_area - tubing.inner_area) * inside
        - (tubing.seal_area - tubing.outer_area) * outside
    )  # fmt: skip


def effective_compression(tubing: Tubing, state: Conditions, packer: float) -> float:
    """Effective compression there, which buckles: P_real + pᵢ Aᵢ − pₒ Aₒ = packer + A_p (pᵢ − pₒ)."""
    inside, outside = state.at(tubing.height)
    return packer + tubing.seal_area * (inside - outside)


def buckling(tubing: Tubing, state: Conditions, packer: float, rule: str) -> Value:
    """Elongation by buckling, at most 0."""
    axial, lateral = weights(tubing, state)
    compression = effective_compression(tubing, state, packer)
    shorter = string_shortening(
        compression, axial, lateral, tubing.length, tubing.stiffness, tubing.clearance, rule
    )  # fmt: skip
    return shorter.times(-1.0)


def weights(tubing: Tubing, state: Conditions) -> tuple[float, float]:
    """Effective weight per length along the hole and across it."""
    return state.weight * _cosine(tubing.angle), state.weight * _sine(tubing.angle)


def elongations(tubing: Tubing, state: Conditions, packer: float, rule: str) -> dict[str, Value]:
    """How much longer the tubing is than free of load and pressure, by kind, with the packer's force on its end.

    Its own weight in air, which stretches it in every state alike, is left out.
    """
    ratio = math.sqrt(tubing.outer_area / tubing.inner_area) if tubing.ratio is None else tubing.ratio
    inside, outside = (0.5 * (top + bottom) for top, bottom in zip(state.at(0.0), state.at(tubing.height), strict=True))
    swell = (inside - ratio**2 * outside) / (ratio**2 - 1.0)
    return {
        "piston": Value(-tubing.length * end_compression(tubing, state, packer) / (tubing.modulus * tubing.area)),
        "buckling": buckling(tubing, state, packer, rule),
        "ballooning": Value(-2.0 * tubing.poisson / tubing.modulus * swell * tubing.length),
        "temperature": Value(tubing.expansion * state.temperature * tubing.length),
    }


def total(parts: dict[str, Value]) -> Value:
    """Sum of elongations, errors added."""
    return Value(sum(part.value for part in parts.values()), sum(part.error for part in parts.values()))


def _cosine(degrees: float) -> float:
    """Cosine of an angle, 0 at 90° exactly."""
    return 0.0 if degrees == 90.0 else math.cos(math.radians(degrees))


def _sine(degrees: float) -> float:
    return math.sin(math.radians(degrees))
