"""Small rules of the numerics: least values, differences, when Newton's method has settled, which cells are sought."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rodwell.numerics.continuation.walk import Trace
from rodwell.numerics.equilibria.cells import CELLS
from rodwell.numerics.equilibria.deflation import _pull
from rodwell.numerics.equilibria.differences import central_slope, one_sided_slope
from rodwell.numerics.equilibria.newton import _settles
from rodwell.numerics.stretches.minima import lowest


def test_least_values_of_smooth_functions_are_those_of_closed_forms() -> None:
    """cos x is least at π, a parabola at its vertex, a straight line at its end; of a constant every place will do."""
    samples = np.linspace(0.0, 1.0, 9) * np.array([[5.0], [2.0], [3.0], [1.0]])

    def values(x: np.ndarray) -> np.ndarray:
        return np.stack([np.cos(x[0]), (x[1] - 0.7) ** 2 - 0.25, 4.0 - x[2], np.full_like(x[3], 2.5)])

    least, where = lowest(values, samples)
    assert least == pytest.approx([-1.0, -0.25, 1.0, 2.5], abs=1e-9)
    assert where[:3] == pytest.approx([np.pi, 0.7, 3.0], abs=1e-5)


def test_newton_has_settled_when_its_next_step_would_be_round_off() -> None:
    """Steps fall like κ d²: from 10⁻² to 10⁻⁶ κ is 10⁻², and the next is 10⁻¹⁴; from 10⁻² to 10⁻⁵ it is 10⁻¹¹."""
    assert _settles(1e-6, 1e-2)
    assert not _settles(1e-5, 1e-2)
    assert not _settles(1e-6, 1e-7), "steps grow"
    assert not _settles(1e-6, 2.0), "far from where they fall like that"


def test_numbers_of_cells_are_all_powers_of_primes_up_to_their_largest() -> None:
    primes = [n for n in range(2, 32) if all(n % k for k in range(2, n))]
    assert list(CELLS) == sorted(p**k for p in primes for k in range(1, 6) if p**k < 32)


def test_differences_are_exact_for_polynomials_of_fourth_degree() -> None:
    """2 + 3x − x² + 5x³ − 4x⁴ and another: derivatives at 0 are 3 and −1, from either side."""

    def both(x: float) -> np.ndarray:
        return np.array([2.0 + 3.0 * x - x**2 + 5.0 * x**3 - 4.0 * x**4, 1.0 - x + 7.0 * x**4])

    assert central_slope(both, 0.1) == pytest.approx([3.0, -1.0], rel=1e-12)
    for h in (0.1, -0.1):
        assert one_sided_slope(both, h) == pytest.approx([3.0, -1.0], rel=1e-11)
    assert central_slope(math.exp, 0.1) == pytest.approx(1.0 - 0.1**4 / 30.0, abs=1e-7)
    assert one_sided_slope(math.exp, 0.01) == pytest.approx(1.0 - 0.01**4 / 5.0, abs=1e-10)


def test_deflation_pulls_by_the_derivative_of_its_factor() -> None:
    """M = 1 + 1/r², r the distance from what is known: along a step M′/M, by differences of its logarithm."""
    band, scale = np.column_stack([np.arange(2.0, 7.0), [0.3, -0.2, 0.5, 0.1, 0.0]]), 1.7
    family: Any = SimpleNamespace(space=SimpleNamespace(slope_gram=band), slope_scale=scale)
    gram = np.diag(band[:, 0]) + np.diag(band[:-1, 1], 1) + np.diag(band[:-1, 1], -1)
    apart, step = np.array([0.3, -0.1, 0.4, 0.2, -0.5]), np.array([0.2, 0.7, -0.3, 0.1, 0.4])

    def logarithm(t: float) -> float:
        at = apart + t * step
        return math.log(1.0 + scale**2 / float(at @ gram @ at))

    assert _pull(family, apart, step) == pytest.approx(float(central_slope(logarithm, 1e-3)), rel=1e-9)


def test_points_that_are_taken_back_go_with_their_meshes_and_events() -> None:
    def point(place: float, space: str) -> Any:
        coarse = SimpleNamespace(space=space)
        coarse.place, coarse.along = place, lambda other: other.place - place
        return SimpleNamespace(coarse=coarse)

    points = [point(place, "one") for place in (0.0, 1.0, 3.0, 7.0)] + [point(9.0, "another")]
    meshes: Any = list("abcde")
    found: Any = [SimpleNamespace(after=k) for k in range(4)]
    trace = Trace(list(points), meshes, found)
    assert trace.step_back(1) == np.inf, "on other meshes"
    assert (trace.points, trace.meshes) == (points[:4], list("abcd"))
    assert [item.after for item in trace.found] == [0, 1, 2]
    assert trace.step_back(2) == 2.0
    assert (trace.points, trace.meshes) == (points[:2], list("ab"))
    assert [item.after for item in trace.found] == [0]
