"""A beam of small slopes on one-sided springs at its nodes, between two walls; its shape as a sampler."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solveh_banded

from rodwell.numerics.stretches.basis import tabulate
from rodwell.numerics.stretches.carry import Sampler
from rodwell.quantities.arrays import BoolArray, FloatArray

ROUNDS, HALVINGS = 60, 30
"""Rounds of Newton's method with each stiffness of the springs, halvings of a step."""


def without_held(band: FloatArray, held: BoolArray) -> FloatArray:
    """A lower band whose rows and columns of what is held are those of the identity."""
    out, free = band.copy(), ~held
    out[0, held] = 1.0
    for k in range(1, 4):
        out[k, :-k] *= free[k:] & free[:-k]
    return out


def on_springs(
    band: FloatArray,
    force: FloatArray,
    walls: tuple[FloatArray, FloatArray],
    held: BoolArray,
    stiffness: float,
    height: FloatArray,
) -> FloatArray:
    """Heights and slopes (2n,) of the beam between walls (n,) each: a convex energy, by Newton's method.

    Its stiffness is a lower ``band`` (4, 2n), its load a ``force`` (2n,); springs push back what is below the first
    wall, or above the second one, which may be infinite. Steps are halved while the energy would not fall.
    """
    free, (floor, ceiling) = ~held, walls

    def sides(u: FloatArray) -> FloatArray:
        return (u[::2] > ceiling) - 1.0 * (u[::2] < floor)

    def gradient(u: FloatArray) -> FloatArray:
        out = band[0] * u - force
        for k in range(1, 4):
            out[k:] += band[k, :-k] * u[:-k]
            out[:-k] += band[k, :-k] * u[k:]
        out[::2] -= stiffness * (np.maximum(floor - u[::2], 0.0) - np.maximum(u[::2] - ceiling, 0.0))
        return np.asarray(out * free)

    for _ in range(ROUNDS):
        now, pressed = gradient(height), sides(height)
        sprung = band.copy()
        sprung[0, ::2] += stiffness * np.abs(pressed)
        sprung = without_held(sprung, held)
        step = -solveh_banded(sprung, now, lower=True) * free
        part = 1.0
        for _ in range(HALVINGS):  # along a line a convex energy falls as long as its slope is negative
            if float(gradient(height + part * step) @ step) <= 0.5 * abs(float(now @ step)):
                break
            part *= 0.5
        height = height + part * step
        if part == 1.0 and np.array_equal(pressed, sides(height)):
            break
    return height


def sampled(places: FloatArray, height: FloatArray) -> Sampler:
    """A beam with heights and slopes (2n,) at its nodes, as a shape in the plane: at φ = 0 below the axis, π above."""

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        element = np.clip(np.searchsorted(places, s, side="right") - 1, 0, places.size - 2)
        h = np.diff(places)[element]
        ends = np.stack([height[2 * element + k] * (h if k % 2 else 1.0) for k in range(4)], axis=1)
        table = tabulate(3, (s - places[element]) / h, 3)
        fields = np.zeros((2, 3, s.size))
        fields[0] = np.einsum("okf,kf->ok", table, ends) / h ** np.arange(3)[:, None]
        angle = np.zeros((3, s.size))
        angle[0] = np.where(fields[0, 0] > 0.0, np.pi, 0.0)
        return fields, angle

    return sample
