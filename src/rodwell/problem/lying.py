"""The rod that lies along a curved hole: which places of the axis it is beside, and how high it rises."""

from __future__ import annotations

import numpy as np

from rodwell.problem.hole import Hole
from rodwell.quantities.arrays import FloatArray

GRID = 2571
"""Places on the axis between which its curvature is integrated, with eight points each."""

MARGIN = 0.05
"""How far beyond S = 0 and S = 1 these reach: a rod on the inside of a bend is beside more than its length."""


def places_of_lying_rod(hole: Hole, reach: float, s: FloatArray) -> FloatArray:
    """Places S₀ (m,) on the axis beside ``s`` (m,) of a rod on the generator towards −N1, S₀(½) = ½.

    The rod is ``reach`` from the axis, negative towards N1; dS₀/ds = 1/(1 + reach k1).
    """
    if not hole.axis:
        return np.asarray(0.5 + (s - 0.5) / (1.0 + reach * hole.curvatures(np.array([0.5]))[0, 0]))
    nodes, weights = np.polynomial.legendre.leggauss(8)
    grid = np.linspace(-MARGIN, 1.0 + MARGIN, GRID)
    half = 0.5 * np.diff(grid)[:, None]

    def stretch(places: FloatArray) -> FloatArray:
        return 1.0 + reach * hole.curvatures(places.ravel())[:, 0].reshape(places.shape)

    lengths = (stretch(grid[:-1, None] + half * (nodes + 1.0)) @ weights) * half[:, 0]
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    along += 0.5 - np.interp(0.5, grid, along)
    found = np.interp(s, along, grid)
    for _ in range(3):  # Newton's method, with the integral from the nearest grid point below
        below = np.clip(np.searchsorted(grid, found, side="right") - 1, 0, grid.size - 2)
        step = 0.5 * (found - grid[below])
        part = (stretch(grid[below][:, None] + step[:, None] * (nodes + 1.0)) @ weights) * step
        found = found - (along[below] + part - s) / stretch(found)
    return np.asarray(found)


def rise_of_lying_rod(hole: Hole, reach: float) -> float:
    """Height of the end s = 1 of a rod on that generator above the end s = 0, in L."""
    places = places_of_lying_rod(hole, reach, np.array([0.0, 1.0]))
    heights = hole.points(places)[:, 2] - reach * hole.frame(places)[:, 0, 2]
    return float(heights[1] - heights[0])
