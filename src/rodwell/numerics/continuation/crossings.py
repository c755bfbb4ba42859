"""Changes of the stability index between two points of a branch: each resolved, and located on both meshes."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from rodwell.numerics.continuation.location import (
    PLACE_TOLERANCE,
    LeftTheBranchError,
    LocatedZero,
    LocationError,
    Segment,
    bracketed_root,
    near_root,
)
from rodwell.quantities.arrays import FloatArray


@dataclass(frozen=True)
class Crossing:
    """A change of the stability index: where, from what to what, and whether it is a fold (λ turns back there).

    ``place`` is None where only one mesh shows it: the eigenvalue vanishes to round-off (the translation eigenvalue
    of a long rod is exponentially small), so its sign means nothing. ``doubt`` is by how much λ may be off, since
    round-off in the eigenvalue hides its zero.
    """

    place: LocatedZero | None
    t: float
    before: int
    after: int
    fold: bool
    doubt: float = 0.0


def index_crossings(
    coarse: Segment, fine: Segment, turns: Sequence[float] = (), end: float = 1.0, *, doubted: bool = False
) -> list[Crossing]:
    """All places up to ``end`` where the stability index changes, each stretch with a change resolved by bisection.

    The segment is cut on either side of each of ``turns``, places where λ turns back: an index that changes there and
    back again nearby is seen. A change by one that stands alone is then located as a zero of the eigenvalue that
    crosses, which is smooth and free of the round-off in pivots; several that cannot be told apart are reported as one.
    A change that nothing explains means that the step has left the branch, unless counts are to be ``doubted``.
    """
    cuts = [0.0, end]
    for turn in turns:
        cuts += [t for t in (turn - FOLD_OFFSET, turn + FOLD_OFFSET) if 0.0 < t < end]
    cuts.sort()
    brackets = []
    for low, high in pairwise(cuts):
        brackets += _bisect(fine, low, high, fine(low).index, fine(high).index)
    return [_located(coarse, fine, turns, bracket, doubted=doubted) for bracket in brackets]


ALONE = 0.1
"""Width of a bracket, as a part of the segment, in which a single change of the index is taken to stand alone."""

CLOSE = 2e-2
"""Width of a bracket, as a part of the segment, in which Newton's method may be kept off a direction."""

BESIDE = (0.06, 0.12, 0.18)
"""How far beyond such a bracket, either way, states tell how much of that direction there is inside."""


FOLD_OFFSET = 1e-3
"""How far from a turning point, as a part of the segment, the index is compared."""

DROWNED = 1e3
"""An eigenvalue below this many times its round-off tells nothing by its sign."""

NOISY = 2.0
"""How many times the round-off in an eigenvalue its located zero may miss: once found, once known."""

CUTS = (0.5, 0.37, 0.64)
"""Where an interval is cut, in the order in which they are tried: at one of them a singular point may lie."""


@dataclass(frozen=True)
class _Bracket:
    """Where a change of the index from ``before`` to ``after`` lies: one of no width is the place.

    ``softest`` is the eigenvalue nearest to zero at ``low``, if it was looked at.
    """

    low: float
    high: float
    before: int
    after: int
    softest: _Eigenvalue | None = None


def _bisect(segment: Segment, low: float, high: float, at_low: int, at_high: int) -> list[_Bracket]:
    """Brackets of the changes of the index in [low, high]."""
    if at_low == at_high:
        return []
    width = high - low
    if width < PLACE_TOLERANCE:
        middle = 0.5 * (low + high)
        return [_Bracket(middle, middle, at_low, at_high)]
    if abs(at_high - at_low) == 1 and width < ALONE:
        softest = _Eigenvalue(segment, low)
        if softest.value * softest.on(segment)(high) < 0.0:
            return [_Bracket(low, high, at_low, at_high, softest)]
    middle, here = _cut(segment, low, high)
    return _bisect(segment, low, middle, at_low, here) + _bisect(segment, middle, high, here, at_high)


def _cut(segment: Segment, low: float, high: float) -> tuple[float, int]:
    """A place inside an interval, near its middle, and the index there."""
    for part in CUTS:
        middle = low + part * (high - low)
        try:
            return middle, segment(middle).index
        except LocationError:
            if part == CUTS[-1]:
                raise
    raise AssertionError


def _located(coarse: Segment, fine: Segment, turns: Sequence[float], bracket: _Bracket, *, doubted: bool) -> Crossing:
    """The zero of the eigenvalue in a bracket, on both meshes."""
    low, high, before, after = bracket.low, bracket.high, bracket.before, bracket.after
    fold = any(low - FOLD_OFFSET <= turn <= high + FOLD_OFFSET for turn in turns) and high - low < 3.0 * FOLD_OFFSET
    vector = None if bracket.softest is None else bracket.softest.vector
    if not fold and not fine.family.may_branch(fine(low), fine(high), vector):
        if doubted or _drowned(fine, low, high):
            return Crossing(None, low, before, after, fold=False)
        raise LeftTheBranchError("the stability index changes where nothing may branch: the step has left the branch")
    if low == high:
        return Crossing(LocatedZero(low, coarse(low), fine(low)), low, before, after, fold=False)
    softest = bracket.softest or _Eigenvalue(fine, low)
    steady = not fold and _wanders(fine.family.parity, softest.vector)
    if steady:
        low, high = _shrunk(fine, low, high, before)
        softest = softest if low == bracket.low else _Eigenvalue(fine, low)
    parts = fine.narrowed(low, high).quick, coarse.narrowed(low, high).quick
    if steady:
        beside = _Eigenvalue(parts[1], 0.0)
        parts = _steadied(fine, parts[0], low, high, softest), _steadied(coarse, parts[1], low, high, beside)
    eigenvalue = softest.on(parts[0])
    ends = eigenvalue(0.0), eigenvalue(1.0)
    t = bracketed_root(eigenvalue, 0.0, 1.0, *ends, noise=eigenvalue.noise)
    try:
        rough = _Eigenvalue(parts[1], t)
        if steady:  # once more, off just the direction in which the Hessian is singular there
            eigenvalue, rough = eigenvalue.off_itself(), rough.off_itself()
            parts = eigenvalue.segment, rough.segment
            t = near_root(eigenvalue, t, after < before, farthest=1.0, noise=eigenvalue.noise)
        other = near_root(rough, t, after < before, farthest=ALONE / (high - low), noise=eigenvalue.noise)
    except LocationError:
        return Crossing(None, low, before, after, fold=False)
    place = LocatedZero(low + t * (high - low), parts[1].with_exact_tangent(other), parts[0].with_exact_tangent(t))
    rest = (
        fine.family.nearest_curvature(place.fine, eigenvalue.vector, 3)[0],
        coarse.family.nearest_curvature(place.coarse, rough.vector, 3)[0],
    )
    left = NOISY * max(eigenvalue.noise, *map(abs, rest))
    doubt = parts[0].doubt(place.fine, t, left / abs(ends[1] - ends[0]))
    if steady:  # what the farthest states change tells how far the others may be off
        nearer = replace(parts[0], through=parts[0].through[:2] + parts[0].through[3:5])
        again = near_root(eigenvalue.on(nearer), t, after < before, noise=eigenvalue.noise)
        doubt += CAUTION * abs(nearer(again).lam - place.fine.lam)
    return Crossing(place, place.t, before, after, fold, doubt)


def _drowned(fine: Segment, low: float, high: float) -> bool:
    """Whether the eigenvalue that changes its sign between two places is round-off."""
    ends = (_Eigenvalue(fine, place) for place in (low, high))
    return any(abs(end(place)) <= DROWNED * end.noise for end, place in zip(ends, (low, high), strict=True))


def _wanders(parity: int, vector: FloatArray) -> bool:
    """Whether Newton's method moves along the direction in which the Hessian becomes singular: symmetry may forbid it.

    States that are periodic beyond their ends branch into others of the same parity.
    """
    kept = vector + parity * vector[::-1]
    return parity == 0 or bool(np.linalg.norm(kept) > np.linalg.norm(vector))


def _shrunk(segment: Segment, low: float, high: float, before: int) -> tuple[float, float]:
    """Halve a bracket of one change of the index until the cubic between its ends is as good as the solution."""
    while high - low > CLOSE:
        middle, index = _cut(segment, low, high)
        low, high = (middle, high) if index == before else (low, middle)
    return low, high


CAUTION = 8.0
"""How many times what two states more change is counted: round-off in the others does not show in that."""


def _steadied(whole: Segment, part: Segment, low: float, high: float, softest: _Eigenvalue) -> Segment:
    """A part of a segment with Newton's method kept off the direction in which the Hessian becomes singular.

    What there is of it comes from states on both sides, where the Hessian is far from singular.
    """
    states = [whole(t) for t in (*(low - beside for beside in BESIDE), *(high + beside for beside in BESIDE))]
    return replace(part, frozen=softest.vector, through=tuple(states))


class _Eigenvalue:
    """The eigenvalue nearest to zero as a function of the place, followed by its vector from ``near``.

    ``value`` and ``noise`` are what it is there, and what round-off leaves in it.
    """

    def __init__(self, segment: Segment, near: float) -> None:
        self.segment = segment
        state = segment(near)
        self.vector = np.random.default_rng(0).standard_normal(state.c.size)
        self.value, self.noise = segment.family.nearest_curvature(state, self.vector, 8)

    def on(self, segment: Segment) -> _Eigenvalue:
        """Return the same on another segment through the same place."""
        other = copy(self)
        other.segment, other.vector = segment, self.vector.copy()
        return other

    def off_itself(self) -> _Eigenvalue:
        """Return the same with Newton's method kept off its vector."""
        return self.on(replace(self.segment, frozen=self.vector.copy()))

    def __call__(self, t: float) -> float:
        return self.segment.family.nearest_curvature(self.segment(t), self.vector, 3)[0]
