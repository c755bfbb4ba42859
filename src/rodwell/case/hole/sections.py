"""[[hole.section]] of a case file: a hole whose diameter has steps, and what lies beside what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rodwell.case.hole.schema import Hole
from rodwell.case.kinds import REQUIRED, Length, Name, SectionInput, _key
from rodwell.errors import InputError

SAME_LENGTH = 1e-6
"""Relative difference of lengths that counts as none: feet become metres by rounding."""


WHOLE = "hole"
"""How a hole without sections is called in messages."""


class HoleSectionInput(SectionInput):
    """[[hole.section]]: a part of the hole with its own diameter, **from the top (s = 1) down**."""

    name: Name | None = _key(None, "for report and messages; its number from the top if not given", "7 in liner")
    length: Length = _key(REQUIRED, "of the part, as far as the rod lies in it", "12 m", "40 ft")
    diameter: Length | None = _key(None, "inner diameter; `hole.diameter` if not given", "6.094 in")


@dataclass(frozen=True)
class HolePart:
    """A part of a hole: what it is called, from where to where it goes, s/L, and its inner diameter in m."""

    name: str
    start: float
    end: float
    diameter: float | None


def check_parts(parts: object) -> None:
    """Refuse what is no list of sections, and lists and uncertainties in them, before anything is read."""
    if not isinstance(parts, Sequence) or isinstance(parts, str):
        what = "must be sections: write [[hole.section]], with two brackets, for each, from the top down"
        raise InputError("hole.section", parts, what)
    for number, part in enumerate(parts, 1):
        if not isinstance(part, Mapping):
            raise InputError(called(number), part, "must be a section: write [[hole.section]] with its keys below it")
        for key, value in part.items():
            if isinstance(value, list | tuple | Mapping):
                raise InputError(f"{called(number)}.{key}", value, "is a list: give one value for each section")
            if isinstance(value, str) and any(sign in value for sign in ("±", "+/-", "+-")):
                what = "cannot have an uncertainty here: [rod], [hole], [mud] and [load] take them; give a value alone"
                raise InputError(f"{called(number)}.{key}", value, what)


def called(number: int, name: str | None = None) -> str:
    """How a section is called in messages: its number from the top, and its name."""
    return f"hole.section {number}" + (f" ({name})" if name else "")


def parts_of(given: Sequence[HoleSectionInput], hole: Hole, length: float) -> tuple[HolePart, ...]:
    """The parts of the hole of a rod of a length in m, from s = 0 up; the hole as one where none are given.

    Raises
    ------
    InputError
        Where lengths do not add up to the rod's, a diameter is missing, or what stands in [hole] contradicts them.
    """
    if not given:
        return (HolePart(WHOLE, 0.0, 1.0, hole.diameter),)
    if hole.clearance is not None:
        raise InputError("hole.clearance", hole.clearance, "contradicts [[hole.section]], whose diameters give it: "
                         "leave one out")  # fmt: skip
    for key in ("build", "walk", "survey", "centerline"):
        if getattr(hole, key) is not None:
            raise InputError(f"hole.{key}", getattr(hole, key), "cannot stand beside [[hole.section]]: steps of the "
                             "clearance are computed in straight holes; leave one out")  # fmt: skip
    total = sum(one.length for one in given)
    if abs(total - length) > SAME_LENGTH * length:
        shown = " + ".join(f"{one.length:.6g}" for one in given)
        raise InputError(
            "hole.section", None, f"has lengths {shown} = {total:.6g} m, and the rod is {length:.6g} m long: give its "
            "parts as far as the rod lies in them",
        )  # fmt: skip
    out: list[HolePart] = []
    above = 1.0
    for number, one in enumerate(given, 1):
        diameter = one.diameter or hole.diameter
        if diameter is None:
            raise InputError(f"{called(number, one.name)}.diameter", None, "is missing: give it here or in [hole]")
        below = 0.0 if number == len(given) else above - one.length / total
        out.append(HolePart(called(number, one.name), below, above, diameter))
        above = below
    return tuple(out[::-1])
