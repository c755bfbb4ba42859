"""The place that lifts off, followed along curves of touching states."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.curves.secant import CurveLostError
from rodwell.analysis.discrete.measures import pressure_maxima
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.quantities.arrays import FloatArray

NEAR = 0.03
"""Maxima of the contact pressure closer than this, or than this part of a half wave if they are short, are one."""


class ContactMaximum:
    """The place that lifts off, followed along a curve: each maximum of the contact pressure is a function of its own.

    ``place`` is None as long as the highest one is meant. Of a symmetric state it lies in the first half.
    """

    def __init__(self) -> None:
        self.place: float | None = None
        self.near = NEAR

    def at(self, family: Family, state: State) -> float:
        """Contact pressure at the maximum that is followed, with the sign that makes contact negative."""
        places, values, _ = _maxima(family, state)
        if self.place is None:
            return float(values.max())
        here = np.abs(places - self.place) < self.near
        if not here.any():
            raise CurveLostError("the place that lifts off is lost")
        return float(values[here].max())

    def moved(self, solution: Solution) -> float:
        """Where the maximum that is followed lies at a state."""
        places, values, _ = _maxima(*solution.levels[1])
        if self.place is None:
            return float(places[np.argmax(values)])
        here = np.abs(places - self.place) < self.near
        return float(places[here][np.argmax(values[here])])

    def rival(self, solution: Solution, mesh: int = 1) -> tuple[float, float | None]:
        """Highest contact pressure at any other maximum, and where; the lowest pressure where there is none."""
        places, values, lowest = _maxima(*solution.levels[mesh])
        other = np.abs(places - self.moved(solution)) >= self.near
        if not other.any():
            return lowest, None
        best = int(np.argmax(np.where(other, values, -np.inf)))
        return float(values[best]), float(places[best])


def _maxima(family: Family, state: State) -> tuple[FloatArray, FloatArray, float]:
    """Maxima of the contact pressure: places, of a symmetric state folded onto the first half, values, lowest value."""
    places, values, lowest = pressure_maxima(family, state)
    symmetric = family.parity != 0 or state.symmetry != 0
    return (np.minimum(places, 1.0 - places) if symmetric else places), values, lowest
