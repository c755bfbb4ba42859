"""The rod along s: the profiles that follow from its sections."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.problem.profile import Profile, Ratio, ReciprocalIntegral, along, extremes, integral_from_1, powers, reach
from rodwell.problem.sections import COLUMNS, PLAIN, Section, seen_from_s_1
from rodwell.quantities.arrays import BoolArray, FloatArray

EQUAL_LENGTHS = 1e-12
"""Lengths that differ by less count as equal."""

SMOOTH = 1e-12
"""Kinks of the stiffness below this part of the largest stiffness over a section's length are round-off."""


@dataclass(frozen=True)
class Rod:
    """A rod of sections: B, C and weight as ratios, constant or a polynomial in each section, with jumps between them.

    Attributes
    ----------
    sections
        Without neighbours that are alike: a rod of one section is uniform.
    """

    sections: tuple[Section, ...]

    @cached_property
    def breaks(self) -> FloatArray:
        """Ends of the sections, from 0 to 1, (n + 1,), to fifteen digits: 0.3 + 0.4 is 0.7."""
        ends = np.cumsum([section[0] for section in self.sections])
        return np.concatenate([[0.0], np.round(ends[:-1] / ends[-1], 15), [1.0]])

    def _ratios(self, which: int) -> FloatArray:
        return np.array([section[which] for section in self.sections])

    @cached_property
    def tapered(self) -> bool:
        """Whether stiffness, weight or torsion vary along a section."""
        return any(isinstance(section[k], tuple) for section in self.sections for k in (1, 2, 4))

    @cached_property
    def ramps(self) -> bool:
        """Whether the clearance varies along a section."""
        return any(isinstance(section[3], tuple) for section in self.sections)

    def tapers(self, ratio: str) -> BoolArray:
        """In which sections a ratio, one of :data:`rodwell.problem.sections.RATIOS`, varies, (n,)."""
        which = COLUMNS.index(ratio)
        return np.array([isinstance(section[which], tuple) for section in self.sections])

    def _profile(self, which: int) -> Profile:
        if self.tapered:
            return along(self.breaks, [section[which] for section in self.sections])
        return Profile(self.breaks, self._ratios(which)[:, None])

    @cached_property
    def stiffness(self) -> Profile:
        """B(s)/B."""
        return self._profile(1)

    @cached_property
    def ranges(self) -> dict[str, FloatArray]:
        """The least and the largest value in each section of each ratio, (2, n)."""
        each = {name: [extremes(section[k])[::2] for section in self.sections] for k, name in enumerate(COLUMNS)}
        return {name: np.transpose(pairs).astype(np.float64) for name, pairs in each.items()}

    @cached_property
    def sizes_of_weight(self) -> FloatArray:
        """The largest size of w(s)/w in each section, (n,), whichever way it acts."""
        return np.asarray(np.max(np.abs(self.ranges["weight"]), axis=0))

    @cached_property
    def _signs_of_weight(self) -> FloatArray:
        """Of each section 1, −1 where it floats, or 0, (n,)."""
        least, most = self.ranges["weight"]
        return np.where(most > 0.0, 1.0, np.where(least < 0.0, -1.0, 0.0))

    @cached_property
    def mixed(self) -> bool:
        """Whether weight acts downwards in some sections and upwards in others, which float."""
        return bool(np.min(self._signs_of_weight) < 0.0 < np.max(self._signs_of_weight))

    @cached_property
    def sign_changes(self) -> FloatArray:
        """Where the weight changes its sign, or begins or ends to be none, (k,), in L."""
        signs = self._signs_of_weight
        return np.asarray(self.breaks[1:-1][signs[1:] != signs[:-1]])

    @cached_property
    def stiffness_reach(self) -> FloatArray:
        """How far each section is from where its polynomial of the stiffness vanishes in the complex plane, (n,), in L.

        A polynomial of the shape converges the faster, the shorter its element is against that.
        """
        return np.asarray(np.diff(self.breaks) * np.array([reach(section[1]) for section in self.sections]))

    @cached_property
    def stiffness_range(self) -> tuple[float, float]:
        """The least and the largest B(s)/B."""
        least, most = self.ranges["stiffness"]
        return float(np.min(least)), float(np.max(most))

    @cached_property
    def weight(self) -> Profile:
        """w(s)/w."""
        return self._profile(2)

    @cached_property
    def torsion(self) -> Profile:
        """C(s)/C."""
        return self._profile(4)

    @cached_property
    def clearance(self) -> Profile:
        """Δ(s)/Δ, of the hole beside each section."""
        if self.ramps:
            return along(self.breaks, [section[3] for section in self.sections])
        return Profile(self.breaks, self._ratios(3)[:, None])

    @cached_property
    def clearance_steps(self) -> FloatArray:
        """Where the clearance has a step, (k,), in L: the string bridges it, off the wall. Where it varies: nowhere."""
        if self.ramps:
            return np.zeros(0)
        clearance = self._ratios(3)
        return np.asarray(self.breaks[1:-1][clearance[1:] != clearance[:-1]])

    @cached_property
    def turned(self) -> Profile | ReciprocalIntegral:
        """∫₀ˢ ds/(C(s)/C), in L: how far a torque along the whole rod has turned it, over what it turns C by in L."""
        if self.tapered:
            return ReciprocalIntegral(self.torsion)
        softness = 1.0 / self._ratios(4)
        below = np.concatenate([[0.0], np.cumsum(softness * np.diff(self.breaks))[:-1]])
        return Profile(self.breaks, np.stack([below - softness * (self.breaks[:-1] - 1.0), softness], axis=1))

    @cached_property
    def lever(self) -> Profile:
        """h(s) = −∫ₛ¹ w(s)/w ds, in L: the axial resultant is N(s) = F + wₐ h(s).

        In a section of one weight it is d + (w/w₀)(s − 1): that of a uniform rod of this section, with another end
        force F + wₐ d.
        """
        if self.tapered:
            return integral_from_1(self.weight)
        weight = self._ratios(2)
        hung = weight * np.diff(self.breaks)
        above = np.concatenate([np.cumsum(hung[::-1])[::-1][1:], [0.0]])  # weight of the sections above each
        offset = -above - weight * (self.breaks[1:] - 1.0)
        offset[-1] = 0.0
        return Profile(self.breaks, np.stack([offset, weight], axis=1))

    @cached_property
    def stiffness_sides(self) -> FloatArray:
        """B(s)/B on both sides of each step between sections, towards s = 0 and towards s = 1, (2, n − 1)."""
        before, after = ([_at(section[1], end) for section in self.sections] for end in (-1, 0))
        return np.array([before[:-1], after[1:]])

    @cached_property
    def stiffness_rate_sides(self) -> FloatArray:
        """The same of its derivative by s, (2, n − 1); what differs by round-off is one."""
        sides = self.stiffness.derivative.sides
        steepest = self.stiffness_range[1] / np.diff(self.breaks)
        alike = np.abs(sides[1] - sides[0]) <= SMOOTH * np.maximum(steepest[1:], steepest[:-1])
        return np.where(alike, np.mean(sides, axis=0), sides)

    @cached_property
    def stiffness_steps(self) -> FloatArray:
        """Where the bending stiffness has a step, (k,), in L."""
        before, after = self.stiffness_sides
        return np.asarray(self.breaks[1:-1][after != before])

    @cached_property
    def steps_of_stiffness_alone(self) -> FloatArray:
        """Those of them where neither the clearance has one nor the weight changes its sign, (k,), in L."""
        return np.setdiff1d(self.stiffness_steps, np.union1d(self.clearance_steps, self.sign_changes))

    @cached_property
    def stiffness_breaks(self) -> BoolArray:
        """At which ends of sections within the rod the bending stiffness has a step or a kink, (n − 1,)."""
        sides = self.stiffness_sides, self.stiffness_rate_sides
        return np.asarray(np.any([below != above for below, above in sides], axis=0), dtype=bool)

    @property
    def stepped(self) -> bool:
        """Whether the bending stiffness has a step: a buckled rod stays on the wall there only if its slope is held."""
        return self.stiffness_steps.size > 0

    @cached_property
    def kinked(self) -> bool:
        """Whether the bending stiffness begins to fall, or ceases to rise, without a step: the wall would have to pull.

        A buckled rod stays on the wall there only if it is held to it.
        """
        return bool(np.any(self.stiffness_kink_sizes < 0.0))

    @cached_property
    def stiffness_kink_sizes(self) -> FloatArray:
        """By how much the derivative of B(s)/B jumps at ends of sections, (n − 1,), in 1/L; 0 where B itself does."""
        if not self.tapered:
            return np.zeros(len(self.sections) - 1)
        (below, above), (rate, next_rate) = self.stiffness_sides, self.stiffness_rate_sides
        return np.where(below == above, next_rate - rate, 0.0)

    def falls_within(self, left: float, right: float) -> FloatArray:
        """Kinks from one place to another at which the bending stiffness begins to fall, or ceases to rise, in L."""
        places = self.breaks[1:-1][self.stiffness_kink_sizes < 0.0]
        return np.asarray(places[(places >= left) & (places <= right)])

    @cached_property
    def whole_weight(self) -> float:
        """∫ w(s)/w ds: weight of the whole, as a ratio to that of a uniform rod."""
        if self.tapered:
            return -float(self.lever(np.zeros(1))[0])
        return float(self._ratios(2) @ np.diff(self.breaks))

    @cached_property
    def compliance(self) -> float:
        """∫ ds/(B(s)/B): how much more the rod bends under a moment that is the same everywhere."""
        if self.tapered:
            return float(ReciprocalIntegral(self.stiffness)(np.ones(1))[0])
        return float(np.diff(self.breaks) @ (1.0 / self._ratios(1)))

    @cached_property
    def twisting_compliance(self) -> float:
        """∫ ds/(C(s)/C)."""
        if self.tapered:
            return float(self.turned(np.ones(1))[0])
        return float(sum(section[0] / ratio for section, ratio in zip(self.sections, self._ratios(4), strict=True)))

    @cached_property
    def symmetric(self) -> bool:
        """Whether the rod is the same seen from either end."""
        mirrored = seen_from_s_1(self.sections)
        alike = all(a[1:] == b[1:] for a, b in zip(self.sections, mirrored, strict=True))
        return alike and bool(np.max(np.abs(self.breaks + self.breaks[::-1] - 1.0)) <= EQUAL_LENGTHS)

    @property
    def plain(self) -> bool:
        """Whether it is the uniform rod that everything is a ratio to."""
        return self.sections == PLAIN


def _at(ratio: Ratio, end: int) -> float:
    """A ratio at the lower (0) or upper (−1) end of its section."""
    return ratio[end] if isinstance(ratio, tuple) else ratio


def lower_half(sections: tuple[Section, ...]) -> tuple[Section, ...]:
    """Sections of the half from s = 0 to ½, with lengths in its own length."""
    breaks, out = Rod(sections).breaks if sections else np.array([0.0]), []
    for i in (i for i in range(len(sections)) if breaks[i] < 0.5):
        length = min(float(breaks[i + 1]), 0.5) - float(breaks[i])
        _, stiffness, weight, clearance, torsion = sections[i]
        part = length / float(breaks[i + 1] - breaks[i])
        ratios = stiffness, weight, clearance, torsion
        b, q, d, c = ratios if part == 1.0 else (_first_part(ratio, part) for ratio in ratios)
        out.append((2.0 * length, b, q, d, c))
    return tuple(out)


def _first_part(ratio: Ratio, part: float) -> Ratio:
    """A ratio in so much of its section, from the lower end."""
    if isinstance(ratio, float):
        return ratio
    found = np.polynomial.Polynomial(powers(ratio))
    return tuple(map(float, found(part * np.linspace(0.0, 1.0, len(ratio)))))
