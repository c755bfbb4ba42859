"""States of a pattern at chosen breaks: chains made for them, states carried over, solved."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from rodwell.analysis.discrete.curved import stations_along
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import DEGREE, WAVES, Elements, Pattern, chain, counts, pieces_of
from rodwell.numerics.stretches.bordered import Row, fixed_load
from rodwell.numerics.stretches.carry import Sampler, fit, sampler
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.newton import Solved, solve
from rodwell.numerics.stretches.walk import Motion, row_of
from rodwell.problem.ends import HOLD_ANGLE
from rodwell.quantities.arrays import FloatArray

LONGEST_ELEMENT, SHORTEST_ELEMENT = 1.5, 0.45
"""An element may become this much longer, or shorter, than a new one would be."""

CURVED_WAVES = 0.4
"""WAVES in a curved hole, which presses the rod to the wall: beside short gaps there the push changes more sharply; and
where the clearance varies, which makes products of the clearance and the fields."""

BESIDE_STATION = 0.02
"""Part of an element's length from which on an end of a stretch is beside a station of the hole, which then is none."""

SOFT_WALL = 2.0
"""Wavenumber of a rod pressed into a soft wall, in units (k/B)^¼: its push has kinks where contact ends."""


def wavenumbers(model: RodInHole, load: float) -> FloatArray:
    """√(|N|/b) at its largest in each section (n,), of a beam column, at least that of a beam bedded on the wall.

    Where a section tapers, those of its least stiffness and largest weight.
    """
    b, bed = model.problem.rod.ranges["stiffness"][0], model.bed(load)
    if model.soft:
        bed = np.maximum(bed, SOFT_WALL**2 * np.sqrt(model.stiffness / b))
    return np.asarray(
        np.sqrt(np.max([*(np.abs(model.resultants(load)) / b), bed, np.full(b.size, math.pi**2)], axis=0))
    )


def wavenumber(model: RodInHole, load: float) -> float:
    """The largest of all sections."""
    return float(np.max(wavenumbers(model, load)))


def element_counts(
    model: RodInHole,
    breaks: FloatArray,
    load: float,
    waves: float | None = None,
    fewest: int = 1,
    fixed: tuple[float, ...] = (),
) -> Elements:
    """Elements of each piece of each stretch, as waves and tapers ask for; ``fixed`` as in :class:`Pattern`."""
    if waves is None:
        waves = WAVES if model.problem.hole is None and not model.inclined else CURVED_WAVES
    corners, section = pieces_of(model.problem, fixed)
    numbers = wavenumbers(model, load)
    if model.problem.tapered:
        numbers = np.maximum(numbers, WAVES * math.pi / model.problem.rod.stiffness_reach)
    return counts(breaks, corners, numbers[section], waves, fewest)


def arranged(
    model: RodInHole,
    pattern: Pattern,
    breaks: FloatArray,
    load: float,
    sample: Sampler,
    *,
    degree: int = DEGREE,
    elements: Elements | None = None,
) -> tuple[Shape, Elements]:
    """A shape of a pattern that follows a sampler, not yet in equilibrium, and its numbers of elements."""
    elements = elements or element_counts(model, breaks, load, fixed=pattern.fixed)
    links, held = chain(model.problem, model.given, pattern, elements, degree)
    return fit(links, breaks, load, sample, held), elements


def solved(
    model: RodInHole,
    pattern: Pattern,
    breaks: FloatArray,
    load: float,
    sample: Sampler,
    *,
    fixed: tuple[int, int] | None = None,
    degree: int = DEGREE,
    elements: Elements | None = None,
) -> PatternedState | None:
    """The equilibrium of a pattern near a sampled shape; None if Newton's method fails.

    It is at the load; or, where ``fixed`` names two ends of stretches (−1 and the number of breaks: the ends of the
    rod), at the distance they have now.
    """
    pattern = pattern if pattern.planar else replace(pattern, turns=turns_of(model, sample))
    if elements is None and model.problem.bent:
        pattern = replace(pattern, fixed=stations_within(model, breaks, load))
    shape, elements = arranged(model, pattern, breaks, load, sample, degree=degree, elements=elements)
    row = fixed_load(shape.chain, load) if fixed is None else _fixed_distance(shape, *fixed)
    state: Solved | None = solve(model, shape, row)[1]
    return PatternedState(pattern, elements, state) if state is not None and state.shape.in_order else None


def turns_of(model: RodInHole, sample: Sampler) -> int:
    """How often a shape winds around the hole: where the rod rolls over its axis, its end has turned once more."""
    if model.problem.ends[1] not in HOLD_ANGLE:
        return 0
    return int(np.round(float(sample(np.array([1.0]))[1][0, 0]) / (2.0 * np.pi)))


def _fixed_distance(shape: Shape, first: int, last: int) -> Row:
    weights = np.zeros(shape.breaks.size)
    if first >= 0:
        weights[first] -= 1.0
    if last < weights.size:
        weights[last] += 1.0
    return Row(np.zeros_like(shape.nodes), weights, 0.0, float(weights @ shape.breaks))


def at_load(state: PatternedState, load: float, attempts: int = 1) -> PatternedState | None:
    """The state of the same pattern at another load; None if it is not found.

    With more ``attempts`` than one it is sought in smaller steps where one is too long: a gap that is about to close
    has a length that goes like the root of the distance in load.
    """
    model, solved, step = state.model, state.solved, load - state.solved.shape.load
    for _ in range(attempts):
        # to the last bit where the step is all that is left
        target = load if step == load - solved.shape.load else solved.shape.load + step
        found = solve(model, solved.shape, fixed_load(solved.shape.chain, target))[1]
        if found is None:
            step *= 0.5
            continue
        if target == load:
            return PatternedState(state.pattern, state.elements, found)
        solved, step = found, load - found.shape.load
    return None


def refined(state: PatternedState, more: int, along: Motion | None = None) -> PatternedState | None:
    """The same state with elements of a degree higher by ``more``: appended bubbles start from zero.

    At the same load; or, with ``along``, at the same place along a path in that direction, which may fold in the load.
    """
    shape = state.solved.shape
    links = replace(shape.chain, degree=shape.chain.degree + more)
    bubbles = np.concatenate([shape.bubbles, np.zeros((*shape.bubbles.shape[:2], more))], axis=2)
    raised = Shape(links, shape.nodes, bubbles, shape.breaks, shape.load)
    row = fixed_load(links, shape.load)
    if along is not None:
        row = row_of(along, links, shape.load)
        row = replace(row, target=row.of(shape.nodes, shape.breaks, shape.load))
    found = solve(state.model, raised, row)[1]
    return None if found is None else PatternedState(state.pattern, state.elements, found)


def stations_within(model: RodInHole, breaks: FloatArray, load: float) -> tuple[float, ...]:
    """Stations of a surveyed hole at which elements of a string end: there the curvature has a kink of its rate.

    Not those next to ends of stretches, which move, or to steps.
    """
    stations = stations_along(model.problem)
    ends = np.concatenate([model.problem.rod.breaks, breaks])
    away = np.min(np.abs(stations[:, None] - ends), axis=1) > BESIDE_STATION * _length_of_element(model, load)
    return tuple(map(float, stations[away]))


def _length_of_element(model: RodInHole, load: float) -> float:
    return CURVED_WAVES * math.pi / wavenumber(model, load)


def _at_stations(state: PatternedState) -> bool:
    """Whether an end of a stretch has come to a station at which elements end, or has left one."""
    fixed, breaks = np.array(state.pattern.fixed), state.solved.shape.breaks
    near = 0.5 * BESIDE_STATION * _length_of_element(state.model, state.load)
    come = bool(np.any(np.abs(fixed[:, None] - breaks) < near))
    return come or len(stations_within(state.model, breaks, state.load)) > fixed.size


def needs_new_elements(state: PatternedState) -> bool:
    """Whether elements have become too long, or far too short, or an end of a stretch has come to a station."""
    if state.problem.bent and _at_stations(state):
        return True
    wanted = element_counts(state.model, state.solved.shape.breaks, state.load, fixed=state.pattern.fixed)
    return any(
        have * LONGEST_ELEMENT < want or (have > 1 and have * SHORTEST_ELEMENT > want)
        for pieces, wants in zip(state.elements, wanted, strict=True)
        for have, want in zip(pieces, wants, strict=True)
    )


def with_new_elements(state: PatternedState) -> PatternedState | None:
    """The same state on elements made for its stretches."""
    shape = state.solved.shape
    return solved(state.model, state.pattern, shape.breaks, shape.load, sampler(shape), degree=shape.chain.degree)
