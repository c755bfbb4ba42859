"""From the wall into the hole: a branch goes on off the wall where it lifts off."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from rodwell.analysis.beyond.carry import carried
from rodwell.analysis.beyond.off_wall_branch import END, OffWallBranch, OffWallPoint
from rodwell.analysis.off_wall.arrange import at_load
from rodwell.analysis.off_wall.changes import changed, unheld
from rodwell.analysis.off_wall.conditions import PatternedState, conditions
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.off_wall.curved.refused import refuse_holes
from rodwell.analysis.off_wall.following import followed
from rodwell.analysis.off_wall.happening import BRANCH_POINT, FOLD, Followed, PathEvent
from rodwell.analysis.off_wall.resolve import resolved_event
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.stretches.walk import between, length, step, tangent
from rodwell.problem.ends import OFF_WALL_ENDS
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Value

GAP_OPENS, TOUCH_DOWN = "gap_opens", "touch_down"

SAME = 1e-6
"""How close, relatively, lift-off on the wall and the opening of the first gap are, which are one."""

MOST_TURNS = 12
"""Folds and branch points through which a branch is followed off the wall."""

MIRRORED = "it meets a symmetric branch, where it turns into its own mirror image"
COMPLETE = "contact is complete again, and it goes on along the wall"
"""Why a branch off the wall ends at another, or comes back to the wall."""

PAST = (1.0, 0.3, 0.1, 0.03)
"""Parts of the rest of a step in which a branch is entered past a fold or branch point."""

Progress = Callable[[float], None]


def check_crosses(problem: Problem) -> None:
    """Raise, with the reason, if branches of a problem are not followed off the wall.

    Raises
    ------
    InputError
        In a curved hole along an axis, out of the vertical plane or of a string, outside a cylinder or on top of it,
        without lateral weight, at steps of stiffness or of clearance, and at ends that are not radially held.
    """
    field = "off_wall"
    refuse_holes(problem)
    loose = [end for end in problem.ends if end in OFF_WALL_ENDS]
    if loose:
        raise InputError("ends", "-".join(problem.ends), f"the rod leaves the wall at a {loose[0]} end as it buckles: "
                         "rodwell.load_path (`rodwell path`) follows it")  # fmt: skip
    if problem.outside:
        raise InputError("outside", True, "a rod outside a cylinder leaves it for good: leave off_wall out")
    if problem.on_top:
        raise InputError("on_top", True, "nothing presses a rod on top to the wall: leave off_wall out")
    if problem.untouched:
        raise InputError(field, True, "nothing presses the rod to the wall, which it leaves as it buckles: "
                         "rodwell.load_path (`rodwell path`) follows it")  # fmt: skip
    problem.refuse_bridges("branches that go on off the wall")
    if problem.rod.stiffness_steps.size:
        raise InputError(field, True, "a string leaves the wall at a step of its stiffness as it buckles: "
                         "rodwell.load_path (`rodwell path`) follows it")  # fmt: skip


def beyond_lift_off(
    before: Equilibrium,
    lift_off: float,
    until: float,
    back: float,
    rtol: float,
    progress: Progress | None = None,
) -> OffWallBranch:
    """Follow a branch on, off the wall, from the last of its states before lift-off.

    It goes through folds and branch points, up to :data:`MOST_TURNS` of them.

    Parameters
    ----------
    before
        A state on the wall before lift-off, with nothing in between.
    lift_off
        End force at lift-off in B/L², tension positive.
    until
        End force at which it ends.
    back
        End force at which it ends on the other side, should it turn back.
    rtol
        Relative tolerance of the loads of special points.
    progress
        Called with the end force of each new state.

    Raises
    ------
    NotConvergedError
        If no state off the wall was found that goes on where the branch on the wall lifts off.
    """
    start = carried(rod_in_hole(before.problem), before)
    if start is not None and (places := unheld(start)):  # at kinks of the stiffness
        off = changed(start, places)
        start = None if off is None else at_load(off.state, before.force)
    if start is None:
        raise NotConvergedError("the state before lift-off was not found as one of a rod that may leave the wall")

    def told(force: float) -> None:
        if progress is not None:
            progress(force)

    walk = _Walk(before.problem, until, back, rtol)
    path = followed(start, walk.target(lift_off - before.force, lift_off), progress=told)
    opening = next(iter(path.events), None)
    if opening is None or not _at(opening, lift_off, rtol) or opening.kind != GAP_OPENS or len(path.states) < 2:
        raise NotConvergedError(f"no state off the wall was found that goes on at lift-off: {path.ended}")
    first = next(i for i, state in enumerate(path.states) if state is opening.state)
    walk.take(Followed(path.states[first:], path.events[1:], path.ended, path.along))
    return walk.on(told)


def _at(opening: PathEvent, lift_off: float, rtol: float) -> bool:
    """Whether a gap opens at lift-off: on elements along a path, or on those on which it is located."""
    size = SAME * abs(lift_off)
    if abs(opening.state.load - lift_off) <= size:
        return True
    return abs(resolved_event(opening, rtol).load.value - lift_off) <= size


@dataclass(eq=False)
class _Walk:
    """A branch off the wall in the making."""

    problem: Problem
    until: float
    back: float
    rtol: float
    states: list[PatternedState] = field(default_factory=list)
    events: list[PathEvent] = field(default_factory=list)
    ended: str = ""

    def target(self, sense: float, here: float) -> float:
        """Where a walk ends that goes this way from an end force: the nearer limit ahead, or far off."""
        ahead = [force for force in (self.until, self.back) if (force - here) * sense > 0.0]
        return min(ahead, key=lambda force: abs(force - here)) if ahead else here

    def take(self, path: Followed) -> None:
        """Add what was followed."""
        again = [i for i, state in enumerate(path.states) if state.pattern.full and (i or self.states)]
        if again:
            path.states, path.ended = path.states[: again[0] + 1], COMPLETE
        kept = {id(state) for state in path.states}
        self.states += path.states
        self.events += [event for event in path.events if event.kind != END and id(event.state) in kept]
        self.ended = path.ended

    def on(self, told: Callable[[float], None]) -> OffWallBranch:
        """Go on through folds and branch points, until the end."""
        turns = 0
        while self.ended in (FOLD, BRANCH_POINT):
            event, turns = self.events[-1], turns + 1
            if _meets_mirror_image(event):
                self.ended = MIRRORED
                break
            new = None if turns > MOST_TURNS else _past(event)
            if new is None:
                where = "a limit point" if self.ended == FOLD else "a branch point"
                self.ended = f"it was not followed on past {where} at F = {event.state.load:.8g} B/L²"
                break
            assert event.along is not None
            along = tangent(new.solved, event.along)
            self.take(followed(new, self.target(along.load, new.load), along=along, progress=told))
        self._keep_explained()
        return self._made()

    def _keep_explained(self) -> None:
        """Cut the branch where its stability index changes and nothing was found that changes it."""
        met = {id(event.state) for event in self.events}
        for i, (one, other) in enumerate(pairwise(self.states)):
            if one.solved.index != other.solved.index and not met & {id(one), id(other)}:
                kept = {id(state) for state in self.states[: i + 1]}
                self.states = self.states[: i + 1]
                self.events = [event for event in self.events if id(event.state) in kept]
                self.ended = f"its stability index changes beyond F = {one.load:.8g} B/L² where no event was located"
                return

    def _made(self) -> OffWallBranch:
        points = [self._point(event) for event in self.events]
        last, index = self.states[-1], self.states[-1].solved.index
        load = Value(last.load, 0.0)
        if points and last is self.events[-1].state:  # it ends at an event
            load, index = points[-1].reached, points[-1].index_before
        points.append(OffWallPoint(END, load, (), index, index, contact_state(last)))
        reached = self.ended == END and abs(last.load - self.until) <= SAME * abs(self.until)
        why = self.ended
        if why == END and not reached:
            why = f"the load turned, and came back to F = {last.load:.6g} B/L²"
        return OffWallBranch(self.problem, tuple(self.states), tuple(points), reached, why, self.until, self.rtol)

    def _point(self, event: PathEvent) -> OffWallPoint:
        """What happens at a place, located to the tolerance."""
        one = resolved_event(event, self.rtol)
        state = ContactState(self.problem, event.state, one.event.state)
        places = tuple(map(float, event.s))
        kind = TOUCH_DOWN if self.ended == COMPLETE and event is self.events[-1] else event.kind
        kind = BRANCH_POINT if _meets_mirror_image(event) else kind
        return OffWallPoint(kind, one.load, places, *self._indices(event), state, one.met)

    def _indices(self, event: PathEvent) -> tuple[int, int]:
        """The stability index on either side of an event."""
        if event.kind in (FOLD, BRANCH_POINT) and event.between is not None:
            return event.between[0].solved.index, event.between[1].solved.index
        here = next((i for i, state in enumerate(self.states) if state is event.state), len(self.states) - 1)
        near = np.clip([here - 1, here + 1], 0, len(self.states) - 1)
        return self.states[near[0]].solved.index, self.states[near[1]].solved.index


def _meets_mirror_image(event: PathEvent) -> bool:
    """Whether a branch turns back since it meets its own mirror image: its stability index does not change there."""
    if event.kind != FOLD or event.between is None:
        return False
    before, after = event.between
    return before.solved.index == after.solved.index


def _past(event: PathEvent) -> PatternedState | None:
    """A state just past a fold or branch point, in which what must hold of contact does; None if none was found."""
    if event.between is None or event.along is None:
        return None
    first, last = event.between
    chain, shape = first.solved.shape.chain, first.solved.shape
    here, whole = (length(between(shape, one.solved.shape), chain, first.load) for one in (event.state, last))
    for part in PAST:
        solved = step(first.model, first.solved, event.along, here + part * (whole - here))[1]
        new = None if solved is None else PatternedState(first.pattern, first.elements, solved)
        if new is not None and all(one.value >= 0.0 for one in conditions(new)):
            return new
    return None
