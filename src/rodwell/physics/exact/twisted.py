"""Weightless twisted rod without a wall: critical loads as roots of elementary functions, and Greenhill's formula.

u⁗ + iT₁u‴ + Pu″ = 0, P = −F, is solved by 1, s and exp(ik₁s), exp(ik₂s) with k₁,₂ = −½T₁ ± K, K² = P + ¼T₁². With s
counted from mid-length, modes of equal ends are u = a + ibs + c exp(ik₁s) + d exp(ik₂s) with real a, b, c, d. Two of
the four conditions at s = ½ give a and b; what is left is a determinant in K, which has a trivial factor k₁²k₂², taken
out here:

    clamped    D = k₁ S(k₂) H(k₁) − k₂ S(k₁) H(k₂) = 0,                  S(k) = sin(k/2)/k,
    ball       K D + 4 S(k₁) S(k₂) = 0,                                   H(k) = (k cos(k/2) − 2 sin(k/2))/k³.

A string with one condition more than its ends' (see :mod:`rodwell.physics.off_wall.linear`) has one eigenvalue between
neighbours of the string without: K between nπ and (n + 1)π, n from 1 if clamped, from 0 if ball. So no root is missed.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from rodwell.physics.exact.horizontal import horizontal_loads

SERIES = 0.05
"""Below this H is summed as a series."""


def critical_twist() -> float:
    """The twist T₁ = 2 · 4.4934…, at which a clamped weightless rod buckles.

    T₁/2 is the first positive root of tan x = x; T₁ is the wavenumber of the second mode of a clamped column.
    """
    return math.sqrt(-horizontal_loads(0.0, 2)[1])


def greenhill_load(twist: float) -> float:
    """F = ¼T₁² − π²: both ends ball joints, T₁ about the fixed axis at both (A. G. Greenhill, *Proc. IMechE* 1883).

    That torque is not the one of :func:`twisted_loads`, which needs less: it has no potential at one end alone.
    """
    return 0.25 * twist**2 - math.pi**2


def twisted_loads(twist: float, count: int = 1, ends: str = "clamped") -> list[float]:
    """Critical end forces of the weightless rod without a wall, falling, in B/L²; each belongs to two modes.

    Parameters
    ----------
    twist
        T₁ in B/L, either sign.
    count
        How many.
    ends
        Both ends "clamped", or "ball": position held, slopes free, semi-tangential torque.
    """
    determinant: Callable[[float, float], float] = {"clamped": _clamped, "ball": _ball}[ends]
    half, first = 0.5 * abs(twist), {"clamped": 1, "ball": 0}[ends]

    def root(n: int) -> float:
        """K between nπ and (n + 1)π; at mπ the sign is that of (−1)ᵐ, or the root is there."""
        low, high, rising = n * math.pi, (n + 1) * math.pi, n % 2 == 1
        while low < 0.5 * (low + high) < high:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if (determinant(half, middle) > 0.0) == rising else (middle, high)
        return 0.5 * (low + high)

    return [(half - k) * (half + k) for k in (root(n) for n in range(first, first + count))]


def _clamped(half: float, k: float) -> float:
    k1, k2 = k - half, -k - half
    return k1 * _sine(k2) * _rest(k1) - k2 * _sine(k1) * _rest(k2)


def _ball(half: float, k: float) -> float:
    k1, k2 = k - half, -k - half
    return k * _clamped(half, k) + 4.0 * _sine(k1) * _sine(k2)


def _sine(k: float) -> float:
    """sin(k/2)/k."""
    return 0.5 if k == 0.0 else math.sin(0.5 * k) / k


def _rest(k: float) -> float:
    """(k cos(k/2) − 2 sin(k/2))/k³ = −1/12 + k²/480 − …."""
    if abs(k) > SERIES:
        return (k * math.cos(0.5 * k) - 2.0 * math.sin(0.5 * k)) / k**3
    x = k * k
    return -1.0 / 12.0 + x / 480.0 - x * x / 53760.0 + x**3 / 11612160.0
