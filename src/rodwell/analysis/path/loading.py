"""The leg on which the load grows: straight, buckled on the wall, off it."""

from __future__ import annotations

from rodwell.analysis.beyond.carry import carried
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.soft import sunk
from rodwell.analysis.path.events import CRITICAL, LIFT_OFF, LOADING, SNAP, Destination, Leg, PathPoint
from rodwell.analysis.path.legs import Walked, walked
from rodwell.analysis.path.start import OnWall, arched, beside_lying, leaving_places, on_wall, released
from rodwell.analysis.path.straightening import How, leaves_lying, lying_state
from rodwell.analysis.straight.without_wall import loads_without_wall
from rodwell.errors import NotConvergedError
from rodwell.quantities.value import Value

BEFORE = 0.2
"""How far below the load that its ends alone bear the straight rod in a soft wall is followed from, relative."""


BEFORE_BUCKLING = 1.5
"""Part of a tension under which a rod buckles, as one does that hangs and is heavy, from which on it is followed."""


def loaded(model: RodInHole, until: float, mirror: bool, how: How) -> Walked:
    """The leg of growing compression."""
    problem, leg, top = model.problem, Leg(LOADING), max(0.0, BEFORE_BUCKLING * how.mode.force)
    if model.soft and problem.lateral_weight > 0.0:
        return _into_soft_wall(model, until, leg, how)
    if leaves_lying(problem, how.mode.force):
        return _off_the_low_side(model, until, leg, how)
    control, sense = how.control, -1.0 if how.control.by_force else 1.0
    if (until - control.of_straight(how.mode.force)) * sense <= 0.0:
        begin = max(top, until) if control.by_force else control.of_straight(top)
        return walked(None, model, begin, until, leg, how)

    def before(state: PatternedState) -> bool:
        return (until - control.value(state.solved)) * sense > 0.0

    begun, start = None, None
    if problem.untouched:
        start = arched(model, how.mode)
    elif problem.ramps:
        start = beside_lying(model, how.mode, mirror)
    elif leaving_places(problem):
        start = released(problem, mirror, how.rtol)
    elif problem.pressed or problem.hole is not None:
        begun = on_wall(problem, 1, mirror, how.rtol, before, how.progress)
        start = None if begun is None else begun.start
    if start is None or not before(start):
        return walked(None, model, control.of_straight(top), until, leg, how)
    critical = Value(how.mode.force, how.mode.error)
    leg.straight.append((top, how.mode.force))
    out = walked(start, model, control.value(start.solved), until, leg, how)
    first = [PathPoint(CRITICAL, critical, (), LOADING)]
    if begun is None and not problem.ramps:
        first.append(PathPoint(LIFT_OFF, critical, leaving_places(problem), LOADING))
    out.events[:0] = first
    if begun is not None:
        _add_wall(leg, model, begun)
    if begun is not None and begun.snap is not None:
        to = Destination(begun.snap.kind, 0, begun.snap.energy, critical, 1, 1)
        out.events.insert(1, PathPoint(SNAP, critical, (), LOADING, to, begun.snap))
    return out


def _off_the_low_side(model: RodInHole, until: float, leg: Leg, how: How) -> Walked:
    """From the rod that lies on the wall of a curved hole, which it leaves in its plane before it buckles."""
    return walked(lying_state(model, 0.0), model, how.control.of_straight(0.0), until, leg, how)


def _into_soft_wall(model: RodInHole, until: float, leg: Leg, how: How) -> Walked:
    """From the straight rod that has sunk into a soft wall, a little below the load that its ends alone would bear."""
    alone = loads_without_wall(model.problem).modes[0].force
    top = alone + BEFORE * max(abs(alone), 1.0)
    start = sunk(model, max(top, until) if how.control.by_force else top)
    if start is None:
        raise NotConvergedError(f"the straight rod in a wall of stiffness {model.stiffness:g} B/L⁴ was not found")
    return walked(start, model, top, until, leg, how)


def _add_wall(leg: Leg, model: RodInHole, begun: OnWall) -> None:
    """States on the wall before the chains begin, as chains too: for curves and for states at loads."""
    states = [carried(model, begun.branch[i]) for i in begun.states[:-1]]
    leg.runs[0] = [state for state in states if state is not None] + leg.runs[0]
