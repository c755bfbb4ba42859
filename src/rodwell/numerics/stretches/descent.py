"""Downhill from a shape that is no equilibrium: implicit Euler steps on the gradient flow, behind a soft rim.

The disc's rim is a spring here, ½k(R − 1)² per length where R > 1: whatever touches it, and where, is found by the
flow, not prescribed. A minimum found like this is close to one behind the hard rim, as 1/k, and tells the pattern of
contact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rodwell.numerics.stretches.basis import reference_element
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.newton import Row, Solved, solve
from rodwell.quantities.arrays import FloatArray

FIRST_RATE, LOWEST_RATE, HIGHEST_RATE = 2e3, 1e-1, 1e9
"""Inverse step of time: the first, one at which the flow is like Newton's method, and one at which it gives up."""

FLOW_TOLERANCE = 1e-7
MOST_EULER_STEPS = 400


@dataclass(frozen=True)
class SoftRim:
    """A model behind a soft rim, pulled back towards a shape by the step of time.

    ``before`` holds the fields at the end of the last step, (2, e, q); ``rate`` the inverse of the step.
    """

    model: Any
    stiffness: float
    rate: float = 0.0
    before: FloatArray | None = None

    @property
    def load_per_length(self) -> float:
        """That of the model."""
        return float(self.model.load_per_length)

    def rim(self, s: FloatArray, u: FloatArray, load: float) -> tuple[FloatArray, ...]:
        """That of the model: on a hard rim nothing is added."""
        kept: tuple[FloatArray, ...] = self.model.rim(s, u, load)
        return kept

    def interior(self, s: FloatArray, u: FloatArray, load: float) -> tuple[FloatArray, ...]:
        """Density with rim and pull."""
        energy, by_load, gradient, mixed, hessian = self.model.interior(s, u, load)
        place = u[:, 0]
        radius = np.maximum(np.hypot(*place), 1e-12)
        inside = radius <= 1.0
        depth = np.where(inside, 0.0, radius - 1.0)
        energy = energy + 0.5 * self.stiffness * depth**2
        across = np.where(inside, 0.0, depth / radius)
        gradient[:, 0] += self.stiffness * across * place
        normal = place / radius
        hard = self.stiffness * np.where(inside, 0.0, 1.0 - across)
        for i in range(2):
            for j in range(2):
                hessian[i, 0, j, 0] += hard * normal[i] * normal[j] + (self.stiffness * across if i == j else 0.0)
        if self.before is not None and self.rate > 0.0:
            away = place - self.before
            energy = energy + 0.5 * self.rate * np.sum(away**2, axis=0)
            gradient[:, 0] += self.rate * away
            for i in range(2):
                hessian[i, 0, i, 0] += self.rate
        return energy, by_load, gradient, mixed, hessian


def _at_points(shape: Shape) -> FloatArray:
    """X and Y at the Gauss points, (2, e, q)."""
    a, _ = shape.local(shape.chain.free)
    return np.asarray(np.einsum("qi,kfi->fkq", reference_element(shape.chain.degree).table[0], a))


def descended(model: Any, shape: Shape, stiffness: float, row: Row, index: Callable[[Solved], int]) -> Solved | None:
    """The minimum of the energy behind a rim of this stiffness to which the flow leads from ``shape``, free everywhere.

    ``row`` is what is held on the way, and ``index`` the stability index where it is. None if the flow does not come to
    rest.
    """
    rim, rate = SoftRim(model, stiffness), FIRST_RATE
    for _ in range(MOST_EULER_STEPS):
        pulled = replace(rim, rate=rate, before=_at_points(shape))
        after = solve(pulled, shape, row, FLOW_TOLERANCE, 8)[1]
        if after is None or index(after) > 0:
            rate *= 4.0
            if rate > HIGHEST_RATE:
                return None
            continue
        shape = after.shape
        rate *= 0.5
        if rate < LOWEST_RATE:
            rest = solve(rim, shape, row)[1]
            if rest is not None and index(rest) == 0:
                return rest
            rate *= 64.0
    return None
