"""Tracing a curve in the plane of a load and another parameter, every point solved on both meshes.

A point of the curve is a zero of a function of equilibria on the line x = const, or load = const where the curve is
steep, found by the secant method in arclength along those equilibria; prediction is along the last two points. So the
curve may turn back in x, and pass places where the equilibria fold.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rodwell.analysis.critical import EULER
from rodwell.analysis.curves import SWITCH, TURN, CurvePoint, Mark, Progress
from rodwell.analysis.measures import pressure_maxima
from rodwell.analysis.solution import Solution
from rodwell.errors import InputError
from rodwell.numerics.families import Family, State
from rodwell.numerics.ladder import Ladder, Point
from rodwell.numerics.location import bracketed_root
from rodwell.numerics.spaces import FloatArray, Prolongation

FIRST_STEP, LARGEST_STEP, SMALLEST_STEP = 0.004, 0.02, 1e-6
"""Steps, as parts of the range in x and of the load."""

STEEP = 0.3
"""Below this share of x in the direction of the curve, the load is prescribed instead."""

BENT = 0.2
"""A point farther from its prediction than this part of the step is sought again with half the step."""

NEAR = 0.03
"""Places on the rod closer than this count as the same place that moves."""

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
        converged = self.solution.converged and self.error <= allowed
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


def trace_curve(
    zero: Zero, seed: Seed, end: float, progress: Progress | None
) -> tuple[tuple[CurvePoint, ...], tuple[Mark, ...], str]:
    """Trace a curve from a state on it to x = ``end``: points, marks, and why it ended ("end": it got there)."""
    return _Tracer(zero, seed, end).run(progress or (lambda _part: None))


class _Tracer:
    """A curve in the making."""

    def __init__(self, zero: Zero, seed: Seed, end: float) -> None:
        self.zero, self.end = zero, end
        self.range = abs(end - seed.x)
        self.sign = 1.0 if end > seed.x else -1.0
        first = zero.solve(seed.ladder, seed.guess, Spot(seed.x, zero.value(seed.solution)), zero.load)
        self.solved = [first]
        self.marks: list[Mark] = []
        self.direction = np.array([self.sign, 0.0])
        self.travelled = 0.0
        self.fresh = True  # the direction is not known yet: at the start, and after a kink

    def run(self, tell: Progress) -> tuple[tuple[CurvePoint, ...], tuple[Mark, ...], str]:
        """Step until the end, or until steps become too short."""
        step, why = FIRST_STEP, ""
        while not why:
            last = self.solved[-1]
            try:
                new, moved = self._step(step)
                why = self._accept(new, moved, step)
                step = min(LARGEST_STEP, 1.5 * step)
            except CurveLostError as problem:
                step *= 0.5
                if step < SMALLEST_STEP:
                    why = str(problem)
            tell(min(1.0, abs(last.spot.x - self.solved[0].spot.x) / self.range))
        return tuple(s.as_point() for s in self.solved), tuple(self.marks), why

    def _scale(self) -> np.ndarray:
        return np.array([self.range, max(abs(self.solved[-1].spot.value), 1.0)])

    def _step(self, step: float) -> tuple[Solved, np.ndarray]:
        """Solve for the next point; returns it and the way to it, in scaled coordinates."""
        last, scale = self.solved[-1], self._scale()
        here = np.array([last.spot.x, last.spot.value])
        steep = self.zero.either_way and abs(self.direction[0]) < STEEP
        along = self.zero.over if steep else self.zero.load
        to_end = (self.end - last.spot.x) / (self.direction[0] * scale[0]) if self.direction[0] != 0.0 else np.inf
        if along == self.zero.load and 0.0 < to_end <= step:
            target = np.array([self.end, here[1] + to_end * self.direction[1] * scale[1]])
            step = to_end
        else:
            target = here + step * self.direction * scale
        guess = self._guess(step)
        slope = self.direction[1] / max(abs(self.direction[0]), 1e-12) * scale[1] / scale[0]
        try:
            new = self.zero.solve(last.solution.ladder, guess, Spot(*target), along, slope)
            if (new.spot.x - self.end) * self.sign > 0.0:
                new = self.zero.solve(last.solution.ladder, new.guess, Spot(self.end, target[1]), self.zero.load)
                target = np.array([new.spot.x, new.spot.value])
        except InputError as problem:
            raise CurveLostError(f"the curve leaves the range of {self.zero.over}") from problem
        moved = (np.array([new.spot.x, new.spot.value]) - here) / scale
        missed = float(np.linalg.norm((np.array([new.spot.x, new.spot.value]) - target) / scale)) - 1e-7
        if not self.fresh and missed > BENT * step + 1e-9 and not _straightens(last, new):
            raise CurveLostError("the curve bends too sharply")
        return new, moved

    def _guess(self, step: float) -> Guess:
        """Coefficients at the next point, extrapolated from the last two where they stand on the same meshes."""
        last = self.solved[-1]
        before, here = self.solved[-2].guess if len(self.solved) > 1 else last.guess, last.guess
        if self.fresh or before.coarse.size != here.coarse.size:
            return here
        ratio = step / self.travelled
        return Guess(
            here.coarse + ratio * (here.coarse - before.coarse),
            here.fine + ratio * (here.fine - before.fine),
            here.near,
        )

    def _accept(self, new: Solved, moved: np.ndarray, step: float) -> str:
        """Add a point, with what is special between it and the last; returns why the curve ends there, or ""."""
        last = self.solved[-1]
        if _straightens(last, new):
            if step > 10.0 * SMALLEST_STEP:
                raise CurveLostError(BECOMES_STRAIGHT)
            return BECOMES_STRAIGHT
        kink = self.zero.touch and _jumped(last, new)
        if kink:
            if step > 10.0 * SMALLEST_STEP and abs(new.spot.x - last.spot.x) > 1e-3 * self.range:
                raise CurveLostError("the place that lifts off jumps")
            self.marks.append(self._switch(last, new))
        if moved[0] * self.direction[0] < 0.0:
            width = abs(moved[0]) * self.range
            self.marks.append(Mark(TURN, last.spot.x, width, last.spot.value, last.error, "the curve turns back"))
        self.travelled = float(np.linalg.norm(moved))
        self.direction = np.array([self.sign, 0.0]) if kink else moved / self.travelled
        self.fresh = kink
        self.solved.append(new)
        if new.spot.x == self.end:
            return "end"
        if (new.spot.x - self.solved[0].spot.x) * self.sign < 0.0:
            return "the curve came back to the start of the range"
        return "" if len(self.solved) < MOST_POINTS else f"the limit of {MOST_POINTS} points was reached"

    def _switch(self, a: Solved, b: Solved) -> Mark:
        """The point between two at which two places on the rod lift off at once."""
        places = _main(a), _main(b)

        def at(x: float) -> Solved:
            part = (x - a.spot.x) / (b.spot.x - a.spot.x)
            value = a.spot.value + part * (b.spot.value - a.spot.value)
            guess, other = a.guess, b.guess
            if guess.coarse.size == other.coarse.size:
                guess = Guess(
                    guess.coarse + part * (other.coarse - guess.coarse),
                    guess.fine + part * (other.fine - guess.fine),
                    guess.near,
                )
            return self.zero.solve(a.solution.ladder, guess, Spot(x, value), self.zero.load)

        def lead(x: float) -> float:
            here = at(x).solution
            found, values, lowest = pressure_maxima(here.ladder.fine, here.point.fine)
            folded = np.minimum(found, 1.0 - found) if here.point.fine.symmetry != 0 else found
            tops = [
                max((v for s, v in zip(folded, values, strict=True) if abs(s - p) < NEAR), default=lowest)
                for p in places
            ]
            return float(tops[0] - tops[1])

        x = bracketed_root(lead, a.spot.x, b.spot.x, lead(a.spot.x), lead(b.spot.x))
        here = at(x)
        note = "the place that lifts off goes from s = {:.5g} to s = {:.5g}".format(*places)
        return Mark(SWITCH, float(x), 1e-8 * abs(float(x)) + here.error, here.spot.value, here.error, note)


BECOMES_STRAIGHT = "the buckled rod becomes straight"
STRAIGHT = 1e-3
"""Amplitude, in radians around the cylinder, below which a curve of buckled states ends."""

MOST_POINTS = 2000


def _straightens(a: Solved, b: Solved) -> bool:
    """Whether the rod becomes straight on the way: nearly so, or buckled to the other side."""
    small = np.max(np.abs(b.guess.fine)) < STRAIGHT * b.solution.problem.clearance
    return bool(small or (a.guess.fine.size == b.guess.fine.size and a.guess.fine @ b.guess.fine < 0.0))


def _main(solved: Solved) -> float:
    """First place that lifts off; of a symmetric state in the first half."""
    s = solved.places[0]
    return min(s, 1.0 - s) if solved.solution.point.fine.symmetry != 0 else s


def _jumped(a: Solved, b: Solved) -> bool:
    return abs(_main(a) - _main(b)) > NEAR
