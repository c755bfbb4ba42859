"""Smooth functions along the rod as polynomials in pieces, between places where they may have jumps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rodwell.quantities.arrays import FloatArray

NODES = 12
"""Chebyshev nodes in each piece of a :class:`PiecewisePolynomial`."""

Along = Callable[[FloatArray], FloatArray]
"""Something along the rod: values at places (m,), of several (k, m)."""


@dataclass(frozen=True)
class PiecewisePolynomial:
    """A smooth function of s from its values at Chebyshev nodes between ``breaks``: coefficients (NODES, pieces)."""

    breaks: FloatArray
    coefficients: FloatArray

    @classmethod
    def of(cls, breaks: FloatArray, function: Along) -> PiecewisePolynomial:
        """Take the values of a function."""
        return cls.each(breaks, lambda s: function(s)[None])[0]

    @classmethod
    def each(cls, breaks: FloatArray, functions: Along) -> list[PiecewisePolynomial]:
        """Take the values of several functions (k, m), which are asked for once."""
        half, centre = 0.5 * np.diff(breaks), 0.5 * (breaks[1:] + breaks[:-1])
        nodes = np.polynomial.chebyshev.chebpts1(NODES)
        found = functions((centre[:, None] + half[:, None] * nodes).ravel()).reshape(-1, half.size, NODES)
        fit = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes, NODES - 1))
        return [cls(breaks, np.asarray(fit @ values.T)) for values in found]

    def __call__(self, s: FloatArray) -> FloatArray:
        """Values (m,) at places (m,)."""
        piece = np.clip(np.searchsorted(self.breaks, s, side="right") - 1, 0, self.breaks.size - 2)
        low, high = self.breaks[piece], self.breaks[piece + 1]
        x = (2.0 * s - low - high) / (high - low)
        return np.asarray(np.polynomial.chebyshev.chebval(x, self.coefficients[:, piece], tensor=False))

    def integral_above(self) -> PiecewisePolynomial:
        """∫ₛ¹ of it."""
        half = 0.5 * np.diff(self.breaks)
        whole = np.array(-half * np.polynomial.chebyshev.chebint(self.coefficients, lbnd=1.0))
        pieces = np.asarray(np.polynomial.chebyshev.chebval(-1.0, whole))
        whole[0] += np.concatenate([np.cumsum(pieces[::-1])[::-1][1:], [0.0]])
        return PiecewisePolynomial(self.breaks, whole)
