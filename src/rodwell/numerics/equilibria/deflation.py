"""Further equilibria at the same λ: Newton's method that is kept away from those that are known.

The gradient g is multiplied by M(c) = Π (1 + r²/‖c − cₖ‖²) over the known equilibria cₖ: it has the same zeros but for
these. The step of Newton's method for M g is that for g, times 1/(1 − M'δ/M): one factorisation of the same banded
Hessian, whatever is known. See P. E. Farrell, A. Birkisson, S. W. Funke, *SIAM J. Sci. Comput.* 37 (2015) A2026–A2045.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.outcome import Outcome
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines import banded
from rodwell.quantities.arrays import FloatArray

MOST_STEPS = 60
LONGEST = 0.5
"""Longest step, in the size of the coefficients."""

NEAR = 1e-3
"""A step, in the size of the coefficients, from which Newton's method goes on by itself."""

DISTINCT = 1e-3
"""Distance in the metric of the family (about radians) beyond which two equilibria at one λ are two."""


def deflated(family: Family, known: Sequence[FloatArray], c: FloatArray, lam: float) -> State | None:
    """Return an equilibrium at λ that is none of ``known`` (coefficients (n,)), sought from ``c``, or None.

    Known equilibria are those of ``family``'s space; images by reflections must be among them if they are not wanted.
    """
    c = c.copy()
    for _ in range(MOST_STEPS):
        energy, gradient, band = family.assemble(c, lam)
        if not np.isfinite(energy):
            return None
        step = _newton_step(family, gradient, band)
        share = sum(_pull(family, c - other, step) for other in known)
        step /= 1.0 - share if abs(1.0 - share) > 1e-8 else 1e-8
        size = float(np.max(np.abs(step))) / family.scale_c
        c += step * min(1.0, LONGEST / size)
        if size < NEAR:
            outcome, state, _ = family.at(c, lam)
            if state is None or outcome is not Outcome.CONVERGED:
                return None
            return state if all(family.distance(state.c - other, 0.0) > DISTINCT for other in known) else None
    return None


def _newton_step(family: Family, gradient: FloatArray, band: FloatArray) -> FloatArray:
    factors = family.held.restrict(band)
    banded.factorise(factors)
    step = np.zeros(gradient.size)
    step[family.held.free] = -family.held.gather(gradient)
    banded.solve(factors, step)
    return family.held.spread(step[family.held.free])


def _pull(family: Family, apart: FloatArray, step: FloatArray) -> float:
    """M'δ/M of one known equilibrium, at the difference ``apart`` from it, for r = 1 in the metric."""
    product = banded.multiply(family.space.slope_gram, apart) / family.slope_scale**2
    square = float(product @ apart)
    return -2.0 * float(product @ step) / (square * (1.0 + square))
