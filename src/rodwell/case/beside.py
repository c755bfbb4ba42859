"""What lies beside what: sections of a string in parts of a hole, with the clearance of each pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rodwell.case.hole.schema import Hole
from rodwell.case.hole.sections import WHOLE, HolePart
from rodwell.case.pipe import PhysicalRod
from rodwell.case.string.sections import Member, PhysicalString
from rodwell.case.string.tapers import AT_TOP
from rodwell.errors import InputError
from rodwell.problem.profile import Ratio, extremes, within
from rodwell.problem.sections import PLAIN, Section

EQUAL = 1e-9
"""Relative difference of clearances, and difference of places in L, that counts as none."""


@dataclass(frozen=True)
class Pair:
    """A piece of the rod between steps, s/L: the section of the string (None: the rod is one), the part of the hole.

    ``clearance`` is from axis to axis, in m: a number, or values at evenly spaced places from the lower end, of which
    it is the polynomial.
    """

    start: float
    end: float
    member: Member | None
    part: HolePart
    clearance: Ratio

    @property
    def name(self) -> str:
        """How it is called in messages."""
        if self.member is None:
            return self.part.name
        return self.member.key if self.part.name == WHOLE else f"{self.member.key} in {self.part.name}"


def pairs_of(
    rod: PhysicalRod, string: PhysicalString | None, hole: Hole, parts: Sequence[HolePart]
) -> tuple[Pair, ...]:
    """The pieces of a rod, from s = 0 up, as sections of the string and parts of the hole part it.

    Raises
    ------
    InputError
        Where a clearance cannot be told, or something does not fit into its hole.
    """
    members = [(None, 0.0, 1.0)] if string is None else [
        (one, *ends) for one, ends in zip(string.members, string.ends, strict=True)
    ]  # fmt: skip
    out = []
    for member, start, end in members:
        for part in parts:
            low, high = max(start, part.start), min(end, part.end)
            if high - low > EQUAL:
                one = rod if member is None else member.rod
                if member is not None and hole.clearance is None:
                    _refuse_tapering_clearance(member)
                inside = (low - part.start) / (part.end - part.start), (high - part.start) / (part.end - part.start)
                here = part if part.diameter is None else replace(part, diameter=within(part.diameter, *inside))
                out.append(Pair(low, high, member, part, _clearance(one, hole, member, here)))
    return tuple(out)


def reference(pairs: Sequence[Pair]) -> float:
    """The clearance that the others are ratios to, in m: that of the longest piece of one, the lowest of equals.

    Where it varies all along the rod, that at its lower end.
    """
    lengths = [(pair.end - pair.start, pair.clearance) for pair in pairs if isinstance(pair.clearance, float)]
    longest = max((length for length, _ in lengths), default=0.0)
    first = pairs[0].clearance
    at_bottom = first[0] if isinstance(first, tuple) else first
    return next((clearance for length, clearance in lengths if length >= longest - EQUAL), at_bottom)


def stepped(pairs: Sequence[Pair]) -> bool:
    """Whether there are several clearances, by steps or along the rod."""
    sizes = [size for pair in pairs for size in extremes(pair.clearance)[::2]]
    return max(sizes) - min(sizes) > EQUAL * max(sizes)


def sections_of(pairs: Sequence[Pair], string: PhysicalString | None) -> tuple[Section, ...]:
    """Sections of the problem, their clearances as ratios to the reference."""
    if not stepped(pairs):
        return () if string is None else string.sections
    unit, out = reference(pairs), []
    for pair in pairs:
        _, stiffness, weight, _, torsion = PLAIN[0]
        if string is not None and pair.member is not None:
            part = string.part_of(pair.member, np.array([pair.start, pair.end]))
            _, *ratios, _, torsion = string.sections[pair.member.place]
            stiffness, weight, torsion = (within(one, *map(float, part)) for one in (*ratios, torsion))
        clearance = pair.clearance
        ratio = tuple(one / unit for one in clearance) if isinstance(clearance, tuple) else clearance / unit
        out.append((pair.end - pair.start, stiffness, weight, ratio, torsion))
    return tuple(out)


def _refuse_tapering_clearance(member: Member) -> None:
    """Refuse a taper that the hole's diameter would give a clearance that tapers."""
    first, last = member.rods[0].outer_diameter, member.rods[-1].outer_diameter
    if first != last:
        what = "lets the clearance taper, which is not computed: give hole.clearance, one for all of the string, or "
        what += "leave outer_diameter as it is and let inner_diameter or core_diameter taper"
        raise InputError(f"{member.key}.outer_diameter{AT_TOP}", f"{last:g} m", what)


def _clearance(rod: PhysicalRod, hole: Hole, member: Member | None, part: HolePart) -> Ratio:
    """The clearance of a rod in a part of the hole."""
    of_rod = "rod" if member is None else member.key
    of_hole = part.name
    if hole.clearance is not None:
        if hole.diameter is not None:
            raise InputError("hole.clearance", None, "contradicts hole.diameter: give only one of the two")
        return hole.clearance
    if part.diameter is None:
        raise InputError("hole.diameter", None, "is missing: give it, or hole.clearance (from axis to axis)")
    outer = rod.outer_diameter
    if outer is None:
        raise InputError(f"{of_rod}.outer_diameter", None, "is missing: it is needed with hole.diameter")
    narrowest = extremes(part.diameter)[0]
    if outer < narrowest:
        if isinstance(part.diameter, tuple):
            return tuple(0.5 * (one - outer) for one in part.diameter)
        return 0.5 * (part.diameter - outer)
    if member is None:
        what = f"must be above the rod's outer diameter of {outer:g} m: the rod does not fit"
        at_top = isinstance(part.diameter, tuple) and part.diameter[-1] == narrowest
        raise InputError(f"{of_hole}.diameter{AT_TOP if at_top else ''}", narrowest, what)
    what = f"must be below the hole's diameter of {narrowest:g} m: the section does not fit"
    if of_hole != WHOLE:
        what = f"must be below the diameter of {of_hole} of {narrowest:g} m: the section does not fit"
    raise InputError(member.diameter_key, f"{outer:.6g} m", what)
