"""[[hole.section]] of a case file: a hole whose diameter has steps, and what lies beside what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from pydantic import ConfigDict

from rodwell.case.hole.lie import depths_of
from rodwell.case.hole.schema import Hole
from rodwell.case.kinds import InnerLength, Length, Name, SectionInput, _key
from rodwell.errors import InputError
from rodwell.problem.profile import Ratio
from rodwell.problem.sections import ramp

SAME_LENGTH = 1e-6
"""Relative difference of lengths that counts as none: feet become metres by rounding."""


UPWARDS = "; these go from the bottom up, as [[string]] does: turn their order round"

WHOLE = "hole"
"""How a hole without sections is called in messages."""


class HoleSectionInput(SectionInput):
    """[[hole.section]]: a part of the hole with its own diameter, **from the top (s = 1) down**."""

    model_config = ConfigDict(extra="forbid", frozen=True, populate_by_name=True)

    name: Name | None = _key(None, "for report and messages; its number from the top if not given", "7 in liner")
    length: Length | None = _key(
        None, "of the part, as far as the rod lies in it; instead of `from` and `to`", "12 m", "40 ft"
    )
    from_: InnerLength | None = _key(
        None, "measured depth where it begins; that where the one above ends if not given. The rod's end s = 1 lies at "
        "`hole.from`, or where the first section begins", "1200 m", alias="from",
    )  # fmt: skip
    to: Length | None = _key(None, "measured depth where it ends; sections may reach beyond the rod", "1900 m")
    diameter: Length | None = _key(
        None, "inner diameter, at the lower end where `diameter_at_top` is another; `hole.diameter` if not given",
        "6.094 in",
    )  # fmt: skip
    diameter_at_top: Length | None = _key(
        None, "inner diameter at the upper end, to which it goes over smoothly, without steps and kinks at either end; "
        "`diameter` if not given", "7 in",
    )  # fmt: skip


@dataclass(frozen=True)
class HolePart:
    """A part of a hole: what it is called, from where to where it goes, s/L, and its inner diameter in m.

    The diameter is a number, or values at evenly spaced places from the lower end, of which it is the polynomial.
    """

    name: str
    start: float
    end: float
    diameter: Ratio | None


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
        Where lengths do not add up to the rod's, depths leave a gap or end within it, a diameter is missing, or what
        stands in [hole] contradicts them.
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
    bounds = _by_depth(given, hole, length) if by_depth(given) else _by_length(given, length)
    out: list[HolePart] = []
    for number, (one, above, below) in enumerate(zip(given, bounds[:-1], bounds[1:], strict=True), 1):
        diameter = one.diameter or hole.diameter
        if diameter is None:
            raise InputError(f"{called(number, one.name)}.diameter", None, "is missing: give it here or in [hole]")
        name, at_top = called(number, one.name), one.diameter_at_top or diameter
        if above > below and at_top == diameter:
            out.append(HolePart(name, below, above, diameter))
        elif above > below:
            quarter = 0.25 * (above - below)
            values = [section[3] for section in ramp(above - below, diameter, at_top)]
            out += [HolePart(name, below + i * quarter, above if i == 3 else below + (i + 1) * quarter, values[i])
                    for i in (3, 2, 1, 0)]  # fmt: skip
    return tuple(out[::-1])


def by_depth(given: Sequence[HoleSectionInput]) -> bool:
    """Whether sections say from which measured depth to which they go, not how long they are."""
    return any(one.from_ is not None or one.to is not None for one in given)


def _by_length(given: Sequence[HoleSectionInput], length: float) -> list[float]:
    """Where sections of the lengths given begin and end, s/L from 1 down."""
    lengths = []
    for number, one in enumerate(given, 1):
        if one.length is None:
            what = "is missing: give it, or from and to, measured depths, in all sections"
            raise InputError(f"{called(number, one.name)}.length", None, what)
        lengths.append(one.length)
    total = sum(lengths)
    if abs(total - length) > SAME_LENGTH * length:
        shown = " + ".join(f"{one:.6g} m" for one in lengths)
        raise InputError(
            "hole.section", None, f"has lengths {shown} = {total:.6g} m, and the rod is {length:.6g} m long: give its "
            "parts as far as the rod lies in them",
        )  # fmt: skip
    return [1.0, *(sum(lengths[k:]) / total for k in range(1, len(lengths))), 0.0]


def _by_depth(given: Sequence[HoleSectionInput], hole: Hole, length: float) -> list[float]:
    """The same of sections between measured depths, no farther than the rod goes."""
    depths = [0.0 if given[0].from_ is None else given[0].from_]
    for number, one in enumerate(given, 1):
        key = called(number, one.name)
        if one.length is not None:
            raise InputError(f"{key}.length", one.length, "contradicts from and to, which sections here have: give one "
                             "or the other, in all of them")  # fmt: skip
        if one.from_ is not None and abs(one.from_ - depths[-1]) > SAME_LENGTH * length:
            what = f"is not where the section above ends, {depths[-1]:.6g} m: sections go from the top down, without "
            raise InputError(
                f"{key}.from", one.from_, f"{what}gap or overlap{UPWARDS if one.from_ < depths[-2] else ''}"
            )
        if one.to is None:
            raise InputError(f"{key}.to", None, "is missing: give the measured depth where the section ends")
        if one.to <= depths[-1]:
            what = f"must be below where the section begins, {depths[-1]:.6g} m{UPWARDS if number > 1 else ''}"
            raise InputError(f"{key}.to", one.to, what)
        depths.append(one.to)
    top = depths[0]
    if hole.from_ is not None or hole.to is not None:
        top, _ = depths_of(hole, length, depths[-1])
    if top < depths[0] - SAME_LENGTH * length or top + length > depths[-1] + SAME_LENGTH * length:
        raise InputError(
            "hole.section", None, f"goes from {depths[0]:.6g} m to {depths[-1]:.6g} m, and the rod lies from "
            f"{top:.6g} m to {top + length:.6g} m: a hole must be known all along its rod",
        )  # fmt: skip
    for number, one in enumerate(given, 1):
        ends = depths[number - 1 : number + 1]
        outside = ends[0] < top - SAME_LENGTH * length or ends[1] > top + length + SAME_LENGTH * length
        if one.diameter_at_top is not None and outside:
            what = f"goes beyond the rod, which lies from {top:.6g} m to {top + length:.6g} m: what varies must lie "
            what += "beside the rod with all of its length"
            raise InputError(f"{called(number, one.name)}.diameter_at_top", one.diameter_at_top, what)
    places = [min(max(1.0 - (depth - top) / length, 0.0), 1.0) for depth in depths]
    return [1.0, *(0.0 if place < SAME_LENGTH else 1.0 if place > 1.0 - SAME_LENGTH else place
                   for place in places[1:-1]), 0.0]  # fmt: skip
