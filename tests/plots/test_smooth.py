"""Smooth lines through the points of a branch."""

import numpy as np
import pytest

from rodwell.plots.smooth import BETWEEN, smooth


def test_the_line_passes_through_the_points_and_follows_a_circle() -> None:
    angle = np.array([0.0, 0.4, 0.7, 1.2, 1.5, 2.1, 2.6, 3.1, 3.6, 4.1])
    x, y = smooth(np.cos(angle), np.sin(angle))
    assert np.array_equal(x[::BETWEEN], np.cos(angle))
    assert np.array_equal(y[::BETWEEN], np.sin(angle))
    polygon = 1.0 - np.cos(0.3)  # by how much a chord of 0.6 rad leaves the circle
    assert np.max(np.abs(np.hypot(x, y) - 1.0)) < 0.1 * polygon


def test_lines_stay_lines_whatever_the_distances_of_their_points() -> None:
    at = np.array([0.0, 1e-3, 0.5, 0.9, 1.0])
    x, y = smooth(1e5 * at, 3.0 - 2e-6 * at)
    assert y == pytest.approx(3.0 - 2e-11 * x, rel=1e-14)
    assert np.all(np.diff(x) > 0.0)


@pytest.mark.parametrize("repeated", [[0], [2], [5], [0, 0, 5, 5]])
def test_a_point_that_comes_twice_changes_nothing(repeated: list[int]) -> None:
    t = np.linspace(0.0, 1.0, 6)
    once = smooth(t, t**3)
    order = np.sort(np.concatenate([np.arange(6), repeated]))
    twice = smooth(t[order], t[order] ** 3)
    ways = np.diff(order).astype(bool).repeat(BETWEEN)
    for with_once, with_twice in zip(once, twice, strict=True):
        assert with_twice[:-1][ways] == pytest.approx(with_once[:-1], abs=1e-15)
        assert with_twice[-1] == with_once[-1]


@pytest.mark.parametrize("count", [1, 2])
def test_one_point_or_two_are_what_they_are(count: int) -> None:
    x, y = smooth(np.arange(count, dtype=float), np.full(count, 7.0))
    assert len(x) == BETWEEN * (count - 1) + 1
    assert np.all(y == 7.0)
