"""Derivatives of the critical loads of a rod that lies along a curved hole, by what its problem is made of.

The rod lies on θ = 0 whatever the inputs are, so only the second variation K + F G at the mode v changes with them:

    dF/dq = −v·(∂K/∂q + F ∂G/∂q)v / v·G v        (Hellmann and Feynman).

Its factors are formulas of the inputs, the hole beside the rod included; ∂/∂q is a central difference of these.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.analysis.straight.lying_loads import variation_factors
from rodwell.numerics.equilibria.differences import central_slope, one_sided_slope
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

STEP = 5e-4
"""Step of the differences: of α in radians, of the others relative."""


def inputs_of(problem: Problem) -> tuple[str, ...]:
    """Numbers of a problem in a curved hole by which derivatives are told.

    Not by the inclination and the curvature of an axis that is given by points: they are those of the points.
    """
    return ("weight", "clearance") if problem.axis else ("weight", "alpha", "clearance", "build")


def step_in(problem: Problem, name: str) -> float:
    """Step of the differences in one of these numbers; of the curvature such that no hole is straight."""
    if name == "alpha":
        return float(np.degrees(STEP))
    if name == "build":
        size = abs(problem.build)
        return min(STEP * max(1.0, size), 0.2 * size) if size > 0.0 else STEP
    return STEP * float(getattr(problem, name) or 1.0)


def beside(problem: Problem, name: str, step: float) -> Problem:
    """The problem with a number changed by a step.

    An inclination beyond the vertical is one on the other side of it, where the high side is the low one.
    """
    value = getattr(problem, name) + step
    if name == "alpha" and not 0.0 <= value <= 180.0:
        beyond = -value if value < 0.0 else 360.0 - value
        return problem.but(alpha=beyond, on_top=not problem.on_top, build=-problem.build)
    return problem.but(**{name: value})


def lying_slope(
    problem: Problem,
    space: SplineSpace,
    coefficients: FloatArray,
    force: float,
    along: Callable[[float], Problem],
    step: float,
    *,
    to_one_side: bool = False,
) -> float:
    """dF/dq of a critical load F = ``force`` with the mode given by ``coefficients``.

    ``along`` gives the problem with q changed by as much as it is called with, up to twice the ``step`` either way; or
    up to four times, towards its side only.
    """
    squares = space.at_points(coefficients)

    def form(factors: FloatArray) -> float:
        return float(np.einsum("dm,dfm,fm->", squares, factors * space.weights, squares))

    def changed(x: float) -> float:
        k, g = variation_factors(along(x), space)
        return form(k + force * g)

    by_force = form(variation_factors(problem, space)[1])
    rate = (one_sided_slope if to_one_side else central_slope)(changed, step)
    return -float(rate) / by_force
