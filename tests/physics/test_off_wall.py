"""The energy off the wall: generated from its symbols, equal to that on the wall, and in balance in space."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell.physics.off_wall import _density, parameters
from rodwell.physics.off_wall._density import hole_density
from rodwell.physics.off_wall.forces import radially_at_wall
from rodwell.physics.off_wall.linear import torque_density, turned_curvature
from rodwell.physics.on_wall import parameters as wall
from rodwell.physics.on_wall._density import rod_density

angles = st.floats(-3.0, 3.0)
rates = st.floats(-20.0, 20.0)


def test_density_is_generated_from_its_symbols() -> None:
    energy = pytest.importorskip("rodwell.physics.off_wall.energy")
    assert Path(_density.__file__).read_text(encoding="utf-8") == energy.generate()


def test_parameters_stand_in_the_order_of_those_on_the_wall() -> None:
    assert wall.PARAMETERS[: len(parameters.PARAMETERS)] == parameters.PARAMETERS


@settings(max_examples=60, deadline=None)
@given(angles, rates, st.floats(-300.0, 300.0), st.floats(0.0, 1.0), st.floats(-8.0, 8.0))
def test_on_the_wall_both_densities_are_equal(phi: float, phi1: float, phi2: float, s: float, twist: float) -> None:
    """x = −Δ cos φ, y = Δ sin φ in the energy off the wall is the energy on it, point by point, torque included."""
    d, values = 0.01, np.array([-123.0, 7.0, 13.0, 0.01, twist])
    sin, cos = np.sin(phi), np.cos(phi)
    x, x1, x2 = -d * cos, d * sin * phi1, d * (cos * phi1**2 + sin * phi2)
    y1, y2 = d * cos * phi1, d * (-sin * phi1**2 + cos * phi2)
    off = hole_density(s, x, x1, x2, y1, y2, values, np.zeros(5))[0]
    on = rod_density(s, d * phi, d * phi1, d * phi2, np.concatenate([values, [1.0, 0.0]]), np.zeros(7))[0]
    scale = 0.5 * (x2**2 + y2**2) + 123.0 * (x1**2 + y1**2) + abs(twist) * d**2 * phi1**2 * abs(phi1) + 0.13
    assert off == pytest.approx(on, abs=1e-13 * scale)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(-0.6, 0.6), min_size=2, max_size=2), st.lists(st.floats(-5.0, 5.0), min_size=2, max_size=2))
def test_derivatives_are_those_of_the_energy(slopes: list[float], bends: list[float]) -> None:
    values, along = np.array([-50.0, 3.0, 5.0, 0.05, 1.5]), np.array([1.0, 0.2, -0.3, 0.0, 0.7])
    u = np.array([0.01, slopes[0], bends[0], slopes[1], bends[1]])

    def all_at(v: np.ndarray, p: np.ndarray) -> tuple:
        return hole_density(0.3, *v, p, along)

    _, rate, gradient, mixed, hessian = all_at(u, values)
    h = 1e-6
    for i in range(5):
        step = h * np.eye(5)[i]
        up, down = all_at(u + step, values), all_at(u - step, values)
        assert (up[0] - down[0]) / (2 * h) == pytest.approx(gradient[i], rel=1e-6, abs=1e-5)
        if i:
            change = (np.array(up[2]) - np.array(down[2]))[1:] / (2 * h)
            assert change == pytest.approx(np.array(hessian[i - 1], dtype=float), rel=1e-6, abs=1e-4)
    up, down = all_at(u, values + h * along), all_at(u, values - h * along)
    assert (up[0] - down[0]) / (2 * h) == pytest.approx(rate, rel=1e-7, abs=1e-7)
    assert (np.array(up[2]) - np.array(down[2])) / (2 * h) == pytest.approx(np.array(mixed), rel=1e-6, abs=1e-6)


def test_radial_moment_and_force_at_the_wall_are_derivatives_of_the_energy_off_it() -> None:
    """Differences along φ = 0.3 + 4s − 7s² + 5s³ about s = 0, where the hole is turned so that φ = 0."""
    d, b, twist, h = 0.2, 0.6, 3.0, 1e-5
    values = np.array([-123.0, 7.0, 0.0, d, twist]) / b
    values[3] = d

    def derivatives(s: float) -> tuple[np.ndarray, np.ndarray]:
        """∂e/∂u′ and ∂e/∂u″."""
        phi, phi1, phi2 = 4.0 * s - 7.0 * s**2 + 5.0 * s**3, 4.0 - 14.0 * s + 15.0 * s**2, -14.0 + 30.0 * s
        sin, cos = np.sin(phi), np.cos(phi)
        x, x1, x2 = -d * cos, d * sin * phi1, d * (cos * phi1**2 + sin * phi2)
        y1, y2 = d * cos * phi1, d * (-sin * phi1**2 + cos * phi2)
        g = hole_density(s, x, x1, x2, y1, y2, values, np.zeros(5))[2]
        return b * np.array([g[1], g[3]]), b * np.array([g[2], g[4]])

    first, second = derivatives(0.0)
    shear = first - (derivatives(h)[1] - derivatives(-h)[1]) / (2.0 * h)
    out, around = np.array([-1.0, 0.0]), np.array([0.0, 1.0])
    at = radially_at_wall(np.array([4.0, 4.0 + h, 4.0 - h]), np.full(3, -14.0), np.full(3, d), twist, np.full(3, b))
    assert at[0][0] == pytest.approx(second @ out, rel=1e-12)
    assert at[1][0] == pytest.approx((at[0][1] - at[0][2]) / (2.0 * h), rel=1e-8)
    assert -at[2][0] == pytest.approx(shear @ out + 4.0 * second @ around, rel=1e-7)


@given(st.tuples(rates, rates, rates, rates), st.floats(-8.0, 8.0))
def test_bending_and_torque_are_the_square_of_a_turned_curvature(fields: tuple[float, ...], twist: float) -> None:
    """|u″ + ½iT₁u′|² = |u″|² + T₁(x′y″ − y′x″) + ¼T₁²|u′|², with u = x + iy."""
    x1, y1, x2, y2 = fields
    slope, bend = np.array([x1 + 1j * y1]), np.array([x2 + 1j * y2])
    square = x2**2 + y2**2 + twist * (x1 * y2 - y1 * x2) + 0.25 * twist**2 * (x1**2 + y1**2)
    assert np.abs(turned_curvature(slope, bend, twist)) ** 2 == pytest.approx(square, rel=1e-12, abs=1e-11)
    assert torque_density(slope, bend) == pytest.approx(x1 * y2 - y1 * x2, rel=1e-14, abs=1e-14)
