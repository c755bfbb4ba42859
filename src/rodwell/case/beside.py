"""What lies beside what: sections of a string in parts of a hole, with the clearance of each pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rodwell.case.hole.schema import Hole
from rodwell.case.hole.sections import WHOLE, HolePart
from rodwell.case.pipe import PhysicalRod
from rodwell.case.string.sections import Member, PhysicalString
from rodwell.case.string.tapers import AT_TOP
from rodwell.errors import InputError
from rodwell.problem.profile import within
from rodwell.problem.sections import PLAIN, Section

EQUAL = 1e-9
"""Relative difference of clearances, and difference of places in L, that counts as none."""


@dataclass(frozen=True)
class Pair:
    """A piece of the rod between steps, s/L: the section of the string (None: the rod is one), the part of the hole.

    ``clearance`` is from axis to axis, in m.
    """

    start: float
    end: float
    member: Member | None
    part: HolePart
    clearance: float

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
                out.append(Pair(low, high, member, part, _clearance(one, hole, member, part)))
    return tuple(out)


def reference(pairs: Sequence[Pair]) -> float:
    """The clearance that the others are ratios to, in m: that of the longest piece, the lowest of equals."""
    longest = max(pair.end - pair.start for pair in pairs)
    return next(pair.clearance for pair in pairs if pair.end - pair.start >= longest - EQUAL)


def stepped(pairs: Sequence[Pair]) -> bool:
    """Whether the clearance has steps."""
    sizes = [pair.clearance for pair in pairs]
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
        out.append((pair.end - pair.start, stiffness, weight, pair.clearance / unit, torsion))
    return tuple(out)


def _refuse_tapering_clearance(member: Member) -> None:
    """Refuse a taper that the hole's diameter would give a clearance that tapers."""
    first, last = member.rods[0].outer_diameter, member.rods[-1].outer_diameter
    if first != last:
        what = "lets the clearance taper, which is not computed: give hole.clearance, one for all of the string, or "
        what += "leave outer_diameter as it is and let inner_diameter or core_diameter taper"
        raise InputError(f"{member.key}.outer_diameter{AT_TOP}", f"{last:g} m", what)


def _clearance(rod: PhysicalRod, hole: Hole, member: Member | None, part: HolePart) -> float:
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
    if outer < part.diameter:
        return 0.5 * (part.diameter - outer)
    if member is None:
        what = f"must be above the rod's outer diameter of {outer:g} m: the rod does not fit"
        raise InputError(f"{of_hole}.diameter", part.diameter, what)
    what = f"must be below the hole's diameter of {part.diameter:g} m: the section does not fit"
    if of_hole != WHOLE:
        what = f"must be below the diameter of {of_hole} of {part.diameter:g} m: the section does not fit"
    raise InputError(member.diameter_key, f"{outer:.6g} m", what)
