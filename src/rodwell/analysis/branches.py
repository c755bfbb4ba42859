"""Following branches of buckled states, with lift-off and changes of stability."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rodwell.analysis.accuracy import (
    MOST_ELEMENTS_OF_BRANCH,
    MOST_WORK,
    RTOL,
    checked_force,
    checked_rtol,
    first_space,
)
from rodwell.analysis.critical import MOST_MODES, Mode, critical_loads
from rodwell.analysis.families import force_family
from rodwell.analysis.measures import STEEPEST, Measured, measured_ladder
from rodwell.analysis.solution import Solution
from rodwell.errors import InputError, NotConvergedError, checked_number, checked_whole
from rodwell.numerics.continuation import INDEX, Event, Found, Stepping, Trace, trace
from rodwell.numerics.families import Outcome
from rodwell.numerics.ladder import Ladder, Point
from rodwell.numerics.location import LocationError, Span
from rodwell.numerics.spaces import FloatArray, SplineSpace
from rodwell.problem import Problem

if TYPE_CHECKING:
    import xarray as xr

LIFT_OFF, END, CRITICAL, FOLD, BRANCH_POINT = "lift_off", "end", "critical", "fold", "branch_point"

LARGEST_ANGLE_OF_FIRST_STEP = 0.05
"""Radians around the cylinder that the first step on a buckled branch reaches, about."""

ROUND_OFF = 2e-13
"""Relative error that round-off in some hundred operations may leave in a located load."""

LARGEST_BRAID_ANGLE = 89.5
"""Degrees of |η| at which a branch ends: the theory holds below 90°."""

REACH = 6.0
"""Without ``until``, a branch is followed for lift-off to at most this many times its scale of load."""


@dataclass(frozen=True)
class SpecialPoint:
    """A point of a branch where something changes.

    Attributes
    ----------
    kind
        "critical" (the branch leaves the straight rod), "lift_off", "branch_point", "fold" or "end".
    force, error
        End force at s = 1 in B/L² (tension positive) and the estimate of its error.
    s
        Where along the rod: the places that lift off; empty for other kinds.
    index_before, index_after
        Stability index on either side, in the direction of travel.
    solution
        The state itself.
    """

    kind: str
    force: float
    error: float
    s: tuple[float, ...]
    index_before: int
    index_after: int
    solution: Solution


class Branch:
    """A branch of equilibria in the end force, points in order of travel.

    Attributes
    ----------
    problem
        The problem.
    mode
        The buckling mode it starts from; None for a branch that does not start at the straight rod.
    special_points
        In order of travel.
    reached_end
        Whether it was followed to where it was asked to end.
    ended_because
        Why it ended.
    """

    def __init__(self, problem: Problem, mode: Mode | None, result: Trace, reached: bool, why: str) -> None:
        self.problem, self.mode = problem, mode
        self._trace = result
        self.reached_end, self.ended_because = reached, why
        self.special_points = self._special_points()

    def __len__(self) -> int:
        return len(self._trace.points)

    def __getitem__(self, i: int) -> Solution:
        return Solution(self.problem, self._trace.points[i], self._trace.ladders[i])

    def __iter__(self) -> Iterator[Solution]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        name = f"mode {self.mode.number}" if self.mode else "no mode"
        return f"<Branch of {name}: {len(self)} points, F = {self.force[0]:.6g} … {self.force[-1]:.6g} B/L²>"

    @cached_property
    def force(self) -> FloatArray:
        """End force F at s = 1 in B/L², tension positive, (n,)."""
        return np.array([p.lam for p in self._trace.points])

    @cached_property
    def stability_index(self) -> FloatArray:
        """Stability index of each point, (n,): 0 is stable under dead loads, for a rod kept on the wall."""
        index = np.array([p.fine.index for p in self._trace.points])
        if self.mode is not None and len(index) > 1:
            index[0] = index[1]  # the first point is the straight rod, whose index is not the branch's
        return index

    def numbers(self, which: Measured) -> FloatArray:
        """Measured numbers of all points, (n,)."""
        return np.array([p.values[which] for p in self._trace.points])

    def errors(self, which: Measured) -> FloatArray:
        """Error estimates of :meth:`numbers`, (n,)."""
        return np.array([p.error[which] for p in self._trace.points])

    @property
    def converged(self) -> bool:
        """Whether every measured number of every point meets the tolerance."""
        return all(p.accurate for p in self._trace.points)

    @property
    def lift_off(self) -> SpecialPoint | None:
        """The first point where the rod leaves the wall, or None if it was not reached.

        Without lateral weight nothing but the buckled rod itself presses it to the wall: lift-off then
        coincides with buckling, and this is the critical point.
        """
        if self.problem.lateral_weight == 0.0 and self.mode is not None:
            return self.special_points[0]
        return next((p for p in self.special_points if p.kind == LIFT_OFF), None)

    @property
    def lift_off_at_buckling(self) -> bool:
        """Whether lift-off coincides with buckling: no lateral weight (weightless rod or vertical cylinder)."""
        return self.problem.lateral_weight == 0.0 and self.mode is not None

    def at(self, force: float) -> Solution:
        """Return the state at an end force within the branch, converged like its points.

        Raises
        ------
        InputError
            If the branch does not pass that force.
        NotConvergedError
            If the state could not be computed.
        """
        force = checked_force("force", force)
        inside = np.nonzero((self.force[:-1] - force) * (self.force[1:] - force) <= 0.0)[0]
        if inside.size == 0:
            low, high = self.force.min(), self.force.max()
            raise InputError("force", force, f"this branch covers {low:.6g} to {high:.6g} B/L²; follow it further")
        i = int(inside[0])
        for near in (i, i + 1):
            if force == self.force[near]:
                return self[near]
        try:
            return self._between(i, force)
        except LocationError as problem:
            raise NotConvergedError(f"no state at F = {force:g}: {problem}") from None

    def _between(self, i: int, force: float) -> Solution:
        """State at ``force`` between points i and i+1, found along the branch and then solved at that force."""
        ladder, last = self._trace.ladders[i + 1], self._trace.points[i + 1]
        _, first = ladder.adopt(self._trace.ladders[i], self._trace.points[i])
        if first is None:
            raise LocationError("the point before it could not be solved on a finer mesh")
        coarse = Span(ladder.coarse, first.coarse, last.coarse).at_lam(force)
        fine = Span(ladder.fine, first.fine, last.fine).at_lam(force)
        near = ladder.point(coarse, fine)
        return Solution(self.problem, ladder.at(near, force) or near, ladder)

    @cached_property
    def dataset(self) -> xr.Dataset:
        """All points as an xarray Dataset: see :func:`rodwell.analysis.dataset.branch_dataset`."""
        from rodwell.analysis.dataset import branch_dataset  # noqa: PLC0415

        return branch_dataset(self)

    def _special_points(self) -> tuple[SpecialPoint, ...]:
        points, ladders = self._trace.points, self._trace.ladders
        out = []
        if self.mode is not None:
            first = Solution(self.problem, points[0], ladders[0])
            places = self[1].highest_pressure[2] if self.lift_off_at_buckling and len(self) > 1 else ()
            index = int(self.stability_index[0])
            before = points[0].fine.index
            out.append(SpecialPoint(CRITICAL, self.mode.force, self.mode.error, places, before, index, first))
        out += [self._special(found) for found in self._trace.found if found.name != _TURNED_ACROSS.name]
        if not out or out[-1].kind != END:
            last = Solution(self.problem, points[-1], ladders[-1])
            index = last.stability_index
            out.append(SpecialPoint(END, last.force, 0.0, (), index, index, last))
        return tuple(out)

    def _special(self, found: Found) -> SpecialPoint:
        solution = Solution(self.problem, found.point, found.ladder)
        kind = found.name
        if kind == INDEX:
            kind = FOLD if found.fold else BRANCH_POINT
        places = solution.highest_pressure[2] if kind == LIFT_OFF else ()
        error = found.lam_error + ROUND_OFF * abs(found.point.lam) if kind != END else 0.0
        return SpecialPoint(kind, found.point.lam, error, places, found.index_before, found.index_after, solution)


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
    Outcome.OUT_OF_RANGE.value, lambda _, values: values[STEEPEST] - np.sin(np.radians(LARGEST_BRAID_ANGLE)), stop=True
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
