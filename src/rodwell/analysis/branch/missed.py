"""What of a branch misses the tolerance, in words."""

from __future__ import annotations

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.special import END
from rodwell.quantities.text import minus

NAMES = {
    "lift_off": "lift-off",
    "branch_point": "branch point",
    "touch_down": "touch-down",
    "equal_energy": "equal energy",
}


def missed(branch: Branch) -> list[str]:
    """Return the special points of a branch that miss the tolerance, and how many of its points do; empty if none does.

    Points of the branch count as :attr:`rodwell.Branch.converged` says: a state that does not solve the paper's
    equations misses it too.
    """
    out = []
    for point in branch.special_points:
        if not branch.meets_tolerance(point) and point.kind != END:
            value = minus(f"{point.value:.8g} ± {point.error:.0e}")
            out.append(f"{branch.name}: {NAMES.get(point.kind, point.kind)} at {branch.parameter} = {value}")
    for away in () if branch.beyond is None else branch.beyond.special_points:
        if not away.met:
            value = minus(f"{away.force:.8g} ± {away.reached.error:.0e}")
            out.append(f"{branch.name}, off the wall: {NAMES.get(away.kind, away.kind)} at force = {value}")
    states = [solution for solution in branch if not solution.converged]
    if states:
        first = minus(f"{states[0].point.lam:.6g}")
        out.append(f"{branch.name}: {len(states)} of {len(branch)} points, the first at {branch.parameter} = {first}")
    return out
