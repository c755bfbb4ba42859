"""States: equilibria on one mesh, with tangent, stability index and symmetry."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray

EQUAL_COEFFICIENTS = 1e-15
"""Coefficients that differ by no more are equal: a state may be zero up to this."""


SYMMETRIC = 1e-5
"""Largest asymmetry, relative to the largest coefficient, of a state that counts as symmetric."""


@dataclass(frozen=True)
class State:
    """An equilibrium: coefficients ``c`` on ``space`` at parameter λ, with tangent and stability index.

    ``tangent`` (n,) and ``tangent_lam`` have length one in the metric of the family; ``row`` (n,) and ``row_lam``
    are their covector. ``index`` is the number of negative eigenvalues of the Hessian.
    """

    space: SplineSpace
    c: FloatArray
    lam: float
    tangent: FloatArray
    tangent_lam: float
    row: FloatArray
    row_lam: float
    index: int
    energy: float

    def __repr__(self) -> str:
        return f"<State at {self.lam:.10g} on {self.space.elements} elements, index {self.index}>"

    @property
    def symmetry(self) -> int:
        """1 if the state is even about the middle, −1 if odd (up to a constant: a coil), 0 if neither."""
        return self.symmetry_within(SYMMETRIC)

    def symmetry_within(self, tolerance: float) -> int:
        """Symmetry up to a part ``tolerance`` of the largest coefficient; the mesh must be symmetric."""
        sizes = np.abs(self.c)
        largest = sizes.argmax()
        size = tolerance * float(sizes[largest]) + EQUAL_COEFFICIENTS
        for parity in (1, -1):
            apart = self.c - self.symmetrised(parity)
            if abs(apart[largest]) <= 0.5 * size and np.abs(apart).max() <= 0.5 * size:  # mostly, one tells enough
                return parity
        return 0

    def symmetrised(self, parity: int) -> FloatArray:
        """Coefficients of the even (1) or odd (−1) part; of a coil, odd about its middle."""
        return _part(self.c, parity)

    def reversed(self) -> State:
        """Return the same state with the opposite direction of travel."""
        return replace(self, tangent=-self.tangent, tangent_lam=-self.tangent_lam, row=-self.row, row_lam=-self.row_lam)

    def along(self, other: State) -> float:
        """Return the distance to ``other`` along the tangent of this state (same space)."""
        return float(self.row @ (other.c - self.c) + self.row_lam * (other.lam - self.lam))


def _part(c: FloatArray, parity: int) -> FloatArray:
    """The even (1) or odd (−1, up to a constant) part of coefficients."""
    middle = c[0] + c[-1] if parity < 0 else 0.0
    return 0.5 * (c + parity * c[::-1] + middle)
