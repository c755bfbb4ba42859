"""Derivatives of critical loads of a rod along a curved hole, or where the clearance varies, by what its problem has.

The rod lies on θ = 0 whatever the inputs are, so only the second variation K + F G at the mode v changes with them:

    dF/dq = −v·(∂K/∂q + F ∂G/∂q)v / v·G v        (Hellmann and Feynman).

Its factors are formulas of the inputs, the hole beside the rod included; ∂/∂q is a central difference of these. In the
data of a section they are linear: :func:`lying_section_slopes` takes no differences.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.analysis.discrete.curved import along_rod, along_uniform_rod, hole_at, rates_at, undeformed_place
from rodwell.analysis.discrete.family import parameters
from rodwell.analysis.straight.lying_pencil import hessian_at, variation_factors
from rodwell.numerics.equilibria.differences import central_slope, one_sided_slope
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.curved import FIRST, LIFT, OFFSET, TERMS
from rodwell.physics.on_wall.curved import hole_at as tabulated
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, FORCE
from rodwell.problem.problem import Problem
from rodwell.problem.varying import CURVATURES
from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray

STEP = 5e-4
"""Step of the differences: of α in radians, of the others relative."""


def inputs_of(problem: Problem) -> tuple[str, ...]:
    """Numbers of a problem in a curved hole, or on a wall whose clearance varies, by which derivatives are told.

    Not by the inclination and the curvature of an axis that is given by points: they are those of the points.
    """
    if problem.axis:
        return ("weight", "clearance")
    if problem.ramps:
        return ("weight", "alpha", "clearance")
    turns = problem.in_space
    return ("weight", "alpha", "clearance", "build", *(("walk",) if turns else ()))


def step_in(problem: Problem, name: str) -> float:
    """Step of the differences in one of these numbers; of the curvature such that no hole is straight."""
    if name == "alpha":
        return float(np.degrees(STEP))
    if name in CURVATURES:
        size = abs(getattr(problem, name))
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

    def changed(x: float) -> float:
        return _form(along(x), space, coefficients, force)

    rate = (one_sided_slope if to_one_side else central_slope)(changed, step)
    return -float(rate) / _by_force(problem, space, coefficients)


def lying_change(problem: Problem, space: SplineSpace, coefficients: FloatArray, force: float, other: Problem) -> float:
    """Change of that load in another problem nearby, to first order in what differs."""
    here, there = (_form(one, space, coefficients, force) for one in (problem, other))
    return (here - there) / _by_force(problem, space, coefficients)


def _form(problem: Problem, space: SplineSpace, coefficients: FloatArray, force: float) -> float:
    """The second variation K + F G at a mode."""
    k, g = variation_factors(problem, space)
    return _square(space, coefficients, k + force * g)


def _by_force(problem: Problem, space: SplineSpace, coefficients: FloatArray) -> float:
    return _square(space, coefficients, variation_factors(problem, space)[1])


def _square(space: SplineSpace, coefficients: FloatArray, factors: FloatArray) -> float:
    squares = space.at_points(coefficients)
    return float(np.einsum("dm,dfm,fm->", squares, factors * space.weights, squares))


def lying_section_slopes(
    problem: Problem, space: SplineSpace, coefficients: FloatArray, force: float
) -> dict[str, FloatArray]:
    """Derivatives of a critical load by the data of each of n sections, named as those of a straight hole.

    :func:`rodwell.analysis.straight.slopes.section_slopes` says which. With the density e of the second variation, of
    which ∂e/∂N is the factor of the force along the hole N = F − w A + C (A and C as of
    :func:`rodwell.analysis.discrete.curved.along_rod`, a sum over sections each), ψ the slope of the hole and
    the bending moment m = ½ ∂e/∂v″, which is continuous, a section contributes

        dF/db = −∫ ∂e/∂b + ∂C/∂b ∂e/∂N ds,   dF/dq = −∫ ∂e/∂q − w ∂A/∂q ∂e/∂N ds,
        dF/ds = [e − 2m v″] − ([b] κᵣκᵣ′ + w [q] cos ψ) ∫₀ˢ ∂e/∂N ds,

    all over ∫ ∂e/∂N ds; [x] is the change of x at the step towards s = 1.
    """
    rod, breaks, s, w = problem.rod, problem.rod.breaks, space.points, space.weights
    piece, every = rod.stiffness.piece_of(s), np.arange(len(problem.sections))
    rows = along_uniform_rod(problem)
    bent, pressed, pushed = _parts_of_density(problem, space, coefficients, rows(s))

    def each(values: FloatArray) -> FloatArray:
        return np.asarray(np.bincount(piece, w * values, every.size), dtype=float)

    below = np.concatenate([[0.0], np.cumsum(each(pushed))])
    found = {}
    for name, part, along, size in (("stiffness", bent, OFFSET, 1.0), ("weight", pressed, LIFT, -problem.weight)):
        tapers, times = rod.tapers(name), np.ones(s.size)
        times[tapers[piece]] = getattr(rod, name)(s[tapers[piece]])

        def hung(x: FloatArray, of: IntArray, along: int = along, tapers: BoolArray = tapers) -> FloatArray:
            of_rod, of_uniform = (tabulated(x, each_at(x).T)[along] for each_at in (along_rod(problem), rows))
            return np.asarray(np.where(tapers[of], of_rod, of_uniform))

        ends = hung(breaks[1:], every)
        driven = (hung(breaks[:-1], every) - ends) * below[:-1] + each((hung(s, piece) - ends[piece]) * pushed)
        found[name] = -(each(times * part) + size * driven) / below[-1]
    found["upper_end"] = _step_slopes(problem, space, coefficients, force, below[1:-1]) / below[-1]
    return found


def _parts_of_density(
    problem: Problem, space: SplineSpace, coefficients: FloatArray, rows: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """∂e/∂b, ∂e/∂q with A as it is, and ∂e/∂N of the second variation of the mode at the quadrature points, (m,) each.

    ``rows`` are those of the uniform rod: b = q = 1.
    """
    squares, bare, p = space.at_points(coefficients), rows.copy(), parameters(problem)
    bare[:, FIRST + LIFT * TERMS : FIRST + (OFFSET + 1) * TERMS] = 0.0
    out = []
    for force, weight in ((0.0, 0.0), (0.0, problem.weight), (1.0, 0.0)):
        p[FORCE], p[AXIAL_WEIGHT] = force, weight
        out.append(np.einsum("dm,dfm,fm->m", squares, hessian_at(space.points, bare, p), squares))
    return out[0], out[1] - out[0], out[2] - out[0]


def _step_slopes(
    problem: Problem, space: SplineSpace, coefficients: FloatArray, force: float, below: FloatArray
) -> FloatArray:
    """By the places of steps (k,), what :func:`lying_section_slopes` says; ``below`` are ∫₀ˢ ∂e/∂N ds up to them."""
    steps, rows, p = problem.rod.breaks[1:-1], along_rod(problem), parameters(problem, force)
    y, slope, bend = space.evaluate(coefficients, steps, 3)
    sides = [(x, rows(x)) for x in (np.nextafter(steps, 0.0), steps)]
    low, high = (hessian_at(*side, p) for side in sides)
    moment = high[2, 2] * bend + high[0, 2] * y + high[1, 2] * slope
    under, above = (
        h[0, 0] * y**2 + 2.0 * h[0, 1] * y * slope + h[1, 1] * slope**2
        - (moment - h[0, 2] * y - h[1, 2] * slope) ** 2 / h[2, 2]
        for h in (low, high)
    )  # fmt: skip
    places = undeformed_place(problem, steps)
    (k1, *_), climb = hole_at(problem, places)
    stretch = 1.0 + problem.clearance * k1
    turned = k1 * rates_at(problem, places)[0] / stretch**4
    stiffer, heavier = (np.diff(profile.sides, axis=0)[0] for profile in (problem.rod.stiffness, problem.rod.weight))
    return np.asarray(above - under - (stiffer * turned + problem.weight * heavier * climb) * below)
