"""Critical loads of the straight rod that is kept on a wall of one clearance, on one mesh."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete.family import given_of, parameters, spline_ends
from rodwell.analysis.discrete.meshes import linear_space, wkb_load
from rodwell.errors import NotConvergedError
from rodwell.numerics.equilibria import eigen
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.linear import second_variation
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray


def factors_of(problem: Problem, space: SplineSpace) -> FloatArray:
    """Factors of v², v′², v″² in the second variation at the quadrature points, (3, m)."""
    given = given_of(problem.rod)(space.points) if problem.sections else None
    return second_variation(space.points, parameters(problem), given)


def starting_space(problem: Problem, count: int) -> SplineSpace:
    """Mesh for the first ``count`` modes, with unknowns enough for the block of vectors that looks for them."""
    space = linear_space(problem, count)
    while space.size < 3 * count + 8:
        space = space.refined()
    return space


def loads_on_mesh(
    problem: Problem, space: SplineSpace, count: int, start: tuple[FloatArray, FloatArray] | None
) -> tuple[FloatArray, FloatArray]:
    """λ = −F, rising, and full coefficient vectors (k, size); k ≥ ``count``, the first ``count`` converged."""
    factors = factors_of(problem, space)
    held = spline_ends(problem).among(space.size)
    stiffness, gram = held.free_part(space.form(factors)), held.free_part(space.slope_gram)

    def full(block: FloatArray) -> FloatArray:
        return np.array([held.spread(free) for free in block])

    def quadrature(block: FloatArray) -> tuple[FloatArray, FloatArray]:
        return space.grams(factors, full(block))

    # ∫φ² ≤ 4∫φ'²/π² for functions that vanish at one end bounds what a negative foundation can do
    below = -problem.heaviest + 4.0 * float(min(np.min(factors[0]), 0.0)) / np.pi**2 - 1.0
    guess, near = None, None
    if start is None:
        near = wkb_load(problem, 0.5), wkb_load(problem, eigen.block_size(count) + 1.0)
    else:
        guess = start[0], np.ascontiguousarray(start[1][:, held.free])
    try:
        values, vectors = eigen.lowest(stiffness, gram, quadrature, count, below, guess, near)
    except eigen.EigenError as error:
        raise NotConvergedError(f"critical loads: {error}") from None
    return values, full(vectors)
