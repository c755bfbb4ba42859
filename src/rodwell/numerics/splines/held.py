"""What is held among the coefficients of a spline, and the unknowns that remain.

A list says which coefficients are held (at zero, for increments). One that *follows* another counts as held, and has
the other's value. A spline's first two coefficients are its value at the end and, with it, its slope there: an end
condition holds value and slope (2), the value only (1), or none (0); where the slope alone is held (at zero), the
outermost coefficient follows its neighbour.

In matrices, rows and columns of what is held become those of the identity: pivots of 1, which leave the number of
negative ones as it is, and add nothing to any sum.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from rodwell.compiling.kernels import kernel
from rodwell.quantities.arrays import FloatArray, IntArray


@kernel
def restrict(band, held, follows):
    """Let what follows join what it follows in a banded matrix (n, width), and put the identity at what is held.

    In place. ``held`` (h,) are the coefficients that are held, ``follows`` (h,) those that they follow, or themselves.
    """
    n, width = band.shape
    for k in range(held.size):
        i, j = held[k], follows[k]
        if j != i:
            band[j, 0] += band[i, 0] + 2.0 * band[min(i, j), abs(i - j)]
            for m in range(max(0, i - width + 1), min(n, i + width)):
                if m not in (i, j) and abs(m - j) < width:
                    band[min(m, j), abs(m - j)] += band[min(m, i), abs(m - i)]
    for i in held:
        band[i, 0] = 1.0
        for k in range(1, width):
            band[i, k] = 0.0
            if i >= k:
                band[i - k, k] = 0.0


@kernel
def gather(x, held, follows):
    """Add entries of a covector ``x`` (n,) to those that they follow, and clear what is held, in place."""
    for k in range(held.size):
        i, j = held[k], follows[k]
        if j != i:
            x[j] += x[i]
    for i in held:
        x[i] = 0.0


@kernel
def spread(x, held, follows):
    """Let entries of a vector of coefficients ``x`` (n,) take the values that they follow, in place."""
    for k in range(held.size):
        i, j = held[k], follows[k]
        x[i] = x[j]


@dataclass(frozen=True)
class Held:
    """Which of ``size`` coefficients are held, (h,), and which one each of these follows (itself, mostly), (h,)."""

    size: int
    held: IntArray
    follows: IntArray

    @cached_property
    def free(self) -> IntArray:
        """Positions of the unknowns."""
        return np.setdiff1d(np.arange(self.size), self.held)

    def restrict(self, band: FloatArray) -> FloatArray:
        """Banded matrix of all coefficients, the identity where they are held."""
        out = band.copy()
        restrict(out, self.held, self.follows)
        return out

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
        x = np.zeros(self.size)
        x[self.free] = free
        spread(x, self.held, self.follows)
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
    first, last = ends.held
    held = np.array([*range(first), *range(size - last, size)], dtype=np.int64)
    follows = held.copy()
    if ends.tied[0]:
        follows[0] = 1
    if ends.tied[1]:
        follows[-1] = size - 2
    return Held(size, held, follows)
