"""Tracing a branch of buckled states: its events, and where and why it ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rodwell.analysis.branch.special import END, EQUAL_ENERGY, LIFT_OFF, OUT_OF_RANGE, REJOINS, STRAIGHT
from rodwell.analysis.branch.starts import Start, rejoined
from rodwell.analysis.discrete.measures import STEEPEST, Measured
from rodwell.numerics.continuation.events import INDEX, TURN, Event, Leaving, LocatedEvent
from rodwell.numerics.continuation.location import LocationError
from rodwell.numerics.continuation.walk import Halt, Stepping, Trace, trace
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.problem.checks import SMALLEST_CLEARANCE
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter, limits_of

LARGEST_BRAID_ANGLE = 89.5
"""Degrees of |η| at which a branch ends: the theory holds below 90°."""

SAME = 1e-7
"""How close, relatively, to where a branch meets another a change of its index is that meeting."""

FLAT = 1e-5
"""Largest angle around the cylinder, in rad, of a rod that counts as straight where a branch turns back."""

LEFT = "the parameter reached the end of its range, or came back past its start"

Progress = Callable[[float], None]
"""Called with the parameter of each new point."""

_CONTACT = Event(LIFT_OFF, lambda _, values: values[Measured.P_MAX])
_ENERGY = Event(EQUAL_ENERGY, lambda _, values: values[Measured.ENERGY])
_ACROSS = Event(OUT_OF_RANGE, lambda _, values: values[STEEPEST] - np.sin(np.radians(LARGEST_BRAID_ANGLE)))


def traced(
    problem: Problem,
    start: Start,
    until: float,
    stepping: Stepping,
    *,
    ends_at: tuple[str, ...] = (),
    parameter: Parameter = "force",
    leaves: Leaving | None = None,
    progress: Progress | None,
    halt: Halt | None = None,
) -> Trace:
    """Trace a branch to ``until``, put its end exactly there, and stop where it rejoins a symmetric one, or is told.

    ``ends_at``: events at which it ends before, LIFT_OFF or INDEX (a change of the stability index).
    """
    meshes, point = start
    stops = {END, OUT_OF_RANGE, LEFT, *ends_at}
    events = [_ACROSS, Event.at(END, until)]
    if not problem.untouched or problem.turns != 0:
        events.append(_CONTACT)
    if problem.turns != 0 and problem.same_sides:
        events.append(_ENERGY)
    if parameter != "force":
        low, high = limits_of(parameter)
        back = low if until > point.lam else high
        if back == 0.0 and parameter == "clearance":
            back = min(SMALLEST_CLEARANCE, 0.5 * point.lam)
        events.append(Event.at(LEFT, back))

    meetings: dict[float, LocatedEvent | None] = {}

    def meeting(event: LocatedEvent) -> LocatedEvent | None:
        if event.point.lam not in meetings:
            meetings[event.point.lam] = rejoined(problem, parameter, event)
        return meetings[event.point.lam]

    def stop(event: LocatedEvent) -> str:
        if event.name != TURN:
            return event.name if event.name in stops else ""
        if np.max(np.abs(event.point.fine.c)) <= FLAT * meshes.coarse.scale_c:
            return STRAIGHT
        if meeting(event) is None:  # without its mirror image, a branch turns back in folds only
            raise LocationError("the branch turns back near a symmetric one, but the place was not found on it")
        return REJOINS

    report = None if progress is None else lambda p: progress(p.lam)
    result = trace(meshes, point, stepping, events, stop=stop, leaves=leaves, progress=report, halt=halt)
    if result.end == REJOINS:
        return _ended_at(result, meeting(result.found[-1]))
    return _end_exactly(result, until)


def _ended_at(result: Trace, meeting: LocatedEvent | None) -> Trace:
    """Put the end of a branch on the branch point at which it meets another."""
    if meeting is not None:
        result.meshes[-1], result.points[-1] = meeting.meshes, meeting.point
        last = result.found.pop()
        # next to the meeting the softest eigenvalue vanishes like the square of the distance: its sign is noise
        near = SAME * abs(meeting.point.lam)
        result.found = [f for f in result.found if f.name != INDEX or abs(f.point.lam - meeting.point.lam) > near]
        changes = [f for f in result.found if f.name == INDEX]
        index = changes[-1].index_after if changes else result.points[min(1, len(result.points) - 1)].fine.index
        result.found.append(
            replace(
                last, meshes=meeting.meshes, point=meeting.point, lam_error=meeting.lam_error,
                index_before=index, index_after=index,
            )
        )  # fmt: skip
    return result


def _end_exactly(result: Trace, value: float) -> Trace:
    """Put the end of a branch that reached its end exactly there; that of one which reached the straight rod, on it."""
    last: MeshedState | None = None
    if result.end == END and not result.points[-1].at(value):
        last = result.meshes[-1].at(result.points[-1], value)
    elif result.end == STRAIGHT:
        last = _flattened(result.meshes[-1], result.points[-1])
    if last is not None:
        result.points[-1] = last
        result.found[-1] = replace(result.found[-1], point=last)
    return result


def _flattened(meshes: TwoMeshes, point: MeshedState) -> MeshedState:
    """The straight rod where a branch reaches it."""
    pairs = ((meshes.coarse, point.coarse), (meshes.fine, point.fine))
    return meshes.point(*(f.state(np.zeros_like(x.c), x.lam, x.tangent, x.tangent_lam, x.index) for f, x in pairs))
