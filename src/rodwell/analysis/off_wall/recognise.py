"""From a minimum behind a soft wall to the state behind the hard one: the pattern is read off, solved, put right."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, pairwise
from typing import NamedTuple

import numpy as np

from rodwell.analysis.off_wall.arrange import arranged, solved
from rodwell.analysis.off_wall.changes import changed
from rodwell.analysis.off_wall.conditions import LEAVES, PatternedState, conditions
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern, pieces_of
from rodwell.numerics.stretches.carry import Sampler, sampler
from rodwell.numerics.stretches.chain import Shape
from rodwell.numerics.stretches.descent import descended
from rodwell.problem.ends import HOLD_ANGLE
from rodwell.quantities.arrays import BoolArray, FloatArray

SAMPLES = 2000

STIFFNESSES = (1e7, 1e8, 1e9, 1e10)
"""Of the soft wall, in B/L⁴, one after the other."""

FINER_FROM = 1e9
"""Stiffness from which on the mesh of the soft wall has twice as many elements."""

POINT, END = 5.0, 3.0
"""Over how many lengths k^(−1/4) a concentrated force is spread behind a soft wall: within the rod, and at an end."""

DOUBTFUL = 2.0
"""Contacts shorter or longer than that by up to this factor are tried both as points and as stretches."""

MOST_DOUBTS, MOST_TRIES = 4, 8

NARROW = 0.004
"""Gaps behind a soft wall that are narrower than this are not counted."""

NEAR, NEAR_TIP, TINY = 0.02, 0.06, 1e-3
"""How far the energies behind soft and hard wall may differ: relative, the same with a loose end that is pressed in,
which costs as k^(−1/2), and absolute in BΔ²/L³."""

MOST_REPAIRS = 8


class _Piece(NamedTuple):
    """A piece of the rod: in contact or not, and from where to where."""

    on: bool
    left: float
    right: float


def recognised(model: RodInHole, shape: Shape, control: Control, value: float) -> PatternedState | None:
    """The stable equilibrium behind the hard wall close to a minimum behind a soft one; None if none was found.

    With a value of what is controlled. The wall is made stiffer until the pattern that it shows can be solved for:
    forces that are concentrated behind a hard wall are spread over lengths like k^(−1/4).
    """
    firmness = model.firmness(shape.load)
    for one in STIFFNESSES:
        stiffness = one * firmness
        if one == FINER_FROM:
            ends = np.concatenate([[0.0], pieces_of(model.problem)[0], [1.0]])
            pieces = np.histogram(0.5 * (shape.places[1:] + shape.places[:-1]), ends)[0]
            shape, _ = arranged(
                model, Pattern((False,)), np.zeros(0), shape.load, sampler(shape), degree=shape.chain.degree,
                elements=(tuple(2 * pieces),),
            )  # fmt: skip
        low = descended(model, shape, stiffness, control.row(shape.chain, value), control.index_at)
        if low is None:
            return None
        shape = low.shape
        state = _solved(model, shape, stiffness, low.out.energy, control)
        if state is not None:
            return state
    return None


def _solved(model: RodInHole, shape: Shape, stiffness: float, energy: float, control: Control) -> PatternedState | None:
    """The valid, stable state of the pattern of a minimum behind a soft wall."""
    sample = sampler(shape)
    s = np.linspace(0.0, 1.0, SAMPLES + 1)
    fields, angle = sample(s)
    depth = np.hypot(fields[0, 0], fields[1, 0]) - 1.0
    turns = int(np.round(angle[0, -1] / (2.0 * np.pi))) if model.problem.ends[1] in HOLD_ANGLE else 0
    loose = [end for end, kind in zip((0.0, 1.0), model.problem.ends, strict=True) if kind == "loose"]
    touched = [end for end in loose if depth[int(end) * SAMPLES] > 0.0]
    for tried, (touching, breaks) in enumerate(_readings(_pieces(s, depth > 0.0), stiffness**-0.25)):
        if tried >= MOST_TRIES:
            return None
        edges = tuple(end for end in touched if not touching[-int(end)])
        state = _polished(model, Pattern(touching, turns, edges=edges), breaks, shape.load, sample, control)
        near = NEAR_TIP if edges else NEAR
        if state is not None and abs(state.solved.out.energy - energy) <= near * abs(energy) + TINY:
            return state
    return None


def _polished(
    model: RodInHole, pattern: Pattern, breaks: FloatArray, load: float, sample: Sampler, control: Control
) -> PatternedState | None:
    state = solved(model, pattern, breaks, load, sample)
    state = None if state is None else _put_right(state)
    return state if state is not None and control.index_at(state.solved) == 0 else None


def _pieces(s: FloatArray, deep: BoolArray) -> list[_Piece]:
    """Pieces in contact and free in turn, from where the soft wall is pressed in; too narrow gaps are closed."""
    change = np.flatnonzero(np.diff(deep.astype(int))) + 1
    ends = [0.0, *(float(0.5 * (s[i] + s[i - 1])) for i in change), 1.0]
    merged: list[_Piece] = []
    on = bool(deep[0])
    for left, right in pairwise(ends):
        here = on or right - left < NARROW
        if merged and merged[-1].on and here:
            merged[-1] = merged[-1]._replace(right=right)
        else:
            merged.append(_Piece(here, left, right))
        on = not on
    return merged


def _readings(pieces: list[_Piece], width: float) -> Iterator[tuple[tuple[bool, ...], FloatArray]]:
    """Patterns that pieces may mean, the likeliest first: doubtful contacts are points or stretches."""
    limits = [(END if k in (0, len(pieces) - 1) else POINT) * width for k in range(len(pieces))]
    lengths = [piece.right - piece.left for piece in pieces]
    short = {k for k, piece in enumerate(pieces) if piece.on and lengths[k] < limits[k] and len(pieces) > 1}
    doubts = [
        k for k, piece in enumerate(pieces)
        if piece.on and len(pieces) > 1 and limits[k] / DOUBTFUL < lengths[k] < limits[k] * DOUBTFUL
    ]  # fmt: skip
    doubts = sorted(doubts, key=lambda k: abs(np.log(lengths[k] / limits[k])))[:MOST_DOUBTS]
    for count in range(len(doubts) + 1):
        for turned in combinations(doubts, count):
            yield _reading(pieces, short ^ set(turned))


def _reading(pieces: list[_Piece], short: set[int]) -> tuple[tuple[bool, ...], FloatArray]:
    """A pattern and its breaks; ``short`` contacts are points within, and nothing at an end of the rod."""
    touching: list[bool] = []
    breaks: list[float] = []
    last = len(pieces) - 1
    for k, piece in enumerate(pieces):
        if k in short:
            if 0 < k < last:
                breaks.append(0.5 * (piece.left + piece.right))
            continue
        if touching and len(breaks) < len(touching):
            breaks.append(piece.left)
        touching.append(piece.on)
    return tuple(touching), np.array(breaks)


def _put_right(state: PatternedState) -> PatternedState | None:
    """Change the pattern at a fixed load until every condition holds."""
    for _ in range(MOST_REPAIRS):
        broken = [one for one in conditions(state) if one.value < -1e-9]
        if not broken:
            return state
        worst = min(broken, key=lambda one: one.value)
        after = None if worst.kind == LEAVES else changed(state, [worst])
        if after is None:
            return None
        shape = after.state.solved.shape
        found = solved(state.model, after.state.pattern, shape.breaks, state.load, sampler(shape))
        if found is None:
            return None
        state = found
    return None
