"""Pseudo-arclength continuation with events.

The loop knows no event by name: an event is a function of λ and of the measured numbers whose zeros matter.
Changes of the stability index are located too, each resolved into the crossings that make it up, and so are
places where λ turns back. A step that cannot be explained in this way is repeated with half the length.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rodwell.numerics.events import Event, Found, events_between
from rodwell.numerics.families import Outcome, State
from rodwell.numerics.ladder import Ladder, Point
from rodwell.numerics.location import LocationError
from rodwell.numerics.spaces import FloatArray
from rodwell.numerics.watch import Watch, hidden_change

STRAYED = 0.2
"""A step whose end lies farther from where it was predicted, as a part of its length, may have left the branch."""


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

    def step_back(self, count: int) -> float:
        """Take the last points back; returns how far apart the next and the one after it were."""
        gap = self.points[-count - 1].coarse.space is self.points[-count].coarse.space
        apart = self.points[-count - 1].coarse.along(self.points[-count].coarse) if gap else np.inf
        del self.points[-count:], self.ladders[-count:]
        self.found = [item for item in self.found if item.after < len(self.points) - 1]
        return float(abs(apart))


Progress = Callable[[Point], None]
Stop = Callable[[Found], str]
"""Why the branch ends at something located, or "" if it goes on."""

_Bend = tuple[FloatArray, float] | None


def trace(
    ladder: Ladder,
    start: Point,
    stepping: Stepping,
    events: Sequence[Event],
    *,
    stop: Stop,
    switched: bool,
    progress: Progress | None = None,
) -> Trace:
    """Follow the branch from ``start`` along its tangent until something found stops it, or a limit is met.

    A step is repeated with half the length if the corrector fails, if the branch turns by more than allowed, if the
    end strays from where it was predicted, or if an event in it cannot be located; the last two steps are, if
    the stability index changed and changed back within them. If the step falls below
    ``stepping.smallest``, the branch ends and ``Trace.end`` says why. ``switched`` says that ``start`` is a
    branch point, whose stability index is that of the branch left.
    """
    result = Trace([start], [ladder])
    length, work = stepping.first, 0.0
    bend: _Bend = None
    watch = Watch()
    while True:
        work += 4.0 * result.ladders[-1].fine.space.elements  # about that many solves a step
        result.end = _limit(result, work, stepping)
        if result.end:
            return result
        advance = _advance(result, length, bend, stepping, events, stop, switched)
        if isinstance(advance, str):
            length, bend = 0.5 * length, None
            if length < stepping.smallest:
                result.end = advance
                return result
            continue
        if result.end:
            return result
        bend, turn = advance
        watch.add(result.ladders[-1], result.points[-1], length)
        result.points[-1] = result.points[-1].light()
        if length > stepping.smallest and watch.may_dip() and hidden_change(result.ladders, result.points):
            length, bend = 0.25 * min(length, result.step_back(2)), None
            watch.forget(2)
            continue
        if progress is not None:
            progress(result.points[-1])
        length = min(stepping.largest, length * min(2.0, 0.5 * stepping.sharpest_turn / max(turn, 1e-3)))


def _advance(
    result: Trace, length: float, bend: _Bend, stepping: Stepping, events: Sequence[Event], stop: Stop, switched: bool
) -> tuple[_Bend, float] | str:
    """Make one step and add it to ``result`` with its events; return how the branch bends, or what went wrong."""
    last, ladder = result.points[-1], result.ladders[-1]
    why, new_ladder, point, turn = _step(ladder, last.coarse, length, bend, stepping)
    if point is None:
        return why
    base = last
    if new_ladder is not ladder:
        outcome, adopted = new_ladder.adopt(ladder, last)
        if adopted is None:
            return outcome.value
        base = adopted
    try:
        opening = len(result.points) == 1
        found = events_between(new_ladder, base, point, events, opening=opening, leaves=opening and switched)
    except LocationError as problem:
        return str(problem)
    result.points[-1], result.ladders[-1] = base, new_ladder
    end = next((i for i, item in enumerate(found) if stop(item)), None)
    if end is not None:
        found = found[: end + 1]
        result.end, point, new_ladder = stop(found[end]), found[end].point, found[end].ladder
    result.found += [replace(item, after=len(result.points) - 1) for item in found]
    result.points.append(point)
    result.ladders.append(new_ladder)
    if end is not None:
        return None, turn
    travelled = base.coarse.along(point.coarse)
    rate = (
        (point.coarse.tangent - base.coarse.tangent) / travelled,
        (point.coarse.tangent_lam - base.coarse.tangent_lam) / travelled,
    )
    return rate, turn


def _limit(result: Trace, work: float, stepping: Stepping) -> str:
    """Why the branch must end here, or ""."""
    if work > stepping.most_work:
        return "the work allowed for one branch is used up: ask for less far, or for a larger rtol"
    if len(result.points) >= stepping.most_points:
        return f"the limit of {stepping.most_points} points was reached"
    return ""


def _step(
    ladder: Ladder, state: State, length: float, bend: _Bend, stepping: Stepping
) -> tuple[str, Ladder, Point | None, float]:
    """Try one step: returns what went wrong (or ""), the ladder, the point or None, the turn of the tangent."""
    outcome, coarse, strayed = ladder.coarse.step(state, length, bend)
    if coarse is None:
        return outcome.value, ladder, None, 0.0
    cosine = float(state.row @ coarse.tangent + state.row_lam * coarse.tangent_lam)
    turn = float(np.arccos(min(1.0, cosine)))
    if turn > stepping.sharpest_turn:
        return "the branch turns too sharply to be followed", ladder, None, turn
    if strayed > STRAYED * length:
        return "the steps stray from the branch", ladder, None, turn
    outcome, ladder, point = ladder.resolve(coarse)
    return (outcome.value if outcome is not Outcome.CONVERGED else ""), ladder, point, turn
