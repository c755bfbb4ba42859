"""What is computed for a set of inputs: critical loads, branches and what leaves them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.exploring import Exploration, Progress
from rodwell.analysis.branch.follow import LARGEST_STEP
from rodwell.analysis.branch.watching import Following
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.answers.result.computed import Computed, compute
from rodwell.answers.words.wording import forces_of
from rodwell.case.case import Case
from rodwell.errors import InputError
from rodwell.plots.ordinates import ORDINATES
from rodwell.plots.units import axis
from rodwell.quantities.forces import Forces
from rodwell.quantities.text import amount
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.analysis.path.load_path import LoadPath

STRAIGHT = "straight"
"""Name of the straight rod among the branches."""

LARGEST_LOAD = 1e12
"""In the unit of the page: beyond lies no load of any rod."""

NO_PULL = 1e-9
"""A pull below this part of what presses the rod to the wall is round-off."""

Reached = Callable[["Explored", bool], None]
"""Called with what is there so far, and whether that is all."""


@dataclass(frozen=True)
class Explored:
    """Branches of one case.

    Attributes
    ----------
    data
        Content of the case file.
    computed
        Critical loads and primary branches.
    branches
        These and what leaves them, as far as it has been followed.
    unexplored
        Why branch points were left without their secondary branch.
    unit
        Factor from newtons (of a dimensionless case: from B/L²) to the unit of loads on the page, and that unit: that
        of the case to begin with, so that it stays while inputs move. None: the one that suits these branches.
    path, no_path
        The load path beyond lift-off where it was asked for; or why there is none.
    """

    data: Mapping[str, Any]
    computed: Computed
    branches: tuple[Branch, ...]
    unexplored: tuple[str, ...] = ()
    unit: tuple[float, str] | None = None
    path: LoadPath | None = None
    no_path: str = ""

    @property
    def case(self) -> Case:
        """The case."""
        return self.computed.case

    @property
    def forces(self) -> Forces:
        """How its end forces are shown."""
        return forces_of(self.case)

    @cached_property
    def load_unit(self) -> tuple[float, str]:
        """Factor from B/L² to the unit of loads on the page, and that unit."""
        if self.unit is None:
            return axis("force", self.case.scales, max(float(np.max(np.abs(b.force))) for b in self.branches))
        return self.unit[0] * newtons(self.case), self.unit[1]

    @property
    def kept_unit(self) -> tuple[float, str]:
        """The unit of loads, for other inputs: B/L² moves with them, newtons do not."""
        return self.load_unit[0] / newtons(self.case), self.load_unit[1]

    def shown(self, force: float) -> float:
        """The compression at the end shown, in the unit of loads, of an end force F in B/L²."""
        return float(self.forces.drawn(force)) * self.load_unit[0]

    def force(self, shown: float) -> float:
        """The end force F at s = 1 in B/L², tension positive, of a compression as it is shown."""
        return (self.forces.weight if self.forces.bottom else 0.0) - shown / self.load_unit[0]

    @cached_property
    def factors(self) -> dict[Measured, tuple[float, str]]:
        """Factor and unit of each ordinate: they suit the largest of all branches; none before there are any."""
        out = {}
        for which, (name, _) in ORDINATES.items() if self.branches else ():
            top = max(float(np.max(np.abs(branch.numbers(which)))) for branch in self.branches)
            out[which] = axis(name, self.case.scales, top)
        return out

    def ordinates(self, at: Mapping[Measured, float]) -> dict[str, float]:
        """Measured numbers as the ordinates show them, by name."""
        return {
            ORDINATES[which][0]: float(at[which]) * factor for which, (factor, _) in self.factors.items() if which in at
        }

    def lines(self, points: Iterable[Mapping[Measured, float]]) -> dict[str, list[float]]:
        """The ordinates of many points, at least one, by name."""
        rows = [self.ordinates(at) for at in points]
        return {name: [row[name] for row in rows] for name in rows[0]}

    def __getitem__(self, name: str) -> Branch:
        return next(branch for branch in self.branches if branch.name == name)

    @cached_property
    def range(self) -> tuple[float, float]:
        """Least and largest load as shown: from the unloaded rod, or some tension, to the end of the first branch."""
        buckles, last = self.shown(self.computed.buckling.value), self.shown(float(self.computed.first.force.min()))
        low = min(0.0, buckles - 0.4 * (last - buckles))
        return low, last if self.path is None else max(last, self.shown(farthest(self.path)))

    @property
    def suggested(self) -> float:
        """The load to begin with: the one that acts, or one between buckling and lift-off, or rest and what ends it."""
        lying = self.computed.lying
        if self.case.applied:
            return float(f"{self.shown(min(load.force for load in self.case.applied)):.12g}")  # as it was given
        buckles, lift = self.computed.buckling.value, self.computed.lift_off
        if lying is not None and lying.buckled is None:
            return float(f"{self.shown(lying.rest.force + 0.6 * (buckles - lying.rest.force)):.4g}")
        end = self.computed.first.force.min() if lift is None or lift.force == buckles else lift.force
        return float(f"{self.shown(buckles + 0.6 * (float(end) - buckles)):.4g}")

    def load_data(self, load: Value) -> dict[str, Any]:
        """A load as shown, in B/L², and in words: compression or tension by that word, or with its sign."""
        compression = self.forces.compression(load)
        text = f"{amount(compression, 6)} B/L²{self.forces.at_end}"
        return {
            "load": self.shown(load.value),
            "error": load.error * self.load_unit[0],
            "force": load.value,
            "text": text if self.case.scales is None else self.forces.load(load),
        }


def checked_load(name: str, load: object) -> float:
    """Return a load as the page shows it, or raise."""
    if isinstance(load, bool) or not isinstance(load, int | float) or not abs(load) < LARGEST_LOAD:
        raise InputError(name, load, f"must be a number below {LARGEST_LOAD:g} in size")
    return float(load)


def farthest(path: LoadPath) -> float:
    """The end force in B/L² up to which a rod was loaded on its load path."""
    return float(path.curve["force"].min())


def newtons(case: Case) -> float:
    """B/L² in newtons; 1 for a dimensionless case."""
    return 1.0 if case.scales is None else case.scales.factor("force")


def uncomputed(data: Mapping[str, Any], case: Case, unit: tuple[float, str]) -> Explored:
    """Return what says how loads of a case are shown before anything of it is computed."""
    return Explored(data, Computed(case, CriticalLoads(()), (), 0.0), (), unit=unit)


def explore(
    data: Mapping[str, Any], case: Case, tell: Progress, reached: Reached, unit: tuple[float, str] | None = None
) -> Explored:
    """Compute the branches of a case, telling what is there in between.

    Parameters
    ----------
    data, case
        Content of the case file, and the same as a case.
    tell
        Called with what is being done; what it raises ends the computation.
    reached
        Called as soon as the first branch is there, with all primary ones, and when all is done.
    unit
        As in :class:`Explored`.

    Raises
    ------
    InputError
        As of :func:`rodwell.answers.result.computed.compute`.
    NotConvergedError
        If the critical loads cannot be computed, or the first branch cannot be started.
    """

    def so_far(computed: Computed) -> Explored:
        branches = [*computed.branches, *filter(None, [computed.other_arm])]
        return Explored(data, computed, tuple(branches), unit=unit)

    def begun(computed: Computed) -> None:
        nonlocal unit
        known = so_far(computed)
        unit = known.kept_unit  # what follows is shown in it too
        reached(known, False)

    computed = compute(case, tell, begun)
    first = so_far(computed)
    if computed.lying is not None:  # what leaves its branch is among its branches
        reached(first, True)
        return first
    if len(computed.branches) > 1:
        reached(first, False)
    how = Following(case.rtol, LARGEST_STEP, lambda _: tell("secondary branches", 0.8))
    work = Exploration(case.problem, computed.critical, computed.until, how)
    work.branches += first.branches
    work.follow_secondary(tell)
    whole = Explored(data, computed, tuple(work.branches), tuple(work.unexplored), unit)
    reached(whole, True)
    return whole
