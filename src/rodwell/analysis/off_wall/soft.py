"""Contact with a soft wall: where the rod is pressed in, and where pieces of contact appear or vanish along a path.

Behind a soft wall there is no pattern to be solved for: the rod is free everywhere, the wall pushes by k times the
depth where it is reached. Contact is read off the shape.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from rodwell.analysis.off_wall.arrange import solved
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.depth import Piece, depth
from rodwell.analysis.off_wall.happening import Followed, PathEvent
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.carry import angle_of, sampler
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.minima import lowest
from rodwell.numerics.stretches.newton import Solved, gap_curvature
from rodwell.numerics.stretches.walk import between, length, locate, tangent
from rodwell.quantities.arrays import FloatArray

WINDOW = 33
"""Places at which the extreme depth of a piece that appears is sought."""

CLOSER = 3
"""How often an event is located, each time on elements made for the place found before."""

TOGETHER = 1e-7
"""Part of a load by which events differ that are one, in mirror images."""

MOST_ALIGNED, ALIGNED = 6, 1e-10
"""How often elements are made anew until they end where contact does, and how closely, in L."""

NEXT_TO_NOTHING = 1e-4
"""Length in L of pieces for which no elements are made."""

JUMPED, NOT_FAR = 3.0, 2e-3
"""A step that ends farther away than it is long by this factor has missed a bend of the path; but not so close by."""

GAP, CONTACT = False, True


def sunk(model: RodInHole, load: float) -> PatternedState | None:
    """The straight rod at a load, pressed into a soft wall by its weight, as a beam on a bed of springs is.

    The start is the beam clamped at both ends, u = (w/k)(1 − e^{−βs}(cos βs + sin βs)) from either, β = (k/4B)^¼.
    """
    problem = model.problem
    rate, most = (0.25 * model.stiffness) ** 0.25, problem.lateral_weight / (model.stiffness * problem.clearance)

    def from_end(s: FloatArray) -> FloatArray:
        return np.asarray(1.0 - np.exp(-rate * s) * (np.cos(rate * s) + np.sin(rate * s)))

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields = np.zeros((2, 3, s.size))
        fields[0, 0] = -1.0 - most * from_end(s) * from_end(1.0 - s)
        return fields, angle_of(fields)

    # twist turns the curve of a rod that has sunk in out of its plane
    return solved(model, Pattern((False,), planar=problem.twist == 0.0), np.zeros(0), load, sample)


def stopped(state: PatternedState) -> PatternedState:
    """The same state where a planar rod without lateral weight has come to the wall, or has left it, in a step."""
    pattern, shape = state.pattern, state.solved.shape
    if not (state.model.soft and pattern.planar and state.problem.lateral_weight == 0.0):
        return state
    touches = any(state.touching)
    if pattern.stopped == touches:
        return state
    told = replace(pattern, stopped=touches)
    again = solved(state.model, told, np.zeros(0), shape.load, sampler(shape), elements=state.elements)
    return state if again is None else again


def settled(model: RodInHole, low: Solved) -> PatternedState | None:
    """A minimum to which a rod has gone, on elements made for it."""
    shape = low.shape
    return solved(model, Pattern((False,)), np.zeros(0), shape.load, sampler(shape))


def jumped(first: Solved, second: Solved, size: float) -> bool:
    """Whether a step of this size has missed a bend of the path, or come to another one.

    Where an arch without weight comes to the wall its path turns a corner.
    """
    shape = first.shape
    far = length(between(shape, second.shape), shape.chain, shape.load)
    return far > max(JUMPED * size, NOT_FAR)


def with_ends_of(state: PatternedState, other: PatternedState) -> PatternedState | None:
    """A state with elements that end where contact does in another one; pieces next to nothing are left out."""
    shape = state.solved.shape
    ends = [0.0]
    for end in map(float, other.bounds[1:-1]):
        if end - ends[-1] > NEXT_TO_NOTHING:
            ends.append(end)
        elif len(ends) > 1:
            ends.pop()
    kept = tuple(end for end in ends[1:] if end < 1.0 - NEXT_TO_NOTHING)
    pattern = replace(state.pattern, fixed=kept)
    return solved(state.model, pattern, np.zeros(0), shape.load, sampler(shape), degree=shape.chain.degree)


def aligned(state: PatternedState) -> PatternedState | None:
    """The same state with elements that end where contact does: the wall's push has kinks there."""
    for _ in range(MOST_ALIGNED):
        found = with_ends_of(state, state)
        if found is None or found.bounds.size != state.bounds.size:
            return found
        change, state = float(np.max(np.abs(found.bounds - state.bounds))), found
        if change < ALIGNED:
            break
    return state


def with_contact(path: Followed) -> list[PathEvent]:
    """The events of a path, with those where pieces of contact or gaps appear or vanish, in order."""
    states = path.states
    found = [(states.index(event.state), event) for event in path.events]
    for i, (one, other) in enumerate(pairwise(states)):
        for before, after, appears in ((one.pieces, other.pieces, True), (other.pieces, one.pieces, False)):
            new = [p for p in after if not any(p.on == q.on and p.overlaps(q) for q in before)]
            events = [at for piece in new if (at := _located(one, other, piece, appears)) is not None]
            found += [(i, event) for event in _joined(events)]
    return [event for _, event in sorted(found, key=lambda one: one[0])]


_NAMES = {
    (GAP, True): "gap_opens",
    (GAP, False): "gap_closes",
    (CONTACT, True): "touches",
    (CONTACT, False): "contact_lost",
}


def _located(one: PatternedState, other: PatternedState, piece: Piece, appears: bool) -> PathEvent | None:
    """Where a piece appears, or vanishes, between two states; found again on elements that end where contact does.

    Sought from the state without it.
    """
    value, place = _extreme(piece)
    without, at = (one, other) if appears else (other, one)
    beyond, along = at, None
    for _ in range(CLOSER):
        first, second = with_ends_of(without, at), with_ends_of(beyond, at)
        if first is None or second is None:
            return None
        found = locate(first.model, first.solved, second.solved, value)
        if found is None:
            return None
        at = PatternedState(first.pattern, first.elements, found)
        along = tangent(found, between(first.solved.shape, second.solved.shape))
    s = place(at.solved.shape)
    return PathEvent(_NAMES[piece.on, appears], at, (s,), value, [], along, (one, other))


def _extreme(piece: Piece) -> tuple[Callable[[Solved], float], Callable[[Shape], float]]:
    """The greatest depth, or gap, of a piece, which is zero where it appears; and where it is.

    At an end, which is held right at the wall, the curvature there in its place.
    """
    if piece.left == 0.0:
        return (lambda one: gap_curvature(one.shape, 0, 0.0)), (lambda _: 0.0)
    if piece.right == 1.0:
        return (lambda one: gap_curvature(one.shape, one.shape.chain.elements - 1, 1.0)), (lambda _: 1.0)
    sign, half = (1.0 if piece.on else -1.0), 0.5 * (piece.right - piece.left)
    places = np.linspace(max(piece.left - half, 0.0), min(piece.right + half, 1.0), WINDOW)[1:-1]

    def extreme(shape: Shape) -> tuple[float, float]:
        value, where = lowest(lambda s: -sign * depth(shape, s[0])[None], places[None])
        return -float(value[0]), float(where[0])

    return lambda one: extreme(one.shape)[0], lambda shape: extreme(shape)[1]


def _joined(events: list[PathEvent]) -> list[PathEvent]:
    """Events at one load told as one, with all their places."""
    out: list[PathEvent] = []
    for event in events:
        last = out[-1] if out else None
        if last is not None and last.kind == event.kind and _same(last, event):
            out[-1] = PathEvent(
                last.kind, last.state, tuple(sorted((*last.s, *event.s))), last.value, [], last.along, last.between
            )
        else:
            out.append(event)
    return out


def _same(one: PathEvent, other: PathEvent) -> bool:
    return abs(one.state.load - other.state.load) <= TOGETHER * max(abs(one.state.load), 1.0)
