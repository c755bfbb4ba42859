"""Loads at many inclinations and curvatures: each solved for, or from a table of how far a formula is off.

An exact load in a bend is He and Kyllingstad's times a factor that goes slowly with inclination and curvature. Where
there are many pairs of these, that factor is tabulated and interpolated in straight lines; what it misses is seen at
pairs that are solved for besides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from rodwell.analysis.loads.by_inclination import Loads, angle_at, place
from rodwell.analysis.loads.long_rod import LocalLoad
from rodwell.quantities.arrays import FloatArray

Pair = tuple[float, float]
"""Inclination in degrees, 0 to 90, and build in 1/m."""

MOST_SOLVED = 200
"""Different pairs, up to which each is solved for."""

NODES = 17
"""Of the table in each direction."""

SEEN = 24
"""Pairs at which the table is held against exact loads."""

SAFETY = 2.0
"""By which factor the error of the table is above the largest difference seen."""


def loads_in_bends(
    pairs: Sequence[Pair],
    solve: Callable[[float, float], LocalLoad],
    formula: Callable[[float, float], float],
    tolerance: float,
    progress: Callable[[float], None] | None = None,
) -> Loads:
    """Loads of pairs of inclination and build; where there are many, to a ``tolerance`` at best."""
    tell = progress or (lambda _done: None)
    distinct = sorted(set(pairs))
    if len(distinct) > MOST_SOLVED:
        return _from_table(pairs, distinct, solve, formula, tolerance, tell)
    known = {}
    for i, pair in enumerate(distinct):
        known[pair] = solve(*pair)
        tell((i + 1) / len(distinct))
    values, errors, reasons = np.full(len(pairs), math.nan), np.full(len(pairs), math.nan), {}
    for i, pair in enumerate(pairs):
        load = known[pair]
        if load.compression is None:
            reasons[i] = load.reason
        else:
            values[i], errors[i] = load.compression.value, load.compression.error
    return Loads(values, errors, reasons, len(distinct), 0.0, tolerance)


def _from_table(
    pairs: Sequence[Pair],
    distinct: Sequence[Pair],
    solve: Callable[[float, float], LocalLoad],
    formula: Callable[[float, float], float],
    tolerance: float,
    tell: Callable[[float], None],
) -> Loads:
    from scipy.interpolate import RegularGridInterpolator  # noqa: PLC0415 - slow to import

    def factor(alpha: float, build: float) -> float:
        load, about = solve(alpha, build).compression, formula(alpha, build)
        return math.nan if load is None or about <= 0.0 else load.value / about

    lies = np.array([(place(alpha), build) for alpha, build in distinct])
    axes = [np.linspace(float(low), float(high), NODES) for low, high in zip(lies.min(0), lies.max(0), strict=True)]
    table = np.empty((NODES, NODES))
    for i, where in enumerate(axes[0]):
        table[i] = [factor(angle_at(float(where)), float(build)) for build in axes[1]]
        tell(0.9 * (i + 1) / NODES)
    factors = RegularGridInterpolator(axes, table, bounds_error=False)
    found: FloatArray = factors(np.array([(place(alpha), build) for alpha, build in pairs]))
    values = found * np.array([formula(*pair) for pair in pairs])
    seen = np.flatnonzero(np.isfinite(values))
    seen = seen[np.unique(np.linspace(0, seen.size - 1, SEEN).astype(int))] if seen.size else seen
    exact = np.array([factor(*pairs[int(i)]) for i in seen])
    worst = float(np.nanmax(np.abs(found[seen] / exact - 1.0), initial=0.0))
    reasons = {int(i): "beyond the table of loads in this curvature" for i in np.flatnonzero(np.isnan(values))}
    errors = max(SAFETY * worst, tolerance) * values
    return Loads(values, errors, reasons, NODES**2 + seen.size, worst, tolerance)
