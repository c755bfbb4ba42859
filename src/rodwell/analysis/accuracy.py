"""Degree, tolerances and first meshes: the numerical choices, in one place."""

from __future__ import annotations

import numpy as np

from rodwell.errors import checked_number
from rodwell.numerics.spaces import SplineSpace, graded_mesh
from rodwell.problem import Problem

DEGREE = 9
"""Spline degree. The contact pressure takes three derivatives and converges with order degree − 2; against
degree 7 this needs half the elements for eight digits of it."""

POINTS = DEGREE - 1
"""Gauss points in each element of the meshes of critical loads: φ″φ″ is integrated exactly."""

POINTS_OF_BRANCH = DEGREE - 3
"""Gauss points in each element of the meshes of branches. Two less than make φ″φ″ exact: with splines this smooth,
errors of neighbouring elements cancel, and every number keeps its error; with one less, the end curvatures do not."""

RTOL = 1e-8
"""Default relative tolerance of every reported number."""

LOWEST_RTOL, HIGHEST_RTOL = 1e-11, 1e-2
MOST_ELEMENTS = 40_000
"""Elements allowed for critical loads."""

MOST_ELEMENTS_OF_BRANCH = 4_000
"""Elements allowed for branches: beyond, round-off in the contact pressure outweighs what is gained."""

MOST_WORK = 1.5e6
"""Elements times solves allowed for one branch: about 20 s."""

LARGEST_FORCE = 1e9
"""Largest end force, in B/L², that may be asked for."""

ELEMENTS_PER_RADIAN = 0.85
"""Density of the first mesh of a branch, per radian of the local wavenumber."""

LINEAR_ELEMENTS_PER_RADIAN = 0.8
"""The same for critical loads: an eigenvalue converges with order 2(degree − 1), twice as fast as the shape."""


def checked_rtol(rtol: float) -> float:
    """Return a tolerance that double precision can meet, or raise."""
    allowed = f"from {LOWEST_RTOL:g} (what double precision allows) to {HIGHEST_RTOL:g}"
    return checked_number("rtol", rtol, LOWEST_RTOL, HIGHEST_RTOL, allowed)


def checked_step(largest_step: float) -> float:
    """Return a longest step of continuation that can be asked for, or raise."""
    return checked_number("largest_step", largest_step, 1e-4, 1.0, "from 0.0001 to 1")


def first_space(
    problem: Problem,
    compression: float,
    tension: float = 0.0,
    density: float = ELEMENTS_PER_RADIAN,
    points: int = POINTS_OF_BRANCH,
) -> SplineSpace:
    """Spline space graded by the local wavenumber of (64) over a range of end forces.

    Every solution of the linear equation with frozen coefficients, k⁴ + N(s) k² + wₗ/Δ = 0, has
    |k| ≤ √|N(s)| + (wₗ/Δ)^¼. That covers half waves, decay lengths and the layers at clamped ends under
    tension; it is largest where the axial weight adds most.

    Parameters
    ----------
    problem
        The problem.
    compression, tension
        Most compressive (lowest) and most tensile (highest) end force to be resolved, tension positive.
    density
        Elements per radian of the local wavenumber.
    points
        Gauss points in each element.
    """
    s = np.linspace(0.0, 1.0, 257)
    weight = problem.axial_weight * (s - 1.0)
    axial = np.maximum(np.abs(compression + weight), np.abs(tension + weight))
    foundation = abs(problem.foundation) / problem.clearance
    wavenumber = np.sqrt(axial) + foundation**0.25 + 2.0 * np.pi * (1 + abs(problem.turns))
    return SplineSpace(graded_mesh(wavenumber, s, density), DEGREE, points)


def checked_force(field: str, value: object) -> float:
    """Return an end force that can be asked for, or raise."""
    allowed = f"a finite end force in B/L², tension positive, of at most {LARGEST_FORCE:g} either way"
    return checked_number(field, value, -LARGEST_FORCE, LARGEST_FORCE, allowed)
