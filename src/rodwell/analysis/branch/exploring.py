"""Following all that hangs together: branches, what leaves them, and where they meet."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import branch_off, follow
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import BRANCH_POINT, END, REJOINS, Origin, SpecialPoint
from rodwell.analysis.branch.symmetry import arms_alike
from rodwell.analysis.branch.watching import Following
from rodwell.analysis.discrete.family import reflections
from rodwell.analysis.straight.critical import CriticalLoads, Mode
from rodwell.analysis.straight.mixed import mixed_modes
from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter, words_for

MOST_SECONDARY = 60
"""Secondary branches followed at most; more end the diagram, with a message."""

SAME_LOAD, SAME_SHAPE = 1e-6, 1e-4
"""How close, relatively, two located branch points on different branches are if they are one."""

LYING = "as it lies"
"""Name of the states of a rod in a hole that leaves the vertical plane, where it has not buckled."""

Progress = Callable[[str, float], None]
"""Called with what is being done and how much of the whole is done (0 to 1)."""


@dataclass(frozen=True)
class Joint:
    """A point that two branches share: where ``child`` leaves or meets ``branch``."""

    branch: str
    child: str
    force: float


class Exploration:
    """A diagram in the making."""

    def __init__(self, problem: Problem, critical: CriticalLoads, until: float, how: Following) -> None:
        self.problem, self.critical, self.until, self.how = problem, critical, until, how
        off_wall, rtol, step = how.off_wall, how.rtol, how.largest_step
        self._follow = partial(follow, problem, off_wall=off_wall, rtol=rtol, largest_step=step)
        self._branch_off = partial(branch_off, until=until, off_wall=off_wall, rtol=rtol, largest_step=step)
        self.branches: list[Branch] = []
        self.joints: list[Joint] = []
        self.unexplored: list[str] = []

    def follow_primary(self, tell: Progress) -> None:
        """Follow the branches of the modes met on the way, both arms unless one is the image of the other."""
        followed = [mode for mode in self.critical if mode.force > self.until]
        for i, mode in enumerate(followed):
            tell(f"branch of {mode.name}", 0.6 * i / len(followed))
            for mirror in self._arms(mode):
                self.branches.append(self._follow(mode, until=self.until, mirror=mirror))
        for modes in _double(followed):
            self._follow_mixed(*modes)

    def follow_lying(self, rest: Solution, highest: float, tell: Progress) -> None:
        """Follow the rod as it lies in a hole that leaves the vertical plane, from rest both ways in the end force."""
        for name, until, done in ((LYING, self.until, 0.1), (f"{LYING}, pulled", highest, 0.4)):
            tell(f"rod {name}", done)
            self.branches.append(self._follow(start=rest, until=until).renamed(Origin(name)))

    def _follow_mixed(self, first: Mode, second: Mode) -> None:
        """Follow what leaves a double critical load along both of its modes."""
        for number, mode in enumerate(mixed_modes(self.problem, first, second), 1):
            name = mode.name + (f", direction {number}" if number > 1 else "")
            for mirror in self._arms(mode):
                try:
                    branch = self._follow(mode, until=self.until, mirror=mirror)
                except NotConvergedError as error:
                    self.unexplored.append(f"{name} at F = {mode.force:.8g}: {error}")
                    continue
                origin = replace(branch.origin, name=name + (", mirror arm" if mirror else ""))
                self.branches.append(branch.renamed(origin))

    def _arms(self, mode: Mode) -> tuple[bool, ...]:
        """Whether the usual arm is followed and the mirrored one, unless one is the image of the other."""
        return (False,) if arms_alike(self.problem, mode.parity) else (False, True)

    def continue_in(self, parameter: Parameter, until: float) -> None:
        """Continue each branch that reached its end in another parameter."""
        for branch in [b for b in self.branches if b.ended_because == END]:
            name = f"{branch.name}, in {words_for(parameter)}"
            try:
                further = self._follow(start=branch[-1], parameter=parameter, until=until)
            except (InputError, NotConvergedError) as error:
                self.unexplored.append(f"{name}: {error}")
                continue
            self.branches.append(further.renamed(Origin(name, parent=branch.name)))

    def follow_secondary(self, tell: Progress) -> None:
        """Follow what leaves each branch point, those on secondary branches included, of those on the wall."""
        self._follow_secondary(tell)
        for branch in self.branches:
            for point in () if branch.beyond is None else branch.beyond.special_points:
                if point.kind == BRANCH_POINT:
                    where = f"{branch.name} at F = {point.force:.8g}"
                    self.unexplored.append(f"{where}: what leaves a branch off the wall is not followed")

    def _follow_secondary(self, tell: Progress) -> None:
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
            if other is not parent and any(same_state(p.solution, point.solution) for p in self._branch_points(other)):
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
                branch = self._branch_off(point, mirror=mirror, origin=origin)
            except NotConvergedError as error:
                self.unexplored.append(f"{where}: {error}")
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
                if other is not branch and point.kind == BRANCH_POINT and same_state(point.solution, end):
                    self.joints.append(Joint(other.name, branch.name, point.force))
                    return


def _double(modes: Sequence[Mode]) -> Iterator[tuple[Mode, Mode]]:
    """Pairs of modes whose critical loads cannot be told apart."""
    return ((a, b) for a, b in combinations(modes, 2) if b.number in a.together)


def same_state(a: Solution, b: Solution) -> bool:
    """Whether two states of a problem are one, up to the reflections that it has."""
    if abs(a.force - b.force) > SAME_LOAD * abs(b.force):
        return False
    s = np.linspace(0.0, 1.0, 65)
    y, other = (x.point.fine.space.evaluate(x.point.fine.c, s, 1)[0] for x in (a, b))
    shapes = [y, *(sign * (y[::-1] if turned else y) for sign, turned in reflections(a.problem))]
    return bool(min(np.max(np.abs(shape - other)) for shape in shapes) <= SAME_SHAPE * np.max(np.abs(other)))
