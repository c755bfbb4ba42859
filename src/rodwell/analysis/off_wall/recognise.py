"""From a minimum behind a soft wall to the state behind the hard one: the pattern is read off, solved, and put right."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.off_wall.arrange import solved
from rodwell.analysis.off_wall.changes import FIRST_CONTACT, changed
from rodwell.analysis.off_wall.conditions import LEAVES, PatternedState, conditions
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.carry import sampler
from rodwell.numerics.stretches.chain import Shape
from rodwell.problem.ends import HOLD_ANGLE

SAMPLES = 1200
POINT = 0.02
"""Stretches of penetration shorter than this, in L, are tried as points of contact."""

NARROW = 0.004
"""Gaps behind a soft wall that are narrower than this are not counted."""

MOST_REPAIRS = 8


def recognised(model: RodInHole, shape: Shape) -> PatternedState | None:
    """The equilibrium behind the hard wall close to one behind a soft wall; None if none was found."""
    sample = sampler(shape)
    s = np.linspace(0.0, 1.0, SAMPLES + 1)
    fields, angle = sample(s)
    depth = np.hypot(fields[0, 0], fields[1, 0]) - 1.0
    turns = int(np.round(angle[0, -1] / (2.0 * np.pi))) if model.problem.ends[1] in HOLD_ANGLE else 0
    for point in (POINT, 3.0 * POINT, 0.25 * POINT):
        touching, breaks = _stretches(s, depth > 0.0, point)
        state = solved(model, Pattern(touching, turns), breaks, shape.load, sample)
        if state is not None:
            state = _put_right(state)
        if state is not None:
            return state
    return None


def _stretches(s: np.ndarray, deep: np.ndarray, point: float) -> tuple[tuple[bool, ...], np.ndarray]:
    """Stretches and their ends from where the soft wall is pressed in."""
    change = np.flatnonzero(np.diff(deep.astype(int))) + 1
    ends = [0.0, *(float(0.5 * (s[i] + s[i - 1])) for i in change), 1.0]
    on = [bool(deep[0])]
    for _ in change:
        on.append(not on[-1])
    pieces = [[flag, a, b] for flag, a, b in zip(on, ends[:-1], ends[1:], strict=True)]
    merged: list[list] = []
    for flag, a, b in pieces:  # gaps too narrow to count are closed
        really = flag or (b - a < NARROW)
        if merged and merged[-1][0] and really:
            merged[-1][2] = b
        else:
            merged.append([really, a, b])
    touching: list[bool] = []
    breaks: list[float] = []
    for flag, a, b in merged:
        inner = a > 0.0 and b < 1.0
        if flag and b - a < point:
            if inner:
                breaks.append(0.5 * (a + b))
            continue
        if touching and breaks and len(breaks) < len(touching):
            breaks.append(a)
        touching.append(flag)
    if not touching:
        return (True,), np.zeros(0)
    return tuple(touching), np.array(breaks)


def _put_right(state: PatternedState) -> PatternedState | None:
    """Change the pattern at a fixed load until every condition holds."""
    for _ in range(MOST_REPAIRS):
        broken = [one for one in conditions(state) if one.value < -1e-9]
        if not broken:
            return state
        worst = min(broken, key=lambda one: one.value)
        if worst.kind == LEAVES:
            return None
        after = changed(state, [worst])
        if after is None:
            return None
        found = solved(
            state.model, after.state.pattern, after.state.solved.shape.breaks, state.load,
            sampler(after.state.solved.shape),
        )  # fmt: skip
        if found is None:
            return None
        state = found
    return None


__all__ = ["FIRST_CONTACT", "recognised"]
