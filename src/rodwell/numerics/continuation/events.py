"""What happens between two points of a branch, in order: zeros of events, changes of the index, turning points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.numerics.continuation.crossings import Crossing, index_crossings
from rodwell.numerics.continuation.location import LocationError, Place, Span, locate
from rodwell.numerics.equilibria.error import CLAIMED_GAIN
from rodwell.numerics.equilibria.family import State
from rodwell.numerics.equilibria.two_meshes import Ladder, Point
from rodwell.quantities.arrays import FloatArray

INDEX, TURN = "index", "turn"
"""Names under which changes of the stability index, and turning points without one, are reported."""

AT_START = 1e-6
"""Part of the first step in which a zero is taken to be the start itself."""

ROUGHLY = 1e-5
"""Part of the step to which a turning point is located first. Where a branch meets its mirror image, the Hessian is
singular and round-off hides the place from there on: what is exact there is the branch point that it meets."""

NEARLY = 1e-2
"""Largest asymmetry of a turning point, relative to the state, or angle in rad, that may be none."""

SHORT_OF = 0.98
"""Part of the way to where a branch meets its mirror image up to which its index is looked at."""

MOST_REFINEMENTS = 2
"""How often the meshes are refined for a located point that does not meet the tolerance."""


@dataclass(frozen=True)
class Event:
    """A function of λ and the measured numbers whose zeros are to be found; of λ alone, if ``level`` is given."""

    name: str
    function: Callable[[float, FloatArray], float]
    level: float | None = None

    @classmethod
    def at(cls, name: str, level: float) -> Event:
        """Where λ is ``level``."""
        return cls(name, lambda lam, _: lam - level, level)


@dataclass(frozen=True)
class Found:
    """Something located: name, point and its ladder, error of its λ, stability index on either side.

    ``rising`` is the sense of an event's function along the branch. ``fold`` says that λ turns back where the index
    changes. ``certain`` is False for a change of the index that only one mesh shows: the eigenvalue
    vanishes to round-off. ``after`` is the number of the point of the branch that it follows.
    """

    name: str
    point: Point
    ladder: Ladder
    lam_error: float
    index_before: int
    index_after: int
    rising: bool = False
    fold: bool = False
    certain: bool = True
    after: int = 0


_Placed = tuple[float, Found]


def events_between(
    ladder: Ladder, before: Point, after: Point, events: Sequence[Event], *, opening: bool, leaves: bool
) -> list[Found]:
    """All that happens between two points on one ladder, in order.

    ``opening`` says that ``before`` is the start of the branch, which may be the zero of an event itself; ``leaves``
    that it is where the branch leaves another: its index and its sense in λ are not this branch's.
    """
    segment = _Segment(ladder, before, after)
    placed: list[_Placed] = []
    if not leaves:
        turn = segment.turn()
        placed = segment.index_changes(turn)
        if turn is not None and not any(found.fold for _, found in placed):
            index = _index_at(turn.t, before.fine.index, placed)
            placed.append((turn.t, _found(TURN, ladder, turn, index, index)))
    changes = sorted(placed, key=lambda item: item[0])
    for event in events:
        if not (opening and segment.starts_at(event)):
            placed += segment.zeros(event, after.fine.index if leaves else before.fine.index, changes)
    return [found for _, found in sorted(placed, key=lambda item: item[0])]


class _Segment:
    """The stretch of a branch between two points on one ladder."""

    def __init__(self, ladder: Ladder, before: Point, after: Point) -> None:
        self.ladder, self.before, self.after = ladder, before, after

    @cached_property
    def spans(self) -> tuple[Span, Span]:
        """The stretch on both meshes."""
        coarse, fine = self.ladder.coarse.sharp(), self.ladder.fine.sharp()
        return Span(coarse, self.before.coarse, self.after.coarse), Span(fine, self.before.fine, self.after.fine)

    def index_changes(self, turn: Place | None = None) -> list[_Placed]:
        """Changes of the stability index; together they make up the whole difference of the two ends."""
        if turn is None and self.before.fine.index == self.after.fine.index:
            return []
        turns, end = [] if turn is None else [turn.t], 1.0
        if turn is not None and self._meets(turn.fine):
            turns, end = [], SHORT_OF * turn.t
        return [(crossing.t, self._changed(crossing)) for crossing in index_crossings(*self.spans, turns, end)]

    def _meets(self, state: State) -> bool:
        """Whether a branch turns back since it meets its own mirror image.

        The index is then the same on both sides, and its softest eigenvalue, which vanishes there without changing
        sign, must not be looked at. The reflection that leaves the state as it is turns the branch round, so the
        tangent has the other symmetry; where a branch of symmetric states folds, it has theirs.
        """
        family = self.ladder.fine
        if np.max(np.abs(state.c)) < NEARLY * family.scale_c:
            return True
        parity = state.symmetry_within(NEARLY) if family.parity == 0 and state.space.symmetric else 0
        return parity != 0 and family.loses(state, parity)

    def _changed(self, crossing: Crossing) -> Found:
        index = crossing.before, crossing.after
        if crossing.place is None:  # no place on the coarse mesh: nothing is known of the error but the step
            error = abs(self.after.lam - self.before.lam)
            point = self.ladder.point(self.spans[0](crossing.t), self.spans[1](crossing.t))
            return Found(INDEX, point, self.ladder, error, *index, certain=False)

        def again(finer: _Segment) -> Place | None:
            near = [c for c in index_crossings(*finer.spans) if c.place is not None and (c.before, c.after) == index]
            return min(near, key=lambda c: abs(c.t - crossing.t)).place if near else None

        return self._refined(
            crossing.place, again, lambda ladder, at: _found(INDEX, ladder, at, *index, fold=crossing.fold)
        )

    def turn(self) -> Place | None:
        """The place where λ turns back, if it does."""
        first, last = self.before.fine.tangent_lam, self.after.fine.tangent_lam
        if first * last >= 0.0:
            return None
        place = locate(*self.spans, _sense, (first, last), ROUGHLY)
        if not self._meets(place.fine):
            place = locate(*self.spans, _sense, (first, last))
        return place

    def at_level(self, lam: float) -> Place | None:
        """Where λ has just this value on both meshes, if it does not turn back."""
        coarse, fine = (span.exactly(lam) for span in self.spans)
        return None if coarse is None or fine is None else Place(fine[0], coarse[1], fine[1])

    def starts_at(self, event: Event) -> bool:
        """Whether the zero of an event is the start itself, to within what is known of its values there."""
        ends = self._values(event)
        return abs(ends[0]) <= AT_START * abs(ends[1] - ends[0])

    def _values(self, event: Event) -> tuple[float, float]:
        return event.function(self.before.lam, self.before.values), event.function(self.after.lam, self.after.values)

    def zeros(self, event: Event, index: int, changes: list[_Placed]) -> list[_Placed]:
        """The zero of an event, if its values at the two ends have opposite signs; ``index`` is that at the start."""
        ends = self._values(event)
        if ends[0] == 0.0 or (ends[0] < 0.0) == (ends[1] < 0.0):
            return []

        def value(span: Span, state: State) -> float:
            return event.function(state.lam, self.ladder.measure(span.family, state)[0])

        def again(segment: _Segment) -> Place:
            exact = None if event.level is None else segment.at_level(event.level)
            return exact or locate(*segment.spans, value, segment._values(event))

        place = again(self)
        index = _index_at(place.t, index, changes)

        rising = ends[1] > ends[0]
        found = self._refined(
            place, again, lambda ladder, at: _found(event.name, ladder, at, index, index, rising=rising)
        )
        return [(place.t, found)]

    def _refined(
        self, place: Place, again: Callable[[_Segment], Place | None], found: Callable[[Ladder, Place], Found]
    ) -> Found:
        """Describe a located point on meshes that are refined until it meets the tolerance, or it no longer helps."""
        best, segment = found(self.ladder, place), self
        for _ in range(MOST_REFINEMENTS):
            if best.point.accurate:
                break
            finer = segment.on_finer(best.point)
            try:
                new = None if finer is None else again(finer)
            except LocationError:
                break
            if finer is None or new is None:
                break
            better = found(finer.ladder, new)
            if better.point.excess > 0.5 * best.point.excess:
                break
            best, segment = better, finer
        return best

    def on_finer(self, point: Point) -> _Segment | None:
        """Return the same stretch on meshes with smaller elements where ``point`` is least resolved."""
        finer = self.ladder.refined(point)
        if finer is None:
            return None
        ends = [finer.adopt(self.ladder, p)[1] for p in (self.before, self.after)]
        return None if ends[0] is None or ends[1] is None else _Segment(finer, ends[0], ends[1])


def _found(
    name: str, ladder: Ladder, place: Place, before: int, after: int, *, rising: bool = False, fold: bool = False
) -> Found:
    point = ladder.point(place.coarse, place.fine)
    return Found(name, point, ladder, place.gap / CLAIMED_GAIN, before, after, rising=rising, fold=fold)


def _index_at(t: float, index: int, changes: Sequence[_Placed]) -> int:
    """Stability index at a place, from that at the start and the changes."""
    for place, change in sorted(changes, key=lambda item: item[0]):
        if place < t:
            index = change.index_after
    return index


def _sense(_: Span, state: State) -> float:
    """Sense of travel in λ."""
    return state.tangent_lam
