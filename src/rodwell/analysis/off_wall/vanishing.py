"""Stretches that become so short that they vanish: which ones, and how the path goes on without them.

A gap that a rod opens with its slope, at a ball joint or around a step of its stiffness, has a length in proportion to
|φ′| there, and closes where φ′ goes through zero: contact is complete in that very state, and right behind it, where
the slope has the other sign, the rod leaves the wall anew. A gap so short is not followed to its end: third derivatives
within it, and with them the balance, are lost in round-off.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rodwell.analysis.off_wall.arrange import solved, wavenumber
from rodwell.analysis.off_wall.certificate import LIMIT
from rodwell.analysis.off_wall.changes import FIRST_CONTACT, Changed, changed
from rodwell.analysis.off_wall.conditions import (
    GROWS,
    GROWS_AT_END,
    OPENS,
    UNHELD,
    Condition,
    PatternedState,
    conditions,
    slope_at,
    watched,
)
from rodwell.analysis.off_wall.state import contact_state
from rodwell.analysis.off_wall.steps import around_kink, closes_with_slope, length_with_slope, shortest_with_slope
from rodwell.errors import NotConvergedError
from rodwell.numerics.stretches.carry import sampler
from rodwell.numerics.stretches.newton import Solved
from rodwell.numerics.stretches.walk import search, tangent_in_load
from rodwell.quantities.arrays import FloatArray

SHORT_GAP = 0.3
"""Length of a gap, times the wavenumber, below which it is about to close."""

SEARCH, FARTHEST = 1e-4, 0.4
"""First and longest step in which the place is sought where a short stretch has vanished."""

LONGER = 1.3
"""Gaps at kinks of the stiffness are about to close when they are so many times as long as when they do."""

AS_SHORT = 1.05
"""Stretches longer by no more than this factor vanish together."""

DOUBTFUL = 5e-4
"""Length of a free stretch, in L, below which the balance of the state is looked at before it is taken."""


def about_to_vanish(state: PatternedState, rates: FloatArray) -> list[int]:
    """The shortest of the stretches that are about to vanish, and those as short; ``rates`` (k,) are of their lengths.

    Empty if none is.
    """
    lengths = np.diff(state.bounds)
    short = [i for i, on in enumerate(state.pattern.touching) if rates[i] < 0.0 and lengths[i] < _least(state, i, on)]
    first = min(short, key=lambda i: lengths[i], default=0)
    return sorted((i for i in short if lengths[i] < AS_SHORT * lengths[first]), key=lambda i: lengths[i])


def _least(state: PatternedState, i: int, on: bool) -> float:
    """The length below which a stretch that becomes shorter is about to vanish."""
    touching = state.pattern.touching
    if on or state.pattern.between_points(i):
        return FIRST_CONTACT
    if closes_with_slope(state, i):
        return shortest_with_slope(state.problem)
    if (least := around_kink(state, i)) is not None:
        return LONGER * least
    beside_line = any(touching[k] for k in (i - 1, i + 1) if 0 <= k < len(touching))  # that it can close up to
    return SHORT_GAP / wavenumber(state.model, state.load) if beside_line else 0.0


def shortened(state: PatternedState, stretches: list[int]) -> tuple[Changed, Condition] | None:
    """The pattern without stretches that have become very short, and the condition that vanishes where the first goes.

    A contact stretch becomes a point, or nothing at an end; a gap closes; two points of contact with a gap between them
    become one.
    """
    shape, bounds = state.solved.shape, state.bounds
    touching, breaks = list(state.pattern.touching), list(shape.breaks)
    first, where = stretches[0], float(np.mean(bounds[stretches[0] : stretches[0] + 2]))
    for i in sorted(stretches, reverse=True):
        last = i == len(state.pattern.touching) - 1
        if touching[i] and i > 0 and not last:
            del touching[i]
            breaks[i - 1 : i + 1] = [0.5 * (breaks[i - 1] + breaks[i])]
        elif touching[i]:
            del touching[i], breaks[-1 if last else 0]
        elif state.pattern.between_points(i):
            del touching[i]
            breaks[i - 1 : i + 1] = [0.5 * (breaks[i - 1] + breaks[i])]
        else:
            _close(touching, breaks, i)
    held = [end for end, on in zip((0.0, 1.0), (touching[0], touching[-1]), strict=True) if on]
    edges = tuple(edge for edge in state.pattern.edges if edge not in held)
    new = replace(state.pattern, touching=tuple(touching), edges=edges)
    found = solved(state.model, new, np.array(breaks), state.load, sampler(shape))
    if found is None:
        return None
    on, ends = state.pattern.touching[first], first in (0, len(state.pattern.touching) - 1)
    merged = state.pattern.between_points(first)
    at_kink = not on and around_kink(state, first) is not None
    closed = UNHELD if at_kink or closes_with_slope(state, first) else OPENS
    kind = (GROWS_AT_END if ends else GROWS) if on or merged else closed
    name = ("contact_lost" if ends else "contact_point") if on else "contacts_merge" if merged else "gap_closes"
    name = "" if at_kink else name
    near = [one for one in conditions(found) if one.kind == kind]
    if not near:
        return None
    condition = min(near, key=lambda one: abs(one.s - where))
    if kind == UNHELD and not at_kink:
        return Changed(found, _turned_over(found.solved, condition.s), name), condition
    return Changed(found, lambda one: watched(condition, PatternedState(new, found.elements, one)), name), condition


def _turned_over(before: Solved, s: float) -> Callable[[Solved], float]:
    """The slope at a place with the sign that makes it negative in a state: it grows through zero."""
    sign = -np.sign(slope_at(before.shape, s))
    return lambda one: float(sign * slope_at(one.shape, s))


def opened_again(closed: Changed, at: list[Condition], load_sense: float) -> Changed | None:
    """The first state behind the one where gaps have closed that open with the slope: it has the other sign there.

    ``closed`` is the state in between, ``at`` the conditions that vanish in it. None if no state was found.
    """
    state, problem = closed.state, closed.state.problem
    steep = shortest_with_slope(problem) / length_with_slope(problem, 1.0)
    along = tangent_in_load(state.solved, load_sense)
    bent = search(state.model, state.solved, along, lambda one: closed.grows(one) - steep, SEARCH, FARTHEST)
    if bent is None:
        return None
    held = PatternedState(state.pattern, state.elements, bent)
    places = {one.s for one in at}
    opened = changed(held, [one for one in conditions(held) if one.kind == UNHELD and one.s in places])
    return opened if opened is not None and all(one.value >= 0.0 for one in conditions(opened.state)) else None


def unbalanced(state: PatternedState) -> str | None:
    """Why a state with very short free stretches is not to be given: in words, by how much it misses its balance."""
    lengths = np.diff(state.bounds)
    short = [float(lengths[i]) for i, on in enumerate(state.pattern.touching) if not on and lengths[i] < DOUBTFUL]
    if not short or state.model.soft:
        return None
    try:
        worst = contact_state(state).certificate.worst
    except NotConvergedError as error:
        return str(error)
    why = f"a gap of {min(short):.1e} L at F = {state.load:.8g} B/L² is too short: balance is missed by {worst:.1e}"
    return why if worst > LIMIT else None


def _close(touching: list[bool], breaks: list[float], i: int) -> None:
    """Close a gap: its stretch and the contact beside it become one."""
    touching[i] = True
    if i + 1 < len(touching) and touching[i + 1]:
        del touching[i + 1], breaks[i]
    if i > 0 and touching[i - 1]:
        del touching[i - 1], breaks[i - 1]
