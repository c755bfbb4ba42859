"""Forces and moments on a whole rod off the wall of a curved hole, as vectors in space, and holes along curves."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from rodwell.analysis.off_wall.curved.own_places import in_fixed_axes, in_space
from rodwell.analysis.off_wall.measured import position
from rodwell.analysis.off_wall.state import ContactState


def plane_axis(curvature: Callable[[float], float], slope: float = 0.0, count: int = 81) -> list[tuple[float, ...]]:
    """Points of a curve in a vertical plane with a curvature along it, and the slope in rad at its middle."""
    places = np.linspace(0.0, 1.0, count)
    found = solve_ivp(
        lambda s, u: [np.cos(u[2]), np.sin(u[2]), curvature(s)], (0.0, 1.0), [0.0, 0.0, 0.0],
        t_eval=places, rtol=1e-12, atol=1e-14,
    )  # fmt: skip
    x, z, angle = found.y
    turn = slope - float(np.interp(0.5, places, angle))
    cos, sin = np.cos(turn), np.sin(turn)
    return [(float(cos * a - sin * b), 0.0, float(sin * a + cos * b)) for a, b in zip(x, z, strict=True)]


def on_the_whole_rod(state: ContactState) -> tuple[np.ndarray, np.ndarray]:
    """Sum of forces, and of moments about the origin: supports, weight, distributed and concentrated contact."""
    problem = state.problem
    force, moment = supports(state)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    ends = np.union1d(state.fine.bounds, state.fine.solved.shape.places)
    half = 0.5 * np.diff(ends)
    s = (ends[:-1, None] + half[:, None] * (nodes + 1.0)).ravel()
    weights = (half[:, None] * weights).ravel()
    r, frames = in_space(state.fine, s)
    x, y, pressure = position(state.fine, s)
    inward = -np.einsum("ki,kij->kj", np.stack([x[0], y[0]], axis=1), frames[:, :2]) / np.hypot(x[0], y[0])[:, None]
    loads = -pressure[:, None] * inward - np.array([0.0, 0.0, problem.weight])
    loads = np.where((pressure == 0.0)[:, None], -np.array([0.0, 0.0, problem.weight]), loads)
    force, moment = force + weights @ loads, moment + weights @ np.cross(r, loads)
    for one in state.point_forces:
        at = np.array([one.s.value])
        r, frames = in_space(state.fine, at)
        x, y, _ = position(state.fine, at)
        push = -one.force.value * (x[0, 0] * frames[0, 0] + y[0, 0] * frames[0, 1]) / problem.clearance
        force, moment = force + push, moment + np.cross(r[0], push)
    return force, moment


def supports(state: ContactState) -> tuple[np.ndarray, np.ndarray]:
    """Force and moment of both supports on the rod, about the origin: n and M with their sign."""
    problem, force, moment = state.problem, np.zeros(3), np.zeros(3)
    for s, sign in ((0.0, -1.0), (1.0, 1.0)):
        at = np.array([s])
        x, y, _ = position(state.fine, at)
        rod = state.fine.model.in_space(at, x, y, state.force)
        n, t = (sign * in_fixed_axes(state.fine, at, one)[:, 0] for one in (rod.n, rod.t))
        k1, k2 = state.fine.model.beside(at)[:2, 0]
        q = 1.0 / (1.0 - k1 * x[0, 0] - k2 * y[0, 0])
        bend = np.array([[x[2, 0] + q * k1], [y[2, 0] + q * k2], [0.0]])
        couple = np.cross(t, in_fixed_axes(state.fine, at, bend)[:, 0]) - problem.twist * t
        force, moment = force + n, moment + couple + np.cross(in_space(state.fine, at)[0][0], n)
    return force, moment
