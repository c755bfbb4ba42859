"""Following a branch of buckled states: from the straight rod, from a given state, or from a branch point."""

from __future__ import annotations

from dataclasses import replace

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.functionals import Numbers, checked_numbers
from rodwell.analysis.branch.making import continued, made
from rodwell.analysis.branch.solution import Solution, solution_of
from rodwell.analysis.branch.special import BRANCH_POINT, END, FOLD, LIFT_OFF, REJOINS, Origin, SpecialPoint
from rodwell.analysis.branch.starts import (
    at_branch_point,
    at_critical,
    at_state,
    check_side,
    checked_end,
    crossing,
    onward,
    place_of,
)
from rodwell.analysis.branch.tracing import Progress, traced
from rodwell.analysis.branch.watching import Following, Watched, crossed
from rodwell.analysis.discrete import first_run
from rodwell.analysis.discrete.choices import MOST_WORK, checked_step
from rodwell.analysis.discrete.family import PATHS
from rodwell.analysis.straight.critical import MOST_MODES, Mode, critical_loads
from rodwell.analysis.straight.lying import check_pressed
from rodwell.errors import InputError, NotConvergedError, checked_whole
from rodwell.numerics.continuation.closing import CLOSED
from rodwell.numerics.continuation.events import Leaving
from rodwell.numerics.continuation.walk import Stepping
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Along, Parameter, ParameterPath, checked_parameter
from rodwell.quantities.tolerance import RTOL, checked_force, checked_rtol

LARGEST_STEP = 0.06
"""Default of the longest step: one unit is an amplitude of about 1 rad, or the whole range of the parameter."""

FIRST_STEP = 0.05
"""First step on a branch that leaves another: radians around the cylinder, about."""

FIRST_STEP_ON = 0.02
"""First step from a given state."""

RIGID = 0.1
"""Wavenumber, in rad/L, below which a mode hardly bends the rod: it is a rigid turn, resisted by weight alone."""

REACH = 6.0
"""Without ``until``, a branch is followed for lift-off to at most this many times its scale of load."""


def follow(
    problem: Problem,
    mode: int | Mode | None = None,
    *,
    until: float | None = None,
    mirror: bool = False,
    start: Solution | SpecialPoint | None = None,
    parameter: Parameter | Along = "force",
    events: Numbers | None = None,
    stop: Numbers | None = None,
    off_wall: bool = False,
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
        Without it, the branch ends at lift-off, or at the end of a path.
    mirror
        The other of the two arms that leave the straight rod: the paper draws ω₂(1) < 0, this is ω₂(1) > 0.
    start
        A state to start from instead (a coiled one, from :func:`equilibrium`; a special point); needs ``until``. From a
        fold the branch is followed as it went on there, to the side of the fold on which it has states.
    parameter
        What varies, from ``start``: "force", "weight", "alpha" (degrees), "clearance", "twist", "poisson" or "torsion"
        (on the last two, no state depends but by how far it is twisted); or a path of one's own, on which several vary:
        a :class:`rodwell.ParameterPath`, or its ``numbers`` alone for a t from 0 to 1.
    events, stop
        Numbers whose zeros are located along the branch, by the names that their special points get: measured numbers
        by name in the nomenclature, or functions of a :class:`Solution` that return a number. At the first zero of
        one in ``stop`` the branch ends. Two zeros within one step are not seen.
    off_wall
        Whether the branch leaves the wall where it lifts off, and goes on off it: :attr:`Branch.beyond`. Otherwise the
        rod is kept on the wall. Needs ``until``, the end force; events and stop conditions are watched on the wall.
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
    watched = Watched(checked_numbers("events", events), checked_numbers("stop", stop))
    parameter = checked_parameter(parameter, PATHS)
    how = Following(checked_rtol(rtol), checked_step(largest_step), progress, watched, off_wall)
    how.check(problem, parameter, until)
    first_run.begin(problem)
    if start is not None:
        if mode is not None or mirror:
            raise InputError("start", None, "a branch from a given state takes neither mode nor mirror: leave them out")
        return from_state(problem, start, parameter, until, how)
    if parameter != "force":
        raise InputError("parameter", parameter, "needs a state to start from: give start (for example branch[-1])")
    return _from_straight(problem, 1 if mode is None else mode, until, mirror, how)


def _from_straight(
    problem: Problem,
    mode: int | Mode,
    until: float | None,
    mirror: bool,
    how: Following,
) -> Branch:
    until = None if until is None else checked_force("until", until)
    if until is None and not problem.untouched and not (problem.pressed or problem.hole is not None):
        raise InputError("until", None, "must be given: the rod is not pressed to the wall, so there is no lift-off")
    first = _mode(problem, mode, how.rtol)
    if until is None:
        check_pressed(problem, first.force)
    if until is not None and until >= first.force:
        raise InputError(
            "until",
            until,
            f"must be below the critical load {first.force:.8g} B/L², where the branch starts towards compression",
        )
    if first.wavenumber < RIGID:
        raise NotConvergedError(
            f"{first.name} turns the rod as a whole (its wavenumber is {first.wavenumber:.2g} rad/L): it has no "
            "buckled branch that could be followed; hold an end, or take the next mode"
        )
    start, stepping = at_critical(problem, first, until, mirror, how.rtol), how.stepping(FIRST_STEP)
    limit = first.force - REACH * first.wavenumber**2 if until is None else until
    if until is None and problem.untouched:  # lift-off coincides with buckling
        stepping = replace(stepping, most_points=2)
    how.watched.tried(solution_of(problem, "force", start[1], start[0]))
    simple = len(first.together) == 1
    leaves = Leaving(falling=first.number - 1, rising=first.number) if simple else Leaving()
    result = traced(
        problem, start, limit, stepping, ends_at=(LIFT_OFF,) if until is None else how.ends_at, leaves=leaves,
        progress=how.progress, halt=how.watched.halt(problem, "force"),
    )  # fmt: skip
    if len(result.points) == 1:
        raise NotConvergedError(
            f"{first.name} could not be followed from its critical load {first.force:.6g} B/L²: {result.end}"
        )
    if until is None and problem.untouched:
        result.end = LIFT_OFF
    reached = result.end == (LIFT_OFF if until is None else END)
    name = first.name + (", mirror arm" if mirror else "")
    origin = Origin(name, None if first.mixed else first, switched=True, mirror=mirror, error=first.error)
    return how.crossed(how.watched.seen(made(problem, origin, result, reached, result.end)), until)


def from_state(
    problem: Problem, start: Solution | SpecialPoint, parameter: Parameter, until: float | None, how: Following
) -> Branch:
    """Follow a branch from a known state, as :func:`follow` does with ``start``."""
    if until is None:
        if not isinstance(parameter, ParameterPath):
            raise InputError("until", None, "must be given to follow a branch from a given state")
        until = parameter.limits[1]
    until = checked_end(problem, parameter, until)
    fold = start if isinstance(start, SpecialPoint) and start.kind == FOLD and start.parameter is parameter else None
    here, start = place_of(start, parameter)
    if start.problem != problem:
        differ = problem.differences(start.problem)
        raise InputError("start", start, f"belongs to another problem ({differ}): follow it in what differs first")
    if isinstance(parameter, ParameterPath) and (differ := parameter.misses(problem, start.force, here)):
        raise InputError("start", start, f"does not lie on the path ({differ}): the path must begin at it")
    if until == here:
        raise InputError("until", until, "must differ from the value at the start")
    if not start.point.fine.c.any() and problem.turns == 0 and (parameter == "force" or problem.hole is None):
        reason = "is the rod that has not buckled, which stays so whatever varies: follow a mode from its critical load"
        raise InputError("start", start, reason)
    if fold is not None:
        check_side(fold, until)
    begin = at_state(problem, start, parameter, here, until, how.rtol, fold=fold is not None)
    how.watched.tried(start)
    how.check_start(start)
    result = traced(
        problem, begin, until, how.stepping(FIRST_STEP_ON), ends_at=how.ends_at, parameter=parameter,
        progress=how.progress, leaves=None if fold is None else onward(fold),
        halt=how.watched.halt(problem, parameter),
    )  # fmt: skip
    origin = Origin(f"from {parameter} = {begin[1].lam:.6g}")
    branch = made(problem, origin, result, result.end in (END, CLOSED), result.end, parameter)
    return how.crossed(how.watched.seen(branch), until)


def branch_off(
    point: SpecialPoint,
    *,
    until: float,
    mirror: bool = False,
    events: Numbers | None = None,
    stop: Numbers | None = None,
    off_wall: bool = False,
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
        Value of the branch's parameter (the end force, usually) at which to end.
    mirror
        The other of the two directions. On a symmetric branch it gives the mirror image.
    events, stop, off_wall, rtol, largest_step, progress
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
    watched = Watched(checked_numbers("events", events), checked_numbers("stop", stop))
    how = Following(checked_rtol(rtol), checked_step(largest_step), progress, watched, off_wall)
    how.check(problem, parameter, until)
    watched.tried(point.solution)
    how.check_start(point.solution)
    start, stepping = at_branch_point(point, mirror, how.rtol), how.stepping(FIRST_STEP)
    result = traced(
        problem, start, until, stepping, ends_at=how.ends_at, parameter=parameter, leaves=crossing(point),
        progress=progress, halt=watched.halt(problem, parameter),
    )  # fmt: skip
    if len(result.points) == 1:
        raise NotConvergedError(f"the branch at {point.value:.8g} could not be followed: {result.end}")
    origin = replace(origin or Origin(f"secondary from {point.value:.6g}", switched=True), error=point.error)
    branch = made(problem, origin, result, result.end in (END, REJOINS, CLOSED), result.end, parameter)
    return how.crossed(watched.seen(branch), until)


def extended(branch: Branch, until: float, *, progress: Progress | None = None) -> Branch:
    """Return a branch continued from its last point down to the end force ``until``, on the wall.

    One that has left the wall is followed on off it, once more from lift-off.

    Raises
    ------
    InputError
        If ``until`` is out of range.
    """
    until = checked_force("until", until)
    if branch.beyond is not None:
        return crossed(branch, until, branch.beyond.rtol, progress)
    stepping = Stepping(first=FIRST_STEP_ON, largest=LARGEST_STEP, most_work=MOST_WORK)
    result = traced(branch.problem, branch.last, until, stepping, progress=progress)
    return continued(branch, result, result.end == END, result.end)


def _mode(problem: Problem, mode: int | Mode, rtol: float) -> Mode:
    """The mode to start from, computed unless it is given."""
    if not isinstance(mode, Mode):
        return critical_loads(problem, checked_whole("mode", mode, 1, MOST_MODES), rtol=rtol)[-1]
    if mode.problem != problem:
        differ = problem.differences(mode.problem)
        raise InputError("mode", f"mode {mode.number}", f"belongs to another problem ({differ})")
    return mode
