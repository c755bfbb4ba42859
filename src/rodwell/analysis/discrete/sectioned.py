"""First meshes of a string of sections: a mesh point at every step, elements as the waves of each section ask for.

In a section the equations are those of a uniform rod with bending stiffness b, compression P(s) and foundation
a = q wₗ/Δ: solutions exp(iks) with b k⁴ − P k² + a = 0, waves with (k₃ − k₁)² = P/b − 2√(a/b) where that is positive,
and abs(k) ≤ √(P/b) + (a/b)^¼ everywhere. Resolving the latter in all sections costs elements where a long string stays
straight, and asks for nothing that a step could make wrong.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete.choices import (
    DEGREE,
    ELEMENTS_PER_RADIAN,
    LEAST_WAVENUMBER,
    LINEAR_ELEMENTS_PER_RADIAN,
    POINTS_OF_BRANCH,
)
from rodwell.analysis.discrete.ramped import contact_on_ramps
from rodwell.numerics.splines.spaces import SplineSpace, graded_mesh
from rodwell.problem.problem import Problem
from rodwell.problem.rod import Rod
from rodwell.quantities.arrays import FloatArray, IntArray

PLACES = 9
"""Places in each section between which the local wavenumber counts as linear; evenly spaced."""

LONG = 257
"""The same of the whole string, shared out by length."""

ABOUT = 1e-6
LEAST_ELEMENTS = 8

SMOOTH = 2
"""Elements of a section from which on it takes as few Gauss points as a uniform rod: y″ of one element between two
steps has more shapes than these see, and those unseen would cost nothing."""

LOWER_DEGREES: dict[bool, tuple[tuple[float, int], ...]] = {
    False: ((0.04, 7), (0.015, 5)),
    True: ((0.12, 7), (0.015, 5)),
}
"""Degrees where the shortest section is short against the waves of the string: below so many radians of the mean
wavenumber, so high a degree; of critical loads (False) and of branches. Round-off in the coefficients is enlarged by
the fourth power of that ratio, and more the higher the degree, and in short elements a low degree resolves as much."""


def places_along(problem: Problem) -> tuple[FloatArray, IntArray]:
    """Places (m,), rising, each step twice, and the section (m,) that each belongs to."""
    breaks = problem.rod.breaks
    lengths = np.diff(breaks)
    counts = np.maximum(PLACES, np.ceil(LONG * lengths).astype(int))
    section = np.repeat(np.arange(lengths.size), counts)
    number = np.arange(section.size) - np.repeat(np.cumsum(counts) - counts, counts)
    share = number / (counts[section] - 1)
    places = np.where(share == 1.0, breaks[section + 1], breaks[section] + lengths[section] * share)
    return places, section


def _local(problem: Problem, places: FloatArray, section: IntArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """B(s)/B, N(s) at F = 0, and wₗ/Δ with its sign at places, (m,) each."""
    rod = problem.rod
    stiffness, weight, lever = (one.in_pieces(places, section) for one in (rod.stiffness, rod.weight, rod.lever))
    return stiffness, problem.axial_weight * lever, problem.foundation / problem.clearance * weight


def wkb_load(problem: Problem, number: float) -> float:
    """Compression −F at s = 1 at which about ``number`` modes have been met: ∫ (k₃ − k₁) ds = number · π."""
    places, section = places_along(problem)
    stiffness, axial, foundation = _local(problem, places, section)
    steps = np.diff(places)
    floor = 2.0 * np.sqrt(np.maximum(foundation, 0.0) / stiffness)

    def phase(load: float) -> float:
        p = (load - axial) / stiffness
        below = foundation < 0.0  # on top: waves of k₃ everywhere
        squares = np.where(
            below, 0.5 * (p + np.sqrt(p * p + 4.0 * np.maximum(-foundation, 0.0) / stiffness)), p - floor
        )
        root = np.sqrt(np.maximum(squares, 0.0))
        return float(0.5 * (root[1:] + root[:-1]) @ steps)

    whole = number * np.pi
    euler = whole**2 / problem.rod.compliance
    low = float(np.min(axial - 2.0 * np.sqrt(np.abs(foundation) * stiffness)))
    high = low + euler
    step = euler
    while phase(high) < whole:
        step *= 2.0
        low, high = high, high + step
    middle = 0.5 * (low + high)
    while high - low > ABOUT * euler and low < middle < high:
        low, high = (middle, high) if phase(middle) < whole else (low, middle)
        middle = 0.5 * (low + high)
    return float(middle)


def linear_space(problem: Problem, count: int) -> SplineSpace:
    """Spline space for critical loads up to about number ``count``."""
    load = wkb_load(problem, count)
    return _space(problem, (load, load), LEAST_WAVENUMBER, LINEAR_ELEMENTS_PER_RADIAN, branch=False)


def free_space(problem: Problem, count: int) -> SplineSpace:
    """The same without a wall: modes turn with the twist along s as well."""
    weight, alpha = abs(problem.axial_weight), 0.0 if problem.axial_weight >= 0.0 else 180.0
    upright = problem.but(weight=weight, alpha=alpha, twist=0.0, on_top=False)
    load = wkb_load(upright, count)
    least = LEAST_WAVENUMBER + abs(problem.twist) / problem.rod.stiffness_range[0]
    return _space(upright, (load, load), least, LINEAR_ELEMENTS_PER_RADIAN, branch=False)


def first_space(problem: Problem, compression: float, tension: float) -> SplineSpace:
    """Spline space for branches between the most compressive and the most tensile end force, tension positive."""
    least = 2.0 * np.pi * (1 + abs(problem.turns))
    return _space(problem, (-compression, -tension), least, ELEMENTS_PER_RADIAN, branch=True)


def _space(problem: Problem, loads: tuple[float, float], least: float, per_radian: float, branch: bool) -> SplineSpace:
    """Space that resolves √(|P|/b) + (a/b)^¼ and ``least`` at compressions −F from one load to the other."""
    places, section = places_along(problem)
    stiffness, axial, foundation = _local(problem, places, section)
    if problem.ramps:
        foundation = _pushed(problem, places, section, loads) / (
            problem.clearance * problem.rod.clearance.in_pieces(places, section)
        )
    most = np.maximum(np.abs(loads[0] - axial), np.abs(loads[1] - axial))
    wavenumber = np.sqrt(most / stiffness) + (np.abs(foundation) / stiffness) ** 0.25 + least
    breaks = problem.rod.breaks
    mesh = graded_mesh(wavenumber, places, per_radian, LEAST_ELEMENTS, breaks[1:-1])
    smooth = _smooth(problem.rod) if problem.ramps else None
    return kinked_space(mesh, breaks[1:-1], float(np.trapezoid(wavenumber, places)), branch, smooth)


def _pushed(problem: Problem, places: FloatArray, section: IntArray, loads: tuple[float, float]) -> FloatArray:
    """The larger contact force per length (m,) at two compressions −F where the clearance varies."""
    at_rest, by_force = contact_on_ramps(problem, places, section)
    return np.maximum(np.abs(at_rest - loads[0] * by_force), np.abs(at_rest - loads[1] * by_force))


def _smooth(rod: Rod) -> IntArray:
    """Derivatives of θ that are continuous at ends of sections where the clearance varies, (n − 1,).

    Where it does, it is smooth up to the third: θ″ jumps with the stiffness, θ‴ with its derivative, θ⁗ with the fourth
    derivative of the clearance. Knots that ask for less leave more to round-off.
    """
    below, above = rod.stiffness_sides
    return np.where(below != above, 1, np.where(rod.stiffness_kink_sizes != 0.0, 2, 3))


def kinked_space(
    mesh: FloatArray, kinks: FloatArray, radians: float, branch: bool, smooth: IntArray | None = None
) -> SplineSpace:
    """Spline space on a mesh with kinks (k,), of so many radians of the local wavenumber in all."""
    ends = np.concatenate([[0.0], kinks, [1.0]])
    shortest = float(np.min(np.diff(ends))) * radians
    degree = min([DEGREE, *(lower for most, lower in LOWER_DEGREES[branch] if shortest < most)])
    inside = np.diff(np.searchsorted(mesh, ends))  # elements between kinks
    few = branch and degree == DEGREE and int(np.min(inside)) >= SMOOTH
    return SplineSpace(mesh, degree, POINTS_OF_BRANCH if few else None, kinks, smooth)
