"""How far a rod is off a hard wall, or pressed into a soft one, and which pieces of it are in contact."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.carry import fields_at
from rodwell.numerics.stretches.chain import Chain, Shape
from rodwell.numerics.stretches.minima import lowest
from rodwell.quantities.arrays import FloatArray, IntArray

PER_ELEMENT = 12
"""Places in an element at which depth and gap are looked at first."""

NOISE, DEPTH_NOISE = 1e-10, 1e-12
"""A gap, over the polynomial with which it opens, is not known better than the first: it is round-off over that. Nor is
the gap itself known better than the second, in Δ: gaps at kinks of the stiffness are hardly higher."""

EDGE, SHORTEST_EDGE, WIDEST = 0.02, 5e-4, 0.1
"""Part of a free stretch at either end where the gap is left to the conditions on forces and curvature; at least so
much of L, since the gap there is of the size of round-off, but no more than the last part of the stretch."""


CLOSE = 1e-14
"""How closely ends of pieces are located, in L."""

SHALLOW = 1e-9
"""Distance from the wall in Δ, in the middle of a piece, that counts as none: events are located no better."""


class Piece(NamedTuple):
    """A piece of the rod, in contact or not, from where to where."""

    on: bool
    left: float
    right: float

    def overlaps(self, other: Piece) -> bool:
        """Whether they have a place in common."""
        return self.left < other.right and other.left < self.right


def depth(shape: Shape, s: FloatArray) -> FloatArray:
    """How far beyond the wall the rod is at places (k,), in Δ; negative: a gap."""
    x, y = fields_at(shape, s)[0][:, 0]
    return np.asarray(np.hypot(x, y) - 1.0)


def _shallow(shape: Shape, left: float, right: float) -> bool:
    """Whether the rod is as good as at the wall between two places at which it is just there."""
    return right - left <= CLOSE or abs(float(depth(shape, np.array([0.5 * (left + right)]))[0])) <= SHALLOW


def contact_pieces(shape: Shape) -> list[Piece]:
    """Contact and gaps in turn, from s = 0."""
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    s = np.concatenate([np.linspace(a, b, PER_ELEMENT, endpoint=False) for a, b in pairwise(shape.places)] + [[1.0]])
    on = depth(shape, s[1:-1]) > 0.0  # ends are held right at the wall
    inner = s[1:-1]
    bounds = [0.0]
    for i in np.flatnonzero(on[1:] != on[:-1]):
        end = float(brentq(lambda t: float(depth(shape, np.array([t]))[0]), inner[i], inner[i + 1], xtol=CLOSE))
        if len(bounds) > 1 and _shallow(shape, bounds[-1], end):
            bounds.pop()  # right where a piece appears it is none
        else:
            bounds.append(end)
    bounds.append(1.0)
    return [Piece(bool(on[0]) ^ bool(i % 2), *ends) for i, ends in enumerate(pairwise(bounds))]


def least_gaps(
    shape: Shape, pattern: Pattern, stretches: Sequence[int], elements: Sequence[IntArray]
) -> list[tuple[float, float]]:
    """The least gap within each of some free stretches, over the polynomial with which it opens, and where.

    Positive everywhere if and only if the gap is; unlike the gap itself it does not vanish at the ends. An edge that
    the rod touches parts a stretch. ``elements`` are those of each; they are looked at together, which takes little
    longer than for one.
    """
    if not stretches:
        return []
    parts, bounds = _parts(pattern, shape.chain), np.concatenate([[0.0], shape.breaks, [1.0]])
    among = np.isin(parts.stretch, stretches)
    stretch, edges, powers = parts.stretch[among], parts.edges[among], parts.powers[among]
    own_ends = np.stack([bounds[stretch], bounds[stretch + 1]], axis=1)
    left, right = np.where(np.isnan(edges), own_ends, edges).T
    inset = np.maximum(EDGE * (right - left), np.minimum(WIDEST * (right - left), SHORTEST_EDGE))
    low, high = left + inset * (powers[:, 0] > 0), right - inset * (powers[:, 1] > 0)
    every = np.concatenate(elements)
    start, end = shape.places[every], shape.places[every + 1]
    own = np.searchsorted(right, 0.5 * (start + end))
    seen = (start < high[own]) & (end > low[own])
    every, own, start, end = every[seen], own[seen], start[seen], end[seen]
    length, radii = end - start, shape.chain.radii[every, None]
    opening, closing = powers[own].T[:, :, None]

    def opens(xi: FloatArray) -> FloatArray:
        at = (start[:, None] + length[:, None] * xi - left[own, None]) / (right - left)[own, None]
        return np.asarray(at**opening * (1.0 - at) ** closing)

    def gap(xi: FloatArray) -> FloatArray:
        x, y = shape.along(every, xi, 1)[:, 0]
        return np.asarray((radii - np.hypot(x, y)) / opens(xi))

    inside = (np.maximum(low[own], start) - start) / length, (np.minimum(high[own], end) - start) / length
    values, xi = lowest(gap, np.linspace(*inside, PER_ELEMENT + 1, axis=1))
    values[np.abs(values) < np.maximum(NOISE, DEPTH_NOISE / opens(xi[:, None])[:, 0])] = 0.0
    first, last = (np.searchsorted(stretch[own], stretches, side) for side in ("left", "right"))
    least = [int(a + np.argmin(values[a:b])) for a, b in zip(first, last, strict=True)]
    return [(float(values[k]), float(start[k] + length[k] * xi[k])) for k in least]


class _Parts(NamedTuple):
    """Parts of free stretches between edges that the rod touches, from s = 0.

    Their ``stretch`` (k,); at either end, (k, 2), the place of the edge, NaN at an end of the stretch, and the power of
    the distance with which the gap opens there.
    """

    stretch: IntArray
    edges: FloatArray
    powers: IntArray


@lru_cache(maxsize=16)
def _parts(pattern: Pattern, chain: Chain) -> _Parts:
    """The parts of all free stretches of a pattern on its chain."""
    inner = chain.edges[(chain.edges > 0) & (chain.edges < chain.elements)]
    owner, places = np.searchsorted(chain.moving, inner), chain.base[inner]
    below, above = chain.radii[inner - 1], chain.radii[inner]  # in the wider part the rod is a step away from the wall
    rows: list[tuple[int, tuple[float, float], tuple[int, int]]] = []
    for stretch in (i for i, on in enumerate(pattern.touching) if not on):
        left, opening = np.nan, _power(pattern, chain, stretch, last=False)
        for k in np.flatnonzero(owner == stretch):
            rows.append((stretch, (left, float(places[k])), (opening, int(below[k] < above[k]))))
            left, opening = float(places[k]), int(above[k] < below[k])
        rows.append((stretch, (left, np.nan), (opening, _power(pattern, chain, stretch, last=True))))
    return _Parts(*(np.array(column) for column in zip(*rows, strict=True)))


def _power(pattern: Pattern, chain: Chain, stretch: int, *, last: bool) -> int:
    """Like which power of the distance the gap opens at an end of a free stretch."""
    neighbour = stretch + (1 if last else -1)
    if 0 <= neighbour < len(pattern.touching):
        return 3 if pattern.touching[neighbour] else 2
    held = chain.held[-1 if last else 0]
    return 2 if held[0] and held[2] else (1 if held[0] else 0)
