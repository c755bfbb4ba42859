"""What is held at the two ends of a spline, and the unknowns that remain.

A spline's first two coefficients are its value at the end and, with it, its slope there. An end condition holds
some of them: value and slope 2, value only 1, none 0. Where the slope alone is held (at zero), the outermost
coefficient is *tied* to its neighbour: it counts as held, and follows the neighbour. One field only.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.compiling.kernels import kernel
from rodwell.quantities.arrays import FloatArray


@kernel
def restrict(band, first, last, tied_first, tied_last):
    """Banded matrix of the free unknowns ``first … last−1``: held ones drop out, tied ones join their neighbour."""
    n, width = last - first, band.shape[1]
    inner = np.zeros((n, width))
    for j in range(n):
        for k in range(min(width, n - j)):
            inner[j, k] = band[first + j, k]
    if tied_first:
        inner[0, 0] += band[0, 0] + 2.0 * band[0, 1]
        for k in range(1, min(width - 1, n)):
            inner[0, k] += band[0, k + 1]
    if tied_last:
        end = band.shape[0] - 1
        inner[n - 1, 0] += band[end, 0] + 2.0 * band[end - 1, 1]
        for k in range(1, min(width - 1, n)):
            inner[n - 1 - k, k] += band[end - 1 - k, k + 1]
    return inner


@kernel
def gather(x, first, last, tied_first, tied_last):
    """Add the entries of a covector ``x`` (n,) at tied unknowns to those of their neighbours, in place."""
    if tied_first:
        x[first] += x[0]
    if tied_last:
        x[last - 1] += x[x.size - 1]


@kernel
def spread(x, first, last, tied_first, tied_last):
    """Let tied entries of a vector of coefficients ``x`` (n,) follow their neighbours, in place."""
    if tied_first:
        x[0] = x[first]
    if tied_last:
        x[x.size - 1] = x[last - 1]


@dataclass(frozen=True)
class Ends:
    """End conditions: coefficients held at the first and the last end, and whether the outermost one is tied."""

    held: tuple[int, int]
    tied: tuple[bool, bool] = (False, False)

    def free(self, size: int) -> slice:
        """Free coefficients among ``size``."""
        return slice(self.held[0], size - self.held[1])

    def restrict(self, band: FloatArray) -> FloatArray:
        """Band of the free unknowns of a banded matrix (n, width)."""
        inner = self.free(band.shape[0])
        return np.asarray(restrict(band, inner.start, inner.stop, *self.tied))

    def gather(self, x: FloatArray) -> FloatArray:
        """Entries of a covector (n,) that belong to the free unknowns."""
        inner, x = self.free(x.size), x.copy()
        gather(x, inner.start, inner.stop, *self.tied)
        return x[inner]

    def spread(self, free: FloatArray) -> FloatArray:
        """Coefficients (n,) of a function whose held values are zero, from its free unknowns."""
        x = np.zeros(free.size + sum(self.held))
        inner = self.free(x.size)
        x[inner] = free
        spread(x, inner.start, inner.stop, *self.tied)
        return x
