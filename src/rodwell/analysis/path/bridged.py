"""The load path of a string that leaves the wall by itself: in the vertical plane, until it buckles out of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rodwell.analysis.off_wall.arrange import at_load
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.following import followed
from rodwell.analysis.off_wall.happening import BRANCH_POINT, END, FOLD, Followed, PathEvent
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.resolve import resolved_event
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path.bridging import at_top, bridged, unstretched
from rodwell.analysis.path.events import CRITICAL, LOADING, Leg, PathPoint
from rodwell.analysis.path.legs import Walked
from rodwell.errors import NotConvergedError
from rodwell.numerics.stretches.chain import ANGLE, ANGLE_RATE
from rodwell.numerics.stretches.newton import Solved, softest, stiffness_along
from rodwell.numerics.stretches.walk import locate
from rodwell.problem.problem import Problem
from rodwell.problem.words import where_it_bridges
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import LARGEST_FORCE

FARTHEST = 10.0
"""End force up to which a string is compressed in search of its buckling, in that of a clamped rod of its stiffest and
heaviest section in its narrowest hole; beside twice 4bκ/Δ, at which a bend alone presses as hard as a bed that buckles:
F = 2√(bP/Δ) with P = Fκ."""

LARGEST = 2.0
"""Largest step along the path: in the plane a string bends little more from one load to the next."""

SHORTER, REPEATS = 0.25, 6
"""Steps are shortened by this factor, so often, where several modes become unstable within one."""

JUST_BEFORE = 1e-9
"""How much less than its buckling load a string must bear without being unstable, as a part of the load."""

HALVINGS, AT_ONCE = 60, 1e-11
"""How often a step in which several disturbances begin to grow is halved, and the part of the load below which they
cannot be told apart."""

PASSED_OVER = 1e-3
"""Part of the load by which a change of contact that was not resolved is passed over."""

BEYOND = "states beyond are not computed"


def farthest(problem: Problem) -> float:
    """The end force in B/L² up to which a string that bridges steps is loaded if nothing is asked for."""
    b, q = float(np.max(problem.rod.ranges["stiffness"])), float(np.max(problem.rod.sizes_of_weight))
    narrow = problem.clearance * float(np.min(problem.rod.ranges["clearance"]))
    of_bed = 2.0 * float(np.sqrt(b * q * problem.lateral_weight / narrow))
    of_bend = 0.0 if problem.hole is None else 4.0 * b * problem.hole.sharpest / narrow
    return max(-FARTHEST * (4.0 * np.pi**2 * b + of_bed + problem.weight) - 2.0 * of_bend, -LARGEST_FORCE)


def bridging(model: RodInHole, until: float, rtol: float, progress: Callable[[float], str | None] | None) -> Walked:
    """The leg of growing compression, from where the string is stretched everywhere.

    Raises
    ------
    NotConvergedError
        If it was not found how the string lies there.
    """
    begin = max(unstretched(model), until)
    start = bridged(model, begin)
    if start is None and (place := at_top(model, begin)) is not None:
        raise NotConvergedError(
            f"at F = {begin:.8g} B/L² the string would reach the upper side of the hole, near s = {place:.4g} L: "
            "contact there is not computed where the clearance has steps"
        )
    if start is None:
        raise NotConvergedError(
            f"how the string lies {where_it_bridges(model.problem)} at F = {begin:.8g} B/L² was not found: no state "
            "whose contacts all push and that keeps inside the hole"
        )
    if start.solved.index and model.problem.hole is not None and not model.problem.rod.mixed:
        raise NotConvergedError(
            f"at F = {begin:.8g} B/L², where nothing is compressed, the string does not stay in the vertical plane: "
            "the curved hole presses it to a side from which it slips off; give one that bends it less, or more weight"
        )
    if start.solved.index:
        raise NotConvergedError(
            f"at F = {begin:.8g} B/L², where nothing is compressed, the string does not stay in the vertical plane: an "
            "end at the bottom that may slide around the wall (guided or free) rolls up with the section beside it, "
            "which floats; clamp or pin that end"
        )
    out = Walked(Leg(LOADING, [[start]]), last=start, ended=END)
    if begin == until:
        return out
    path = _first_loss(start, until, progress)
    out.leg.runs, out.last, out.ended = [path.states], path.last, path.ended
    for event in path.events:
        lost = event is path.events[-1] and path.ended in (BRANCH_POINT, FOLD)
        if event.kind == END or (event.kind == BRANCH_POINT and not lost):
            continue
        one = resolved_event(event, rtol)
        sideways = lost and event.kind == BRANCH_POINT and _sideways(one.event.state)
        state = ContactState(model.problem, event.state, one.event.state)
        kind = CRITICAL if sideways else event.kind
        met = one.met and state.certificate.passed
        out.events.append(PathPoint(kind, one.load, tuple(map(float, event.s)), LOADING, None, state, met))
        if lost:
            how = "buckles sideways" if sideways else "gives way in its plane"
            out.ended = f"the string {how} at F = {one.load.value:.8g} B/L²: {BEYOND} {where_it_bridges(model.problem)}"
    return out


def _first_loss(start: PatternedState, until: float, progress: Callable[[float], str | None] | None) -> Followed:
    """The path to the first load at which a disturbance grows: within a step there may be several.

    Where a change of contact was not resolved, the string is sought anew a little beyond, as at the beginning.
    """
    path, largest = followed(start, until, largest=LARGEST, progress=progress), LARGEST
    for _ in range(REPEATS):
        last = path.last
        if path.ended in (END, FOLD):
            return path
        if path.ended == BRANCH_POINT:
            before = at_load(last, last.load + JUST_BEFORE * abs(last.load))
            steady = before is not None and not before.solved.index
            if steady and _one_alone(path.events[-1]):
                return path
            first = _first_of_several(path.events[-1])
            if first is not None:
                states = [*path.states[:-1], first.state]
                return replace(path, states=states, events=[*path.events[:-1], first])
            if steady:
                return path
            largest *= SHORTER
            kept, events, again = path.states[:-2], path.events[:-1], path.states[-2]
        else:
            beyond = bridged(last.model, max(last.load - PASSED_OVER * max(abs(last.load), 1.0), until))
            if beyond is None or beyond.solved.index:
                return path
            kept, events, again = path.states, path.events, beyond
        more = followed(again, until, largest=largest, progress=progress)
        path = Followed(kept + more.states, events + more.events, more.ended, more.along)
    if path.ended == BRANCH_POINT:
        grown = next((state.load for state in path.states if state.solved.index), path.last.load)
        path.ended = f"several disturbances begin to grow near F = {grown:.8g} B/L², the first of them not told"
    return path


def _one_alone(event: PathEvent) -> bool:
    """Whether no more than one disturbance begins to grow within the step of a branch point."""
    return event.between is not None and event.between[1].solved.index <= 1


def _first_of_several(event: PathEvent) -> PathEvent | None:
    """Where the first of several disturbances begins to grow within the step of a branch point, however close they are.

    By halves: how many grow is the number of negative eigenvalues of the second variation. None if that many do at the
    start of the step already, or if a state on the way was not found.
    """
    if event.between is None or event.between[0].solved.index:
        return None
    steady, growing = event.between
    for _ in range(HALVINGS):
        if not growing.solved.index:
            return None
        value = _singular_along(softest(growing.solved))
        if growing.solved.index == 1 and value(growing.solved) < 0.0:
            break
        if abs(growing.load - steady.load) <= AT_ONCE * abs(growing.load):
            value, (steady, growing) = _none_grows, event.between
            break
        middle = at_load(steady, 0.5 * (steady.load + growing.load))
        if middle is None:
            return None
        steady, growing = (steady, middle) if middle.solved.index else (middle, growing)
    at = locate(steady.model, steady.solved, growing.solved, value)
    if at is None:
        return None
    there = PatternedState(steady.pattern, steady.elements, at)
    return replace(event, state=there, value=value, between=(steady, growing))


def _singular_along(direction: FloatArray) -> Callable[[Solved], float]:
    """A function that vanishes where the second variation is singular along about a direction."""
    return lambda one: stiffness_along(one, direction)


def _none_grows(state: Solved) -> float:
    """Positive where no disturbance grows, else negative: for several that begin to grow in the same place."""
    return 0.5 - state.index


def _sideways(state: PatternedState) -> bool:
    """Whether a planar state is softest against a disturbance out of its plane."""
    direction = softest(state.solved).reshape(-1, 4) ** 2
    return float(np.sum(direction[:, [ANGLE, ANGLE_RATE]])) > 0.5 * float(np.sum(direction))
