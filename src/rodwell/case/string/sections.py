"""[[string]] of a case file: a string of sections, from the bottom up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rodwell.case import schema
from rodwell.case.catalogue import Catalogue
from rodwell.case.facts import Fact
from rodwell.case.fluids import Fluids, fluids_of, weight_in
from rodwell.case.hole.schema import Hole
from rodwell.case.pipe import PhysicalRod, physical_rod
from rodwell.case.string.tapers import AT_TOP, Taper, taper_of
from rodwell.case.string.tapers import KEYS as TAPERS
from rodwell.case.string.tool_joints import TOOL_JOINT, body_between_tool_joints, tool_joint_of
from rodwell.errors import InputError
from rodwell.problem.profile import Ratio
from rodwell.problem.sections import Section
from rodwell.quantities.arrays import FloatArray

EQUAL = 1e-9
"""Relative difference of lengths that counts as none."""

BESIDE = ("ends", "length")
"""Keys of [rod] that may stand beside [[string]]."""


@dataclass(frozen=True)
class Member:
    """A section of a string: its name, the rod that it is in SI units, and its weight in the fluids in N/m.

    Of a ``taper`` the rod is that at its lower end, the weight is the mean.

    ``number`` is that of its [[string]] from the bottom, from 1, ``place`` its own among all members, from 0: a section
    with tool joints has a member for each body and each tool joint, which ``tool_joint`` tells apart.
    """

    number: int
    place: int
    name: str
    rod: PhysicalRod
    weight: float
    tool_joint: bool = False
    taper: Taper | None = None

    @property
    def key(self) -> str:
        """How the section is called in messages: its number from the bottom, and its name."""
        return called(self.number, self.name)

    @property
    def diameter_key(self) -> str:
        """The key that has its outer diameter."""
        own = called(self.number, self.name.removesuffix(TOOL_JOINT)) if self.tool_joint else self.key
        return f"{own}.{'tool_joint_diameter' if self.tool_joint else 'outer_diameter'}"

    @property
    def rods(self) -> tuple[PhysicalRod, ...]:
        """What it is at evenly spaced places, from its lower end; one rod, if it does not taper."""
        return (self.rod,) if self.taper is None else self.taper.rods

    @property
    def within(self) -> tuple[FloatArray, FloatArray]:
        """Diameters in m of its bore and of its core, 0 where there is none, at its lower and its upper end, (2,)."""
        ends = self.rods[0], self.rods[-1]
        return np.array([rod.inner_diameter for rod in ends]), np.array([rod.core_diameter or 0.0 for rod in ends])

    @property
    def weights(self) -> tuple[float, ...]:
        """Its weight in N/m at evenly spaced places, the same way."""
        return (self.weight,) if self.taper is None else self.taper.weights


@dataclass(frozen=True)
class PhysicalString:
    """Sections from the bottom (s = 0) up."""

    members: tuple[Member, ...]

    @cached_property
    def length(self) -> float:
        """Of the whole, in m."""
        return sum(member.rod.length for member in self.members)

    @cached_property
    def weight(self) -> float:
        """Mean weight per length in the fluids in N/m; of sections that are alike exactly theirs."""
        first = self.members[0].weight
        return first + sum((one.weight - first) * one.rod.length for one in self.members) / self.length

    @cached_property
    def mixed(self) -> bool:
        """Whether some sections sink and others float."""
        return min(min(one.weights) for one in self.members) < 0.0 < max(max(one.weights) for one in self.members)

    @cached_property
    def unit_weight(self) -> float:
        """Weight per length in N/m that others are ratios to: the mean, or the largest where some sections float."""
        return max(abs(one) for member in self.members for one in member.weights) if self.mixed else self.weight

    @cached_property
    def longest(self) -> Member:
        """The longest section, the first of equals: its stiffness is the unit B."""
        return max(self.members, key=lambda member: member.rod.length)

    @cached_property
    def ends(self) -> tuple[tuple[float, float], ...]:
        """Where each section begins and ends, s/L."""
        out, below = [], 0.0
        for member in self.members:
            out.append((below / self.length, (below + member.rod.length) / self.length))
            below += member.rod.length
        return tuple(out)

    def part_of(self, member: Member, s: FloatArray) -> FloatArray:
        """Places s/L (m,) as parts of the length of a section, from its lower end."""
        start, end = self.ends[member.place]
        return (s - start) / (end - start)

    @cached_property
    def sections(self) -> tuple[Section, ...]:
        """Lengths in L, and ratios to the longest section's stiffness and the unit of weight."""
        unit, whole = self.longest.rod, self.unit_weight
        return tuple(
            (
                one.rod.length / self.length,
                _ratio(rod.stiffness / unit.stiffness for rod in one.rods),
                _ratio(weight / whole if whole != 0.0 else 1.0 for weight in one.weights),
                1.0,
                _ratio(rod.torsional_stiffness / unit.torsional_stiffness for rod in one.rods),
            )
            for one in self.members
        )

    @cached_property
    def whole(self) -> PhysicalRod:
        """A rod of the whole length with the longest section's data, the mean weight in air and no strength."""
        air = sum(one.rod.weight_in_air * one.rod.length for one in self.members) / self.length
        return replace(self.longest.rod, length=self.length, weight_in_air=air, yield_strength=None, facts=())

    def at_end(self, bottom: bool) -> PhysicalRod:
        """The rod at the lower or the upper end."""
        return self.members[0].rods[0] if bottom else self.members[-1].rods[-1]

    def facts(self) -> tuple[Fact, ...]:
        """Where the numbers of each section come from."""
        note = "the longest section; weights are set against " + ("the largest" if self.mixed else "their mean")
        tapers = "" if self.longest.taper is None else ", at its lower end"
        out = [Fact("unit of stiffness B", f"{self.longest.key}{tapers}", note=note)]
        for one in {member.key: member for member in self.members}.values():
            out += [replace(fact, label=f"{one.key}: {fact.label}") for fact in one.rod.facts]
        return tuple(out)


def _ratio(values: Iterable[float]) -> Ratio:
    """A ratio of a section: a number, or its values at evenly spaced places."""
    found = tuple(values)
    return found[0] if len(found) == 1 else found


def called(number: int, name: str = "") -> str:
    """How a section is called in messages."""
    return f"string {number}" + (f" ({name})" if name else "")


def check_beside(rod: object, string: object) -> None:
    """Refuse what cannot stand in [rod] beside [[string]], lists and uncertainties in it, before anything is read."""
    for key, value in rod.items() if isinstance(rod, Mapping) else ():
        if key not in BESIDE and key in schema.RodInput.model_fields:
            what = "cannot stand beside [[string]], whose sections have their own: leave it out, or [[string]]"
            raise InputError(f"rod.{key}", value, what)
    if not isinstance(string, Sequence) or isinstance(string, str):
        what = "must be sections: write [[string]], with two brackets, for each, from the bottom up"
        raise InputError("string", None, what)
    for number, section in enumerate(string, 1):
        for key, value in section.items() if isinstance(section, Mapping) else ():
            if isinstance(value, list | tuple | Mapping):
                what = "is a list: it is neither a taper nor a study here; write one [[string]] for each section"
                if key in TAPERS:
                    what += f", and a taper as {key} and {key}{AT_TOP}, its values at lower and upper end"
                raise InputError(f"{called(number)}.{key}", value, what)
            if isinstance(value, str) and any(sign in value for sign in ("±", "+/-", "+-")):
                what = "cannot have an uncertainty here: [rod], [hole], [mud] and [load] take them; give a value alone"
                raise InputError(f"{called(number)}.{key}", value, what)


def string_of(
    given: Sequence[schema.StringInput],
    hole: Hole,
    mud: schema.Mud | None,
    pressure: schema.PressureAtEnd | None,
    catalogue: Catalogue,
) -> tuple[PhysicalString, Fluids]:
    """Return the string that [[string]] describes, and the fluids in and around it.

    Raises
    ------
    InputError
        Naming section and key that is missing, contradicts another, or is not in the catalogue.
    """
    members: list[Member] = []
    fluids = None
    for number, one in enumerate(given, 1):
        name = name_of(one, number)
        with _as_section(number, name):
            made, fluids = _made_up(one, hole.gravity, mud, pressure, catalogue)
            members += [
                Member(number, place, f"{name}{what}", rod, weight, what == TOOL_JOINT, taper)
                for place, (what, rod, weight, taper) in enumerate(made, len(members))
            ]
    if fluids is None:
        raise InputError("string", None, "has no section: give one [[string]] for each, from the bottom up")
    string = PhysicalString(tuple(members))
    for member in string.members:
        if min(member.weights) < 0.0 < max(member.weights):
            raise InputError(member.key, None, "begins to float within the section: part it there")
    return string, fluids


def name_of(one: schema.StringInput, number: int) -> str:
    """What a section is called: its own name, or that of its pipe, or its number from the bottom, from 1."""
    return one.name or one.pipe or f"section {number}"


def section_rod(
    one: schema.StringInput,
    length: float,
    gravity: float,
    mud: schema.Mud | None,
    pressure: schema.PressureAtEnd | None,
    catalogue: Catalogue,
) -> tuple[PhysicalRod, Fluids, float]:
    """The rod of a section of a length in m, the fluids in and around it, and its weight in these in N/m."""
    rod = physical_rod(one, gravity, catalogue, length)
    fluids = fluids_of(mud, pressure, rod)
    return rod, fluids, weight_in(fluids, rod, gravity)


def check_length(string: PhysicalString, length: float | None) -> None:
    """Refuse a rod.length that is not that of its sections."""
    if length is not None and abs(length - string.length) > EQUAL * string.length:
        parts = " + ".join(f"{one.rod.length:.6g}" for one in string.members)
        what = f"is not that of the sections, {parts} = {string.length:.6g} m: correct one, or leave rod.length out"
        raise InputError("rod.length", length, what)


def _made_up(
    one: schema.StringInput,
    gravity: float,
    mud: schema.Mud | None,
    pressure: schema.PressureAtEnd | None,
    catalogue: Catalogue,
) -> tuple[list[tuple[str, PhysicalRod, float, Taper | None]], Fluids]:
    """What a section is made up of from the bottom up, each with a word for its name, its weight in N/m, its taper."""
    tapered = taper_of(one, lambda at: section_rod(at, _length(one), gravity, mud, pressure, catalogue))
    if tapered is not None:
        taper, fluids = tapered
        return [("", taper.rods[0], taper.mean_weight, taper)], fluids
    length, joints, thick = _length(one), one.joints, one.tool_joint_length
    body = body_between_tool_joints(one, catalogue)
    if body is None or joints is None or thick is None:
        rod, fluids, weight = section_rod(one, length, gravity, mud, pressure, catalogue)
        return [("", rod, weight, None)], fluids
    rod, fluids, weight = section_rod(body, length / joints - thick, gravity, mud, pressure, catalogue)
    joint, _, heavy = section_rod(tool_joint_of(one, rod, catalogue), thick, gravity, mud, pressure, catalogue)
    half = (TOOL_JOINT, replace(joint, length=0.5 * thick), heavy, None)
    pipe = ("", rod, weight, None)
    between = [pipe, (TOOL_JOINT, joint, heavy, None)]
    return [half, *(joints - 1) * between, pipe, half], fluids


def _length(one: schema.StringInput) -> float:
    """Length of a section: as given, or that of its joints."""
    if one.length is not None:
        for key in ("joints", "joint_length"):
            if getattr(one, key) is not None:
                raise InputError(f"rod.{key}", getattr(one, key), "contradicts length: give only one of the two")
        return one.length
    if one.joints is None:
        raise InputError("rod.length", None, "is missing: give it, or joints and joint_length")
    if one.joint_length is None:
        raise InputError("rod.joint_length", None, "is missing: the length of one joint is needed with joints")
    return one.joints * one.joint_length


@contextmanager
def _as_section(number: int, name: str) -> Iterator[None]:
    """Give errors of what is stated for [rod] the name of a section of [[string]]."""
    try:
        yield
    except InputError as error:
        field: str = error.field
        if field.startswith("rod."):
            field = f"{called(number, name)}.{field.removeprefix('rod.')}"
        raise InputError(field, error.value, error.reason.replace("rod.", "")) from None
