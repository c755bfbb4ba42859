and problem.rod.stepped"""A string in a bend that nothing holds at steps of its stiffness: the load at which it buckles sideways.

On the wall all along lies a string only where something holds its slope at these steps
(:mod:`rodwell.analysis.straight.lying`); one that nothing holds is off the wall beside them, and may buckle sooner.
"""

from __future__ import annotations

from collections.abc import Callable

from rodwell.analysis.off_wall.curved.refused import refuse_holes
from rodwell.analysis.path.events import CRITICAL, PathPoint
from rodwell.analysis.path.follow import load_path
from rodwell.errors import RodwellError
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL


def asks_to_be_held(problem: Problem) -> bool:
    """Whether a string lies along its hole only if something holds it at steps of its stiffness."""
    return problem.bent and not problem.bridges 


def buckles_if_not_held(
    problem: Problem, rtol: float = RTOL, progress: Callable[[str, float], str | None] | None = None
) -> PathPoint | str | None:
    """Where a string in a bend buckles sideways that nothing holds at steps of its stiffness, or why that is not known.

    The event has the end force F at s = 1 in B/L², tension positive. None for rods that need not be held.
    """
    if not asks_to_be_held(problem):
        return None
    try:
        refuse_holes(problem, strings=True)
        path = load_path(problem, rtol=rtol, progress=progress)
    except RodwellError as error:
        return str(error)
    found = path.first(CRITICAL)
    if found is not None:
        return found
    why = path.ended_because or f"it was followed to F = {path.until:.6g} B/L²"
    return f"no load was found at which the string buckles out of its plane: {why}"
