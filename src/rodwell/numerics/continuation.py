"""Pseudo-arclength continuation with events.

The loop knows no event by name: an event is a function of λ and of the measured numbers whose zeros matter.
Changes of the stability index are located too, each resolved into the crossings that make it up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from rodwell.numerics.families import Outcome, State
from rodwell.numerics.ladder import CLAIMED_GAIN, Ladder, Point
from rodwell.numerics.location import LocationError, Span, index_crossings, locate
from rodwell.numerics.spaces import FloatArray

INDEX = "index"
"""Name under which changes of the stability index are reported."""


@dataclass(frozen=True)
class Event:
    """A function of λ and the measured numbers whose zeros are to be found; ``stop`` ends the branch there."""

    name: str
    function: Callable[[float, FloatArray], float]
    stop: bool = False


@dataclass(frozen=True)
class Found:
    """A located zero: name, point and its ladder, error of its λ, stability index on either side."""

    name: str
    point: Point
    ladder: Ladder
    lam_error: float
    index_before: int
    index_after: int
    fold: bool = False


@dataclass(frozen=True)
class Stepping:
    """Step lengths of continuation, in the metric of the family, and when to give up."""

    first: float
    largest: float
    smallest: float = 1e-7
    most_points: int = 2000
    most_work: float = np.inf  # elements times solves
    sharpest_turn: float = 0.35  # radians between successive tangents


@dataclass
class Trace:
    """What continuation found: points in order, the ladder each stands on, located events, why it ended."""

    points: list[Point] = field(default_factory=list)
    ladders: list[Ladder] = field(default_factory=list)
    found: list[Found] = field(default_factory=list)
    end: str = ""


Progress = Callable[[Point], None]


def trace(
    ladder: Ladder,
    start: Point,
    stepping: Stepping,
    events: Sequence[Event],
    progress: Progress | None = None,
) -> Trace:
    """Follow the branch from ``start`` along its tangent until a stopping event or the limit of points.

    A step is repeated with half the length if the corrector fails, if the branch turns by more than allowed,
    or if an event in it cannot be located. If the step falls below ``stepping.smallest``, the branch ends
    and ``Trace.end`` says why.
    """
    result = Trace([start], [ladder])
    length = stepping.first
    bend: tuple[FloatArray, float] | None = None
    work = 0.0
    while True:
        last, ladder = result.points[-1], result.ladders[-1]
        work += 4.0 * ladder.fine.space.elements  # about that many solves a step
        result.end = _limit(result, work, stepping)
        if result.end:
            return result
        why, new_ladder, point, turn = _step(ladder, last.coarse, length, bend, stepping)
        found: list[Found] = []
        if point is not None:
            base: Point | None = last
            if new_ladder is not ladder:
                outcome, base = new_ladder.adopt(ladder, last)
                why = outcome.value
            try:
                if base is not None:
                    found = _events_between(new_ladder, base, point, events, first=len(result.points) == 1)
            except LocationError as problem:
                base, why = None, str(problem)
            if base is None:
                point = None
            else:
                result.points[-1], result.ladders[-1] = base, new_ladder
                last = base
        if point is None:
            length, bend = 0.5 * length, None
            if length < stepping.smallest:
                result.end = why
                return result
            continue
        result.found += found
        stops = [f for f in found if any(e.stop and e.name == f.name for e in events)]
        if stops:
            result.points.append(stops[0].point)
            result.ladders.append(new_ladder)
            result.end = stops[0].name
            return result
        result.points.append(point)
        result.ladders.append(new_ladder)
        if progress is not None:
            progress(point)
        travelled = last.coarse.along(point.coarse)
        bend = (
            (point.coarse.tangent - last.coarse.tangent) / travelled,
            (point.coarse.tangent_lam - last.coarse.tangent_lam) / travelled,
        )
        length = min(stepping.largest, length * min(2.0, 0.5 * stepping.sharpest_turn / max(turn, 1e-3)))


def _limit(result: Trace, work: float, stepping: Stepping) -> str:
    """Why the branch must end here, or ""."""
    if work > stepping.most_work:
        return "the work allowed for one branch is used up: ask for less far, or for a larger rtol"
    if len(result.points) >= stepping.most_points:
        return f"the limit of {stepping.most_points} points was reached"
    return ""


def _step(
    ladder: Ladder, state: State, length: float, bend: tuple[FloatArray, float] | None, stepping: Stepping
) -> tuple[str, Ladder, Point | None, float]:
    """Try one step: returns what went wrong (or ""), the ladder, the point or None, the turn of the tangent."""
    outcome, coarse, _ = ladder.coarse.step(state, length, bend)
    if coarse is None:
        return outcome.value, ladder, None, 0.0
    cosine = float(state.row @ coarse.tangent + state.row_lam * coarse.tangent_lam)
    turn = float(np.arccos(min(1.0, cosine)))
    if turn > stepping.sharpest_turn:
        return "the branch turns too sharply to be followed", ladder, None, turn
    outcome, ladder, point = ladder.resolve(coarse)
    return (outcome.value if outcome is not Outcome.CONVERGED else ""), ladder, point, turn


def _events_between(ladder: Ladder, before: Point, after: Point, events: Sequence[Event], first: bool) -> list[Found]:
    """All events between two points on one ladder, in order; up to the first that stops the branch."""
    spans = (
        Span(ladder.coarse.sharp(), before.coarse, after.coarse),
        Span(ladder.fine.sharp(), before.fine, after.fine),
    )
    crossings: list[tuple[float, Found]] = []
    if not first:  # the index of the straight rod is not that of the branch which leaves it
        for place, coarse, fine, indices, error, fold in index_crossings(*spans):
            point = ladder.point(coarse, fine)
            crossings.append((place, Found(INDEX, point, ladder, error / CLAIMED_GAIN, *indices, fold)))
    for event in events:
        ends = event.function(before.lam, before.values), event.function(after.lam, after.values)
        if ends[0] == 0.0 or (ends[0] < 0.0) == (ends[1] < 0.0):
            continue
        place, coarse, fine, error = locate(*spans, ladder.measure, event.function, ends)
        index = fine.index if not first else after.fine.index
        crossings.append(
            (place, Found(event.name, ladder.point(coarse, fine), ladder, error / CLAIMED_GAIN, index, index))
        )
    crossings.sort(key=lambda item: item[0])
    stops = {e.name for e in events if e.stop}
    out: list[Found] = []
    for _, item in crossings:
        out.append(item)
        if item.name in stops:
            break
    return out
