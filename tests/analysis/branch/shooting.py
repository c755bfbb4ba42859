"""A horizontal clamped rod as an initial-value problem: a second way to its special points, without the engine.

The energy of docs/theory.md is stationary without twist, with sin η = y', κ = η' and the multiplier V of that, where

    ξ₂' = sin η / Δ,    η' = κ,    κ' = 2 sin³η cos η / Δ² + F sin η − V cos η,    V' = γ sin ξ₂

A state even or odd about the middle is known by the two of these four that do not vanish there. Small changes of it
split into those of its own symmetry, singular at folds, and the others, singular where it is lost.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

FloatArray = NDArray[np.float64]

CLEARANCE = 0.01
XI, ETA, KAPPA, V = range(4)
FREE = {1: (XI, KAPPA), -1: (ETA, V)}
"""What need not vanish in the middle: of states that are even, and odd."""

SIGNS = {1: np.array([1.0, -1.0, 1.0, -1.0]), -1: np.array([-1.0, 1.0, -1.0, 1.0])}
"""What the reflection about the middle does to the four."""


def rates(_: float, x: FloatArray, force: float, weight: float) -> FloatArray:
    """Derivatives of the four and of small changes of them, which follow four by four."""
    d = CLEARANCE
    xi, eta, kappa, v = x[:4]
    sin, cos = np.sin(eta), np.cos(eta)
    out = np.empty_like(x)
    out[:4] = sin / d, kappa, 2.0 * sin**3 * cos / d**2 + force * sin - v * cos, weight * np.sin(xi)
    change, of = x[4:].reshape(-1, 4), out[4:].reshape(-1, 4)
    stiffness = 2.0 * sin * sin * (4.0 * cos * cos - 1.0) / d**2 + force * cos + v * sin
    of[:, XI], of[:, ETA] = cos / d * change[:, ETA], change[:, KAPPA]
    of[:, KAPPA] = stiffness * change[:, ETA] - cos * change[:, V]
    of[:, V] = weight * np.cos(xi) * change[:, XI]
    return out


class Shot:
    """The rod from its middle, or from an end, with small changes of two of the four there."""

    def __init__(self, start: FloatArray, at: float, changed: tuple[int, int], force: float, weight: float) -> None:
        self.force, self.weight = force, weight
        first = np.concatenate([start, *np.eye(4)[list(changed)]])
        self.path = solve_ivp(
            rates, (at, 1.0), first, "DOP853", args=(force, weight), rtol=1e-12, atol=1e-14, dense_output=True
        )

    @property
    def end(self) -> FloatArray:
        """The four at s = 1."""
        return np.asarray(self.path.y[:4, -1])

    @staticmethod
    def determinant(x: FloatArray) -> FloatArray:
        """Zero where a small change that fits the start leaves ξ₂ and η as they are."""
        return np.asarray(x[4] * x[9] - x[5] * x[8])

    def pressure(self, s: float) -> float:
        """Contact pressure of the rod, (52)–(58) without twist."""
        xi, eta, kappa, v = self.path.sol(s)[:4]
        d, sin, cos = CLEARANCE, np.sin(eta), np.cos(eta)
        w1, w2, w3 = -sin * cos / d, -kappa, sin**2 / d
        w2_rate = -(2.0 * sin**3 * cos / d**2 + self.force * sin - v * cos)
        at_end = 0.5 * self.end[KAPPA] ** 2 + d * self.weight
        tangential = self.force - (0.5 * (w2**2 + w3**2) + d * self.weight * np.cos(xi)) + at_end
        shear = w2_rate - w1 * w3
        own = -3.0 * w2_rate * w1 - 3.0 * np.cos(2.0 * eta) * w2**2 / d
        return float(own + w3 * tangential - w1 * shear - self.weight * np.cos(xi))

    @cached_property
    def highest_pressure(self) -> float:
        """Largest contact pressure over half the rod."""
        s = np.linspace(0.5, 1.0, 201)
        values = [self.pressure(x) for x in s]
        top = int(np.argmax(values))
        around = s[max(top - 1, 0)], s[min(top + 1, 200)]
        best = minimize_scalar(lambda x: -self.pressure(x), bounds=around, method="bounded", options={"xatol": 1e-7})
        return max(-float(best.fun), values[top])


FOLD, LIFT_OFF = "fold", "lift_off"

SETTLED, MOST_STEPS = 1e-9, 12

OF_FORCE, DIFFERENCES = 1e-6, (1e-8, 1e-10, 1e-7, 1e-7)
"""Small changes of the end force and of the four: far out the end grows by 1e9 with η in the middle."""


def special(weight: float, parity: int, kind: str, guess: Sequence[float]) -> tuple[float, int]:
    """End force at a special point of a symmetric branch, and the stability index, by Newton's method.

    ``guess`` is the end force and the two that do not vanish in the middle. At a change of the index it is the lower.
    """
    own, changed = FREE[parity], FREE[parity if kind == FOLD else -parity]

    def shot(unknowns: FloatArray) -> Shot:
        start = np.zeros(4)
        start[list(own)] = unknowns[1:]
        return Shot(start, 0.5, changed, unknowns[0], weight)

    def gap(unknowns: FloatArray) -> FloatArray:
        it = shot(unknowns)
        last = it.highest_pressure if kind == LIFT_OFF else Shot.determinant(it.path.y[:, -1])
        return np.array([it.end[XI], it.end[ETA], float(last)])

    unknowns, differences = np.array(guess), np.diag([OF_FORCE, *(DIFFERENCES[i] for i in own)])
    for _ in range(MOST_STEPS):
        slopes = [(gap(unknowns + d) - gap(unknowns - d)) / (2.0 * np.sum(d)) for d in differences]
        step = np.linalg.solve(np.transpose(slopes), -gap(unknowns))
        unknowns = unknowns + step
        if abs(step[0]) <= SETTLED * abs(unknowns[0]):
            return float(unknowns[0]), conjugate_points(SIGNS[parity] * shot(unknowns).end, unknowns[0], weight)
    raise AssertionError("Newton's method did not settle")


def critical(weight: float, parity: int, low: float, high: float) -> float:
    """End force between two at which the straight rod buckles into an even or odd mode."""

    def determinant(force: float) -> float:
        shot = Shot(np.zeros(4), 0.5, FREE[parity], force, weight)
        return float(Shot.determinant(shot.path.y[:, -1]))

    return float(brentq(determinant, low, high, xtol=1e-10))


def conjugate_points(start: FloatArray, force: float, weight: float) -> int:
    """Stability index by Morse's theorem: places within the rod up to which it could have buckled already.

    ``start`` are the four at s = 0. A singular point has one such place at s = 1, which does not count.
    """
    whole = Shot(np.array([0.0, 0.0, start[KAPPA], start[V]]), 0.0, (KAPPA, V), force, weight)
    signs = np.sign(Shot.determinant(whole.path.sol(np.linspace(0.02, 0.995, 1000))))
    return int(np.sum(signs[1:] != signs[:-1]))
