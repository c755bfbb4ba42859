"""A load path in sentences."""

from __future__ import annotations

from collections.abc import Sequence

from rodwell.analysis.off_wall.state import ON_WALL, OTHER_SIDE
from rodwell.analysis.path.events import (
    BRANCH_POINT,
    CRITICAL,
    ENTERS,
    LEAVES,
    LIFT_OFF,
    LOADING,
    SNAP,
    TOUCH_DOWN,
    TOUCHES,
    UNLOADING,
    PathPoint,
    unbuckled,
)
from rodwell.problem.problem import Problem
from rodwell.quantities.text import amount


def sentences(problem: Problem, events: Sequence[PathPoint]) -> tuple[str, ...]:
    """What happens on loading and on unloading, in a few sentences; compression at s = 1 in B/L²."""
    told, out = (CRITICAL, LIFT_OFF, SNAP), []
    up, down = ([one for one in events if one.leg == leg] for leg in (LOADING, UNLOADING))
    parts = [_clause(one) for one in up if one.kind in told or is_gradual(problem, one)]
    if parts:
        out.append("Under growing compression the rod " + "; ".join(parts) + ".")
    parts = [_clause(one) for one in down if one.kind in told or is_gradual(problem, one)]
    if parts:
        out.append("When the load is taken off it " + "; ".join(parts) + ".")
    return tuple(out)


def is_gradual(problem: Problem, event: PathPoint) -> bool:
    """Whether a rod goes over from one shape to another without a jump, in a way that is told.

    It does where nothing presses it to the wall; and in a curved hole, where it may cross to the other side.
    """
    if problem.hole is not None:
        return event.kind == TOUCHES or (event.kind == BRANCH_POINT and (event.plane != "" or problem.in_space))
    return problem.untouched and event.kind in (TOUCHES, TOUCH_DOWN, *([BRANCH_POINT] * problem.isotropic_ends))


def gradually(event: PathPoint, load: str) -> str:
    """What happens at one of them, with its load as text: the end of "the rod …"."""
    if event.kind == TOUCHES:
        return f"touches the wall anew at {load}"
    if event.kind == BRANCH_POINT and event.curved:
        goes = {
            ENTERS: f"lies in the vertical plane from {load} on", LEAVES: f"leaves that plane at {load}",
            "": f"goes over to another shape at {load}",
        }  # fmt: skip
        return f"{goes[event.plane]}, without a jump"
    if event.kind == BRANCH_POINT:
        return f"{'leaves' if event.leg == LOADING else 'is back in'} the plane of its arch at {load}, without a jump"
    turns = 0 if event.state is None else abs(event.state.turns)
    shape = f", a helix of {turns} turn{'s' if turns != 1 else ''}" if turns else ""
    return f"lies against the wall everywhere from {load} on{shape}"


def _clause(event: PathPoint) -> str:
    load = amount(event.force.times(-1.0), 6)
    if event.kind == CRITICAL:
        if event.leg == LOADING:
            return f"buckles at {load} B/L²"
        return f"{'lies along the hole' if event.curved else 'is straight'} again at {load} B/L²"
    if event.kind == LIFT_OFF:
        return f"lifts off the wall at {load} B/L²"
    if event.to is None:
        return gradually(event, f"{load} B/L²")
    if event.to.kind == "straight":
        return f"falls back to {unbuckled(event.curved)} at {load} B/L²"
    turns = f" of {abs(event.to.turns)} turn{'s' if abs(event.to.turns) != 1 else ''}" if event.to.turns else ""
    return f"snaps at {load} B/L² to {_NAMES.get(event.to.kind, 'another state of partial contact')}{turns}"


_NAMES = {
    "helix": "a helix", "sinusoidal": "a sinusoidal shape on the wall", OTHER_SIDE: f"the shape {OTHER_SIDE}",
    ON_WALL: f"a shape {ON_WALL}",
}  # fmt: skip
