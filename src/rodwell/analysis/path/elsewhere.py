"""A state of a rod that may have left the wall, followed to another problem and another load.

The numbers of the problem move in a straight line from the old ones to the new ones, the end force with them. At each
place the equilibrium is solved for at that load, contact boundaries with it, from the one before. Where a condition on
contact ceases to hold within a step, the place is located, the pattern changes there as along a load path
(:mod:`rodwell.analysis.off_wall.changes`), and a stretch about to vanish goes as there. A stable state cannot turn back
on the way, so no arclength is needed: where it loses stability, or no state is found beyond, the rod gives way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.beyond.between import MISSED
from rodwell.analysis.off_wall.arrange import needs_new_elements, solved, with_new_elements
from rodwell.analysis.off_wall.certificate import LIMIT
from rodwell.analysis.off_wall.changes import changed
from rodwell.analysis.off_wall.conditions import LEAVES, UNHELD, Condition, PatternedState, conditions, watched
from rodwell.analysis.off_wall.happening import together
from rodwell.analysis.off_wall.pattern import pieces_of
from rodwell.analysis.off_wall.soft import stopped
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.off_wall.vanishing import about_to_vanish, shortened
from rodwell.analysis.path.between import Way, check_alike
from rodwell.analysis.path.checks import checked_problem
from rodwell.analysis.path.plane import freed
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.stretches.carry import sampler
from rodwell.numerics.stretches.walk import between, length, zero_within
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import checked_force

NEAR = 0.05
"""Part by which numbers move in the first step, about."""

FARTHEST, WANTED = 0.25, 0.1
"""Most arclength of a step, as along a load path, and what is aimed at: the next one is longer or shorter by that."""

SHORTER, SHORTEST = 0.4, 1e-3
"""By how much a step is shortened that did not succeed, and part of the whole way below which it is not any more."""

LOCATED = 1e-4
"""Part of a step to which the place is located at which a condition on contact vanishes."""

PARTS = (1.0, 0.5, 0.25, 0.1)
"""First lengths of a gap, or a contact, with which a new pattern is tried, as parts of the usual one."""

Progress = Callable[[float], None]
"""Called before each step with the part of the way that has been gone; what it raises ends the computation."""


def follow_contact(
    start: ContactState, problem: Problem, force: float | None = None, *, progress: Progress | None = None
) -> ContactState:
    """Follow a stable state of a rod in its hole to other numbers of its problem, under a load that moves with them.

    Parameters
    ----------
    start
        A state that may have left the wall: of a load path, ``path.at(force)[0].state``.
    problem
        The problem to follow it to. It differs from that of the state in numbers only: weight, inclination, clearance,
        twist, torsion, lengths and ratios of sections. They move in a straight line.
    force
        End force at s = 1 in B/L² of that problem, tension positive; None: that of the state.
    progress
        Called before each step with the part of the way that has been gone, from 0 to 1.

    Returns
    -------
    ContactState
        The stable equilibrium that hangs together with the state. Along a load path of the new problem the rod may be
        in another one at that load, since where it is depends on what came before.

    Raises
    ------
    InputError
        If the problems differ in more than numbers, the state is not stable, or rods of the new problem have no
        states off the wall here (:func:`rodwell.load_path`).
    NotConvergedError
        If the rod gives way before the new problem is reached, contact changes in a way that was not resolved, or the
        state there misses its balance. The text has the part of the way up to which it was followed.
    """
    checked_problem(problem)
    check_alike(start.problem, problem)
    if start.stability_index:
        raise InputError("start", f"stability index {start.stability_index}", "must be a stable state: index 0")
    end = start.force if force is None else checked_force("force", force)
    way = Way(start.problem, problem, start.force, end, start.fine.model.stiffness)
    state: PatternedState | None = start.coarse
    if start.coarse.pattern.planar and problem.in_space:
        state = freed(start.coarse)
    if state is None:
        raise NotConvergedError("the state in the vertical plane was not found as one that may leave it")
    return _Mover(way, state, progress or (lambda _: None)).moved()


@dataclass(eq=False)
class _Mover:
    """A state on its way: how far it is, and how its stretches became longer or shorter last."""

    way: Way
    state: PatternedState
    tell: Progress
    part: float = 0.0
    rates: FloatArray | None = None
    why: str = ""

    def moved(self) -> ContactState:
        """Go all the way."""
        size = min(1.0, NEAR / max(self.way.far, NEAR))
        while self.part < 1.0:
            before, begun = self.state, self.part
            self.tell(begun)
            if self._step(min(begun + size, 1.0)):
                size = max(self.part - begun, SHORTEST) * self._growth(before)
                self._renew()
                continue
            size *= SHORTER
            if size < SHORTEST:
                raise NotConvergedError(f"the state was followed {self.part:.1%} of the way: {self.why}")
        found = contact_state(self.state)
        if found.certificate.worst > LIMIT:
            raise NotConvergedError(f"what was found misses its balance by {found.certificate.worst:.1e}")
        return found

    def _growth(self, before: PatternedState) -> float:
        """By how much the next step is longer, from how far the last one led."""
        if before.pattern != self.state.pattern or before.elements != self.state.elements:
            return 1.0
        far = _apart(before, self.state)
        return float(np.clip(WANTED / max(far, 1e-9), 0.5, 4.0))

    def _renew(self) -> None:
        """Make new elements where the old ones no longer fit."""
        if needs_new_elements(self.state):
            self.state = with_new_elements(self.state) or self.state

    def _at(self, state: PatternedState, part: float) -> PatternedState | None:
        """The state of the same pattern at a part of the way; None if there is none near."""
        shape, model = state.solved.shape, self.way.model(part)
        corners = sum(len(pieces) - 1 for pieces in state.elements)
        alike = corners == pieces_of(model.problem, state.pattern.fixed)[0].size  # stations may have come together
        found = solved(
            model, state.pattern, shape.breaks, self.way.load(part), sampler(shape),
            degree=shape.chain.degree, elements=state.elements if alike else None,
        )  # fmt: skip
        if found is None or not found.solved.shape.in_order:
            return None
        return stopped(found)

    def _step(self, part: float) -> bool:
        """Go to a part of the way, or to where the pattern has changed before it; say whether that was done."""
        new = self._at(self.state, part)
        if new is None:
            self.why = "the rod gives way there, or no state was found beyond"
            return self._without_short(part)
        broken = _broken(new)
        if broken:
            return self._without_short(part) or self._changed(new, part, broken)
        if not self._follows(self.state, new):
            return False
        self._take(new, part)
        return True

    def _follows(self, old: PatternedState, new: PatternedState) -> bool:
        """Whether a state is stable and hangs together with one before, as far as a step shows."""
        if new.solved.index:
            self.why = "it loses stability there, and the rod gives way"
            return False
        if old.pattern == new.pattern and old.elements == new.elements and _apart(old, new) > FARTHEST:
            self.why = "the rod gives way there, or the state changes too fast to be followed"
            return False
        return True

    def _take(self, new: PatternedState, part: float) -> None:
        same = new.bounds.size == self.state.bounds.size
        self.rates = (np.diff(new.bounds) - np.diff(self.state.bounds)) / (part - self.part) if same else None
        self.state, self.part = new, part

    def _without_short(self, part: float) -> bool:
        """Go on without stretches that are about to vanish, if that pattern holds at a part of the way."""
        short = [] if self.rates is None else about_to_vanish(self.state, self.rates)
        after = shortened(self.state, short) if short else None
        if after is None or after[1].kind == UNHELD:
            return False
        new = self._at(after[0].state, part)
        if new is None or _broken(new) or not self._follows(after[0].state, new):
            return False
        self._take(new, part)
        return True

    def _changed(self, new: PatternedState, part: float, broken: list[Condition]) -> bool:
        """Go over to the pattern that follows where the first of the conditions ceases to hold before ``new``."""
        located = [there for one in broken if (there := self._located(new, part, one)) is not None]
        if len(located) < len(broken):
            self.why = "contact changes there, at a place that was not located"
            return False
        k = int(np.argmin([place for place, _ in located]))
        at = located[k][1]
        if at.solved.index:
            self.why = "it loses stability there, and the rod gives way"
            return False
        vanished = together(at, broken, k)
        s = ", ".join(f"{one.s:.4g}" for one in vanished)
        self.why = f"contact changes there at s = {s}, in a way that was not resolved"
        if vanished[0].kind == LEAVES:
            return False
        for share in PARTS:
            self.tell(self.part)
            after = changed(at, vanished, share)
            if after is None:
                continue
            beyond = self._at(after.state, part)
            if beyond is None or _broken(beyond) or not self._follows(after.state, beyond):
                continue
            self._take(beyond, part)
            return True
        return False

    def _located(self, new: PatternedState, part: float, condition: Condition) -> tuple[float, PatternedState] | None:
        """Where a condition vanishes between the state and a new one: the part of the way, and the state there."""
        begun = self.part
        known = {0.0: self.state, 1.0: new}

        def value(share: float) -> float:
            if share not in known:
                near = known[min(known, key=lambda one: abs(one - share))]
                found = self._at(near, begun + share * (part - begun))
                if found is None:
                    raise _LostError
                known[share] = found
            return watched(condition, known[share])

        ends = watched(condition, self.state), watched(condition, new)
        if not ends[0] * ends[1] < 0.0:
            return (begun, self.state) if ends[0] <= 0.0 else None
        try:
            share = zero_within(value, ends, LOCATED)
        except _LostError:
            return None
        return begun + share * (part - begun), known[share]


class _LostError(Exception):
    """Newton's method failed within a step."""


def _broken(state: PatternedState) -> list[Condition]:
    """Conditions on contact that do not hold: of several of one kind on one stretch the first."""
    found: dict[tuple[str, int], Condition] = {}
    for one in conditions(state):
        if one.value < MISSED:
            found.setdefault((one.kind, one.number), one)
    return list(found.values())


def _apart(one: PatternedState, other: PatternedState) -> float:
    """Arclength between two states of one chain."""
    shape = one.solved.shape
    return length(between(shape, other.solved.shape), shape.chain, other.solved.shape.load)
