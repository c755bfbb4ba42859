"""First meshes of a rod in a curved hole: fine where waves are short, kinks at stations and at steps of a string."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete.choices import (
    DEGREE,
    ELEMENTS_PER_RADIAN,
    LEAST_WAVENUMBER,
    LINEAR_ELEMENTS_PER_RADIAN,
    MOST_ELEMENTS_OF_BRANCH,
    POINTS_OF_BRANCH,
)
from rodwell.analysis.discrete.curved import (
    PLACES,
    hole_at,
    hung,
    pieces_of,
    stations_along,
    undeformed_place,
)
from rodwell.analysis.discrete.pieces import Along
from rodwell.analysis.discrete.sectioned import kinked_space, places_along
from rodwell.numerics.splines.spaces import SplineSpace, graded_mesh, running_integral
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray, IntArray

APART = 0.12
"""Radians of the local wavenumber by which kinks of a mesh are apart, and from its ends: round-off in the contact grows
like h⁻³. Of stations closer together some are left to the mesh as it is."""

MOST_PIECES = MOST_ELEMENTS_OF_BRANCH // 4
"""More pieces of a hole, as through very many points, are left to the mesh as it is."""


def linear_space(problem: Problem, loads: tuple[float, float]) -> SplineSpace:
    """Spline space for modes between two end forces, tension positive."""
    return _space(problem, loads, LEAST_WAVENUMBER, LINEAR_ELEMENTS_PER_RADIAN, branch=False)


def first_space(problem: Problem, compression: float, tension: float) -> SplineSpace:
    """Spline space for branches between the most compressive and the most tensile end force, tension positive."""
    return _space(problem, (compression, tension), 2.0 * np.pi, ELEMENTS_PER_RADIAN, branch=True)


def _space(problem: Problem, loads: tuple[float, float], least: float, per_radian: float, branch: bool) -> SplineSpace:
    """Space that resolves the local wavenumber and ``least``; with kinks at steps of a string and at stations.

    No element is on two pieces of an axis that is given, but where these are very many, or close to others.
    """
    places, sections = places_along(problem) if problem.sections else (PLACES, np.zeros(PLACES.size, dtype=int))
    wavenumber = _wavenumber(problem, loads, places, sections) + least
    phase = running_integral(wavenumber, places)
    steps = problem.rod.breaks[1:-1]

    def radians(s: FloatArray) -> FloatArray:
        return np.interp(s, places, phase)

    kinks = _apart(steps, stations_along(problem), radians)
    breaks, pieces = kinks, pieces_of(problem)[1:-1]
    if problem.axis and pieces.size <= MOST_PIECES:  # the pieces of an arc go over into each other
        breaks = _apart(kinks, pieces, radians)
    mesh = graded_mesh(wavenumber, places, per_radian, breaks=breaks)
    if problem.sections:
        return kinked_space(mesh, kinks, float(phase[-1]), branch)
    return SplineSpace(mesh, DEGREE, POINTS_OF_BRANCH if branch else None, kinks)


def _apart(fixed: FloatArray, places: FloatArray, radians: Along) -> FloatArray:
    """Places ``fixed``, and those of others, both rising, that are apart from these, each other, and the ends."""
    kept, last, ends = [], 0.0, np.append(fixed, 1.0)
    reached, at_ends = radians(places), radians(ends)
    for place, phase, after in zip(places, reached, np.searchsorted(ends, places), strict=True):
        before = max(last, at_ends[after - 1] if after else 0.0)
        if phase - before >= APART <= at_ends[after] - phase:
            kept.append(place)
            last = phase
    return np.sort(np.concatenate([fixed, kept]))


def _wavenumber(problem: Problem, loads: tuple[float, float], places: FloatArray, sections: IntArray) -> FloatArray:
    """√(abs(N)/b) + (p/(bΔ))^¼ with the largest contact p per length between two end forces, at places (m,)."""
    k1, k2, g1, g2 = hole_at(problem, undeformed_place(problem, places))[0]
    stiffness, weight = (one.in_pieces(places, sections) for one in (problem.rod.stiffness, problem.rod.weight))
    weights = problem.weight * hung(problem, problem.rod, np.unique(places))(places)
    axial = np.maximum(*(np.abs(load - weights) for load in loads))
    pressed = problem.weight * weight * np.hypot(g1, g2) + np.hypot(k1, k2) * axial
    return np.asarray(np.sqrt(axial / stiffness) + (pressed / (problem.clearance * stiffness)) ** 0.25)
