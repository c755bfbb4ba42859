"""How branches are followed, with events and stop conditions that users bring, and off the wall beyond lift-off.

Events are numbers of a state whose zeros on a branch are located like others.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.functionals import Number, Numbers, changes_sign, number_of, value_of, value_on
from rodwell.analysis.branch.making import made
from rodwell.analysis.branch.solution import Solution, solution_of
from rodwell.analysis.branch.special import END, LIFT_OFF, SpecialPoint
from rodwell.analysis.branch.tracing import Progress
from rodwell.analysis.discrete.choices import MOST_WORK
from rodwell.analysis.discrete.measures import Measured
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.continuation.events import LocatedEvent
from rodwell.numerics.continuation.walk import Halt, Stepping, Trace
from rodwell.numerics.equilibria.state import State
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value


@dataclass(frozen=True)
class Watched:
    """What users ask to be told of along a branch, and where they ask it to end: numbers whose zeros matter."""

    events: Numbers = field(default_factory=dict)
    stop: Numbers = field(default_factory=dict)

    def tried(self, state: Solution) -> None:
        """Evaluate all of them once, so that what cannot work is told before a branch is followed."""
        for which in (*self.events.values(), *self.stop.values()):
            number_of(state, which)

    def halt(self, problem: Problem, parameter: Parameter) -> Halt | None:
        """What ends a walk: the name of the first stop condition that changes its sign in the last step, or ""."""
        if not self.stop:
            return None
        last: dict[str, float] = {}

        def halt(trace: Trace) -> str:
            solution = solution_of(problem, parameter, trace.points[-1], trace.meshes[-1])
            before = dict(last)
            last.update({name: value_of(solution, which) for name, which in self.stop.items()})
            changed = (name for name in before if changes_sign(before[name], last[name]))
            return next(changed, "")

        return halt

    def seen(self, branch: Branch) -> Branch:
        """Return a branch that ends where a stop condition was met, with the events that were met on it."""
        if branch.ended_because in self.stop:
            branch = _ended(branch, branch.ended_because, self.stop[branch.ended_because])
        found = [point for name, which in self.events.items() for point in zeros(branch, name, which)]
        if not found:
            return branch
        order = sorted((*branch.special_points, *found), key=lambda point: _place(branch, point))
        ending = branch.reached_end, branch.ended_because
        return Branch(branch.problem, branch.origin, branch.trace, tuple(order), *ending, branch.parameter)


@dataclass(frozen=True)
class Following:
    """How branches are followed: to which tolerance, with which longest step, and who is told."""

    rtol: float
    largest_step: float
    progress: Progress | None = None
    watched: Watched = field(default_factory=Watched)
    off_wall: bool = False

    def stepping(self, first: float) -> Stepping:
        """Steps of which the first is as given, if it is not too long."""
        return Stepping(first=min(first, self.largest_step), largest=self.largest_step, most_work=MOST_WORK)

    @property
    def ends_at(self) -> tuple[str, ...]:
        """Events at which the part of a branch on the wall ends."""
        return (LIFT_OFF,) if self.off_wall else ()

    def check(self, problem: Problem, parameter: Parameter, until: float | None) -> None:
        """Raise if a branch that is to go on off the wall cannot."""
        from rodwell.analysis.beyond.crossing import check_crosses  # noqa: PLC0415 - most who follow stay on the wall

        if not self.off_wall:
            return
        if parameter != "force":
            raise InputError("parameter", str(parameter), "must be force where branches go on off the wall (off_wall)")
        if until is None:
            raise InputError("until", None, "must be given with off_wall: the end force to which it is followed")
        check_crosses(problem)

    def check_start(self, start: Solution) -> None:
        """Raise if a branch that is to go on off the wall would not begin on it."""
        if self.off_wall and start.number(Measured.P_MAX).value > 0.0:
            raise InputError("start", start, "is kept on the wall, which would have to pull: begin where contact is "
                             "complete, or leave off_wall out")  # fmt: skip

    def crossed(self, branch: Branch, until: float | None) -> Branch:
        """Return a branch that has lifted off with what follows off the wall; any other as it is."""
        if not self.off_wall or until is None or branch.ended_because != LIFT_OFF:
            return branch
        return crossed(branch, until, self.rtol, self.progress)


def crossed(branch: Branch, until: float, rtol: float, progress: Progress | None = None) -> Branch:
    """Return a branch that ended at lift-off with its states off the wall, followed to the end force ``until``.

    Where none was found that goes on, it says so.
    """
    from rodwell.analysis.beyond.crossing import beyond_lift_off  # noqa: PLC0415 - most who follow stay on the wall

    lifts = next(point for point in branch.special_points if point.kind == LIFT_OFF)
    before, beyond = branch[lifts.after], None
    back = 2.0 * float(branch.force[0]) - until  # as far on the other side of its start
    try:
        beyond = beyond_lift_off(before, lifts.force, until, back, rtol, progress)
    except NotConvergedError as error:
        reached, why = False, str(error)
    else:
        reached, why = beyond.reached_end, beyond.ended_because
    points = tuple(point for point in branch.special_points if point.kind != END)
    return Branch(branch.problem, branch.origin, branch.trace, points, reached, why, branch.parameter, beyond)


def zeros(branch: Branch, name: str, which: Number) -> list[SpecialPoint]:
    """Special points of a branch at which a number vanishes, in order of travel, each located on both meshes.

    Where it changes its sign from one point to the next there is at least one; two within a step are not seen. A zero
    that cannot be located is given with its step as its error.
    """
    values = branch.numbers(which)
    return [
        _zero(branch, i, name, which)
        for i in range(len(branch) - 1)
        if changes_sign(float(values[i]), float(values[i + 1]))
    ]


def _zero(branch: Branch, i: int, name: str, which: Number) -> SpecialPoint:
    """The zero of a number between points i and i+1."""
    function = value_on(branch.problem, branch.parameter, branch.trace.meshes[i + 1], which)
    try:
        solution, error = branch.zero_between(i, function)
    except NotConvergedError:
        solution, error = branch[i + 1], abs(float(branch.values[i + 1] - branch.values[i]))
    value = solution.point.lam
    index = int(branch.stability_index[i])
    for change in branch.special_points:  # it is that of the side on which the zero lies
        if change.after == i and change.index_before != change.index_after and not _behind(branch, solution, change):
            index = change.index_after
    return SpecialPoint(name, solution.force, Value(value, error), (), index, index, solution, i, branch.parameter)


def _place(branch: Branch, point: SpecialPoint) -> tuple[int, float]:
    """Where a special point lies in the order of travel."""
    if point.kind == END:
        return len(branch), 0.0
    return point.after, _along(branch, point.after, point.solution)


def _behind(branch: Branch, solution: Solution, change: SpecialPoint) -> bool:
    """Whether a state comes before a special point of the same step."""
    return _along(branch, change.after, solution) < _along(branch, change.after, change.solution)


def _along(branch: Branch, i: int, solution: Solution) -> float:
    """How far a state lies from point i along the branch, as a part of the step, in the metric of the family."""
    family = branch.trace.meshes[min(i + 1, len(branch) - 1)].fine
    weights = 1.0 / family.slope_scale, np.sqrt(LOOKED_AT.size) / family.lam_scale

    def vector(state: State) -> FloatArray:
        slopes = state.space.evaluate(state.c, LOOKED_AT, 2)[1]
        return np.array([*(weights[0] * slopes), weights[1] * state.lam])

    start, end = (vector(branch.trace.points[k].fine) for k in (i, min(i + 1, len(branch) - 1)))
    step = end - start
    return float((vector(solution.point.fine) - start) @ step / max(float(step @ step), TINY))


LOOKED_AT, TINY = np.linspace(0.0, 1.0, 65), 1e-300
"""Places along the rod at which states are compared; stands for zero in a denominator."""


def _ended(branch: Branch, name: str, which: Number) -> Branch:
    """The branch ended at the zero of a stop condition in its last step."""
    last = len(branch) - 2
    point = _zero(branch, last, name, which)
    old, state = branch.trace, point.solution
    here = _along(branch, last, state)

    def stays(event: LocatedEvent) -> bool:
        at = solution_of(branch.problem, branch.parameter, event.point, event.meshes)
        return event.after < last or _along(branch, last, at) < here

    points, meshes = [*old.points[:-1], state.point], [*old.meshes[:-1], state.meshes]
    cut = replace(old, points=points, meshes=meshes, found=[event for event in old.found if stays(event)], end=name)
    ended = made(branch.problem, branch.origin, cut, True, name, branch.parameter)
    end = replace(ended.special_points[-1], kind=name, reached=point.reached)
    special = (*ended.special_points[:-1], end, ended.special_points[-1])
    return Branch(ended.problem, ended.origin, ended.trace, special, True, name, ended.parameter)
