"""[[string]] in the file of a well: the sections of a string, from the bit up to the surface."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rodwell.case.catalogue import Catalogue
from rodwell.case.fluids import Fluids
from rodwell.case.pipe import PhysicalRod
from rodwell.case.schema import Mud, PressureAtEnd, StringInput
from rodwell.case.string.sections import name_of, section_rod
from rodwell.case.string.tapers import AT_TOP
from rodwell.case.string.tapers import KEYS as TAPERS
from rodwell.case.string.tool_joints import KEYS
from rodwell.errors import InputError

MOST_SECTIONS = 200
"""Sections that a string may have."""


@dataclass(frozen=True)
class StringSection:
    """A section of a string: name, rod, weight in the fluids in N/m, fluids; length ``inf``: up to the surface."""

    name: str
    rod: PhysicalRod
    weight: float
    fluids: Fluids


def key_of_part(number: int, key: str) -> str:
    """How a key of a section is called in messages, counted from 1 at the bottom."""
    return f"[[string]] {number + 1}, {key}"


def string_sections(
    parts: Sequence[StringInput], gravity: float, mud: Mud | None, pressure: PressureAtEnd | None, catalogue: Catalogue
) -> tuple[StringSection, ...]:
    """Return the sections of a string in SI units, from the bottom up.

    Raises
    ------
    InputError
        Naming the section (from 1 at the bottom) and the key that is missing, contradicts another, or is not in the
        catalogue.
    """
    if not parts:
        raise InputError("string", None, "is missing: give [[string]] for each section, from the bottom up")
    if len(parts) > MOST_SECTIONS:
        raise InputError("string", len(parts), f"has more than {MOST_SECTIONS} sections: join those that are alike")
    out = []
    for i, part in enumerate(parts):
        for key in (one + AT_TOP for one in TAPERS):
            if getattr(part, key) is not None:
                what = "makes a taper, which torque and drag does not take: give one [[string]] for each section"
                raise InputError(key_of_part(i, key), getattr(part, key), what)
        for key in KEYS:
            if getattr(part, key) is not None:
                what = "is not taken by torque and drag: give weight_per_length with the tool joints in it instead"
                raise InputError(key_of_part(i, key), getattr(part, key), what)
        length = _length(part, i, last=i == len(parts) - 1)
        try:
            rod, fluids, weight = section_rod(part, length, gravity, mud, pressure, catalogue)
        except InputError as error:
            raise _renamed(error, i) from None
        out.append(StringSection(name_of(part, i + 1), rod, weight, fluids))
    return tuple(out)


def _length(part: StringInput, number: int, last: bool) -> float:
    """Length of a section in m; infinite where it is left open."""
    if part.joints is None:
        if part.joint_length is not None:
            raise InputError(key_of_part(number, "joints"), None, "is missing: joint_length needs it")
        if part.length is None and not last:
            raise InputError(key_of_part(number, "length"), None, "is missing: only the uppermost section may leave it "
                             "out; give it, or joints and joint_length")  # fmt: skip
        return math.inf if part.length is None else part.length
    if part.length is not None:
        raise InputError(key_of_part(number, "length"), part.length, "contradicts joints: give only one of the two")
    if part.joint_length is None:
        raise InputError(key_of_part(number, "joint_length"), None, 'is missing: joints needs it, for example "9.45 m"')
    return part.joints * part.joint_length


def _renamed(error: InputError, number: int) -> InputError:
    """An error about [rod] as one about a section."""
    field = error.field
    name = key_of_part(number, field.removeprefix("rod.")) if field.startswith("rod.") else field
    return InputError(name, error.value, error.reason.replace("rod.", ""))
