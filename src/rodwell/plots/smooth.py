"""A smooth line through the points of a branch, which may lie far apart."""

from __future__ import annotations

import numpy as np

from rodwell.quantities.arrays import FloatArray

BETWEEN = 12
"""Pieces that the way from one point to the next is drawn in."""

SAME = 1e-9
"""Points nearer to each other than this part of the whole way count as one."""


def smooth(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return points of a smooth line through points (n,) of a curve: every :data:`BETWEEN`-th is one of them.

    Cubic Hermite pieces over the chord length in a picture in which both ranges are equally long; the slope at a point
    is that of the parabola through it and its neighbours. It is for the eye only: between the points nothing was
    computed.

    Parameters
    ----------
    x, y
        The points in order of travel, (n,).

    Returns
    -------
    tuple
        x and y, (BETWEEN (n − 1) + 1,) each.
    """
    points = np.stack([x, y], axis=1)
    size = np.maximum(np.ptp(points, axis=0), np.finfo(float).tiny)
    chord = np.hypot(*(np.diff(points, axis=0) / size).T)
    apart = chord > SAME * max(float(chord.sum()), np.finfo(float).tiny)
    if np.count_nonzero(apart) < 2:
        apart_points = np.arange(BETWEEN * (len(x) - 1) + 1) / BETWEEN
        return (np.interp(apart_points, np.arange(len(x)), x), np.interp(apart_points, np.arange(len(x)), y))
    knots = points[np.concatenate([[True], apart])]
    step = chord[apart]
    slope = _slopes(knots, step)
    own = np.cumsum(apart) - 1  # piece of each way; a way of no length stays at the end of the piece before
    u = np.where(apart[:, None], np.arange(BETWEEN) / BETWEEN, 1.0)
    own = np.maximum(own, 0)
    u[(np.cumsum(apart) == 0)] = 0.0
    u, own = u.ravel(), np.repeat(own, BETWEEN)
    h = step[own]
    basis = (
        (1.0 + 2.0 * u) * (1.0 - u) ** 2, h * u * (1.0 - u) ** 2, u**2 * (3.0 - 2.0 * u), -h * u**2 * (1.0 - u),
    )  # fmt: skip
    values = (knots[own], slope[own], knots[own + 1], slope[own + 1])
    line = sum(weight[:, None] * value for weight, value in zip(basis, values, strict=True))
    whole = np.concatenate([line, points[-1:]])
    whole[::BETWEEN] = points  # to the last digit
    return whole[:, 0], whole[:, 1]


def _slopes(knots: FloatArray, step: FloatArray) -> FloatArray:
    """Slopes over the chord length at points (m, 2), by parabolas through three neighbours each."""
    secant = np.diff(knots, axis=0) / step[:, None]
    before, after = step[:-1, None], step[1:, None]
    inner = (after * secant[:-1] + before * secant[1:]) / (before + after)
    return np.concatenate([2.0 * secant[:1] - inner[:1], inner, 2.0 * secant[-1:] - inner[-1:]])
