"""A state at rest of a rod in a hole that leaves the vertical plane: where the states along it are followed from."""

from __future__ import annotations

import math

from rodwell.analysis.branch.follow import FIRST_STEP_ON
from rodwell.analysis.branch.making import made
from rodwell.analysis.branch.minimum import equilibrium
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import END, TOUCH_DOWN, Origin
from rodwell.analysis.branch.starts import at_state
from rodwell.analysis.branch.tracing import traced
from rodwell.analysis.branch.watching import Following
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.straight.scale import EULER
from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.problem.words import side_of_wall

REACH = 2.0
"""How far states are followed by themselves on either side, in sums of what straight, bent and heavy rods bear."""

AT_REST = (0.5, 0.0, 1.0)
"""End forces at which a state at rest is sought, as parts of the axial weight: first where the middle bears none."""


def reach_in_space(problem: Problem) -> float:
    """How far from rest states are followed by themselves, in B/L²."""
    hole = problem.hole
    assert hole is not None
    return REACH * (
        EULER + (4.0 * hole.sharpest + 2.0 * math.sqrt(problem.weight * problem.clearance)) / problem.clearance
    )


def at_rest(problem: Problem, how: Following) -> Solution:
    """A state on the wall, stable: at a small end force, or else where contact becomes complete beyond one."""
    states: list[Solution] = []
    for force in dict.fromkeys(part * problem.hung_weight for part in AT_REST):
        try:
            states.append(equilibrium(problem, force, rtol=how.rtol))
        except NotConvergedError:
            continue
        if _on_wall(states[-1]):
            return states[-1]
    if not states:
        raise NotConvergedError("no state of the rod along this hole was found under a small end force")
    return _after_touch_down(problem, states[0], how)


def _on_wall(state: Solution) -> bool:
    return state.stability_index == 0 and state.number(Measured.P_MAX).value < 0.0


def _after_touch_down(problem: Problem, start: Solution, how: Following) -> Solution:
    """The first state in contact everywhere on the way from one that is not, towards compression or else tension."""
    far = reach_in_space(problem)
    for until in (start.force - far, start.force + far):
        begin = at_state(problem, start, "force", start.force, until, how.rtol)
        trace = traced(problem, begin, until, how.stepping(FIRST_STEP_ON), progress=how.progress)
        branch = made(problem, Origin("on the way to the wall"), trace, trace.end == END, trace.end)
        down = next((point for point in branch.special_points if point.kind == TOUCH_DOWN), None)
        if down is None:
            continue
        for state in (branch[i] for i in range(down.after + 1, len(branch))):
            if _on_wall(state):
                return state
    side = side_of_wall(problem)
    where = start.highest_pressure[2]
    raise InputError(
        "axis" if problem.axis else "walk",
        f"{len(problem.axis)} points" if problem.axis else problem.walk,
        f"bends the hole so that a rod held on its {side} side lies on the wall at no end force from "
        f"{start.force - far:.6g} to {start.force + far:.6g} B/L²: at {start.force:.6g} B/L² the wall would have to "
        f"pull it at s/L = {where[0]:.4g}; take a shorter piece of the hole, let the ends slide around the wall "
        '("guided"), or give the rod its weight',
    )
