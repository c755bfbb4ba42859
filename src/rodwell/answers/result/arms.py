"""The two arms by which a rod leaves its straight state in one mode: with twist they are no images of each other."""

from __future__ import annotations

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import follow
from rodwell.errors import InputError, NotConvergedError
from rodwell.strength.limits import end_of_the_way


def with_other_arm(branch: Branch, rtol: float) -> tuple[Branch, Branch | None]:
    """Follow the other arm of a branch's mode to lift-off; the arm that counts comes first: the rod may take either.

    Parameters
    ----------
    branch
        One arm, followed to lift-off.
    rtol
        Relative tolerance.

    Returns
    -------
    tuple
        The arm on which the rod leaves the wall or loses its stability at less compression, and the other; None for
        one that could not be followed.
    """
    assert branch.mode is not None
    try:
        other = follow(branch.problem, branch.mode, mirror=not branch.origin.mirror, rtol=rtol)
    except (InputError, NotConvergedError):
        return branch, None
    return (other, branch) if _ends(other) > _ends(branch) else (branch, other)


def _ends(branch: Branch) -> float:
    """End force at which a rod on this arm leaves the wall or loses its stability, or −∞."""
    end = end_of_the_way(branch)
    return float("-inf") if end is None else end.force
