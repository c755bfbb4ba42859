"""Gaps as they open, in closed form: starts for Newton's method."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState, kink_gap, slope_at
from rodwell.numerics.stretches.carry import Sampler
from rodwell.physics.off_wall import kinks
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
    low, mid, high = pressure_at(state, stretch, np.array([middle - width, middle, middle + width]))
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
    near, far = pressure_at(state, stretch, np.array([end, other]))
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


class StepGap(NamedTuple):
    """A gap around a step of the stiffness: its ends, and its shape."""

    left: float
    right: float
    bump: Bump


@lru_cache(maxsize=256)
def step_gap_sizes(ratio: float) -> tuple[float, float]:
    """Part of a gap at a step on the stiffer side, a, and Λ in its length ℓ = √(2[b]κΛ/q), from b soft over b stiff.

    With t = 0 at the stiffer end and 1 at the other the radial moment, less that of contact on the stiffer side, is
    [b]κm with m = Λ(t − t²) − t: contact moments at both ends, bent by the contact force q that is missing. The gap's
    curvature is that over b stiff for t < a, and [b]κ(m + 1) over b soft beyond; that it and its slope close leaves one
    equation for a, and Λ. For a small step a = ½ + 1/√12 and Λ = √3.
    """
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    def both(a: float) -> tuple[float, float]:
        rest = (1.0 - a) ** 2
        slope = (ratio * a**2 - rest) / 2.0, ratio * (a**2 / 2.0 - a**3 / 3.0) + 1.0 / 6.0 - a**2 / 2.0 + a**3 / 3.0
        shift = (
            ratio * a**3 / 3.0 - (1.0 / 6.0 - a**2 / 2.0 + a**3 / 3.0),
            ratio * (a**3 / 3.0 - a**4 / 4.0) + 1.0 / 12.0 - a**3 / 3.0 + a**4 / 4.0,
        )
        return slope[0] / slope[1], shift[0] / shift[1]

    least = 1.0 / (1.0 + math.sqrt(ratio))  # where Λ = 0 by the slope
    a = float(brentq(lambda part: both(part)[0] - both(part)[1], least, 1.0))
    return a, both(a)[0]


def at_step(state: PatternedState, stretch: int, s: float) -> StepGap:
    """The gap with which a rod leaves the wall around a step of its stiffness, where it is bent with the wall.

    The contact force is taken as the mean of those on the two sides, and both as constant.
    """
    model = state.model
    below, above = (float(b) for b in model.problem.rod.stiffness(sides(s)))
    stiff, soft, sense = max(below, above), min(below, above), 1.0 if below > above else -1.0
    kappa = slope_at(state.solved.shape, s) ** 2
    push = max(-float(np.mean(pressure_at(state, stretch, sides(s)))) / model.problem.clearance, 1e-3 * kappa)
    a, factor = step_gap_sizes(soft / stiff)
    length = math.sqrt(2.0 * (stiff - soft) * kappa * factor / push)
    origin, scale = s - sense * a * length, (stiff - soft) * kappa

    def bump(places: FloatArray) -> FloatArray:
        t = sense * (places - origin) / length
        out = np.zeros((3, places.size))
        for here, u, sign, b in (((t > 0.0) & (t < a), t, 1.0, stiff), ((t >= a) & (t < 1.0), 1.0 - t, -1.0, soft)):
            v = u[here]
            value = factor * (v**3 / 6.0 - v**4 / 12.0) - sign * v**3 / 6.0
            first = factor * (v**2 / 2.0 - v**3 / 3.0) - sign * v**2 / 2.0
            second = factor * (v - v**2) - sign * v
            out[:, here] = scale / b * np.stack([length**2 * value, sense * sign * length * first, second])
        return out

    left, right = sorted((origin, origin + sense * length))
    return StepGap(left, right, bump)


def at_kink(state: PatternedState, s: float) -> StepGap:
    """The gap around a kink of the stiffness at which the wall would have to pull: see ``kinks``."""
    problem, (length, shortest, push) = state.problem, kink_gap(state, s)
    half = 0.5 * max(length, shortest)
    stiffness = float(problem.rod.stiffness(np.array([s]))[0])

    def bump(places: FloatArray) -> FloatArray:
        return kinks.rises(half, push, stiffness, s, places) / problem.clearance

    return StepGap(s - half, s + half, bump)


def sides(s: float) -> FloatArray:
    """Two places, (2,), just below a step and just above it."""
    return np.array([np.nextafter(s, 0.0), np.nextafter(s, 1.0)])


def lowered(sample: Sampler, bumps: list[Bump]) -> Sampler:
    """A sampler whose radius is less by bumps."""

    def below(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, angle = sample(s)
        r = np.array([1.0, 0.0, 0.0])[:, None] - sum((bump(s) for bump in bumps), np.zeros((3, s.size)))
        pair = [np.stack([u[0] * r[0], u[1] * r[0] + u[0] * r[1], u[2] * r[0] + 2.0 * u[1] * r[1] + u[0] * r[2]])
                for u in fields[:, :3]]  # fmt: skip
        return np.stack(pair), angle

    return below if bumps else sample


def pressure_at(state: PatternedState, stretch: int, places: FloatArray) -> FloatArray:
    """Contact pressure at places of a stretch on the wall."""
    shape, elements = state.solved.shape, state.elements_of(stretch)
    inner = shape.places[elements.start + 1 : elements.stop]
    found = np.empty(places.size)
    for k, s in enumerate(places):
        element = elements.start + int(np.searchsorted(inner, s))
        xi = (s - shape.places[element]) / (shape.places[element + 1] - shape.places[element])
        angle, given = shape.at(element, np.array([xi]))[0], shape.chain.given[element]
        found[k] = state.model.pressure(np.array([s]), angle, shape.load, given)[0]
    return found
