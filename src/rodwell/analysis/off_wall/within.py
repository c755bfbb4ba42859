"""What happens first within a step along a path of partial contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState, conditions
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.happening import (
    BRANCH_POINT,
    END,
    FOLD,
    LOAD_PEAK,
    TOGETHER,
    PathEvent,
    load_rate,
    together,
    watch,
)
from rodwell.numerics.stretches.newton import Solved, softest, stiffness_along
from rodwell.numerics.stretches.walk import Motion, between, locate, row_of, tangent
from rodwell.quantities.arrays import FloatArray

MOST_EARLIER = 6
"""How often within a step something is found that happens before what was found first."""


SLACK, ROUND_OFF = 1.0, 1e-7
"""By how much of the change of ∂E/∂F energies at the ends of a step may differ from the mean of both; half of it where
∂E/∂F changes one way. And what round-off may add, as a part of the energy."""

AT_ONCE = 1e-6
"""Part of a step within which two things happen in the same place."""

Place = tuple[PatternedState, Motion]
"""A state and the direction of the path there."""


@dataclass(frozen=True, eq=False, repr=False)
class Step:
    """A step: the states at its ends with the directions of the path there, what is controlled, and where it ends."""

    state: PatternedState
    along: Motion
    new: PatternedState
    turned: Motion
    control: Control
    until: float
    sense: float


def first_event(step: Step) -> PathEvent | str | None:
    """The first thing that happens within a step, located; in words why not, where the step is too long for that."""
    if step.state.problem.in_space and _on_another_path(step):
        return f"another path is met beyond F = {step.state.load:.8g} B/L²"
    event = None
    for _ in range(MOST_EARLIER):
        found = _located(step)
        if found is None or isinstance(found, str):
            return event if found is None else found
        event = found
        if not _earlier(event, step):
            return event
        step = replace(step, new=event.state, turned=tangent(event.state.solved, step.along))
    return f"contact changes too often beyond F = {step.state.load:.8g} B/L²"


def _on_another_path(step: Step) -> bool:
    """Whether a step has led to another path, past a limit point of its own.

    Along one path energies differ by ∫u dF, with u = ∂E/∂F at the ends of a step as its bounds, unless the load turns.
    """
    first, last = step.state.solved, step.new.solved
    if not step.control.by_force or step.along.load * step.turned.load <= 0.0:
        return False
    far, (before, after) = last.shape.load - first.shape.load, (one.out.energy_by_load for one in (first, last))
    missed = last.out.energy - first.out.energy - 0.5 * (before + after) * far
    noise = ROUND_OFF * max(abs(first.out.energy), abs(last.out.energy), 1.0)
    return abs(missed) > SLACK * abs((after - before) * far) + noise


def _located(step: Step) -> PathEvent | str | None:
    """What is seen to happen within a step by what holds at its ends; the first of it along the tangent."""
    state, new = step.state, step.new
    if not new.solved.shape.in_order:  # of a step of the string, say
        return f"an end of a stretch passes that of an element within a step beyond F = {state.load:.8g} B/L²"
    broken = [one for one in conditions(new) if one.value < 0.0]
    first = {(one.kind, one.number): k for k, one in reversed(list(enumerate(broken)))}  # one function for all minima
    candidates = [(broken[k].kind, watch(broken[k], state)) for k in first.values()]
    candidates += turning_points(step.control, (state, step.along), (new, step.turned), step.sense)
    if (step.control.value(new.solved) - step.until) * step.sense >= 0.0:
        candidates.append((END, lambda one: step.control.value(one) - step.until))
    located = []
    row = row_of(step.along, state.solved.shape.chain, state.load)
    for kind, value in candidates:
        at = locate(state.model, state.solved, new.solved, value)
        if at is None and kind == BRANCH_POINT and _steadier(step):
            continue  # from a contact without force, where stability is round-off; nothing follows from it
        if at is None:
            return f"{kind} beyond F = {state.load:.8g} B/L² could not be located"
        there = PatternedState(state.pattern, state.elements, at)
        order = row.of(at.shape.nodes, at.shape.breaks, at.shape.load)
        located.append((order, PathEvent(kind, there, (), value, [], step.along, (state, new))))
    if not located:
        return None
    number = _first([order for order, _ in located], len(broken), AT_ONCE * row.of(*_motion(state, new)))
    event = located[number][1]
    if number >= len(first):
        return event
    at_once = together(event.state, broken, list(first.values())[number])
    return replace(event, s=tuple(sorted(one.s for one in at_once)), together=at_once)


def turning_points(
    control: Control, start: Place, end: Place, sense: float
) -> list[tuple[str, Callable[[Solved], float]]]:
    """Extrema of the load and of what is controlled, and changes of the stability index, within a step.

    Each with the function whose zero it is.
    """
    (state, along), (new, turned) = start, end
    found: list[tuple[str, Callable[[Solved], float]]] = []
    if along.load * turned.load < 0.0:
        found.append((FOLD if control.by_force else LOAD_PEAK, load_rate(along)))
    if not control.by_force and control.rate(new.solved, turned) * sense < 0.0:
        found.append((FOLD, driven_rate(control, along)))
    before = control.index(state.solved, along, sense)
    if before != control.index(new.solved, turned, sense) and not any(kind == FOLD for kind, _ in found):
        direction = softest(new.solved)
        found.append((BRANCH_POINT, lambda one: stiffness_along(one, direction)))
    return found


def driven_rate(control: Control, along: Motion) -> Callable[[Solved], float]:
    """How fast the controlled quantity changes along the path: zero where it turns."""
    return lambda one: control.rate(one, tangent(one, along))


def _steadier(step: Step) -> bool:
    """Whether fewer disturbances grow at the end of a step than at its start."""
    places = (step.state, step.along), (step.new, step.turned)
    before, after = (step.control.index(at.solved, motion, step.sense) for at, motion in places)
    return after < before


def _motion(state: PatternedState, new: PatternedState) -> tuple[FloatArray, FloatArray, float]:
    chord = between(state.solved.shape, new.solved.shape)
    return chord.nodes, chord.breaks, chord.load


def _first(orders: list[float], conditions: int, close: float) -> int:
    """The number of what happens first; a condition on contact, should the state lose stability in the same place."""
    first = int(np.argmin(orders))
    lead = int(np.argmin(orders[:conditions])) if conditions else first
    return lead if orders[lead] <= orders[first] + close else first


def _earlier(event: PathEvent, step: Step) -> bool:
    """Whether a condition is missed at an event already: the path bends within the step, and it vanished before."""
    before, after = (
        {(one.kind, one.number): abs(one.value) for one in sorted(conditions(state), key=lambda one: -one.value)}
        for state in (step.state, step.new)
    )
    known = {(one.kind, one.number) for one in event.together}
    for one in conditions(event.state):
        key = one.kind, one.number
        size = max(before.get(key, 0.0), after.get(key, 0.0))
        if key not in known and one.value < -TOGETHER * size and before.get(key, 0.0) > 0.0:
            return True
    return False
