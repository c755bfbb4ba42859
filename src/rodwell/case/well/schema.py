"""What the file of a well may hold (`rodwell drag`): string, hole, fluids, operations; each value on its own."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, StrictBool

from rodwell.case.about import ReportInput
from rodwell.case.hole.schema import DepthUnit
from rodwell.case.kinds import (
    REQUIRED,
    Acceleration,
    Force,
    InnerLength,
    Length,
    Name,
    Number,
    OneOf,
    Quantity,
    SectionInput,
    Several,
    Units,
    _key,
)
from rodwell.case.schema import CatalogueFiles, Mud, PressureAtEnd, StringInput
from rodwell.case.well.hole_sections import ALLOWED_FRICTION, HolePart

KINDS_OF_OPERATION = ("run-in", "pull-out", "rotate-off-bottom", "slide", "drill", "ream", "back-ream")
CONTACTS = ("exact", "correlation", "straight")
STRINGS = ("soft", "stiff")
STATE_RULES = ("history", "equal-energy", "late", "early")

MOST_OPERATIONS, MOST_DEPTHS, MOST_FACTORS = 40, 400, 12

Speed = Annotated[float, BeforeValidator(Quantity("speed", least=0.0))]
Weight = Annotated[float, BeforeValidator(Quantity("force", least=0.0))]
Torque = Annotated[float, BeforeValidator(Quantity("moment", least=0.0))]
Operation = Annotated[str, BeforeValidator(OneOf(KINDS_OF_OPERATION))]
Contact = Annotated[Literal["exact", "correlation", "straight"], BeforeValidator(OneOf(CONTACTS))]
Model = Annotated[Literal["soft", "stiff"], BeforeValidator(OneOf(STRINGS))]
StateRule = Annotated[Literal["history", "equal-energy", "late", "early"], BeforeValidator(OneOf(STATE_RULES))]
Operations = Annotated[tuple[Operation, ...], BeforeValidator(Several(len(KINDS_OF_OPERATION)))]
Factors = Annotated[tuple[Number, ...], BeforeValidator(Several(MOST_FACTORS))]


class WellHole(SectionInput):
    """[hole]: the path of the hole, and what belongs to all its sections."""

    survey: str = _key(REQUIRED, "file of measured depth, inclination and azimuth, from the folder of the file",
                       "survey.csv")  # fmt: skip
    well: str | None = _key(None, "which well, if the survey holds several", "A-1")
    depth_unit: DepthUnit | None = _key(None, "unit of depth, if the survey does not say", "ft")
    diameter: Length | None = _key(None, "inner diameter, where a section does not say", "8.5 in")
    friction: Number | None = _key(None, "friction factor, where a section does not say", 0.25,
                                   allowed=ALLOWED_FRICTION)  # fmt: skip
    gravity: Acceleration = _key(9.80665, "used with `density` and fluids", "9.80665 m/s^2")
    section: tuple[HolePart, ...] = Field((), description="[[hole.section]], from the top down")


class OperationInput(SectionInput):
    """[[well.operation]]: what is done with the string."""

    name: Name | None = _key(None, "what it is called in tables; its kind if not given", "slide at TD")
    kind: Operation = _key(REQUIRED, "what is done", "run-in", allowed=", ".join(KINDS_OF_OPERATION))
    bit_depth: Length | None = _key(
        None, "measured depth of the bit; that of the string's length, or the end of the survey, if not given", "3400 m"
    )
    bit_force: Force | None = _key(
        None, "effective force at the bit, **tension positive**: weight on bit is negative; 0 if not given", "-50 kN"
    )
    bit_torque: Torque | None = _key(None, "torque at the bit, 0 if not given", "3 kN m")
    speed: Speed | None = _key(None, "axial speed, with `rpm` for drilling and reaming", "20 m/h")
    rpm: Number | None = _key(None, "turns per minute, with `speed` for drilling and reaming", 120,
                              allowed="0 or more")  # fmt: skip


class RoadMapInput(SectionInput):
    """[well.road_map]: hook load and torque against the depth of the bit."""

    from_: InnerLength | None = Field(None, alias="from", description="least depth of the bit", examples=["500 m"])
    to: Length | None = _key(None, "largest depth of the bit; the end of the survey if not given", "3400 m")
    depths: int = _key(40, "how many depths", 40, strict=True, ge=2, le=MOST_DEPTHS)
    kinds: Operations = _key(("run-in", "pull-out", "rotate-off-bottom"), "operations", ["run-in", "pull-out"])
    friction: Factors | None = _key(None, "friction factors for the whole hole, one curve each", [0.2, 0.3, 0.4])
    friction_times: Factors | None = _key(
        None, "factors on the friction of all sections, one curve each, instead of `friction`", [0.8, 1.0, 1.2]
    )
    bit_force: Force | None = _key(None, "effective force at the bit when sliding or drilling", "-50 kN")


class WellInput(SectionInput):
    """[well]: how the well is computed, and what is done in it."""

    block_weight: Weight = _key(0.0, "weight of block and top drive, which also pushes; the hook load does not have it",
                                "200 kN")  # fmt: skip
    push: Weight = _key(0.0, "largest push at surface beside the weight of the block: of an injector, of jacks",
                        "150 kN")  # fmt: skip
    contact: Contact = _key(
        "exact", "how a buckled string presses the wall", "correlation", allowed=", ".join(CONTACTS)
    )
    string: Model = _key("soft", "whether the string's stiffness counts in the curved hole", "stiff",
                         allowed=", ".join(STRINGS))  # fmt: skip
    state_rule: StateRule = _key("history", "which of several stable local states holds", "equal-energy",
                                 allowed=", ".join(STATE_RULES))  # fmt: skip
    operation: tuple[OperationInput, ...] = Field(default=(), description="[[well.operation]], in any order")
    road_map: RoadMapInput | None = Field(default=None, description="[well.road_map]")


class WellFile(SectionInput):
    """At the top of the file, before the first section."""

    title: str | None = _key(None, "for report and summary; the name of the file if not given", "Well A")
    units: Units | None = _key(None, "units of the results; `si` if not given", "field")
    string: tuple[StringInput, ...] = Field((), description="[[string]], from the bit up")
    hole: WellHole = Field(REQUIRED)
    mud: Mud | None = None
    pressure: PressureAtEnd | None = None
    well: WellInput = Field(default_factory=WellInput)
    study: StrictBool | None = _key(
        None, "`true` makes each list of values a parameter study; a range makes one by itself", True
    )
    catalogue: CatalogueFiles | None = None
    report: ReportInput | None = None
