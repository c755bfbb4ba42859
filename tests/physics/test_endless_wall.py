"""The endless rod on the wall: its curvature is that of the curve in space, and what compression does to a force."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell.physics.on_wall import endless

RATES, BENDS = np.array([0.3, -0.9, 1.4, 0.0]), np.array([0.7, 0.2, -1.1, 0.8])
"""θ' and θ''."""

SLOPES = (0.05, 0.4)
"""ε = D/ℓ."""


def tangent(x: complex, rate: float, bend: float, slope: float) -> np.ndarray:
    """How (ε cos θ, ε sin θ, z) changes with the arc length x, in ℓ, where θ = 0.2 + θ'x + ½θ''x²."""
    angle, turned = 0.2 + rate * x + 0.5 * bend * x * x, rate + bend * x
    around = slope * turned
    return np.array([-around * np.sin(angle), around * np.cos(angle), np.sqrt(1.0 - around * around)])


@pytest.mark.parametrize("slope", SLOPES)
def test_curvature_is_that_of_the_curve_in_space(slope: float) -> None:
    """By a complex step from the tangent; of a helix, θ'' = 0, it is θ'² in closed form."""
    step = 1e-30
    inside = [tangent(1j * step, *pair, slope).imag / step for pair in zip(RATES, BENDS, strict=True)]
    expected = np.linalg.norm(inside, axis=1) / slope  # in D/ℓ²
    assert endless.curvature(RATES, BENDS, slope) == pytest.approx(expected, rel=1e-13)
    assert endless.curvature(RATES, 0.0 * BENDS, slope) == pytest.approx(RATES**2, rel=1e-14)


@pytest.mark.parametrize("slope", SLOPES)
def test_compression_works_on_what_the_rod_is_shorter(slope: float) -> None:
    """The energy is linear in β, and so is its derivative by θ': a difference is the derivative by β."""
    fields = np.array([0.1 + RATES, RATES, BENDS])
    less, more = (endless.density(fields, beta, slope) for beta in (2.0, 5.0))
    assert endless.load_derivative(RATES, slope) == pytest.approx((more.by_rate - less.by_rate) / 3.0, rel=1e-12)
    axial = np.array([tangent(0.0, *pair, slope)[2] for pair in zip(RATES, BENDS, strict=True)]).real
    shorter = (1.0 - axial) / slope**2
    assert endless.shortening(RATES, slope) == pytest.approx(shorter, rel=1e-10)
    assert (less.energy - more.energy) / 3.0 == pytest.approx(shorter, rel=1e-10)
