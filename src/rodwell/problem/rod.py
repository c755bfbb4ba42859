"""The rod along s: sections of a string, checked, and the profiles that follow from them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.errors import InputError, checked_number
from rodwell.quantities.arrays import FloatArray, IntArray

Section = tuple[float, float, float, float, float]
"""Length in L, and ratios to the problem's data: bending stiffness, weight, clearance, torsional stiffness."""

RATIOS = ("stiffness", "weight", "clearance", "torsion")
COLUMNS = ("length", *RATIOS)
SMALLEST_RATIO, LARGEST_RATIO = 1e-6, 1e6
MOST_SECTIONS = 100_000

ROUNDED = 1e-9
"""How far the lengths of sections may be from adding up to 1."""

EQUAL_LENGTHS = 1e-12
"""Lengths that differ by less count as equal."""

PLAIN: tuple[Section, ...] = ((1.0, 1.0, 1.0, 1.0, 1.0),)
"""The one section of a uniform rod."""

FORM = (
    "must be a sequence of (length, stiffness, weight, clearance, torsion), from s = 0; "
    "all but the length may be left out"
)


@dataclass(frozen=True)
class Profile:
    """A function of s in pieces, each a polynomial.

    Attributes
    ----------
    breaks
        Where pieces begin and end, rising from 0 to 1, (n + 1,).
    coefficients
        Of the powers 0, 1, … of s − 1, for each piece, (n, k): a piece is a function of all s, prolonged to s = 1.
    """

    breaks: FloatArray
    coefficients: FloatArray

    def piece_of(self, places: FloatArray) -> IntArray:
        """Number of the piece in which each place (m,) lies; where two meet, that towards s = 1."""
        inner = self.breaks[1:-1]
        return np.searchsorted(inner, places, side="right").astype(np.int64)

    def __call__(self, places: FloatArray) -> FloatArray:
        """Values (m,) at places (m,)."""
        own = self.coefficients[self.piece_of(places)]
        value = np.zeros(own.shape[0])
        for k in range(own.shape[1] - 1, -1, -1):
            value = value * (places - 1.0) + own[:, k]
        return value


@dataclass(frozen=True)
class Rod:
    """A rod of sections: B, C and weight as ratios, constant in each section, with jumps between them.

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
    def stiffness(self) -> Profile:
        """B(s)/B."""
        return Profile(self.breaks, self._ratios(1)[:, None])

    @cached_property
    def weight(self) -> Profile:
        """w(s)/w."""
        return Profile(self.breaks, self._ratios(2)[:, None])

    @cached_property
    def torsion(self) -> Profile:
        """C(s)/C."""
        return Profile(self.breaks, self._ratios(4)[:, None])

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
    def turned(self) -> Profile:
        """∫₀ˢ ds/(C(s)/C), in L: how far a torque along the whole rod has turned it, over what it turns C by in L."""
        softness = 1.0 / self._ratios(4)
        below = np.concatenate([[0.0], np.cumsum(softness * np.diff(self.breaks))[:-1]])
        return Profile(self.breaks, np.stack([below - softness * (self.breaks[:-1] - 1.0), softness], axis=1))

    @cached_property
    def lever(self) -> Profile:
        """h(s) = −∫ₛ¹ w(s)/w ds, in L: the axial resultant is N(s) = F + wₐ h(s).

        In a section it is d + (w/w₀)(s − 1): that of a uniform rod of this section, with another end force F + wₐ d.
        """
        weight = self._ratios(2)
        hung = weight * np.diff(self.breaks)
        above = np.concatenate([np.cumsum(hung[::-1])[::-1][1:], [0.0]])  # weight of the sections above each
        offset = -above - weight * (self.breaks[1:] - 1.0)
        offset[-1] = 0.0
        return Profile(self.breaks, np.stack([offset, weight], axis=1))

    @cached_property
    def stiffness_steps(self) -> FloatArray:
        """Where the bending stiffness has a step, (k,), in L."""
        stiffness = self._ratios(1)
        return np.asarray(self.breaks[1:-1][stiffness[1:] != stiffness[:-1]])

    @property
    def stepped(self) -> bool:
        """Whether the bending stiffness has a step: a buckled rod stays on the wall there only if its slope is held."""
        return self.stiffness_steps.size > 0

    @cached_property
    def whole_weight(self) -> float:
        """∫ w(s)/w ds: weight of the whole, as a ratio to that of a uniform rod."""
        return float(self._ratios(2) @ np.diff(self.breaks))

    @cached_property
    def compliance(self) -> float:
        """∫ ds/(B(s)/B): how much more the rod bends under a moment that is the same everywhere."""
        return float(np.diff(self.breaks) @ (1.0 / self._ratios(1)))

    @cached_property
    def symmetric(self) -> bool:
        """Whether the rod is the same seen from either end."""
        mirrored = self.sections[::-1]
        alike = all(a[1:] == b[1:] for a, b in zip(self.sections, mirrored, strict=True))
        return alike and bool(np.max(np.abs(self.breaks + self.breaks[::-1] - 1.0)) <= EQUAL_LENGTHS)

    @property
    def plain(self) -> bool:
        """Whether it is the uniform rod that everything is a ratio to."""
        return self.sections == PLAIN


def sections_from(text: str, name: str = "sections") -> list[list[float]]:
    """Numbers of sections as they are written in a line, ``0.6:1:1, 0.4:0.3:0.5``; what they must be is checked later.

    Raises
    ------
    InputError
        Naming the section that cannot be read; ``name`` is what the text is called.
    """
    found = []
    for number, section in enumerate(text.split(","), 1):
        try:
            found.append([float(part) for part in section.split(":")])
        except ValueError:
            what = "must be length:stiffness[:weight[:clearance[:torsion]]], numbers, sections parted by commas"
            raise InputError(f"{name}, section {number}", section, what) from None
    return found


def sections_text(sections: Iterable[Sequence[float]]) -> str:
    """Sections written in a line, as :func:`sections_from` reads them: ratios of 1 at the end are left out."""
    lines = []
    for length, *ratios in sections:
        while len(ratios) > 1 and ratios[-1] == 1.0:
            ratios.pop()
        lines.append(":".join(f"{number!r}".removesuffix(".0") for number in (length, *ratios)))
    return ",".join(lines)


def refuse_sections(sections: tuple[Section, ...], why: str) -> None:
    """Raise for a string of sections, where only a uniform rod is taken; ``why`` says why, and what to do."""
    if sections:
        raise InputError("sections", f"{len(sections)} of them", why)


def lower_half(sections: tuple[Section, ...]) -> tuple[Section, ...]:
    """Sections of the half from s = 0 to ½, with lengths in its own length."""
    breaks = Rod(sections).breaks if sections else np.array([0.0])
    inside = [i for i in range(len(sections)) if breaks[i] < 0.5]
    lengths = [2.0 * (min(float(breaks[i + 1]), 0.5) - float(breaks[i])) for i in inside]
    return tuple((length, *sections[i][1:]) for i, length in zip(inside, lengths, strict=True))


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
        if joined and joined[-1][1:] == section[1:]:
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
    ratios = []
    for name, value in zip(RATIOS, [*values[1:], *[1.0] * 4], strict=False):
        low = 0.0 if name == "weight" else SMALLEST_RATIO
        allowed = f"from {low:g} to {LARGEST_RATIO:g}, a ratio to the {name} of the problem"
        ratios.append(checked_number(f"section {number}, {name}", value, low, LARGEST_RATIO, allowed))
    return (length, ratios[0], ratios[1], ratios[2], ratios[3])
