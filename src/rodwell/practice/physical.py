"""From the rod and hole of a case file to the dimensionless problem."""

from __future__ import annotations

import math

from rodwell.errors import InputError
from rodwell.practice import schema
from rodwell.practice.scales import Scales
from rodwell.problem import Problem, checked_ends


def physical_problem(rod: schema.Rod | None, hole: schema.Hole | None, twist: float) -> tuple[Problem, Scales]:
    """Return the dimensionless problem and its scales; ``twist`` in N m.

    Raises
    ------
    InputError
        Naming the key of the case file that is missing, contradicts another, or does not fit the others.
    """
    if rod is None:
        raise InputError("rod", None, "is missing: a case with [hole] needs [rod]")
    if hole is None:
        raise InputError("hole", None, "is missing: a case with [rod] needs [hole]")
    stiffness = _stiffness(rod)
    weight = _weight_per_length(rod, hole.gravity)
    clearance = _clearance(rod, hole)
    if clearance >= rod.length:
        raise InputError(
            "hole.clearance" if hole.clearance else "hole.diameter",
            hole.clearance or hole.diameter,
            f"leaves a clearance of {clearance:g} m, which must be below the rod's length of {rod.length:g} m",
        )
    radius = None if rod.outer_diameter is None else 0.5 * rod.outer_diameter
    scales = Scales(rod.length, stiffness, radius)
    try:
        problem = Problem(
            weight=weight / scales.factor("force_per_length"),
            alpha=_angle(hole),
            clearance=clearance / rod.length,
            poisson=rod.poisson,
            twist=twist / scales.factor("moment"),
            ends=checked_ends(rod.ends),
        )
    except InputError as found:
        names = {
            "weight": "rod.length",
            "poisson": "rod.poisson",
            "twist": "load.twist",
            "ends": "rod.ends",
            "clearance": "hole.diameter",
        }
        name = names.get(found.field, found.field)
        what = found.problem
        if found.field == "weight":
            what = (
                f"makes γ = mg L³/B = {weight / scales.factor('force_per_length'):g}, which {what}: check the units of "
            )
            what += "length, weight or density, stiffness or diameters, and gravity"
        raise InputError(name, None if found.field == "weight" else found.value, what) from None
    return problem, scales


def _area_and_inertia(rod: schema.Rod, reason: str) -> tuple[float, float]:
    if rod.outer_diameter is None:
        raise InputError("rod.outer_diameter", None, f"is missing: it is needed {reason}")
    outer, inner = rod.outer_diameter, rod.inner_diameter or 0.0
    if inner >= outer:
        raise InputError("rod.inner_diameter", inner, f"must be below the outer diameter of {outer:g} m")
    return math.pi / 4.0 * (outer**2 - inner**2), math.pi / 64.0 * (outer**4 - inner**4)


def _stiffness(rod: schema.Rod) -> float:
    if rod.bending_stiffness is not None:
        if rod.youngs_modulus is not None:
            raise InputError("rod.bending_stiffness", None, "contradicts rod.youngs_modulus: give only one of the two")
        return rod.bending_stiffness
    if rod.youngs_modulus is None:
        raise InputError("rod.youngs_modulus", None, "is missing: give it, or rod.bending_stiffness")
    return rod.youngs_modulus * _area_and_inertia(rod, "with rod.youngs_modulus")[1]


def _weight_per_length(rod: schema.Rod, gravity: float) -> float:
    if rod.weight_per_length is not None:
        if rod.density is not None:
            raise InputError("rod.weight_per_length", None, "contradicts rod.density: give only one of the two")
        return rod.weight_per_length
    if rod.density is None:
        raise InputError("rod.density", None, "is missing: give it, or rod.weight_per_length (may be 0 N/m)")
    return rod.density * _area_and_inertia(rod, "with rod.density")[0] * gravity


def _clearance(rod: schema.Rod, hole: schema.Hole) -> float:
    if hole.clearance is not None:
        if hole.diameter is not None:
            raise InputError("hole.clearance", None, "contradicts hole.diameter: give only one of the two")
        return hole.clearance
    if hole.diameter is None:
        raise InputError("hole.diameter", None, "is missing: give it, or hole.clearance (from axis to axis)")
    if rod.outer_diameter is None:
        raise InputError("rod.outer_diameter", None, "is missing: it is needed with hole.diameter")
    if rod.outer_diameter >= hole.diameter:
        raise InputError(
            "hole.diameter",
            hole.diameter,
            f"must be above the rod's outer diameter of {rod.outer_diameter:g} m: the rod does not fit",
        )
    return 0.5 * (hole.diameter - rod.outer_diameter)


def _angle(hole: schema.Hole) -> float:
    angles = {
        "angle_from_vertical": hole.angle_from_vertical,
        "angle_from_horizontal": hole.angle_from_horizontal,
    }
    given = [(name, value) for name, value in angles.items() if value is not None]
    if len(given) != 1:
        raise InputError(
            "hole.angle_from_vertical",
            None,
            "is missing: give it or hole.angle_from_horizontal"
            if not given
            else "contradicts hole.angle_from_horizontal: give only one of the two",
        )
    name, value = given[0]
    degrees = round(math.degrees(value), 12)  # "90 deg" makes its way through radians
    if not 0.0 <= degrees <= 90.0:
        raise InputError(f"hole.{name}", f"{degrees:g} deg", 'must be from "0 deg" to "90 deg"')
    return degrees if name == "angle_from_vertical" else 90.0 - degrees
