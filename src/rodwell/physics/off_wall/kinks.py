"""Kinks of the stiffness: the force of the wall on a buckled rod there, and the gap where it would have to pull.

Across the wall a rod in contact is bent by ω₃ = Δφ′², the moment b ω₃ goes on continuously at a kink, and the force
that is its derivative jumps: the wall exerts [b′] ω₃ towards the axis at a single place ([x]: x towards s = 1 less x
towards s = 0). Where the stiffness ceases to rise or begins to fall the wall would have to pull by P = −[b′] ω₃. There
a gap opens, as in a heavy beam that is lifted from a floor: symmetric about the kink, y = q(ax³/18 − x⁴/24)/b at the
distance x from either end, with the contact force q per length beside it and the length 2a = 3P/(2q), since 2·qa/3 is
pushed at the ends and 2aq − P is borne by them. P is of second order in the amplitude, the gap's height q a⁴/(72 b) of
its eighth: below a length at which the height is round-off of every number that is told of the state, it counts as
closed, and the force that pulls as part of the contact around it.
"""

from __future__ import annotations

import numpy as np

from rodwell.quantities.arrays import FloatArray

HEIGHT, LONGEST = 1e-11, 2e-3
"""Height in Δ, and length in L, below which a gap at a kink counts as closed."""

LEAST_PUSH = 1e-9
"""Contact force in B/L³ that counts as none."""

PER_FORCE = 1.5
"""Length of the gap over P/q."""


def shortest(clearance: float, stiffness: float, push: float) -> float:
    """The length in L from which on a gap at a kink counts, from Δ, b there and the contact force per length q."""
    return min(LONGEST, float((72.0 * 16.0 * HEIGHT * clearance * stiffness / max(push, LEAST_PUSH)) ** 0.25))


def length(pulled: float, push: float) -> float:
    """The length of the gap in L, from P and q; negative where the wall need not pull."""
    return PER_FORCE * pulled / max(push, LEAST_PUSH)


def rises(half: float, push: float, stiffness: float, middle: float, places: FloatArray) -> FloatArray:
    """The gap at a kink, of half length ``half``, with two derivatives at places (k,), in L, (3, k)."""
    x = half - np.abs(places - middle)
    out, inside, sense = np.zeros((3, places.size)), x > 0.0, -np.sign(places - middle)
    x, sense = x[inside], sense[inside]
    scale = push / stiffness
    out[0, inside] = scale * (half * x**3 / 18.0 - x**4 / 24.0)
    out[1, inside] = scale * sense * (half * x**2 / 6.0 - x**3 / 6.0)
    out[2, inside] = scale * (half * x / 3.0 - x**2 / 2.0)
    return out
