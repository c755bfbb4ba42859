"""The linear problem (64): second variation of the energy at the straight rod."""

from __future__ import annotations

import numpy as np

from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.sections import section_density
from rodwell.quantities.arrays import FloatArray


def second_variation(places: FloatArray, parameters: FloatArray, given: FloatArray | None = None) -> FloatArray:
    """Factors (3, m) of y², y'², y''² in the second variation at y = 0, at ``places`` (m,).

    They are wₗ/Δ, N(s) = F + wₐ(s − 1) and 1: those of (64), read off the Hessian of the one energy density at both
    ends, since they are linear in s. The twisting moment and the curvature ω₃ do not enter. Of a string, ``given``
    (m, 3) are the data of the sections in which the places lie: wₗ and N are theirs, and the last is b.
    """
    if given is not None and given.shape[1]:
        none = np.zeros_like(places)
        hessian = section_density(places, none, none, none, given.T, parameters, np.zeros_like(parameters))[-1]
        return np.array([np.broadcast_to(hessian[k][k], places.shape) for k in range(3)], dtype=float)
    first, last = (_diagonal(s, parameters) for s in (0.0, 1.0))
    return np.asarray(first[:, None] + (last - first)[:, None] * places)


def _diagonal(s: float, parameters: FloatArray) -> FloatArray:
    """Diagonal (3,) of the Hessian of the density at y = 0."""
    hessian = rod_density(s, 0.0, 0.0, 0.0, parameters, np.zeros_like(parameters))[-1]
    return np.diag(np.array(hessian, dtype=float))
