"""Branches of equilibria: points, special points, states in between."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rodwell.analysis.accuracy import checked_force
from rodwell.analysis.critical import Mode
from rodwell.analysis.measures import Measured
from rodwell.analysis.solution import Solution
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.continuation import INDEX, Found, Trace
from rodwell.numerics.families import Outcome
from rodwell.numerics.location import LocationError, Span
from rodwell.numerics.spaces import FloatArray
from rodwell.problem import Problem

if TYPE_CHECKING:
    import xarray as xr

LIFT_OFF, END, CRITICAL, FOLD, BRANCH_POINT = "lift_off", "end", "critical", "fold", "branch_point"

OUT_OF_RANGE = Outcome.OUT_OF_RANGE.value
"""Why a branch ends where the rod turns across the cylinder."""

ROUND_OFF = 2e-13
"""Relative error that round-off in some hundred operations may leave in a located load."""


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
        out += [self._special(found) for found in self._trace.found if found.name != OUT_OF_RANGE]
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
