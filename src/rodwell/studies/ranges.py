"""Ranges as text, "30..90 deg in 13": what parameter studies and maps read alike."""

from __future__ import annotations

import re

from rodwell.quantities.units import in_unit_of

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


def tidy(value: float) -> float:
    """The number without what round-off adds in the sixteenth digit: 0.3, not 0.30000000000000004."""
    return float(f"{value:.13g}")
