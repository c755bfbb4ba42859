"""Sections of a rod: checked, turned round, and written in a line, ``0.6:1:1,0.4:1/0.3:1/0.5``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from rodwell.errors import InputError, checked_number
from rodwell.problem.profile import MOST_VALUES, Ratio, extremes

Section = tuple[float, Ratio, Ratio, float, Ratio]
"""Length in L, and ratios to the problem's data: bending stiffness, weight, clearance, torsional stiffness."""

RATIOS = ("stiffness", "weight", "clearance", "torsion")
COLUMNS = ("length", *RATIOS)
SMALLEST_RATIO, LARGEST_RATIO = 1e-6, 1e6
MOST_SECTIONS = 100_000

ROUNDED = 1e-9
"""How far the lengths of sections may be from adding up to 1."""

PLAIN: tuple[Section, ...] = ((1.0, 1.0, 1.0, 1.0, 1.0),)
"""The one section of a uniform rod."""

FORM = (
    "must be a sequence of (length, stiffness, weight, clearance, torsion), from s = 0; all but the length may be left "
    f"out, and all but length and clearance may be 2 to {MOST_VALUES} values at evenly spaced places of the section"
)


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
    low = -LARGEST_RATIO if name == "weight" else SMALLEST_RATIO
    allowed = f"from {low:g} to {LARGEST_RATIO:g}, a ratio to the {name} of the problem"
    allowed += ", negative where it floats" if name == "weight" else ""
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
    if name == "weight" and min(ratio) >= 0.0:
        low = 0.0
    if name == "weight" and least < 0.0 < most and (min(ratio) < 0.0 < max(ratio) or max(ratio) <= 0.0):
        what = "must not change its sign within a section: part the section where it begins to float"
        raise InputError(field, " / ".join(f"{one:g}" for one in ratio), what)
    if least < low or most > LARGEST_RATIO:
        found = f"{least:.4g} at {where:.4g}" if least < low else f"{most:.4g} at most"
        what = f"the polynomial through them is {found} of the section's length: part the section, or give fewer values"
        raise InputError(field, " / ".join(f"{one:g}" for one in ratio), what)
    return ratio


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


def sections_from(text: str, name: str = "sections") -> list[list[float | list[float]]]:
    """Numbers of sections, ``length:stiffness:weight:clearance:torsion`` of each, parted by commas; a taper's by /.

    What they must be is checked with the problem that they make.

    Raises
    ------
    InputError
        Naming the section that cannot be read; ``name`` is what the text is called.
    """
    found = []
    for number, section in enumerate(text.split(","), 1):
        try:
            parts = [[float(one) for one in part.split("/")] for part in section.split(":")]
        except ValueError:
            what = "must be length:stiffness[:weight[:clearance[:torsion]]], numbers, a taper's parted by /, sections "
            what += "parted by commas"
            raise InputError(f"{name}, section {number}", section, what) from None
        found.append([part if len(part) > 1 else part[0] for part in parts])
    return found


def sections_text(sections: Iterable[Sequence[Ratio]]) -> str:
    """Sections in a line, as :func:`sections_from` reads them: ratios of 1 at the end are left out."""
    lines = []
    for length, *ratios in sections:
        while len(ratios) > 1 and ratios[-1] == 1.0:
            ratios.pop()
        lines.append(":".join(_ratio_text(one) for one in (length, *ratios)))
    return ",".join(lines)


def _ratio_text(ratio: Ratio) -> str:
    values = ratio if isinstance(ratio, tuple) else (ratio,)
    return "/".join(f"{number!r}".removesuffix(".0") for number in values)
