"""What a case file may hold. Each value is checked on its own here; how they fit together, in ``case``.

Meaning, examples and what is allowed stand with each key: ``rodwell keys``, the table of keys in the documentation and
``rodwell init`` take them from here.
"""

from __future__ import annotations

from typing import Any

from pydantic import Field, StrictBool, model_validator

from rodwell.case.about import ReportInput
from rodwell.case.hole.schema import CylinderInput, Hole
from rodwell.case.kinds import (
    REQUIRED,
    Density,
    End,
    Ends,
    Expansion,
    FluidDensity,
    Force,
    ForceKind,
    ForcePerLength,
    Forces,
    InnerLength,
    Length,
    Moment,
    Motion,
    Name,
    Number,
    Numbers,
    PositiveForce,
    PositiveMoment,
    Pressure,
    SectionInput,
    SectionsLine,
    Stiffness,
    Stress,
    TemperatureChange,
    TorsionalStiffness,
    Units,
    _key,
)

MOST_MODES = 12
"""Branches that one case may ask for."""

POISSON, RTOL = "above -1 and at most 0.5", "from 1e-11 to 0.01"


class PipeInput(SectionInput):
    """What a pipe, rod or wire is, whole or a section of a string."""

    length: Length | None = _key(None, "length of the section", "30 m", "300 ft")
    outer_diameter: Length | None = _key(
        None, "needed with `youngs_modulus`, `density`, `material`, `hole.diameter` and fluids", "5 in", "0.89 mm"
    )
    inner_diameter: InnerLength | None = _key(None, "bore; 0 (solid) if not given", "4.276 in", "0 mm")
    core_diameter: Length | None = _key(
        None, "of a solid core that alone bears load, within a coil or sleeve of `outer_diameter`; needs "
        "`weight_per_length`, that of both", "0.6 mm",
    )  # fmt: skip
    youngs_modulus: Stress | None = _key(None, "with the diameters gives the bending stiffness", "200 GPa", "30e6 psi")
    bending_stiffness: Stiffness | None = _key(None, "B = EI, instead of `youngs_modulus`", "9.8e5 N m^2", "1400 N·mm²")
    torsional_stiffness: TorsionalStiffness | None = _key(
        None, "C = GJ as measured, instead of `poisson`; B/(1 + ν) if not given", "7.5e5 N m^2", "1800 N·mm²"
    )
    density: Density | None = _key(
        None, "of the material; with diameters and gravity gives the weight", "7800 kg/m^3", "65.5 lb/gal"
    )
    weight_per_length: ForcePerLength | None = _key(
        None, "in air with `[mud]`, else mg itself; instead of `density` or a pipe's nominal weight",
        "19.5 lbf/ft", "0.04 N/m",
    )  # fmt: skip
    poisson: Number = _key(0.3, "Poisson's ratio ν; that of the `material` if not given", 0.3, allowed=POISSON)
    pipe: Name | None = _key(
        None, "name in the catalogue (`rodwell catalogue`), instead of diameters, modulus and weight",
        "5 in 19.5 lb/ft drill pipe",
    )  # fmt: skip
    material: Name | None = _key(None, "name in the catalogue, instead of `youngs_modulus` and `density`", "steel")
    grade: Name | None = _key(None, "name in the catalogue: gives the yield strength", "S-135")
    yield_strength: Stress | None = _key(None, "of the rod, instead of `grade`", "135000 psi", "930 MPa")


class RodInput(PipeInput):
    """[rod]: the pipe, rod or wire; beside [[string]] its ends alone."""

    length: Length = _key(REQUIRED, "length L between the ends", "30 m", "300 ft")
    ends: Ends = _key("clamped-clamped", "conditions at s = 0 and s = 1", "clamped-pinned")


class StringRod(SectionInput):
    """[rod] beside [[string]]: what belongs to the whole."""

    length: Length | None = _key(None, "length of the whole, a check of the sections' lengths", "900 m")
    ends: Ends = _key("clamped-clamped", "conditions at s = 0 and s = 1", "clamped-pinned")


class StringInput(PipeInput):
    """[[string]]: a section of a string, from the bottom up; instead of the keys of the pipe in [rod]."""

    length: Length | None = _key(None, "length of the section, or `joints` and `joint_length`", "90 m", "300 ft")
    name: Name | None = _key(None, "for report and messages; that of the `pipe` if not given", "heavy-weight pipe")
    joints: int | None = _key(None, "how many, instead of `length`", 3, strict=True, ge=1, le=100_000)
    joint_length: Length | None = _key(None, "of one, with `joints`", "9.3 m", "30.5 ft")
    tool_joint_diameter: Length | None = _key(
        None, "outer diameter of the tool joints, with `joints`: half of one at either end of each joint; the body has "
        "its plain-end weight then", "6.625 in",
    )  # fmt: skip
    tool_joint_length: Length | None = _key(None, "of one made up, pin and box", "21 in")
    tool_joint_bore: InnerLength | None = _key(None, "of the tool joints; that of the body if not given", "3.25 in")
    outer_diameter_at_top: Length | None = _key(
        None, "a taper: the outer diameter goes in a straight line from `outer_diameter` at the section's lower end to "
        "this one at its upper; with `hole.clearance`", "0.15 mm",
    )  # fmt: skip
    inner_diameter_at_top: InnerLength | None = _key(None, "the same of the bore", "82 mm")
    core_diameter_at_top: Length | None = _key(None, "the same of the core", "0.15 mm")
    bending_stiffness_at_top: Stiffness | None = _key(None, "the same of the stiffness as measured", "5 N·mm²")
    torsional_stiffness_at_top: TorsionalStiffness | None = _key(
        None, "the same of the torsional stiffness as measured", "6 N·mm²"
    )
    weight_per_length_at_top: ForcePerLength | None = _key(None, "the same of the weight as measured", "0.01 N/m")


class Supports(SectionInput):
    """[supports]: what each support of the rod's ends and of the cylinder's ends can bear, for the check against it."""

    force: PositiveForce | None = _key(
        None, "largest force that a support of rod or cylinder can bear, at either end", "50 kN", "12000 lbf"
    )
    moment: PositiveMoment | None = _key(None, "largest bending moment across its axis", "2 kN m", "1500 ft lbf")
    torque: PositiveMoment | None = _key(None, "largest twisting moment about its axis", "1 kN m", "800 ft lbf")

    @model_validator(mode="after")
    def _something(self) -> Supports:
        if self.force is None and self.moment is None and self.torque is None:
            raise ValueError("is empty: give force, moment or torque, or leave the section out")
        return self


class Mud(SectionInput):
    """[mud]: the fluids in and around the rod, whose weight and lift make its weight the buoyed one."""

    density: FluidDensity | None = _key(
        None, "of the fluid on both sides of the pipe, instead of `inside` and `outside`", "10 lb/gal", "1.2 g/cm^3"
    )
    inside: FluidDensity | None = _key(None, "of the fluid in the bore; empty if not given", "8.34 lb/gal")
    outside: FluidDensity | None = _key(None, "of the fluid around the rod; empty if not given", "1060 kg/m^3")


class PressureAtEnd(SectionInput):
    """[pressure]: fluid pressures at the end s = 1, which make the force in the pipe wall the effective one."""

    inside: Pressure = _key(0.0, "in the bore at s = 1", "2500 psi", "17 MPa")
    outside: Pressure = _key(0.0, "around the rod at s = 1", "1500 psi", "10 MPa")


class PackerInput(SectionInput):
    """[packer]: tubing in a packer that goes from the state of [mud] and [pressure] to another."""

    bore: Length = _key(REQUIRED, "diameter of the packer's bore, in which the seals slide", "3.25 in")
    motion: Motion = _key(
        REQUIRED, "how much of its motion the packer allows the tubing; `some` needs `up`, `down` or both", "all"
    )
    up: InnerLength | None = _key(None, "how far the seals may move up from where they were landed", "2.5 ft")
    down: InnerLength | None = _key(None, "how far they may move down; `0 m`: landed on the packer", "0 m")
    slack_off: PositiveForce | None = _key(
        None, "weight set down on the packer when the tubing was landed, a compression without a sign", "20000 lbf"
    )
    pick_up: PositiveForce | None = _key(
        None, "force with which the tubing pulled at the packer when it was landed, instead of `slack_off`", "50 kN"
    )
    inside: FluidDensity | None = _key(
        None, "of the fluid in the tubing afterwards; that of `[mud]` if not given", "15 lb/gal"
    )
    outside: FluidDensity | None = _key(
        None, "of the fluid around it afterwards; that of `[mud]` if not given", "1010 kg/m^3"
    )
    inside_pressure: Pressure | None = _key(
        None, "in the tubing at the upper end afterwards; that of `[pressure]` if not given", "5000 psi"
    )
    outside_pressure: Pressure | None = _key(
        None, "around it at the upper end afterwards; that of `[pressure]` if not given", "1000 psi"
    )
    temperature_change: TemperatureChange = _key(0.0, "of the tubing, the mean over its length", "-20 °F", "35 K")
    thermal_expansion: Expansion | None = _key(
        None, "coefficient of the tubing, needed with `temperature_change`", "6.9e-6 /°F", "12.4e-6 /K"
    )


class CatalogueFiles(SectionInput):
    """[catalogue]: the user's own pipes, materials and grades."""

    files: list[str] = _key(
        REQUIRED, "TOML files with pipes, materials and grades of your own, from the folder of the case file",
        ["my-pipes.toml"],
    )  # fmt: skip


class Dimensionless(SectionInput):
    """[dimensionless]: instead of [rod] and [hole]."""

    weight: Number = _key(REQUIRED, "γ = mg L³/B; negative: the rod floats", 16.5, -15.0, allowed="up to 1e9 in size")
    alpha: Number = _key(90.0, "inclination α from the vertical, in degrees; beyond 90 s = 1 is the lower end", 60,
                          allowed="from 0 to 180")  # fmt: skip
    clearance: Number = _key(0.01, "Δ/L, from axis to axis", 0.01, allowed="above 0 and below 1")
    poisson: Number = _key(0.3, "Poisson's ratio ν", 0.3, allowed=POISSON)
    torsion: Number | None = _key(None, "C/B, instead of `poisson`; 1/(1 + ν) if not given", 13.0, allowed="above 0")
    ends: Ends = _key("clamped-clamped", "as in [rod]", "clamped-pinned")
    sections: SectionsLine | None = _key(
        None, "of a string from s = 0, `length:stiffness[:weight[:clearance[:torsion]]]` of each: lengths in L, which "
        "add up to 1, the others ratios, 1 where left out", "0.6:1:1, 0.4:0.3:0.5",
    )  # fmt: skip
    build: Number = _key(0.0, "curvature of the hole in 1/L, positive where it is concave upward; `alpha` is then the "
                         "inclination at mid-length", 0.2)  # fmt: skip
    walk: Number = _key(0.0, "curvature of the hole in 1/L to the right, looking towards s = 0", 0.1)
    wall_stiffness: Number | None = _key(None, "k L⁴/B, as in [hole]", 1e6, allowed="above 0")


UNTIL = (
    "end force to which branches are followed, **tension positive** (compression negative); chosen from the loads "
    "found if not given"
)
APPLIED = (
    "the load that acts, or a list, **tension positive**: what becomes of the rod there; a range makes a study of it"
)
TWIST = "end twisting moment T₁ at s = 1, a dead load"
AT = (
    "where `until` and `applied` act: `top` (s = 1, the upper end unless the hole climbs) or `bottom` (s = 0); `top` "
    "if not given"
)


class LoadInput(SectionInput):
    """[load]: what is applied at the ends; beside [dimensionless] plain numbers, in B/L² and B/L."""

    until: Force | None = _key(None, UNTIL, "-60000 lbf", "-5 N")
    applied: Forces | None = _key(None, APPLIED, "-35000 lbf", ["-20 kN", "-40 kN"])
    twist: Moment = _key(0.0, TWIST, "800 ft lbf", "5 N mm")
    at: End | None = _key(None, AT, "bottom")
    kind: ForceKind | None = _key(
        None, "what `until` and `applied` are: the `effective` force, or the `real` one in the wall; must be said "
        "beside `[pressure]`", "real",
    )  # fmt: skip


class DimensionlessLoad(SectionInput):
    """[load] beside [dimensionless]."""

    until: Number | None = _key(None, UNTIL, -200)
    applied: Numbers | None = _key(None, APPLIED, -120, [-100, -120])
    twist: Number = _key(0.0, TWIST, 0.5)
    at: End | None = _key(None, AT, "bottom")


class Analysis(SectionInput):
    """[analysis]: what is computed, and how exactly."""

    modes: int = _key(4, "how many buckling modes", 3, strict=True, ge=1, le=MOST_MODES)
    rtol: Number = _key(1e-8, "relative tolerance of every number", 1e-6, allowed=RTOL)
    off_wall: StrictBool = _key(
        True, "`false` leaves the load path out: what happens beyond lift-off, and on the way back", False
    )


class CaseFile(SectionInput):
    """At the top of the file, before the first section."""

    title: str | None = _key(None, "for report and summary; the name of the file if not given", "Drill pipe at 30°")
    rod: RodInput | None = None
    string: tuple[StringInput, ...] | None = None
    hole: Hole | None = None
    cylinder: CylinderInput | None = None
    supports: Supports | None = None
    dimensionless: Dimensionless | None = None
    load: dict[str, Any] = Field(default_factory=dict)
    analysis: Analysis = Analysis()
    mud: Mud | None = None
    pressure: PressureAtEnd | None = None
    packer: PackerInput | None = None
    catalogue: CatalogueFiles | None = None
    report: ReportInput | None = None
    units: Units | None = _key(None, "units of the results; `si` if not given", "field")
    study: StrictBool | None = _key(
        None, "`true` makes each list of values a parameter study; a range makes one by itself", True
    )
    plausible: StrictBool | None = _key(
        None, "`false` lets values pass that no rod has (a modulus of 30e6 GPa, a density of 7850 lb/gal)", False
    )
