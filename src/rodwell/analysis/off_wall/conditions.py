"""What must hold in a state of partial contact, each condition as a number that is positive while it does.

Where one of them vanishes along a path the pattern of contact changes:

* contact pushes all along a stretch on the wall: else a gap opens there,
* a point of contact pushes: else it is lost,
* the gap beside a point of contact opens like a parabola, r″ < 0: else the contact grows to a stretch,
* at a radially held end the free rod curves inwards: else contact grows from the end,
* at an end that is not radially held a rod in contact does not turn around the wall, since nothing bears the radial
  moment that this takes: else it leaves the wall there,
* the rod nowhere reaches the wall within a free stretch: else it touches there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.newton import Solved, gap_curvature
from rodwell.problem.ends import OFF_WALL_ENDS
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

OPENS, LOST, GROWS, GROWS_AT_END, TOUCHES, LEAVES = "opens", "lost", "grows", "grows_at_end", "touches", "leaves"
UNHELD = "unheld"

PER_ELEMENT = 12
"""Places in an element at which pressure and gap are looked at first."""

CLOSER, ZOOMS = 9, 4
"""Places of each closer look at a minimum, and how many looks: the last are some thousandths of an element apart."""

NOISE = 1e-10
"""A gap, over the polynomial with which it opens, is not known better than this: it is round-off over that."""

KNOWN_FORCE = 5e-6
"""A force at the end of a stretch in contact comes from third derivatives, which the elements along a path know to this
part of |F|^{3/2}: an end of a gap that has just opened may seem to pull by less."""

EDGE = 0.02
"""Part of a free stretch at either end where the gap is left to the conditions on forces and curvature."""


class Condition(NamedTuple):
    """A condition: its kind, the stretch, break or end it belongs to, its value (positive: holds), and where."""

    kind: str
    number: int
    value: float
    s: float


@dataclass(frozen=True, eq=False, repr=False)
class PatternedState:
    """An equilibrium with its pattern and the numbers of elements of its stretches."""

    pattern: Pattern
    elements: tuple[int, ...]
    solved: Solved

    @property
    def model(self) -> RodInHole:
        """The rod in its hole."""
        model: RodInHole = self.solved.model
        return model

    @property
    def problem(self) -> Problem:
        """The problem."""
        return self.model.problem

    @property
    def load(self) -> float:
        """End force F at s = 1 in B/L², tension positive."""
        return float(self.solved.shape.load)

    @property
    def bounds(self) -> FloatArray:
        """Where the stretches begin and end, (k+1,)."""
        return np.concatenate([[0.0], self.solved.shape.breaks, [1.0]])

    def elements_of(self, stretch: int) -> range:
        """Numbers of the elements of a stretch."""
        first = sum(self.elements[:stretch])
        return range(first, first + self.elements[stretch])


def conditions(state: PatternedState) -> list[Condition]:
    """All conditions of a state."""
    found: list[Condition] = []
    solved, pattern = state.solved, state.pattern
    for i, on in enumerate(pattern.touching):
        found += pressing(state, i) if on else [apart(state, i)]
    for i in range(pattern.breaks):
        place = float(solved.shape.breaks[i])
        found.append(Condition(LOST if pattern.is_point(i) else LEAVES, i, _pushing(state, i), place))
        if pattern.is_point(i):
            found.append(Condition(GROWS, i, float(solved.openings[i]), place))
    found += [at for last in (False, True) if (at := _at_end(state, last)) is not None]
    return found


def _pushing(state: PatternedState, i: int) -> float:
    """The concentrated force at a break; at an end of a stretch in contact as far as it is certain that it pulls."""
    force = float(state.solved.forces[i])
    return force if state.pattern.is_point(i) else force + KNOWN_FORCE * abs(state.load) ** 1.5


def _at_end(state: PatternedState, last: bool) -> Condition | None:
    """The curvature of the gap at a radially held end of a free stretch."""
    shape = state.solved.shape
    node = -1 if last else 0
    if state.pattern.touching[node]:
        ball = state.model.problem.ends[node] in OFF_WALL_ENDS
        return Condition(UNHELD, int(last), -abs(float(shape.nodes[node, 3])), float(last)) if ball else None
    if not (shape.chain.held[node, 2] and shape.chain.held[node, 0]):
        return None
    element = shape.chain.elements - 1 if last else 0
    return Condition(GROWS_AT_END, int(last), gap_curvature(shape, element, float(last)), float(last))


def pressing(state: PatternedState, stretch: int) -> list[Condition]:
    """The least contact forces per length −p on a stretch on the wall, and where: all minima, the lowest first."""
    shape, elements = state.solved.shape, state.elements_of(stretch)
    xi = np.linspace(0.0, 1.0, PER_ELEMENT + 1)
    functions = [_pressure(state, element) for element in elements]
    values = np.concatenate([function(xi[:-1]) for function in functions] + [functions[-1](xi[-1:])])
    low = np.r_[True, values[1:] <= values[:-1]] & np.r_[values[:-1] <= values[1:], True]
    found = []
    for k in np.flatnonzero(low):
        best = (float(values[k]), np.nan)
        for e in {
            min(max(int(k) - 1, 0) // PER_ELEMENT, len(functions) - 1),
            min(int(k) // PER_ELEMENT, len(functions) - 1),
        }:
            part = int(k) - e * PER_ELEMENT
            around = float(xi[max(part - 1, 0)]), float(xi[min(part + 1, PER_ELEMENT)])
            value, where = lowest(functions[e], np.linspace(*around, CLOSER))
            left, right = shape.places[elements[e]], shape.places[elements[e] + 1]
            if value <= best[0] or np.isnan(best[1]):
                best = (value, float(left + (right - left) * where))
        found.append(Condition(OPENS, stretch, *best))
    return sorted(found, key=lambda one: one.value)


def _pressure(state: PatternedState, element: int) -> Callable[[FloatArray], FloatArray]:
    """The contact force per length −p of an element as a function of ξ."""
    shape = state.solved.shape
    left, h = shape.places[element], shape.places[element + 1] - shape.places[element]
    return lambda xi: -state.model.pressure(left + h * xi, shape.at(element, xi)[0], shape.load)


def apart(state: PatternedState, stretch: int) -> Condition:
    """The least gap within a free stretch, over the polynomial with which it opens from its ends, and where.

    Positive everywhere if and only if the gap is; unlike the gap itself it does not vanish at the ends.
    """
    left, right = state.bounds[stretch : stretch + 2]
    best, where = np.inf, np.nan
    shape = state.solved.shape
    powers = [_power(state, stretch, last) for last in (False, True)]
    for element in state.elements_of(stretch):
        start, h = shape.places[element], shape.places[element + 1] - shape.places[element]

        def gap(part: FloatArray, element: int = element, start: float = start, h: float = h) -> FloatArray:
            x, y = shape.at(element, part, 1)[:, 0]
            at = (start + h * part - left) / (right - left)
            return np.asarray((1.0 - np.hypot(x, y)) / (at ** powers[0] * (1.0 - at) ** powers[1]))

        low = max(0.0, (left + EDGE * (right - left) - start) / h) if powers[0] else 0.0
        high = min(1.0, (right - EDGE * (right - left) - start) / h) if powers[1] else 1.0
        if high > low:
            value, part = lowest(gap, np.linspace(low, high, PER_ELEMENT + 1))
            if value < best:
                best, where = value, start + h * part
    return Condition(TOUCHES, stretch, 0.0 if abs(best) < NOISE else best, where)


def _power(state: PatternedState, stretch: int, last: bool) -> int:
    """Like which power of the distance the gap opens at an end of a free stretch."""
    neighbour = stretch + (1 if last else -1)
    touching = state.pattern.touching
    if 0 <= neighbour < len(touching):
        return 3 if touching[neighbour] else 2
    held = state.solved.shape.chain.held[-1 if last else 0]
    return 2 if held[0] and held[2] else (1 if held[0] else 0)


def lowest(function: Callable[[FloatArray], FloatArray], xi: FloatArray) -> tuple[float, float]:
    """Least value of a smooth function over samples, looked at more closely, and where; a parabola is the last step."""
    for zoom in range(ZOOMS):
        values = function(xi)
        k = int(np.argmin(values))
        low, high = max(k - 1, 0), min(k + 1, xi.size - 1)
        if zoom < ZOOMS - 1:
            xi = np.linspace(xi[low], xi[high], CLOSER)
    if high - low < 2:
        return float(values[k]), float(xi[k])
    a, b, c = values[k - 1 : k + 2]
    bend, tilt = a - 2.0 * b + c, 0.5 * (c - a)
    if not bend > 0.0:
        return float(b), float(xi[k])
    return float(b - 0.5 * tilt**2 / bend), float(xi[k] - tilt / bend * (xi[k] - xi[k - 1]))


def watched(condition: Condition, state: PatternedState) -> float:
    """The value of a condition in another state of the same pattern."""
    if condition.kind == OPENS:
        return pressing(state, condition.number)[0].value
    if condition.kind == TOUCHES:
        return apart(state, condition.number).value
    if condition.kind == GROWS:
        return float(state.solved.openings[condition.number])
    if condition.kind in (GROWS_AT_END, UNHELD):
        at = _at_end(state, bool(condition.number))
        return np.nan if at is None else at.value
    return _pushing(state, condition.number)
