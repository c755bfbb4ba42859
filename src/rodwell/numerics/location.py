"""Locating zeros between two points of a branch, on both meshes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rodwell.numerics.families import Family, State

PLACE_TOLERANCE = 1e-12
"""Width, as a part of the span, to which a zero is bracketed."""


class LocationError(RuntimeError):
    """A zero known to lie between two points could not be located; a shorter step is needed."""


@dataclass(frozen=True)
class Span:
    """The stretch of a branch between two states of one family, in t from 0 to 1 along the first's tangent."""

    family: Family
    first: State
    last: State

    def __call__(self, t: float) -> State:
        """Return the equilibrium at ``t``: Newton from the cubic Hermite interpolant."""
        a, b = self.first, self.last
        length = a.along(b)
        rate = float(a.row @ b.tangent + a.row_lam * b.tangent_lam)
        if t == 0.0:
            return a
        if t == 1.0:
            return b
        h0, h1 = (1.0 + 2.0 * t) * (1.0 - t) ** 2, t * t * (3.0 - 2.0 * t)
        s0, s1 = length * t * (1.0 - t) ** 2, length / rate * t * t * (t - 1.0)
        c = h0 * a.c + h1 * b.c + s0 * a.tangent + s1 * b.tangent
        lam = h0 * a.lam + h1 * b.lam + s0 * a.tangent_lam + s1 * b.tangent_lam
        target = float(a.row @ a.c) + a.row_lam * a.lam + t * length
        outcome, state, _ = self.family.correct(c, lam, a.row, a.row_lam, target)
        if state is None:
            raise LocationError(f"no equilibrium found while locating an event: {outcome.value}")
        return state

    def at_lam(self, lam: float) -> State:
        """Return the equilibrium at a λ that lies between those of the ends."""
        ends = self.first.lam - lam, self.last.lam - lam
        return self(bracketed_root(lambda t: self(t).lam - lam, 0.0, 1.0, *ends))


def bracketed_root(function: Callable[[float], float], low: float, high: float, f_low: float, f_high: float) -> float:
    """Zero of a continuous function between two places of opposite sign, by Chandrupatla's method.

    T. R. Chandrupatla, *Adv. Eng. Software* 28 (1997) 145–149: bisection and inverse quadratic
    interpolation, whichever is safe.
    """
    a, b, c = high, low, high
    fa, fb, fc = f_high, f_low, f_high
    t = 0.5
    for _ in range(200):
        x = a + t * (b - a)
        fx = function(x)
        if (fx < 0.0) == (fa < 0.0):
            c, fc = a, fa
        else:
            c, b, fc, fb = b, a, fb, fa
        a, fa = x, fx
        best, f_best = (a, fa) if abs(fa) < abs(fb) else (b, fb)
        share = PLACE_TOLERANCE / max(abs(b - a), PLACE_TOLERANCE)
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
class Place:
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


def locate(coarse: Span, fine: Span, function: Callable[[Span, State], float], ends: tuple[float, float]) -> Place:
    """Zero of a function of a state on both meshes; ``ends`` are its values at the ends of the fine span."""
    place = bracketed_root(lambda t: function(fine, fine(t)), 0.0, 1.0, *ends)
    other = _near(lambda t: function(coarse, coarse(t)), place, ends[1] > ends[0])
    return Place(place, coarse(other), fine(place))


def _near(function: Callable[[float], float], place: float, rising: bool) -> float:
    """Zero of ``function`` close to ``place``, where a function that differs little from it has one."""
    middle = function(place)
    if middle == 0.0:
        return place
    width = 1e-6
    direction = -1.0 if (middle > 0.0) == rising else 1.0
    near, f_near = place, middle
    while width < 1.0:
        far = place + direction * width
        f_far = function(far)
        if (f_far < 0.0) != (middle < 0.0):
            return bracketed_root(function, near, far, f_near, f_far)
        near, f_near, width = far, f_far, 4.0 * width
    raise LocationError("an event was found on the finer mesh only")


@dataclass(frozen=True)
class Crossing:
    """A change of the stability index: where, from what to what, and whether it is a fold (λ turns back there).

    ``place`` is None where only one mesh shows it: the eigenvalue vanishes to round-off (the translation eigenvalue
    of a long rod is exponentially small), so its sign means nothing.
    """

    place: Place | None
    t: float
    before: int
    after: int
    fold: bool


def index_crossings(coarse: Span, fine: Span) -> list[Crossing]:
    """All places where the stability index changes, each stretch whose ends differ in it resolved by bisection.

    A change by one that stands alone is then located as a zero of the eigenvalue that crosses, which is
    smooth and free of the round-off in pivots; several that cannot be told apart are reported as one.
    """
    out = []
    for low, high, before, after in _bisect(fine, 0.0, 1.0, fine.first.index, fine.last.index):
        t = _crossing(fine, low, high)
        try:
            other = _near(_Crossing(coarse, t), t, rising=after < before) if high > low else t
        except LocationError:
            out.append(Crossing(None, t, before, after, fold=False))
            continue
        fold = fine(t - FOLD_OFFSET).tangent_lam * fine(t + FOLD_OFFSET).tangent_lam < 0.0
        out.append(Crossing(Place(t, coarse(other), fine(t)), t, before, after, fold))
    return out


ALONE = 1e-2
"""Width of a bracket, as a part of the span, in which a single change of the index is taken to stand alone."""

FOLD_OFFSET = 1e-5
"""How far from a crossing, as a part of the span, the sense of travel is compared."""


def _bisect(span: Span, low: float, high: float, at_low: int, at_high: int) -> list[tuple[float, float, int, int]]:
    """Brackets of the changes of the index in [low, high]: (low, high, before, after)."""
    if at_low == at_high:
        return []
    width = high - low
    if width < PLACE_TOLERANCE:
        middle = 0.5 * (low + high)
        return [(middle, middle, at_low, at_high)]
    if abs(at_high - at_low) == 1 and width < ALONE and _Crossing(span, low)(low) * _Crossing(span, high)(high) < 0.0:
        return [(low, high, at_low, at_high)]
    middle = 0.5 * (low + high)
    here = span(middle).index
    return _bisect(span, low, middle, at_low, here) + _bisect(span, middle, high, here, at_high)


class _Crossing:
    """The eigenvalue nearest to zero as a function of the place, followed by its vector from ``near``."""

    def __init__(self, span: Span, near: float) -> None:
        self.span = span
        state = span(near)
        self.vector = np.random.default_rng(0).standard_normal(state.c.size)
        span.family.nearest_curvature(state, self.vector, 8)

    def __call__(self, t: float) -> float:
        return self.span.family.nearest_curvature(self.span(t), self.vector, 3)


def _crossing(span: Span, low: float, high: float) -> float:
    """Place of a single change of the index in a bracket; a bracket of no width is the place."""
    if low == high:
        return low
    eigenvalue = _Crossing(span, low)
    return bracketed_root(eigenvalue, low, high, eigenvalue(low), eigenvalue(high))
