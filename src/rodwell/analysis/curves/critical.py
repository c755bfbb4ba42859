"""Critical loads against weight, inclination or clearance: mode switching and veering found exactly."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from rodwell.analysis.curves.curve import DOUBLE_POINT, VEERING, Curve, CurvePoint, Mark, Progress, checked_range
from rodwell.analysis.straight.critical import MOST_MODES, Mode, critical_loads
from rodwell.analysis.straight.lying_slopes import STEP, lying_slope
from rodwell.analysis.straight.lying_slopes import step_in as curved_step
from rodwell.analysis.straight.scale import EULER
from rodwell.analysis.straight.slopes import load_slope, rates_along, weight_rates
from rodwell.errors import checked_whole
from rodwell.numerics.continuation.location import bracketed_root
from rodwell.problem.problem import Problem
from rodwell.problem.rod import lower_half
from rodwell.problem.sections import seen_from_s_1
from rodwell.problem.varying import Along, Parameter, ParameterPath, limits_of, throughout, varied
from rodwell.quantities.tolerance import RTOL, checked_rtol

SMOOTH = 1e-5
"""Relative to the range of loads: how far a point may lie from the cubic through its neighbours."""

FIRST_STEPS = 12
NARROWEST = 1e-4
"""Narrowest step, as a part of the range."""

MOST_STEPS = 20


def critical_curves(
    problem: Problem,
    over: Parameter | Along,
    limits: Sequence[float],
    *,
    modes: int = 4,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> tuple[Curve, ...]:
    """Critical loads of the first modes as functions of weight, alpha, clearance, twist or the hole's curvature.

    Each point is a solution of the eigenproblem to the tolerance; steps follow from the slopes, which come from the
    eigenvectors: dF/dx = −∫(N_x y'² + (wₗ/Δ)_x y²)/∫y'². On a problem that looks the same from both ends curves
    belong to even and odd modes, which cross: double points. Otherwise loads of neighbouring modes veer.

    Parameters
    ----------
    problem
        The rod; its value of ``over`` does not matter.
    over
        "weight", "alpha", "clearance", "build" (the hole's curvature), a parameter on which the loads do not depend
        ("twist", "poisson", "torsion"), or a path of one's own: a :class:`rodwell.ParameterPath`, or its ``numbers``
        alone for a t from 0 to 1.
    limits
        Start and end of the range.
    modes
        How many, in the order of compression at each value. Curves are continuous: number k is the k-th load at
        the start of the range, and of one symmetry, where the problem has it.
    rtol, progress
        Tolerance as for :func:`rodwell.critical_loads`; called with the part done.

    Returns
    -------
    tuple of Curve
        One for each mode at the start, with the double points and closest approaches as marks of both curves.
    """
    modes, rtol = checked_whole("modes", modes, 1, MOST_MODES), checked_rtol(rtol)
    if problem.ramps:
        problem.refuse_bridges("curves of critical loads")
    over, start, end = checked_range(problem, over, limits)
    split = all(one.symmetric for one in throughout(varied(problem, over, start), over))
    table = _LoadsOverRange(problem, over, modes, rtol, split)
    table.fill(start, end, progress or (lambda _part: None))
    marks = table.marks()
    return tuple(
        Curve(
            "critical",
            f"mode {k + 1}" + (f", {('odd', 'even')[parity > 0]}" if split else ""),
            varied(problem, over, start),
            over,
            tuple(node.point((parity, rank)) for node in table.nodes),
            tuple(mark for mark, who in marks if (parity, rank) in who),
        )
        for k, (parity, rank) in enumerate(table.labels)
    )


Key = tuple[int, int]
"""Parity of a mode (0 where there is none) and its rank among those of this parity, from 1."""


@dataclass(frozen=True)
class _Load:
    """A critical load, its error, and its derivative by the parameter."""

    force: float
    error: float
    slope: float


@dataclass(frozen=True)
class _Node:
    """Critical loads at one value of the parameter."""

    x: float
    loads: dict[Key, _Load]

    def point(self, key: Key) -> CurvePoint:
        return CurvePoint(self.x, self.loads[key].force, self.loads[key].error)

    def gap(self, a: Key, b: Key) -> float:
        return self.loads[a].force - self.loads[b].force

    def gap_slope(self, a: Key, b: Key) -> float:
        return self.loads[a].slope - self.loads[b].slope


class _LoadsOverRange:
    """Nodes along the range, close enough together that cubics join them."""

    def __init__(self, problem: Problem, over: Parameter, modes: int, rtol: float, split: bool) -> None:
        self.problem, self.over, self.modes, self.rtol = problem, over, modes, rtol
        self.split = split  # into even and odd modes
        self._curved = any(one.hole is not None for one in throughout(problem, over))
        self.nodes: list[_Node] = []

    @property
    def labels(self) -> list[Key]:
        """(parity, rank) of the first modes at the start, in order."""
        loads = self.nodes[0].loads
        return sorted(loads, key=lambda k: -loads[k].force)[: self.modes]

    def fill(self, start: float, end: float, tell: Progress) -> None:
        """Compute nodes, halving steps until cubics join them smoothly."""
        grid = np.linspace(start, end, FIRST_STEPS + 1)
        self.nodes = [self.node(float(grid[0]))]
        for x in grid[1:]:
            self._join(self.nodes[-1], self.node(float(x)), abs(end - start))
            tell(abs(float(x) - start) / abs(end - start))

    def _join(self, a: _Node, b: _Node, width: float) -> None:
        middle = self.node(0.5 * (a.x + b.x))
        h = b.x - a.x
        size = max(abs(a.loads[k].force) for k in a.loads) + EULER
        smooth = all(
            abs(0.5 * (p.force + q.force) + h / 8.0 * (p.slope - q.slope) - m.force) <= SMOOTH * size
            for p, m, q in ((a.loads[k], middle.loads[k], b.loads[k]) for k in a.loads)
        )
        if smooth or abs(h) < NARROWEST * width:
            self.nodes += [middle, b]
            return
        self._join(a, middle, width)
        self._join(middle, b, width)

    def node(self, x: float) -> _Node:
        """Solve the eigenproblem at ``x``."""
        problem = varied(self.problem, self.over, x)
        if not self.split:
            loads = critical_loads(problem, self.modes + 1, rtol=self.rtol)
            slope = self._slopes(x, lambda whole: whole)
            return _Node(x, {(0, m.number): _Load(m.force, m.error, slope(m)) for m in loads})
        out: dict[Key, _Load] = {}
        for parity in (1, -1):
            half = partial(_half_in_arc if self._curved else _half, parity=parity)
            slope = self._slopes(x, half, 1.0 / 16.0)
            for m in critical_loads(half(problem), (self.modes + 1) // 2 + 1, rtol=self.rtol):
                out[parity, m.number] = _Load(4.0 * m.force, 4.0 * m.error, 4.0 * slope(m))
        return _Node(x, out)

    def _slopes(self, x: float, part: Callable[[Problem], Problem], foundation: float = 1.0) -> Callable[[Mode], float]:
        """Derivatives by the parameter of loads at ``x``, of modes of a ``part`` of the rod.

        Of a half in a straight hole, which is level, only the ``foundation`` counts, as many times as large.
        """
        problem, over = varied(self.problem, self.over, x), self.over
        if not self._curved:
            rates = weight_rates(problem, over) if isinstance(over, str) else rates_along(self.problem, over, x)
            axial, lateral = rates if foundation == 1.0 else (0.0, foundation * rates[1])
            return lambda mode: load_slope(mode.problem, mode.space, mode.coefficients, axial, lateral)
        low, high = limits_of(over)
        step = STEP * (high - low) if isinstance(over, ParameterPath) else curved_step(problem, over)
        one_sided = not low <= x - 2.0 * step < x + 2.0 * step <= high
        step = -step if one_sided and x + 4.0 * step > high else step

        def along(more: float) -> Problem:
            return part(varied(self.problem, over, x + more))

        return lambda mode: lying_slope(
            mode.problem, mode.space, mode.coefficients, mode.force, along, step, to_one_side=one_sided
        )

    def marks(self) -> list[tuple[Mark, tuple[Key, Key]]]:
        """Double points and closest approaches of the labelled modes, in order."""
        out = []
        keys = self.labels
        for i, a in enumerate(keys):
            for b in keys[i + 1 :]:
                if self.split and a[0] == b[0]:
                    continue
                if not self.split and abs(a[1] - b[1]) != 1:
                    continue
                for left, right in zip(self.nodes[:-1], self.nodes[1:], strict=True):
                    mark = self._crossing(left, right, a, b) if self.split else self._closest(left, right, a, b)
                    if mark is not None:
                        out.append((mark, (a, b)))
        return sorted(out, key=lambda item: item[0].x)

    def _crossing(self, left: _Node, right: _Node, a: Key, b: Key) -> Mark | None:
        """The double point between two nodes, if the loads of two symmetries change places there."""
        ends = left.gap(a, b), right.gap(a, b)
        if ends[0] * ends[1] > 0.0 or ends[0] == 0.0:
            return None
        node = self._root(left, right, a, b)
        load, other = node.loads[a], node.loads[b]
        error = load.error + other.error
        x_error = (error + abs(node.gap(a, b))) / abs(node.gap_slope(a, b))
        rank = 1 + sum(m.force > max(load.force, other.force) + 10.0 * error for m in node.loads.values())
        value_error = error + max(abs(load.slope), abs(other.slope)) * x_error
        value, note = 0.5 * (load.force + other.force), f"modes {rank} and {rank + 1} switch"
        return Mark(DOUBLE_POINT, node.x, x_error, value, value_error, note)

    def _root(self, left: _Node, right: _Node, a: Key, b: Key) -> _Node:
        """Node at which two loads are equal: Newton's method on their gap, kept between the two nodes."""
        low, high = sorted((left.x, right.x))
        share = left.gap(a, b) / (left.gap(a, b) - right.gap(a, b))
        x = left.x + share * (right.x - left.x)
        best = self.node(x)
        for _ in range(MOST_STEPS):
            x -= best.gap(a, b) / best.gap_slope(a, b)
            if not low <= x <= high:
                break
            node = self.node(x)
            settled = abs(node.gap(a, b)) >= 0.5 * abs(best.gap(a, b))
            best = node if abs(node.gap(a, b)) < abs(best.gap(a, b)) else best
            if settled:
                return best
        ends = left.gap(a, b), right.gap(a, b)
        return self.node(bracketed_root(lambda t: self.node(t).gap(a, b), left.x, right.x, *ends))

    def _closest(self, left: _Node, right: _Node, a: Key, b: Key) -> Mark | None:
        """The closest approach of two neighbouring loads between two nodes, if their gap has a minimum there."""
        ends = left.gap_slope(a, b) * (right.x - left.x), right.gap_slope(a, b) * (right.x - left.x)
        if not ends[0] < 0.0 < ends[1]:
            return None
        x = bracketed_root(lambda t: self.node(t).gap_slope(a, b) * (right.x - left.x), left.x, right.x, *ends)
        node = self.node(x)
        load, other = node.loads[a], node.loads[b]
        error = load.error + other.error
        bend = abs(right.gap_slope(a, b) - left.gap_slope(a, b)) / abs(right.x - left.x)
        x_error = math.sqrt(error / bend) if bend > 0.0 else abs(right.x - left.x)
        gap = abs(node.gap(a, b))
        return Mark(
            VEERING,
            x,
            x_error,
            load.force,
            load.error,
            f"modes {a[1]} and {b[1]} come within {gap:.6g} ± {error:.0e} B/L²",
        )


def _half(problem: Problem, parity: int) -> Problem:
    """The half of a symmetric horizontal rod that is all one needs to know of its even (1) or odd (−1) modes.

    At mid-length an even mode is guided, an odd one pinned. With half the length, forces are a quarter in number, and
    the foundation wₗ/Δ a sixteenth. Each symmetry on its own has no double loads.
    """
    middle = "guided" if parity > 0 else "pinned"
    sections = lower_half(problem.sections)
    return problem.but(weight=problem.weight / 16.0, ends=(problem.ends[0], middle), sections=sections)


def _half_in_arc(problem: Problem, parity: int) -> Problem:
    """The same in a level arc, or a straight hole: the half with the end force.

    It is inclined by what the hole turns over a quarter of the rod.
    """
    middle = "guided" if parity > 0 else "pinned"
    reach = -problem.clearance if problem.on_top != problem.floats else problem.clearance
    turn = math.degrees(0.25 * problem.build / (1.0 + reach * problem.build))
    return problem.but(
        weight=problem.weight / 8.0, clearance=2.0 * problem.clearance, build=0.5 * problem.build,
        alpha=90.0 - turn, ends=(middle, problem.ends[1]), sections=seen_from_s_1(lower_half(problem.sections)),
    )  # fmt: skip
