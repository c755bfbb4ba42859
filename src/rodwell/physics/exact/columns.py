"""Weightless column: critical loads of all pairs of end conditions in closed form."""

from __future__ import annotations

import math

from rodwell.physics.exact.horizontal import horizontal_loads, sine_loads


def weightless_loads(count: int, ends: tuple[str, str] = ("clamped", "clamped")) -> list[float]:
    """Critical end forces of the weightless rod, falling, in B/L² (paper, after (77); tension positive).

    Clamped: k = 2nπ for odd n-th modes and tan(k/2) = k/2 for the others, F = −k². Ends as in S. P. Timoshenko and
    J. M. Gere, *Theory of Elastic Stability*, 2nd ed. (1961), section 2.2. A free end bears no shear and lets the rod
    turn, so without weight it buckles as if the other end were alone: pinned–free and free–free have the rigid rod at
    F = 0 first. Where no end holds y, turning around the cylinder as a whole is left out.

    Parameters
    ----------
    count
        How many.
    ends
        End conditions at s = 0 and s = 1: "clamped", "pinned", "guided" or "free".
    """
    pair = frozenset(ends)
    if pair in ({"pinned", "free"}, {"free"}):
        return [0.0, *sine_loads(0.0, count)][:count]
    if pair in ({"clamped", "free"}, {"guided", "free"}, {"pinned", "guided"}):
        return sine_loads(0.0, count, 0.5)
    if pair in ({"clamped", "guided"}, {"pinned"}, {"guided"}):
        return sine_loads(0.0, count)
    return horizontal_loads(0.0, count, ends)


def infinite_load(lateral_weight: float, clearance: float) -> float:
    """Limit F = −2√(wₗ/Δ) of the loads (77) for a long or heavy rod at the bottom; no end force below it is reached.

    It is the load that well engineers use (R. Dawson and P. R. Paslay, *J. Petroleum Technology* 36 (1984) 1734).
    """
    return -2.0 * math.sqrt(lateral_weight / clearance)
