"""What happens between two points of a branch, in order: zeros of events, changes of the index, turning points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cached_property

from rodwell.numerics.continuation.at_rest import passes_rest
from rodwell.numerics.continuation.crossings import Crossing, index_crossings
from rodwell.numerics.continuation.events import (
    INDEX,
    TURN,
    Event,
    Leaving,
    LocatedEvent,
    Placed,
    found_at,
    index_at,
    unknown_at,
)
from rodwell.numerics.continuation.location import LeftTheBranchError, LocatedZero, LocationError, Segment, locate
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes

NEARLY = 1e-2
"""Largest asymmetry of a turning point, relative to the state, or angle in rad, that may be none."""

AT_START = 1e-6
"""Part of the first step in which a zero is taken to be the start itself."""

EARLY = (1e-4, 1e-3, 1e-2)
"""Distances from the start of a branch that leaves another, in the metric of the family, at which it is looked at
first, in the order of trial: what happens before, if anything, changes λ by less than is known of it."""

PARTS_OF_SHORT = (0.1, 0.3)
"""Parts of a first step at which it is looked at where it is shorter than these: a fold may follow at once, next to a
double load under twist, before λ has changed by more than 1e-4."""

EVEN_RISE = (0.5, 3.0)
"""Bounds of λ′ times the distance from such a start over the rise of λ, which is 1 or 2 without round-off."""

ROUGHLY = 1e-5
"""Part of the step to which a turning point is located first. Where a branch meets its mirror image, the Hessian is
singular and round-off hides the place from there on: what is exact there is the branch point that it meets."""

SHORT_OF = 0.98
"""Part of the way to where a branch meets its mirror image, or rest, up to which its index is looked at."""

TINY = 1e-300
"""Stands for zero in a denominator."""

MOST_REFINEMENTS = 2
"""How often the meshes are refined for a located point that does not meet the tolerance."""


def events_between(
    meshes: TwoMeshes,
    before: MeshedState,
    after: MeshedState,
    events: Sequence[Event],
    *,
    opening: bool,
    leaves: Leaving | None = None,
    doubted: bool = False,
) -> list[LocatedEvent]:
    """All that happens between two points on the same meshes, in order.

    ``opening`` says that ``before`` is the start of the branch, which may be the zero of an event itself; ``leaves``
    that it is where the branch leaves another: its index and its sense in λ are not this branch's, but it has to have
    the index given there. ``doubted`` says that branches come closer to each other here than can be told apart: a
    change of the index that nothing explains is then uncertain, and no error.

    Raises
    ------
    LocationError
        If something cannot be located.
    LeftTheBranchError
        If the two points are not on one branch.
    """
    stretch = _Stretch(meshes, before, after, doubted)
    placed = stretch.changes() if leaves is None else stretch.changes_past_the_start(leaves)
    changes = sorted(placed, key=lambda item: item[0])
    index = before.fine.index if leaves is None else changes[0][1].index_before if changes else after.fine.index
    for event in events:
        if not (opening and stretch.starts_at(event)):
            placed += stretch.zeros(event, index, changes)
    return [found for _, found in sorted(placed, key=lambda item: item[0])]


class _Stretch:
    """The stretch of a branch between two points on the same meshes."""

    def __init__(self, meshes: TwoMeshes, before: MeshedState, after: MeshedState, doubted: bool = False) -> None:
        self.meshes, self.before, self.after, self.doubted = meshes, before, after, doubted

    @cached_property
    def segments(self) -> tuple[Segment, Segment]:
        """The stretch on both meshes."""
        coarse, fine = self.meshes.coarse.with_exact_tangent(), self.meshes.fine.with_exact_tangent()
        return Segment(coarse, self.before.coarse, self.after.coarse), Segment(fine, self.before.fine, self.after.fine)

    def changes(self) -> list[Placed]:
        """Changes of the stability index, and the turning point that has none, or where the branch meets rest.

        Raises
        ------
        LocationError
            If index and sense of travel do not go together: the two ends are not on one branch.
        """
        turn = self.turn()
        rest = passes_rest(self.meshes, self.before, self.after) if turn is None else None
        if rest is not None:
            placed = self._index_changes_up_to(SHORT_OF * rest.t)
            index = index_at(rest.t, self.before.fine.index, placed)
            return [*placed, (rest.t, found_at(TURN, self.meshes, rest, index, index))]
        placed = self.index_changes(turn)
        if turn is not None and not any(found.fold for _, found in placed):
            meets = self.meshes.fine.meets_mirror_image(turn.fine, NEARLY)
            if not (meets or self.doubted) and all(found.certain for _, found in placed):
                raise LeftTheBranchError(LeftTheBranchError.STEP)
            index = index_at(turn.t, self.before.fine.index, placed)
            placed.append((turn.t, found_at(TURN, self.meshes, turn, index, index)))
        return placed

    def changes_past_the_start(self, leaves: Leaving) -> list[Placed]:
        """The same where a branch leaves another, from a place on, close by, at which it is by itself.

        Raises
        ------
        LocationError
            If it has not the index there that it has to have: next to a double load, a step has gone to a third branch.
        """
        length = self.before.fine.along(self.after.fine)
        strayed = False
        for early in [distance / length for distance in EARLY if distance < 0.5 * length] or PARTS_OF_SHORT:
            try:
                coarse, fine = (segment(early) for segment in self.segments)
            except LocationError:
                continue
            if not self._is_steep(fine):
                continue
            strayed = fine.index != leaves.index(fine)
            if strayed and not self.doubted:
                continue
            point = self.meshes.point(coarse, fine)
            placed = _Stretch(self.meshes, point, self.after, self.doubted).changes()
            placed = [(early + (1.0 - early) * t, found) for t, found in placed]
            if strayed:
                error = abs(self.after.lam - self.before.lam)
                index = leaves.index(fine), fine.index
                placed.insert(0, (early, LocatedEvent(INDEX, point, self.meshes, error, *index, certain=False)))
            return placed
        if strayed:
            raise LeftTheBranchError(LeftTheBranchError.FIRST_STEP)
        return []

    def _is_steep(self, state: State) -> bool:
        """Whether the sense of travel in λ just past the start is known: λ grows like the distance or its square."""
        start = self.before.fine
        distance, rise = start.along(state), state.lam - start.lam
        return rise != 0.0 and EVEN_RISE[0] < state.tangent_lam * distance / rise < EVEN_RISE[1]

    def index_changes(self, turn: LocatedZero | None = None) -> list[Placed]:
        """Changes of the stability index; together they make up the whole difference of the two ends.

        Where a branch meets its own mirror image the index is the same on both sides, and its softest eigenvalue, which
        vanishes there without changing sign, must not be looked at.
        """
        if turn is None and self.before.fine.index == self.after.fine.index:
            return []
        if turn is not None and self.meshes.fine.meets_mirror_image(turn.fine, NEARLY):
            return self._index_changes_up_to(SHORT_OF * turn.t)
        found = index_crossings(*self.segments, [] if turn is None else [turn.t], doubted=self.doubted)
        return [(crossing.t, self._changed(crossing)) for crossing in found]

    def _index_changes_up_to(self, end: float) -> list[Placed]:
        """The same on the way to where the branch ends at another: those that both meshes show."""
        found = index_crossings(*self.segments, end=end, doubted=True)
        return [(crossing.t, self._changed(crossing)) for crossing in found if crossing.place is not None]

    def _changed(self, crossing: Crossing) -> LocatedEvent:
        index = crossing.before, crossing.after
        if crossing.place is None:  # no place on the coarse mesh: nothing is known of the error but the step
            error = abs(self.after.lam - self.before.lam)
            try:
                point = self.meshes.point(self.segments[0](crossing.t), self.segments[1](crossing.t))
            except LocationError:
                point = self.before
            return LocatedEvent(INDEX, point, self.meshes, error, *index, certain=False)

        def again(finer: _Stretch) -> LocatedZero | None:
            near = [c for c in index_crossings(*finer.segments) if c.place is not None and (c.before, c.after) == index]
            return min(near, key=lambda c: abs(c.t - crossing.t)).place if near else None

        return self._refined(
            crossing.place,
            again,
            lambda meshes, at: found_at(INDEX, meshes, at, *index, fold=crossing.fold, doubt=crossing.doubt),
        )

    def turn(self) -> LocatedZero | None:
        """The place where λ turns back, if it does."""
        first, last = self.before.fine.tangent_lam, self.after.fine.tangent_lam
        if first * last >= 0.0:
            return None
        place = locate(*self.segments, _sense, (first, last), ROUGHLY)
        if not self.meshes.fine.meets_mirror_image(place.fine, NEARLY):
            place = locate(*self.segments, _sense, (first, last))
        return place

    def at_level(self, lam: float) -> LocatedZero | None:
        """Where λ has just this value on both meshes, if it does not turn back."""
        coarse, fine = (segment.exactly(lam) for segment in self.segments)
        return None if coarse is None or fine is None else LocatedZero(fine[0], coarse[1], fine[1])

    def starts_at(self, event: Event) -> bool:
        """Whether the zero of an event is the start itself, to within what is known of its values there."""
        ends = self._values(event)
        return abs(ends[0]) <= AT_START * abs(ends[1] - ends[0])

    def _values(self, event: Event) -> tuple[float, float]:
        return event.function(self.before.lam, self.before.values), event.function(self.after.lam, self.after.values)

    def zeros(self, event: Event, index: int, changes: list[Placed]) -> list[Placed]:
        """The zero of an event, if its values at the two ends have opposite signs; ``index`` is that at the start."""
        ends = self._values(event)
        if ends[0] == 0.0 or (ends[0] < 0.0) == (ends[1] < 0.0):
            return []

        def value(segment: Segment, state: State) -> float:
            return event.function(state.lam, self.meshes.measure(segment.family, state)[0])

        def again(segment: _Stretch) -> LocatedZero:
            exact = None if event.level is None else segment.at_level(event.level)
            return exact or locate(*segment.segments, value, segment._values(event))

        place = again(self)
        index = index_at(place.t, index, changes)

        rising = ends[1] > ends[0]
        found = self._refined(
            place, again, lambda meshes, at: found_at(event.name, meshes, at, index, index, rising=rising)
        )
        return [(place.t, self._doubted(event, place, found))]

    def _doubted(self, event: Event, place: LocatedZero, found: LocatedEvent) -> LocatedEvent:
        """Count to the error of λ what is not known of an event's function, over its slope.

        Of a function that is bent in one sense, the slope at its zero lies between those of the chords to both ends.
        Where both meshes put the zero at the same place by chance, the ends of the stretch tell how well they agree.
        """
        if event.level is not None:
            return found
        ends = self._values(event)
        slope = min(abs(ends[0]) / max(place.t, TINY), abs(ends[1]) / max(1.0 - place.t, TINY))

        def doubt(unknown: float) -> float:
            return self.segments[1].doubt(place.fine, place.t, min(1.0, unknown / max(slope, TINY)))

        beside = min(unknown_at(event, point) for point in (self.before, self.after))
        here = doubt(unknown_at(event, found.point))
        return replace(found, lam_error=max(found.lam_error, doubt(beside)) + here)

    def _refined(
        self,
        place: LocatedZero,
        again: Callable[[_Stretch], LocatedZero | None],
        found: Callable[[TwoMeshes, LocatedZero], LocatedEvent],
    ) -> LocatedEvent:
        """Describe a located point on meshes that are refined until it meets the tolerance, or it no longer helps."""
        best, segment = found(self.meshes, place), self
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
            better = found(finer.meshes, new)
            if better.point.excess > 0.5 * best.point.excess:
                break
            best, segment = better, finer
        return best

    def on_finer(self, point: MeshedState) -> _Stretch | None:
        """Return the same stretch on meshes with smaller elements where ``point`` is least resolved."""
        finer = self.meshes.refined(point)
        if finer is None:
            return None
        ends = [finer.adopt(self.meshes, p)[1] for p in (self.before, self.after)]
        return None if ends[0] is None or ends[1] is None else _Stretch(finer, ends[0], ends[1])


def _sense(_: Segment, state: State) -> float:
    """Sense of travel in λ."""
    return state.tangent_lam
