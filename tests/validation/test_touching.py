"""The straight rod at a wall that nothing presses it to: whether its mode needs the wall."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from walls import free, touch_of

from rodwell import (
    InputError,
    NotConvergedError,
    Problem,
    certify,
    critical_loads,
    follow,
    loads_without_wall,
)
from rodwell.physics.exact.twisted import twisted_loads


def test_clamped_mode_moves_inwards_in_compression_only() -> None:
    """The mode fills a half-plane just when no end force is left: T₁ = 2 · 4.4934."""
    s = np.linspace(0.0, 1.0, 1001)
    for twist in (1.0, 5.0, 8.9):
        touch = touch_of(Problem(0.0, alpha=0.0, twist=twist))
        assert touch.moves_inward
        assert touch.force == pytest.approx(twisted_loads(twist)[0], rel=1e-12)
        assert np.min(touch.shape(s).real) > -1e-6
    assert not touch_of(Problem(0.0, alpha=0.0, twist=9.2)).moves_inward


def touching_symmetrically(twist: float, near: tuple[float, float]) -> tuple[float, float]:
    """Load F > 0 and contact length b of a weightless clamped rod in contact on [0, b] and [1 − b, 1], in closed form.

    From mid-length u = a + iβs + c exp(ik₁s) + d exp(ik₂s) with real factors; in contact x = 0 and y⁗ = Fy″. At the
    boundary x, x′, x″ vanish and y to y‴ are continuous; y = y′ = 0 at the end. ``near``: two lengths about the root.
    """

    def conditions(b: float, force: float) -> np.ndarray:
        s, root, k = (
            0.5 - b,
            math.sqrt(force),
            -0.5 * twist + np.array([1.0, -1.0]) * math.sqrt(0.25 * twist**2 - force),
        )
        waves = np.array([(1j * k) ** n * np.exp(1j * k * s) for n in range(4)])
        u = np.zeros((4, 4), dtype=complex)
        u[0, :2], u[1, 1], u[:, 2:] = [1.0, 1j * s], 1j, waves
        y = np.array([[1.0, s, 1.0, math.exp(-root * b)], [0.0, 1.0, -root, root * math.exp(-root * b)],
                      [0.0, 0.0, force, force * math.exp(-root * b)],
                      [0.0, 0.0, -(root**3), root**3 * math.exp(-root * b)]])  # fmt: skip
        end = np.array([[1.0, 0.5, math.exp(-root * b), 1.0], [0.0, 1.0, -root * math.exp(-root * b), root]])
        none = np.zeros((2, 4))
        out = np.vstack([np.hstack([u.imag, -y]), np.hstack([none, end]), np.hstack([u.real[:3], np.zeros((3, 4))])])
        return out / np.linalg.norm(out, axis=1)[:, None]  # the last row is that of x″

    def load(b: float) -> float:
        top = twisted_loads(twist)[0]
        scan = np.linspace(0.9 * top, top, 400)
        values = [np.linalg.det(conditions(b, f)[:8]) for f in scan]
        last = max(i for i in range(399) if values[i] * values[i + 1] < 0.0)
        return brentq(lambda f: np.linalg.det(conditions(b, f)[:8]), scan[last], scan[last + 1], xtol=1e-13)

    def bend(b: float) -> float:
        matrix = conditions(b, load(b))
        null = np.linalg.svd(matrix[:8])[2][-1]
        return float(matrix[8] @ null * np.sign(null[2]))

    length = brentq(bend, *near, xtol=1e-12)
    return load(length), length


def test_contact_at_both_ends_in_closed_form() -> None:
    for twist, near in ((12.0, (0.03, 0.04)), (15.0, (0.06, 0.068))):
        force, length = touching_symmetrically(twist, near)
        touch = touch_of(Problem(0.0, alpha=0.0, twist=twist))
        assert abs(touch.force - force) <= touch.error + 1e-10 * force
        assert touch.contacts == (pytest.approx((0.0, length), abs=2e-3), pytest.approx((1.0 - length, 1.0), abs=2e-3))


@pytest.mark.parametrize(
    "problem",
    [Problem(0.0, alpha=0.0, twist=-15.0), Problem(0.0, alpha=0.0, twist=2.0, ends="pinned-pinned"),
     Problem(60.0, alpha=0.0, twist=15.0)],
)  # fmt: skip
def test_mode_that_needs_the_wall(problem: Problem) -> None:
    """Between the loads without the wall and on it; the other sense of twist gives the mirror image."""
    touch = touch_of(problem)
    assert not touch.moves_inward
    assert touch.error < 1e-6
    assert critical_loads(problem, 1)[0].force < touch.force < free(problem)[0]
    assert np.min(touch.shape(np.linspace(0.0, 1.0, 2001)).real) > -1e-5
    other = touch_of(problem.but(twist=-problem.twist))
    assert abs(other.force - touch.force) <= other.error + touch.error


def test_ends_off_the_wall() -> None:
    """On the wall a ball joint buckles as a pin, but the buckled rod would not stay there."""
    on_wall = critical_loads(Problem(15.0, ends="ball-ball"), 2).forces
    assert on_wall == pytest.approx(critical_loads(Problem(15.0, ends="pinned-pinned"), 2).forces, rel=1e-13)
    for refused in (lambda p: follow(p, 1, until=-90.0), lambda p: certify(p, 1)):
        with pytest.raises(InputError, match="leaves the wall at a ball end"):
            refused(Problem(15.0, ends="ball-clamped"))
    with pytest.raises(InputError, match="a loose end takes no torque"):
        Problem(1.0, twist=1.0, ends="clamped-loose")
    with pytest.raises(InputError, match="turns"):
        loads_without_wall(Problem(1.0, turns=1))
    assert loads_without_wall(Problem(15.0)).at_wall is None
    with pytest.raises(NotConvergedError, match="not above"):
        touch_of(Problem(0.0, alpha=0.0, twist=300.0))
