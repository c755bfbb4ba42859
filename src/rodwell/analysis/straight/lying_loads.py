"""Critical loads of the rod that lies along a curved hole, in compression and in tension.

The second variation K + F G has F in the factor of v² too, and G is not definite where the rod lies on the outside of
the curve: loads exist in tension as well. A force F* is sought at which K + F* G is positive definite, and the loads on
both sides of it are F* − scale/μ of the pencil −scale·G v = μ (K + F* G) v, none skipped.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.discrete.curved import along_rod, linear_space
from rodwell.analysis.discrete.family import parameters, spline_ends
from rodwell.analysis.straight.lying import refuse_spatial
from rodwell.analysis.straight.refining import refined_loads
from rodwell.analysis.straight.scale import load_scale
from rodwell.errors import NotConvergedError
from rodwell.numerics.equilibria import eigen
from rodwell.numerics.splines.banded import factorise
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.curved import RodInCurvedHole
from rodwell.physics.on_wall.parameters import COUNT
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

SPARE_MODES = 4

MOST_HALVINGS = 60

ENDLESS = 1e6
"""In units of the scale of loads: the rod counts as stable at every force beyond."""

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


def _factors(problem: Problem, space: SplineSpace) -> tuple[FloatArray, FloatArray]:
    """Hessian of the density at y = 0, (3, 3, m), without an end force, and by it."""
    rows, still = along_rod(problem)(space.points).T, np.zeros((3, space.points.size))
    out = []
    for force in (0.0, 1.0):
        p, rates = parameters(problem, force), np.zeros(COUNT)
        hessian = RodInCurvedHole.density(space.points, still, rows, p, rates)[-1]
        out.append(np.array([[np.broadcast_to(x, space.points.shape) for x in row] for row in hessian], dtype=float))
    return out[0], out[1] - out[0]


def _band(space: SplineSpace, factors: FloatArray) -> FloatArray:
    """Band (n, p + 1) of the form with factors (3, 3, m) at the quadrature points."""
    local, elements = space.degree + 1, space.elements
    table = space.table.reshape(elements, -1, 3, local)
    weighted = (factors * space.weights).reshape(3, 3, elements, -1)
    blocks = np.einsum("eqda,dfeq,eqfb->eab", table, weighted, table, optimize=True)
    band = np.zeros((space.size, local))
    for a in range(local):
        for b in range(a + 1):
            np.add.at(band[:, a - b], space.starts + b, blocks[:, a, b])
    return band


class _Pencil:
    """K and G on a mesh, restricted to what the ends leave free."""

    def __init__(self, problem: Problem, space: SplineSpace) -> None:
        self.space = space
        self.held = spline_ends(problem).among(space.size)
        self.factors = _factors(problem, space)
        self.k, self.g = (self.held.free_part(_band(space, f)) for f in self.factors)
        self.slopes = self.held.free_part(space.slope_gram)

    def full(self, block: FloatArray) -> FloatArray:
        return np.array([self.held.spread(free) for free in block])

    def gram(self, factors: FloatArray, block: FloatArray) -> FloatArray:
        """Matrix (k, k) of a form for vectors (k, n), from values at the points: squares do not cancel."""
        values = self.space.at_points(self.full(block))
        weighted = np.einsum("dfm,kfm->kdm", factors * self.space.weights, values)
        return np.asarray(np.einsum("kdm,ldm->kl", weighted, values))

    def unstable(self, force: float) -> int:
        """How many directions are unstable at an end force."""
        return int(factorise(self.k + force * self.g))

    def softest(self, force: float) -> tuple[int, float]:
        """How many directions are unstable at an end force, and by which sign of F the softest becomes stiffer."""
        band = self.k + force * self.g
        negative = self.unstable(force)
        if negative == 0:
            return 0, 0.0
        whole, slope = self.factors[0] + force * self.factors[1], np.zeros_like(self.factors[0])
        slope[1, 1] = 1.0

        def quadrature(block: FloatArray) -> tuple[FloatArray, FloatArray]:
            return self.gram(whole, block), self.gram(slope, block)

        below = -1.0
        while eigen.count_below(band, self.slopes, below) > 0:
            below *= 2.0
        _, vectors = eigen.lowest(band, self.slopes, quadrature, 1, below, None)
        return negative, float(self.gram(self.factors[1], vectors[:1])[0, 0])


def stable_force(problem: Problem, space: SplineSpace, scale: float) -> float | None:
    """An end force at which the lying rod is stable on the wall, or None.

    The softest eigenvalue is a concave function of F: its slope at an unstable force tells on which side stable ones
    lie, if there are any.
    """
    pencil = _Pencil(problem, space)
    low, high, force = -np.inf, np.inf, 0.5 * problem.hung_weight
    for number in range(MOST_HALVINGS):
        negative, slope = pencil.softest(force)
        if negative == 0:
            return _between(pencil, force, scale)
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


def _between(pencil: _Pencil, force: float, scale: float) -> float:
    """About the middle of the stable end forces around a stable one, or a scale of load inside of the only limit."""
    low, high = (_reach(pencil, force, sign * scale) for sign in (-1.0, 1.0))
    if np.isfinite(low) and np.isfinite(high):
        return 0.5 * (low + high)
    return high - scale if np.isfinite(high) else low + scale


def _reach(pencil: _Pencil, force: float, step: float) -> float:
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
            "it begins to buckle"
        )
    if tension:
        count = min(count, _in_tension(problem, space))
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


def _in_tension(problem: Problem, space: SplineSpace) -> int:
    """How many loads there are in tension: the negative directions of G."""
    return int(factorise(_Pencil(problem, space).g.copy()))


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
    pencil = _Pencil(problem, space)
    sign = 1.0 if tension else -1.0
    stiff, gram = sign * scale * pencil.g, pencil.k + rest * pencil.g
    whole = pencil.factors[0] + rest * pencil.factors[1]

    def quadrature(block: FloatArray) -> tuple[FloatArray, FloatArray]:
        return sign * scale * pencil.gram(pencil.factors[1], block), pencil.gram(whole, block)

    below = -1.0
    while eigen.count_below(stiff, gram, below) > 0:
        below *= 2.0
    guess = None
    if start is not None:
        guess = -scale / np.abs(start[0] - rest), np.ascontiguousarray(start[1][:, pencil.held.free])
    try:
        values, vectors = eigen.lowest(stiff, gram, quadrature, count, below, guess, right=stiff)
    except eigen.EigenError:  # loads of the other sign are nearer to F* and drown those sought
        try:
            values, vectors = eigen.lowest(stiff, gram, quadrature, count, below, guess)
        except eigen.EigenError as error:
            raise NotConvergedError(f"critical loads: {error}") from None
    return rest - sign * scale / values, pencil.full(vectors)


def value_of(found: Found, i: int) -> Value:
    """Load number ``i`` from 0."""
    return Value(float(found.forces[i]), float(found.errors[i]))
