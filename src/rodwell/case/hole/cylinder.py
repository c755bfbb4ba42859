"""The cylinder of a case: section and strength."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rodwell.case.hole.schema import CylinderInput, Hole
from rodwell.errors import InputError


@dataclass(frozen=True)
class Cylinder:
    """Section and strength of the cylinder: diameters in m, yield strength in Pa."""

    outer_diameter: float
    inner_diameter: float
    yield_strength: float

    @property
    def inertia(self) -> float:
        """Second moment of area in m⁴."""
        return math.pi / 64.0 * (self.outer_diameter**4 - self.inner_diameter**4)


def cylinder_of(given: CylinderInput, hole: Hole) -> Cylinder:
    """Return the cylinder of a case.

    Raises
    ------
    InputError
        If diameters contradict each other or are missing.
    """
    inner = given.inner_diameter
    if hole.diameter is not None:
        if inner is not None and not math.isclose(inner, hole.diameter, rel_tol=1e-9):
            raise InputError(
                "cylinder.inner_diameter", inner, f"contradicts hole.diameter of {hole.diameter:g} m: leave it out"
            )
        inner = hole.diameter
    if inner is None:
        raise InputError("cylinder.inner_diameter", None, "is missing: give it, or hole.diameter")
    if given.outer_diameter <= inner:
        raise InputError(
            "cylinder.outer_diameter", given.outer_diameter, f"must be above the inner diameter of {inner:g} m"
        )
    return Cylinder(given.outer_diameter, inner, given.yield_strength)
