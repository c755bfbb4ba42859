"""What a case file may hold. Each value is checked on its own here; how they fit together, in ``case``."""

from __future__ import annotations

import math
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from rodwell.errors import InputError
from rodwell.practice.units import to_si
from rodwell.problem import checked_ends


def _quantity(kind: str, above: float = -math.inf, least: float = -math.inf) -> BeforeValidator:
    """Validator from text to an SI number, which must be above ``above`` and at least ``least``."""

    def parse(text: object) -> float:
        value = to_si(text, kind)
        if not value > above:
            raise ValueError("must be above 0")
        if not value >= least:
            raise ValueError("must not be negative")
        return value

    return BeforeValidator(parse)


def _plain(text: object) -> object:
    if isinstance(text, str):
        raise ValueError("must be a plain number, without quotes or unit")
    if isinstance(text, bool):
        raise ValueError("must be a number")
    return text


Length = Annotated[float, _quantity("length", above=0.0)]
InnerLength = Annotated[float, _quantity("length", least=0.0)]
Angle = Annotated[float, _quantity("angle")]
Force = Annotated[float, _quantity("force")]
Moment = Annotated[float, _quantity("moment")]
Stress = Annotated[float, _quantity("stress", above=0.0)]
Density = Annotated[float, _quantity("density", above=0.0)]
ForcePerLength = Annotated[float, _quantity("force per length", least=0.0)]
Stiffness = Annotated[float, _quantity("bending stiffness", above=0.0)]
Acceleration = Annotated[float, _quantity("acceleration", least=0.0)]
Number = Annotated[float, BeforeValidator(_plain)]


def _ends(text: object) -> str:
    try:
        return "-".join(checked_ends(text))
    except InputError as problem:
        raise ValueError(problem.problem) from None


Ends = Annotated[str, BeforeValidator(_ends)]

MOST_MODES = 12
"""Branches that one case may ask for."""


class Section(BaseModel):
    """Base of all sections: unknown keys are refused, values are not changed after reading."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Rod(Section):
    """[rod]: the pipe, rod or wire."""

    length: Length
    outer_diameter: Length | None = None
    inner_diameter: InnerLength | None = None
    youngs_modulus: Stress | None = None
    bending_stiffness: Stiffness | None = None
    density: Density | None = None
    weight_per_length: ForcePerLength | None = None
    poisson: Number = 0.3
    ends: Ends = "clamped-clamped"


class Hole(Section):
    """[hole]: the borehole, vessel or pipe around it."""

    diameter: Length | None = None
    clearance: Length | None = None
    angle_from_vertical: Angle | None = None
    angle_from_horizontal: Angle | None = None
    gravity: Acceleration = 9.80665


class Cylinder(Section):
    """[cylinder]: section and strength of the pipe around it, for the check of its capacity."""

    outer_diameter: Length
    inner_diameter: Length | None = None
    yield_strength: Stress


class Dimensionless(Section):
    """[dimensionless]: instead of [rod] and [hole]."""

    weight: Number
    alpha: Number = 90.0
    clearance: Number = 0.01
    poisson: Number = 0.3
    ends: Ends = "clamped-clamped"


class Load(Section):
    """[load]: what is applied at the end s = 1 (in physical units)."""

    until: Force | None = None
    twist: Moment = 0.0


class DimensionlessLoad(Section):
    """[load] beside [dimensionless]."""

    until: Number | None = None
    twist: Number = 0.0


class Analysis(Section):
    """[analysis]: what is computed, and how exactly."""

    modes: int = Field(default=4, strict=True, ge=1, le=MOST_MODES)
    rtol: Number = 1e-8


class CaseFile(Section):
    """The whole file."""

    title: str = "Untitled case"
    rod: Rod | None = None
    hole: Hole | None = None
    cylinder: Cylinder | None = None
    dimensionless: Dimensionless | None = None
    load: dict[str, Any] = Field(default_factory=dict)
    analysis: Analysis = Analysis()
