"""How far the branch of the first mode goes: to the loads that are named, or to where it ends, and why there."""

from __future__ import annotations

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import extended
from rodwell.analysis.branch.special import END, LIFT_OFF
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
