"""Predicting the next point of a branch: against curves that are known, and what must not grow along a branch."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell import Problem, critical_loads, follow
from rodwell.numerics.continuation.prediction import MOST_POINTS, Predictor
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.spaces import SplineSpace

SPACE = SplineSpace(np.linspace(0.0, 1.0, 3), 2)


def on_ellipse(angle: float) -> State:
    """A point of a curve in (c₀ … c₃, λ), with its unit tangent in the Euclidean metric."""
    direction = np.array([0.5, -0.3, 0.2, 0.7])
    c = direction * np.cos(angle) + np.array([0.0, 1.0, 0.0, 0.5]) * np.sin(angle)
    tangent = -direction * np.sin(angle) + np.array([0.0, 1.0, 0.0, 0.5]) * np.cos(angle)
    lam, rate = np.sin(0.7 * angle), 0.7 * np.cos(0.7 * angle)
    length = np.sqrt(tangent @ tangent + rate * rate)
    t, r = tangent / length, rate / length
    return State(SPACE, c, lam, t, r, t, r, 0, 0.0)


def missed(count: int, step: float, growth: float = 1.0) -> tuple[float, float]:
    """Distance of a prediction from the curve, and from the hyperplane that it should lie on."""
    angles = 0.4 + np.concatenate([[0.0], np.cumsum(step * growth ** np.arange(count))])
    course = Predictor(on_ellipse(angles[0]))
    for angle in angles[1:count]:
        course.add(on_ellipse(angle))
    last, there = on_ellipse(angles[count - 1]), on_ellipse(angles[count])
    length = last.along(there)
    c, lam = course.ahead(length)
    gap = last.row @ (c - last.c) + last.row_lam * (lam - last.lam) - length
    return float(np.hypot(np.linalg.norm(c - there.c), lam - there.lam)), abs(float(gap))


@pytest.mark.parametrize("growth", [1.0, 1.3, 0.6])
@pytest.mark.parametrize(("count", "order"), [(1, 2), (2, 3), (3, 3), (4, 4), (5, 5)])
def test_prediction_misses_by_a_power_of_the_step(count: int, order: int, growth: float) -> None:
    """The tangent alone: 2; two points and a tangent: 3; a polynomial through k points: k."""
    step = 0.04 if count > 3 else 0.004  # as small as round-off allows
    (large, gap), (small, _) = missed(count, step, growth), missed(count, 0.5 * step, growth)
    assert np.log2(large / small) == pytest.approx(order, abs=0.35 if count > 3 else 0.05)
    assert gap <= (1e-9 if count > 2 else 1e-3)


def test_places_are_those_of_arclength() -> None:
    """On a circle, to the fourth power of the angle between points."""

    def at(angle: float) -> State:
        tangent = np.array([-np.sin(angle), np.cos(angle), 0.0, 0.0])
        return State(SPACE, np.array([np.cos(angle), np.sin(angle), 0.0, 0.0]), 0.0, tangent, 0.0, tangent, 0.0, 0, 0.0)

    course = Predictor(at(0.0))
    for angle in (0.2, 0.4, 0.6):
        course.add(at(angle))
    np.testing.assert_allclose(course.places[-4:], [-0.6, -0.4, -0.2, 0.0], rtol=1e-4)


def test_only_the_last_points_count() -> None:
    course, short = Predictor(on_ellipse(-3.0)), Predictor(on_ellipse(0.0))
    for angle in (-2.0, -1.0):
        course.add(on_ellipse(angle))
    course.add(on_ellipse(0.0))
    for angle in 0.01 * np.arange(1, MOST_POINTS):
        course.add(on_ellipse(angle))
        short.add(on_ellipse(angle))
    np.testing.assert_allclose(course.ahead(0.01)[0], short.ahead(0.01)[0], rtol=1e-9)
    course.restart(on_ellipse(0.5))
    np.testing.assert_allclose(course.ahead(0.1)[0], on_ellipse(0.5).c + 0.1 * on_ellipse(0.5).tangent, rtol=1e-14)


def test_round_off_against_an_end_condition_does_not_grow_along_a_branch() -> None:
    """A slope held at zero ties two coefficients, which Newton's method moves together."""
    problem = Problem(68.0, alpha=73.5, clearance=0.018, ends=("clamped", "guided"))
    state = follow(problem, 3, until=-206.0, rtol=1e-10).last[1].fine
    assert abs(state.c[-1] - state.c[-2]) <= 2e-15 * np.max(np.abs(state.c))


def test_round_off_against_the_symmetry_does_not_grow_along_a_branch() -> None:
    """Polynomials through the last points multiply what Newton's method, which keeps the symmetry, leaves alone."""
    problem = Problem(15.0)
    for mode in (1, 2):
        branch = follow(problem, critical_loads(problem, 2)[mode - 1], until=-250.0, largest_step=0.02)
        state = branch.last[1].fine
        sign = state.symmetry
        assert sign != 0
        assert np.max(np.abs(state.c - sign * state.c[::-1])) <= 1e-13 * np.max(np.abs(state.c))
