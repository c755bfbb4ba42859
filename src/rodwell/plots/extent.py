"""How much of a long rod is drawn: the part that is buckled, with places enough for its half waves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.state.extent import buckled_to, spline_of
from rodwell.analysis.straight.critical import Mode
from rodwell.quantities.arrays import FloatArray

SHORT = 0.5
"""A buckled part longer than this part of the rod is no reason to leave out the rest."""

PLACES, PER_ELEMENT = 601, 4


def shown_part(shapes: Sequence[Mode | Solution]) -> float:
    """Where to end a picture of some shapes, s/L: beyond the buckled part if it is short, else at 1."""
    farthest = max(buckled_to(shape) for shape in shapes)
    return 1.0 if farthest > SHORT else min(1.0, 1.2 * farthest)


def drawn_places(shapes: Sequence[Mode | Solution], part: float = 1.0) -> FloatArray:
    """Places from s = 0 to ``part``: evenly spaced, as many as the half waves ask for."""
    elements = max(int(np.searchsorted(spline_of(shape)[0].breaks, part)) for shape in shapes)
    return np.linspace(0.0, part, max(PLACES, PER_ELEMENT * elements + 1))


def straight_beyond(part: float) -> str:
    """What an axis says of the rest of the rod."""
    return "" if part == 1.0 else " (straight beyond the picture)"
