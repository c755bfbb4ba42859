"""The rod in a state that may leave the wall: what is asked of it for stresses, on both meshes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.state.compared import compared_peaks
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Peak

Fields = dict[str, FloatArray]

PLACES, ZOOMS, ZOOMED = 401, 3, 17
"""Places among which a largest value is sought first, how often it is looked at closer, and at how many places."""


@dataclass(frozen=True, eq=False)
class RodOffWall:
    """A state of partial contact, asked like :class:`rodwell.strength.loaded.LoadedRod`.

    Attributes
    ----------
    state
        The state.
    straight, error
        It is buckled, and its end force is what it is solved for.
    """

    state: ContactState
    straight: bool = False
    error: float = 0.0

    @cached_property
    def _levels(self) -> tuple[ContactState, ContactState]:
        """The state on elements of the lower and of the higher degree."""
        coarse = self.state.coarse
        return ContactState(self.state.problem, coarse, coarse), self.state

    def fields(self, s: FloatArray) -> Fields:
        """Fields at places s (m,) in units B = L = 1, named as those of a rod on the wall."""
        return _fields(self.state, s)

    def largest(self, size: Callable[[Fields], FloatArray]) -> Peak:
        """Largest value along the rod of something made from its fields, with its error and place."""
        return compared_peaks(*(_largest(level, size) for level in self._levels))


def _fields(state: ContactState, s: FloatArray) -> Fields:
    """Force, moments and height of a state, at places s (m,).

    The twisting moment is that of the end all along. ``xi2`` is the angle around the hole of a rod on the wall at the
    same height: cos ξ₂ = −x/Δ.
    """
    f = state.fields(s)
    height = np.clip(-f["x"] / state.problem.clearance, -1.0, 1.0)
    return {
        "s": f["s"], "z": f["z"], "xi2": np.arccos(height), "rod_F1": f["tension"],
        "rod_M1": np.full(s.shape, state.problem.twist), "rod_M2": np.zeros(s.shape), "rod_M3": f["bending_moment"],
    }  # fmt: skip


def _largest(state: ContactState, size: Callable[[Fields], FloatArray]) -> tuple[float, float]:
    """The largest value and its place: among evenly spaced places and ends of stretches, then closer and closer.

    Of a string also on either side of each step, where what is made from its fields jumps.
    """
    steps = state.problem.rod.breaks[1:-1]
    ends = np.concatenate([np.clip(state.fine.bounds, 0.0, 1.0), np.nextafter(steps, 0.0), steps])
    places = np.unique(np.concatenate([np.linspace(0.0, 1.0, PLACES), ends]))
    found = -np.inf, 0.0
    for zoom in range(ZOOMS + 1):
        values = size(_fields(state, places))
        i = int(np.argmax(values))
        found = max(found, (float(values[i]), float(places[i])))
        if zoom < ZOOMS:
            places = np.linspace(places[max(i - 1, 0)], places[min(i + 1, len(places) - 1)], ZOOMED)
    return found
