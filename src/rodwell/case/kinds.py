"""Kinds of values that a case file holds: how each is read from what was written, and what is allowed in words.

And what all its sections share: keys with their meaning and examples, unknown keys refused.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from rodwell.errors import InputError
from rodwell.problem.ends import ENDS, checked_ends
from rodwell.quantities.units import SYSTEMS, to_si


@dataclass(frozen=True)
class Quantity:
    """Text with a number and a unit, read as an SI number that is above ``above`` and at least ``least``."""

    kind: str
    above: float = -math.inf
    least: float = -math.inf

    def __call__(self, text: object) -> float:
        """Return the SI value; raises ValueError with what is wrong and what to write instead."""
        value = to_si(text, self.kind)
        if not value > self.above:
            raise ValueError("must be above 0")
        if not value >= self.least:
            raise ValueError("must not be negative")
        return value

    @property
    def allowed(self) -> str:
        """What is allowed, in words."""
        return "above 0" if self.above == 0.0 else "0 or more" if self.least == 0.0 else ""


@dataclass(frozen=True)
class PlainNumber:
    """A number as TOML has it, without quotes or unit."""

    kind: str = "number"
    allowed: str = ""

    def __call__(self, text: object) -> object:
        """Return the number; raises ValueError for text and for true and false."""
        if isinstance(text, str):
            raise ValueError("must be a plain number, without quotes or unit")
        if isinstance(text, bool):
            raise ValueError("must be a number")
        return text


@dataclass(frozen=True)
class OneOf:
    """Text that must be one of a few words."""

    words: tuple[str, ...]
    kind: str = "text"

    def __call__(self, text: object) -> object:
        """Return the word; raises ValueError for any other."""
        if text not in self.words:
            raise ValueError("must be " + " or ".join(f'"{word}"' for word in self.words))
        return text

    @property
    def allowed(self) -> str:
        """What is allowed, in words."""
        return " or ".join(self.words)


@dataclass(frozen=True)
class TwoEnds:
    """End conditions at s = 0 and s = 1, as text."""

    kind: str = "text"
    allowed: str = f"two of {', '.join(ENDS)}, joined by a hyphen"

    def __call__(self, text: object) -> str:
        """Return the text; raises ValueError for any other pair."""
        try:
            return "-".join(checked_ends(text))
        except InputError as error:
            raise ValueError(error.reason) from None


@dataclass(frozen=True)
class Several:
    """One value, or a list of up to ``most``, as a list."""

    most: int

    def __call__(self, value: object) -> object:
        """Return one value as a list of one; raises ValueError for none or too many."""
        if not isinstance(value, list | tuple):
            return [value]
        if not 1 <= len(value) <= self.most:
            raise ValueError(f"must hold from 1 to {self.most} forces")
        return value


MOST_LOADS = 12
"""Loads that one case may apply."""

Length = Annotated[float, BeforeValidator(Quantity("length", above=0.0))]
InnerLength = Annotated[float, BeforeValidator(Quantity("length", least=0.0))]
Angle = Annotated[float, BeforeValidator(Quantity("angle"))]
Curvature = Annotated[float, BeforeValidator(Quantity("curvature"))]
Force = Annotated[float, BeforeValidator(Quantity("force"))]
Moment = Annotated[float, BeforeValidator(Quantity("moment"))]
PositiveForce = Annotated[float, BeforeValidator(Quantity("force", above=0.0))]
PositiveMoment = Annotated[float, BeforeValidator(Quantity("moment", above=0.0))]
Stress = Annotated[float, BeforeValidator(Quantity("stress", above=0.0))]
WallStiffness = Annotated[float, BeforeValidator(Quantity("wall stiffness", above=0.0))]
Density = Annotated[float, BeforeValidator(Quantity("density", above=0.0))]
ForcePerLength = Annotated[float, BeforeValidator(Quantity("force per length", least=0.0))]
Stiffness = Annotated[float, BeforeValidator(Quantity("bending stiffness", above=0.0))]
TorsionalStiffness = Annotated[float, BeforeValidator(Quantity("torsional stiffness", above=0.0))]
Acceleration = Annotated[float, BeforeValidator(Quantity("acceleration", least=0.0))]
Pressure = Annotated[float, BeforeValidator(Quantity("pressure", least=0.0))]
FluidDensity = Annotated[float, BeforeValidator(Quantity("density", least=0.0))]
TemperatureChange = Annotated[float, BeforeValidator(Quantity("temperature change"))]
Expansion = Annotated[float, BeforeValidator(Quantity("thermal expansion", least=0.0))]
Number = Annotated[float, BeforeValidator(PlainNumber())]
Forces = Annotated[tuple[Force, ...], BeforeValidator(Several(MOST_LOADS))]
Numbers = Annotated[tuple[Number, ...], BeforeValidator(Several(MOST_LOADS))]
Ends = Annotated[str, BeforeValidator(TwoEnds())]
Name = Annotated[str, Field(min_length=1, max_length=80)]
Line = Annotated[str, Field(min_length=1, max_length=200)]
SectionsLine = Annotated[str, Field(min_length=1, max_length=10_000)]
End = Annotated[Literal["top", "bottom"], BeforeValidator(OneOf(("top", "bottom")))]
ForceKind = Annotated[Literal["effective", "real"], BeforeValidator(OneOf(("effective", "real")))]
Motion = Annotated[Literal["none", "some", "all"], BeforeValidator(OneOf(("none", "some", "all")))]
Units = Annotated[Literal["si", "field", "mm"], BeforeValidator(OneOf(SYSTEMS))]

REQUIRED: Any = ...


def _key(default: Any, meaning: str, *examples: object, allowed: str = "", **checks: Any) -> Any:
    """A key with its default (REQUIRED: none), what it means, examples, and what is allowed beyond its kind.

    ``alias`` among the checks is what it is called in the file where that is a word of Python.
    """
    return Field(
        default, description=meaning, examples=list(examples), json_schema_extra={"allowed": allowed}, **checks
    )


class SectionInput(BaseModel):
    """Base of all sections: unknown keys are refused, values are not changed after reading."""

    model_config = ConfigDict(extra="forbid", frozen=True)
