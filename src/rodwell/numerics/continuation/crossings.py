"""Changes of the stability index between two points of a branch: each resolved, and located on both meshes."""

from __future__ import annotations

from collections.abc import Sequence
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
    return [_located(coarse, fine, turns, *bracket, doubted=doubted) for bracket in brackets]


ALONE = 0.1
"""Width of a bracket, as a part of the segment, in which a single change of the index is taken to stand alone."""

CLOSE = 3e-3
"""Width of a bracket in which Newton's method may be kept off a direction: the error left goes with its 4th power."""

FOLD_OFFSET = 1e-3
"""How far from a turning point, as a part of the segment, the index is compared."""

DROWNED = 1e3
"""An eigenvalue below this many times its round-off tells nothing by its sign."""

NOISY = 2.0
"""How many times the round-off in an eigenvalue its located zero may miss: once found, once known."""

CUTS = (0.5, 0.37, 0.64)
"""Where an interval is cut, in the order in which they are tried: at one of them a singular point may lie."""


def _bisect(
    segment: Segment, low: float, high: float, at_low: int, at_high: int
) -> list[tuple[float, float, int, int]]:
    """Brackets of the changes of the index in [low, high]: (low, high, before, after)."""
    if at_low == at_high:
        return []
    width = high - low
    if width < PLACE_TOLERANCE:
        middle = 0.5 * (low + high)
        return [(middle, middle, at_low, at_high)]
    if abs(at_high - at_low) == 1 and width < ALONE and _changes_sign(segment, low, high):
        return [(low, high, at_low, at_high)]
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


def _changes_sign(segment: Segment, low: float, high: float) -> bool:
    eigenvalue = _Eigenvalue(segment, low)
    return eigenvalue(low) * eigenvalue(high) < 0.0


def _located(
    coarse: Segment,
    fine: Segment,
    turns: Sequence[float],
    low: float,
    high: float,
    before: int,
    after: int,
    *,
    doubted: bool,
) -> Crossing:
    """The zero of the eigenvalue in a bracket, on both meshes; a bracket of no width is the place."""
    fold = any(low - FOLD_OFFSET <= turn <= high + FOLD_OFFSET for turn in turns) and high - low < 3.0 * FOLD_OFFSET
    if not fold and not fine.family.may_branch(fine(low), fine(high)):
        if doubted or _drowned(fine, low, high):
            return Crossing(None, low, before, after, fold=False)
        raise LeftTheBranchError("the stability index changes where nothing may branch: the step has left the branch")
    if low == high:
        return Crossing(LocatedZero(low, coarse(low), fine(low)), low, before, after, fold=False)
    steady = not fold and _wanders(fine, low)
    if steady:
        low, high = _shrunk(fine, low, high, before)
    parts = fine.narrowed(low, high).quick, coarse.narrowed(low, high).quick
    if steady:
        parts = tuple(_steadied(part) for part in parts)  # type: ignore[assignment]
    eigenvalue = _Eigenvalue(parts[0], 0.0)
    ends = eigenvalue(0.0), eigenvalue(1.0)
    t = bracketed_root(eigenvalue, 0.0, 1.0, *ends, noise=eigenvalue.noise)
    try:
        rough = _Eigenvalue(parts[1], t)
        other = near_root(rough, t, after < before, farthest=ALONE / (high - low), noise=eigenvalue.noise)
    except LocationError:
        return Crossing(None, low, before, after, fold=False)
    place = LocatedZero(low + t * (high - low), parts[1].with_exact_tangent(other), parts[0].with_exact_tangent(t))
    levels = (fine.family, place.fine), (coarse.family, place.coarse)
    rest = [family.nearest_curvature(state, vector, 3)[0] for (family, state), vector in zip(levels, (eigenvalue.vector, rough.vector), strict=True)]
    left = NOISY * max(eigenvalue.noise, *map(abs, rest))
    doubt = parts[0].doubt(place.fine, t, left / abs(ends[1] - ends[0]))
    return Crossing(place, place.t, before, after, fold, doubt)


def _drowned(fine: Segment, low: float, high: float) -> bool:
    """Whether the eigenvalue that changes its sign between two places is round-off."""
    for place in (low, high):
        eigenvalue = _Eigenvalue(fine, place)
        if abs(eigenvalue(place)) <= DROWNED * eigenvalue.noise:
            return True
    return False


def _wanders(segment: Segment, place: float) -> bool:
    """Whether Newton's method moves along the direction in which the Hessian becomes singular: symmetry may forbid it.

    States that are periodic beyond their ends branch into others of the same parity.
    """
    parity = segment.family.parity
    vector = _Eigenvalue(segment, place).vector
    kept = vector + parity * vector[::-1]
    return parity == 0 or bool(np.linalg.norm(kept) > np.linalg.norm(vector))


def _shrunk(segment: Segment, low: float, high: float, before: int) -> tuple[float, float]:
    """Halve a bracket of one change of the index until the cubic between its ends is as good as the solution."""
    while high - low > CLOSE:
        middle, index = _cut(segment, low, high)
        low, high = (middle, high) if index == before else (low, middle)
    return low, high


def _steadied(segment: Segment) -> Segment:
    """The segment with Newton's method kept off the direction in which the Hessian becomes singular."""
    eigenvalue = _Eigenvalue(segment, 0.0)
    return replace(segment, frozen=eigenvalue.vector)


class _Eigenvalue:
    """The eigenvalue nearest to zero as a function of the place, followed by its vector from ``near``."""

    def __init__(self, segment: Segment, near: float) -> None:
        self.segment = segment
        state = segment(near)
        self.vector = np.random.default_rng(0).standard_normal(state.c.size)
        _, self.noise = segment.family.nearest_curvature(state, self.vector, 8)

    def __call__(self, t: float) -> float:
        return self.segment.family.nearest_curvature(self.segment(t), self.vector, 3)[0]
