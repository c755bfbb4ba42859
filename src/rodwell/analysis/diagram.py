"""Bifurcation diagrams: primary branches, what leaves them, and how all of it hangs together."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.accuracy import RTOL, checked_force, checked_rtol
from rodwell.analysis.branches import BRANCH_POINT, END, REJOINS, Branch, Origin, SpecialPoint
from rodwell.analysis.coiled import coil
from rodwell.analysis.critical import MOST_MODES, CriticalLoads, critical_loads
from rodwell.analysis.families import PATHS
from rodwell.analysis.follow import LARGEST_STEP, branch_off, checked_end, follow
from rodwell.analysis.solution import Solution
from rodwell.analysis.symmetry import Reflection, images
from rodwell.errors import InputError, NotConvergedError, checked_number, checked_whole
from rodwell.problem import Problem, ends_text

if TYPE_CHECKING:
    import xarray as xr

MODES = 4
"""Default number of primary branches."""

MOST_SECONDARY = 60
"""Secondary branches followed at most; more end the diagram, with a message."""

SAME_LOAD, SAME_SHAPE = 1e-6, 1e-4
"""How close, relatively, two located branch points on different branches are if they are one."""

Progress = Callable[[str, float], None]
"""Called with what is being done and how much of the whole is done (0 to 1)."""


@dataclass(frozen=True)
class Joint:
    """A point that two branches share: where ``child`` leaves or meets ``branch``."""

    branch: str
    child: str
    force: float


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
    """

    problem: Problem
    critical: CriticalLoads
    branches: tuple[Branch, ...]
    joints: tuple[Joint, ...]
    until: float
    unexplored: tuple[str, ...]

    def __iter__(self) -> Iterator[Branch]:
        return iter(self.branches)

    def __getitem__(self, name: str) -> Branch:
        found = next((branch for branch in self.branches if branch.name == name), None)
        if found is None:
            raise InputError("branch", name, "must be one of " + ", ".join(b.name for b in self.branches))
        return found

    def __repr__(self) -> str:
        return f"<Diagram down to F = {self.until:.6g} B/L²: {', '.join(branch.name for branch in self.branches)}>"

    @property
    def primary(self) -> tuple[Branch, ...]:
        """Branches that leave the straight rod, or the coil."""
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
        middle = branch[len(branch) // 2]
        return images(middle.problem, middle.point.fine.symmetry)

    @cached_property
    def datasets(self) -> dict[str, xr.Dataset]:
        """Each branch as an xarray Dataset, by name: see :func:`rodwell.analysis.dataset.branch_dataset`."""
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
            "special_points": [special_dict(point) for point in branch.special_points],
        }


def special_dict(point: SpecialPoint) -> dict[str, Any]:
    """Return a special point as plain data."""
    return {
        "kind": point.kind,
        "force": point.force,
        "parameter": point.parameter,
        "value": point.value,
        "error": point.error,
        "index_before": point.index_before,
        "index_after": point.index_after,
        "s": list(point.s),
    }


def diagram(
    problem: Problem,
    *,
    modes: int = MODES,
    until: float | None = None,
    secondary: bool = True,
    then: tuple[str, float] | None = None,
    rtol: float = RTOL,
    largest_step: float = LARGEST_STEP,
    progress: Progress | None = None,
) -> Diagram:
    """Bifurcation diagram in the end force.

    Primary branches leave the straight rod at its critical loads; with ``problem.turns`` ≠ 0 the branch of the coil
    takes their place. At every branch point on them the branch that leaves
    there is followed too, until it meets a symmetric branch again or reaches the end. Branches that are images of
    others by a reflection are not computed: :meth:`Diagram.images` names them.

    Parameters
    ----------
    problem
        The rod.
    modes
        How many primary branches.
    until
        End force at s = 1 in B/L², tension positive, at which branches end; without it, somewhat beyond the last mode.
    secondary
        Whether to follow secondary branches.
    then
        A parameter ("weight", "alpha", "clearance" or "twist") and the value to which each branch is continued in it,
        from its state at ``until`` and at that force; these branches come last, named "…, in weight".
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
    rtol, modes = checked_rtol(rtol), checked_whole("modes", modes, 1, MOST_MODES)
    largest_step = checked_number("largest_step", largest_step, 1e-4, 1.0, "from 0.0001 to 1")
    tell = progress or (lambda _what, _done: None)
    if then is not None and (then[0] not in PATHS or then[0] == "force"):
        raise InputError("then", then[0], f"must be one of {', '.join(PATHS[1:])}, with the value to go to")
    if then is not None:
        checked_end(problem, *then)
    if problem.turns != 0:
        start = coil(problem, until=until, rtol=rtol, largest_step=largest_step)
        until = float(start.force[-1]) if until is None else until
        work = _Work(problem, CriticalLoads(()), until, rtol, largest_step)
        work.branches.append(start)
    else:
        critical = critical_loads(problem, modes, rtol=rtol)
        until = _end(critical, until)
        work = _Work(problem, critical, until, rtol, largest_step)
        work.follow_primary(tell)
    if secondary:
        work.follow_secondary(tell)
    if then is not None:
        work.continue_in(*then)
    tell("done", 1.0)
    return Diagram(problem, work.critical, tuple(work.branches), tuple(work.joints), until, tuple(work.unexplored))


def _end(critical: CriticalLoads, until: float | None) -> float:
    first, last = critical[0].force, critical[-1].force
    if until is None:
        return float(first - max(1.5 * (first - last), 2.0 * critical[0].wavenumber ** 2))
    until = checked_force("until", until)
    if until >= first:
        raise InputError("until", until, f"must be below the first critical load, {first:.8g} B/L²")
    return until


class _Work:
    """A diagram in the making."""

    def __init__(
        self, problem: Problem, critical: CriticalLoads, until: float, rtol: float, largest_step: float
    ) -> None:
        self.problem, self.critical, self.until = problem, critical, until
        self.rtol, self.largest_step = rtol, largest_step
        self.branches: list[Branch] = []
        self.joints: list[Joint] = []
        self.unexplored: list[str] = []

    def follow_primary(self, tell: Progress) -> None:
        """Follow the branches of the modes met on the way, both arms unless one is the image of the other."""
        followed = [mode for mode in self.critical if mode.force > self.until]
        for i, mode in enumerate(followed):
            tell(f"branch of mode {mode.number}", 0.6 * i / len(followed))
            for mirror in (False, True) if len(images(self.problem, mode.parity)) == 1 else (False,):
                self.branches.append(
                    follow(
                        self.problem, mode, until=self.until, mirror=mirror,
                        rtol=self.rtol, largest_step=self.largest_step,
                    )
                )  # fmt: skip

    def continue_in(self, parameter: str, until: float) -> None:
        """Continue each branch that reached its end in another parameter."""
        for branch in [b for b in self.branches if b.ended_because == END]:
            name = f"{branch.name}, in {parameter}"
            try:
                further = follow(
                    self.problem, start=branch[-1], parameter=parameter, until=until,
                    rtol=self.rtol, largest_step=self.largest_step,
                )  # fmt: skip
            except (InputError, NotConvergedError) as problem:
                self.unexplored.append(f"{name}: {problem}")
                continue
            self.branches.append(further.renamed(Origin(name, parent=branch.name)))

    def follow_secondary(self, tell: Progress) -> None:
        """Follow what leaves each branch point, those on secondary branches included."""
        done, count = 0, 0
        while done < len(self.branches):
            parent = self.branches[done]
            done += 1
            for point in self._branch_points(parent):
                if self._taken(parent, point) or self._meets_known(parent, point):
                    continue
                if count == MOST_SECONDARY:
                    self.unexplored.append(f"the limit of {MOST_SECONDARY} secondary branches was reached")
                    return
                tell(f"secondary branch at F = {point.force:.5g}", 0.6 + 0.4 * done / (len(self.branches) + 1))
                count += self._leave(parent, point)

    @staticmethod
    def _branch_points(parent: Branch) -> list[SpecialPoint]:
        """Branch points inside ``parent``: where it does not begin or end."""
        inner = parent.special_points[1:] if parent.origin.switched else parent.special_points
        return [p for p in inner if p.kind == BRANCH_POINT and p.index_before != p.index_after]

    def _taken(self, parent: Branch, point: SpecialPoint) -> bool:
        """Whether the branch that meets ``parent`` at ``point`` is known."""
        known = (joint.force for joint in self.joints if joint.branch == parent.name)
        return any(abs(point.force - force) <= SAME_LOAD * abs(force) for force in known)

    def _meets_known(self, parent: Branch, point: SpecialPoint) -> bool:
        """Whether the branch that crosses ``parent`` at ``point`` is already there; noted if so."""
        for other in self.branches:
            if other is not parent and any(
                p.kind == BRANCH_POINT and p.index_before != p.index_after and _same(p.solution, point.solution)
                for p in (other.special_points[1:] if other.origin.switched else other.special_points)
            ):
                self.joints.append(Joint(parent.name, other.name, point.force))
                return True
        return False

    def _leave(self, parent: Branch, point: SpecialPoint) -> int:
        """Follow the branch that leaves ``parent`` at ``point``, both ways unless one is the other's image."""
        where = f"{parent.name} at F = {point.force:.8g}"
        if abs(point.index_after - point.index_before) > 1:
            self.unexplored.append(f"{where}: {abs(point.index_after - point.index_before)} eigenvalues vanish at once")
            return 0
        mirrored = point.solution.point.fine.symmetry == 0
        for mirror in (False, True) if mirrored else (False,):
            number = 1 + sum(b.origin.parent is not None for b in self.branches)
            origin = Origin(f"secondary {number}", switched=True, parent=parent.name)
            try:
                branch = branch_off(
                    point,
                    until=self.until,
                    mirror=mirror,
                    rtol=self.rtol,
                    largest_step=self.largest_step,
                    origin=origin,
                )
            except NotConvergedError as problem:
                self.unexplored.append(f"{where}: {problem}")
                continue
            self.branches.append(branch)
            self.joints.append(Joint(parent.name, branch.name, point.force))
            if branch.ended_because == REJOINS:
                self._join(branch)
        return 1

    def _join(self, branch: Branch) -> None:
        """Note on which branch, and where, a secondary branch ends."""
        end = branch[-1]
        for other in self.branches:
            for point in other.special_points:
                if other is not branch and point.kind == BRANCH_POINT and _same(point.solution, end):
                    self.joints.append(Joint(other.name, branch.name, point.force))
                    return


def _same(a: Solution, b: Solution) -> bool:
    """Whether two states are one, up to reflections."""
    if abs(a.force - b.force) > SAME_LOAD * abs(b.force):
        return False
    s = np.linspace(0.0, 1.0, 65)
    y, other = (x.point.fine.space.evaluate(x.point.fine.c, s, 1)[0] for x in (a, b))
    gaps = [np.max(np.abs(image - other)) for image in (y, -y, y[::-1], -y[::-1])]
    return bool(min(gaps) <= SAME_SHAPE * np.max(np.abs(other)))
