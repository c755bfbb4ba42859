"""Tracing a curve in the plane of a load and another parameter, every point solved on both meshes.

A point of the curve is a zero of a function of equilibria (:mod:`rodwell.analysis.curves.points`). Steps are measured,
and predictions made, in the space of states, load and parameter: where two modes exchange their roles, a curve that is
smooth there has needles in the plane, turning about within 1e-5 of its range. Where it turns back in the parameter,
points are solved for on hyperplanes normal to it instead of at a given parameter.

A curve of lift-off follows one maximum of the contact pressure. Where another one reaches zero too, the curve has a
corner: the point is solved for, and the curve goes on with the other maximum, towards where the first one is pressed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.curves.checks import (
    BECOMES_STRAIGHT,
    bracket,
    carried,
    error_at_turn,
    leapt,
    on_meshes,
    straightens,
    vertex,
)
from rodwell.analysis.curves.contact import NEAR
from rodwell.analysis.curves.curve import SWITCH, TURN, CurvePoint, Mark, Progress
from rodwell.analysis.curves.points import (
    CurveStart,
    CurveTangent,
    NearbyStates,
    PlanePoint,
    SolvedPoint,
    Zero,
)
from rodwell.analysis.curves.secant import CurveLostError
from rodwell.errors import InputError
from rodwell.numerics.continuation.location import bracketed_root
from rodwell.numerics.equilibria.error import CLAIMED_GAIN

FIRST_STEP, LARGEST_STEP, SMALLEST_STEP = 0.004, 0.02, 1e-7
"""Steps, as parts of the range in x and of the load, with amplitudes by their weight."""

AMPLITUDE = 0.2
"""Weight of a change of shape in a step, per radian around the cylinder."""

ALONG = 0.5
"""Cosine between curve and equilibria at a fixed parameter above which the parameter is solved for."""

BENT = 0.2
"""A point farther from its prediction than this part of the step is sought again with half the step."""

GLANCE, NEAREST, FARTHEST = 0.02, 0.1, 30.0
"""Step, as part of the one that failed, with which the tangent is found anew, and how long it may turn out."""

UNIT = 0.01
"""Unit of the secant method in the parameter, as part of its range."""

BESIDE = (1e-5, 1e-6, 1e-7, 1e-8)
"""Where the first point beyond a corner is sought, as parts of the range."""

HARD_BY = 0.98
"""Where, on the way to a corner, it is looked whether the curve turned back before."""

MOST_VERTICES, STILL = 8, 1e-12
"""Parabolas that locate a place where the curve turns back, at most, and relative change of x that counts as none."""


def trace_curve(
    zero: Zero, seed: CurveStart, end: float, progress: Progress | None
) -> tuple[tuple[CurvePoint, ...], tuple[Mark, ...], str]:
    """Trace a curve from a state on it to x = ``end``: points, marks, and why it ended ("end": it got there)."""
    return _Tracer(zero, seed, end).run(progress or (lambda _part: None))


@dataclass(frozen=True)
class _Direction:
    """From one point of the curve to another, on the meshes of the latter, and how long it is."""

    travel: CurveTangent
    length: float

    def ahead(self, here: SolvedPoint, share: float) -> tuple[NearbyStates, PlanePoint]:
        """What lies ``share`` times as far ahead of a point, extrapolated."""
        guess, by = here.guess, self.travel
        spot = PlanePoint(here.spot.x + share * by.x, here.spot.value + share * by.value)
        return NearbyStates(guess.coarse + share * by.coarse, guess.fine + share * by.fine, guess.near), spot


class _Tracer:
    """A curve in the making."""

    def __init__(self, zero: Zero, seed: CurveStart, end: float) -> None:
        self.zero, self.end = zero, end
        self.range = abs(end - seed.x)
        self.sign = 1.0 if end > seed.x else -1.0
        fine = seed.solution.point.fine
        zero.touching.near = min(NEAR, NEAR * 10.0 * np.pi / fine.space.wavenumber(fine.c))
        first = zero.solve(seed.meshes, seed.guess, PlanePoint(seed.x, zero.value(seed.solution)))
        self.solved = [first]
        self.marks: list[Mark] = []
        self.way: _Direction | None = None  # not known yet
        self._attend(first)

    def run(self, tell: Progress) -> tuple[tuple[CurvePoint, ...], tuple[Mark, ...], str]:
        """Step until the end, or until steps become too short."""
        step, why = FIRST_STEP, ""
        while not why:
            try:
                why = self._accept(self._step(step), step)
                step = min(LARGEST_STEP, 1.5 * step)
            except CurveLostError as error:
                step *= 0.5
                if step < SMALLEST_STEP:
                    why = str(error)
            tell(min(1.0, abs(self.solved[-1].spot.x - self.solved[0].spot.x) / self.range))
        return tuple(s.as_point() for s in self.solved), tuple(self.marks), why

    def _attend(self, solved: SolvedPoint) -> None:
        """Let the maximum of the contact pressure that is followed be where it is at a point."""
        if self.zero.touch:
            self.zero.touching.place = self.zero.touching.moved(solved.solution)

    def _step(self, step: float) -> SolvedPoint:
        """Solve for the next point."""
        last = self.solved[-1]
        left = self.end - last.spot.x
        if self.way is None:
            x = last.spot.x + self.sign * min(step * self.range, abs(left))
            return self._solve(last, last.guess, PlanePoint(x, last.spot.value))
        share, dx = step / self.way.length, self.way.travel.x
        if dx * self.sign > 0.0 and abs(dx) * share >= abs(left):
            guess, spot = self.way.ahead(last, left / dx)
            new = self._solve(last, guess, PlanePoint(self.end, spot.value))
        else:
            guess, spot = self.way.ahead(last, share)
            new = self._solve(last, guess, spot, self.way.travel if self._along_equilibria(last) else None)
            if (new.spot.x - self.end) * self.sign > 0.0:
                return self._solve(last, new.guess, PlanePoint(self.end, new.spot.value))
        missed = self._length(on_meshes(guess, last, new), spot, new)
        if missed > BENT * self._way(last, new).length + 1e-9 and not straightens(last, new):
            self.way = self._tangent(last, GLANCE * step)
            raise CurveLostError("the curve bends too sharply")
        return new

    def _tangent(self, last: SolvedPoint, step: float) -> _Direction:
        """The way to a point very close ahead: nearer to the tangent than the way from the point before."""
        old = _known(self.way)
        new = self._solve(last, *old.ahead(last, step / old.length), old.travel)
        found = self._way(last, new)
        if not NEAREST * step < found.length < FARTHEST * step or last.guess.fine.size != new.guess.fine.size:
            return old
        return found

    def _solve(
        self, last: SolvedPoint, guess: NearbyStates, spot: PlanePoint, travel: CurveTangent | None = None
    ) -> SolvedPoint:
        try:
            return self.zero.solve(last.solution.meshes, guess, spot, travel)
        except InputError as error:
            raise CurveLostError(f"the curve leaves the range of {self.zero.over}") from error

    def _along_equilibria(self, last: SolvedPoint) -> bool:
        """Whether the curve runs along the equilibria at a fixed parameter, as it does where it turns back."""
        family, state = last.solution.levels[1]
        travel = _known(self.way).travel
        row, row_lam, _, _ = family.covector(travel.fine, travel.value)
        return bool(abs(float(row @ state.tangent) + row_lam * state.tangent_lam) > ALONG)

    def _way(self, a: SolvedPoint, b: SolvedPoint) -> _Direction:
        """The way from a point to another on the same or on finer meshes."""
        before = on_meshes(a.guess, a, b)
        coarse, fine = b.guess.coarse - before.coarse, b.guess.fine - before.fine
        dx, dv = b.spot.x - a.spot.x, b.spot.value - a.spot.value
        return _Direction(CurveTangent(coarse, fine, dv, dx, UNIT * self.range), self._length(before, a.spot, b))

    def _length(self, guess: NearbyStates, spot: PlanePoint, b: SolvedPoint) -> float:
        """Distance between a guess and a point on the same meshes, in the space of states, load and parameter."""
        shape = AMPLITUDE * b.solution.meshes.fine.distance(b.guess.fine - guess.fine, 0.0)
        load = (b.spot.value - spot.value) / max(abs(b.spot.value), 1.0)
        return float(np.linalg.norm([(b.spot.x - spot.x) / self.range, load, shape]))

    def _accept(self, new: SolvedPoint, step: float) -> str:
        """Add a point, with what is special between it and the last; returns why the curve ends there, or ""."""
        last = self.solved[-1]
        if straightens(last, new):
            if step > 10.0 * SMALLEST_STEP:
                raise CurveLostError(BECOMES_STRAIGHT)
            return BECOMES_STRAIGHT
        if step > 10.0 * SMALLEST_STEP and leapt(last, new):
            raise CurveLostError("another curve comes too close")
        if self.zero.touch and self.zero.touching.rival(new.solution)[0] > 0.0:
            self._turn_corner(last, new)
            return ""
        self._add(new)
        if new.spot.x == self.end:
            return "end"
        if (new.spot.x - self.solved[0].spot.x) * self.sign < 0.0:
            return "the curve came back to the start of the range"
        return "" if len(self.solved) < MOST_POINTS else f"the limit of {MOST_POINTS} points was reached"

    def _add(self, new: SolvedPoint) -> None:
        """Add a point of the same smooth piece of the curve, and the place where it turned back on the way."""
        last = self.solved[-1]
        way = self._way(last, new)
        if self.way is not None:
            before = self.solved[-2]
            if (last.spot.x - before.spot.x) * (new.spot.x - last.spot.x) < 0.0:
                self._mark_turn(before, last, new)
        if self.solved[-1] is not last:  # the place where it turned lies between
            way = self._way(self.solved[-1], new)
        self.way = way
        self.solved.append(new)
        self._attend(new)

    def _turn_corner(self, last: SolvedPoint, new: SolvedPoint) -> None:
        """Add the point between two at which another place lifts off too, and the first point beyond, on its curve."""
        touching, way = self.zero.touching, self._way(last, new)
        place = touching.place
        across = way.travel if self.way is not None and self._along_equilibria(last) else None

        def at(share: float) -> SolvedPoint:
            return self._solve(new, *way.ahead(new, share - 1.0), across)

        ends = touching.rival(last.solution)[0], touching.rival(new.solution)[0]
        if ends[0] >= 0.0:
            raise CurveLostError("two places lift off at once for more than one value of the parameter")
        where = bracketed_root(lambda share: touching.rival(at(share).solution)[0], 0.0, 1.0, *ends)
        corner, before = at(where), at(HARD_BY * where)
        highest, other = touching.rival(corner.solution)
        if other is None:
            raise CurveLostError("the place that lifts off jumps")
        gap = abs(highest - touching.rival(corner.solution, mesh=0)[0]) / CLAIMED_GAIN + abs(highest)
        part = gap / (ends[1] - ends[0])
        error, x_error = corner.error + part * abs(way.travel.value), corner.x_error + part * abs(way.travel.x)
        here = touching.moved(corner.solution)
        note = f"the place that lifts off goes from s = {here:.5g} to s = {other:.5g}"
        touching.place = other
        beyond = self._beyond(corner)
        touching.place = place
        if (before.spot.x - last.spot.x) * (corner.spot.x - before.spot.x) < 0.0:
            self._add(before)  # it has turned back on the way
        self._add(corner)
        self.marks.append(Mark(SWITCH, corner.spot.x, float(x_error), corner.spot.value, float(error), note))
        self.solved.append(beyond)
        self.way = self._way(corner, beyond)
        touching.place = other
        self._attend(beyond)

    def _beyond(self, corner: SolvedPoint) -> SolvedPoint:
        """The first point on the curve of another place, on the side where the place left behind is pressed."""
        for part in BESIDE:
            for side in (self.sign, -self.sign):
                try:
                    spot = PlanePoint(corner.spot.x + side * part * self.range, corner.spot.value)
                    found = self._solve(corner, corner.guess, spot)
                except CurveLostError:
                    continue
                if self.zero.touching.rival(found.solution)[0] < 0.0:
                    return found
        raise CurveLostError("beyond a corner the curve was lost")

    def _mark_turn(self, a: SolvedPoint, b: SolvedPoint, c: SolvedPoint) -> None:
        """Locate the place near the middle one of three points where x is largest or smallest; add it to the curve."""
        way = self._way(b, c)
        family = c.solution.meshes.fine
        row, row_lam, _, _ = family.covector(way.travel.fine, way.travel.value)

        def along(point: SolvedPoint) -> float:
            return float(row @ carried(point.guess.fine, point, c, 1)) + row_lam * point.spot.value

        start, whole = along(b), along(c) - along(b)
        three = around = [((along(point) - start) / whole, point) for point in (a, b, c)]
        change = np.inf
        for _ in range(MOST_VERTICES):
            share = vertex([(t, point.spot.x) for t, point in three])
            (low, _), (t, middle), (high, _) = three
            if share is None or not low < share < high or abs(share - t) < 1e-9:
                break
            found = self._solve(c, *way.ahead(c, share - 1.0), way.travel)
            change = abs(found.spot.x - middle.spot.x)
            three = bracket([*three, ((along(found) - start) / whole, found)])
            if change <= STILL * abs(found.spot.x):
                break
        t, turn = three[1]
        if turn is not b:
            self.solved.insert(len(self.solved) - (t < 0.0), turn)
        x_error = turn.x_error + (change if np.isfinite(change) else abs(way.travel.x))
        error, note = turn.error + error_at_turn(around, three, x_error), "the curve turns back"
        self.marks.append(Mark(TURN, turn.spot.x, float(x_error), turn.spot.value, float(error), note))


MOST_POINTS = 2000


def _known(way: _Direction | None) -> _Direction:
    assert way is not None
    return way
