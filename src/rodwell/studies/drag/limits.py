"""Compression at which the string buckles along the hole, and from which it is helical: the limits of a figure."""

from __future__ import annotations

import numpy as np

from rodwell.quantities.arrays import FloatArray
from rodwell.studies.drag.contact import ACROSS, CURVATURE, RATIO, WEIGHT
from rodwell.studies.drag.run import Run

SCANNED, HALVED = 80, 60


def limit_compression(one: Run, beta: float) -> FloatArray:
    """Least compression P in N at the rows with P = β √(B q(P)/r), (m,): q depends on P where the hole is curved.

    In a vertical straight hole it is 0. In a drop compression first takes the string off the low side; the least root
    counts.
    """
    table = one.pieces.table[one.piece]
    kappa, w, ratio = table[:, CURVATURE], table[:, WEIGHT], table[:, RATIO]
    lateral = _lateral(one)
    across = w * table[:, ACROSS]

    def over(p: FloatArray) -> FloatArray:
        q = np.sqrt((w * lateral - p * kappa) ** 2 + across**2)
        return np.asarray(p * p - beta * beta * ratio * q)

    most = beta * np.sqrt(ratio * w) + beta * beta * ratio * kappa
    low, high = np.zeros(len(w)), np.full(len(w), np.nan)
    for part in np.linspace(0.0, 2.0, SCANNED + 1)[1:]:
        p = part * most
        fresh = np.isnan(high) & (over(p) >= 0.0)
        high[fresh] = p[fresh]
        rising = np.isnan(high)
        low[rising] = p[rising]
    high = np.where(np.isnan(high), 2.0 * most, high)
    for _ in range(HALVED):
        middle = 0.5 * (low + high)
        beyond = over(middle) >= 0.0
        high = np.where(beyond, middle, high)
        low = np.where(beyond, low, middle)
    return np.asarray(high)


def _lateral(one: Run) -> FloatArray:
    """g·N at the rows, (m,)."""
    table = one.pieces.table[one.piece]
    starts = one.depth - one.pieces.bottom[one.piece]
    angle = table[:, 1] - table[:, CURVATURE] * (one.rows[:, 0] - starts)
    return np.asarray(table[:, 4] * np.cos(angle) - table[:, 3] * np.sin(angle))
