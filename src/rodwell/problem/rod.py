"""The rod along s: sections of a string, checked, and the profiles that follow from them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.errors import InputError, checked_number
from rodwell.problem.profile import (
    MOST_VALUES,
    Profile,
    Ratio,
    ReciprocalIntegral,
    along,
    extremes,
    integral_from_1,
    powers,
)
from rodwell.quantities.arrays import BoolArray, FloatArray

Section = tuple[float, Ratio, Ratio, float, Ratio]
"""Length in L, and ratios to the problem's data: bending stiffness, weight, clearance, torsional stiffness."""

RATIOS = ("stiffness", "weight", "clearance", "torsion")
COLUMNS = ("length", *RATIOS)
SMALLEST_RATIO, LARGEST_RATIO = 1e-6, 1e6
MOST_SECTIONS = 100_000

ROUNDED = 1e-9
"""How far the lengths of sections may be from adding up to 1."""

EQUAL_LENGTHS = 1e-12
"""Lengths that differ by less count as equal."""

SMOOTH = 1e-12
"""Kinks of the stiffness below this part of the largest stiffness over a section's length are round-off."""

PLAIN: tuple[Section, ...] = ((1.0, 1.0, 1.0, 1.0, 1.0),)
"""The one section of a uniform rod."""

FORM = (
    "must be a sequence of (length, stiffness, weight, clearance, torsion), from s = 0; all but the length may be left "
    f"out, and all but length and clearance may be 2 to {MOST_VALUES} values at evenly spaced places of the section"
)


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
        """Whether a ratio varies along a section."""
        return any(isinstance(ratio, tuple) for section in self.sections for ratio in section)

    def tapers(self, ratio: str) -> BoolArray:
        """In which sections a ratio, one of :data:`RATIOS`, varies, (n,)."""
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
    def stiffness_range(self) -> tuple[float, float]:
        """The least and the largest B(s)/B."""
        ranges = [extremes(section[1]) for section in self.sections]
        return min(least for least, _, _ in ranges), max(most for _, _, most in ranges)

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
        return Profile(self.breaks, self._ratios(3)[:, None])

    @cached_property
    def clearance_steps(self) -> FloatArray:
        """Where the clearance has a step, (k,), in L: the string bridges it, off the wall."""
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

    @property
    def stepped(self) -> bool:
        """Whether the bending stiffness has a step: a buckled rod stays on the wall there only if its slope is held."""
        return self.stiffness_steps.size > 0

    @cached_property
    def kinked(self) -> bool:
        """Whether the bending stiffness begins to fall, or ceases to rise, without a step: the wall would have to pull.

        A buckled rod stays on the wall there only if it is held to it.
        """
        (below, above), (rate, next_rate) = self.stiffness_sides, self.stiffness_rate_sides
        return self.tapered and bool(np.any((below == above) & (next_rate < rate)))

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


def seen_from_s_1(sections: tuple[Section, ...]) -> tuple[Section, ...]:
    """Sections of the rod turned round."""
    return tuple(
        (length, _turned(stiffness), _turned(weight), clearance, _turned(torsion))
        for length, stiffness, weight, clearance, torsion in sections[::-1]
    )


def _turned(ratio: Ratio) -> Ratio:
    return ratio[::-1] if isinstance(ratio, tuple) else ratio


def refuse_sections(sections: tuple[Section, ...], why: str) -> None:
    """Raise for a string of sections, where only a uniform rod is taken; ``why`` says why, and what to do."""
    if sections:
        raise InputError("sections", f"{len(sections)} of them", why)


def lower_half(sections: tuple[Section, ...]) -> tuple[Section, ...]:
    """Sections of the half from s = 0 to ½, with lengths in its own length."""
    breaks, out = Rod(sections).breaks if sections else np.array([0.0]), []
    for i in (i for i in range(len(sections)) if breaks[i] < 0.5):
        length = min(float(breaks[i + 1]), 0.5) - float(breaks[i])
        _, stiffness, weight, clearance, torsion = sections[i]
        part = length / float(breaks[i + 1] - breaks[i])
        ratios = stiffness, weight, torsion
        b, q, c = ratios if part == 1.0 else (_first_part(ratio, part) for ratio in ratios)
        out.append((2.0 * length, b, q, clearance, c))
    return tuple(out)


def _first_part(ratio: Ratio, part: float) -> Ratio:
    """A ratio in so much of its section, from the lower end."""
    if isinstance(ratio, float):
        return ratio
    found = np.polynomial.Polynomial(powers(ratio))
    return tuple(map(float, found(part * np.linspace(0.0, 1.0, len(ratio)))))


def checked_sections(sections: object) -> tuple[Section, ...]:
    """Return sections whole, their lengths adding up to 1, neighbours that are alike joined; none for the plain rod.

    Raises
    ------
    InputError
        Where one is not as it must be: it is named by its number, from s = 0.
    """
    if isinstance(sections, str) or not isinstance(sections, Iterable):
        raise InputError("sections", sections, FORM)
    given = list(sections)
    if not given:
        return ()
    if len(given) > MOST_SECTIONS:
        raise InputError("sections", len(given), f"may be at most {MOST_SECTIONS} of them")
    whole = [_checked(section, number) for number, section in enumerate(given, 1)]
    total = float(np.sum([section[0] for section in whole]))
    if abs(total - 1.0) > ROUNDED:
        lengths = " + ".join(f"{section[0]:.10g}" for section in whole[:6]) + (" + …" if len(whole) > 6 else "")
        raise InputError(
            "sections", lengths, f"lengths are parts of the rod's length and must add up to 1, not to {total:.10g}"
        )
    joined: list[Section] = []
    for section in whole:
        if joined and joined[-1][1:] == section[1:] and not any(isinstance(ratio, tuple) for ratio in section):
            joined[-1] = (joined[-1][0] + section[0], *section[1:])
        else:
            joined.append(section)
    if len(joined) == 1:
        joined = [(1.0, *joined[0][1:])]
    return () if tuple(joined) == PLAIN else tuple(joined)


def _checked(section: object, number: int) -> Section:
    """A section with all its five numbers, each checked."""
    if isinstance(section, str) or not isinstance(section, Iterable):
        raise InputError(f"section {number}", section, FORM)
    values = list(section)
    if not 1 <= len(values) <= 1 + len(RATIOS):
        raise InputError(f"section {number}", section, FORM)
    length = checked_number(
        f"section {number}, length", values[0], 1e-9, 1.0, "above 0 and at most 1, a part of the length"
    )
    b, q, d, c = (
        _checked_ratio(f"section {number}, {name}", name, value)
        for name, value in zip(RATIOS, [*values[1:], *[1.0] * 4], strict=False)
    )
    assert isinstance(d, float)
    return (length, b, q, d, c)


def _checked_ratio(field: str, name: str, value: object) -> Ratio:
    """A ratio: a number, or its values along the section; values that are all alike are a number."""
    low = 0.0 if name == "weight" else SMALLEST_RATIO
    allowed = f"from {low:g} to {LARGEST_RATIO:g}, a ratio to the {name} of the problem"
    if name == "clearance" or isinstance(value, str) or not isinstance(value, Iterable):
        return float(checked_number(field, value, low, LARGEST_RATIO, allowed))
    given = list(value)
    if not 1 <= len(given) <= MOST_VALUES:
        what = f"must be a number, or 2 to {MOST_VALUES} of them, its values at evenly spaced places of the section"
        raise InputError(field, f"{len(given)} values", f"{what}: part the section for more")
    ratio = tuple(float(checked_number(field, one, low, LARGEST_RATIO, allowed)) for one in given)
    if min(ratio) == max(ratio):
        return ratio[0]
    least, where, most = extremes(ratio)
    if least < low or most > LARGEST_RATIO:
        found = f"{least:.4g} at {where:.4g}" if least < low else f"{most:.4g} at most"
        what = f"the polynomial through them is {found} of the section's length: part the section, or give fewer values"
        raise InputError(field, " / ".join(f"{one:g}" for one in ratio), what)
    return ratio
