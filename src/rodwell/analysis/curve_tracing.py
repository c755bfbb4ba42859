"""Tracing a curve in the plane of a load and another parameter, every point solved on both meshes.

A point of the curve is a zero of a function of equilibria on the line x = const, or load = const where the curve is
steep, found by the secant method in arclength along those equilibria; prediction is along the last two points. So the
curve may turn back in x, and pass places where the equilibria fold.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.curve_points import CurveLostError, Guess, Seed, Solved, Spot, Zero
from rodwell.analysis.curves import SWITCH, TURN, CurvePoint, Mark, Progress
from rodwell.analysis.measures import pressure_maxima
from rodwell.errors import InputError
from rodwell.numerics.location import bracketed_root

FIRST_STEP, LARGEST_STEP, SMALLEST_STEP = 0.004, 0.02, 1e-6
"""Steps, as parts of the range in x and of the load."""

STEEP = 0.3
"""Below this share of x in the direction of the curve, the load is prescribed instead."""

BENT = 0.2
"""A point farther from its prediction than this part of the step is sought again with half the step."""

NEAR = 0.03
"""Places on the rod closer than this count as the same place that moves."""


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
