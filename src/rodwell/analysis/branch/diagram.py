"""Bifurcation diagrams: primary branches, what leaves them, and how all of it hangs together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.coiled import coil
from rodwell.analysis.branch.exploring import Exploration, Joint, Progress
from rodwell.analysis.branch.follow import LARGEST_STEP
from rodwell.analysis.branch.rest import at_rest, reach_in_space
from rodwell.analysis.branch.searching import WAYS
from rodwell.analysis.branch.searching import search as search_for_more
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.branch.starts import checked_end
from rodwell.analysis.branch.symmetry import Reflection
from rodwell.analysis.branch.watching import Following
from rodwell.analysis.discrete import first_run
from rodwell.analysis.discrete.choices import checked_step
from rodwell.analysis.discrete.family import PATHS
from rodwell.analysis.straight.critical import MOST_MODES, CriticalLoads, critical_loads
from rodwell.errors import InputError, checked_whole
from rodwell.faces import drawn
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Along, Parameter, ParameterPath, checked_parameter
from rodwell.problem.words import ends_text
from rodwell.quantities.tolerance import RTOL, checked_force, checked_rtol

if TYPE_CHECKING:
    import xarray as xr

    from rodwell.analysis.branch.functionals import Number
    from rodwell.faces import Axes
    from rodwell.quantities.scales import Scales

MODES = 4
"""Default number of primary branches."""


@dataclass(frozen=True)
class Diagram:
    """The branches of a problem in the end force, with images by symmetry left out.

    Attributes
    ----------
    problem
        The problem.
    critical
        The critical loads of the primary branches.
    branches
        Primary branches in the order of modes, then secondary ones in the order in which they were found.
    joints
        Where branches hang together, besides the straight rod.
    until
        End force in B/L² at s = 1 to which branches were followed.
    unexplored
        Why branch points were left without their secondary branch; empty if none was.
    searched
        Where branches were looked for, in words: there may be others.
    """

    problem: Problem
    critical: CriticalLoads
    branches: tuple[Branch, ...]
    joints: tuple[Joint, ...]
    until: float
    unexplored: tuple[str, ...]
    searched: tuple[str, ...]

    def __iter__(self) -> Iterator[Branch]:
        return iter(self.branches)

    def plot(self, ax: Axes | None = None, *, ordinate: Number | None = None, scales: Scales | None = None) -> Axes:
        """Draw all branches in the end force; return the axes. Arguments as in :meth:`rodwell.Branch.plot`."""
        return drawn(self, ax, ordinate=ordinate, scales=scales)

    def __getitem__(self, name: str) -> Branch:
        branch = next((branch for branch in self.branches if branch.name == name), None)
        if branch is None:
            raise InputError("branch", name, "must be one of " + ", ".join(b.name for b in self.branches))
        return branch

    def __repr__(self) -> str:
        return f"<Diagram down to F = {self.until:.6g} B/L²: {', '.join(branch.name for branch in self.branches)}>"

    @property
    def primary(self) -> tuple[Branch, ...]:
        """Branches that leave the straight rod, or that of the coil, or of the rod as it lies."""
        return tuple(branch for branch in self.branches if branch.origin.parent is None)

    @property
    def secondary(self) -> tuple[Branch, ...]:
        """Branches that leave other buckled states."""
        return tuple(b for b in self.branches if b.origin.parent is not None and b.parameter == "force")

    @property
    def converged(self) -> bool:
        """Whether every number of every branch meets the tolerance."""
        return all(branch.converged for branch in self.branches)

    def images(self, branch: Branch) -> tuple[Reflection, ...]:
        """Reflections that make other branches of the diagram out of ``branch``, the identity first."""
        return branch.images

    @cached_property
    def datasets(self) -> dict[str, xr.Dataset]:
        """Each branch as an xarray Dataset, by name: see :func:`rodwell.store.dataset.branch_dataset`."""
        return {branch.name: branch.dataset for branch in self.branches}

    def as_dict(self) -> dict[str, Any]:
        """Return the diagram as plain data, for JSON."""
        return {
            "convention": f"end force at s = 1 in B/L^2, tension positive; {ends_text(self.problem)}; "
            "stability index under dead loads",
            "until": self.until,
            "converged": self.converged,
            "branches": [self._branch_dict(branch) for branch in self.branches],
            "joints": [vars(joint) for joint in self.joints],
            "unexplored": list(self.unexplored),
            "searched": list(self.searched),
        }

    def _branch_dict(self, branch: Branch) -> dict[str, Any]:
        return {
            "name": branch.name,
            "mode": branch.mode.number if branch.mode else None,
            "parent": branch.origin.parent,
            "images": [image.name for image in self.images(branch)],
            "points": len(branch),
            "reached_end": branch.reached_end,
            "ended_because": branch.ended_because,
            "converged": branch.converged,
            "special_points": [
                special_dict(point) | {"converged": branch.meets_tolerance(point)} for point in branch.special_points
            ],
            **({} if branch.beyond is None else {"off_wall": branch.beyond.as_dict()}),
        }


def special_dict(point: SpecialPoint) -> dict[str, Any]:
    """Return a special point as plain data."""
    found = point.as_dict() | {"parameter": str(point.parameter), "value": point.value}
    return found | ({"at": point.parameter.at(point.value)} if isinstance(point.parameter, ParameterPath) else {})


def diagram(
    problem: Problem,
    *,
    modes: int = MODES,
    until: float | None = None,
    secondary: bool = True,
    then: tuple[Parameter | Along, float] | None = None,
    search: Sequence[str] = (),
    off_wall: bool = False,
    rtol: float = RTOL,
    largest_step: float = LARGEST_STEP,
    progress: Progress | None = None,
) -> Diagram:
    """Bifurcation diagram in the end force.

    Primary branches leave the straight rod at its critical loads; with ``problem.turns`` ≠ 0 the branch of the coil
    takes their place. In a hole that leaves the vertical plane, where there are none, the rod as it lies is followed
    from rest (on the wall, stable), down to ``until`` and into tension: "as it lies" and "as it lies, pulled".

    At every branch point on them the branch that leaves there is followed too, until it meets a symmetric branch again
    or reaches the end. Branches that are images of others by a reflection are not computed: :meth:`Diagram.images`
    names them.

    Parameters
    ----------
    problem
        The rod.
    modes
        How many primary branches, where they leave at critical loads.
    until
        End force at s = 1 in B/L², tension positive, at which branches end; without it, somewhat beyond the last mode,
        and of a rod that has none, where :func:`rodwell.lying_rod` ends by itself.
    secondary
        Whether to follow secondary branches.
    then
        A parameter, or a path of one's own, and the value to which each branch is continued in it, from its state at
        ``until`` (and at that force): see :func:`rodwell.follow`. These branches come last, named "…, in weight".
    search
        Ways to look for branches that hang together with none of these: "unfolding" (states of the problem without
        twist, or in a horizontal cylinder, carried over to this one), "deflation" (further states at some loads, sought
        by Newton's method kept off those that are known). Named "isolated"; ``Diagram.searched`` says what was done.
    off_wall
        Whether branches leave the wall where they lift off, and go on off it: :attr:`rodwell.Branch.beyond`. Otherwise
        the rod is kept on the wall. What leaves them off the wall is not followed. Not together with ``then``,
        ``search``, or turns.
    rtol, largest_step
        As for :func:`rodwell.follow`.
    progress
        Called with what is being done and how much is done.

    Raises
    ------
    InputError
        If an argument is out of range.
    NotConvergedError
        If the critical loads cannot be computed, or a primary branch cannot be started.
    """
    first_run.begin(problem)
    how = Following(checked_rtol(rtol), checked_step(largest_step), off_wall=off_wall)
    modes = checked_whole("modes", modes, 1, MOST_MODES)
    tell = progress or (lambda _what, _done: None)
    if off_wall:
        _check_off_wall(problem, then, search)
    ways = _checked_ways(problem, search)
    further = None if then is None else _checked_further(problem, *then)
    if problem.turns != 0:
        start = coil(problem, until=until, rtol=how.rtol, largest_step=how.largest_step)
        until = float(start.force[-1]) if until is None else until
        work = Exploration(problem, CriticalLoads(()), until, how)
        work.branches.append(start)
    elif _lies(problem):
        rest, far = at_rest(problem, how), reach_in_space(problem)
        until = rest.force - far if until is None else _below(until, rest.force, "the force at rest")
        work = Exploration(problem, CriticalLoads(()), until, how)
        work.follow_lying(rest, rest.force + far, tell)
    else:
        critical = critical_loads(problem, modes, rtol=how.rtol)
        until = _end(critical, until)
        work = Exploration(problem, critical, until, how)
        work.follow_primary(tell)
    if secondary:
        work.follow_secondary(tell)
    searched = search_for_more(work, ways, tell)
    if further is not None:
        work.continue_in(*further)
    tell("done", 1.0)
    return Diagram(
        problem, work.critical, tuple(work.branches), tuple(work.joints), until, tuple(work.unexplored), searched
    )


def _check_off_wall(problem: Problem, then: object, search: Sequence[str]) -> None:
    """Raise if branches of a diagram cannot go on off the wall."""
    from rodwell.analysis.beyond.crossing import check_crosses  # noqa: PLC0415 - most diagrams stay on the wall

    check_crosses(problem)
    if problem.turns != 0:
        reason = (
            "must be 0 with off_wall: the branch of a coil begins where the wall would have to pull; follow it from "
        )
        raise InputError("turns", problem.turns, reason + "a state in contact (follow, start)")
    for name, given in (("then", then), ("search", tuple(search))):
        if given:
            raise InputError(name, given, "must be left out where branches leave the wall (off_wall)")


def _lies(problem: Problem) -> bool:
    """Whether the rod lies along a hole that leaves the vertical plane, where it has no critical loads."""
    return problem.in_space


def _checked_further(problem: Problem, parameter: Parameter | Along, until: float) -> tuple[Parameter, float]:
    """What branches are continued in, and to where."""
    if parameter == "force" or (isinstance(parameter, str) and parameter not in PATHS):
        raise InputError("then", parameter, f"must be one of {', '.join(PATHS[1:])}, with the value to go to")
    parameter = checked_parameter(parameter, PATHS)
    return parameter, checked_end(problem, parameter, until)


def _checked_ways(problem: Problem, search: Sequence[str]) -> tuple[str, ...]:
    ways = (search,) if isinstance(search, str) else tuple(search)
    for way in ways:
        if way not in WAYS:
            raise InputError("search", way, f"must be among {', '.join(WAYS)}")
    if "unfolding" in ways:
        problem.refuse_curved("branches are sought by unfolding")
    if ways and _lies(problem):
        why = "starts from modes of the straight rod, and in a hole that leaves the vertical plane there are none"
        raise InputError("search", ways[0], f"{why}: leave it out")
    if ways and problem.turns != 0:
        raise InputError("search", ways[0], "is for rods that are not coiled: leave it out")
    return ways


def _end(critical: CriticalLoads, until: float | None) -> float:
    first, last = critical[0].force, critical[-1].force
    if until is None:
        return float(first - max(1.5 * (first - last), 2.0 * critical[0].wavenumber ** 2))
    return _below(until, first, "the first critical load")


def _below(until: float, highest: float, what: str) -> float:
    until = checked_force("until", until)
    if until >= highest:
        raise InputError("until", until, f"must be below {what}, {highest:.8g} B/L²")
    return until
