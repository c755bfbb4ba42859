"""Critical loads of the rod that lies along a wall whose clearance varies smoothly; whether it lies there."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete.family import parameters
from rodwell.analysis.discrete.meshes import linear_space
from rodwell.analysis.discrete.ramped import along_ramps, contact_on_ramps
from rodwell.analysis.straight.lying_loads import Found
from rodwell.analysis.straight.lying_pencil import Pencil, below_all
from rodwell.analysis.straight.refining import refined_loads
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.equilibria import eigen
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.ramps import axial_resultant, wall_at
from rodwell.problem.clearances import check_lies
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Peak, Value

NODES, LAST = 28, 3
"""Places in a section through which the contact is known, and coefficients at the end that tell how well."""

ROUND_OFF = 1e4 * np.finfo(float).eps
"""Round-off in a fourth derivative, as a part of the clearance over the fourth power of the section's length."""


def axial_contact(problem: Problem, force: float) -> float:
    """How much the wall pushes the lying rod along the hole in all, in B/L²: N(0) is F less the axial weight, and this.

    Positive where it pushes towards s = 1, as a hole that widens towards s = 1 does: it adds to the tension below.
    """
    given = along_ramps(problem)(np.zeros(1)).T
    start = axial_resultant(np.zeros(1), given, wall_at(np.zeros(1), given), parameters(problem, force))
    return float(start[0]) - force + problem.hung_weight


def contact_in_all_on_ramps(problem: Problem, force: float) -> Value:
    """∫|p| ds in B/L² of the rod that lies on the wall, pressed to it everywhere, at an end force."""
    breaks, n, found = problem.rod.breaks, problem.rod.breaks.size - 1, []
    half = 0.5 * np.diff(breaks)
    for count in (NODES // 2, NODES):
        nodes, weights = np.polynomial.legendre.leggauss(count)
        places = (0.5 * (breaks[1:] + breaks[:-1])[:, None] + half[:, None] * nodes).ravel()
        at_rest, by_force = contact_on_ramps(problem, places, np.repeat(np.arange(n), count))
        found.append(float(np.abs(at_rest + force * by_force) @ (half[:, None] * weights).ravel()))
    return Value(found[1], abs(found[1] - found[0]))


def least_contact_on_ramps(problem: Problem, force: float) -> Peak:
    """Least contact force per length in B/L³ of the rod that lies on the wall, and where; below 0 it would pull.

    ``force`` is the end force at s = 1 in B/L², tension positive. In each section the contact force is taken as the
    polynomial through NODES places, whose extremes are exact; in each the one towards an end counts there.
    """
    breaks, sign = problem.rod.breaks, -1.0 if problem.outside else 1.0
    x = 0.5 - 0.5 * np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)
    n, lengths = breaks.size - 1, np.diff(breaks)
    places = (breaks[:-1, None] + lengths[:, None] * x).ravel()
    at_rest, by_force = contact_on_ramps(problem, places, np.repeat(np.arange(n), NODES))
    values = sign * (at_rest + force * by_force).reshape(n, NODES)
    rows = np.linalg.solve(np.polynomial.chebyshev.chebvander(2.0 * x - 1.0, NODES - 1), values.T).T
    found = [_least(np.polynomial.Chebyshev(row)) for row in rows]
    k = int(np.argmin([value for value, _ in found]))
    shortest = float(np.min(lengths[problem.rod.tapers("clearance")]))
    noise = ROUND_OFF * problem.clearance * problem.rod.stiffness_range[1] / shortest**4
    noise += float(np.max(np.abs(rows[:, -LAST:])))
    return Peak(found[k][0], noise + 64.0 * float(np.finfo(float).eps) * float(np.max(np.abs(values))),
                float(breaks[k] + lengths[k] * found[k][1]))  # fmt: skip


def _least(polynomial: np.polynomial.Chebyshev) -> tuple[float, float]:
    """Least value of a polynomial on [−1, 1], and where, as a part of the interval."""
    size = float(np.max(np.abs(polynomial.coef)))
    slope = polynomial.deriv().trim(1e-13 * size) if size > 0.0 else polynomial
    roots = slope.roots() if slope.degree() > 0 else np.zeros(0)
    within = roots.real[(np.abs(roots.imag) < 1e-6) & (np.abs(roots.real) < 1.0)]
    places = np.concatenate([[-1.0, 1.0], within])
    values = polynomial(places)
    k = int(np.argmin(values))
    return float(values[k]), float(0.5 + 0.5 * places[k])


def steepest(problem: Problem) -> float:
    """Largest abs(Δ′) along the rod; 0 where the clearance is constant."""
    if not problem.ramps:
        return 0.0
    slope, breaks = problem.rod.clearance.derivative, problem.rod.breaks
    n, places = breaks.size - 1, np.linspace(0.0, 1.0, 33)
    s = (breaks[:-1, None] + np.diff(breaks)[:, None] * places).ravel()
    return problem.clearance * float(np.max(np.abs(slope.in_pieces(s, np.repeat(np.arange(n), places.size)))))


def refuse_pull(problem: Problem, force: float) -> None:
    """Raise where the wall would have to pull the rod at an end force, with the place.

    Raises
    ------
    InputError
        Where the contact force is not above 0 everywhere.
    """
    least = least_contact_on_ramps(problem, force)
    if least.value <= least.error:
        raise InputError(
            "sections, clearance", f"contact force {least.value:.4g} B/L³ at s/L = {least.s:.4g}",
            f"must press the rod to the wall everywhere at its critical load {force:.8g} B/L²: the string bridges the "
            "wall there, which is computed at steps of the clearance only. Let it vary over a longer part of the rod",
        )  # fmt: skip


def loads_on_ramps(problem: Problem, count: int, rtol: float) -> Found:
    """Critical loads of the rod that lies on a wall whose clearance varies, whatever its slope.

    Only those at which the wall presses the rod everywhere: at higher compression it has left the wall.

    Raises
    ------
    InputError
        Where the wall would have to pull already at the first.
    NotConvergedError
        If the tolerance cannot be met.
    """
    check_lies(problem)
    space = linear_space(problem, count)
    while space.size < 3 * count + 8:
        space = space.refined()
    found = refined_loads(problem, space, count, rtol, lambda mesh, start: _solve(problem, mesh, count, start))
    refuse_pull(problem, -float(found.loads[0]))
    pressed = [least_contact_on_ramps(problem, -load) for load in map(float, found.loads[:count])]
    n = next((i for i, least in enumerate(pressed) if least.value <= least.error), count)
    return Found(
        -found.loads[:n], found.errors[:n], found.space, found.vectors[:n], found.coarse_space,
        found.coarse_vectors[:n],
    )  # fmt: skip


def _solve(
    problem: Problem, space: SplineSpace, count: int, start: tuple[FloatArray, FloatArray] | None
) -> tuple[FloatArray, FloatArray]:
    """λ = −F, rising, and full coefficient vectors (k, size), k ≥ ``count``."""
    pencil = Pencil(problem, space)

    def quadrature(block: FloatArray) -> tuple[FloatArray, FloatArray]:
        return pencil.gram(pencil.factors[0], block), pencil.gram(pencil.factors[1], block)

    guess = None if start is None else (start[0], np.ascontiguousarray(start[1][:, pencil.held.free]))
    try:
        below = below_all(pencil.k, pencil.g)
        values, vectors = eigen.lowest(pencil.k, pencil.g, quadrature, count, below, guess)
    except eigen.EigenError as error:
        raise NotConvergedError(f"critical loads: {error}") from None
    return values, pencil.full(vectors)
