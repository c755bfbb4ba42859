"""How far up a long rod a shape reaches: one definition for summary, report, pictures and pages."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.analysis.state.fields import largest_of
from rodwell.analysis.straight.critical import Mode
from rodwell.numerics.continuation.location import bracketed_root
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray

FADED = 1e-3
"""Part of the largest deflection below which a rod counts as straight."""

LOOKS = 16
"""Places in each element at which the end of the buckled part is looked for."""

FIRST_WINDOW = 8


def buckled_to(shape: Mode | Equilibrium) -> float:
    """Return the last place s/L at which a shape deflects by :data:`FADED` of its largest deflection.

    Beyond it |y(s)| < 10⁻³ max |y|. 1 for a shape that deflects at its end s = 1, 0 for the straight rod.
    """
    space, coefficients = spline_of(shape)

    def size(s: FloatArray) -> FloatArray:
        return np.asarray(np.abs(space.evaluate(coefficients, s, 1)[0]))

    level = FADED * largest_of(size, space, zooms=2)[0]
    above = np.flatnonzero(np.abs(coefficients) > level)
    if level == 0.0 or above.size == 0:
        return 0.0
    # a spline stays within its coefficients: nothing is found beyond the last function that exceeds the level
    last = min(int(above[-1]) + 1, space.elements)
    window = FIRST_WINDOW
    while True:
        first = max(0, last - window)
        s = np.interp(
            np.arange(LOOKS * (last - first) + 1) / LOOKS + first, np.arange(space.elements + 1), space.breaks
        )
        beyond = np.flatnonzero(size(s) >= level)
        if beyond.size or first == 0:
            break
        window *= 2
    at = int(beyond[-1])
    if at == s.size - 1:
        return float(s[at])

    def above_level(place: float) -> float:
        return float(size(np.array([place]))[0]) - level

    ends = float(s[at]), float(s[at + 1])
    return bracketed_root(above_level, *ends, above_level(ends[0]), above_level(ends[1]))


def spline_of(shape: Mode | Equilibrium) -> tuple[SplineSpace, FloatArray]:
    """Space and coefficients of y(s), on the finer mesh of a state."""
    if isinstance(shape, Mode):
        return shape.space, shape.coefficients
    state = shape.point.fine
    return state.space, state.c
