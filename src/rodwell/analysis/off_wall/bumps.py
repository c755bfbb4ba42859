"""Gaps as they open, in closed form: starts for Newton's method."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.numerics.stretches.carry import Sampler
from rodwell.quantities.arrays import FloatArray

Bump = Callable[[FloatArray], FloatArray]
"""Places (k,) to a gap in Δ with two derivatives, (3, k)."""


def within(state: PatternedState, stretch: int, middle: float, half: float) -> Bump:
    """A small gap within a stretch in contact, of half length m.

    Where the pressure with which the rod would leave the wall is ε − κσ²/2 at the distance σ from its maximum, the gap
    is k(m² − σ²)³ with k = κ/720 and 72km² = ε, since its fourth derivative is 72km² − 360kσ² and it opens with its
    third power at both ends: m ∝ √ε, and the height km⁶.
    """
    width = 0.5 * half
    low, mid, high = _pressure_at(state, stretch, np.array([middle - width, middle, middle + width]))
    kappa = max(-(low - 2.0 * mid + high) / width**2, 1.0)
    scale = kappa / 720.0 / state.model.problem.clearance

    def bump(s: FloatArray) -> FloatArray:
        d = s - middle
        inside = np.where(np.abs(d) < half, half**2 - d**2, 0.0)
        return np.asarray(scale * np.stack([inside**3, -6.0 * d * inside**2, -6.0 * inside**2 + 24.0 * d**2 * inside]))

    return bump


def beside(state: PatternedState, stretch: int, end: float, other: float) -> Bump:
    """A small gap between an end of a stretch in contact, where the rod keeps touching the wall, and ``other``.

    The pressure grows towards the end like a straight line of slope p′: the gap is p′/120 (s − other)³(s − end)².
    """
    towards = end - other
    near, far = _pressure_at(state, stretch, np.array([end, other]))
    length = abs(towards)
    scale = max((near - far) / length, 1.0) / 120.0 / state.model.problem.clearance

    def bump(s: FloatArray) -> FloatArray:
        t = (s - other) / towards  # 0 at the new end of contact, 1 at the old one
        a = np.where((t > 0.0) & (t < 1.0), t, 0.0)
        b = np.where(a > 0.0, 1.0 - t, 0.0)
        value, first = a**3 * b**2, 3.0 * a**2 * b**2 - 2.0 * a**3 * b
        second = 6.0 * a * b**2 - 12.0 * a**2 * b + 2.0 * a**3
        return np.asarray(scale * length**3 * np.stack([value * length**2, first * length**2 / towards, second]))

    return bump


def lowered(sample: Sampler, bumps: list[Bump]) -> Sampler:
    """A sampler whose radius is less by bumps."""

    def below(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, angle = sample(s)
        r = np.array([1.0, 0.0, 0.0])[:, None] - sum((bump(s) for bump in bumps), np.zeros((3, s.size)))
        pair = [np.stack([u[0] * r[0], u[1] * r[0] + u[0] * r[1], u[2] * r[0] + 2.0 * u[1] * r[1] + u[0] * r[2]])
                for u in fields[:, :3]]  # fmt: skip
        return np.stack(pair), angle

    return below if bumps else sample


def _pressure_at(state: PatternedState, stretch: int, places: FloatArray) -> FloatArray:
    """Contact pressure at places of a stretch on the wall."""
    shape, elements = state.solved.shape, state.elements_of(stretch)
    inner = shape.places[elements.start + 1 : elements.stop]
    found = np.empty(places.size)
    for k, s in enumerate(places):
        element = elements.start + int(np.searchsorted(inner, s))
        xi = (s - shape.places[element]) / (shape.places[element + 1] - shape.places[element])
        found[k] = state.model.pressure(np.array([s]), shape.at(element, np.array([xi]))[0], shape.load)[0]
    return found
