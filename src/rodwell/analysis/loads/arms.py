"""The two arms by which a rod leaves its straight state in one mode: with twist they are no images of each other."""

from __future__ import annotations

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import LARGEST_STEP, follow
from rodwell.analysis.branch.symmetry import arms_differ
from rodwell.analysis.branch.tracing import Progress
from rodwell.analysis.straight.critical import Mode
from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem


def to_lift_off(
    problem: Problem,
    mode: Mode,
    rtol: float,
    largest_step: float = LARGEST_STEP,
    progress: Progress | None = None,
) -> tuple[Branch, Branch | None]:
    """Follow the branch of a mode to lift-off; where twist makes the two arms differ, as :func:`with_other_arm` does.

    ``progress`` is called with the end force of each new point of the first arm.

    Raises
    ------
    NotConvergedError
        If the branch cannot even be started.
    """
    branch = follow(problem, mode, rtol=rtol, largest_step=largest_step, progress=progress)
    return with_other_arm(branch, rtol) if arms_differ(problem, mode.parity) else (branch, None)


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
    end = branch.end_of_the_way
    return float("-inf") if end is None else end.force
