"""Coiled states: rods whose end has been carried around the cylinder."""

from __future__ import annotations

import math

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import LARGEST_STEP, follow
from rodwell.analysis.branch.minimum import equilibrium
from rodwell.analysis.branch.special import Origin
from rodwell.analysis.branch.tracing import Progress
from rodwell.errors import InputError
from rodwell.physics.exact.helix import equal_energy_load, least_equal_energy_load
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL, checked_force

REACH = 8.0
"""Without ``until``, a coil is followed to this many times (2πn)², the scale of load of n turns."""


BEYOND = 1.25
"""How much farther than the load of equal energy."""


def _reach(problem: Problem) -> float:
    """End force down to which a coil is followed by default."""
    rate, weight, radius = 2.0 * math.pi * abs(problem.turns), abs(problem.lateral_weight), problem.clearance
    local, rate_of_local = least_equal_energy_load(
        weight, radius
    )  # wound on a part of its length only, if that is less
    equal = local if rate_of_local > rate else equal_energy_load(rate, weight, radius, small_slope=True)
    return min(-REACH * rate**2, BEYOND * equal)


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
    the coil has less. A heavy rod with turns that are not whole has no such load: its straight rival is held elsewhere.

    Parameters
    ----------
    problem
        The rod, with ``turns`` ≠ 0, whole or not.
    until
        End force at s = 1 in B/L², tension positive. Without it −8 (2πn)² for n turns, or 1.25 times the load at which
        a long coil has the energy of the straight rod, if that is more: so that the special points are in the range.
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
    problem.refuse_curved("coils are computed")
    if problem.turns == 0:
        raise InputError("turns", 0, "must not be 0: a coil has its end carried around the cylinder")
    until = _reach(problem) if until is None else checked_force("until", until)
    start = checked_force("start", start)
    if until >= start:
        raise InputError("until", until, f"must be below the force at which the coil starts, {start:g} B/L²")
    state = equilibrium(problem, start, rtol=rtol)
    branch = follow(problem, start=state, until=until, rtol=rtol, largest_step=largest_step, progress=progress)
    turns = "1 turn" if abs(problem.turns) == 1 else f"{abs(problem.turns):g} turns"
    return branch.renamed(Origin(f"coil of {turns}"))
