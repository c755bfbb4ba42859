"""Ranges as text, "30..90 deg in 13": what parameter studies and maps read alike."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from rodwell.errors import InputError
from rodwell.quantities.units import in_unit_of
from rodwell.quantities.written import number_and_rest, remedy

RANGE = re.compile(r"\s*(?P<first>[^.].*?|\.\d.*?)\s*\.\.\s*(?P<last>.+?)\s+in\s+(?P<count>\d+)\s*")
"""A range: both ends, and how many values."""

LONGEST_RANGE = 150
"""Characters that a range may have: expressions that read one take their number to the third."""


def in_unit(unit: str, to: str, number: float) -> float:
    """Return a number in ``unit`` as one in the unit ``to``.

    Raises
    ------
    ValueError
        If the two do not go together.
    """
    return number if unit == to else in_unit_of(number, unit, to)


@dataclass(frozen=True)
class Range:
    """A range that was read: both ends in ``unit`` ("" without one), and how many values."""

    first: float
    last: float
    count: int
    unit: str


def read_range(name: str, text: str, given: str, most: int, allowed: str, units: str = "") -> Range:
    """Read a range, "30..90 deg in 13", or raise an InputError about ``name``.

    ``given`` is what the user wrote, ``text`` the part of it that is to be a range; ``allowed`` says what may stand
    there where it is none, ``units`` (the same, if not given) where its units do not go together.
    """
    parts = RANGE.fullmatch(text)
    ends = None if parts is None else (number_and_rest(parts["first"]), number_and_rest(parts["last"]))
    if parts is None or ends is None or ends[0] is None or ends[1] is None:
        how = "" if parts is None else remedy(parts["first"]) or remedy(parts["last"])
        raise InputError(name, given, f"is not a range; {f'write {how}' if how else ''}{allowed}")
    (first, own), (last, unit), count = ends[0], ends[1], int(parts["count"][:9])
    try:
        first = in_unit(own or unit, unit, first)
    except ValueError as error:
        raise InputError(name, given, f"{error}; {units or allowed}") from None
    if not 2 <= count <= most:
        raise InputError(name, given, f"must have from 2 to {most} values")
    if not (math.isfinite(first) and math.isfinite(last)) or first == last:
        raise InputError(name, given, "must go from one finite value to another")
    return Range(first, last, count, unit)


def tidy(value: float) -> float:
    """The number without what round-off adds in the sixteenth digit: 0.3, not 0.30000000000000004."""
    return float(f"{value:.13g}")
