"""The dimensionless problem: what the mathematics needs, and nothing else."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.problem.checks import check
from rodwell.problem.ends import HOLD_ANGLE, OFF_WALL_ENDS
from rodwell.problem.hole import Hole
from rodwell.problem.lying import hung_from_end
from rodwell.problem.points import Rows
from rodwell.problem.profile import Ratio
from rodwell.problem.refusals import Refusals
from rodwell.problem.rod import Rod
from rodwell.problem.sections import COLUMNS, PLAIN, Section, seen_from_s_1


@dataclass(frozen=True)
class Problem(Refusals):
    """A heavy rod on a cylinder of any inclination.

    Units: bending stiffness B = 1, rod length L = 1; forces in B/L², moments in B/L, lengths in L. Tension is positive.

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
        adding up to 1, the others ratios to the data of the problem, 1 where left out; all of these may vary along
        the section, as two to five values at evenly spaced places of it, a polynomial. ``weight`` is that of a
        uniform rod of weight ratio 1, B, in which everything is measured, that of stiffness ratio 1, and ``torsion`` or
        ``poisson`` give C of torsion ratio 1. A clearance ratio that all share goes into ``clearance``; where it has
        steps the string bridges them, off the wall: :func:`rodwell.load_path` follows it until it buckles, and what is
        computed of rods that stay on the wall is refused. So does it where it begins to float: a section of negative
        weight ratio, beside others of positive ones, lies on the upper side; the ends stay at the bottom. Where the
        clearance varies without steps and kinks (:func:`rodwell.ramp`), there are loads, branches and load paths. In a
        hole that leaves the vertical plane all have one clearance and one sign of weight. None: a uniform rod.
    build, walk
        Curvature of the hole in 1/L, constant along it: ``build`` > 0 where it is concave upward, ``walk`` > 0 where it
        turns to the right, looking towards s = 0: see :class:`rodwell.problem.hole.Hole`. ``alpha`` is then the
        inclination at the middle of the undeformed rod.
    floats
        The rod is lighter than what surrounds it: ``weight`` acts upwards, and "bottom" is the side of the cylinder to
        which it is pressed, the upper one. Upside down it is a rod with its weight downwards at 180° − α.
    axis
        Points (x, y, z) of the hole's axis in L from s = 0 to s = 1, z vertically up, in place of ``build``, ``walk``;
        ``alpha`` is then taken from it. Or stations of ten numbers, arclength, direction and its two derivatives:
        :meth:`rodwell.problem.hole.Hole.through`.

    Notes
    -----
    Ends that are both clamped are (B2), (B4), (B7), (B8) of the paper; what an end does not hold is natural. The end
    force acts at s = 1, the upper end of a cylinder inclined by less than 90°, along the cylinder's axis; the axial
    resultant is N(s) = F + γ cos α (s − 1), or F − γ cos α ∫ₛ¹ (w/w₀) ds of sections. The end s = 0 bears what is left,
    whatever its condition. In a curved hole the end force acts along the tangent of the rod on the wall at s = 1.

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
    axis: Rows = ()
    floats: bool = False

    def __post_init__(self) -> None:
        check(self)

    @cached_property
    def given_hole(self) -> Hole | None:
        """The curved hole as it is in space; None: it is straight."""
        if self.build == self.walk == 0.0 and not self.axis:
            return None
        hole = Hole.through(self.axis) if self.axis else Hole.arc(self.alpha, self.build, self.walk)
        return None if hole.straight else hole

    @cached_property
    def hole(self) -> Hole | None:
        """The curved hole with the weight downwards: that of a rod that floats upside down. None: it is straight."""
        given = self.given_hole
        return given.upside_down if given is not None and self.floats else given

    @property
    def in_space(self) -> bool:
        """Whether the hole leaves the vertical plane: no rod lies on a straight generator of it."""
        return self.hole is not None and not self.hole.planar

    @cached_property
    def bridges(self) -> bool:
        """Whether a string leaves the wall: over steps of the clearance, or between sections that sink and float."""
        return bool(self.sections) and (self.rod.clearance_steps.size > 0 or self.rod.mixed)

    @property
    def bent(self) -> bool:
        """Whether a curved hole bends a string of sections: it is off the wall beside steps of its stiffness."""
        return bool(self.sections) and self.hole is not None

    @property
    def leaves_wall(self) -> bool:
        """Whether a string is off the wall before it buckles: where it bridges, or where a curved hole bends it."""
        return self.bridges or self.bent

    @property
    def ramps(self) -> bool:
        """Whether the clearance varies along sections, without steps and kinks."""
        return bool(self.sections) and self.rod.ramps

    @property
    def tapered(self) -> bool:
        """Whether stiffness, weight or torsion vary along a section."""
        return bool(self.sections) and self.rod.tapered

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

        Without weight and an end that holds y, y(0) is fixed, and the ends unequal; as where weight finds them on two
        sides. An arc is such a hole, level or without weight; out of the vertical plane by y(s) → y(1 − s) only.
        """
        loose = self.lateral_weight == 0.0 and not self.holds_angle
        if self.hole is not None:
            alike = self.ends[0] == self.ends[1] and self.rod.symmetric
            return not self.axis and self.axial_weight == 0.0 and alike
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
        if self.hole is None:
            return self.axial_weight * self.rod.whole_weight if self.sections else self.axial_weight
        if self.axial_weight == 0.0 and not self.axis and self.rod.symmetric:
            return 0.0  # a level arc is alike from both ends
        reach = -self.clearance if self.on_top else self.clearance
        return self.weight * hung_from_end(self.hole, reach, self.rod.weight)

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
        if self.sections and self.rod.mixed:
            return float(np.max(-self.axial_weight * self.rod.lever(self.rod.breaks)))
        return max(self.hung_weight, 0.0)

    @property
    def turned_round(self) -> Problem:
        """The same rod seen from its other end, y(s) → ± y(1 − s): inclination 180° − α, ends exchanged.

        Its end force, which acts at the other end, is F − wₐ (of sections, less their axial weight). Of a coil it is
        also the mirror image, so that it winds in the same sense; with half a turn over, it begins on the other side.
        """
        on_top = self.on_top != ((2.0 * self.turns) % 2.0 == 1.0)
        return self.but(
            alpha=180.0 - self.alpha, ends=self.ends[::-1], sections=seen_from_s_1(self.sections), on_top=on_top
        )

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
        return self.torsional_stiffness / self.rod.twisting_compliance

    @property
    def given_more(self) -> dict[str, float | list[Ratio]]:
        """What was given besides, by name: C/B where it does not follow from ν, and each column of the sections."""
        out: dict[str, float | list[Ratio]] = {} if self.torsion is None else {"torsion": self.torsion}
        if self.sections:
            columns = zip(*self.sections, strict=True)
            out |= {f"section_{name}": list(column) for name, column in zip(COLUMNS, columns, strict=True)}
        return out | {name: getattr(self, name) for name in ("build", "walk") if getattr(self, name) != 0.0}

    @property
    def attributes(self) -> dict[str, Any]:
        """The same as attributes of labelled arrays, which hold numbers, lists of them and text: tapers as JSON."""
        given = self.given_more
        tapers = {name for name, one in given.items() if isinstance(one, list) and tuple in map(type, one)}
        return {name: json.dumps(one) if name in tapers else one for name, one in given.items()}

    def differences(self, other: Problem) -> str:
        """What differs in another problem, in words: names, its value, and that of this one."""
        names = [field.name for field in fields(self) if getattr(self, field.name) != getattr(other, field.name)]
        return ", ".join(f"{name} = {getattr(other, name)!r} there, {getattr(self, name)!r} here" for name in names)

    def but(self, **changes: Any) -> Problem:
        """Return this problem with some values changed."""
        return Problem(**{name: getattr(self, name) for name in NAMES} | changes)


NAMES = tuple(field.name for field in fields(Problem))  # of what makes a problem
