"""Critical loads of the rod that lies along a curved hole, in compression and in tension.

The second variation K + F G has F in the factor of v² too, and G is not definite where the rod lies on the outside of
the curve: loads exist in tension as well. A force F* is sought at which K + F* G is positive definite, and the loads on
both sides of it are F* − scale/μ of the pencil −scale·G v = μ (K + F* G) v, none skipped.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.discrete.curved_meshes import linear_space
from rodwell.analysis.straight.lying import refuse_spatial
from rodwell.analysis.straight.lying_pencil import Pencil, below_all
from rodwell.analysis.straight.refining import refined_loads
from rodwell.analysis.straight.scale import load_scale
from rodwell.errors import NotConvergedError
from rodwell.numerics.equilibria import eigen
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

SPARE_MODES, MOST_HALVINGS = 4, 60

ENDLESS = 1e6
"""In units of the scale of loads: the rod counts as stable at every force beyond."""

APART = 100.0
"""Ratio of the distances of loads from a stable force beyond which they are sought one by one."""

SETTLED = 1e-7
"""Relative change of a load from which on the next one, which squares it, is below round-off."""

LARGEST_LOAD = 1e9
"""In units of the scale of loads: how far a stable force is looked for."""


@dataclass(frozen=True)
class Found:
    """Critical loads of one sign: end forces (k,) with errors, and modes on two nested meshes."""

    forces: FloatArray
    errors: FloatArray
    space: SplineSpace
    vectors: FloatArray
    coarse_space: SplineSpace
    coarse_vectors: FloatArray


def stable_force(problem: Problem, space: SplineSpace, scale: float) -> float | None:
    """An end force at which the lying rod is stable on the wall, or None.

    The softest eigenvalue is a concave function of F: its slope at an unstable force tells on which side stable ones
    lie, if there are any.
    """
    pencil = Pencil(problem, space)
    low, high, force = -np.inf, np.inf, 0.5 * problem.hung_weight
    for number in range(MOST_HALVINGS):
        if pencil.unstable(force) == 0:
            return _between(pencil, force, scale)
        slope = pencil.along(pencil.softest(force)[1][0])[1]
        low, high = (force, high) if slope > 0.0 else (low, force)
        if np.isfinite(low) and np.isfinite(high):
            if high - low < 1e-6 * scale:
                return None
            force = 0.5 * (low + high)
        else:
            force += np.sign(slope) * scale * 2.0**number
            if abs(force) > LARGEST_LOAD * scale:
                return None
    return None


def _between(pencil: Pencil, force: float, scale: float) -> float:
    """About the middle of the stable end forces around a stable one, or a scale of load inside of the only limit."""
    low, high = (_reach(pencil, force, sign * scale) for sign in (-1.0, 1.0))
    if np.isfinite(low) and np.isfinite(high):
        return 0.5 * (low + high)
    return high - scale if np.isfinite(high) else low + scale


def _reach(pencil: Pencil, force: float, step: float) -> float:
    """A stable end force within a fifth of ``step`` of where stability ends in its direction; infinite: nowhere."""
    inside, outside = 0.0, 1.0
    while pencil.unstable(force + outside * step) == 0:
        inside, outside = outside, 4.0 * outside
        if outside > ENDLESS:
            return float(np.sign(step) * np.inf)
    while outside - inside > 0.2:
        middle = 0.5 * (inside + outside)
        inside, outside = (middle, outside) if pencil.unstable(force + middle * step) == 0 else (inside, middle)
    return force + inside * step


def loads_of_lying_rod(problem: Problem, count: int, rtol: float, tension: bool = False) -> Found | None:
    """Critical loads of one sign, those met first; None if there are none (in tension), or no stable force at all.

    Raises
    ------
    InputError
        Where θ = 0 is no equilibrium.
    NotConvergedError
        If the tolerance cannot be met, or if the rod is unstable at every end force (in compression).
    """
    refuse_spatial(problem)
    expected = _expected(problem, count + SPARE_MODES)
    scale = load_scale(problem)
    space = linear_space(problem, (-expected, expected))
    while space.size < 3 * count + 8:
        space = space.refined()
    rest = stable_force(problem, space, scale)
    if rest is None:
        if tension:
            return None
        raise NotConvergedError(
            "the rod that lies along this hole is unstable on the wall at every end force: there is no load at which "
            "it begins to buckle. Of a string that hangs through a build in tension, take the part below the build"
        )
    if tension:
        count = min(count, Pencil(problem, space).unstable(rest + ENDLESS * scale))
        if count == 0:
            return None
    found = refined_loads(
        problem, space, count, rtol, lambda mesh, start: _solve(problem, mesh, count, rest, scale, tension, start)
    )
    return Found(
        found.loads[:count], found.errors, found.space, found.vectors[:count], found.coarse_space,
        found.coarse_vectors[:count],
    )  # fmt: skip


def _expected(problem: Problem, number: int) -> float:
    """About the compression at which ``number`` modes have been met."""
    assert problem.hole is not None
    load = 0.0
    for _ in range(50):
        pressed = problem.weight + problem.hole.sharpest * load
        load = 2.0 * np.sqrt(pressed / problem.clearance) + (number * np.pi) ** 2 + problem.weight
    return float(load)


def _solve(
    problem: Problem,
    space: SplineSpace,
    count: int,
    rest: float,
    scale: float,
    tension: bool,
    start: tuple[FloatArray, FloatArray] | None,
) -> tuple[FloatArray, FloatArray]:
    """End forces, those next to ``rest`` first, and full coefficient vectors (k, size), k ≥ ``count``."""
    pencil = Pencil(problem, space)
    step = scale if tension else -scale
    away = None if start is None else np.abs(start[0] - rest)
    try:
        if away is not None and away[count - 1] > APART * away[0]:
            return _one_by_one(pencil, rest, step, count)
        return _in_a_block(pencil, rest, step, count, start)
    except eigen.EigenError:  # loads of the other sign are nearer to F*, or the first of this one, and drown the rest
        try:
            return _one_by_one(pencil, rest, step, count)
        except eigen.EigenError as error:
            raise NotConvergedError(f"critical loads: {error}") from None


def _in_a_block(
    pencil: Pencil, rest: float, step: float, count: int, start: tuple[FloatArray, FloatArray] | None
) -> tuple[FloatArray, FloatArray]:
    """Loads on the side of ``step``, all at once, as eigenvalues of the pencil above; and full coefficient vectors."""
    stiff, gram = step * pencil.g, pencil.k + rest * pencil.g
    whole = pencil.factors[0] + rest * pencil.factors[1]

    def quadrature(block: FloatArray) -> tuple[FloatArray, FloatArray]:
        return step * pencil.gram(pencil.factors[1], block), pencil.gram(whole, block)

    guess = None
    if start is not None:
        guess = -abs(step) / np.abs(start[0] - rest), np.ascontiguousarray(start[1][:, pencil.held.free])
    values, vectors = eigen.lowest(stiff, gram, quadrature, count, below_all(stiff, gram), guess, right=stiff)
    return rest - step / values, pencil.full(vectors)


def _one_by_one(pencil: Pencil, rest: float, step: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Loads on the side of ``step``, bracketed by counts, however far apart they are; and full coefficient vectors.

    The k-th is where the k-th lowest eigenvalue of K + F G vanishes: Newton's method in F, whose next force is the
    Rayleigh quotient −vKv/vGv of that direction. The count grows with the distance from a stable force.
    """
    forces, vectors = np.empty(count), np.empty((count, pencil.k.shape[0]))
    inside, outside = 0.0, 1.0
    for i in range(count):
        while pencil.unstable(rest + outside * step) <= i:
            inside, outside = outside, 2.0 * outside
            if outside > LARGEST_LOAD:
                raise eigen.EigenError(f"load {i + 1} is beyond {rest + outside * step:.1g} B/L²")
        low, high = inside, outside
        place = 0.5 * (low + high)
        for _ in range(MOST_HALVINGS):
            values, modes = pencil.softest(rest + place * step, i + 1)
            low, high = (low, place) if values[i] < 0.0 else (place, high)
            k, g = pencil.along(modes[i])
            before, place = place, (-k / g - rest) / step
            if abs(place - before) <= SETTLED * before:
                break
            if not low < place < high:
                place = 0.5 * (low + high)
        else:
            raise eigen.EigenError(f"load {i + 1} did not settle")
        forces[i], vectors[i] = rest + place * step, modes[i]
    return forces, pencil.full(vectors)


def value_of(found: Found, i: int) -> Value:
    """Load number ``i`` from 0."""
    return Value(float(found.forces[i]), float(found.errors[i]))
