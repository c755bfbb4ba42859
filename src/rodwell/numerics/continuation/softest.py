"""Watching the softest eigenvalues along a branch: one that dips through zero and back between two points is seen.

Counting negative eigenvalues at the points of a branch misses two changes that undo each other within a step. Such an
eigenvalue comes close to zero at the points around; where its course could reach zero, places in between are counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rodwell.compiling.kernels import kernel
from rodwell.numerics.continuation.location import LocationError, Segment
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.newton import dot, symmetrise
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.numerics.splines.banded import factorise, multiply, solve
from rodwell.numerics.splines.held import gather, spread
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray

FIRST_ITERATIONS, ITERATIONS = 8, 1
DEEP = 0.5
"""A minimum of the parabola through three values below this part of the middle one may be a dip through zero."""

BETWEEN = (0.2, 0.4, 0.6, 0.8)
"""Places between two points at which the index is counted, as parts of the step."""


@dataclass
class SoftestEigenvalues:
    """Softest eigenvalues of even and odd variations (the two softest, on a mesh without symmetry) at each point."""

    vectors: FloatArray | None = None
    space: SplineSpace | None = None
    values: list[tuple[float, float]] = field(default_factory=list)
    places: list[float] = field(default_factory=list)

    def add(self, meshes: TwoMeshes, point: MeshedState, travelled: float, factors: FloatArray | None = None) -> None:
        """Take in the next point of the branch, ``travelled`` from the last.

        ``factors`` are those of the Hessian there on the coarse mesh, if they are known.
        """
        self.values.append(self._softest(meshes.coarse, point.coarse, factors))
        self.places.append((self.places[-1] if self.places else 0.0) + travelled)

    def forget(self, count: int) -> None:
        """Take the last points back."""
        del self.values[-count:], self.places[-count:]

    def dips(self) -> list[float]:
        """Where an eigenvalue may have passed zero and come back around the last point but one.

        In parts of the step after that point, or, with the other sign, of the step before it.
        """
        if len(self.values) < 3:
            return []
        before, here, after = self.places[-3:]
        found = (_dip((before - here, 0.0, after - here), values) for values in zip(*self.values[-3:], strict=True))
        return [place / (after - here if place > 0.0 else here - before) for place in found if place is not None]

    def _softest(self, family: Family, state: State, factors: FloatArray | None) -> tuple[float, float]:
        space = family.space
        iterations = ITERATIONS
        if self.vectors is None or self.space is not space:
            self.vectors, self.space = np.random.default_rng(0).standard_normal((2, space.size)), space
            iterations = FIRST_ITERATIONS
        if factors is None:
            factors = family.held.restrict(family.assemble(state.c, state.lam)[2])
            factorise(factors)
        gram, held, follows = family.mesh.gram, family.mesh.held, family.mesh.follows
        even, odd = softest(gram, held, follows, factors, space.symmetric, iterations, self.vectors)
        return float(even), float(odd)


@kernel
def softest(gram, held, follows, factors, symmetric, iterations, vectors):
    """Eigenvalues (2,) of H v = μ G v (G: ∫v'²) nearest to zero, by inverse iteration from ``vectors`` (2, n).

    ``factors`` are those of H, ``gram`` is the band of G; what is ``held`` and ``follows`` what is that of a
    :class:`rodwell.numerics.splines.records.Discretisation`. On a ``symmetric`` mesh the first value is that of
    even vectors and the second that of odd ones; otherwise the second vector is kept normal to the first. ``vectors``
    become the eigenvectors, of length one.
    """
    n = vectors.shape[1]
    values = np.zeros(2)
    for _ in range(iterations):
        for k in range(2):
            new = multiply(gram, vectors[k])
            length = np.sqrt(dot(vectors[k], new))
            gather(new, held, follows)
            for i in range(n):
                new[i] /= length
            solve(factors, new)
            spread(new, held, follows)
            if symmetric:
                symmetrise(new, 1 - 2 * k)
            elif k == 1:
                part = dot(vectors[0], multiply(gram, new))
                for i in range(n):
                    new[i] -= part * vectors[0, i]
            values[k] = length / dot(multiply(gram, vectors[k]), new)
            size = np.sqrt(dot(new, multiply(gram, new)))
            for i in range(n):
                vectors[k, i] = new[i] / size
    return values[0], values[1]


def _dip(place: Sequence[float], values: Sequence[float]) -> float | None:
    """Where the parabola through three values of one sign, the middle one nearest to zero, comes much nearer."""
    if not (min(values) > 0.0 or max(values) < 0.0):
        return None
    first, middle, last = (abs(value) for value in values)
    if middle > min(first, last):
        return None
    before, after = (middle - first) / (place[1] - place[0]), (last - middle) / (place[2] - place[1])
    bend = (after - before) / (place[2] - place[0])
    slope = before + bend * (place[1] - place[0])
    return -slope / (2.0 * bend) if bend > 0.0 and middle - slope * slope / (4.0 * bend) < DEEP * middle else None


def hidden_change(meshes_along: list[TwoMeshes], points: list[MeshedState], dips: Sequence[float]) -> bool:
    """Whether the index changes and changes back between the last three points of a branch.

    ``dips`` are places, as :meth:`SoftestEigenvalues.dips` gives them, at which to look besides.
    """
    for k, own in ((-3, [1.0 + dip for dip in dips if dip < 0.0]), (-2, [dip for dip in dips if dip > 0.0])):
        meshes, last = meshes_along[k + 1], points[k + 1]
        first = points[k] if meshes_along[k] is meshes else meshes.adopt(meshes_along[k], points[k])[1]
        if first is None or first.fine.index != last.fine.index:
            continue
        segment = Segment(meshes.coarse.with_exact_tangent(), first.coarse, last.coarse)
        for t in (*own, *BETWEEN):
            try:
                if segment(t).index != last.fine.index:
                    return True
            except LocationError:
                return True
    return False
