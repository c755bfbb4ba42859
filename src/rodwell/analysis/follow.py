"""Following a branch of buckled states: from the straight rod, from a given state, or from a branch point."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from rodwell.analysis.accuracy import MOST_WORK, RTOL, checked_force, checked_rtol
from rodwell.analysis.branches import (
    BRANCH_POINT,
    END,
    EQUAL_ENERGY,
    LIFT_OFF,
    OUT_OF_RANGE,
    REJOINS,
    STRAIGHT,
    Branch,
    Origin,
    SpecialPoint,
    continued,
)
from rodwell.analysis.critical import MOST_MODES, Mode, critical_loads
from rodwell.analysis.families import PATHS, parameter_value
from rodwell.analysis.measures import STEEPEST, Measured
from rodwell.analysis.solution import Solution
from rodwell.analysis.starts import Start, at_branch_point, at_critical, at_state, rejoined
from rodwell.errors import InputError, NotConvergedError, checked_number, checked_whole
from rodwell.numerics.continuation import INDEX, TURN, Event, Found, Stepping, Trace, trace
from rodwell.numerics.ladder import Ladder, Point
from rodwell.problem import LIMITS, SMALLEST_CLEARANCE, Problem

LARGEST_STEP = 0.04
"""Default of the longest step: one unit is an amplitude of about 1 rad, or the whole range of the parameter."""

FIRST_STEP = 0.05
"""First step on a branch that leaves another: radians around the cylinder, about."""

FIRST_STEP_ON = 0.02
"""First step from a given state."""

LARGEST_BRAID_ANGLE = 89.5
"""Degrees of |η| at which a branch ends: the theory holds below 90°."""

RIGID = 0.1
"""Wavenumber, in rad/L, below which a mode hardly bends the rod: it is a rigid turn, resisted by weight alone."""

SAME = 1e-7
"""How close, relatively, to where a branch meets another a change of its index is that meeting."""

REACH = 6.0
"""Without ``until``, a branch is followed for lift-off to at most this many times its scale of load."""

FLAT = 1e-5
"""Largest angle around the cylinder, in rad, of a rod that counts as straight where a branch turns back."""

LEFT = "the parameter reached the end of its range, or came back past its start"

Progress = Callable[[float], None]
"""Called with the parameter of each new point."""

_CONTACT = Event(LIFT_OFF, lambda _, values: values[Measured.P_MAX])
_ENERGY = Event(EQUAL_ENERGY, lambda _, values: values[Measured.ENERGY])
_ACROSS = Event(OUT_OF_RANGE, lambda _, values: values[STEEPEST] - np.sin(np.radians(LARGEST_BRAID_ANGLE)))


def follow(
    problem: Problem,
    mode: int | Mode | None = None,
    *,
    until: float | None = None,
    mirror: bool = False,
    start: Solution | None = None,
    parameter: str = "force",
    rtol: float = RTOL,
    largest_step: float = LARGEST_STEP,
    progress: Progress | None = None,
) -> Branch:
    """Follow a branch of buckled states in the end force, from the straight rod, or in any parameter from a state.

    Parameters
    ----------
    problem
        The rod; what is not the parameter stays constant.
    mode
        Number of the buckling mode to start from, 1 (the default) for the first met, or a :class:`Mode` already
        computed.
    until
        Value of the parameter at which to end: by default the end force at s = 1 in B/L², tension positive.
        Without it, the branch ends at lift-off.
    mirror
        The other of the two arms that leave the straight rod: the paper draws ω₂(1) < 0, this is ω₂(1) > 0.
    start
        A state to start from instead (for example a coiled one, from :func:`equilibrium`); needs ``until``.
    parameter
        What varies, from ``start``: "force", "weight", "alpha" (degrees), "clearance" or "twist".
    rtol
        Relative tolerance of every measured number and special point.
    largest_step
        Longest step. One unit is an amplitude of about 1 rad around the cylinder, or the whole range of the
        parameter.
    progress
        Called with the parameter of each new point.

    Returns
    -------
    Branch
        Its ``reached_end`` and ``ended_because`` say whether the end asked for was reached.

    Raises
    ------
    InputError
        If an argument is out of range, or does not go with the others.
    NotConvergedError
        If the branch cannot even be started.
    """
    rtol = checked_rtol(rtol)
    largest_step = checked_number("largest_step", largest_step, 1e-4, 1.0, "from 0.0001 to 1")
    if parameter not in PATHS:
        raise InputError("parameter", parameter, f"must be one of {', '.join(PATHS)}")
    if start is not None:
        if mode is not None or mirror:
            raise InputError("start", None, "a branch from a given state takes neither mode nor mirror: leave them out")
        return _from_state(problem, start, parameter, until, rtol, largest_step, progress)
    if parameter != "force":
        raise InputError("parameter", parameter, "needs a state to start from: give start (for example branch[-1])")
    return _from_straight(problem, 1 if mode is None else mode, until, mirror, rtol, largest_step, progress)


def _from_straight(
    problem: Problem,
    mode: int | Mode,
    until: float | None,
    mirror: bool,
    rtol: float,
    largest_step: float,
    progress: Progress | None,
) -> Branch:
    until = None if until is None else checked_force("until", until)
    if until is None and problem.lateral_weight > 0.0 and not problem.pressed:
        raise InputError("until", None, "must be given: the rod is not pressed to the wall, so there is no lift-off")
    found = _mode(problem, mode, rtol)
    if until is not None and until >= found.force:
        raise InputError(
            "until",
            until,
            f"must be below the critical load {found.force:.8g} B/L², where the branch starts towards compression",
        )
    if found.wavenumber < RIGID:
        raise NotConvergedError(
            f"mode {found.number} turns the rod as a whole (its wavenumber is {found.wavenumber:.2g} rad/L): it has no "
            "buckled branch that could be followed; hold an end, or take the next mode"
        )
    start = at_critical(problem, found, until, mirror, rtol)
    stepping = Stepping(first=min(FIRST_STEP, largest_step), largest=largest_step, most_work=MOST_WORK)
    limit = found.force - REACH * found.wavenumber**2 if until is None else until
    if until is None and problem.lateral_weight == 0.0:  # lift-off coincides with buckling
        stepping = replace(stepping, most_points=2)
    stops = (END, OUT_OF_RANGE, LIFT_OFF) if until is None else (END, OUT_OF_RANGE)
    result = _traced(problem, start, limit, stepping, stops, switched=True, progress=progress)
    if len(result.points) == 1:
        raise NotConvergedError(
            f"mode {found.number} could not be followed from its critical load {found.force:.6g} B/L²: {result.end}"
        )
    if until is None and problem.lateral_weight == 0.0:
        result.end = LIFT_OFF
    reached = result.end == (LIFT_OFF if until is None else END)
    origin = Origin(f"mode {found.number}" + (", mirror arm" if mirror else ""), found, switched=True)
    return Branch(problem, origin, result, reached, result.end)


def _from_state(
    problem: Problem,
    start: Solution,
    parameter: str,
    until: float | None,
    rtol: float,
    largest_step: float,
    progress: Progress | None,
) -> Branch:
    if until is None:
        raise InputError("until", None, "must be given to follow a branch from a given state")
    until = checked_end(problem, parameter, until)
    if start.problem != problem:
        raise InputError("start", start.problem, "belongs to another problem")
    if until == parameter_value(start, parameter):
        raise InputError("until", until, "must differ from the value at the start")
    stepping = Stepping(first=min(FIRST_STEP_ON, largest_step), largest=largest_step, most_work=MOST_WORK)
    begin = at_state(problem, start, parameter, until, rtol)
    result = _traced(
        problem, begin, until, stepping, (END, OUT_OF_RANGE), parameter=parameter, switched=False, progress=progress
    )
    origin = Origin(f"from {parameter} = {begin[1].lam:.6g}")
    return Branch(problem, origin, result, result.end == END, result.end, parameter)


def checked_end(problem: Problem, parameter: str, until: float) -> float:
    """Return the end of a branch in a parameter, if the problem allows that value, or raise."""
    if parameter == "force":
        return checked_force("until", until)
    if parameter == "clearance" and problem.turns != 0:
        raise InputError("parameter", parameter, "a coiled rod cannot be followed in it: its end would have to move")
    return float(getattr(problem.but(**{parameter: until}), parameter))


def branch_off(
    point: SpecialPoint,
    *,
    until: float,
    mirror: bool = False,
    rtol: float = RTOL,
    largest_step: float = LARGEST_STEP,
    progress: Progress | None = None,
    origin: Origin | None = None,
) -> Branch:
    """Follow the branch that leaves another at a branch point, until it meets a symmetric branch again, or ``until``.

    Parameters
    ----------
    point
        A special point of kind "branch_point", from ``Branch.special_points``.
    until
        Value of the branch's parameter (the end force, usually) at which to end on the way down; on the way up it
        ends at the same distance.
    mirror
        The other of the two directions. On a symmetric branch it gives the mirror image.
    rtol, largest_step, progress
        As for :func:`follow`.
    origin
        Name and parent, for diagrams.

    Raises
    ------
    InputError
        If the point is of another kind or an argument is out of range.
    NotConvergedError
        If the branch cannot be started.
    """
    if point.kind != BRANCH_POINT:
        raise InputError("point", point.kind, "must be a special point of kind branch_point")
    problem, parameter = point.solution.problem, point.parameter
    until = checked_end(problem, parameter, until)
    start = at_branch_point(point, mirror, checked_rtol(rtol))
    stepping = Stepping(first=min(FIRST_STEP, largest_step), largest=largest_step, most_work=MOST_WORK)
    result = _traced(
        problem, start, until, stepping, (END, OUT_OF_RANGE), parameter=parameter, switched=True, progress=progress
    )
    if len(result.points) == 1:
        raise NotConvergedError(f"the branch at {point.value:.8g} could not be followed: {result.end}")
    name = origin or Origin(f"secondary from {point.value:.6g}", switched=True)
    return Branch(problem, name, result, result.end in (END, REJOINS), result.end, parameter)


def extended(branch: Branch, until: float, *, progress: Progress | None = None) -> Branch:
    """Return a branch continued from its last point down to the end force ``until``.

    Raises
    ------
    InputError
        If ``until`` is out of range.
    """
    until = checked_force("until", until)
    ladder, point = branch.last
    stepping = Stepping(first=FIRST_STEP_ON, largest=LARGEST_STEP, most_work=MOST_WORK)
    result = _traced(
        branch.problem, (ladder, point), until, stepping, (END, OUT_OF_RANGE), switched=False, progress=progress
    )
    return continued(branch, result, result.end == END, result.end)


def _traced(
    problem: Problem,
    start: Start,
    until: float,
    stepping: Stepping,
    stops: Sequence[str],
    *,
    parameter: str = "force",
    switched: bool,
    progress: Progress | None,
) -> Trace:
    """Trace a branch to ``until``, put its end exactly there, and stop where it rejoins a symmetric one."""
    ladder, point = start
    events = [_ACROSS, Event(END, lambda lam, _: lam - until)]
    if problem.lateral_weight > 0.0 or problem.turns != 0:
        events.append(_CONTACT)

    if problem.turns != 0:
        events.append(_ENERGY)
    if parameter != "force":
        low, high, _ = LIMITS[parameter]
        back = low if until > point.lam else high
        if back == 0.0 and parameter == "clearance":
            back = min(SMALLEST_CLEARANCE, 0.5 * point.lam)
        events.append(Event(LEFT, lambda lam, _: lam - back))
        stops = (*stops, LEFT)

    meetings: dict[float, Found | None] = {}

    def meeting(found: Found) -> Found | None:
        if found.point.lam not in meetings:
            meetings[found.point.lam] = rejoined(problem, found)
        return meetings[found.point.lam]

    def stop(found: Found) -> str:
        if found.name == TURN and np.max(np.abs(found.point.fine.c)) <= FLAT * ladder.coarse.scale_c:
            return STRAIGHT
        if found.name == TURN and meeting(found) is not None:
            return REJOINS
        return found.name if found.name in stops else ""

    report = None if progress is None else lambda p: progress(p.lam)
    result = trace(ladder, point, stepping, events, stop=stop, switched=switched, progress=report)
    if result.end == REJOINS:
        return _ended_at(result, meeting(result.found[-1]))
    return _end_exactly(result, until)


def _ended_at(result: Trace, meeting: Found | None) -> Trace:
    """Put the end of a branch on the branch point at which it meets another."""
    if meeting is not None:
        result.ladders[-1], result.points[-1] = meeting.ladder, meeting.point
        last = result.found.pop()
        # next to the meeting the softest eigenvalue vanishes like the square of the distance: its sign is noise
        near = SAME * abs(meeting.point.lam)
        result.found = [f for f in result.found if f.name != INDEX or abs(f.point.lam - meeting.point.lam) > near]
        changes = [f for f in result.found if f.name == INDEX]
        index = changes[-1].index_after if changes else result.points[min(1, len(result.points) - 1)].fine.index
        result.found.append(
            replace(
                last, ladder=meeting.ladder, point=meeting.point, lam_error=meeting.lam_error,
                index_before=index, index_after=index,
            )
        )  # fmt: skip
    return result


def _end_exactly(result: Trace, value: float) -> Trace:
    """Put the end of a branch that reached its end exactly there; that of one which reached the straight rod, on it."""
    last: Point | None = None
    if result.end == END:
        last = result.ladders[-1].at(result.points[-1], value)
    elif result.end == STRAIGHT:
        last = _flattened(result.ladders[-1], result.points[-1])
    if last is not None:
        result.points[-1] = last
        result.found[-1] = replace(result.found[-1], point=last)
    return result


def _flattened(ladder: Ladder, point: Point) -> Point:
    """The straight rod where a branch reaches it."""
    pairs = ((ladder.coarse, point.coarse), (ladder.fine, point.fine))
    return ladder.point(*(f.state(np.zeros_like(x.c), x.lam, x.tangent, x.tangent_lam, x.index) for f, x in pairs))


def _mode(problem: Problem, mode: int | Mode, rtol: float) -> Mode:
    """The mode to start from, computed unless it is given."""
    if not isinstance(mode, Mode):
        return critical_loads(problem, checked_whole("mode", mode, 1, MOST_MODES), rtol=rtol)[-1]
    if mode.problem != problem:
        raise InputError("mode", f"mode {mode.number} of {mode.problem}", "belongs to another problem")
    return mode
