"""Coiled states: rods whose end has been carried around the cylinder."""

from __future__ import annotations

import math

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import LARGEST_STEP, follow
from rodwell.analysis.branch.minimum import equilibrium
from rodwell.analysis.branch.special import Origin
from rodwell.analysis.branch.tracing import Progress
from rodwell.errors import InputError
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL, checked_force

REACH = 8.0
"""Without ``until``, a coil is followed to this many times (2πn)², the scale of load of n turns."""


def coil(
    problem: Problem,
    *,
    until: float | None = None,
    start: float = 0.0,
    rtol: float = RTOL,
    largest_step: float = LARGEST_STEP,
    progress: Progress | None = None,
) -> Branch:
    """Branch of coiled states, from the end force ``start`` down to ``until``.

    Its special points tell where contact is complete ("touch_down", "lift_off": on either side of that range the
    coil leaves the wall) and where it has the energy of the straight rod ("equal_energy"): with more compression
    the coil has less.

    Parameters
    ----------
    problem
        The rod, with ``turns`` ≠ 0.
    until
        End force at s = 1 in B/L², tension positive; −8 (2πn)² for n turns if not given.
    start
        End force at which to start.
    rtol, largest_step, progress
        As for :func:`rodwell.follow`.

    Raises
    ------
    InputError
        If ``turns`` is 0 or a force is out of range.
    NotConvergedError
        If no coiled state was found.
    """
    if problem.turns == 0:
        raise InputError("turns", 0, "must not be 0: a coil has its end carried around the cylinder")
    scale = (2.0 * math.pi * problem.turns) ** 2
    until = -REACH * scale if until is None else checked_force("until", until)
    start = checked_force("start", start)
    if until >= start:
        raise InputError("until", until, f"must be below the force at which the coil starts, {start:g} B/L²")
    state = equilibrium(problem, start, rtol=rtol)
    branch = follow(problem, start=state, until=until, rtol=rtol, largest_step=largest_step, progress=progress)
    turns = "1 turn" if abs(problem.turns) == 1 else f"{abs(problem.turns)} turns"
    return branch.renamed(Origin(f"coil of {turns}"))
