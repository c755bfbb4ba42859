"""States of a rod that may leave the wall between those along which a path was followed."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from rodwell.analysis.off_wall.certificate import LIMIT
from rodwell.analysis.off_wall.conditions import PatternedState, conditions
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.errors import NotConvergedError

ROUND_OFF = 1e-12
"""By how much of itself a value asked for may lie beyond the last state."""

MISSED = -1e-9
"""A condition on contact below this does not hold."""

MOST_ATTEMPTS = 40
"""How often a state that is asked for is sought, in ever smaller steps from a known one."""


def around(
    run: Sequence[PatternedState], value: float, control: Control
) -> list[tuple[PatternedState, PatternedState]]:
    """Pairs of neighbouring states between which a value of the controlled quantity lies, in order."""
    slack, known = ROUND_OFF * abs(value), [control.value(state.solved) for state in run]
    ends = zip(pairwise(run), pairwise(known), strict=True)
    return [pair for pair, (a, b) in ends if min(a, b) - slack <= value <= max(a, b) + slack]


def nearest_first(pair: Sequence[PatternedState], value: float, control: Control) -> list[PatternedState]:
    """The states of a pair, the one nearer to a value first."""
    return sorted(pair, key=lambda state: abs(control.value(state.solved) - value))


def state_at(near: Sequence[PatternedState], value: float, control: Control, path: str) -> ContactState:
    """The state at a value of what is controlled, from known ones near it; ``path`` names what they belong to.

    Raises
    ------
    NotConvergedError
        If none was found whose contacts push and whose certificate holds.
    """
    missed = ""
    for known in near:
        state = control.at(known, value, MOST_ATTEMPTS)
        if state is None or any(one.value <= MISSED for one in conditions(state)):
            continue
        found = contact_state(state)
        if found.certificate.worst <= LIMIT:
            return found
        missed = f": what was found misses its balance by {found.certificate.worst:.1e}"
    raise NotConvergedError(f"no state of the {path} was found at {control.name} = {value:.8g}{missed}")
