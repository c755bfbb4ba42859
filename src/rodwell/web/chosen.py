"""Which state is asked for: by load, branch and place among those there, or as a special point; what is said of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rodwell.analysis.path.events import LOADING
from rodwell.errors import InputError
from rodwell.quantities.text import error_digit
from rodwell.report.reports.texts import KINDS as LABELS
from rodwell.web import off_wall, state
from rodwell.web.explored import STRAIGHT, Explored, checked_load


@dataclass(frozen=True)
class Chosen:
    """A state: its branch, its place among how many states there at this load, and what is to be said of the choice."""

    shown: state.Shown
    branch: str
    which: int = 0
    count: int = 1
    note: str = ""


def chosen(found: Explored, request: Mapping[str, Any]) -> Chosen:
    """Return the state that a request names by ``load``, ``branch``, ``which`` and ``special``.

    Raises
    ------
    InputError
        For a load, a branch or a number that is not there.
    NotConvergedError
        If the state could not be computed.
    """
    asked, which, special = request.get("branch") or "", request.get("which") or 0, request.get("special")
    load = checked_load("load", request.get("load"))
    if not isinstance(asked, str):
        raise InputError("branch", asked, "must be text: the name of a branch")
    for name, value in (("which", which), ("special", 0 if special is None else special)):
        if isinstance(value, bool) or not isinstance(value, int):
            raise InputError(name, value, "must be a whole number")
    if asked and asked != STRAIGHT and special is not None:
        if found.path is not None and asked in off_wall.LEGS.values():
            return _event(found, asked, int(special))
        return _special(found, asked, int(special))
    force, note = found.force(load), ""
    name = asked or _usual(found, force)
    states = state.states_of(found, name, force)
    if not states:
        if found.computed.lying is not None:
            raise InputError("load", load, "is none at which the rod was followed as it lies: take one of its branches")
        if asked:
            note = f"{asked} does not pass this load: the straight rod is shown."
        name, states = STRAIGHT, state.states_of(found, STRAIGHT, force)
    which = min(max(which, 0), len(states) - 1)
    return Chosen(states[which], name, which, len(states), note)


def _usual(found: Explored, force: float) -> str:
    """The branch that a rod follows as the load grows: past lift-off its load path, where that is known."""
    lift = found.computed.lift_off
    if found.path is not None and lift is not None and force < lift.force:
        return off_wall.LEGS[LOADING]
    if found.computed.lying is not None:  # it buckles, or lies at less or at more end force than at rest
        ways = (branch for branch in found.branches if branch.reach[0] <= force <= branch.reach[1])
        return next(ways, found.computed.first).name
    return found.computed.first.name


def _special(found: Explored, name: str, number: int) -> Chosen:
    """A special point of a branch, as it was located."""
    state.states_of(found, name, 0.0)  # raises where there is no such branch
    points = found[name].special_points
    if not 0 <= number < len(points):
        raise InputError("special", number, f"must be from 0 to {len(points) - 1}: {name} has no more")
    point = points[number]
    index = f"index {point.index_before} → {point.index_after}"
    what = LABELS[point.kind]
    note = f"{what[:1].upper()}{what[1:]} of {name}"
    if point.error > 0.0:  # an end to which a branch was followed is no result
        note += f", known to ± {error_digit(found.load_unit[0] * point.error)} {found.load_unit[1]}"
    return Chosen(point.solution, name, note=f"{note}; {index}.")


def _event(found: Explored, name: str, number: int) -> Chosen:
    """An event of the load path."""
    assert found.path is not None
    events = off_wall.events_of(found.path, name)
    if not 0 <= number < len(events):
        raise InputError("special", number, f"must be from 0 to {len(events) - 1}: {name} has no more")
    event = events[number]
    assert event.state is not None
    error = error_digit(found.load_unit[0] * event.force.error)
    note = f"{event.meaning[:1].upper()}{event.meaning[1:]}: the load is known to ± {error} {found.load_unit[1]}."
    return Chosen(event.state, name, note=note)
