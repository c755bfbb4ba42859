"""Points that the axis of a hole goes through: checked, and the smooth curve through them."""

from __future__ import annotations

import numpy as np

from rodwell.errors import InputError
from rodwell.problem.axis import Axis, tabulate
from rodwell.quantities.arrays import FloatArray

Rows = tuple[tuple[float, ...], ...]
"""Numbers as rows: problems are frozen, and are told apart by them."""

MOST_POINTS = 10_000
FEWEST_POINTS = 4

SAME_PLACE = 1e-11
"""Points nearer to each other, in L, are the same: what remains is round-off."""

FORM = f"must be points (x, y, z) of the hole's axis in L, from s = 0 to s = 1, z upwards, at least {FEWEST_POINTS}"


def checked_points(given: FloatArray) -> Rows:
    """Return points (n, 3) of an axis as rows, or raise."""
    if given.ndim != 2 or given.shape[1] != 3:
        raise InputError("axis", None, f"{FORM}: (n, 3), not {given.shape}")
    if not FEWEST_POINTS <= len(given) <= MOST_POINTS:
        raise InputError("axis", f"{len(given)} points", f"{FORM} and at most {MOST_POINTS}")
    if not np.all(np.isfinite(given)):
        raise InputError("axis", None, "must be finite at every point")
    chords = np.diff(given, axis=0)
    lengths = np.linalg.norm(chords, axis=1)
    if not np.all(lengths > SAME_PLACE):
        raise InputError("axis", f"point {int(np.argmin(lengths)) + 2}", "is the same point as the one before it")
    forward = np.sum(chords[1:] * chords[:-1], axis=1)
    if np.any(forward <= 0.0):
        where = int(np.argmax(forward <= 0.0)) + 2
        raise InputError(
            "axis",
            f"point {where}",
            "turns back by 90° or more: points must be in order along the hole, close enough to show its bends",
        )
    return tuple((float(x), float(y), float(z)) for x, y, z in given)


def through_points(points: FloatArray) -> Axis:
    """The axis through points (n, 3): a spline of degree five in the sum of the chords, with four derivatives."""
    from scipy.interpolate import make_interp_spline  # noqa: PLC0415 - slow to import

    chords = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    spline = make_interp_spline(chords, points, k=min(5, len(points) - 1))
    first, second = spline.derivative(1), spline.derivative(2)
    return tabulate(chords, lambda u: (first(u), second(u)), points[0])
