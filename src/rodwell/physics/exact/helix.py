"""Coiled rods in closed form: the weightless helix, and energies of long coils of given turns.

Units B = 1, lengths in any unit; ``radius`` is Δ, the distance between the axes. P = −F is compression.
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Helix(NamedTuple):
    """A uniform helix y' = sin η in equilibrium on a cylinder of radius Δ, weightless, free to turn about it.

    Attributes
    ----------
    force
        End force F = −(2B/Δ²) sin²η cos η, tension positive: ends need not be held from turning about the cylinder.
    pressure
        Contact pressure p = −B sin⁴η/Δ³ per length; p < 0 presses on the wall around the rod.
    rate
        Angle wound per length of the rod, sin η/Δ.
    energy
        Bending energy per length of the rod, B sin⁴η/(2Δ²).
    """

    force: float
    pressure: float
    rate: float
    energy: float


STEEPEST = math.asin(math.sqrt(2.0 / 3.0))
"""η of the largest compression that a helix bears, 4/(3√3) B/Δ² = 0.7698 B/Δ²."""


def weightless_helix(eta: float, radius: float) -> Helix:
    """Weightless helix whose tangent makes the angle η with the cylinder's axis, |η| < π/2.

    The energy per length ½ sin⁴η/Δ² + F(1 − cos η) is stationary in η for a rod free to wind: the force. For small η
    the load is F = −2θ'² with the rate θ' (A. Lubinski and H. Woods: pitch π√(8B/P)), the pressure −ΔP²/(4B).
    """
    square = math.sin(eta) ** 2
    return Helix(
        -2.0 * square * math.cos(eta) / radius**2, -(square**2) / radius**3, math.sin(eta) / radius,
        0.5 * square**2 / radius**2,
    )  # fmt: skip


LARGEST = 2.0 / math.sqrt(27.0)
"""Largest u √(1 − u), reached at u = 2/3."""


def sine_squared(load: float) -> float:
    """Return u = sin²η of the weightless helix under the compression P, from load = ½PΔ²/B = u √(1 − u).

    It is the smaller root, that of the stable helix; ``load`` must lie from 0 to ``LARGEST``.
    """
    # u³ − u² + load² = 0: the middle one of three real roots, by the cosine of a third of an angle; for small loads
    # that loses digits, which steps of Newton's method bring back
    angle = math.acos(max(-1.0, min(1.0, 1.0 - 13.5 * load**2)))
    u = 1.0 / 3.0 + 2.0 / 3.0 * math.cos(angle / 3.0 + 4.0 * math.pi / 3.0)
    for _ in range(2 if u < 0.6 else 0):
        u -= (u * math.sqrt(1.0 - u) - load) * math.sqrt(1.0 - u) / (1.0 - 1.5 * u)
    return u


def helix_shortening(load: float) -> float:
    """Return the integral of 1 − cos η over compression from 0 to P, in B/Δ², for load = ½PΔ²/B.

    A weightless helix whose compression P falls linearly along it, by w per length, is shorter by the integral over w.
    With d = 1 − cos η and P = (2B/Δ²) sin²η cos η it is 2(d² − 2d³ + ¾d⁴); for small slopes P²Δ⁴/(8B²), whence the
    Δ²P²/(8Bw) of A. Lubinski, W. S. Althouse and J. L. Logan, *J. Petroleum Technology* 14 (1962) 655.
    """
    u = sine_squared(load)
    d = u / (1.0 + math.sqrt(1.0 - u))
    return 2.0 * d**2 * (1.0 - 2.0 * d + 0.75 * d**2)


def coil_energy(rate: float, force: float, lateral_weight: float, radius: float) -> float:
    """Energy per length of a rod wound uniformly at ``rate`` (rad per length), relative to the straight rod.

    e = ½ sin⁴η/Δ² + Δwₗ + F(1 − cos η), sin η = Δq; for small slope ½Δ²q⁴ + Δwₗ + ½FΔ²q². On the mean over whole turns
    the rod is lifted by Δ. It is an upper bound of the least energy of a coil with pinned ends and whole turns,
    since the uniform helix is one of the shapes that such a rod can take; without lateral weight it is the
    equilibrium. Clamped ends cost more, by an amount that is small against the total for a long coil.
    """
    sine = radius * rate
    return 0.5 * sine**4 / radius**2 + radius * lateral_weight + force * _one_minus_cosine(sine)


def equal_energy_load(rate: float, lateral_weight: float, radius: float, *, small_slope: bool = False) -> float:
    """End force F at which a uniformly wound long rod has the energy of the straight one, tension positive.

    In the limit of small slope −F = q² + 2wₗ/(Δq²) (``small_slope``); n turns on the length L have q = 2πn/L, which
    gives the finite formula −F = 4π²n²B/L² + wₗL²/(2π²n²Δ) of Y.-C. Chen, Y.-H. Lin and J. B. Cheatham (*J. Petroleum
    Technology* 42 (1990) 140). An energy-equality (Maxwell) load, no bifurcation.
    """
    if small_slope:
        return -(rate**2 + 2.0 * lateral_weight / (radius * rate**2))
    return -coil_energy(rate, 0.0, lateral_weight, radius) / _one_minus_cosine(radius * rate)


def least_equal_energy_load(lateral_weight: float, radius: float) -> tuple[float, float]:
    """Equal-energy load of the best winding of a long rod, small slope: F = −2√2 √(wₗ/Δ), and its rate (2wₗ/Δ)^¼.

    It is √2 times the load −2√(wₗ/Δ) at which a long rod buckles sideways (Chen, Lin and Cheatham 1990).
    """
    b = lateral_weight / radius
    return -2.0 * math.sqrt(2.0 * b), (2.0 * b) ** 0.25


def _one_minus_cosine(sine: float) -> float:
    """1 − √(1 − x²) without cancellation."""
    return sine**2 / (1.0 + math.sqrt(1.0 - sine**2))
