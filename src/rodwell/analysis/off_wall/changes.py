"""How the pattern of contact goes on where conditions on it cease to hold.

A change starts from the state where a condition vanishes, or several at once, as in symmetric states. It gives the
first state of the new pattern, and a number that grows in the sense in which the path goes on there. A gap or a stretch
in contact starts with a small length, held while the load is solved for: right at its opening a gap has no height long
before it has no length.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.off_wall.arrange import solved, wavenumber
from rodwell.analysis.off_wall.bumps import beside, lowered, sides, within
from rodwell.analysis.off_wall.conditions import (
    BESIDE_STEP,
    CROSSES,
    GROWS,
    GROWS_AT_END,
    LEAVES_EDGE,
    LOST,
    OPENS,
    TOUCHES,
    UNHELD,
    Condition,
    PatternedState,
    conditions,
)
from rodwell.analysis.off_wall.pattern import pieces_of
from rodwell.analysis.off_wall.steps import (
    Plan,
    cross,
    edge_at,
    kinked,
    length_with_slope,
    open_at,
    release,
    shortest_with_slope,
)
from rodwell.numerics.stretches.carry import sampler
from rodwell.numerics.stretches.newton import Solved
from rodwell.numerics.stretches.walk import Motion, step, tangent_in_load

SPLITS = "splits"
"""What a point of contact does that cannot grow to a stretch, since that would pull."""

FIRST_GAP = 0.25
"""Half the length of a gap that opens, in wavelengths of a beam column over 2π."""

FIRST_CONTACT = 5e-4
"""Length of a contact stretch, in L, below which it is taken for a point: Newton's method is stiff there."""

PROBE = 1e-3
"""Arclength over which it is seen what grows in a new pattern."""

SHORTEST_CONTACT = 1.2e-4
"""Length below which no contact stretch starts, though what happens next is passed over with it."""

HALVINGS, ROUNDS = 5, 3
"""Sizes of a first gap, each half the one before; and how often others that would open next open with it."""

NAMES = {OPENS: "gap_opens", TOUCHES: "touches", LOST: "contact_lost", GROWS: "contact_line",
         SPLITS: "contact_splits", GROWS_AT_END: "contact_line", UNHELD: "gap_opens", CROSSES: "",
         LEAVES_EDGE: "contact_lost"}  # fmt: skip
"""What a change is called along a path. That an end of a stretch passes a step of a string is no event, nor that a gap
at a kink of the stiffness has become long enough to count: it has been there since the rod buckled."""


@dataclass(frozen=True, eq=False, repr=False)
class Changed:
    """The first state of a new pattern, what grows along the path from there, and where gaps have opened with it."""

    state: PatternedState
    grows: Callable[[Solved], float]
    name: str
    too: tuple[float, ...] = ()


def changed(state: PatternedState, vanished: list[Condition], part: float = 1.0) -> Changed | None:
    """The pattern after conditions have vanished at ``state``; None if no state of it was found that keeps the rest.

    ``part``: of the first length that a gap usually starts with.
    """
    first, vanished, last = vanished[0], list(vanished), None
    too: tuple[float, ...] = ()
    if any(one.kind == CROSSES and edge_at(state, one.s) is not None for one in vanished):
        return None  # contact up to the very edge of a narrower part would need a couple
    size = part * FIRST_GAP / wavenumber(state.model, state.load)
    for _ in range(ROUNDS):
        spots: list[float] = []
        for halved in range(HALVINGS):
            half, contact = size * 0.5**halved, max(2.2 * FIRST_CONTACT * 0.5**halved, SHORTEST_CONTACT)
            found, plan = _edited(state, vanished, half, contact, hold=True)
            if found is None:
                continue
            hurt = [one for one in conditions(found) if one.value < 0.0 and not _just_now(one)]
            name = "" if kinked(state, first.s) and first.kind == UNHELD else NAMES[first.kind]
            last = Changed(found, _growing(first, found, plan), name, too)
            if not hurt or first.kind not in (OPENS, GROWS, SPLITS, GROWS_AT_END):
                return last
            spots = [one.s for one in hurt if one.kind == OPENS] or spots
        if first.kind == GROWS and spots:
            return changed(state, [one._replace(kind=SPLITS) for one in vanished], part) or last
        following = _next(state, vanished, spots, size)
        if not following:
            break
        vanished += following
        too = (*too, *(one.s for one in following))
    return last if first.kind in (GROWS, GROWS_AT_END) else None


def unheld(state: PatternedState) -> list[Condition]:
    """Where a rod in contact leaves the wall, since nothing holds it radially there."""
    return [one for one in conditions(state) if one.kind == UNHELD and one.value < 0.0]


def _edited(
    state: PatternedState, conditions: list[Condition], half: float, contact: float, *, hold: bool
) -> tuple[PatternedState | None, Plan]:
    """The state of a pattern without the conditions, and the plan; ``hold``: the length that starts, not the load."""
    pattern = state.pattern
    plan = Plan(state, half, contact, list(pattern.touching), list(state.solved.shape.breaks), list(pattern.edges))
    for condition in sorted(conditions, key=lambda one: -one.s):
        _EDITS[condition.kind](plan, condition)
    pattern = replace(pattern, touching=tuple(plan.touching), edges=tuple(sorted(plan.edges)))
    sample = lowered(sampler(state.solved.shape), plan.bumps)
    fixed = plan.fixed if hold else None
    return solved(state.model, pattern, np.array(plan.breaks), state.load, sample, fixed=fixed), plan


def mended(state: PatternedState, condition: Condition, size: float) -> PatternedState | None:
    """The state at the same load with a pattern that misses a condition changed; what starts has about this length."""
    return _edited(state, [condition], size, size, hold=False)[0]


def _next(state: PatternedState, vanished: list[Condition], spots: list[float], near: float) -> list[Condition]:
    """Gaps that open next, at places where contact would pull beside those that have opened before."""
    known = [one.s for one in vanished]
    return [
        one for one in conditions(state)
        if one.kind == OPENS and min(abs(one.s - s) for s in known) > 1e-6 and any(abs(one.s - s) < near for s in spots)
    ]  # fmt: skip


def _just_now(condition: Condition) -> bool:
    """Whether a condition is as good as met: contact without force, a gap without curvature."""
    return condition.kind in (LOST, GROWS, GROWS_AT_END, LEAVES_EDGE) and condition.value > -1e-6


def _growing(first: Condition, found: PatternedState, plan: Plan) -> Callable[[Solved], float]:
    """What grows after the first of the conditions has vanished."""
    if plan.pair is not None and plan.fixed is not None:
        low, high = plan.fixed
        return lambda one: _place(one, high) - _place(one, low)
    place = first.s
    edge = edge_at(found, place)
    if first.kind == TOUCHES and edge is not None:
        number = found.pattern.edges.index(edge)
        return lambda one: float(PatternedState(found.pattern, found.elements, one).edge_forces[number])
    if first.kind == TOUCHES:
        point = int(np.argmin(np.abs(found.solved.shape.breaks - place)))
        return lambda one: float(one.forces[point])
    radius = 1.0 if found.model.inclined else float(np.min(found.problem.rod.clearance(sides(place))))
    return lambda one: radius - float(np.hypot(*sampler(one.shape)(np.array([place]))[0][:, 0, 0]))


def _place(one: Solved, number: int) -> float:
    return float(np.concatenate([[0.0], one.shape.breaks, [1.0]])[number + 1])


def _open(plan: Plan, condition: Condition) -> None:
    """A gap opens on a stretch in contact: within it, or beside one of its ends."""
    i, s, state = condition.number, condition.s, plan.state
    left, right = state.bounds[i : i + 2]
    if float(np.min(np.abs(pieces_of(state.model.problem)[0] - s), initial=1.0)) < BESIDE_STEP:
        open_at(plan, condition)
        return
    half = min(plan.half, 0.3 * (right - left))
    if min(s - left, right - s) <= 0.05 * half:
        at_left = s - left < right - s
        other = left + half if at_left else right - half
        end = left if at_left else right
        plan.touching[i : i + 1] = [False, True] if at_left else [True, False]
        plan.breaks.insert(i, other)
        plan.bumps.append(beside(state, i, end, other))
        plan.pair = (left, other) if at_left else (other, right)
        return
    half = min(half, 0.8 * min(s - left, right - s))
    plan.touching[i : i + 1] = [True, False, True]
    plan.breaks[i:i] = [s - half, s + half]
    plan.bumps.append(within(state, i, s, half))
    plan.pair = (s - half, s + half)


def _touch(plan: Plan, condition: Condition) -> None:
    """The rod reaches the wall within a free stretch: a point of contact, or an edge, without force at first."""
    edge = edge_at(plan.state, condition.s)
    if edge is not None:
        plan.edges.append(edge)
        return
    plan.touching[condition.number : condition.number + 1] = [False, False]
    plan.breaks.insert(condition.number, condition.s)


def _lose(plan: Plan, condition: Condition) -> None:
    """A point of contact without force leaves the wall."""
    del plan.touching[condition.number], plan.breaks[condition.number]


def _leave_edge(plan: Plan, condition: Condition) -> None:
    """The rod leaves an edge that no longer pushes."""
    plan.edges.remove(condition.s)


def _grow(plan: Plan, condition: Condition) -> None:
    """A point of contact grows to a stretch."""
    _widen(plan, condition.number, touching=True)


def _split(plan: Plan, condition: Condition) -> None:
    """A point of contact becomes two with a gap between them: in contact the stretch between them would pull."""
    _widen(plan, condition.number, touching=False)


def _widen(plan: Plan, i: int, *, touching: bool) -> None:
    """Put a short stretch, in contact or free, in the place of a point of contact."""
    s, half = plan.breaks[i], 0.5 * plan.contact
    plan.touching.insert(i + 1, touching)
    plan.breaks[i : i + 1] = [s - half, s + half]
    plan.pair = (s - half, s + half)


def _grow_at_end(plan: Plan, condition: Condition) -> None:
    """Contact grows from a radially held end."""
    size = plan.contact
    if condition.number:
        plan.touching.append(True)
        plan.breaks.append(1.0 - size)
        plan.pair = (1.0 - size, 1.0)
    else:
        plan.touching.insert(0, True)
        plan.breaks.insert(0, size)
        plan.pair = (0.0, size)


def _release(plan: Plan, condition: Condition) -> None:
    """A rod that nothing holds radially leaves the wall at its end, over a length of about 2φ′√(Δ/wₗ).

    The end itself stays at the wall, where a ball joint is held there; a loose one is pressed to it, since the radial
    moment that is missing bends the rod outwards.
    """
    if 0.0 < condition.s < 1.0:
        release(plan, condition)
        return
    problem = plan.state.model.problem
    length = float(np.clip(length_with_slope(problem, condition.value), shortest_with_slope(problem), 0.3))
    if problem.ends[int(condition.s)] == "loose":
        plan.edges.append(condition.s)
    if condition.number:
        plan.touching.append(False)
        plan.breaks.append(1.0 - length)
        plan.pair = (1.0 - length, 1.0)
    else:
        plan.touching.insert(0, False)
        plan.breaks.insert(0, length)
        plan.pair = (0.0, length)


_EDITS = {UNHELD: _release, OPENS: _open, TOUCHES: _touch, LOST: _lose, GROWS: _grow, SPLITS: _split,
          GROWS_AT_END: _grow_at_end, CROSSES: cross, LEAVES_EDGE: _leave_edge}  # fmt: skip


def growing_direction(after: Changed, load_sense: float) -> Motion:
    """The sense in which a new pattern exists; along the load's if what grows there cannot be seen."""
    start = after.state
    along = tangent_in_load(start.solved, load_sense)
    ahead = step(start.model, start.solved, along, PROBE)[1]
    return along.times(-1.0) if ahead is not None and after.grows(ahead) < after.grows(start.solved) else along
