"""Sections of a rod: checked, turned round, and written in a line, ``0.6:1:1,0.4:1/0.3:1/0.5``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from rodwell.errors import InputError, checked_number
from rodwell.problem.profile import MOST_VALUES, Ratio, extremes, within

Section = tuple[float, Ratio, Ratio, Ratio, Ratio]
"""Length in L, and ratios to the problem's data: bending stiffness, weight, clearance, torsional stiffness."""

RATIOS = ("stiffness", "weight", "clearance", "torsion")
COLUMNS = ("length", *RATIOS)
SMALLEST_RATIO, LARGEST_RATIO = 1e-6, 1e6
MOST_SECTIONS = 100_000

ROUNDED = 1e-9
"""How far the lengths of sections may be from adding up to 1."""

SMOOTH_STEP = (
    (0.0, 0.0, 0.0, 0.0, 1.0 / 24.0),
    (1.0 / 24.0, 1.0 / 6.0, 0.25, 1.0 / 6.0, -0.125),
    (0.5, 2.0 / 3.0, 0.0, -1.0 / 3.0, 0.125),
    (23.0 / 24.0, 1.0 / 6.0, -0.25, 1.0 / 6.0, -1.0 / 24.0),
)
"""Coefficients of the powers of u, from 0 to 1 in each of four equal parts, of the step from 0 to 1 whose derivative is
the cubic B-spline: three times continuously differentiable."""

PLAIN: tuple[Section, ...] = ((1.0, 1.0, 1.0, 1.0, 1.0),)
"""The one section of a uniform rod."""

FORM = (
    "must be a sequence of (length, stiffness, weight, clearance, torsion), from s = 0; all but the length may be left "
    f"out, and all but the length may be 2 to {MOST_VALUES} values at evenly spaced places of the section"
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
    return (length, b, q, d, c)


def _checked_ratio(field: str, name: str, value: object) -> Ratio:
    """A ratio: a number, or its values along the section; values that are all alike are a number."""
    low = -LARGEST_RATIO if name == "weight" else SMALLEST_RATIO
    allowed = f"from {low:g} to {LARGEST_RATIO:g}, a ratio to the {name} of the problem"
    allowed += ", negative where it floats" if name == "weight" else ""
    if isinstance(value, str) or not isinstance(value, Iterable):
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
        (length, _turned(stiffness), _turned(weight), _turned(clearance), _turned(torsion))
        for length, stiffness, weight, clearance, torsion in sections[::-1]
    )


def _turned(ratio: Ratio) -> Ratio:
    return ratio[::-1] if isinstance(ratio, tuple) else ratio


def refuse_sections(sections: tuple[Section, ...], why: str) -> None:
    """Raise for a string of sections, where only a uniform rod is taken; ``why`` says why, and what to do."""
    if sections:
        raise InputError("sections", f"{len(sections)} of them", why)


def ramp(
    length: float,
    first: float,
    last: float,
    *,
    stiffness: float | Sequence[float] = 1.0,
    weight: float | Sequence[float] = 1.0,
    torsion: float | Sequence[float] = 1.0,
) -> tuple[Section, ...]:
    """Four sections, each a quarter of ``length``, over which the clearance goes smoothly from a ratio to another.

    Three times continuously differentiable, constant beyond: the wall need not exert forces at single places on the
    rod that lies on it. Its slope is at most 8/3 of that of a straight line, in the middle, and the fourth derivative
    768 (last − first)/length⁴.

    Parameters
    ----------
    length
        Of all four, in L.
    first, last
        Clearance ratios at the lower end (towards s = 0) and the upper end.
    stiffness, weight, torsion
        Ratios as of any section, constant or values along all of the length.
    """
    if last < first:  # the mirror image of the other one to the last bit
        b, q, c = (one[::-1] if isinstance(one, Sequence) else one for one in (stiffness, weight, torsion))
        return seen_from_s_1(ramp(length, last, first, stiffness=b, weight=q, torsion=c))
    others = [tuple(map(float, one)) if isinstance(one, Sequence) else float(one)
              for one in (stiffness, weight, torsion)]  # fmt: skip
    u, out = np.linspace(0.0, 1.0, 5), []
    for i, coefficients in enumerate(SMOOTH_STEP):
        step = np.polynomial.polynomial.polyval(u, coefficients)
        b, q, c = (within(one, 0.25 * i, 0.25 * (i + 1)) for one in others)
        clearance: Ratio = tuple(map(float, first + (last - first) * step)) if first != last else float(first)
        out.append((0.25 * length, b, q, clearance, c))
    return tuple(out)


def sections_from(text: str, name: str = "sections") -> list[Sequence[float | Sequence[float]]]:
    """Numbers of sections, ``length:stiffness:weight:clearance:torsion`` of each, parted by commas; a taper's by /.

    A clearance ``a~b`` goes over from a to b smoothly: see :func:`rodwell.problem.clearances.ramp`.

    What they must be is checked with the problem that they make.

    Raises
    ------
    InputError
        Naming the section that cannot be read; ``name`` is what the text is called.
    """
    found: list[Sequence[float | Sequence[float]]] = []
    for number, section in enumerate(text.split(","), 1):
        try:
            parts = section.split(":")
            ends = [float(one) for one in parts[3].split("~")] if len(parts) > 3 and parts[3].count("~") == 1 else []
            parts[3:4] = ["1"] if ends else parts[3:4]
            numbers = [[float(one) for one in part.split("/")] for part in parts]
        except ValueError:
            what = "must be length:stiffness[:weight[:clearance[:torsion]]], numbers, a taper's parted by /, the ends "
            what += "of a smooth clearance by ~, sections by commas"
            raise InputError(f"{name}, section {number}", section, what) from None
        one = [part if len(part) > 1 else part[0] for part in numbers]
        found += _ramped(one, *ends) if ends else [one]
    return found


def _ramped(one: Sequence[Any], first: float, last: float) -> tuple[Section, ...]:
    """The sections of one whose clearance goes over smoothly: length, stiffness, weight, and torsion if given."""
    length, stiffness, weight, _, *torsion = one
    return ramp(length, first, last, stiffness=stiffness, weight=weight, torsion=torsion[0] if torsion else 1.0)


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
