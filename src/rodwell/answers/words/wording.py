"""Numbers, forces and places in the reader's words: no digit is printed that the error does not allow."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rodwell.problem.problem import Problem
from rodwell.problem.words import counted_around, side_of_wall
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import amount, plain
from rodwell.quantities.units import System
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.branch.special import SpecialPoint
    from rodwell.analysis.path.load_path import LoadPath
    from rodwell.case.case import Case


def quantity(system: System, number: Value, dimension: str, digits: int = 4) -> str:
    """A number in SI units in the reader's, rounded like :func:`amount`."""
    return system.amount(number, dimension, digits)


def size_text(scales: Scales | None, number: Value, dimension: str = "force", unit: str = "B/L²") -> str:
    """A number in units B = L = 1 in the reader's units only."""
    if scales is None:
        return f"{amount(number)} {unit}"
    return scales.amount(number, dimension)


def bend_text(case: Case) -> str:
    """How the hole of a case is bent, in a few words."""
    hole = case.problem.hole
    assert hole is not None
    one = not hole.axis
    turns = f"turns by {plain(math.degrees(hole.turning), 3)}°"
    if case.scales is None:
        return f"{turns}, {'' if one else 'least '}radius {plain(1.0 / hole.sharpest, 3)} L"
    return f"{turns}, {'' if one else 'least '}radius {case.scales.text(1.0 / hole.sharpest, 'length')}"


def forces_of(case: Case) -> Forces:
    """How end forces of a case are said: at which end, with which sign."""
    return Forces(case.scales, case.problem.hung_weight)


def forces_in(path: LoadPath, case: Case | None) -> Forces:
    """How forces of a load path are said: as the pages of a case do, without one as F in B/L²."""
    return Forces(None, path.problem.hung_weight) if case is None else forces_of(case)


def place_text(case: Case, place: Value) -> str:
    """A place along the rod: by its distance from the end s = 0 and, in an inclined hole, its depth below s = 1."""
    scales = case.scales
    text = f"s/L = {amount(place)}"
    if scales is None:
        return text
    above = size_text(scales, place, "length")
    if case.problem.axial_weight == 0.0 or scales.climbs:
        return f"{above} from the end s = 0"
    if not 0.0 < place.value < 1.0:
        return "the bottom" if place.value <= 0.0 else "the top"
    depth = size_text(scales, Value(1.0 - place.value, place.error), "length")
    return f"{above} above the bottom ({depth} below the top)"


def side_of(case: Case) -> str:
    """The side of the hole that the rod lies on before it buckles: "low" or "high"."""
    return side_of_wall(case.problem)


def soft_wall(case: Case) -> list[str]:
    """What counts of a wall that gives way, in a sentence; none of a rigid one."""
    if math.isinf(case.wall_stiffness):
        return []
    size = size_text(case.scales, Value(case.wall_stiffness), "stress", "B/L⁴")
    return [
        f"The wall gives way, by {size} of push per length and depth: that counts beyond lift-off, where the rod is "
        "followed from the straight one that has sunk into it; all that is told of the rod on the wall, critical and "
        "lift-off loads too, takes the wall as rigid."
    ]


def around_text(angle: Value, problem: Problem) -> str:
    """Where around the hole an angle ξ₂ is: "the low side", "12° to the left of the low side"."""
    (side, sense), opposite = counted_around(problem), {"low": "high", "high": "low", "left": "right", "right": "left"}
    degrees = angle.times(180.0 / math.pi)
    turned = (degrees.value + 180.0) % 360.0 - 180.0
    if abs(turned) < NEARLY:
        return f"the {side} side"
    if abs(abs(turned) - 180.0) < NEARLY:
        return f"the {opposite[side]} side"
    sense = sense if turned > 0.0 else opposite[sense]
    return f"{amount(Value(abs(turned), degrees.error), 3)}° to the {sense} of the {side} side"


NEARLY = 0.05
"""Degrees around the hole that nobody tells apart."""


def places_text(case: Case, point: SpecialPoint) -> str:
    """The places of a special point; their errors from the places of the largest pressure on the coarser mesh."""
    from rodwell.analysis.discrete.measures import pressure_maxima  # noqa: PLC0415

    maxima, _, _ = pressure_maxima(point.solution.meshes.coarse, point.solution.point.coarse)
    places = (Value(s, min(abs(float(t) - s) for t in maxima)) for s in point.s)
    return " and ".join(place_text(case, place) for place in places)
