"""What a catalogue holds: pipes, materials and grades, each with its source."""

from __future__ import annotations

from pydantic import Field, model_validator

from rodwell.case.kinds import Density, ForcePerLength, Length, Name, Number, SectionInput, Stiffness, Stress


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
