"""The leg on which the load grows: straight, or as the rod lies in a hole out of a plane; buckled; off the wall."""

from __future__ import annotations

from rodwell.analysis.beyond.carry import carried
from rodwell.analysis.branch.follow import LARGEST_STEP
from rodwell.analysis.branch.rest import at_rest
from rodwell.analysis.branch.watching import Following
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.following import followed
from rodwell.analysis.off_wall.happening import END
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.soft import sunk
from rodwell.analysis.path.events import CRITICAL, LIFT_OFF, LOADING, SNAP, Destination, Leg, PathPoint
from rodwell.analysis.path.legs import Walked, walked
from rodwell.analysis.path.start import OnWall, arched, beside_lying, leaving_places, on_wall, released
from rodwell.analysis.path.straightening import How, leaves_lying, lying_state
from rodwell.analysis.straight.without_wall import loads_without_wall
from rodwell.errors import InputError, NotConvergedError

BEFORE = 0.2
"""How far below the load that its ends alone bear the straight rod in a soft wall is followed from, relative."""


BEFORE_BUCKLING = 1.5
"""Part of a tension under which a rod buckles, as one does that hangs and is heavy, from which on it is followed."""


def loaded(model: RodInHole, until: float, mirror: bool, how: How) -> Walked:
    """The leg of growing compression."""
    problem, leg = model.problem, Leg(LOADING)
    if problem.in_space:
        return _as_it_lies(model, until, leg, how)
    top = max(0.0, BEFORE_BUCKLING * how.buckling.value)
    if model.soft and problem.lateral_weight > 0.0:
        return _into_soft_wall(model, until, leg, how)
    if leaves_lying(problem, how.buckling.value):
        return _off_the_low_side(model, until, leg, how)
    control, sense = how.control, -1.0 if how.control.by_force else 1.0
    if (until - control.of_straight(how.buckling.value)) * sense <= 0.0:
        begin = max(top, until) if control.by_force else control.of_straight(top)
        return walked(None, model, begin, until, leg, how)

    def before(state: PatternedState) -> bool:
        return (until - control.value(state.solved)) * sense > 0.0

    begun, start = None, None
    if problem.untouched and how.mode is not None:
        start = arched(model, how.mode)
    elif problem.ramps and how.mode is not None:
        start = beside_lying(model, how.mode, mirror)
    elif leaving_places(problem):
        start = released(problem, mirror, how.rtol)
    elif problem.pressed or problem.hole is not None:
        begun = on_wall(problem, 1, mirror, how.rtol, before, how.progress)
        start = None if begun is None else begun.start
    if start is None or not before(start):
        return walked(None, model, control.of_straight(top), until, leg, how)
    critical = how.buckling
    leg.straight.append((top, how.buckling.value))
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


def _as_it_lies(model: RodInHole, until: float, leg: Leg, how: How) -> Walked:
    """From the rod as it lies in a hole that leaves the vertical plane, where it is nowhere straight.

    Weight and bend press it to different sides, so that it lies at an angle that varies along it and moves with the end
    force (:mod:`rodwell.analysis.loads.lying_rod`).

    Raises
    ------
    InputError
        If the path would not go towards compression, or the rod lies on this side of the hole at no end force.
    NotConvergedError
        If no state at rest is found.
    """
    start, control = _lying_on_wall(model, how), how.control
    begin = control.value(start.solved)
    if (until - begin) * (-1.0 if control.by_force else 1.0) <= 0.0:
        where = f"{'below' if control.by_force else 'above'} {begin:.8g}"
        raise InputError(
            "until", until, f"must be {where}, where the path begins in this hole, as the rod lies on the wall; "
            "how it lies in tension: rodwell.lying_rod",
        )  # fmt: skip
    return walked(start, model, begin, until, leg, how)


def _lying_on_wall(model: RodInHole, how: How) -> PatternedState:
    """The rod as it lies on the wall, stable, without an end force; where it does not, at rest."""

    def told(force: float) -> None:
        if how.progress is not None:
            how.progress(force)

    rest = at_rest(model.problem, Following(how.rtol, LARGEST_STEP, told))
    state = carried(model, rest)
    if state is None or state.solved.index:
        raise NotConvergedError(
            f"the rod at rest at F = {rest.force:.8g} B/L² was not found as one that may leave the wall"
        )
    if state.load == 0.0:
        return state
    path = followed(state, 0.0)
    return path.last if path.ended == END and all(one.pattern.full for one in path.states) else state


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
