"""Paths in the parameters that are given as functions: what compiled loops evaluate is the function."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell.numerics.equilibria.family import on_path
from rodwell.numerics.equilibria.series import series_path


def function(t: float) -> np.ndarray:
    return np.array([np.exp(t), np.cos(3.0 * t), 0.3, t])


def rate(t: float) -> np.ndarray:
    return np.array([np.exp(t), -3.0 * np.sin(3.0 * t), 0.0, 1.0])


@pytest.fixture(scope="module")
def path() -> np.ndarray:
    found = series_path(function, -0.5, 2.0)
    assert found is not None
    return found


@pytest.mark.parametrize("t", [-0.5, -0.113, 0.77, 2.0])
def test_values_and_derivatives_are_those_of_the_function(path: np.ndarray, t: float) -> None:
    value, derivative = on_path(path, t)
    assert value == pytest.approx(function(t), rel=1e-13, abs=1e-13)
    assert derivative == pytest.approx(rate(t), rel=1e-11, abs=1e-11)


def test_what_is_constant_is_so_to_the_last_bit(path: np.ndarray) -> None:
    assert all(on_path(path, t)[0][2] == 0.3 and on_path(path, t)[1][2] == 0.0 for t in (-0.5, 0.2, 1.99, 2.4))


@pytest.mark.parametrize(("t", "end"), [(2.3, 2.0), (-0.9, -0.5)])
def test_beyond_its_ends_it_goes_on_straight(path: np.ndarray, t: float, end: float) -> None:
    value, derivative = on_path(path, t)
    assert value == pytest.approx(function(end) + rate(end) * (t - end), rel=1e-10)
    assert derivative == pytest.approx(rate(end), rel=1e-10, abs=1e-10)


def test_a_path_backwards_is_the_same_path(path: np.ndarray) -> None:
    back = series_path(function, 2.0, -0.5)
    assert back is not None
    assert on_path(back, 0.4)[0] == pytest.approx(on_path(path, 0.4)[0], rel=1e-13)
    assert on_path(back, 0.4)[1] == pytest.approx(on_path(path, 0.4)[1], rel=1e-11, abs=1e-11)


def test_a_function_with_a_kink_has_no_series() -> None:
    assert series_path(lambda t: np.array([abs(t - 0.3)]), 0.0, 1.0) is None
