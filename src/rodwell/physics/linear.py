"""The linear problem (64): second variation of the energy at the straight rod."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rodwell.jit import kernel
from rodwell.physics._kernels import rod_density

FloatArray = NDArray[np.float64]


def second_variation(places: FloatArray, parameters: FloatArray) -> FloatArray:
    """Factors (3, m) of y², y'², y''² in the second variation at y = 0, at ``places`` (m,).

    They are wₗ/Δ, N(s) = F + wₐ(s − 1) and 1: those of (64), read off the Hessian of the one energy density. The
    twisting moment and the curvature ω₃ do not enter.
    """
    return np.asarray(_diagonals(places, parameters))


@kernel
def _diagonals(places, parameters):  # type: ignore[no-untyped-def]
    """Diagonal (3, m) of the Hessian of the density at y = 0."""
    gradient, mixed, hessian = np.empty(3), np.empty(3), np.empty((3, 3))
    straight, rates = np.zeros(3), np.zeros(parameters.size)
    out = np.empty((3, places.size))
    for i in range(places.size):
        rod_density(places[i], straight, parameters, rates, gradient, hessian, mixed)
        for d in range(3):
            out[d, i] = hessian[d, d]
    return out
