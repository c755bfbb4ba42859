"""Branches made of what continuation found: its points, and the special points between them."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.solution import Solution, solution_of
from rodwell.analysis.branch.special import (
    BRANCH_POINT,
    CRITICAL,
    END,
    FOLD,
    KINDS,
    LIFT_OFF,
    LOCATED_NOISE,
    REJOINS,
    STRAIGHT,
    TOUCH_DOWN,
    UNCERTAIN,
    Origin,
    SpecialPoint,
    index_at_start,
)
from rodwell.analysis.discrete.folds import load_noise
from rodwell.numerics.continuation.events import INDEX, TURN, LocatedEvent
from rodwell.numerics.continuation.walk import Trace
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter
from rodwell.quantities.value import Value


def made(
    problem: Problem, origin: Origin, trace: Trace, reached: bool, why: str, parameter: Parameter = "force"
) -> Branch:
    """Return the branch of a trace: special points are found in it, in order of travel.

    ``reached`` says whether it was followed to where it was asked to end, ``why`` why it ended.
    """
    points = _Finding(problem, origin, trace, parameter).special_points()
    return Branch(problem, origin, trace, points, reached, why, parameter)


def continued(branch: Branch, trace: Trace, reached: bool, why: str) -> Branch:
    """Return ``branch`` followed by ``trace``, which starts at its last point."""
    old = branch.trace
    merged = replace(
        old,
        points=old.points[:-1] + trace.points,
        meshes=old.meshes[:-1] + trace.meshes,
        found=[f for f in old.found if f.name != END]
        + [replace(f, after=f.after + len(old.points) - 1) for f in trace.found],
        end=trace.end,
    )
    return made(branch.problem, branch.origin, merged, reached, why, branch.parameter)


@dataclass(frozen=True)
class _Finding:
    """What the special points of a branch are made of."""

    problem: Problem
    origin: Origin
    trace: Trace
    parameter: Parameter

    def special_points(self) -> tuple[SpecialPoint, ...]:
        """All special points. The start is one where it is shared with another branch, and the end always is."""
        trace = self.trace
        out = [self._start()] if self.origin.switched else []
        met = trace.found[-1:] if trace.end in (REJOINS, STRAIGHT) else []
        for event in trace.found:
            if event.name in KINDS:
                out.append(self._special(event, met=any(event is m for m in met)))
        if not out or out[-1].kind != END:
            point, number = trace.points[-1], len(trace.points) - 1
            last = self._solution(point, trace.meshes[-1])
            index = trace.found[-1].index_after if met else last.stability_index
            reached = Value(point.lam, out[-1].error if met else 0.0)
            out.append(SpecialPoint(END, last.force, reached, (), index, index, last, number, self.parameter))
        return tuple(out)

    def _solution(self, point: MeshedState, meshes: TwoMeshes) -> Solution:
        return solution_of(self.problem, self.parameter, point, meshes)

    def _start(self) -> SpecialPoint:
        """The point where the branch leaves another one, or the straight rod."""
        trace, origin = self.trace, self.origin
        point = trace.points[0]
        first, before = self._solution(point, trace.meshes[0]), point.fine.index
        kind = BRANCH_POINT if point.fine.c.any() else CRITICAL
        index, places = before, tuple[float, ...]()
        if len(trace.points) > 1:
            index = int(index_at_start(trace))
            if self.problem.untouched and kind == CRITICAL:  # it lifts off as it buckles
                places = self._solution(trace.points[1], trace.meshes[1]).highest_pressure[2]
        reached = Value(point.lam, max(origin.error, float(point.lam_gap)))
        return SpecialPoint(kind, first.force, reached, places, before, index, first, 0, self.parameter)

    def _special(self, event: LocatedEvent, *, met: bool) -> SpecialPoint:
        """What was found between two points; ``met``: the branch ends there, at another one."""
        solution = self._solution(event.point, event.meshes)
        kind = event.name
        if kind == INDEX:
            kind = FOLD if event.fold else BRANCH_POINT if event.certain else UNCERTAIN
        elif kind == TURN:
            kind = BRANCH_POINT if met else FOLD
        elif kind == LIFT_OFF and not event.rising:
            kind = TOUCH_DOWN
        places = solution.highest_pressure[2] if kind in (LIFT_OFF, TOUCH_DOWN) else ()
        error = event.lam_error + LOCATED_NOISE * abs(event.point.lam) if kind != END else 0.0
        if kind == FOLD:
            error += load_noise(event.meshes.fine, event.point.fine)
        reached, index = Value(event.point.lam, error), (event.index_before, event.index_after)
        return SpecialPoint(kind, solution.force, reached, places, *index, solution, event.after, self.parameter)
