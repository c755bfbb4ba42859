"""Degree, tolerances and first meshes: the numerical choices, in one place."""

from __future__ import annotations

import math

from rodwell.errors import checked_number

DEGREE = 9
"""Spline degree. The contact pressure takes three derivatives and converges with order degree − 2; against
degree 7 this needs half the elements for eight digits of it."""

POINTS_OF_BRANCH = DEGREE - 3
"""Gauss points in each element of the meshes of branches. Two less than make φ″φ″ exact: with splines this smooth,
errors of neighbouring elements cancel, and every number keeps its error; with one less, the end curvatures do not."""


MOST_ELEMENTS = 40_000
"""Elements allowed for critical loads."""

MOST_ELEMENTS_OF_BRANCH = 4_000
"""Elements allowed for branches: beyond, round-off in the contact pressure outweighs what is gained."""

MOST_WORK = 1.5e6
"""Elements times solves allowed for one branch: about 20 s."""


ELEMENTS_PER_RADIAN = 0.85
"""Density of the first mesh of a branch, per radian of the local wavenumber."""

LINEAR_ELEMENTS_PER_RADIAN = 0.8
"""The same for critical loads: an eigenvalue converges with order 2(degree − 1), twice as fast as the shape."""


LEAST_WAVENUMBER = 6.0 * math.pi
"""Wavenumber in rad/L that is resolved everywhere: for light rods, where frozen coefficients say little."""


def checked_step(largest_step: float) -> float:
    """Return a longest step of continuation that can be asked for, or raise."""
    return checked_number("largest_step", largest_step, 1e-4, 1.0, "from 0.0001 to 1")
