"""Points of a curve in the plane of a load and another parameter: what defines them, and how one is solved for."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rodwell.analysis.critical import EULER
from rodwell.analysis.curves import CurvePoint
from rodwell.analysis.solution import Solution
from rodwell.numerics.families import Family, State
from rodwell.numerics.ladder import Ladder, Point
from rodwell.numerics.spaces import FloatArray, Prolongation

MOST_REFINEMENTS = 3
Function = Callable[[Family, State], float]


class Guess(NamedTuple):
    """Coefficients close to a point of the curve on both meshes, and states near it along the load."""

    coarse: FloatArray
    fine: FloatArray
    near: tuple[State | None, State | None] = (None, None)


class CurveLostError(RuntimeError):
    """A point of the curve could not be found."""


@dataclass(frozen=True)
class Spot:
    """A place in the plane: parameter and load."""

    x: float
    value: float


@dataclass(frozen=True)
class Seed:
    """A known state on the curve."""

    x: float
    solution: Solution

    @property
    def ladder(self) -> Ladder:
        """The meshes it stands on."""
        return self.solution.ladder

    @property
    def guess(self) -> Guess:
        """Coefficients on both meshes."""
        return Guess(self.solution.point.coarse.c, self.solution.point.fine.c)


@dataclass(frozen=True)
class Solved:
    """A point of the curve."""

    spot: Spot
    error: float
    solution: Solution
    places: tuple[float, ...]
    along_load: bool

    @property
    def guess(self) -> Guess:
        """Coefficients on both meshes, and the states where they were found along the load."""
        point = self.solution.point
        return Guess(point.coarse.c, point.fine.c, (point.coarse, point.fine) if self.along_load else (None, None))

    def as_point(self) -> CurvePoint:
        """The point as users see it."""
        allowed = self.solution.ladder.rtol * (abs(self.spot.value) + EULER)
        converged = self.solution.accurate and self.error <= allowed
        return CurvePoint(self.spot.x, self.spot.value, self.error, self.places, converged, self.solution)


class Zero(ABC):
    """What defines a curve: the zero of a function of equilibria, and how to reach equilibria in the plane.

    Parameters
    ----------
    over, load
        Names of the two parameters of the plane: x, and the load ("force" or "twist").
    """

    function: Function
    touch: bool
    either_way = True  # whether lines along the parameter can be searched too, where the curve is steep

    def __init__(self, over: str, load: str) -> None:
        self.over, self.load = over, load

    @abstractmethod
    def ladder(self, ladder: Ladder, spot: Spot, along: str) -> Ladder:
        """Return ``ladder`` with the equilibria along the parameter ``along`` through ``spot``."""

    @abstractmethod
    def solution(self, ladder: Ladder, point: Point, spot: Spot) -> Solution:
        """Return a point as a solution of the problem at ``spot``."""

    def value(self, solution: Solution) -> float:
        """Load of a solution."""
        return solution.force if self.load == "force" else solution.problem.twist

    def solve(self, ladder: Ladder, guess: Guess, spot: Spot, along: str, slope: float = 1.0) -> Solved:
        """Return the zero on the line through ``spot`` along one parameter, from coefficients close to it.

        ``slope`` turns an error of x into one of the load, where the line runs along x.
        """
        for refinement in range(MOST_REFINEMENTS + 1):
            line = self.ladder(ladder, spot, along)
            start = spot.value if along == self.load else spot.x
            near = guess.near if along == self.load else (None, None)
            coarse = _zero_on(line.coarse, guess.coarse, start, near[0], self.function)
            fine = _zero_on(line.fine, guess.fine, coarse.lam, near[1], self.function)
            point = line.point(coarse, fine)
            finer = None if point.accurate or refinement == MOST_REFINEMENTS else line.refined(point)
            if finer is None:
                break
            ladder = finer
            guess = Guess(
                Prolongation(line.coarse.space, finer.coarse.space)(coarse.c),
                Prolongation(line.fine.space, finer.fine.space)(fine.c),
            )
        there = Spot(spot.x, float(fine.lam)) if along == self.load else Spot(float(fine.lam), spot.value)
        error = (point.lam_gap + 2e-13 * abs(fine.lam)) * (1.0 if along == self.load else abs(slope))
        solution = self.solution(line, point, there)
        return Solved(there, error, solution, solution.highest_pressure[2] if self.touch else (), along == self.load)


def _zero_on(family: Family, c: FloatArray, lam: float, near: State | None, function: Function) -> State:
    """Zero of a function of the equilibria of a family, by the secant method in arclength from ``(c, λ)``.

    It begins on the hyperplane normal to the tangent of ``near``, so it works where the equilibria fold too; without
    such a state, at λ.
    """
    if near is None or near.space is not family.space:
        outcome, state, _ = family.at(c, lam)
    else:
        outcome, state, _ = family.correct(c, lam, near.row, near.row_lam, float(near.row @ c) + near.row_lam * lam)
    if state is None:
        raise CurveLostError(outcome.value)
    value, step = function(family, state), PROBE
    for _ in range(MOST_SECANTS):
        outcome, new, _ = family.step(state, step)
        if new is None:
            raise CurveLostError(outcome.value)
        if abs(step) <= SETTLED:
            return new
        f = function(family, new)
        if f == value:
            raise CurveLostError("the function does not change along the line")
        state, value, step = new, f, float(np.clip(-f * step / (f - value), -FARTHEST, FARTHEST))
    raise CurveLostError("the secant method did not settle")


PROBE, SETTLED, FARTHEST, MOST_SECANTS = 1e-5, 1e-9, 0.1, 30
"""First step, last step (the error left is about its square) and longest step of the secant method, in the metric."""
