"""The one energy: generated formulas against their source, and against the formula of the theory in plain NumPy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell.physics.on_wall import _density, energy
from rodwell.physics.on_wall.linear import second_variation
from rodwell.physics.on_wall.parameters import PARAMETERS

STATE = st.tuples(
    st.floats(0.0, 1.0),  # s
    st.floats(-0.05, 0.05),  # y
    st.floats(-0.7, 0.7),  # y'
    st.floats(-5.0, 5.0),  # y''
)
PARAMETER_SETS = st.tuples(
    st.floats(-500.0, 100.0),
    st.floats(0.0, 200.0),
    st.floats(-200.0, 200.0),
    st.floats(0.005, 0.1),
    st.floats(-5.0, 5.0),
).map(np.array)


def density(s: float, u: np.ndarray, p: np.ndarray) -> float:
    """e(s, y, y', y'') as written in the theory, less its value at y = 0 and the null Lagrangian T₁ ξ₂'."""
    force, axial, lateral, clearance, twist = p
    y, y1, y2 = u
    root = np.sqrt(1.0 - y1**2)
    axial_force = force + axial * (s - 1.0)
    full = (
        0.5 * y2**2 / (1.0 - y1**2)
        + 0.5 * y1**4 / clearance**2
        - clearance * lateral * np.cos(y / clearance)
        - axial_force * root
        + twist / clearance * y1 * (root - 1.0)
    )
    return full + clearance * lateral + axial_force


def derivatives(s: float, u: np.ndarray, p: np.ndarray, rates: np.ndarray) -> tuple[float, np.ndarray, ...]:
    value, rate, gradient, mixed, hessian = _density.rod_density(s, *u, p, rates)
    return value, np.array(gradient), np.array(hessian), np.array(mixed), rate


def test_formulas_are_those_that_the_symbolic_energy_generates() -> None:
    assert Path(_density.__file__).read_text(encoding="utf-8") == energy.generate()


@given(STATE, PARAMETER_SETS)
def test_value_is_the_density_of_the_theory(state: tuple[float, ...], p: np.ndarray) -> None:
    s, u = state[0], np.array(state[1:])
    value = derivatives(s, u, p, np.zeros(5))[0]
    size = 1.0 + abs(p[0]) + p[1] + abs(p[2]) + 25.0 + 1.0 / p[3] ** 2 + abs(p[4]) / p[3]
    assert value == pytest.approx(density(s, u, p), rel=1e-12, abs=1e-14 * size)


@given(STATE, PARAMETER_SETS)
def test_derivatives_agree_with_finite_differences(state: tuple[float, ...], p: np.ndarray) -> None:
    s, u = state[0], np.array(state[1:])
    _, gradient, hessian, _, _ = derivatives(s, u, p, np.zeros(5))
    for i, step in enumerate((1e-5 * p[3], 1e-6, 1e-5)):
        shift = np.zeros(3)
        shift[i] = step
        above, below = derivatives(s, u + shift, p, np.zeros(5)), derivatives(s, u - shift, p, np.zeros(5))
        slope = (density(s, u + shift, p) - density(s, u - shift, p)) / (2.0 * step)
        assert gradient[i] == pytest.approx(slope, rel=1e-5, abs=1e-3 / p[3])
        assert hessian[i] == pytest.approx((above[1] - below[1]) / (2.0 * step), rel=1e-6, abs=1e-3 / p[3])
    assert np.array_equal(hessian, hessian.T)


@pytest.mark.parametrize("which", range(5), ids=PARAMETERS[:5])
def test_mixed_derivative_follows_each_parameter(which: int) -> None:
    s, u, p = 0.3, np.array([0.011, 0.2, 1.7]), np.array([-150.0, 20.0, 12.0, 0.02, 0.8])
    rates = np.zeros(5)
    rates[which] = 1.0
    step = 1e-6 * max(abs(p[which]), 1e-2)
    above, below = derivatives(s, u, p + step * rates, rates)[1], derivatives(s, u, p - step * rates, rates)[1]
    assert derivatives(s, u, p, rates)[3] == pytest.approx((above - below) / (2.0 * step), rel=1e-7, abs=1e-6)
    value = [density(s, u, p + sign * step * rates) for sign in (1.0, -1.0)]
    assert derivatives(s, u, p, rates)[4] == pytest.approx((value[0] - value[1]) / (2.0 * step), rel=1e-6, abs=1e-6)


def test_small_values_keep_their_digits() -> None:
    """No cancellation: at y = 1e-9 the energy is its quadratic part, to all digits."""
    p = np.array([-100.0, 0.0, 15.0, 0.01, 0.0])
    u = 1e-9 * np.array([1.0, 3.0, 7.0])
    quadratic = 0.5 * (u[2] ** 2 - 100.0 * u[1] ** 2 + 1500.0 * u[0] ** 2)
    assert derivatives(0.5, u, p, np.zeros(5))[0] == pytest.approx(quadratic, rel=1e-12)


def test_second_variation_is_that_of_equation_64() -> None:
    """Factors wₗ/Δ, N(s), 1; neither T₁ nor ω₃ enters."""
    s = np.array([0.0, 0.25, 1.0])
    p = np.array([-7.0, 30.0, 12.0, 0.02, 4.0])
    assert second_variation(s, p) == pytest.approx(np.array([[600.0] * 3, -7.0 + 30.0 * (s - 1.0), [1.0] * 3]))
