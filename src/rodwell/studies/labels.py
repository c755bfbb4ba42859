"""Names of the inputs of a study for people: on axes, in tables and in sentences."""

from __future__ import annotations

LABELS = {
    "rod.length": "length of the rod",
    "rod.outer_diameter": "outer diameter of the rod",
    "rod.inner_diameter": "bore of the rod",
    "rod.youngs_modulus": "Young's modulus",
    "rod.bending_stiffness": "bending stiffness",
    "rod.torsional_stiffness": "torsional stiffness",
    "rod.density": "density of the rod",
    "rod.weight_per_length": "weight per length",
    "rod.poisson": "Poisson's ratio",
    "rod.ends": "ends",
    "rod.pipe": "pipe",
    "rod.material": "material",
    "rod.grade": "grade",
    "rod.yield_strength": "yield strength",
    "hole.friction": "friction factor",
    "well.block_weight": "weight of the block",
    "well.push": "push at surface",
    "hole.diameter": "diameter of the hole",
    "hole.clearance": "clearance",
    "hole.angle_from_vertical": "inclination from the vertical",
    "hole.angle_from_horizontal": "inclination from the horizontal",
    "hole.build": "build of the hole",
    "hole.walk": "walk of the hole",
    "hole.from": "measured depth of s = 1",
    "hole.to": "measured depth of s = 0",
    "hole.tortuosity": "tortuosity of the hole",
    "hole.gravity": "gravity",
    "mud.density": "density of the mud",
    "mud.inside": "density of the fluid inside",
    "mud.outside": "density of the fluid outside",
    "pressure.inside": "pressure inside",
    "pressure.outside": "pressure outside",
    "load.twist": "twisting moment",
    "load.applied": "load (tension positive)",
    "dimensionless.weight": "weight γ",
    "dimensionless.alpha": "inclination α",
    "dimensionless.clearance": "clearance Δ/L",
    "dimensionless.poisson": "Poisson's ratio",
    "dimensionless.torsion": "torsional stiffness C/B",
    "dimensionless.ends": "ends",
    "dimensionless.build": "build of the hole",
    "dimensionless.walk": "walk of the hole",
}
"""By key of the case file; a key that is not here is told by itself."""

UNITS = {"deg": "°", "degrees": "°", "degree": "°"}
"""Units as they are read, where people do not read them as they are written."""


def label(name: str) -> str:
    """What an input is called, from section and key."""
    return LABELS.get(name, name.partition(".")[2].replace("_", " ") or name)


def shown_unit(unit: str) -> str:
    """A unit as it is read: "°" for "deg", "N·m" for "N m"."""
    return UNITS.get(unit, unit.replace("*", "·").replace("N m", "N·m").replace("^2", "²").replace("^3", "³"))
