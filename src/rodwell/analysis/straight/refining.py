"""Critical loads on meshes that grow until two nested ones agree."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rodwell.analysis.discrete.choices import MOST_ELEMENTS
from rodwell.analysis.straight.scale import load_noise, load_scale
from rodwell.errors import NotConvergedError
from rodwell.numerics.splines.spaces import Prolongation, SplineSpace
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

Pairs = tuple[FloatArray, FloatArray]
"""Loads (k,) and modes (k, n)."""

Solve = Callable[[SplineSpace, Pairs | None], Pairs]
"""Loads and modes on a mesh, as many as asked for or more; from those of a coarser one, if there is one."""


class Refined(NamedTuple):
    """Loads and modes on the finer of two nested meshes, with errors of those asked for, and those on the coarser."""

    loads: FloatArray
    errors: FloatArray
    space: SplineSpace
    vectors: FloatArray
    coarse_loads: FloatArray
    coarse_space: SplineSpace
    coarse_vectors: FloatArray


def refined_loads(problem: Problem, space: SplineSpace, count: int, rtol: float, solve: Solve) -> Refined:
    """Halve the elements until ``count`` loads change by no more than the tolerance.

    The error is that change and round-off; it is judged against abs(load) and the scale of loads of the problem.

    Raises
    ------
    NotConvergedError
        If the tolerance cannot be met with the elements that there may be.
    """
    loads, vectors = solve(space, None)
    while True:
        finer = space.refined()
        up = Prolongation(space, finer)
        better, shapes = solve(finer, (loads, np.array([up(v) for v in vectors])))
        size = np.abs(better[:count]) + load_scale(problem)
        error = np.abs(better[:count] - loads[:count]) + load_noise(problem) * size
        if np.all(error <= rtol * size):
            return Refined(better, error, finer, shapes, loads, space, vectors)
        if 2 * finer.elements > MOST_ELEMENTS:
            raise NotConvergedError(
                f"critical loads are known to {np.max(error / size):.1e} only, rtol is {rtol:g}: "
                "ask for fewer modes or a larger rtol"
            )
        space, loads, vectors = finer, better, shapes
