"""The rod that lies along a curved hole: which places of the axis it is beside, and how high it rises."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from rodwell.problem.hole import Hole
from rodwell.problem.profile import Profile
from rodwell.quantities.arrays import FloatArray

GRID = 2571
"""Places on the axis between which its curvature is integrated, with eight points each."""

SQUARED = 1e-9
"""Step of Newton's method after which the error is below round-off."""

MARGIN = 0.05
"""How far beyond S = 0 and S = 1 these reach: a rod on the inside of a bend is beside more than its length."""


def places_of_lying_rod(hole: Hole, reach: float, s: FloatArray) -> FloatArray:
    """Places S₀ (m,) on the axis beside ``s`` (m,) of a rod on the generator towards −N1, S₀(½) = ½.

    The rod is ``reach`` from the axis, negative towards N1; dS₀/ds = 1/(1 + reach k1).
    """
    if not hole.axis:
        return np.asarray(0.5 + (s - 0.5) / (1.0 + reach * hole.curvatures(np.array([0.5]))[0, 0]))
    grid, along = _lengths(hole, reach)
    found = np.interp(s, along, grid)
    for _ in range(3):  # Newton's method, which squares the error
        step = (lying_rod_beside(hole, reach, found) - s) / _stretch(hole, reach, found)
        found = found - step
        if np.max(np.abs(step), initial=0.0) <= SQUARED:
            break
    return np.asarray(found)


def lying_rod_beside(hole: Hole, reach: float, places: FloatArray) -> FloatArray:
    """Arclength s (m,) of that rod beside ``places`` S₀ (m,) of an axis that is given: the inverse function."""
    grid, along = _lengths(hole, reach)
    below = np.clip(np.searchsorted(grid, places, side="right") - 1, 0, grid.size - 2)
    return np.asarray(along[below] + _length(hole, reach, grid[below], places))


@lru_cache(maxsize=64)
def _lengths(hole: Hole, reach: float) -> tuple[FloatArray, FloatArray]:
    """Places on the axis, rising, and the arclength s of the lying rod beside each, (n,)."""
    grid = np.linspace(-MARGIN, 1.0 + MARGIN, GRID)
    along = np.concatenate([[0.0], np.cumsum(_length(hole, reach, grid[:-1], grid[1:]))])
    return grid, along + 0.5 - np.interp(0.5, grid, along)


def _length(hole: Hole, reach: float, low: FloatArray, high: FloatArray) -> FloatArray:
    """Lengths (m,) of the lying rod from beside the places ``low`` to beside ``high``, (m,) each."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    half = 0.5 * (high - low)
    return np.asarray((_stretch(hole, reach, low[:, None] + half[:, None] * (nodes + 1.0)) @ weights) * half)


def _stretch(hole: Hole, reach: float, places: FloatArray) -> FloatArray:
    """Arclength of the lying rod per arclength of the axis, at places of any shape."""
    return 1.0 + reach * hole.curvatures(places.ravel())[:, 0].reshape(places.shape)


def heights_of_lying_rod(hole: Hole, reach: float, s: FloatArray) -> FloatArray:
    """Heights (m,) at ``s`` (m,) of a rod on that generator, in L, above S = 0 of the hole's axis."""
    _, frames, points = hole.at(places_of_lying_rod(hole, reach, s))
    return np.asarray(points[:, 2] - reach * frames[:, 0, 2])


PANELS = 64
"""Parts of the rod, at least, in each of which what hangs is added up by eight points."""


def hung_from_end(hole: Hole, reach: float, weight: Profile) -> float:
    """∫ q T·k ds over that rod, the weight that hangs from its upper end, as a ratio to that of a uniform rod of L.

    Of sections of one weight each, from how high each rises.
    """
    if weight.coefficients.shape[1] == 1:
        rises = np.diff(heights_of_lying_rod(hole, reach, weight.breaks))
        return float(weight(weight.breaks[:-1]) @ rises)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    ends = np.union1d(np.linspace(0.0, 1.0, PANELS + 1), weight.breaks)
    half = 0.5 * np.diff(ends)
    s = (ends[:-1, None] + half[:, None] * (nodes + 1.0)).ravel()
    climb = hole.frame(places_of_lying_rod(hole, reach, s))[:, 2, 2]
    return float(half @ ((weight(s) * climb).reshape(half.size, -1) @ weights))
