"""Following a path of partial contact through changes of its pattern."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.off_wall.arrange import needs_new_elements, with_new_elements
from rodwell.analysis.off_wall.changes import Changed, changed, growing_direction
from rodwell.analysis.off_wall.conditions import LEAVES, UNHELD, PatternedState, conditions
from rodwell.analysis.off_wall.control import FORCE, Control
from rodwell.analysis.off_wall.happening import (
    BRANCH_POINT,
    END,
    FOLD,
    LOAD_PEAK,
    Followed,
    PathEvent,
    together,
    unresolved,
)
from rodwell.analysis.off_wall.soft import jumped, stopped, with_ends_of
from rodwell.analysis.off_wall.steps import kinked
from rodwell.analysis.off_wall.vanishing import FARTHEST, SEARCH, about_to_vanish, opened_again, shortened, unbalanced
from rodwell.analysis.off_wall.within import Step, driven_rate, first_event
from rodwell.numerics.stretches.walk import (
    Motion,
    Passed,
    between,
    length,
    locate,
    search,
    step,
    tangent,
    tangent_in_load,
)
from rodwell.quantities.arrays import FloatArray

FIRST_STEP, LARGEST_STEP, SMALLEST_STEP = 0.02, 0.25, 1e-7
EASY, HARD = 5, 8
"""Steps of Newton's method up to which the next step grows, and from which on it shrinks."""

MOST_SHRUNK = 0.6
"""By how much of its length a stretch may shrink in a step."""

PAST = 0.02
"""Part of a step by which a place is passed where something happens that ends nothing."""

SMALLEST_PART, NEARLY = 0.1, 1e-9
"""A gap that opens is tried down to this part of its usual first length; a condition missed by so much is met."""

MOST_STATES = 2000


def followed(
    start: PatternedState,
    until: float,
    *,
    along: Motion | None = None,
    control: Control = FORCE,
    most_states: int = MOST_STATES,
    largest: float = LARGEST_STEP,
    progress: Callable[[float], str | None] | None = None,
) -> Followed:
    """Follow equilibria from a state until the controlled quantity has the value ``until``.

    The path ends where it folds in that quantity, or loses stability while it is controlled, or for what ``progress``,
    which is told the end force of each state, returns as a reason.
    """
    if along is None:
        sense = until - control.value(start.solved)
        along = tangent_in_load(start.solved, sense if control.by_force else -sense)  # at first the load grows with it
        if control.rate(start.solved, along) * sense < 0.0:
            along = along.times(-1.0)
    return _Walker(Followed(), start, along, until, control, progress=progress, largest=largest).walk(most_states)


@dataclass(eq=False)
class _Walker:
    """A path being followed: where it is, in which direction, with which step."""

    result: Followed
    state: PatternedState
    along: Motion
    until: float
    control: Control
    size: float = FIRST_STEP
    largest: float = LARGEST_STEP
    close: bool = False
    before: Passed | None = None
    progress: Callable[[float], str | None] | None = None

    def walk(self, most_states: int) -> Followed:
        """Go on until the end of the range, or until it cannot."""
        self.result.states.append(self.state)
        self.sense = float(np.sign(self.until - self.control.value(self.state.solved)))
        while not self.result.ended:
            if len(self.result.states) >= most_states:
                self.result.ended = f"it has more than {most_states} states"
            elif not self._short_stretch():
                self._next()
        self.result.along = self.along
        return self.result

    def _next(self) -> None:
        self._renew_elements()
        state = self.state
        lengths, rates = self._lengths()
        most = MOST_SHRUNK / max(float(np.max(-rates / lengths)), MOST_SHRUNK / self.largest)  # none is passed over
        outcome, solved, steps = step(state.model, state.solved, self.along, min(self.size, most), self.before)
        if solved is None:
            self._shorten(f"{outcome.value}, beyond F = {state.load:.8g} B/L²")
            return
        if state.model.soft and jumped(state.solved, solved, min(self.size, most)):
            self._shorten(f"the path bends sharply beyond F = {state.load:.8g} B/L²")  # the wall's push begins, or ends
            return
        new = stopped(PatternedState(state.pattern, state.elements, solved))
        turned = tangent(new.solved, self.along)
        found = first_event(Step(state, self.along, new, turned, self.control, self.until, self.sense))
        if isinstance(found, str):
            self._shorten(found)
        elif found is None:
            self._accept(new, turned)
            self.size *= 0.6 if steps >= HARD else (1.5 if steps <= EASY else 1.0)
            self.size = min(self.size, self.largest)
        elif found.kind != END and self._closer(found):
            return
        elif found.kind in (FOLD, BRANCH_POINT, LOAD_PEAK):
            self._turned(found, new, turned)
        elif found.kind == END:
            self._accept(found.state, turned)
            if self.result.last is found.state:
                self.result.events.append(found)
                self.result.ended = END
        else:
            self._change(found)

    def _closer(self, event: PathEvent) -> bool:
        """Behind a soft wall, whether the step is taken again on elements that end where contact does at an event."""
        again = None
        if self.state.model.soft and event.state.bounds.size > 2 and not self.close:
            again = with_ends_of(self.state, event.state)
        self.close = again is not None
        if again is not None:
            self.state, self.along = again, tangent_in_load(again.solved, self.along.load)
        return self.close

    def _lengths(self) -> tuple[FloatArray, FloatArray]:
        """Lengths of the stretches and their rates along the path."""
        return np.diff(self.state.bounds), np.diff(np.concatenate([[0.0], self.along.breaks, [0.0]]))

    def _renew_elements(self) -> None:
        """Make new elements where the old ones no longer fit; breaks and load tell the direction."""
        if self.close or not needs_new_elements(self.state):
            return
        renewed = with_new_elements(self.state)
        if renewed is not None:
            guide = Motion(np.zeros_like(renewed.solved.shape.nodes), self.along.breaks, self.along.load, np.zeros(0))
            self.state, self.along = renewed, tangent(renewed.solved, guide)

    def _turned(self, event: PathEvent, new: PatternedState, turned: Motion) -> None:
        """At a fold or a change of the index: go on, or end."""
        self.result.events.append(event)
        self.result.states.append(event.state)
        worse = self.control.index(new.solved, turned, self.sense) > self.control.index(
            self.state.solved, self.along, self.sense
        )
        if event.kind == FOLD or (event.kind == BRANCH_POINT and worse):
            self.state, self.result.ended = event.state, event.kind
        else:
            self._pass(event, new, turned)

    def _pass(self, event: PathEvent, new: PatternedState, turned: Motion) -> None:
        """Go on behind an event that ends nothing: to the end of the step, or just past it if more happens within."""
        state = self.state
        if event.kind == LOAD_PEAK and self.control.rate(new.solved, turned) * self.sense < 0.0:
            value = driven_rate(self.control, self.along)  # behind something soft the load turns just before
            at = locate(state.model, event.state.solved, new.solved, value)
            if at is not None:
                fold = PatternedState(state.pattern, state.elements, at)
                self._turned(PathEvent(FOLD, fold, (), value, [], self.along, (state, new)), new, turned)
                return
        if any(one.value < 0.0 for one in conditions(new)):
            chain, load = state.solved.shape.chain, state.load
            there = length(between(state.solved.shape, event.state.solved.shape), chain, load)
            near = step(state.model, state.solved, self.along, there * (1.0 + PAST) + PAST * self.size)[1]
            if near is not None:
                new = PatternedState(state.pattern, state.elements, near)
                turned = tangent(near, self.along)
        self._accept(new, turned)

    def _change(self, event: PathEvent) -> None:
        """Go over to the pattern that follows."""
        self.result.states.append(event.state)
        self.state = event.state
        if event.together[0].kind == LEAVES:  # a gap so short that its ends no longer push
            free = [i for i in (event.together[0].number, event.together[0].number + 1)
                    if not event.state.pattern.touching[i]]  # fmt: skip
            if not self._without(free):
                self.result.ended = unresolved(event)
            return
        after, part = None, 1.0
        while part >= SMALLEST_PART:
            found = changed(event.state, event.together, part)
            if found is None:
                break
            after, along = found, growing_direction(found, self.along.load or self.sense)
            beyond = (self.control.value(found.state.solved) - self.until) * self.sense > 0.0
            if self.control.rate(found.state.solved, along) * self.sense > 0.0 and not beyond:
                break
            part *= 0.5  # the first state may lie behind a fold
        if after is None:
            self.result.ended = unresolved(event)
            return
        if after.name:
            self.result.events.append(replace(event, kind=after.name, s=tuple(sorted({*event.s, *after.too}))))
        self._enter(after)

    def _enter(self, after: Changed) -> None:
        """Start on a new pattern, in the sense in which it exists."""
        along = growing_direction(after, self.along.load or self.sense)
        turned_back = self.control.rate(after.state.solved, along) * self.sense < 0.0
        self.state, self.size = after.state, max(min(self.size, 0.5 * FIRST_STEP), 1e-3)
        self.along = along
        if (self.control.value(self.state.solved) - self.until) * self.sense > 0.0:  # the first state lies beyond
            last = self.control.at(self.state, self.until)
            if last is not None and all(one.value > -NEARLY * abs(self.state.load) for one in conditions(last)):
                self.state, self.result.ended = last, END
                self.result.states.append(last)
                return
        if turned_back:
            self.result.ended = FOLD
            self.result.events.append(PathEvent(FOLD, self.result.last))
        else:
            self._take(self.state)

    def _short_stretch(self) -> bool:
        """Whether a stretch was about to vanish, and the pattern without it has been entered."""
        vanishing = about_to_vanish(self.state, self._lengths()[1])
        return bool(vanishing) and self._without(vanishing)

    def _without(self, stretches: list[int]) -> bool:
        """Enter the pattern without stretches that vanish, at the place where they do; False if that was not found."""
        found = shortened(self.state, stretches)
        if found is None:
            return False
        after, condition = found
        along = tangent_in_load(after.state.solved, self.along.load)
        at = search(after.state.model, after.state.solved, along, after.grows, SEARCH, FARTHEST)
        if at is None or not at.shape.in_order:
            return False
        new, old = PatternedState(after.state.pattern, after.state.elements, at), self.state.solved
        there, here = (self.control.value(one) for one in (at, old))
        behind = condition.kind != UNHELD and (there - here) * self.sense < -NEARLY * abs(here)  # on another path
        if behind or (there - self.until) * self.sense > 0.0:  # not before the end
            return False
        if self.control.index_at(at) > self.control.index_at(old):
            return False  # it loses stability before: where it does is found with the stretch
        if any(one.value < -NEARLY * max(abs(new.load), 1.0) for one in conditions(new)):
            return False
        at_once, after = together(new, [condition], 0, strict=False), Changed(new, after.grows, after.name)
        s = tuple(sorted(one.s for one in at_once))
        event = PathEvent(after.name, new, s, after.grows, together=at_once, along=along)
        self.result.events += [event] if event.kind else []
        if condition.kind == UNHELD and not kinked(new, condition.s):
            self._open_again(event, after)
        else:
            self._enter(after)
        return True

    def _open_again(self, event: PathEvent, closed: Changed) -> None:
        """Enter the pattern in which a gap is open again that opens with the slope, where it has closed."""
        self.state = event.state
        self.result.states.append(event.state)
        opened = opened_again(closed, event.together, self.along.load)
        if opened is None:
            self.result.ended = unresolved(event)
        else:
            self.result.events.append(replace(event, kind=opened.name))
            self._enter(opened)

    def _accept(self, new: PatternedState, along: Motion) -> None:
        self.before = self.state.solved, self.along
        self.state, self.along, self.close = new, along, False
        self._take(new)
        if not self.result.ended and self.progress is not None and (enough := self.progress(new.load)):
            self.result.ended = enough

    def _take(self, new: PatternedState) -> None:
        """A state of the path; before one that misses its balance the path ends."""
        self.result.ended = unbalanced(new) or ""
        if not self.result.ended:
            self.result.states.append(new)

    def _shorten(self, why: str) -> None:
        self.size *= 0.4
        if self.size < SMALLEST_STEP:
            self.result.ended = why
