"""How far the branch of the first mode goes: to the loads that are named, or to where it ends, and why there."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import extended, follow
from rodwell.analysis.branch.special import END, LIFT_OFF, SpecialPoint
from rodwell.analysis.branch.symmetry import arms_differ
from rodwell.analysis.loads.arms import to_lift_off
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.answers.result.lying import left_before
from rodwell.case.case import Case
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales
from rodwell.quantities.tolerance import LARGEST_FORCE
from rodwell.quantities.value import Value

UNSOLVED = "the branch passes this load, but the state there could not be computed"


def followed_on(branch: Branch, until: float) -> Branch:
    """Return the branch, followed on down to the end force ``until`` in B/L² if it does not go so far yet.

    A branch that had to end before its own end comes back as it is.
    """
    ended = branch.ended_because not in (END, LIFT_OFF)
    until = max(until, -LARGEST_FORCE)
    return branch if ended or until >= branch.force[-1] else extended(branch, until)


def passes(branch: Branch, force: float) -> bool:
    """Whether the branch has a state at an end force in B/L²."""
    return bool(branch.force.min() <= force <= branch.force.max())


def out_of_reach(branch: Branch, force: float) -> bool:
    """Whether the branch had to end before an end force in B/L², tension positive.

    False where the branch was not followed towards it: on the side of tension, and beyond lift-off if it was to end
    there.
    """
    wanted = force < branch.force[0] and not passes(branch, force)
    return bool(wanted and branch.ended_because != LIFT_OFF)


def why_out_of_reach(branch: Branch, scales: Scales | None) -> str:
    """How far the branch goes, in the reader's units, and why it ends."""
    said = Forces(scales, branch.problem.hung_weight)
    if branch.mode is None and branch.force[-1] > branch.force[0]:
        far = said.load(Value(branch.reach[1]))
        return f"the rod as it lies was followed no farther than to {far} ({_ending(branch)})"
    lowest, number = Value(branch.reach[0]), 1 if branch.mode is None else branch.mode.number
    far = said.load(lowest)
    if branch.mode is None and not branch.origin.switched:
        return f"the rod as it lies was followed no farther than to {far} ({_ending(branch)})"
    return (
        f"the branch of mode {number} goes no farther than {far} and ends there or on its way back ({_ending(branch)})"
    )


def _ending(branch: Branch) -> str:
    """Why a branch ends, in words."""
    return "its state there could not be followed" if branch.ended_because == END else branch.ending


def no_lift_off(scales: Scales | None, branch: Branch) -> str:
    """Why the first branch has no lift-off, in words."""
    far = Forces(scales, branch.problem.hung_weight).load(Value(float(branch.force[-1])))
    if branch.ended_because == END:
        return (
            f"was not found: the branch was followed to {far}, where the search ends, and the rod stays on the wall "
            "all the way"
        )
    return f"was not found: the branch could be followed to {far} only: {branch.ended_because}"


def first_branch(
    case: Case, critical: CriticalLoads, report: Callable[[float], None]
) -> tuple[Branch, Branch | None, float]:
    """Branch of the first mode, its other arm where that differs, and the end force to follow branches to.

    That is the one asked for, if it buckles the rod; otherwise one past lift-off and all modes. The first branch
    goes on to the loads that act.
    """
    first = critical[0]
    until, asked = case.until, case.until is not None and case.until < first.force
    if left_before(case.problem, critical) is not None:  # what follows needs a wall that pulls: there is no lift-off
        until = until if until is not None and asked else _reach(critical, None)
        return follow(case.problem, first, until=until, rtol=case.rtol, progress=report), None, until
    if until is not None and asked and not arms_differ(case.problem, first.parity):
        return follow(case.problem, first, until=until, rtol=case.rtol, progress=report), None, until
    lifted, other = to_lift_off(case.problem, first, case.rtol, progress=report)
    if until is not None and asked:
        mirror = lifted.origin.mirror
        return follow(case.problem, first, until=until, mirror=mirror, rtol=case.rtol), other, until
    until = _reach(critical, lifted.lift_off)
    branch = extended(lifted, until) if lifted.reached_end else lifted
    return followed_on(branch, min((load.force for load in case.applied), default=np.inf)), other, until


def _reach(critical: CriticalLoads, lift: SpecialPoint | None) -> float:
    """End force past lift-off and all modes."""
    first = critical[0].force
    past = 0.0 if lift is None else 1.3 * (first - lift.force)
    return float(first - max(1.2 * (first - critical[-1].force), 0.3 * critical[0].wavenumber ** 2, past))
