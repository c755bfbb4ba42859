"""Numbers, forces and places in the reader's words: no digit is printed that the error does not allow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rodwell.quantities.scales import Scales
from rodwell.quantities.text import amount, certain
from rodwell.quantities.units import System
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.branch.special import SpecialPoint


def quantity(system: System, number: Value, dimension: str, digits: int = 4) -> str:
    """A number in SI units in the reader's, rounded like :func:`amount`."""
    count = certain(number, digits)
    text = system.text(number.value, dimension, count or 1)
    return text if count else f"{text} ± {system.text(number.error, dimension, 1)}"


def size_text(scales: Scales | None, number: Value, dimension: str = "force", unit: str = "B/L²") -> str:
    """A number in units B = L = 1 in the reader's units only."""
    if scales is None:
        return f"{amount(number)} {unit}"
    return quantity(scales.system, number.times(scales.factor(dimension)), dimension)


def force_text(scales: Scales | None, force: Value) -> str:
    """A force in the reader's units: SI first where the case has dimensions. Without error: a force that was given."""
    text = f"{amount(force, 6)} B/L²"
    return text if scales is None else f"{size_text(scales, force)} ({text})"


def place_text(scales: Scales | None, place: Value) -> str:
    """A place along the rod, s/L."""
    text = f"s/L = {amount(place)}"
    return text if scales is None else f"{size_text(scales, place, 'length')} from the end s = 0 ({text})"


def places_text(scales: Scales | None, point: SpecialPoint) -> str:
    """The places of a special point; their errors from the places of the largest pressure on the coarser mesh."""
    from rodwell.analysis.discrete.measures import pressure_maxima  # noqa: PLC0415

    maxima, _, _ = pressure_maxima(point.solution.meshes.coarse, point.solution.point.coarse)
    places = (Value(s, min(abs(float(t) - s) for t in maxima)) for s in point.s)
    return " and ".join(place_text(scales, place) for place in places)
