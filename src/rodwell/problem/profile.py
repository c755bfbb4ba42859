"""Functions of s in pieces, each a polynomial; ratios of sections that vary along them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np

from rodwell.quantities.arrays import FloatArray, IntArray

Ratio = float | tuple[float, ...]
"""A number, or the values at evenly spaced places of a section, from its lower to its upper end."""

MOST_VALUES = 5
"""Values that make a polynomial at most: a quartic, such as the stiffness of a rod whose diameter goes in a line."""

FEW_TIMES, SEEN, POINTS = 1.5, 9, 16
"""By which factor a polynomial may vary in a panel, seen at so many places, for Gauss's rule of so many points to have
all digits of the integral of its reciprocal."""

_EDGE = 1e-9
"""How far a root may lie beside [0, 1] and count as within."""


@dataclass(frozen=True)
class Profile:
    """A function of s in pieces, each a polynomial.

    Attributes
    ----------
    breaks
        Where pieces begin and end, rising from 0 to 1, (n + 1,).
    coefficients
        Of the powers 0, 1, … of s less the piece's origin, for each piece, (n, k): a piece is a function of all s.
    origins
        Of the pieces, (n,); None: all have s = 1, to which they are prolonged.
    """

    breaks: FloatArray
    coefficients: FloatArray
    origins: FloatArray | None = None

    def piece_of(self, places: FloatArray) -> IntArray:
        """Number of the piece in which each place (m,) lies; where two meet, that towards s = 1."""
        inner = self.breaks[1:-1]
        return np.searchsorted(inner, places, side="right").astype(np.int64)

    def __call__(self, places: FloatArray) -> FloatArray:
        """Values (m,) at places (m,)."""
        return self.in_pieces(places, self.piece_of(places))

    def in_pieces(self, places: FloatArray, piece: IntArray) -> FloatArray:
        """Values (m,) that the pieces (m,) have at places (m,)."""
        own = self.coefficients[piece]
        x = places - (1.0 if self.origins is None else self.origins[piece])
        value = np.zeros(own.shape[0])
        for k in range(own.shape[1] - 1, -1, -1):
            value = value * x + own[:, k]
        return value

    @cached_property
    def derivative(self) -> Profile:
        """The derivative by s within the pieces."""
        order = np.arange(1.0, max(self.coefficients.shape[1], 2))
        lower = self.coefficients[:, 1:] * order[: self.coefficients.shape[1] - 1]
        return Profile(self.breaks, lower if lower.shape[1] else np.zeros((lower.shape[0], 1)), self.origins)

    @cached_property
    def sides(self) -> FloatArray:
        """Values that the pieces have at their steps, (2, n − 1): of the piece towards s = 0, and of that towards 1."""
        steps, piece = self.breaks[1:-1], np.arange(self.breaks.size - 2)
        return np.stack([self.in_pieces(steps, piece), self.in_pieces(steps, piece + 1)])


@lru_cache(maxsize=256)
def powers(ratio: Ratio) -> tuple[float, ...]:
    """Coefficients of the powers of x, from 0 to 1 along the section, of a ratio."""
    if isinstance(ratio, float):
        return (ratio,)
    nodes = np.linspace(0.0, 1.0, len(ratio))
    return tuple(map(float, np.linalg.solve(np.vander(nodes, increasing=True), np.array(ratio))))


def extremes(ratio: Ratio) -> tuple[float, float, float]:
    """Least value of a ratio within its section, where, as a part of its length, and its largest value."""
    if isinstance(ratio, float):
        return ratio, 0.0, ratio
    found = np.polynomial.Polynomial(powers(ratio))
    roots = found.deriv().roots() if found.degree() > 1 else np.zeros(0)
    within = roots.real[(np.abs(roots.imag) < _EDGE) & (roots.real > 0.0) & (roots.real < 1.0)]
    places = np.concatenate([[0.0, 1.0], within])
    values = found(places)
    k = int(np.argmin(values))
    return float(values[k]), float(places[k]), float(np.max(values))


def reach(ratio: Ratio) -> float:
    """Distance of the nearest zero of a ratio in the complex plane from its section, in lengths of the section."""
    zeros = np.polynomial.Polynomial(powers(ratio)).roots()
    return float(np.min(np.abs(zeros - np.clip(zeros.real, 0.0, 1.0)), initial=np.inf))


def within(ratio: Ratio, first: float, last: float) -> Ratio:
    """A ratio in a part of its section, from ``first`` to ``last`` of its length."""
    if isinstance(ratio, float):
        return ratio
    places = np.linspace(first, last, len(ratio))
    return tuple(map(float, np.polynomial.polynomial.polyval(places, powers(ratio))))


def along(breaks: FloatArray, ratios: Sequence[Ratio]) -> Profile:
    """The profile of ratios, one for each section."""
    rows = [powers(ratio) for ratio in ratios]
    coefficients = np.zeros((len(rows), max(map(len, rows))))
    for i, row in enumerate(rows):
        coefficients[i, : len(row)] = row
    lengths = np.diff(breaks)[:, None]
    return Profile(breaks, coefficients / lengths ** np.arange(coefficients.shape[1]), breaks[:-1])


def integral_from_1(profile: Profile) -> Profile:
    """∫₁ˢ of a profile with origins at the lower ends of its pieces."""
    coefficients, lengths = profile.coefficients, np.diff(profile.breaks)
    order = np.arange(1.0, coefficients.shape[1] + 1.0)
    raised = coefficients / order
    whole = np.sum(raised * lengths[:, None] ** order, axis=1)
    rest = np.cumsum(whole[::-1])[::-1]
    return Profile(profile.breaks, np.concatenate([-rest[:, None], raised], axis=1), profile.origins)


@dataclass(frozen=True)
class ReciprocalIntegral:
    """∫₀ˢ ds/f(s) of a profile f > 0, as a function of s: by Gauss's rule in panels in which f varies little."""

    profile: Profile

    @cached_property
    def _panels(self) -> tuple[FloatArray, IntArray, FloatArray]:
        """Where panels begin, and at last end, (m + 1,), their pieces (m,), and the integral up to each, (m + 1,)."""
        ends, pieces = [0.0], []
        for piece, bounds in enumerate(pairwise(map(float, self.profile.breaks))):
            waiting = [bounds]
            while waiting:
                left, right = waiting.pop()
                values = self.profile.in_pieces(np.linspace(left, right, SEEN), np.full(SEEN, piece))
                if np.max(values) <= FEW_TIMES * np.min(values):
                    ends.append(right)
                    pieces.append(piece)
                else:
                    middle = 0.5 * (left + right)
                    waiting += [(middle, right), (left, middle)]
        starts, owner = np.array(ends), np.array(pieces)
        return starts, owner, np.concatenate([[0.0], np.cumsum(self._part(starts[:-1], starts[1:], owner))])

    def _part(self, left: FloatArray, right: FloatArray, piece: IntArray) -> FloatArray:
        points, weights = np.polynomial.legendre.leggauss(POINTS)
        h = 0.5 * (right - left)
        places = left[:, None] + h[:, None] * (points + 1.0)
        values = self.profile.in_pieces(places.ravel(), np.repeat(piece, POINTS)).reshape(places.shape)
        return np.asarray(h * ((1.0 / values) @ weights))

    def __call__(self, places: FloatArray) -> FloatArray:
        """Values (m,) at places (m,)."""
        ends, pieces, below = self._panels
        k = np.clip(np.searchsorted(ends, places, side="right") - 1, 0, pieces.size - 1)
        return np.asarray(below[k] + self._part(ends[k], np.asarray(places, dtype=float), pieces[k]))
