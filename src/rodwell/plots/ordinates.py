"""What of branches is drawn against the end compression: words, for pages that do not draw too."""

from __future__ import annotations

from collections.abc import Sequence

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.discrete.measures import Measured
from rodwell.problem.ends import HOLDS_SLOPE
from rodwell.quantities.scales import Scales

ORDINATES = {
    Measured.OMEGA2_1: ("omega2_at_1", "end curvature ω₂(1)"),
    Measured.OMEGA2_0: ("omega2_at_0", "end curvature ω₂(0)"),
    Measured.ENERGY: ("energy", "energy E, relative to the straight rod"),
    Measured.SHORTENING: ("end_shortening", "approach of the ends 1 − z(1)"),
    Measured.ANGLE_MID: ("angle_at_middle", "angle at mid-length ξ₂(½)"),
    Measured.TORQUE_0: ("support_torque", "support torque T₂(0)"),
    Measured.P_MAX: ("largest_pressure", "largest contact pressure max p"),
}
"""What can be drawn against the end compression: name in the nomenclature and label."""

STRAIGHT_END = 1e-6
"""Part of the curvature at the other end below which an end counts as straight."""


def telling(branches: Sequence[Branch], scales: Scales | None = None) -> Measured:
    """Ordinate that tells branches apart: ω₂ at an end that bends the rod, s = 1 if it can be; energy for a coil.

    A rod that lies along a hole out of the vertical plane shows where around it its middle lies. A long string under
    its weight buckles at its lower end only: ω₂(1) is then zero to all digits. A case with dimensions shows by how much
    the ends approach each other, which can be measured.
    """
    problem = branches[0].problem
    if lies(branches[0]):
        return Measured.ANGLE_MID
    if problem.turns:
        return Measured.ENERGY
    if scales is not None:
        return Measured.SHORTENING
    last, first = (max(abs(b.numbers(at)).max() for b in branches) for at in (Measured.OMEGA2_1, Measured.OMEGA2_0))
    if problem.ends[1] in HOLDS_SLOPE and last >= STRAIGHT_END * first:
        return Measured.OMEGA2_1
    return Measured.OMEGA2_0 if problem.ends[0] in HOLDS_SLOPE else Measured.SHORTENING


def lies(branch: Branch) -> bool:
    """Whether a branch has the states of a rod as it lies in a hole that leaves the vertical plane, not buckled."""
    hole = branch.problem.hole
    return hole is not None and not hole.planar and not branch.origin.switched
