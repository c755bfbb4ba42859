"""States of a branch off the wall once more, by another program: see :mod:`rodwell.analysis.beyond.other_program`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rodwell.analysis.beyond.off_wall_branch import OffWallBranch
from rodwell.analysis.beyond.other_program import Again, check_known, solved_again
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.state import ContactState
from rodwell.quantities.arrays import FloatArray

ELSEWHERE = 0.01
"""The start is the state of the same pattern whose load differs by about this part of itself."""

BETWEEN = 202
"""Places along the rod at which fields are compared: none of them is at mid-length, where ends of stretches meet."""


class Compared(NamedTuple):
    """What came of a state: largest differences by name, the engine's own errors, the other's solution."""

    differences: dict[str, float]
    known: dict[str, float]
    again: Again


def compared(beyond: OffWallBranch, force: float, rtol: float) -> Compared:
    """Solve the first state at an end force in B/L² once more.

    Differences are relative to each field's largest value, those of ends of stretches in L, those of
    concentrated forces relative to the whole contact force.

    Raises
    ------
    InputError
        If the branch does not pass that force off the wall, or the other program does not know its problem.
    NotConvergedError
        If the engine's state could not be computed.
    """
    check_known(beyond.problem)
    state, s = beyond.at(force), np.linspace(0.0, 1.0, BETWEEN)
    for start in _elsewhere(beyond, state):
        again = solved_again(start, force, rtol, s)
        if again.residual <= 2.0 * rtol:
            break
    own, errors = state.fields(s), state.field_errors(s)
    size = {name: float(np.max(np.abs(own[name]))) or 1.0 for name in again.fields}
    size["x"] = size["y"] = max(size["x"], size["y"])
    differences = {name: float(np.max(np.abs(own[name] - field))) / size[name] for name, field in again.fields.items()}
    forces = np.array([one.force.value for one in state.point_forces])
    if again.breaks.size:
        differences["ends of stretches"] = _largest(again.breaks - state.fine.bounds[1:-1])
        differences["concentrated forces"] = _largest(again.forces - forces) / state.contact_total.value
    return Compared(differences, {name: errors[name] / size[name] for name in again.fields}, again)


def _largest(values: FloatArray) -> float:
    return float(np.max(np.abs(values)))


def _elsewhere(beyond: OffWallBranch, state: ContactState) -> list[PatternedState]:
    """States of the same pattern at other loads, from which to start: some way off, and, if that fails, the nearest."""
    known, index = beyond.states, state.stability_index
    alike = [one for one in known if one.pattern == state.fine.pattern and one.solved.index == index]
    others = [one for one in alike if one.load != state.force] or [state.coarse]
    away = [abs(one.load - state.force) for one in others]
    wanted = ELSEWHERE * abs(state.force)
    picks = dict.fromkeys([int(np.argmin([abs(one - wanted) for one in away])), int(np.argmin(away))])
    return [others[i] for i in picks]
