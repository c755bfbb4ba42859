"""A pattern of contact being rewritten, and what steps between the sections of a string do to it.

Where the bending stiffness has a step, a rod in contact on both sides with a slope there would need a couple from the
wall, which only pushes (:mod:`rodwell.physics.on_wall.sections`): it leaves the wall over a short stretch around the
step. An end of a stretch in contact that comes to a step from the stiffer side goes no farther: beyond it the rod
touches at a point, and leaves the wall before the step. In the vertical plane it has no slope around the wall, and the
wall no couple to give. All other ends, and points of contact, pass a step; since an
element ends there, they are set over it (:func:`cross`).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rodwell.analysis.off_wall.bumps import Bump, at_kink, at_step, beside, pressure_at, sides
from rodwell.analysis.off_wall.conditions import BESIDE_STEP, Condition, PatternedState
from rodwell.physics.off_wall.kinks import shortest
from rodwell.problem.ends import OFF_WALL_ENDS
from rodwell.problem.problem import Problem

OVER = 2.0
"""How far beyond a step an end is set, in distances at which it counts as having reached it."""

ROOM = 0.9
"""Part of the room up to the ends of a stretch that a gap may take as it opens."""


FIRST_WITH_SLOPE, SLIGHT = 2e-3, 0.1
"""Least length of a gap that opens with the slope, in L; less where that takes a slope φ′ of more than the second."""

AT_KINK = 1e-9
"""Distance in L within which a place is that of a kink."""

SLIGHT_JUMP = 1e-9
"""A jump of the contact force in B/L³ that is as good as none."""

SHARE = 0.1
"""Part of a gap that opens at a step of the weight on the side where contact still pushes."""


@dataclass(repr=False)
class Plan:
    """A pattern being rewritten: stretches, ends between them, gaps that open, and the length to hold.

    ``half`` is half the first length of a gap, ``contact`` the first length of a stretch in contact; ``edges`` are
    those of narrower parts of the hole that the rod touches.
    """

    state: PatternedState
    half: float
    contact: float
    touching: list[bool]
    breaks: list[float]
    edges: list[float]
    bumps: list[Bump] = field(default_factory=list)
    pair: tuple[float, float] | None = None

    @property
    def fixed(self) -> tuple[int, int] | None:
        """The numbers of the ends whose distance is held."""
        if self.pair is None:
            return None
        places = [0.0, *self.breaks, 1.0]
        first, last = (places.index(place) - 1 for place in self.pair)
        return first, last


def closes_with_slope(state: PatternedState, stretch: int) -> bool:
    """Whether a free stretch is one that a rod opens wherever it has a slope.

    At a ball joint, at a loose end, at a step of the stiffness.
    """
    problem, (left, right) = state.model.problem, state.bounds[stretch : stretch + 2]
    ends = [end for end, bound in zip(problem.ends, (left == 0.0, right == 1.0), strict=True) if bound]
    steps = problem.rod.stiffness_steps
    return not set(OFF_WALL_ENDS).isdisjoint(ends) or bool(np.any((steps > left) & (steps < right)))


def around_kink(state: PatternedState, stretch: int) -> float | None:
    """The length in L below which a free stretch is a gap at a kink of the stiffness that counts as closed, or None."""
    left, right = state.bounds[stretch : stretch + 2]
    problem = state.problem
    place = problem.rod.falls_within(left, right)
    if place.size != 1 or closes_with_slope(state, stretch):
        return None
    touching = state.pattern.touching
    beside = [(i, s) for i, s in ((stretch - 1, left), (stretch + 1, right)) if 0 <= i < len(touching) and touching[i]]
    if not beside:
        return None
    push = -float(np.mean([pressure_at(state, i, np.array([s]))[0] for i, s in beside]))
    return shortest(problem.clearance, float(problem.rod.stiffness(place)[0]), push)


def kinked(state: PatternedState, s: float) -> bool:
    """Whether a place is a kink of the stiffness at which the wall would have to pull."""
    return bool(state.problem.rod.falls_within(s - AT_KINK, s + AT_KINK).size)


def length_with_slope(problem: Problem, slope: float) -> float:
    """About how long the gap is, in L, over which a rod with a slope φ′ leaves the wall at its end: 2|φ′|√(Δ/wₗ)."""
    return 2.0 * abs(slope) * float(np.sqrt(problem.clearance / max(problem.lateral_weight, 1e-3)))


def shortest_with_slope(problem: Problem) -> float:
    """The length with which such a gap starts, and below which it is about to close."""
    return min(FIRST_WITH_SLOPE, length_with_slope(problem, SLIGHT))


def edge_at(state: PatternedState, s: float) -> float | None:
    """The step of the clearance at a place, the edge of the narrower part of the hole, or the loose end there.

    None where there is neither.
    """
    problem = state.problem
    ends = [place for place, end in zip((0.0, 1.0), problem.ends, strict=True) if end == "loose"]
    return next((float(one) for one in (*problem.rod.clearance_steps, *ends) if abs(one - s) < BESIDE_STEP), None)


def over_jump(length: float, growth: float, jump: float) -> float:
    """How far a gap of this length reaches over a jump of the contact force, to the side where contact pushes.

    Beside the gap κx³/120 (x − b)² of length b, whose contact force would grow by κb, that side bears the moment κb³/60
    of its end: over √(κb³/(30 p)), p the jump, which is short against b.
    """
    return length * float(np.sqrt(abs(growth) / (30.0 * max(jump, SLIGHT_JUMP))))


def open_at(plan: Plan, condition: Condition) -> None:
    """A gap opens beside a step of the weight, where contact comes to push least at the step itself.

    There the contact force is no parabola: on the other side it still pushes, and the gap hardly reaches over.
    """
    i, s, state = condition.number, condition.s, plan.state
    left, right = state.bounds[i : i + 2]
    below, above = pressure_at(state, i, sides(s))
    sense, room = (1.0, right - s) if above > below else (-1.0, s - left)
    length = min(2.0 * plan.half, 0.8 * float(room))
    over = SHARE * length
    if state.model.inclined:
        near, far = max(below, above), float(pressure_at(state, i, np.array([s + sense * length]))[0])
        over = min(over_jump(length, near - far, float(near - min(above, below))), 0.5 * length)
    ends = sorted((s - sense * over, s + sense * length))
    plan.bumps.append(beside(state, i, s, s + sense * length))
    plan.touching[i : i + 1] = [True, False, True]
    plan.breaks[i:i] = ends
    plan.pair = (ends[0], ends[1])


def release(plan: Plan, condition: Condition) -> None:
    """The rod leaves the wall around a step of its stiffness, or around several that are close together."""
    s, state = condition.s, plan.state
    i = int(np.searchsorted(state.bounds, s)) - 1
    gap = at_kink(state, s) if kinked(state, s) else at_step(state, i, s)
    left = max(gap.left, s - ROOM * (s - float(state.bounds[i])))
    right = min(gap.right, s + ROOM * (float(state.bounds[i + 1]) - s))
    plan.bumps.append(gap.bump)
    if i < len(plan.breaks) and right >= plan.breaks[i] and not plan.touching[i + 1]:  # into the gap at the next step
        plan.pair = (left, plan.breaks[i + 1] if i + 1 < len(plan.breaks) else 1.0)
        plan.breaks[i] = left
        return
    plan.touching[i : i + 1] = [True, False, True]
    plan.breaks[i:i] = [left, right]
    plan.pair = (left, right)


def cross(plan: Plan, condition: Condition) -> None:
    """An end of a stretch, or a point of contact, has come to a step."""
    i, up = condition.number // 2, condition.number % 2 == 1
    state, s, size = plan.state, condition.s, OVER * BESIDE_STEP
    below, above = state.model.problem.rod.stiffness(sides(s))
    own, beyond = (below, above) if up else (above, below)
    into_gap = plan.touching[i if up else i + 1] and not plan.touching[i + 1 if up else i]
    jumps = s in state.problem.rod.stiffness_steps  # at a kink the two sides differ by round-off
    if jumps and into_gap and own > beyond and not state.pattern.planar:
        plan.breaks[i : i + 1] = [s - size, s + size]
        plan.touching.insert(i + 1, False)
        plan.pair = (s - size, s + size)
        return
    plan.breaks[i] = s + size if up else s - size
    plan.pair = (0.0, plan.breaks[i]) if up else (plan.breaks[i], 1.0)
