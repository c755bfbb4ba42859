"""A hole known by its direction at stations, as surveys know it: how it goes on between them.

Between stations the direction is a polynomial of degree five in the arclength, made a unit vector; it has the direction
of both stations, and two derivatives there. Its integral is the axis: the curvature has a continuous rate, and is
smooth but for its second derivative, which jumps at stations.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rodwell.errors import InputError
from rodwell.problem.axis import Axis, tabulate
from rodwell.problem.points import MOST_POINTS, Rows
from rodwell.quantities.arrays import FloatArray

if TYPE_CHECKING:
    from scipy.interpolate import BPoly

COLUMNS = 10
"""Of a station: arclength, then direction, its first and its second derivative by that, three components each."""

LEAST_SIZE, LARGEST_SIZE = 0.5, 2.0
"""Of directions: those of a piece that begins between stations are no unit vectors."""

FORM = (
    f"must be stations with {COLUMNS} numbers each, at least 2: arclength in L, rising from 0 at s = 0; direction of "
    "the hole towards s = 1, about a unit vector, z upwards; its first and its second derivative by that"
)


def checked_stations(stations: FloatArray) -> Rows:
    """Return stations (n, 10) as rows, or raise."""
    what = f"{len(stations)} stations"
    if not 2 <= len(stations) <= MOST_POINTS:
        raise InputError("axis", what, f"{FORM}; at most {MOST_POINTS}")
    if not np.all(np.isfinite(stations)):
        raise InputError("axis", what, "must be finite at every station")
    places, directions = stations[:, 0], stations[:, 1:4]
    if places[0] != 0.0 or not np.all(np.diff(places) > 0.0):
        raise InputError("axis", what, FORM)
    sizes = np.linalg.norm(directions, axis=1)
    if not np.all((sizes >= LEAST_SIZE) & (sizes <= LARGEST_SIZE)):
        where = int(np.argmax((sizes < LEAST_SIZE) | (sizes > LARGEST_SIZE)))
        raise InputError("axis", f"station {where + 1} with a direction of length {sizes[where]:.3g}", FORM)
    forward = np.sum(directions[1:] * directions[:-1], axis=1)
    if np.any(forward <= 0.0):
        where = int(np.argmax(forward <= 0.0)) + 2
        raise InputError("axis", f"station {where}", "turns by 90° or more from the one before: give stations between")
    return tuple(tuple(row) for row in stations.tolist())


def along_stations(stations: FloatArray, start: FloatArray) -> Axis:
    """The axis from a point (3,) on, along stations (n, 10)."""
    direction = _direction(stations)
    rate = direction.derivative()

    def motion(at: FloatArray) -> tuple[FloatArray, FloatArray]:
        value, slope = direction(at), rate(at)
        size = np.linalg.norm(value, axis=1, keepdims=True)
        unit = value / size
        return unit, (slope - np.sum(slope * unit, axis=1, keepdims=True) * unit) / size

    return tabulate(stations[:, 0], motion, start)


def piece_of(stations: FloatArray, low: float, high: float) -> FloatArray:
    """Stations (m, 10) of the piece between two arclengths, which are stations of it: the same polynomials."""
    places = stations[:, 0]
    shortest = NO_COURSE * (high - low)
    inside = places[(places > low + shortest) & (places < high - shortest)]
    at = np.concatenate([[low], inside, [high]])
    direction = _direction(stations)
    return np.concatenate([at[:, None], *(direction(at, nu=order) for order in range(3))], axis=1)


NO_COURSE = 1e-6
"""Stations nearer to an end of a piece, as a part of its length, are left out."""


def _direction(stations: FloatArray) -> BPoly:
    """The direction, not yet of unit length, as a function of the arclength."""
    from scipy.interpolate import BPoly  # noqa: PLC0415 - slow to import

    return BPoly.from_derivatives(stations[:, 0], stations[:, 1:].reshape(-1, 3, 3))
