"""Which branch of a case is verified."""

from __future__ import annotations

from collections.abc import Sequence

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import extended, follow
from rodwell.analysis.straight.scale import EULER
from rodwell.case.case import Case

BEYOND = 1.3
"""How far the branch is followed if no load is asked for, in parts of the way from buckling to lift-off."""


def branch_to_verify(case: Case, mode: int, forces: Sequence[float], *, off_wall: bool = False) -> Branch:
    """Return the branch of a mode of a case, far enough for the loads at which it is to be verified.

    ``forces`` are end forces at s = 1 in B/L², tension positive; ``off_wall``: whether it goes on off the wall. Errors
    as of :func:`rodwell.follow`.
    """
    problem = case.problem
    if forces:
        return follow(problem, mode, until=min(forces), off_wall=off_wall, rtol=case.rtol)
    if not problem.pressed:
        branch = follow(problem, mode, until=_some_way(case, mode), rtol=case.rtol)
    else:
        branch = follow(problem, mode, rtol=case.rtol)
        if branch.lift_off is not None:
            start = float(branch.force[0])
            until = start - BEYOND * (start - branch.lift_off.force)
            if off_wall:
                return follow(problem, mode, until=until, off_wall=True, rtol=case.rtol)
            branch = extended(branch, until)
    return branch


def _some_way(case: Case, mode: int) -> float:
    """Load a third of the critical load (or of Euler's) below it, for rods that nothing presses to the wall."""
    from rodwell.analysis.straight.critical import critical_loads  # noqa: PLC0415

    force = critical_loads(case.problem, mode, rtol=case.rtol)[mode - 1].force
    return force - max(abs(force), EULER) / 3.0
