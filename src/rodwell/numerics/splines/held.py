"""What is held among the coefficients of a spline, and the unknowns that remain.

A mask says which coefficients are held (at zero, for increments). One that *follows* another counts as held, and has
the other's value. A spline's first two coefficients are its value at the end and, with it, its slope there: an end
condition holds value and slope (2), the value only (1), or none (0); where the slope alone is held (at zero), the
outermost coefficient follows its neighbour.

In matrices, rows and columns of what is held become those of the identity: pivots of 1, which leave the number of
negative ones as it is, and add nothing to any sum.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rodwell.compiling.kernels import kernel
from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray


@kernel
def restrict(band, held, follows):
    """Banded matrix (n, width) in which what follows has joined what it follows, and what is held is the identity."""
    n, width = band.shape
    inner = np.empty((n, width))
    for j in range(n):
        for k in range(width):
            inner[j, k] = band[j, k]
    for i in range(n):
        j = follows[i]
        if j != i:
            inner[j, 0] += band[i, 0] + 2.0 * band[min(i, j), abs(i - j)]
            for m in range(max(0, i - width + 1), min(n, i + width)):
                if m not in (i, j) and abs(m - j) < width:
                    inner[min(m, j), abs(m - j)] += band[min(m, i), abs(m - i)]
    for i in range(n):
        if held[i]:
            inner[i, 0] = 1.0
            for k in range(1, width):
                inner[i, k] = 0.0
                if i >= k:
                    inner[i - k, k] = 0.0
    return inner


@kernel
def gather(x, held, follows):
    """Add entries of a covector ``x`` (n,) to those that they follow, and clear what is held, in place."""
    for i in range(x.size):
        if follows[i] != i:
            x[follows[i]] += x[i]
    for i in range(x.size):
        if held[i]:
            x[i] = 0.0


@kernel
def spread(x, follows):
    """Let entries of a vector of coefficients ``x`` (n,) take the values that they follow, in place."""
    for i in range(x.size):
        x[i] = x[follows[i]]


@dataclass(frozen=True)
class Held:
    """Which of n coefficients are held, (n,), and which one each follows (itself, mostly), (n,)."""

    held: BoolArray
    follows: IntArray

    @property
    def free(self) -> IntArray:
        """Positions of the unknowns."""
        return np.flatnonzero(~self.held)

    def restrict(self, band: FloatArray) -> FloatArray:
        """Banded matrix of all coefficients, the identity where they are held."""
        return np.asarray(restrict(band, self.held, self.follows))

    def free_part(self, band: FloatArray) -> FloatArray:
        """Band of the unknowns alone, those between two of which others are held moved together."""
        whole, free = self.restrict(band), self.free
        inner = np.zeros((free.size, band.shape[1]))
        for k in range(min(band.shape[1], free.size)):
            apart = free[k:] - free[: free.size - k]
            near = apart < band.shape[1]
            inner[: free.size - k, k][near] = whole[free[: free.size - k][near], apart[near]]
        return inner

    def gather(self, x: FloatArray) -> FloatArray:
        """Entries of a covector (n,) that belong to the unknowns."""
        x = x.copy()
        gather(x, self.held, self.follows)
        return x[self.free]

    def spread(self, free: FloatArray) -> FloatArray:
        """Coefficients (n,) of a function whose held values are zero, from its unknowns."""
        x = np.zeros(self.held.size)
        x[self.free] = free
        spread(x, self.follows)
        return x


@dataclass(frozen=True)
class Ends:
    """End conditions: coefficients held at the first and the last end, and whether the outermost follows the next."""

    held: tuple[int, int]
    tied: tuple[bool, bool] = (False, False)

    def among(self, size: int) -> Held:
        """What they hold among ``size`` coefficients."""
        return _among(self, size)


@lru_cache(maxsize=64)
def _among(ends: Ends, size: int) -> Held:
    held, follows = np.zeros(size, dtype=np.bool_), np.arange(size, dtype=np.int64)
    held[: ends.held[0]] = True
    held[size - ends.held[1] :] = True
    if ends.tied[0]:
        follows[0] = 1
    if ends.tied[1]:
        follows[-1] = size - 2
    return Held(held, follows)
