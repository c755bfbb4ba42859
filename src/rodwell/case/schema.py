"""What a case file may hold. Each value is checked on its own here; how they fit together, in ``case``."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from rodwell.errors import InputError
from rodwell.problem.ends import checked_ends
from rodwell.quantities.units import SYSTEMS, to_si


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
PositiveForce = Annotated[float, _quantity("force", above=0.0)]
PositiveMoment = Annotated[float, _quantity("moment", above=0.0)]
Stress = Annotated[float, _quantity("stress", above=0.0)]
Density = Annotated[float, _quantity("density", above=0.0)]
ForcePerLength = Annotated[float, _quantity("force per length", least=0.0)]
Stiffness = Annotated[float, _quantity("bending stiffness", above=0.0)]
Acceleration = Annotated[float, _quantity("acceleration", least=0.0)]
Pressure = Annotated[float, _quantity("pressure", least=0.0)]
FluidDensity = Annotated[float, _quantity("density", least=0.0)]
Number = Annotated[float, BeforeValidator(_plain)]


def _ends(text: object) -> str:
    try:
        return "-".join(checked_ends(text))
    except InputError as error:
        raise ValueError(error.reason) from None


Ends = Annotated[str, BeforeValidator(_ends)]


def _one_of(*allowed: str) -> BeforeValidator:
    """Validator of text that must be one of a few words."""

    def check(text: object) -> object:
        if text not in allowed:
            raise ValueError("must be " + " or ".join(f'"{word}"' for word in allowed))
        return text

    return BeforeValidator(check)


def _yes_or_no(value: object) -> object:
    if not isinstance(value, bool):
        raise ValueError("must be true or false, without quotes")
    return value


YesOrNo = Annotated[bool, BeforeValidator(_yes_or_no)]
Name = Annotated[str, Field(min_length=1, max_length=80)]
End = Annotated[Literal["top", "bottom"], _one_of("top", "bottom")]
ForceKind = Annotated[Literal["effective", "real"], _one_of("effective", "real")]
Units = Annotated[Literal["si", "field", "mm"], _one_of(*SYSTEMS)]

MOST_MODES = 12
"""Branches that one case may ask for."""

MOST_LOADS = 12
"""Loads that one case may apply."""


def _several(value: object) -> object:
    """One value as a list of one."""
    if not isinstance(value, list | tuple):
        return [value]
    if not 1 <= len(value) <= MOST_LOADS:
        raise ValueError(f"must hold from 1 to {MOST_LOADS} forces")
    return value


Forces = Annotated[tuple[Force, ...], BeforeValidator(_several)]
Numbers = Annotated[tuple[Number, ...], BeforeValidator(_several)]


class SectionInput(BaseModel):
    """Base of all sections: unknown keys are refused, values are not changed after reading."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class RodInput(SectionInput):
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
    pipe: Name | None = None
    material: Name | None = None
    grade: Name | None = None
    yield_strength: Stress | None = None


class Hole(SectionInput):
    """[hole]: the borehole, vessel or pipe around it."""

    diameter: Length | None = None
    clearance: Length | None = None
    angle_from_vertical: Angle | None = None
    angle_from_horizontal: Angle | None = None
    gravity: Acceleration = 9.80665


class CylinderInput(SectionInput):
    """[cylinder]: section and strength of the pipe around it, for the check of its capacity."""

    outer_diameter: Length
    inner_diameter: Length | None = None
    yield_strength: Stress


class Supports(SectionInput):
    """[supports]: what each support of the rod's ends and of the cylinder's ends can bear, for the check against it."""

    force: PositiveForce | None = None
    moment: PositiveMoment | None = None
    torque: PositiveMoment | None = None

    @model_validator(mode="after")
    def _something(self) -> Supports:
        if self.force is None and self.moment is None and self.torque is None:
            raise ValueError("is empty: give force, moment or torque, or leave the section out")
        return self


class Mud(SectionInput):
    """[mud]: the fluids in and around the rod, whose weight and lift make its weight the buoyed one."""

    density: FluidDensity | None = None
    inside: FluidDensity | None = None
    outside: FluidDensity | None = None


class PressureAtEnd(SectionInput):
    """[pressure]: fluid pressures at the end s = 1, which make the force in the pipe wall the effective one."""

    inside: Pressure = 0.0
    outside: Pressure = 0.0


class CatalogueFiles(SectionInput):
    """[catalogue]: the user's own pipes, materials and grades."""

    files: list[str]


class Dimensionless(SectionInput):
    """[dimensionless]: instead of [rod] and [hole]."""

    weight: Number
    alpha: Number = 90.0
    clearance: Number = 0.01
    poisson: Number = 0.3
    ends: Ends = "clamped-clamped"


class LoadInput(SectionInput):
    """[load]: what is applied at the ends (in physical units)."""

    until: Force | None = None
    applied: Forces | None = None
    twist: Moment = 0.0
    at: End | None = None
    kind: ForceKind | None = None


class DimensionlessLoad(SectionInput):
    """[load] beside [dimensionless]."""

    until: Number | None = None
    applied: Numbers | None = None
    twist: Number = 0.0
    at: End | None = None


class Analysis(SectionInput):
    """[analysis]: what is computed, and how exactly."""

    modes: int = Field(default=4, strict=True, ge=1, le=MOST_MODES)
    rtol: Number = 1e-8


class CaseFile(SectionInput):
    """The whole file."""

    title: str = "Untitled case"
    rod: RodInput | None = None
    hole: Hole | None = None
    cylinder: CylinderInput | None = None
    supports: Supports | None = None
    dimensionless: Dimensionless | None = None
    load: dict[str, Any] = Field(default_factory=dict)
    analysis: Analysis = Analysis()
    mud: Mud | None = None
    pressure: PressureAtEnd | None = None
    catalogue: CatalogueFiles | None = None
    units: Units | None = None
    plausible: YesOrNo = True


class Entry(SectionInput):
    """An entry of a catalogue."""

    name: Name
    source: str = Field(min_length=1)
    note: str = ""


class Pipe(Entry):
    """[[pipe]]: diameters (inner, or wall; solid without, unless hollow), and what else is known of it."""

    kind: str = "pipe"
    hollow: bool = False
    outer_diameter: Length
    inner_diameter: Length | None = None
    wall: Length | None = None
    weight_per_length: ForcePerLength | None = None
    plain_end_weight: ForcePerLength | None = None
    bending_stiffness: Stiffness | None = None
    material: str | None = None

    @model_validator(mode="after")
    def _bore(self) -> Pipe:
        if self.wall is not None and self.inner_diameter is not None:
            raise ValueError("has both inner_diameter and wall: give only one of the two")
        if self.bore is not None and not 0.0 < self.bore < self.outer_diameter:
            raise ValueError("must have a bore below its outer diameter: check inner_diameter or wall")
        return self

    @property
    def bore(self) -> float | None:
        """Inner diameter in m; None where the catalogue has none."""
        return self.inner_diameter if self.wall is None else self.outer_diameter - 2.0 * self.wall


class Material(Entry):
    """[[material]]: what follows from a material's name."""

    youngs_modulus: Stress
    density: Density
    poisson: Number = 0.3
    aliases: tuple[str, ...] = ()


class Grade(Entry):
    """[[grade]]: strength, and the material that has it."""

    yield_strength: Stress
    material: str | None = None
