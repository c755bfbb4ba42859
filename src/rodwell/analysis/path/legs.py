"""The legs of a load path: following, snapping, following on."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState, conditions
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.following import followed
from rodwell.analysis.off_wall.happening import END, Followed, PathEvent
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.resolve import UNKNOWN, resolved_event
from rodwell.analysis.off_wall.soft import with_contact
from rodwell.analysis.off_wall.state import STRAIGHT, ContactState, contact_state
from rodwell.analysis.off_wall.steps import around_kink
from rodwell.analysis.path.events import (
    BRANCH_POINT,
    CRITICAL,
    ENTERS,
    FOLD,
    LEAVES,
    LIFT_OFF,
    SNAP,
    TOUCH_DOWN,
    Destination,
    Leg,
    PathPoint,
)
from rodwell.analysis.path.plane import back_in_plane, out_of_plane
from rodwell.analysis.path.snap import BEYOND, BEYOND_BUCKLING, NEAR, Snap, snapped
from rodwell.analysis.path.straightening import How, first_still, flat, straight_state, straightens, without_jump
from rodwell.quantities.value import Value

MOST_SNAPS = 12
"""Snaps and changes of shape on a leg, after which it is given up."""

SLACK = 1e-9
"""A condition on contact that is missed by no more than this part of the load is as good as met."""

SLIGHTLY = 0.1
"""Part of what the energy falls up to the state that the flow has found, beyond the event, that is as good as none."""

NO_DROP = 1e-3
"""A state that gives way to one whose energy differs by less than this part has not snapped: the other branches off."""


@dataclass(eq=False)
class Walked:
    """A leg with its events, its last state (None: straight), and why it ended ("end" if it went all the way)."""

    leg: Leg
    events: list[PathPoint] = field(default_factory=list)
    last: PatternedState | None = None
    ended: str = ""


def walked(start: PatternedState | None, model: RodInHole, begin: float, target: float, leg: Leg, how: How) -> Walked:
    """Go from a state, or the straight rod, to ``target``: ``begin`` and it are values of what is controlled."""
    out = Walked(leg, last=start)
    sense = float(np.sign(target - begin))
    for _ in range(MOST_SNAPS):
        if out.last is None:
            begin = _along_straight(out, model, begin, target, sense, how)
            if out.ended:
                return out
            continue
        path = followed(out.last, target, control=how.control, progress=how.progress)
        path = without_jump(path, target, sense, how)
        if _came_to_rest(out, path, how):
            begin = how.control.of_straight(how.buckling.value)
            continue
        leg.runs.append(path.states)
        out.last = path.last
        _tell(out, path, how)
        if path.ended == END:
            out.ended = END
        elif path.ended in (FOLD, BRANCH_POINT):
            begin = how.control.value(path.last.solved)
            _give_way(out, path, sense, how)
        else:
            out.ended = path.ended
        if out.ended:
            return out
    out.ended = f"it snaps or branches more than {MOST_SNAPS} times"
    return out


def _along_straight(out: Walked, model: RodInHole, begin: float, target: float, sense: float, how: How) -> float:
    """Keep the rod straight as far as it is; return where it buckles."""
    control, critical = how.control, how.buckling
    first, last, buckles = (
        control.straight_load(begin),
        control.straight_load(target),
        control.of_straight(how.buckling.value),
    )
    if (sense > 0.0) == control.by_force or (target - buckles) * sense <= 0.0:
        if first is not None and last is not None:
            out.leg.straight.append((first, last))
        out.ended = END
        return target
    if first is not None:
        out.leg.straight.append((first, critical.value))
    out.events.append(PathPoint(CRITICAL, critical, (), out.leg.name))
    _to(out, straight_state(model, critical.value), sense, how, critical, buckles)
    if out.last is None and not out.ended:
        out.ended = (
            f"the straight rod buckles at F = {critical.value:.8g} B/L², and descent from it found no other state: "
            "where it goes was not resolved"
        )
    return buckles


def _came_to_rest(out: Walked, path: Followed, how: How) -> bool:
    """Whether a path on the wall has met the straight rod, at its buckling load, and would go on along it."""
    first = first_still(path)
    if first is None:
        return False
    path.states = path.states[:first]
    path.events = [event for event in path.events if event.state in path.states]
    out.leg.runs.append(path.states)
    _tell(out, path, how)
    out.events.append(PathPoint(CRITICAL, how.buckling, (), out.leg.name))
    out.last = None
    return True


def _tell(out: Walked, path: Followed, how: How) -> None:
    """Events of a path, located to the tolerance; loss of stability is told by what follows it."""
    if path.states[0].model.soft:
        path.events = with_contact(path)
    for event in path.events:
        if event.kind == END or (event.kind == BRANCH_POINT and event is not path.events[-1]):
            continue
        if event.kind == BRANCH_POINT or (event.kind == FOLD and _met_another(event.state, how)):
            continue
        how.tell(event.state)  # to locate it takes as long as some steps
        one = resolved_event(event, how.rtol)
        kind = event.kind
        if kind == "gap_opens" and _complete(event):
            kind = LIFT_OFF
        elif kind == "gap_closes" and _complete(event):
            kind = TOUCH_DOWN
        state = ContactState(event.state.model.problem, event.state, one.event.state)
        out.events.append(PathPoint(kind, one.load, tuple(map(float, event.s)), out.leg.name, None, state, one.met))


def _complete(event: PathEvent) -> bool:
    """Whether contact is complete on one side of an event of a gap, but for gaps at kinks of the stiffness."""
    if not event.state.model.soft:
        return _touches(event.state)
    return event.between is not None and any(one.everywhere for one in event.between)


def _touches(state: PatternedState) -> bool:
    """Whether contact is complete, but for gaps at kinks of the stiffness."""
    return all(on or around_kink(state, i) is not None for i, on in enumerate(state.pattern.touching))


def _met_another(state: PatternedState, how: How) -> bool:
    """Whether a path that folds has met another one: the straight rod, or states in the plane of its ends."""
    return straightens(state, how) or back_in_plane(state, 0.0) is not None


def _give_way(out: Walked, path: Followed, sense: float, how: How) -> None:
    """What follows where a state ceases to exist, or to be stable."""
    last = path.last
    if straightens(last, how):
        critical = how.buckling
        out.events.append(PathPoint(CRITICAL, critical, (), out.leg.name))
        out.last = None
        return
    load, finer = Value(last.load, 0.0), last
    how.tell(last)
    if path.events and path.events[-1].value is not None:
        resolved = resolved_event(path.events[-1], how.rtol)
        load, finer = resolved.load, resolved.event.state
    held = load.value if how.control.by_force else how.control.value(finer.solved)
    beside = _beside_plane(path, sense, how, held)
    if beside is not None:
        kind = CRITICAL if last.model.soft and last.problem.lateral_weight > 0.0 else BRANCH_POINT
        plane = "" if kind == CRITICAL else (ENTERS if beside.pattern.planar else LEAVES)
        out.events.append(PathPoint(kind, load, (), out.leg.name, None, contact_state(beside), plane=plane))
        out.last = beside
        return
    _to(out, last, sense, how, load, held, fold=path.ended == FOLD)


def _beside_plane(path: Followed, sense: float, how: How, held: float) -> PatternedState | None:
    """The first state after a planar path has lost stability sideways, or another one has come back to the plane."""
    last, by_force = path.last, how.control.by_force
    if path.ended == FOLD:
        return back_in_plane(last, sense if by_force else -sense)
    beside = out_of_plane(last) if last.pattern.planar else None
    on = beside is not None and (how.control.value(beside.solved) - held) * sense > 0.0
    return beside if on else None


def _to(
    out: Walked, event: PatternedState, sense: float, how: How, load: Value, held: float, *, fold: bool = False
) -> None:
    """Go where the flow leads from a state that gives way at a load, with ``held`` of what is controlled."""
    control = how.control
    how.tell(event)
    beyond, near = (BEYOND_BUCKLING, 0.0) if flat(event) else (BEYOND, NEAR)
    snap = snapped(event, sense, how.seeds, control, beyond, near, how.progress)
    if snap is None:
        out.ended = (
            f"the rod gives way at F = {load.value:.8g} B/L², and where it goes was not resolved: no minimum found by "
            "descent could be solved for with its contacts"
        )
        return
    found, at = _destination(event, snap, control, held)
    if not fold and _continuous(event, snap.state, at, control):
        kind = BRANCH_POINT
        if flat(event):
            kind = "" if _touches(found.fine) else LIFT_OFF
        if kind:
            out.events.append(PathPoint(kind, load, (), out.leg.name, None, found))
    else:
        energy = Value(0.0, 0.0) if found.kind == STRAIGHT else found.energy
        to = Destination(found.kind, found.turns, energy, _load_after(found, control, held), snap.tried, snap.agree)
        out.events.append(PathPoint(SNAP, load, (), out.leg.name, to, found))
    out.last = None if found.kind == STRAIGHT else snap.state


def _continuous(event: PatternedState, after: PatternedState, at: PatternedState | None, control: Control) -> bool:
    """Whether the state after an event grows out of that before: at the event itself they are the same."""
    if at is None:
        return True  # it exists beyond that load only
    before, beyond, there = (control.potential(one.solved) for one in (event, after, at))
    if flat(event):
        return abs(there - before) < SLIGHTLY * abs(beyond - before)
    same_load = abs(at.load - event.load) <= NO_DROP * abs(event.load)
    return same_load and abs(there - before) < NO_DROP * max(abs(there), abs(before))


def _load_after(found: ContactState, control: Control, held: float) -> Value:
    """The end force after a snap, with the estimate of its error."""
    if control.by_force:
        return Value(found.force, 0.0)
    finer = control.at(found.fine, held)
    error = abs(finer.load - found.force) if finer is not None else UNKNOWN * abs(found.force)
    return Value(found.force if finer is None else finer.load, error)


def _destination(
    event: PatternedState, snap: Snap, control: Control, held: float
) -> tuple[ContactState, PatternedState | None]:
    """The state after a snap, at the load (or shortening) of the snap if it exists there, else where the flow was.

    A state of more energy than that which gives way is none to which a rod goes: beside buckling Newton's method finds
    such ones, with gaps at kinks of the stiffness that are about to close.
    """
    at = control.at(snap.state, held)
    if at is not None:
        before, there, beyond = (control.potential(one.solved) for one in (event, at, snap.state))
        valid = there - before <= SLIGHTLY * abs(beyond - before)
        valid = valid and all(one.value >= -SLACK * abs(at.load) for one in conditions(at))
        at = at if valid and not control.index_at(at.solved) else None
    return contact_state(at if at is not None else snap.state), at
