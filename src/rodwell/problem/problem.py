"""The dimensionless problem: what the mathematics needs, and nothing else."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

from rodwell.errors import InputError, InputWarning, checked_number
from rodwell.problem.ends import HOLD_ANGLE, OFF_WALL_ENDS, checked_ends, refuse_off_wall
from rodwell.problem.hole import Hole, Points, checked_points
from rodwell.problem.lying import rise_of_lying_rod
from rodwell.problem.rod import COLUMNS, PLAIN, Rod, Section, checked_sections

LARGEST_WEIGHT = 1e9
LARGEST_TWIST = 1e4
LARGEST_TURNS = 1000
TURNS_ALLOWED = f"from -{LARGEST_TURNS} to {LARGEST_TURNS} turns of the end s = 1, whole or not"
SMALLEST_CLEARANCE = 1e-7
SMALLEST_TORSION, LARGEST_TORSION = 1e-6, 1e6


LIMITS = {
    "weight": (0.0, LARGEST_WEIGHT, f"from 0 to {LARGEST_WEIGHT:g}, γ = mg L³/B"),
    "alpha": (0.0, 180.0, "from 0 (vertical) over 90 (horizontal) to 180 (s = 1 below), in degrees"),
    "clearance": (0.0, 1.0, "above 0 and below 1: Δ/L, a part of the length"),
    "poisson": (-1.0, 0.5, "above -1 and at most 0.5"),
    "torsion": (SMALLEST_TORSION, LARGEST_TORSION, f"from {SMALLEST_TORSION:g} to {LARGEST_TORSION:g}, C/B"),
    "twist": (-LARGEST_TWIST, LARGEST_TWIST, f"from -{LARGEST_TWIST:g} to {LARGEST_TWIST:g}, in B/L"),
}
"""Lowest and highest value of each number, and what is allowed in words."""


RADIANS = tuple(math.radians(degrees) for degrees in (15, 30, 45, 60, 75, 80, 85, 89, 90))
"""Inclinations that are asked back, since they are round in degrees if they are meant in radians."""

STEEP = 1.01 * max(RADIANS)
"""No angle above is one of them: curves make thousands of problems."""


def ends_text(problem: Problem, words: Mapping[str, str] | None = None) -> str:
    """End conditions in words: names, or what ``words`` says of each; how many sections, and whether the rod floats."""
    first, last = (words[end] if words else end for end in problem.ends)
    ends = f"both ends {first}" if first == last else f"end s = 0 {first}, end s = 1 {last}"
    ends += f", string of {len(problem.sections)} sections" if problem.sections else ""
    return f"{ends}, rod floats: pressed to the upper side" if problem.floats else ends


@dataclass(frozen=True)
class Problem:
    """A heavy rod on a cylinder of any inclination.

    Units: bending stiffness B = 1 and rod length L = 1. Forces are in B/L², moments in B/L, lengths in L.
    Tension is positive.

    Parameters
    ----------
    weight
        γ = mg L³/B ≥ 0, weight of the whole rod (paper, section 4).
    alpha
        Angle α between the cylinder and the vertical in degrees, 0 (vertical, s = 1 above) over 90 (horizontal) to 180
        (vertical, s = 1 below). Seen from its other end, a rod has 180° − α and its ends exchanged.
    clearance
        Δ/L, distance between the axes of rod and cylinder, 0 < Δ < 1.
    poisson
        Poisson's ratio ν, which sets the torsional stiffness C/B = 1/(1 + ν) of a round rod of one material;
        −1 < ν ≤ 0.5.
    twist
        Dead end twisting moment T₁ in B/L.
    turns
        Turns n of the end s = 1 around the cylinder: ξ₂(1) = ξ₂(0) + 2πn. 0 in the paper. Of whole turns the ends stand
        where they do without any; with n + ½ the end s = 1 is held on the opposite side of the cylinder.
    on_top
        The rod lies on top of the cylinder, ξ₂(0) = π (paper, section 4.3), not at the bottom.
    outside
        The rod lies on the outside of the cylinder: contact asks p > 0.
    ends
        End conditions at s = 0 and s = 1: two of "clamped" (y and y' held), "pinned" (y held), "guided" (y' held: the
        end slides around the wall) and "free" (none). A text like "clamped-pinned" will do. These ends are radially
        held: x and x' too. "ball" (x, y held) and "loose" (nothing held) are for critical loads of the straight rod
        and for load paths only, since the rod leaves the wall there as soon as it buckles.
    torsion
        C/B as measured, for shafts that are not round rods of one material (braided, coiled, slotted); ``poisson`` then
        has no effect. None: that of ``poisson``.
    sections
        A string of sections from s = 0: (length, stiffness, weight, clearance, torsion) of each, the lengths in L,
        adding up to 1, the others ratios to the data of the problem, 1 where left out. ``weight`` is then that of a
        uniform rod of weight ratio 1, B, in which everything is measured, that of stiffness ratio 1, and ``torsion`` or
        ``poisson`` give C of torsion ratio 1. A clearance ratio that all share goes into ``clearance``; where it has
        steps the string bridges them, off the wall: :func:`rodwell.load_path` follows it until it buckles, and what is
        computed of rods that stay on the wall is refused. None given: a uniform rod.
    build, walk
        Curvature of the hole in 1/L, constant along it: ``build`` > 0 where it is concave upward, ``walk`` > 0 where it
        turns to the right, looking towards s = 0: see :class:`rodwell.problem.hole.Hole`. ``alpha`` is then the
        inclination at the middle of the undeformed rod.
    floats
        The rod is lighter than what surrounds it: ``weight`` acts upwards, and "bottom" is the side of the cylinder to
        which it is pressed, the upper one. Upside down it is a rod with its weight downwards at 180° − α.
    axis
        Points (x, y, z) of the hole's axis in L from s = 0 to s = 1, z vertically up, in place of ``build``, ``walk``;
        ``alpha`` is then taken from it.

    Notes
    -----
    With both ends clamped they are (B2), (B4), (B7), (B8) of the paper; what an end does not hold is natural. The
    end force acts at s = 1, the upper end of a cylinder inclined by less than 90°, along the cylinder's axis; the axial
    resultant is N(s) = F + γ cos α (s − 1), or F − γ cos α ∫ₛ¹ (w/w₀) ds of sections. The end s = 0 bears what is left
    of it, whatever its condition. In a curved hole the end force acts along the tangent of the rod on the wall at
    s = 1.

    Raises
    ------
    InputError
        For values outside the ranges above, NaN and infinities included, and for combinations that make no sense.
    """

    weight: float
    alpha: float = 90.0
    clearance: float = 0.01
    poisson: float = 0.3
    twist: float = 0.0
    turns: float = 0
    on_top: bool = False
    outside: bool = False
    ends: tuple[str, str] = ("clamped", "clamped")
    torsion: float | None = None
    sections: tuple[Section, ...] = ()
    build: float = 0.0
    walk: float = 0.0
    axis: Points = ()
    floats: bool = False

    def __post_init__(self) -> None:
        if isinstance(self.weight, int | float) and self.weight < 0.0:
            reason = f"must be {LIMITS['weight'][2]}: for a rod that floats give {-self.weight:g} and floats=True"
            raise InputError("weight", self.weight, reason)
        for name, (low, high, allowed) in LIMITS.items():
            value = getattr(self, name)
            if (type(value) is float and low <= value <= high) or (name == "torsion" and value is None):
                continue  # mostly: curves make thousands of problems
            object.__setattr__(self, name, checked_number(name, value, low, high, allowed))
        turns = checked_number("turns", self.turns, -LARGEST_TURNS, LARGEST_TURNS, TURNS_ALLOWED)
        object.__setattr__(self, "turns", int(turns) if turns.is_integer() else turns)
        for flag in ("on_top", "outside", "floats"):
            if not isinstance(getattr(self, flag), bool):
                raise InputError(flag, getattr(self, flag), "must be True or False")
        object.__setattr__(self, "ends", checked_ends(self.ends))
        object.__setattr__(self, "sections", checked_sections(self.sections))
        if self.sections:
            self._take_clearance()
        if not SMALLEST_CLEARANCE <= self.clearance < 1.0:
            allowed = f"must be above 0 and below 1: Δ/L, a part of the length (at least {SMALLEST_CLEARANCE:g})"
            raise InputError("clearance", self.clearance, allowed)
        if self.poisson == -1.0:
            raise InputError("poisson", self.poisson, "must be above -1 and at most 0.5")
        if abs(self.rise) >= 1.0:
            raise InputError(
                "turns", self.turns, f"a rod of this length cannot wind around so often at clearance {self.clearance:g}"
            )
        self._check_ends()
        if self.build != 0.0 or self.walk != 0.0 or len(self.axis) > 0:
            self._check_hole()
        elif not isinstance(self.axis, tuple):
            object.__setattr__(self, "axis", ())
        if self.alpha < STEEP and any(math.isclose(self.alpha, angle, rel_tol=1e-9) for angle in RADIANS):
            degrees = math.degrees(self.alpha)
            warnings.warn(
                f"alpha = {self.alpha:.6g} is taken in degrees, nearly vertical; for {self.alpha:.6g} rad give "
                f"{degrees:.6g}",
                InputWarning,
                stacklevel=3,
            )

    def _take_clearance(self) -> None:
        """Take a clearance ratio that all sections share into the clearance, and check those of the others."""
        ratios = [section[3] for section in self.sections]
        if min(ratios) == max(ratios) != 1.0:
            object.__setattr__(self, "clearance", self.clearance * ratios[0])
            same = [(*section[:3], 1.0, section[4]) for section in self.sections]
            object.__setattr__(self, "sections", checked_sections(same))
            return
        for number, ratio in enumerate(ratios, 1):
            if not SMALLEST_CLEARANCE <= ratio * self.clearance < 1.0:
                what = f"makes its clearance {ratio * self.clearance:g} L: must be above 0 and below 1, a part of the "
                what += f"rod's length (at least {SMALLEST_CLEARANCE:g})"
                raise InputError(f"section {number}, clearance", ratio, what)

    def _check_ends(self) -> None:
        """Refuse what the ends cannot hold."""
        ends = "-".join(self.ends)
        untwisted = [end for end in self.ends if end in ("free", "loose")]
        if self.twist != 0.0 and untwisted:
            reason = f"a {untwisted[0]} end takes no torque: twist must be 0 with ends {ends}"
            raise InputError("twist", self.twist, reason)
        if self.turns != 0 and not (self.ends[0] in HOLD_ANGLE and self.ends[1] in HOLD_ANGLE):
            raise InputError("turns", self.turns, f"ends {ends} let the rod unwind: clamp or pin both")
        if self.on_top and self.lateral_weight > 0.0 and not self.holds_angle:
            raise InputError("ends", ends, "nothing keeps the rod on top: clamp or pin at least one end")

    def _check_hole(self) -> None:
        """Take the axis of a curved hole, and refuse what goes with a straight one only."""
        if len(self.axis) > 0:
            if self.build != 0.0 or self.walk != 0.0:
                name = "build" if self.build != 0.0 else "walk"
                raise InputError(name, getattr(self, name), "must be left out where axis gives the hole")
            object.__setattr__(self, "axis", checked_points(self.axis))
            hole = Hole.through(self.axis)
            if self.alpha not in (90.0, hole.alpha):
                reason = f"must be left out: axis has the inclination {hole.alpha:.10g} degrees at mid-length"
                raise InputError("alpha", self.alpha, reason)
            object.__setattr__(self, "alpha", hole.alpha)
        else:
            hole = Hole.arc(self.alpha, self.build, self.walk)
            object.__setattr__(self, "build", hole.build)
            object.__setattr__(self, "walk", hole.walk)
        hole.check(self.clearance)
        if hole.straight:
            return
        if self.floats:
            raise InputError(
                "floats", True, "must be False in a curved hole: rods that float are computed in straight ones"
            )
        refuse_off_wall(self.ends, "the states of a rod in a curved hole")
        if self.turns != 0:
            raise InputError("turns", self.turns, "must be 0 in a curved hole: coils are computed in straight ones")
        if self.sections:
            why = "are computed in straight holes: give a uniform rod, or leave build, walk and axis out"
            raise InputError("sections", f"{len(self.sections)} of them", why)

    @cached_property
    def hole(self) -> Hole | None:
        """The curved hole; None: it is straight."""
        if self.build == self.walk == 0.0 and not self.axis:
            return None
        hole = Hole.through(self.axis) if self.axis else Hole.arc(self.alpha, self.build, self.walk)
        return None if hole.straight else hole

    def refuse_curved(self, what: str) -> None:
        """Raise in a curved hole: ``what`` is computed in straight ones."""
        if self.hole is not None:
            name = "axis" if self.axis else "build" if self.build != 0.0 else "walk"
            value = f"{len(self.axis)} points" if self.axis else getattr(self, name)
            raise InputError(name, value, f"must be left out: {what} in straight holes only")

    @cached_property
    def bridges(self) -> bool:
        """Whether the clearance has steps, over which a string leaves the wall."""
        return bool(self.sections) and self.rod.clearance_steps.size > 0

    def refuse_bridges(self, what: str) -> None:
        """Raise where the clearance has steps: ``what`` are computed of rods that stay on the wall."""
        if self.bridges:
            ratios = " + ".join(f"{section[3]:g}" for section in self.sections[:6])
            raise InputError(
                "sections", f"clearance ratios {ratios}" + (" + …" if len(self.sections) > 6 else ""),
                f"must have one clearance: {what} are those of a rod that stays on the wall, and a string bridges "
                "steps of the clearance, off the wall. How it lies there, and when it buckles: `rodwell run` "
                "of a case; `rodwell path`, `rodwell critical`, rodwell.load_path",
            )  # fmt: skip

    @property
    def holds_angle(self) -> bool:
        """Whether an end holds y, the place around the cylinder."""
        return self.ends[0] in HOLD_ANGLE or self.ends[1] in HOLD_ANGLE

    @property
    def isotropic_ends(self) -> bool:
        """Whether both ends hold all lateral directions alike: clamped, or ends that only a rod off the wall has."""
        return all(end == "clamped" or end in OFF_WALL_ENDS for end in self.ends)

    @property
    def symmetric(self) -> bool:
        """Whether the problem is the same seen from either end: equal ends, no axial weight, sections alike.

        A weightless rod without an end that holds y has y(0) fixed instead, which makes the ends unequal. So does
        weight where the end s = 1 has not come round to the side of the other. An arc is such a hole, level or
        without weight; where it leaves the vertical plane, only y(s) → y(1 − s) leaves it as it is.
        """
        loose = self.lateral_weight == 0.0 and not self.holds_angle
        if self.hole is not None:
            return not self.axis and self.axial_weight == 0.0 and self.ends[0] == self.ends[1]
        if self.axial_weight != 0.0 or self.ends[0] != self.ends[1] or loose or not self.same_sides:
            return False
        return not self.sections or self.rod.symmetric

    @property
    def same_sides(self) -> bool:
        """Whether weight does the same to both ends: they lie on one side of the cylinder, or it does not press."""
        return isinstance(self.turns, int) or self.lateral_weight == 0.0

    @property
    def pressed(self) -> bool:
        """Whether lateral weight presses the straight rod on the wall: at the bottom inside, or outside on top."""
        return self.lateral_weight > 0.0 and self.on_top == self.outside

    @property
    def untouched(self) -> bool:
        """Whether nothing presses the straight rod to the wall: no lateral weight, nor a curve of the hole."""
        return self.lateral_weight == 0.0 and self.hole is None

    @cached_property
    def rod(self) -> Rod:
        """Stiffness and weight along s."""
        return Rod(self.sections or PLAIN)

    @cached_property
    def hung_weight(self) -> float:
        """F − N(0), the axial weight of the whole rod: γ cos α of a uniform one, γ times its rise in a curved hole."""
        if self.hole is not None and self.axial_weight == 0.0 and not self.axis:
            return 0.0  # a level arc is alike from both ends
        if self.hole is not None:
            return self.weight * rise_of_lying_rod(self.hole, -self.clearance if self.on_top else self.clearance)
        return self.axial_weight * self.rod.whole_weight if self.sections else self.axial_weight

    @property
    def axial_weight(self) -> float:
        """wₐ = γ cos α, exactly zero for a horizontal cylinder; negative where the end s = 1 is the lower one.

        Of a rod that floats −γ cos α. Of sections, that of weight ratio 1.
        """
        if self.alpha == 90.0:
            return 0.0
        # exactly what it is for 180° − α, but for the sign
        size = self.weight * math.cos(math.radians(min(self.alpha, 180.0 - self.alpha)))
        return -size if (self.alpha > 90.0) != self.floats else size

    @property
    def lateral_weight(self) -> float:
        """wₗ = γ sin α, exactly zero for a vertical cylinder; the sense of ξ₂ is in :attr:`foundation`.

        Of sections, that of weight ratio 1.
        """
        return self.weight * math.sin(math.radians(min(self.alpha, 180.0 - self.alpha)))

    @property
    def heaviest(self) -> float:
        """Max wₐ, 0: by how much compression may be larger somewhere along the rod than at s = 1."""
        return max(self.hung_weight, 0.0)

    @property
    def turned_round(self) -> Problem:
        """The same rod seen from its other end, y(s) → ± y(1 − s): inclination 180° − α, ends exchanged.

        Its end force, which acts at the other end, is F − wₐ (of sections, less their axial weight). Of a coil it is
        also the mirror image, so that it winds in the same sense; with half a turn over, it begins on the other side.
        """
        on_top = self.on_top != ((2.0 * self.turns) % 2.0 == 1.0)
        return self.but(alpha=180.0 - self.alpha, ends=self.ends[::-1], sections=self.sections[::-1], on_top=on_top)

    @property
    def foundation(self) -> float:
        """wₗ with the sign of its effect: negative for a rod on top, where weight helps buckling."""
        return -self.lateral_weight if self.on_top else self.lateral_weight

    @property
    def rise(self) -> float:
        """2πnΔ, how far around the cylinder the end s = 1 of a coiled rod lies from the end s = 0, in L."""
        return 2.0 * math.pi * self.turns * self.clearance

    @property
    def torsional_stiffness(self) -> float:
        """C/B: ``torsion``, or 1/(1 + ν)."""
        return 1.0 / (1.0 + self.poisson) if self.torsion is None else self.torsion

    @property
    def whole_torsion(self) -> float:
        """Torsional stiffness of the whole straight rod, whose end s = 1 turns by T₁ over it: C, or 1/∫ ds/C(s)."""
        if not self.sections:
            return self.torsional_stiffness
        return self.torsional_stiffness / sum(length / torsion for length, *_, torsion in self.sections)

    @property
    def given_more(self) -> dict[str, float | list[float]]:
        """What was given besides, by name: C/B where it does not follow from ν, and each column of the sections."""
        out: dict[str, float | list[float]] = {} if self.torsion is None else {"torsion": self.torsion}
        if self.sections:
            columns = zip(*self.sections, strict=True)
            out |= {f"section_{name}": list(column) for name, column in zip(COLUMNS, columns, strict=True)}
        return out | {name: getattr(self, name) for name in ("build", "walk") if getattr(self, name) != 0.0}

    def differences(self, other: Problem) -> str:
        """What differs in another problem, in words: names, its value, and that of this one."""
        names = [field.name for field in fields(self) if getattr(self, field.name) != getattr(other, field.name)]
        return ", ".join(f"{name} = {getattr(other, name)!r} there, {getattr(self, name)!r} here" for name in names)

    def but(self, **changes: Any) -> Problem:
        """Return this problem with some values changed."""
        return replace(self, **changes)
