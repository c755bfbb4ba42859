"""Minima of the energy from poor starts: Newton's method, shifted until it goes downhill."""

from __future__ import annotations

import numpy as np

from rodwell.numerics.equilibria import newton
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.outcome import Outcome
from rodwell.numerics.splines import banded
from rodwell.quantities.arrays import FloatArray

SMALLEST_LENGTH = 1e-12

AT_THE_RIM = 1e-8
"""Largest change of a coefficient, relative to their size, of a step that is cut short only where the energy ends: the
minimum, if there is one, lies beyond the range of the model."""


def minimise(family: Family, c: FloatArray, lam: float, most_steps: int = 500) -> tuple[Outcome, FloatArray]:
    """Coefficients (n,) of a local minimum of the energy at fixed λ, found downhill from ``c`` (n,).

    Each step solves (H + σ G) δ = −g with the smallest σ ≥ 0 of a rising sequence that makes the matrix
    positive definite, and is halved until the energy falls (Armijo). It ends with an unshifted, full
    Newton step below the family's tolerance. See J. Nocedal and S. J. Wright, *Numerical Optimization* (2006),
    algorithms 3.2 and 3.3. Where the energy falls right up to the rim of the model's range, it ends there.
    """
    sigma = 0.0
    energy, gradient, band = family.assemble(c, lam)
    if not np.isfinite(energy):
        return Outcome.OUT_OF_RANGE, c
    for _ in range(most_steps):
        step, sigma = _downhill(family, gradient, band, 0.1 * sigma if sigma > 1e-3 else 0.0)
        size, slope = float(np.max(np.abs(step))) / family.scale_c, float(gradient @ step)
        length, outside = 1.0, False
        while True:
            new, gradient, band = family.assemble(c + length * step, lam)
            if np.isfinite(new) and (new <= energy + 1e-4 * length * slope or size < 1e-6):
                break
            length *= 0.5
            outside = outside or not np.isfinite(new)
            if length < SMALLEST_LENGTH:
                return Outcome.OUT_OF_RANGE if outside else Outcome.NOT_CONVERGED, c
        if outside and length * size < AT_THE_RIM:
            return Outcome.OUT_OF_RANGE, c
        c, energy = c + length * step, new
        if sigma == 0.0 and length == 1.0 and size <= family.tolerance:
            return Outcome.CONVERGED, c
    return Outcome.NOT_CONVERGED, c


def _downhill(family: Family, gradient: FloatArray, band: FloatArray, sigma: float) -> tuple[FloatArray, float]:
    """Newton step with the Hessian shifted, from ``sigma`` on, until it is positive definite; and the shift."""
    while True:
        factors = family.held.free_part(band + sigma * family.space.slope_gram)
        if banded.factorise(factors) == 0:
            break
        sigma = max(1.0, 4.0 * sigma)
    free = -family.held.gather(gradient)
    banded.solve(factors, free)
    step = family.held.spread(free)
    newton.symmetrise(step, family.parity)
    return step, sigma
