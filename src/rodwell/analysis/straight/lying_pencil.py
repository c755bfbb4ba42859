"""The second variation of a rod that lies on its wall, in a curved hole or where the clearance varies: K + F G."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.analysis.discrete.curved import along_rod
from rodwell.analysis.discrete.family import given_along, parameters, rod_model, spline_ends
from rodwell.numerics.equilibria import eigen
from rodwell.numerics.splines.banded import factorise
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.curved import model_of
from rodwell.physics.on_wall.parameters import COUNT
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray


def variation_factors(problem: Problem, space: SplineSpace) -> tuple[FloatArray, FloatArray]:
    """Hessian of the density at y = 0, (3, 3, m), without an end force, and by it.

    A straight hole of one clearance counts as a curved one, which it is among others along curves.
    """
    given = given_along(problem) if problem.ramps else along_rod(problem)
    assert given is not None
    rows = given(space.points)
    model = rod_model(problem) if problem.ramps else model_of(rows.T)
    at_rest, pushed = (hessian_at(space.points, rows, parameters(problem, force), model) for force in (0.0, 1.0))
    return at_rest, pushed - at_rest


def hessian_at(s: FloatArray, rows: FloatArray, p: FloatArray, model: Any = None) -> FloatArray:
    """Hessian of the density at y = 0 by y, y′, y″, (3, 3, m), at places (m,), in the hole given by ``rows`` there.

    ``model``: that of a curved hole, where none is given.
    """
    model = model_of(rows.T) if model is None else model
    hessian = model.density(s, np.zeros((3, s.size)), rows.T, p, np.zeros(COUNT))[-1]
    return np.array([[np.broadcast_to(x, s.shape) for x in row] for row in hessian], dtype=float)


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


class Pencil:
    """K and G of a rod that lies on its wall, on a mesh, restricted to what the ends leave free."""

    def __init__(self, problem: Problem, space: SplineSpace) -> None:
        self.space = space
        self.held = spline_ends(problem).among(space.size)
        self.factors = variation_factors(problem, space)
        self.k, self.g = (self.held.free_part(_band(space, f)) for f in self.factors)
        self.slopes = self.held.free_part(space.slope_gram)

    def full(self, block: FloatArray) -> FloatArray:
        """Vectors (k, n) with what is held, (k, size)."""
        return np.array([self.held.spread(free) for free in block])

    def gram(self, factors: FloatArray, block: FloatArray) -> FloatArray:
        """Matrix (k, k) of a form for vectors (k, n), from values at the points: squares do not cancel."""
        values = self.space.at_points(self.full(block))
        weighted = np.einsum("dfm,kfm->kdm", factors * self.space.weights, values)
        return np.asarray(np.einsum("kdm,ldm->kl", weighted, values))

    def unstable(self, force: float) -> int:
        """How many directions are unstable at an end force."""
        return int(factorise(self.k + force * self.g))

    def softest(self, force: float, count: int = 1) -> tuple[FloatArray, FloatArray]:
        """Lowest eigenvalues (count,) of K + F G against (1 + |F|)∫v′², rising, and their vectors (count, n)."""
        band = self.k + force * self.g
        size = 1.0 + abs(force)  # eigenvalues of about 1: changes are judged against that
        whole, slope = self.factors[0] + force * self.factors[1], np.zeros_like(self.factors[0])
        slope[1, 1] = size

        def quadrature(block: FloatArray) -> tuple[FloatArray, FloatArray]:
            return self.gram(whole, block), self.gram(slope, block)

        gram = size * self.slopes
        values, vectors = eigen.lowest(band, gram, quadrature, count, below_all(band, gram), None)
        return values[:count], vectors[:count]

    def along(self, vector: FloatArray) -> tuple[float, float]:
        """Both forms, vKv and vGv, of one vector (n,)."""
        k, g = (float(self.gram(factors, vector[None])[0, 0]) for factors in self.factors)
        return k, g


def below_all(stiffness: FloatArray, gram: FloatArray) -> float:
    """A negative number below all eigenvalues of K v = λ G v."""
    below = -1.0
    while eigen.count_below(stiffness, gram, below) > 0:
        below *= 2.0
    return below
