"""First meshes, as fine as the modes ask for and where they ask for it.

With frozen coefficients and compression P(s) = −N(s), equation (64) has solutions exp(iks) with k⁴ − Pk² + b = 0,
b = wₗ/Δ. Where P > 2√b they are waves, and (k₃ − k₁)² = P − 2√b: modes fill the part of the rod where that is
positive, with ∫ (k₃ − k₁) ds growing by π from mode to mode. Elsewhere modes die away at the rate μ = ½√(2√b − P), or,
beyond P = −2√b, at the rates √((N ∓ √(N² − 4b))/2). So under its own weight a long inclined rod buckles at its lower
end only, and the mesh need not resolve what stands above. The meshes are a matter of cost: what is found on them is
checked on finer ones, and by counts.
"""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete import curved_meshes, sectioned
from rodwell.analysis.discrete.choices import (
    DEGREE,
    ELEMENTS_PER_RADIAN,
    LEAST_WAVENUMBER,
    LINEAR_ELEMENTS_PER_RADIAN,
    POINTS_OF_BRANCH,
)
from rodwell.numerics.splines.spaces import SplineSpace, graded_mesh, running_integral
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

SPARE_MODES = 4
"""How many modes more than asked for the mesh is made for."""

DEAD = 30.0
"""Where a solution has fallen by exp(−30) it need not be resolved any more."""

GROWTH = 5.0
"""Elements stay shorter than the distance to what is resolved, times about the density over this number."""

FULLER = 2.5
"""How many times the wavenumber of the linear equation buckled states ask for at most."""

MANY, EVEN = 6.0, 1.5
"""With more half waves than this, meshes of branches are finer by this factor where the waves are: the numbers that are
measured, among them the largest contact pressure, tell little of the waves elsewhere."""

ABOUT = 1e-6
"""How closely the load of a number of half waves is needed, as a part of their Euler load."""

PLACES = 257


def linear_space(problem: Problem, count: int) -> SplineSpace:
    """Return a spline space for the first ``count`` critical loads."""
    if problem.sections:
        return sectioned.linear_space(problem, count + SPARE_MODES)
    if problem.axial_weight < 0.0:
        return _mirrored(linear_space(problem.turned_round, count))
    load = wkb_load(problem, count + SPARE_MODES)
    places = _places(problem, load)
    mesh = graded_mesh(resolved(problem, places, load) + LEAST_WAVENUMBER, places, LINEAR_ELEMENTS_PER_RADIAN)
    return SplineSpace(mesh, DEGREE)


def first_space(problem: Problem, compression: float, tension: float = 0.0) -> SplineSpace:
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

    Elements grow where states have died away: beyond the part of the rod in which the lowest end force makes waves.
    """
    if problem.hole is not None:
        return curved_meshes.first_space(problem, compression, tension)
    if problem.sections:
        return sectioned.first_space(problem, compression, tension)
    if problem.axial_weight < 0.0:
        ends = (force - problem.axial_weight for force in (compression, tension))
        return _mirrored(first_space(problem.turned_round, *ends))
    load = -compression
    s = _places(problem, load)
    weight = problem.axial_weight * (s - 1.0)
    axial = np.maximum(np.abs(compression + weight), np.abs(tension + weight))
    foundation = abs(problem.foundation) / problem.clearance
    wavenumber = np.sqrt(axial) + foundation**0.25
    if _waves(problem, load) and problem.turns == 0:
        wavenumber = np.minimum(wavenumber, FULLER * resolved(problem, s, load))
        if foundation**0.25 * _end_of_waves(problem, load) > MANY * np.pi:
            wavenumber[s <= _end_of_waves(problem, load)] *= EVEN  # s = 1 too: symmetric where the problem is
    wavenumber += 2.0 * np.pi * (1 + abs(problem.turns))
    return SplineSpace(graded_mesh(wavenumber, s, ELEMENTS_PER_RADIAN), DEGREE, POINTS_OF_BRANCH)


def _mirrored(space: SplineSpace) -> SplineSpace:
    """The space of a rod seen from its other end: what follows takes the lower end to be s = 0."""
    return SplineSpace(1.0 - space.breaks[::-1], space.degree, space.per_element)


def _waves(problem: Problem, load: float) -> bool:
    """Whether frozen coefficients have waves at the lower end: then the rest of a long rod may stay straight."""
    b = problem.foundation / problem.clearance
    return bool(b > 0.0 and load + problem.axial_weight > 2.0 * np.sqrt(b))


def wkb_load(problem: Problem, number: float) -> float:
    """Compression −F at s = 1 at which about ``number`` modes have been met: ∫ (k₃ − k₁) ds = number · π."""
    if problem.sections:
        return sectioned.wkb_load(problem, number)
    if problem.axial_weight < 0.0:
        return wkb_load(problem.turned_round, number) - problem.axial_weight
    b, weight, whole = problem.foundation / problem.clearance, problem.axial_weight, number * np.pi
    if b < 0.0:  # on top: the whole rod is in waves of k₃, the other root is imaginary
        s = np.linspace(0.0, 1.0, PLACES)

        def phase(load: float) -> float:
            p = load + weight * (1.0 - s)
            return float(np.trapezoid(np.sqrt(0.5 * (p + np.sqrt(p * p - 4.0 * b))), s))

        low, high = -weight - 2.0 * np.sqrt(-b), 2.0 * np.sqrt(-b) + whole**2
    else:
        floor = 2.0 * np.sqrt(b)

        def phase(load: float) -> float:
            top, bottom = max(load - floor, 0.0), max(load + weight - floor, 0.0)
            return _mean_root(top, bottom, 1.0 if bottom >= weight else bottom / weight)

        low, high = floor - weight, floor + whole**2
    middle = 0.5 * (low + high)
    while high - low > ABOUT * whole**2 and low < middle < high:
        low, high = (middle, high) if phase(middle) < whole else (low, middle)
        middle = 0.5 * (low + high)
    return float(middle)


def _mean_root(a: float, b: float, length: float) -> float:
    """∫ √u ds over a length on which u falls linearly from b to a; no digits are lost where a is close to b."""
    p, q = np.sqrt(a), np.sqrt(b)
    return float(2.0 / 3.0 * length * (a + p * q + b) / (p + q)) if p + q > 0.0 else 0.0


def _places(problem: Problem, load: float) -> FloatArray:
    """Places in [0, 1], close together near the ends and where the waves end."""
    close = np.logspace(-9.0, 0.0, 91)
    turning = _end_of_waves(problem, load)
    near = [close, 1.0 - close, turning - close, turning + close, [turning]]
    places = np.concatenate([np.linspace(0.0, 1.0, PLACES), *near])
    return np.unique(places[(places >= 0.0) & (places <= 1.0)])


def _end_of_waves(problem: Problem, load: float) -> float:
    """Where P = 2√b: below, modes are waves."""
    if problem.foundation < 0.0 or problem.axial_weight == 0.0:
        return 1.0
    excess = load + problem.axial_weight - 2.0 * np.sqrt(problem.foundation / problem.clearance)
    return 1.0 if excess >= problem.axial_weight else float(max(0.0, excess) / problem.axial_weight)


def resolved(problem: Problem, places: FloatArray, load: float) -> FloatArray:
    """Wavenumber in rad/L to be resolved at ``places`` (m,), from s = 0 to 1, at the compression −F = ``load``."""
    b = problem.foundation / problem.clearance
    p = load + problem.axial_weight * (1.0 - places)
    floor = 2.0 * np.sqrt(abs(b))
    root = np.sqrt(np.maximum(p * p - 4.0 * b, 0.0))
    largest = np.where((np.abs(p) < floor) & (b > 0.0), abs(b) ** 0.25, np.sqrt(0.5 * (np.abs(p) + root)))
    if b < 0.0 or problem.axial_weight == 0.0:
        return np.asarray(largest)
    waves = places <= _end_of_waves(problem, load)
    tense = p < -floor
    between = np.where(waves, 0.0, 0.5 * np.sqrt(np.maximum(floor - p, 0.0)))
    slow = np.where(tense, 0.5 * floor / np.maximum(largest, 1e-300), between)
    fast = np.where(tense, largest, between)
    alive, sharp = (running_integral(rate, places) < DEAD for rate in (slow, fast))
    phase = running_integral(largest, places)
    layers = (phase < DEAD) | (phase[-1] - phase < DEAD)
    fine = sharp | layers
    wavenumber = np.where(fine, largest, np.where(alive, slow, 0.0))
    edges = places[fine]
    after = np.searchsorted(edges, places)
    distance = np.minimum(
        np.abs(places - edges[np.maximum(after - 1, 0)]), np.abs(places - edges[np.minimum(after, edges.size - 1)])
    )
    return np.asarray(np.maximum(wavenumber, np.where(fine, 0.0, np.minimum(GROWTH / (distance + 1e-12), largest))))


def free_space(problem: Problem, count: int) -> SplineSpace:
    """Spline space for the first ``count`` critical loads without a wall: modes turn with the twist along s as well."""
    if problem.sections:
        return sectioned.free_space(problem, count + SPARE_MODES)
    if problem.axial_weight < 0.0:
        return _mirrored(free_space(problem.turned_round, count))
    upright = problem.but(weight=problem.axial_weight, alpha=0.0, twist=0.0, on_top=False)
    load = wkb_load(upright, count + SPARE_MODES)
    places = _places(upright, load)
    wavenumber = resolved(upright, places, load) + LEAST_WAVENUMBER + abs(problem.twist)
    return SplineSpace(graded_mesh(wavenumber, places, LINEAR_ELEMENTS_PER_RADIAN), DEGREE)
