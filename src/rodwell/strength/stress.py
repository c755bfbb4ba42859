"""Stress in the wall of a pipe, or in a solid rod: axial force, bending, torsion and pressures, by von Mises.

The axial stress is that of the **real** force in the wall; hoop and radial stress are those of Lamé, so thick walls are
right too (API TR 5C3 combines them in the same way). Shear forces are neglected, and so is the pressing of the rod on
the wall where it lies.

Along a radius, and around the section, the square of the von Mises stress is

    σ_e² = (N/A ± M r/I)² + 3 ((pᵢ − pₒ) rᵢ² rₒ²/((rₒ² − rᵢ²) r²))² + 3 (T r/J)²

with the **effective** force N = N_real − pᵢ Aᵢ + pₒ Aₒ. Each term is convex in r, so the largest value is always at the
inner or the outer surface, in the plane of bending: four places are looked at, two for a solid rod.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rodwell.case.pipe import PhysicalRod
from rodwell.quantities.arrays import FloatArray

PLACES = ("outer surface, bending in tension", "outer surface, bending in compression",
          "inner surface, bending in tension", "inner surface, bending in compression")  # fmt: skip
"""The fibres looked at; a solid rod has the first two."""


@dataclass(frozen=True)
class Section:
    """A ring, or a disc with ``inner`` 0: outer and inner radius in m; where a rod tapers, those at places, (m,)."""

    outer: float | FloatArray
    inner: float | FloatArray = 0.0

    @property
    def area(self) -> float | FloatArray:
        """Area A in m²."""
        return math.pi * (self.outer**2 - self.inner**2)

    @property
    def inertia(self) -> float | FloatArray:
        """Second moment of area I in m⁴; that of torsion is J = 2 I."""
        return math.pi / 4.0 * (self.outer**4 - self.inner**4)

    @property
    def surfaces(self) -> tuple[float | FloatArray, ...]:
        """Radii of the surfaces in m, the outer one first."""
        return (self.outer, self.inner) if np.all(self.inner) else (self.outer,)

    def lame(
        self, inside: FloatArray, outside: FloatArray, radius: float | FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Radial and hoop stress in Pa at a radius in m, from the pressures in Pa inside and outside (Lamé)."""
        o, i = self.outer**2, self.inner**2
        mean = (inside * i - outside * o) / (o - i)
        swing = (inside - outside) * i * o / ((o - i) * radius**2) if np.all(i) else 0.0
        return mean - swing, mean + swing


def section_of(rod: PhysicalRod) -> Section | None:
    """The section of a rod; None where its outer diameter or its bore is not known."""
    if rod.outer_diameter is None or not rod.bore_known:
        return None
    return Section(0.5 * rod.bearing_diameter, 0.5 * rod.inner_diameter)


@dataclass(frozen=True)
class Loading:
    """What acts on sections along the rod, (m,) each or single numbers.

    Attributes
    ----------
    force
        Real axial force in the wall in N, tension positive.
    bending, torque
        Bending moment √(M₂² + M₃²) and twisting moment in N m.
    inside, outside
        Pressures in Pa.
    """

    force: FloatArray
    bending: FloatArray
    torque: FloatArray
    inside: FloatArray
    outside: FloatArray


@dataclass(frozen=True)
class Stresses:
    """Stresses along the rod in Pa, (m,) each, tension positive.

    Attributes
    ----------
    axial
        Of the real axial force, N_real/A.
    bending, torsion
        Largest bending stress M rₒ/I (either sign) and shear stress of torsion T rₒ/J, both at the outer surface.
    hoop_outer, hoop_inner
        Hoop stress at the two surfaces; for a solid rod the same.
    von_mises
        The largest over the section.
    fibre
        Number in ``PLACES`` of the fibre where that is.
    """

    axial: FloatArray
    bending: FloatArray
    torsion: FloatArray
    hoop_outer: FloatArray
    hoop_inner: FloatArray
    von_mises: FloatArray
    fibre: FloatArray


def von_mises(radial: FloatArray, hoop: FloatArray, axial: FloatArray, shear: FloatArray) -> FloatArray:
    """Equivalent stress of three normal stresses and one shear stress (between hoop and axial direction)."""
    squares = (axial - radial) ** 2 + (radial - hoop) ** 2 + (hoop - axial) ** 2
    return np.asarray(np.sqrt(0.5 * squares + 3.0 * shear**2))


def stresses(section: Section, load: Loading) -> Stresses:
    """Stresses of a section under given forces, moments and pressures."""
    axial = np.asarray(load.force / section.area)
    per_radius = load.bending / section.inertia
    candidates = []
    for radius in section.surfaces:
        radial, hoop = section.lame(load.inside, load.outside, radius)
        shear = load.torque * radius / (2.0 * section.inertia)
        candidates += [von_mises(radial, hoop, axial + sign * per_radius * radius, shear) for sign in (1.0, -1.0)]
    every = np.stack(np.broadcast_arrays(*candidates))
    hoops = [section.lame(load.inside, load.outside, radius)[1] for radius in section.surfaces]
    return Stresses(
        axial=axial,
        bending=np.asarray(per_radius * section.outer),
        torsion=np.asarray(load.torque * section.outer / (2.0 * section.inertia)),
        hoop_outer=np.asarray(hoops[0]),
        hoop_inner=np.asarray(hoops[-1]),
        von_mises=np.max(every, axis=0),
        fibre=np.argmax(every, axis=0),
    )
