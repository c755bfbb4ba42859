"""Least Rayleigh quotient of a banded symmetric pencil on a cone: where some linear functions are not negative.

Inverse iteration with a sign condition: z ← the minimum of ½z·(K − σG)z − z·Gz₀ with Cz ≥ 0, for a σ below all
eigenvalues. The problem is convex; its multipliers solve a small linear complementarity problem, found by non-negative
least squares among the places that matter, which are collected as they are violated. The quotient falls in every step:
z·Gz ≥ 2z·Gz₀ − z₀·Gz₀. So it goes to a stationary value. That no other one is lower is not proved; starts should be
many.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rodwell.numerics.splines.banded import factorise, multiply, solve
from rodwell.quantities.arrays import FloatArray, IntArray

MOST_STEPS = 400
MOST_ROUNDS = 60
SETTLED = 1e-12
VIOLATED = 1e-10
"""Of the largest value of the functions: more than that below zero counts."""

JITTER = 1e-13


@dataclass
class OneSided:
    """The cone and the shifted matrix.

    Attributes
    ----------
    stiffness, gram
        Bands of K and G, (n, width).
    rows
        C: values of the functions, (m, n), places in order, so that neighbours are neighbours.
    shift
        σ.
    """

    stiffness: FloatArray
    gram: FloatArray
    rows: FloatArray
    shift: float
    _factors: FloatArray = field(init=False)
    _columns: dict[int, FloatArray] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self._factors = self.stiffness - self.shift * self.gram
        if factorise(self._factors) > 0:
            raise ValueError("the shift lies above an eigenvalue")

    def lowest(
        self, start: FloatArray, quotient: Callable[[FloatArray], float], settled: float = SETTLED
    ) -> tuple[float, FloatArray, IntArray, FloatArray]:
        """Stationary quotient from ``start`` (n,), its vector, places that are active, and their multipliers.

        ``settled`` is the relative change of the quotient that ends the iteration.
        The multipliers are those of Kz − λGz = Cᵀm for the vector as it is returned, with z·Gz = 1.
        """
        z, last, places = start, np.inf, np.zeros(0, dtype=np.int64)
        value, forces = np.inf, np.zeros(0)
        for _ in range(MOST_STEPS):
            pushed = np.asarray(multiply(self.gram, z))
            pushed /= np.sqrt(z @ pushed)
            z, places, forces = self._pushed(pushed, places)
            value = quotient(z)
            if abs(last - value) <= settled * (abs(value) + 1.0):
                break
            last = value
        size = float(np.sqrt(z @ np.asarray(multiply(self.gram, z))))
        return value, z / size, places, forces / size

    def _pushed(self, load: FloatArray, places: IntArray) -> tuple[FloatArray, IntArray, FloatArray]:
        """The minimum for a right side; starting from places that were active."""
        from scipy.optimize import nnls  # noqa: PLC0415 - takes a tenth of a second to import

        free = load.copy()
        solve(self._factors, free)
        forces = np.zeros(places.size)
        z = free
        for _ in range(MOST_ROUNDS):
            if places.size:
                columns = np.array([self._column(k) for k in places])
                response = columns @ self.rows[places].T
                response = 0.5 * (response + response.T)
                response[np.diag_indices(places.size)] *= 1.0 + JITTER * places.size
                root = np.linalg.cholesky(response + JITTER * np.trace(response) * np.eye(places.size) / places.size)
                forces, _ = nnls(root.T, -np.linalg.solve(root, self.rows[places] @ free), maxiter=100 * places.size)
                z = free + forces @ columns
            values = self.rows @ z
            low = -VIOLATED * float(np.max(np.abs(values)) + 1e-300)
            padded = np.concatenate([[np.inf], values, [np.inf]])
            least = (values < low) & (values <= padded[:-2]) & (values <= padded[2:])
            new = np.setdiff1d(np.flatnonzero(least), places)
            if not new.size:
                break
            kept = forces > 0.0
            order = np.argsort(np.concatenate([places[kept], new]))
            places = np.concatenate([places[kept], new])[order]
        kept = forces > 0.0
        return z, places[kept] if places.size else places, forces[kept] if places.size else forces

    def _column(self, place: int) -> FloatArray:
        """(K − σG)⁻¹ times a row of C."""
        if place not in self._columns:
            column = self.rows[place].copy()
            solve(self._factors, column)
            self._columns[place] = column
        return self._columns[place]
