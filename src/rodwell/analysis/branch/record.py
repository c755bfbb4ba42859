"""A branch as a record: its points in order of travel, and the states in between."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rodwell.analysis.branch.solution import Solution, solution_of
from rodwell.analysis.branch.special import LOCATED_NOISE, Origin, SpecialPoint, index_at_start
from rodwell.analysis.straight.critical import Mode
from rodwell.errors import InputError, NotConvergedError, checked_number
from rodwell.numerics.continuation.location import LocationError, Segment, locate
from rodwell.numerics.continuation.walk import Trace
from rodwell.numerics.equilibria.error import CLAIMED_GAIN
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.physics.on_wall.parameters import FORCE
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter
from rodwell.quantities.arrays import FloatArray

if TYPE_CHECKING:
    from rodwell.analysis.beyond.off_wall_branch import OffWallBranch


class BranchRecord:
    """Points of a branch, special points, and the states between them: see :class:`rodwell.Branch`."""

    def __init__(
        self,
        problem: Problem,
        origin: Origin,
        trace: Trace,
        special_points: tuple[SpecialPoint, ...],
        reached: bool,
        why: str,
        parameter: Parameter = "force",
        beyond: OffWallBranch | None = None,
    ) -> None:
        self.problem, self.origin, self.parameter = problem, origin, parameter
        self.trace = trace
        self.special_points = special_points
        self._solutions: dict[int, Solution] = {}
        self.reached_end, self.ended_because = reached, why
        self.beyond = beyond

    def __len__(self) -> int:
        return len(self.trace.points)

    def __getitem__(self, i: int) -> Solution:
        i = range(len(self))[i]  # refuses what lies outside
        if i not in self._solutions:  # kept: with it the certificate, once asked for
            self._solutions[i] = self.solution(self.trace.points[i], self.trace.meshes[i])
        return self._solutions[i]

    def __iter__(self) -> Iterator[Solution]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        first, last = self.values[0], self.values[-1]
        return f"<Branch {self.name}: {len(self)} points, {self.parameter} = {first:.6g} … {last:.6g}>"

    def forget_tables(self) -> None:
        """Let go of what is made again where it is needed, most of what a branch keeps: all but what was found."""
        self._solutions.clear()
        for meshes in (*self.trace.meshes, *(point.solution.meshes for point in self.special_points)):
            meshes.coarse.forget_tables()
            meshes.fine.forget_tables()

    @property
    def name(self) -> str:
        """Name of the branch."""
        return self.origin.name

    @property
    def mode(self) -> Mode | None:
        """The buckling mode by which it leaves the straight rod; None if it starts elsewhere."""
        return self.origin.mode

    @cached_property
    def values(self) -> FloatArray:
        """The parameter at each point, (n,)."""
        return np.array([p.lam for p in self.trace.points])

    @cached_property
    def force(self) -> FloatArray:
        """End force F at s = 1 in B/L², tension positive, (n,)."""
        pairs = zip(self.trace.points, self.trace.meshes, strict=True)
        return np.array([meshes.fine.parameters(p.lam)[FORCE] for p, meshes in pairs])

    @cached_property
    def stability_index(self) -> FloatArray:
        """Stability index of each point, (n,): 0 is stable under dead loads, for a rod kept on the wall."""
        index = np.array([p.fine.index for p in self.trace.points])
        if self.origin.switched and len(index) > 1:
            index[0] = index_at_start(self.trace)
        return index

    @property
    def reach(self) -> tuple[float, float]:
        """Lowest and highest value of the parameter on the branch, folds included."""
        values = [*self.values, *(p.value for p in self.special_points)]
        return float(min(values)), float(max(values))

    @property
    def last(self) -> tuple[TwoMeshes, MeshedState]:
        """Meshes and state of the last point, from which the branch can be continued."""
        return self.trace.meshes[-1], self.trace.points[-1]

    def at(self, value: float) -> Solution:
        """Return the first state at a value of the parameter within the branch, converged like its points.

        Raises
        ------
        InputError
            If the branch does not pass that value.
        NotConvergedError
            If the state could not be computed.
        """
        value = checked_number(str(self.parameter), value, -1e12, 1e12, "a finite number")
        inside = self._steps_across(value)
        if not inside:
            range_ = f"{self.values.min():.6g} to {self.values.max():.6g}" + " B/L²" * (self.parameter == "force")
            raise InputError(str(self.parameter), value, f"this branch covers {range_}; follow it further")
        return self._state_within(inside[0], value)

    def states_at(self, value: float) -> tuple[Solution, ...]:
        """Return all states at a value of the parameter, in order of travel; none if the branch does not pass it.

        Raises
        ------
        NotConvergedError
            If a state could not be computed.
        """
        value = checked_number(str(self.parameter), value, -1e12, 1e12, "a finite number")
        steps = self._steps_across(value)
        return tuple(self._state_within(i, value) for k, i in enumerate(steps) if k == 0 or value != self.values[i])

    def _steps_across(self, value: float) -> list[int]:
        """Numbers of the points after which the parameter passes a value, or has it."""
        gaps = self.values - value
        return [int(i) for i in np.nonzero(gaps[:-1] * gaps[1:] <= 0.0)[0]]

    def _state_within(self, i: int, value: float) -> Solution:
        """The state at a value between points i and i+1, or at one of them."""
        for near in (i, i + 1):
            if value == self.values[near]:
                return self[near]
        try:
            return self._between(i, value)
        except LocationError as error:
            raise NotConvergedError(f"no state at {self.parameter} = {value:g}: {error}") from None

    def zero_between(self, i: int, function: Callable[[Family, State], float]) -> tuple[Solution, float]:
        """State between points i and i+1 at which a function of it changes sign, and the error of the parameter there.

        Located along the branch on both meshes, like special points; ``function`` takes the equations and the state on
        one mesh, and must have opposite signs at the two points.

        Raises
        ------
        NotConvergedError
            If no such state could be found.
        """
        try:
            meshes, (coarse, fine) = self._segments(i)
            ends = function(fine.family, fine.first), function(fine.family, fine.last)
            place = locate(coarse, fine, lambda segment, state: function(segment.family, state), ends)
        except LocationError as error:
            raise NotConvergedError(f"no zero between points {i} and {i + 1}: {error}") from None
        point = meshes.point(place.coarse, place.fine)
        return self.solution(point, meshes), place.gap / CLAIMED_GAIN + LOCATED_NOISE * abs(point.lam)

    def _segments(self, i: int) -> tuple[TwoMeshes, tuple[Segment, Segment]]:
        """The stretch of the branch between points i and i+1 on both meshes."""
        meshes, last = self.trace.meshes[i + 1], self.trace.points[i + 1]
        _, first = meshes.adopt(self.trace.meshes[i], self.trace.points[i])
        if first is None:
            raise LocationError("the point before it could not be solved on a finer mesh")
        return meshes, (Segment(meshes.coarse, first.coarse, last.coarse), Segment(meshes.fine, first.fine, last.fine))

    def _between(self, i: int, value: float) -> Solution:
        """State at ``value`` between points i and i+1, found along the branch and then solved exactly there."""
        meshes, (coarse, fine) = self._segments(i)
        near = meshes.point(coarse.at_lam(value), fine.at_lam(value))
        return self.solution(near if near.at(value) else meshes.at(near, value) or near, meshes)

    def solution(self, point: MeshedState, meshes: TwoMeshes) -> Solution:
        """Return the solution of a state of this branch, or of one between its points."""
        return solution_of(self.problem, self.parameter, point, meshes)
