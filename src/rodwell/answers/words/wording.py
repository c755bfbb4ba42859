"""Numbers, forces and places in the reader's words: no digit is printed that the error does not allow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rodwell.quantities.text import amount, certain
from rodwell.quantities.units import System

if TYPE_CHECKING:
    from rodwell.analysis.branch.special import SpecialPoint
    from rodwell.answers.result.answer import Answer


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
    from rodwell.analysis.discrete.measures import pressure_maxima  # noqa: PLC0415

    maxima, _, _ = pressure_maxima(point.solution.meshes.coarse, point.solution.point.coarse)
    return " and ".join(place_text(answer, s, min(abs(float(t) - s) for t in maxima)) for s in point.s)
