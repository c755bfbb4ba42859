"""A second method for free stretches: the equations of a rod in space, integrated from one end to the other."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp

from rodwell.analysis.off_wall.measured import position
from rodwell.analysis.off_wall.state import ContactState
from rodwell.problem.profile import Profile


def integrated(state: ContactState, left: float, right: float) -> np.ndarray:
    """The tangent's and the force's own equations from one end of a free stretch to the other: x, y there, in Δ.

    (b t′)′ = −n + (t·n − b|t′|²)t − T₁ t × t′ and n′ = q(wₗ i + wₐ k), with b t′ and n continuous at a step.
    """
    problem, inset = state.problem, 1e-9
    start = left + inset
    x, y, _ = position(state.fine, np.array([start]))
    (x, y), rod = (x[:, 0], y[:, 0]), problem.rod
    z1 = np.sqrt(1.0 - x[1] ** 2 - y[1] ** 2)
    t = np.array([x[1], y[1], z1])
    t1 = np.array([x[2], y[2], -(x[1] * x[2] + y[1] * y[2]) / z1])
    z3 = -(x[2] ** 2 + y[2] ** 2 + t1[2] ** 2 + x[1] * x[3] + y[1] * y[3]) / z1
    t2 = np.array([x[3], y[3], z3])
    b, rate = (_at(f, start) for f in (rod.stiffness, rod.stiffness.derivative))
    across = -b * (t2 + t1 @ t1 * t) - rate * t1 - problem.twist * np.cross(t, t1)
    along = (state.force + problem.axial_weight * _at(rod.lever, start) - across[2]) / z1
    now = np.concatenate([[x[0], y[0]], t, b * t1, across + along * t])
    gravity = np.array([problem.lateral_weight, 0.0, problem.axial_weight])
    corners = [start, *(s for s in rod.breaks if start < s < right), right]

    def rates(s: float, v: np.ndarray) -> np.ndarray:
        t, bend, n = v[2:5], v[5:8], v[8:11]
        t1 = bend / _at(rod.stiffness, s)
        turning = -n + (t @ n - bend @ t1) * t - problem.twist * np.cross(t, t1)
        return np.concatenate([t[:2], t1, turning, _at(rod.weight, s) * gravity])

    for low, high in pairwise(corners):  # a place on a break belongs to the section above it
        until = high if high == right else np.nextafter(high, low)
        now = solve_ivp(rates, (low, until), now, method="DOP853", rtol=1e-12, atol=1e-15).y[:, -1]
    return now[:2] / problem.clearance


def _at(profile: Profile, s: float) -> float:
    return float(profile(np.array([s]))[0])
