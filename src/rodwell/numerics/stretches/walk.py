"""From one equilibrium of a chain to the next along its path, and to places on it where a function vanishes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rodwell.numerics.stretches.bordered import Row
from rodwell.numerics.stretches.chain import Chain, Shape
from rodwell.numerics.stretches.newton import Outcome, Solved, solve
from rodwell.quantities.arrays import FloatArray

BREAK_SCALE, LOAD_SCALE = 0.1, 0.1
"""What counts as one unit of arclength: a break moved by a tenth of the length, the load changed by a tenth."""

LOCATED, MOST_OF_STEP = 1e-11, 1e-3
"""Arclength to which a zero is located; but no coarser than to this part of a step."""

MOST_SECANTS = 6
"""How often a zero that is close by is sought by secants."""

AS_GOOD_AS_ZERO = 1e-7
"""Part of its values at the ends of a step below which a function counts as zero where Newton's method fails."""


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """A direction along a path: derivatives of nodes, breaks, load and bubbles by arclength."""

    nodes: FloatArray
    breaks: FloatArray
    load: float
    bubbles: FloatArray

    def times(self, factor: float) -> Motion:
        """The same, stretched."""
        return Motion(self.nodes * factor, self.breaks * factor, self.load * factor, self.bubbles * factor)


def metric(chain: Chain, load: float) -> tuple[FloatArray, float, float]:
    """Weights of nodes (4,), breaks and load in the square of arclength."""
    wavenumber = max(abs(load), 1.0)
    per_node = 1.0 / (chain.elements + 1)
    weights = per_node * np.array([1.0, 1.0, 1.0 / wavenumber, 1.0 / wavenumber])
    return weights, BREAK_SCALE**-2, (LOAD_SCALE * max(abs(load), 1.0)) ** -2


def length(motion: Motion, chain: Chain, load: float) -> float:
    """Arclength of a motion."""
    nodes, breaks, by_load = metric(chain, load)
    square = np.sum(nodes * motion.nodes**2) + breaks * np.sum(motion.breaks**2) + by_load * motion.load**2
    return float(np.sqrt(square))


def row_of(motion: Motion, chain: Chain, load: float) -> Row:
    """The row whose left side is the product with a motion in the metric."""
    nodes, breaks, by_load = metric(chain, load)
    return Row(nodes * motion.nodes, breaks * motion.breaks, by_load * motion.load, 0.0)


def tangent(state: Solved, before: Motion) -> Motion:
    """Unit tangent at a state that points like ``before``."""
    chain, load = state.shape.chain, state.shape.load
    found = Motion(*state.tangent(row_of(before, chain, load)))
    return found.times(1.0 / length(found, chain, load))


def tangent_in_load(state: Solved, sign: float) -> Motion:
    """Unit tangent along which the load changes in the sense of ``sign``."""
    chain = state.shape.chain
    none = np.zeros_like(state.shape.nodes), np.zeros_like(state.shape.breaks)
    found = Motion(*state.tangent(Row(*none, np.sign(sign), 0.0)))
    return found.times(1.0 / length(found, chain, state.shape.load))


def _moved(shape: Shape, motion: Motion, step: float) -> Shape:
    by = motion.times(step)
    return shape.moved(by.nodes, by.bubbles, by.breaks, by.load)


Passed = tuple[Solved, Motion]
"""A state, and the direction of the path there."""


def step(
    model: Any, state: Solved, along: Motion, size: float, before: Passed | None = None
) -> tuple[Outcome, Solved | None, int]:
    """One step of arclength ``size`` along a tangent; Newton's method begins :func:`ahead`."""
    shape = state.shape
    row = row_of(along, shape.chain, shape.load)
    row = replace(row, target=row.of(shape.nodes, shape.breaks, shape.load) + size)
    return solve(model, ahead(shape, along, size, before), row)


def ahead(shape: Shape, along: Motion, size: float, before: Passed | None) -> Shape:
    """The shape to be expected at a distance along a tangent: on it, to first order.

    To third, where a state ``before`` is on the same chain: on the cubic through both with their tangents.
    """
    if before is None or before[0].shape.chain is not shape.chain:
        return _moved(shape, along, size)
    back, rate = between(shape, before[0].shape), before[1]
    row = row_of(along, shape.chain, shape.load)
    far, turned = (row.of(motion.nodes, motion.breaks, motion.load) for motion in (back, rate))
    if not far < 0.0 < turned:
        return _moved(shape, along, size)
    part = -size / far
    shape = _moved(shape, along, size * (1.0 + part) ** 2)
    shape = _moved(shape, rate, size * part * (1.0 + part) / turned)
    return _moved(shape, back, part**2 * (3.0 + 2.0 * part))


def between(first: Shape, second: Shape) -> Motion:
    """The motion from one shape of a chain to another."""
    return Motion(
        second.nodes - first.nodes, second.breaks - first.breaks, second.load - first.load,
        second.bubbles - first.bubbles,
    )  # fmt: skip


def _interpolated(known: dict[float, Shape], part: float) -> Shape:
    """A shape between known ones of a chain: by the parabola through the three nearest, or the chord of two."""
    near = sorted(known, key=lambda other: abs(other - part))[:3]
    shape = known[near[0]]
    for k, at in enumerate(near[1:], 1):
        others = [other for i, other in enumerate(near) if i != k]
        weight = math.prod((part - other) / (at - other) for other in others)
        shape = _moved(shape, between(known[near[0]], known[at]), weight)
    return shape


class _Lost(Exception):  # noqa: N818 - says what happened, and never leaves this file
    """Newton's method failed within a step."""


def zero_within(value: Callable[[float], float], ends: tuple[float, float], xtol: float) -> float:
    """A place within [0, 1] where ``value``, of opposite signs at the ``ends``, vanishes to ``xtol``.

    By inverse interpolation, and by halves where that leads out of the bracket or does not halve it in three steps. A
    value is a solve: it is not asked for once more beyond the zero only to bracket it as closely as it is known.
    """
    known, (low, high) = [(0.0, ends[0]), (1.0, ends[1])], (0.0, 1.0)
    widths = [np.inf] * 2 + [1.0]
    while high - low > xtol:
        part = _inverse(known[-3:])
        if not low < part < high or 2.0 * widths[-1] > widths[-3]:
            part = 0.5 * (low + high)
        elif len(known) > 2 and abs(part - known[-1][0]) <= xtol:
            break
        known.append((part, value(part)))
        if known[-1][1] == 0.0:
            break
        low, high = (low, part) if known[-1][1] * ends[1] > 0.0 else (part, high)
        widths.append(high - low)
    return known[-1][0]


def _inverse(known: list[tuple[float, float]]) -> float:
    """Where the polynomial vanishes that gives the places of two or three values; NaN where values are alike."""
    found = 0.0
    for part, value in known:
        others = [other for _, other in known if other != value]
        if len(others) < len(known) - 1:
            return math.nan
        found += part * math.prod(other / (other - value) for other in others)
    return found


def locate(model: Any, first: Solved, second: Solved, function: Callable[[Solved], float]) -> Solved | None:
    """The state between two where ``function`` vanishes, sought in the part of the step from the first.

    None if Newton's method fails on the way, or if the function does not change its sign between the two.
    """
    chord = between(first.shape, second.shape)
    base = row_of(chord, first.shape.chain, first.shape.load)
    low, high = (base.of(one.shape.nodes, one.shape.breaks, one.shape.load) for one in (first, second))
    known = {0.0: (first, function(first)), 1.0: (second, function(second))}
    xtol = min(LOCATED / length(chord, first.shape.chain, first.shape.load), MOST_OF_STEP)
    if not known[0.0][1] * known[1.0][1] < 0.0:
        return next((state for state, value in known.values() if value == 0.0), None)

    def value(part: float) -> float:
        if part not in known:
            row = replace(base, target=low + part * (high - low))
            state = solve(model, _interpolated({other: known[other][0].shape for other in known}, part), row)[1]
            if state is None:
                raise _Lost
            known[part] = state, function(state)
            if not np.isfinite(known[part][1]):
                raise _Lost
        return known[part][1]

    try:
        root = zero_within(value, (known[0.0][1], known[1.0][1]), xtol)
    except _Lost:  # right at a branch point the equations are singular: as near as that is found
        size = max(abs(known[0.0][1]), abs(known[1.0][1]))
        best, left = min(known.values(), key=lambda one: abs(one[1]))
        return best if abs(left) <= AS_GOOD_AS_ZERO * size else None
    return known[root][0]


def search(
    model: Any, state: Solved, along: Motion, function: Callable[[Solved], float], first: float, largest: float
) -> Solved | None:
    """The nearest state, either way along a path, where ``function`` vanishes, in steps that double.

    For states that lie just beside one: the sign of the derivative tells which way to go.
    """
    value = function(state)
    if value == 0.0:
        return state
    other = step(model, state, along, first)[1]
    if other is None:
        return None
    beside = function(other)
    near = _straight_to(model, state, along, function, (value, beside), first)
    if near is not None:
        return near
    ahead = abs(beside) < abs(value) or beside * value < 0.0
    for sign in (1.0, -1.0) if ahead else (-1.0, 1.0):
        found = _towards(model, state, along.times(sign), function, first, largest)
        if found is not None:
            return found
    return None


def _straight_to(
    model: Any,
    state: Solved,
    along: Motion,
    function: Callable[[Solved], float],
    values: tuple[float, float],
    size: float,
) -> Solved | None:
    """The state where ``function`` vanishes, if secants find it no farther away than ``size``; else None.

    ``values``: at the state, and at that distance from it along the path.
    """
    (last, value), here, place = (values[1], values[0]), size, 0.0
    for _ in range(MOST_SECANTS):
        rise = value - last
        ahead = place - value * (place - here) / rise if rise else np.inf
        if not abs(ahead) <= size:
            return None
        here, place, last = place, ahead, value
        found = step(model, state, along, place)[1]
        if found is None:
            return None
        value = function(found)
        if abs(place - here) <= LOCATED or value == 0.0:
            return found
    return None


def _towards(
    model: Any, here: Solved, along: Motion, function: Callable[[Solved], float], size: float, largest: float
) -> Solved | None:
    """The next state along a path where ``function`` vanishes, in steps that double from ``size`` to ``largest``."""
    value = function(here)
    while size <= largest:
        other = step(model, here, along, size)[1]
        if other is None:
            return None
        if function(other) * value <= 0.0:
            return locate(model, here, other, function)
        along = tangent(other, along)
        here, size = other, 2.0 * size
    return None
