"""Where a path turns or loses stability within a step, and in which sense it goes on in a new pattern."""

from __future__ import annotations

from collections.abc import Callable

from rodwell.analysis.off_wall.changes import Changed
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.happening import BRANCH_POINT, FOLD, LOAD_PEAK, load_rate
from rodwell.numerics.stretches.newton import Solved, softest, stiffness_along
from rodwell.numerics.stretches.walk import Motion, step, tangent, tangent_in_load

PROBE = 1e-3
"""Arclength over which it is seen what grows in a new pattern."""

Place = tuple[PatternedState, Motion]
"""A state and the direction of the path there."""


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


def growing_direction(after: Changed, load_sense: float) -> Motion:
    """The sense in which a new pattern exists; along the load's if what grows there cannot be seen."""
    start = after.state
    along = tangent_in_load(start.solved, load_sense)
    ahead = step(start.model, start.solved, along, PROBE)[1]
    return along.times(-1.0) if ahead is not None and after.grows(ahead) < after.grows(start.solved) else along
