"""The linear problem (64): second variation of the energy at the straight rod."""

from __future__ import annotations

import numpy as np

from rodwell.physics.on_wall._density import rod_density
from rodwell.quantities.arrays import FloatArray


def second_variation(places: FloatArray, parameters: FloatArray) -> FloatArray:
    """Factors (3, m) of y², y'², y''² in the second variation at y = 0, at ``places`` (m,).

    They are wₗ/Δ, N(s) = F + wₐ(s − 1) and 1: those of (64), read off the Hessian of the one energy density at both
    ends, since they are linear in s. The twisting moment and the curvature ω₃ do not enter.
    """
    first, last = (_diagonal(s, parameters) for s in (0.0, 1.0))
    return np.asarray(first[:, None] + (last - first)[:, None] * places)


def _diagonal(s: float, parameters: FloatArray) -> FloatArray:
    """Diagonal (3,) of the Hessian of the density at y = 0."""
    hessian = rod_density(s, 0.0, 0.0, 0.0, parameters, np.zeros_like(parameters))[-1]
    return np.diag(np.array(hessian, dtype=float))
