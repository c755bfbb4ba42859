"""Fig. 10: the determinant (86) of the vertical column under its own weight, with Airy and Scorer functions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.quantities.arrays import FloatArray

NODES = 32
"""Gauss points for the integral of Gi; it is smooth over at most seven units of t."""

ROOTS = ((60.0, 90.0), (140.0, 170.0), (310.0, 340.0))
"""Weights between which the first three roots lie."""

GI_ERROR = 1e-13
"""Relative error of Airy functions and their integrals over the range used."""


@dataclass(frozen=True)
class Determinant:
    """Data of Fig. 10.

    Attributes
    ----------
    weights, values
        γ and D(0, γ), (n,).
    roots
        First three roots.
    """

    weights: FloatArray
    values: FloatArray
    roots: tuple[float, ...]


def start(weight: float, *, printed: bool = False) -> float:
    """t₁ at F = 0, from t = (s − 1 + F/mg)(mg)^(1/3) at s = 0; or as printed below (86), which has the other sign."""
    size = float(np.cbrt(weight))
    return size if printed else -size


def airy(t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return Ai, Bi, Gi, ∫₀ᵗAi, ∫₀ᵗBi at ``t`` (n,); Gi from (84), with ∫ₜ^∞ Ai = 1/3 − ∫₀ᵗ Ai.

    The integrals are those of Gauss's rule: SciPy's own (``itairy``) have seven digits only.
    """
    from scipy import special  # noqa: PLC0415 - slow to import

    t = np.asarray(t, dtype=float)
    x, w = np.polynomial.legendre.leggauss(NODES)
    inside = special.airy(0.5 * t[:, None] * (x + 1.0))
    int_a, int_b = 0.5 * t * (inside[0] @ w), 0.5 * t * (inside[2] @ w)
    ai, _, bi, _ = special.airy(t)
    return ai, bi, bi * (1.0 / 3.0 - int_a) + ai * int_b, int_a, int_b


def determinant(weight: float, *, printed: bool = False) -> float:
    """D(0, γ) of (86): coefficients of Ai, Bi and Gi at both ends, and their integrals between them."""
    ends = np.array([start(weight, printed=printed), 0.0])
    ai, bi, gi, int_a, int_b = airy(ends)
    x, w = np.polynomial.legendre.leggauss(NODES)
    half = 0.5 * (ends[1] - ends[0])
    int_g = half * (w @ airy(ends[0] + half * (x + 1.0))[2])
    matrix = np.array([[ai[0], bi[0], gi[0]], [ai[1], bi[1], gi[1]], [int_a[1] - int_a[0], int_b[1] - int_b[0], int_g]])
    return float(np.linalg.det(matrix))


def root(number: int) -> tuple[float, float]:
    """Return the first, second or third zero of D(0, γ) and the estimate of its error."""
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    zero = float(brentq(determinant, *ROOTS[number - 1], xtol=1e-12, rtol=1e-14))
    step = 1e-3 * zero
    slope = (determinant(zero + step) - determinant(zero - step)) / (2.0 * step)
    return zero, abs(GI_ERROR / slope) + 1e-14 * zero


def bessel_root() -> float:
    """First zero of J_⅓(⅔√γ), (88)."""
    from scipy import special  # noqa: PLC0415 - slow to import
    from scipy.optimize import brentq  # noqa: PLC0415

    return float(brentq(lambda w: special.jv(1.0 / 3.0, 2.0 / 3.0 * np.sqrt(w)), 15.0, 25.0, xtol=1e-13, rtol=1e-15))


def data() -> Determinant:
    """D(0, γ) for γ up to 350."""
    weights = np.linspace(1.0, 350.0, 350)
    return Determinant(weights, np.array([determinant(w) for w in weights]), tuple(root(k)[0] for k in (1, 2, 3)))
