"""The helix without a wall in closed form: balance in space, and the energy stationary there.

A rod bent into the helix r = (ρ cos ks, ρ sin ks, cs), ρ²k² + c² = 1, that nothing touches and that has no weight,
carries a constant force along its axis; the part of moment balance around the axis gives N = −ck² − T₁k.
"""

from __future__ import annotations

import numpy as np
import pytest

from rodwell.physics.off_wall._density import hole_density
from rodwell.physics.off_wall.forces import in_space
from rodwell.physics.on_wall.parameters import COUNT, FORCE, TWIST
from rodwell.quantities.arrays import FloatArray

RADIUS, RATE = 0.02, 9.0
CASES = [(twist, sense) for twist in (0.0, 2.5) for sense in (1.0, -1.0)]


def helix(s: FloatArray, rate: float) -> tuple[FloatArray, FloatArray, float]:
    """x and y with three derivatives, (4, k) each, and c."""
    turns = np.array([rate**i for i in range(4)])[:, None]
    phase = rate * s + 0.5 * np.pi * np.arange(4)[:, None]
    return RADIUS * turns * np.cos(phase), RADIUS * turns * np.sin(phase), float(np.sqrt(1.0 - (RADIUS * rate) ** 2))


@pytest.mark.parametrize(("twist", "sense"), CASES)
def test_its_force_is_along_its_axis(twist: float, sense: float) -> None:
    s = np.linspace(0.0, 1.0, 41)
    x, y, c = helix(s, sense * RATE)
    force = -c * RATE**2 - twist * sense * RATE
    rod = in_space(x, y, np.full(s.size, force), twist, np.ones(s.size), np.zeros(s.size))
    assert np.max(np.abs(rod.n[:2])) < 1e-12 * abs(force)
    assert rod.n[2] == pytest.approx(force, rel=1e-13)
    assert rod.curvature == pytest.approx(RADIUS * RATE**2, rel=1e-13)


@pytest.mark.parametrize(("twist", "sense"), CASES)
def test_its_energy_is_stationary(twist: float, sense: float) -> None:
    """The first variation vanishes for a disturbance that leaves ends and tangents alone; not at another force."""
    points, weights = np.polynomial.legendre.leggauss(60)
    s, weights = 0.5 * (points + 1.0), 0.5 * weights
    x, y, c = helix(s, sense * RATE)
    bump = np.polynomial.Polynomial([0.0, 0.0, 1.0, -2.0, 1.0])  # s²(1 − s)²
    v1, v2 = bump.deriv(1)(s), bump.deriv(2)(s)

    def variation(force: float) -> float:
        own, none = np.zeros(COUNT), np.zeros(COUNT)
        own[FORCE], own[TWIST] = force, twist
        g = hole_density(s, x[0], x[1], x[2], y[1], y[2], own, none)[2]
        return float(weights @ (g[1] * v1 + g[2] * v2 + 0.7 * (g[3] * v1 + g[4] * v2)))

    force = -c * RATE**2 - twist * sense * RATE
    scale = abs(variation(1.1 * force))
    assert scale > 1e-4
    assert abs(variation(force)) < 1e-10 * scale
