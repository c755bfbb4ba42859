"""Locating zeros between two points of a branch, on both meshes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.quantities.arrays import FloatArray

PLACE_TOLERANCE = 1e-12
"""Width, as a part of the segment, to which a zero is bracketed."""

INSIDE = 0.02
"""The first place looked at lies at least this part of the bracket from its ends."""

BESIDE = 0.01
"""How far, as a part of the segment, a solution at given λ may lie from where it was expected."""


class LocationError(RuntimeError):
    """A zero known to lie between two points could not be located; a shorter step is needed."""


class LeftTheBranchError(LocationError):
    """The two ends of a step are not on one branch.

    The sign of det H, which the index tells, and the sense of travel in λ change together along a branch of regular
    points, since the bordered determinant keeps its sign: the index changes by one where λ turns back, and only there.
    What may branch, or meet its mirror image, does so by a symmetry. See H. B. Keller, *Lectures on Numerical Methods
    in Bifurcation Problems* (1987), chapter 5.
    """

    STEP = "the step has left the branch: the stability index and the sense in λ do not go together"
    FIRST_STEP = "the first step has left the branch: its stability index is not that of a branch that crosses there"


@dataclass(frozen=True)
class Segment:
    """The stretch of a branch between two states of one family, in t from 0 to 1 along the first's tangent.

    States are sought from the cubic through both, or from the polynomial ``through`` others that lie around them.
    """

    family: Family
    first: State
    last: State
    frozen: FloatArray | None = None
    through: tuple[State, ...] = ()

    def __call__(self, t: float) -> State:
        """Return the equilibrium at ``t``: Newton from the cubic Hermite interpolant.

        Along ``frozen`` (n,), if given, the interpolant is kept: there Newton's method would wander, next to a point
        where the Hessian is singular and the branch does not turn back.
        """
        a, b = self.first, self.last
        if t == 0.0:
            return a
        if t == 1.0:
            return b
        if t not in self._known:
            target = float(a.row @ a.c) + a.row_lam * a.lam + t * self._length
            outcome, state, _ = self.family.correct(*self._interpolant(t), a.row, a.row_lam, target, self.frozen)
            if state is None:
                raise LocationError(f"no equilibrium found while locating an event: {self.family.advice(outcome)}")
            self._known[t] = state
        return self._known[t]

    @cached_property
    def _known(self) -> dict[float, State]:
        """States that were solved, by their places."""
        return {}

    @cached_property
    def _length(self) -> float:
        return self.first.along(self.last)

    @cached_property
    def _rate(self) -> float:
        """Growth of the distance along the first tangent, at the last point."""
        return float(self.first.row @ self.last.tangent) + self.first.row_lam * self.last.tangent_lam

    def doubt(self, state: State, t: float, shift: float) -> float:
        """How far λ may be off, if the place of a state at ``t`` is off by ``shift``; λ may turn back there."""
        a = self.first
        rate = state.tangent_lam * self._length / (float(a.row @ state.tangent) + a.row_lam * state.tangent_lam)
        bent = abs(a.lam - state.lam) / max(t, 0.5) ** 2 + abs(self.last.lam - state.lam) / max(1.0 - t, 0.5) ** 2
        return float(abs(rate) * shift + bent * shift * shift)

    def _shares(self, t: float) -> tuple[float, float, float, float]:
        """Hermite's cubics at ``t``: shares of the values at both ends and of the tangents there."""
        slopes = self._length * t * (1.0 - t) ** 2, self._length / self._rate * t * t * (t - 1.0)
        return (1.0 + 2.0 * t) * (1.0 - t) ** 2, t * t * (3.0 - 2.0 * t), *slopes

    def _interpolant(self, t: float) -> tuple[FloatArray, float]:
        """Coefficients and λ of the interpolant: Hermite's cubic, or through more states."""
        a, b = self.first, self.last
        if self.through:
            shares = [
                math.prod((t - there) / (here - there) for j, there in enumerate(self._places) if j != i)
                for i, here in enumerate(self._places)
            ]
            known = list(zip(shares, self.through, strict=True))
            return np.asarray(sum(share * x.c for share, x in known)), sum(share * x.lam for share, x in known)
        h0, h1, s0, s1 = self._shares(t)
        return h0 * a.c + h1 * b.c + s0 * a.tangent + s1 * b.tangent, self._lam(t)

    @cached_property
    def _places(self) -> list[float]:
        """Where the states lie that the interpolant goes through."""
        return [self.first.along(state) / self._length for state in self.through]

    def _lam(self, t: float) -> float:
        a, b = self.first, self.last
        h0, h1, s0, s1 = self._shares(t)
        return h0 * a.lam + h1 * b.lam + s0 * a.tangent_lam + s1 * b.tangent_lam

    def with_exact_tangent(self, t: float) -> State:
        """Return the equilibrium at ``t`` with its tangent and index taken at the solution itself."""
        return replace(self, family=self.family.with_exact_tangent())(t)

    @property
    def quick(self) -> Segment:
        """The same segment without the step that makes tangents and index sharp."""
        return replace(self, family=self.family.quick)

    def narrowed(self, low: float, high: float) -> Segment:
        """Return the stretch between two places of this one."""
        return Segment(self.family, self(low), self(high))

    def at_lam(self, lam: float) -> State:
        """Return the equilibrium at a λ that lies between those of the ends."""
        found = self.exactly(lam)
        if found is not None:
            return found[1]
        ends = self.first.lam - lam, self.last.lam - lam
        return self(bracketed_root(lambda t: self(t).lam - lam, 0.0, 1.0, *ends))

    def exactly(self, lam: float) -> tuple[float, State] | None:
        """Return where λ has a value, and the equilibrium at just that value; None where λ turns back, or far away."""
        a, b = self.first, self.last
        if a.tangent_lam * b.tangent_lam <= 0.0:
            return None
        ends = a.lam - lam, b.lam - lam
        if (ends[0] < 0.0) == (ends[1] < 0.0):  # just beyond an end, since the other mesh has its own λ there
            t = 0.0 if abs(ends[0]) < abs(ends[1]) else 1.0
        else:
            t = bracketed_root(lambda t: self._lam(t) - lam, 0.0, 1.0, *ends)
        state = self.family.at(self._interpolant(t)[0], lam)[1]
        if state is None or abs(a.along(state) - t * self._length) > BESIDE * abs(self._length):
            return None
        return t, state if a.tangent_lam > 0.0 else state.reversed()


def bracketed_root(
    function: Callable[[float], float],
    low: float,
    high: float,
    f_low: float,
    f_high: float,
    tolerance: float = PLACE_TOLERANCE,
    noise: float = 0.0,
) -> float:
    """Zero of a continuous function between two places of opposite sign, by Chandrupatla's method.

    T. R. Chandrupatla, *Adv. Eng. Software* 28 (1997) 145–149: bisection and inverse quadratic interpolation, whichever
    is safe; here it begins with the secant. It ends when the bracket is as small as ``tolerance``, or the function as
    ``noise``.
    """
    a, b, c = high, low, high
    fa, fb, fc = f_high, f_low, f_high
    t = min(max(fa / (fa - fb), INSIDE), 1.0 - INSIDE)
    for _ in range(200):
        x = a + t * (b - a)
        fx = function(x)
        if abs(fx) <= noise:
            return x
        if (fx < 0.0) == (fa < 0.0):
            c, fc = a, fa
        else:
            c, b, fc, fb = b, a, fb, fa
        a, fa = x, fx
        best, f_best = (a, fa) if abs(fa) < abs(fb) else (b, fb)
        share = tolerance / max(abs(b - a), tolerance)
        if share >= 0.5 or f_best == 0.0:
            return best
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        if phi**2 < xi and (1.0 - phi) ** 2 < 1.0 - xi:
            t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        else:
            t = 0.5
        t = min(max(t, share), 1.0 - share)
    return best


@dataclass(frozen=True)
class LocatedZero:
    """A zero found on both meshes: t on the fine one, and the states at the zero of each mesh.

    The two states differ by what the zero's place is uncertain too, so what is measured of them has errors that
    include it.
    """

    t: float
    coarse: State
    fine: State

    @property
    def gap(self) -> float:
        """How far apart in λ the zeros of the two meshes are."""
        return abs(self.coarse.lam - self.fine.lam)


def locate(
    coarse: Segment,
    fine: Segment,
    function: Callable[[Segment, State], float],
    ends: tuple[float, float],
    tolerance: float = PLACE_TOLERANCE,
) -> LocatedZero:
    """Zero of a function of a state on both meshes; ``ends`` are its values at the ends of the fine segment."""
    quick = coarse.quick, fine.quick
    near = (function(quick[0], coarse.first), function(quick[0], coarse.last))
    if (near[0] < 0.0) == (near[1] < 0.0):  # not seen on the coarse mesh: begin with the fine one
        place = bracketed_root(lambda t: function(quick[1], quick[1](t)), 0.0, 1.0, *ends, tolerance)
        other = near_root(lambda t: function(quick[0], quick[0](t)), place, ends[1] > ends[0], tolerance=tolerance)
    else:
        other = bracketed_root(lambda t: function(quick[0], quick[0](t)), 0.0, 1.0, *near, tolerance)
        place = near_root(lambda t: function(quick[1], quick[1](t)), other, ends[1] > ends[0], tolerance=tolerance)
    return LocatedZero(place, coarse(other), fine(place))


def near_root(
    function: Callable[[float], float],
    place: float,
    rising: bool,
    farthest: float = 1.0,
    tolerance: float = PLACE_TOLERANCE,
    noise: float = 0.0,
) -> float:
    """Zero of ``function`` within ``farthest`` of ``place``, where a function that differs little from it has one."""
    middle = function(place)
    if abs(middle) <= noise:
        return place
    width = max(1e-6, tolerance)
    direction = -1.0 if (middle > 0.0) == rising else 1.0
    near, f_near = place, middle
    while width < farthest:
        far = place + direction * width
        f_far = function(far)
        if (f_far < 0.0) != (middle < 0.0):
            return bracketed_root(function, near, far, f_near, f_far, tolerance, noise)
        near, f_near, width = far, f_far, 4.0 * width
    raise LocationError("an event was found on the finer mesh only")
