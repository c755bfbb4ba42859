"""Following a branch of buckled states from the straight rod, or from a given state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rodwell.analysis.accuracy import (
    MOST_ELEMENTS_OF_BRANCH,
    MOST_WORK,
    RTOL,
    checked_force,
    checked_rtol,
    first_space,
)
from rodwell.analysis.branches import END, LIFT_OFF, OUT_OF_RANGE, Branch
from rodwell.analysis.critical import MOST_MODES, Mode, critical_loads
from rodwell.analysis.families import force_family
from rodwell.analysis.measures import STEEPEST, Measured, measured_ladder
from rodwell.analysis.solution import Solution
from rodwell.errors import InputError, NotConvergedError, checked_number, checked_whole
from rodwell.numerics.continuation import Event, Stepping, Trace, trace
from rodwell.numerics.ladder import Ladder, Point
from rodwell.numerics.spaces import FloatArray, SplineSpace
from rodwell.problem import Problem

LARGEST_ANGLE_OF_FIRST_STEP = 0.05
"""Radians around the cylinder that the first step on a buckled branch reaches, about."""

LARGEST_BRAID_ANGLE = 89.5
"""Degrees of |η| at which a branch ends: the theory holds below 90°."""

REACH = 6.0
"""Without ``until``, a branch is followed for lift-off to at most this many times its scale of load."""

Progress = Callable[[float], None]
"""Called with the end force of each new point."""


def follow(
    problem: Problem,
    mode: int | Mode = 1,
    *,
    until: float | None = None,
    mirror: bool = False,
    start: Solution | None = None,
    rtol: float = RTOL,
    largest_step: float = 0.04,
    progress: Progress | None = None,
) -> Branch:
    """Follow a branch of buckled states in the end force, from the straight rod or from a given state.

    Parameters
    ----------
    problem
        The rod, clamped at both ends; twist stays constant.
    mode
        Number of the buckling mode to start from, 1 for the first met, or a :class:`Mode` already computed.
    until
        End force at s = 1 in B/L² (tension positive) at which to end. Without it, the branch ends at lift-off.
    mirror
        The other of the two arms that leave the straight rod: the paper draws ω₂(1) < 0, this is ω₂(1) > 0.
    start
        A state to start from instead (for example a coiled one, from :func:`equilibrium`); needs ``until``.
    rtol
        Relative tolerance of every measured number and special point.
    largest_step
        Longest step. One unit is an amplitude of about 1 rad around the cylinder, or the whole range of force.
    progress
        Called with the force of each new point.

    Returns
    -------
    Branch
        Its ``reached_end`` and ``ended_because`` say whether the end asked for was reached.

    Raises
    ------
    InputError
        If an argument is out of range.
    NotConvergedError
        If the branch cannot even be started.
    """
    rtol = checked_rtol(rtol)
    until = None if until is None else checked_force("until", until)
    largest_step = checked_number("largest_step", largest_step, 1e-4, 1.0, "from 0.0001 to 1")
    if start is not None:
        return _follow_from(problem, start, until, largest_step, progress)
    if until is None and problem.on_top and problem.lateral_weight > 0.0:
        raise InputError("on_top", True, "a rod on top is not pressed to the wall, so it has no lift-off: give until")
    found = _mode(problem, mode, rtol)
    if until is not None and until >= found.force:
        raise InputError(
            "until",
            until,
            f"must be below the critical load {found.force:.8g} B/L², where the branch starts towards compression",
        )
    ladder, point = _at_critical(problem, found, until, mirror, rtol)
    length = LARGEST_ANGLE_OF_FIRST_STEP
    stepping = Stepping(first=min(length, largest_step), largest=largest_step, most_work=MOST_WORK)
    events = [Event(LIFT_OFF, lambda _, values: values[Measured.P_MAX], stop=until is None), _TURNED_ACROSS]
    limit = found.force - REACH * found.wavenumber**2 if until is None else until
    events.append(Event(END, lambda lam, _: lam - limit, stop=True))
    if problem.lateral_weight == 0.0:
        events.pop(0)  # lift-off coincides with buckling
        if until is None:
            stepping = Stepping(first=length, largest=length, most_points=2)
    result = _end_exactly(trace(ladder, point, stepping, events, _reporting(progress)), limit)
    if until is None and problem.lateral_weight == 0.0 and len(result.points) > 1:
        result.end = LIFT_OFF
    reached = result.end == (LIFT_OFF if until is None else END)
    if len(result.points) == 1:
        raise NotConvergedError(
            f"mode {found.number} could not be followed from its critical load {found.force:.6g} B/L²: {result.end}"
        )
    return Branch(problem, found, result, reached, result.end)


_TURNED_ACROSS = Event(
    OUT_OF_RANGE, lambda _, values: values[STEEPEST] - np.sin(np.radians(LARGEST_BRAID_ANGLE)), stop=True
)


def _mode(problem: Problem, mode: int | Mode, rtol: float) -> Mode:
    """The mode to start from, computed unless it is given."""
    if not isinstance(mode, Mode):
        return critical_loads(problem, checked_whole("mode", mode, 1, MOST_MODES), rtol=rtol)[-1]
    if mode.problem != problem:
        raise InputError("mode", f"mode {mode.number} of {mode.problem}", "belongs to another problem")
    return mode


def _reporting(progress: Progress | None) -> Callable[[Point], None] | None:
    return None if progress is None else lambda point: progress(point.lam)


def _end_exactly(result: Trace, force: float) -> Trace:
    """Put the end of a branch that reached its end force exactly there."""
    if result.end == END:
        last = result.ladders[-1].at(result.points[-1], force)
        if last is not None:
            result.points[-1] = last
            result.found[-1] = replace(result.found[-1], point=last)
    return result


def _at_critical(problem: Problem, mode: Mode, until: float | None, mirror: bool, rtol: float) -> tuple[Ladder, Point]:
    """Ladder for the branch, and the straight rod at the critical load with the mode as tangent."""
    reach = until if until is not None else mode.force - mode.wavenumber**2
    space = first_space(problem, min(reach, mode.force), max(reach, mode.force))
    family = force_family(
        problem,
        space,
        parity=mode.parity if problem.twist == 0.0 or mode.parity < 0 else 0,
        wavenumber=mode.wavenumber,
        force_scale=max(abs(reach - mode.force), 0.1 * mode.wavenumber**2),
    )
    ladder = measured_ladder(family, rtol, MOST_ELEMENTS_OF_BRANCH)

    def straight(on: SplineSpace) -> FloatArray:
        shape = mode.space.evaluate(mode.coefficients, on.points, 1)[0]
        return on.project(-shape if mirror else shape, held=2)

    # the index just above the critical load: as many modes as have been met before this one
    states = [f.state(np.zeros(f.space.size), mode.force, straight(f.space), 0.0, mode.number - 1)
              for f in (ladder.coarse, ladder.fine)]  # fmt: skip
    return ladder, ladder.point(*states)


def _follow_from(
    problem: Problem, start: Solution, until: float | None, largest_step: float, progress: Progress | None
) -> Branch:
    if until is None or until == start.force:
        raise InputError("until", until, "is needed to follow a branch from a given state, and must differ from it")
    if start.problem != problem:
        raise InputError("start", start.problem, "belongs to another problem")
    point = start.point
    if (until - start.force) * point.coarse.tangent_lam < 0.0:
        point = Point(point.coarse.reversed(), point.fine.reversed(), point.values, point.error, point.excess)
    events = [
        Event(LIFT_OFF, lambda _, values: values[Measured.P_MAX]),
        _TURNED_ACROSS,
        Event(END, lambda lam, _: lam - until, stop=True),
    ]
    stepping = Stepping(first=min(0.02, largest_step), largest=largest_step, most_work=MOST_WORK)
    result = _end_exactly(trace(start.ladder, point, stepping, events, _reporting(progress)), until)
    return Branch(problem, None, result, result.end == END, result.end)
