"""The two-field eigenproblem of the straight rod, λ = −F: ∫ b|u″|² + wₐ h|u′|² + T₁ Im(ū′u″) ds = λ ∫ |u′|² ds.

h = s − 1 and b = 1, or those of sections.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.errors import NotConvergedError
from rodwell.numerics.equilibria import eigen
from rodwell.numerics.splines import pair
from rodwell.numerics.splines.held import Ends, Held
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.off_wall.linear import square_factors, turned_curvature
from rodwell.problem.rod import Rod
from rodwell.quantities.arrays import ComplexArray, FloatArray

SLOPE = np.array([[0.0], [1.0], [0.0]])


@dataclass(frozen=True)
class Pencil:
    """The eigenproblem: axial weight wₐ in B/L², twist T₁ in B/L, what the ends hold of x and y, the rod's sections."""

    axial_weight: float
    twist: float
    x: Ends
    y: Ends
    rod: Rod | None = None

    @property
    def lift(self) -> float:
        """¼T₁²/b with the least b, by which eigenvalues are shifted to become those of a sum of squares."""
        least = 1.0 if self.rod is None else self.rod.stiffness_range[0]
        return 0.25 * self.twist**2 / least

    @property
    def hung_weight(self) -> float:
        """Axial weight of the whole rod."""
        return self.axial_weight if self.rod is None else self.axial_weight * self.rod.whole_weight

    def along(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """N at F = 0, and b, at places (m,)."""
        if self.rod is None:
            return self.axial_weight * (places - 1.0), np.ones_like(places)
        return self.axial_weight * self.rod.lever(places), self.rod.stiffness(places)

    def held(self, space: SplineSpace) -> Held:
        """What the ends hold among the 2n coefficients of both fields."""
        return pair.held_pair(self.x, self.y, space.size)

    def bands(self, space: SplineSpace) -> tuple[FloatArray, FloatArray]:
        """Bands (2n, 2p + 2) of the form shifted by ¼T₁², and of ∫|u′|² ds, before anything is held."""
        points = space.points
        stiffness = pair.pair_band(space, square_factors(*self.along(points), self.lift), self.twist)
        return stiffness, pair.pair_band(space, np.broadcast_to(SLOPE, (3, points.size)), 0.0)

    def grams(self, space: SplineSpace, block: ComplexArray) -> tuple[FloatArray, FloatArray]:
        """Matrices (k, k) of both forms (the first shifted) for functions (k, n), from squares at the points."""
        u = pair.derivatives(space, block)
        axial, b = self.along(space.points)
        slope, bend = u[:, 1], turned_curvature(u[:, 1], u[:, 2], self.twist / b)
        w = space.weights
        gram = (slope * w) @ slope.conj().T
        left = axial + (self.lift - 0.25 * self.twist**2 / b)
        weight = (slope * (w * left)) @ slope.conj().T
        return np.asarray(((bend * (w * b)) @ bend.conj().T + weight).real), np.asarray(gram.real)

    def quotient(self, space: SplineSpace, coefficients: ComplexArray) -> float:
        """λ of one function, its Rayleigh quotient."""
        stiffness, gram = self.grams(space, coefficients[None])
        return float(stiffness[0, 0] / gram[0, 0] - self.lift)

    def lowest(
        self, space: SplineSpace, count: int, start: tuple[FloatArray, FloatArray] | None
    ) -> tuple[FloatArray, ComplexArray]:
        """λ, rising, and complex coefficients (k, n); k ≥ ``count``, of which the first ``count`` have converged."""
        held = self.held(space)
        stiffness, gram = (held.free_part(band) for band in self.bands(space))

        def full(block: FloatArray) -> ComplexArray:
            return pair.as_complex(np.array([held.spread(free) for free in block]))

        def quadrature(block: FloatArray) -> tuple[FloatArray, FloatArray]:
            return self.grams(space, full(block))

        guess = None
        if start is not None:
            guess = start[0] + self.lift, np.ascontiguousarray(start[1][:, held.free])
        try:
            below = -max(self.hung_weight, 0.0) - 1.0  # the rest of the form is a square
            values, vectors = eigen.lowest(stiffness, gram, quadrature, count, below, guess)
        except eigen.EigenError as reason:
            raise NotConvergedError(f"loads without the wall: {reason}") from None
        return values - self.lift, full(vectors)
