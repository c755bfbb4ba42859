"""Loads at many inclinations from few exact ones, with a checked error."""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.loads.long_rod import LocalLoad
from rodwell.quantities.arrays import FloatArray, IntArray
from rodwell.quantities.value import Value

Solve = Callable[[float], LocalLoad]

SAFETY = 4.0
"""An interval is fine enough if the difference at its middle is this much below the tolerance."""

SPARE = 1e-2
"""By what part of the tolerance an error may be above it: an interpolated load has that of its neighbours besides."""

FIRST_NODES = 9
"""Inclinations of the first table; with up to twice as many different ones, each is solved for."""


@dataclass(frozen=True)
class Loads:
    """Loads at many inclinations: values in N (n,), error estimates (n,), and how many were solved exactly.

    Where there is no value both are NaN, and ``reasons`` says why, by number. ``interpolated`` is the largest relative
    difference between interpolated and exact loads at the middles of the intervals; 0 if nothing was interpolated.
    ``tolerance`` is the relative error that was asked for.
    """

    values: FloatArray
    errors: FloatArray
    reasons: dict[int, str]
    solved: int
    interpolated: float
    tolerance: float

    @property
    def missed(self) -> IntArray:
        """Numbers of the loads that miss the tolerance: mostly, because loads jump near their inclination."""
        with np.errstate(invalid="ignore"):
            beyond = self.errors > (1.0 + SPARE) * self.tolerance * np.abs(self.values)
        return np.flatnonzero(beyond)


@dataclass(frozen=True)
class Precision:
    """How exact a table is: relative error ``tolerance``, and how often an interval may be halved (``levels``)."""

    tolerance: float
    levels: int


def loads_at(
    alphas: Sequence[float], solve: Solve, precision: Precision, progress: Callable[[float], None] | None = None
) -> Loads:
    """Loads at inclinations in degrees (0 to 90): each solved for, or from a table where there are many.

    The table is refined until the middle of every interval agrees with an exact load to a quarter of the tolerance, and
    the middles become nodes themselves; the error reported is the tolerance. Where a load jumps (the place that lifts
    off changes), halving ends; a few inclinations there are solved for, and if there are more, their error is the size
    of the jump.
    """
    tell = progress or (lambda _done: None)
    distinct = sorted(set(alphas))
    inclined = [alpha for alpha in distinct if alpha > 0.0]
    known, solved, worst = {}, len(distinct), 0.0
    if len(inclined) <= 2 * FIRST_NODES:
        for i, alpha in enumerate(distinct):
            known[alpha] = solve(alpha)
            tell((i + 1) / len(distinct))
    else:
        table = _LoadsOverAngle(inclined[0], inclined[-1], solve, precision, tell)
        known = table.at(inclined)
        jumps = table.jumps()
        at_jumps = [alpha for alpha in inclined if any(low < place(alpha) < high for low, high in jumps)]
        if len(at_jumps) <= 2 * FIRST_NODES:
            known |= {alpha: solve(alpha) for alpha in at_jumps}
        else:
            at_jumps = []
        solved, worst = len(table.nodes) + len(at_jumps), table.worst
        if distinct[0] == 0.0:
            known[0.0] = solve(0.0)
            solved += 1
    loads = [known[alpha] for alpha in alphas]
    compressions = [load.compression or Value(math.nan, math.nan) for load in loads]
    values, errors = np.array([load.value for load in compressions]), np.array([load.error for load in compressions])
    reasons = {i: load.reason for i, load in enumerate(loads) if load.compression is None}
    return Loads(values, errors, reasons, solved, worst, precision.tolerance)


def place(alpha: float) -> float:
    """Where an inclination in degrees lies in the table, from −1 (vertical) to 1 (horizontal).

    Loads are smooth in this: near the vertical they follow (sin α)^¼, the inverse of the half wave; near the horizontal
    (cos α)^⅔, by which axial weight raises the load of a rod that is clamped where it is compressed most.
    """
    angle = math.radians(alpha)
    return float(math.sin(angle) ** 0.25 - max(math.cos(angle), 0.0) ** (2.0 / 3.0))


def angle_at(where: float) -> float:
    """Inclination in degrees at a place of the table: inverse of :func:`place`, by bisection."""
    low, high = 0.0, 90.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if place(middle) < where else (low, middle)
    return 0.5 * (low + high)


@dataclass(frozen=True)
class _Interval:
    """An interval that is not halved again: relative difference at its middle, or why it has no load."""

    low: float
    high: float
    gap: float
    reason: str = ""


class _LoadsOverAngle:
    """Exact loads at places of the table, and shape-preserving cubics between them."""

    def __init__(
        self, low: float, high: float, solve: Solve, precision: Precision, tell: Callable[[float], None]
    ) -> None:
        self._solve, self._precision = solve, precision
        self._done: list[_Interval] = []
        first = [float(x) for x in np.linspace(place(low), place(high), FIRST_NODES)]
        angles = {first[0]: low, first[-1]: high}
        self.nodes: dict[float, LocalLoad] = {}
        for i, where in enumerate(first):
            self.nodes[where] = solve(angles.get(where, angle_at(where)))
            tell(0.4 * i / FIRST_NODES)
        todo = list(itertools.pairwise(first))
        for level in range(precision.levels):
            todo = self._refined(todo, last=level == precision.levels - 1)
            tell(0.4 + 0.6 * (level + 1) / precision.levels)
        self._curve = self._interpolant()
        self.worst = max((part.gap for part in self._done if not part.reason), default=0.0)

    def _interpolant(self) -> Callable[[FloatArray], FloatArray]:
        from scipy.interpolate import PchipInterpolator  # noqa: PLC0415 - slow to import

        loads = ((where, load.compression) for where, load in self.nodes.items())
        known = sorted((where, load.value) for where, load in loads if load is not None)
        if len(known) < 2:
            return lambda places: np.full(len(places), math.nan)
        curve = PchipInterpolator([x for x, _ in known], [y for _, y in known], extrapolate=False)
        return lambda places: np.asarray(curve(places))

    def _refined(self, intervals: list[tuple[float, float]], last: bool) -> list[tuple[float, float]]:
        """Solve at the middle of intervals; return the halves of those where the cubic was too far off."""
        curve, still = self._interpolant(), []
        for low, high in intervals:
            middle = 0.5 * (low + high)
            self.nodes[middle] = self._solve(angle_at(middle))
            three = [self.nodes[where] for where in (low, middle, high)]
            values = [load.compression.value for load in three if load.compression is not None]
            if len(values) < 3:
                reason = next(load.reason for load in three if load.compression is None)
                self._done.append(_Interval(low, high, math.nan, reason))
                continue
            gap = abs(float(curve(np.array([middle]))[0]) / values[1] - 1.0)
            if gap <= self._precision.tolerance / SAFETY:
                self._done.append(_Interval(low, high, gap))
            elif last:
                jump = max(abs(values[1] - values[0]), abs(values[2] - values[1])) / min(values)
                self._done.append(_Interval(low, high, jump))
            else:
                still += [(low, middle), (middle, high)]
        return still

    def jumps(self) -> list[tuple[float, float]]:
        """The intervals of the table in which halving did not help."""
        return [(part.low, part.high) for part in self._done if part.gap > self._precision.tolerance]

    def at(self, alphas: Sequence[float]) -> dict[float, LocalLoad]:
        """Loads at inclinations, by inclination, with the difference seen in their intervals as part of the errors.

        All in one go: a well has 100,000 stations.
        """
        places = [place(alpha) for alpha in alphas]
        values = self._curve(np.array(places))
        nodes, parts = sorted(self.nodes), sorted(self._done, key=lambda part: part.low)
        lows = [part.low for part in parts]
        out = {}
        for alpha, where, value in zip(alphas, places, values.tolist(), strict=True):
            right = bisect.bisect_left(nodes, where)
            near = min(nodes[max(right - 1, 0) : right + 1], key=lambda node: abs(node - where))
            part = parts[max(bisect.bisect_right(lows, where) - 1, 0)]
            out[alpha] = self.nodes[near] if abs(near - where) < 1e-12 else self._within(part, near, value)
        return out

    def _within(self, part: _Interval, near: float, value: float) -> LocalLoad:
        """The load inside an interval, whose nearest node is ``near``."""
        if part.reason:
            return LocalLoad(None, reason=f"no exact load at an inclination near by: {part.reason}")
        node = self.nodes[near].compression
        error = 0.0 if node is None else node.error
        return LocalLoad(Value(value, error + max(part.gap, self._precision.tolerance) * value))
