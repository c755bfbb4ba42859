"""Numbers, forces and places in the reader's words: no digit is printed that the error does not allow."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rodwell.practice.units import System, plain

if TYPE_CHECKING:
    from rodwell.analysis.special import SpecialPoint
    from rodwell.practice.answer import Answer


def certain(value: float, error: float, digits: int) -> int:
    """Return how many of the first ``digits`` significant digits the error allows; 0 if not even the first.

    A digit is allowed if half a unit of it is no less than the error: rounding then hides more than the error changes.
    """
    if not error > 0.0 or value == 0.0:
        return digits
    if not math.isfinite(error):
        return 0
    unit = math.ceil(math.log10(2.0 * error) - 1e-9)
    return max(0, min(digits, math.floor(math.log10(abs(value))) - unit + 1))


def amount(value: float, error: float = 0.0, digits: int = 4) -> str:
    """A number rounded to the digits that its error allows; with the error beside it where it allows none."""
    count = certain(value, error, digits)
    text = plain(value, count) if count else f"{plain(value, 1)} ± {plain(error, 1)}"
    return text.replace("-", "−")


def percent(part: float, error: float = 0.0, digits: int = 3) -> str:
    """A part of 1 in percent, rounded like :func:`amount`."""
    return f"{amount(100.0 * part, 100.0 * error, digits)} %"


def quantity(system: System, value: float, error: float, dimension: str, digits: int = 4) -> str:
    """A number in SI units in the reader's, rounded like :func:`amount`."""
    count = certain(value, error, digits)
    text = system.text(value, dimension, count or 1)
    return text if count else f"{text} ± {system.text(error, dimension, 1)}"


def size_text(answer: Answer, value: float, error: float, dimension: str = "force", unit: str = "B/L²") -> str:
    """A number in units B = L = 1 in the reader's units only."""
    scales = answer.case.scales
    if scales is None:
        return f"{amount(value, error)} {unit}"
    factor = scales.factor(dimension)
    return quantity(scales.system, value * factor, error * factor, dimension)


def force_text(answer: Answer, value: float, error: float = 0.0) -> str:
    """A force in the reader's units: SI first where the case has dimensions. ``error`` 0: a force that was given."""
    text = f"{amount(value, error, 6)} B/L²"
    return text if answer.case.scales is None else f"{size_text(answer, value, error)} ({text})"


def place_text(answer: Answer, s: float, error: float = 0.0) -> str:
    """A place along the rod."""
    text = f"s/L = {amount(s, error)}"
    if answer.case.scales is None:
        return text
    return f"{size_text(answer, s, error, 'length')} from the end s = 0 ({text})"


def places_text(answer: Answer, point: SpecialPoint) -> str:
    """The places of a special point; their errors from the places of the largest pressure on the coarser mesh."""
    from rodwell.analysis.measures import pressure_maxima  # noqa: PLC0415

    maxima, _, _ = pressure_maxima(point.solution.ladder.coarse, point.solution.point.coarse)
    return " and ".join(place_text(answer, s, min(abs(float(t) - s) for t in maxima)) for s in point.s)
