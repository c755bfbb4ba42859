"""One cell of a map: what is asked of one problem, and what came of it, whatever happens."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import LARGEST_STEP
from rodwell.analysis.loads.arms import to_lift_off
from rodwell.analysis.straight.critical import CriticalLoads, critical_loads
from rodwell.answers.result.assessment import STRAIGHT, Assessment, AtLoad
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.reach import followed_on
from rodwell.case.case import Case
from rodwell.quantities.value import Value
from rodwell.strength.loaded import LoadedRod

OUTCOMES = (
    "not_computed", "converged", "misses_tolerance", "not_reached", "off_the_wall", "another_shape", "not_defined",
    "impossible", "failed",
)  # fmt: skip
"""What can come of a cell, by number; a store holds the numbers."""

(
    NOT_COMPUTED, CONVERGED, MISSES_TOLERANCE, NOT_REACHED, OFF_THE_WALL, ANOTHER_SHAPE, NOT_DEFINED,
    IMPOSSIBLE, FAILED,
) = range(len(OUTCOMES))  # fmt: skip

IN_WORDS = {
    NOT_COMPUTED: "not computed yet",
    CONVERGED: "known to the tolerance",
    MISSES_TOLERANCE: "known, but not to the tolerance: the error says how well",
    NOT_REACHED: "out of reach: the branch ends before",
    OFF_THE_WALL: "the rod has left the wall at less compression",
    ANOTHER_SHAPE: "the buckled shape has lost its stability at less compression",
    NOT_DEFINED: "this problem has no such number",
    IMPOSSIBLE: "these inputs make no problem",
    FAILED: "could not be computed, with shorter steps neither",
}
"""The same for people."""

WITH_VALUE = (CONVERGED, MISSES_TOLERANCE)
"""Outcomes with a value."""

FINER = 4.0
"""Steps are shorter by this where a cell is tried again."""


@dataclass(frozen=True)
class Found:
    """What came of a cell.

    Attributes
    ----------
    outcome
        A number from :data:`OUTCOMES`.
    value
        The number asked for, dimensionless (stress: in Pa); NaN where there is none.
    place
        s/L where it is reached or happens, the first of several; NaN where that means nothing.
    wavenumber
        √(∫y''²/∫y'²) of the buckling mode in rad/L: the number of half waves times π; 0 for the straight rod.
    reason
        Why there is no value, or it misses the tolerance.
    """

    outcome: int
    value: Value = Value(math.nan, math.nan)  # noqa: RUF009 - frozen
    place: float = math.nan
    wavenumber: float = math.nan
    reason: str = ""


class NoSuchNumber(Exception):  # noqa: N818 - no error: an outcome
    """A problem for which the number asked for does not exist, with outcome and reason."""

    def __init__(self, outcome: int, reason: str, wavenumber: float = math.nan) -> None:
        super().__init__(reason)
        self.found = Found(outcome, wavenumber=wavenumber, reason=reason)


class MappedRod:
    """One rod of a map; everything is computed when it is first asked for."""

    def __init__(self, case: Case, largest_step: float = LARGEST_STEP) -> None:
        self.case, self.largest_step = case, largest_step

    def finer(self) -> MappedRod:
        """The same rod, its branches followed in shorter steps."""
        return MappedRod(self.case, self.largest_step / FINER)

    @cached_property
    def critical(self) -> CriticalLoads:
        """The first critical load."""
        return critical_loads(self.case.problem, 1, rtol=self.case.rtol)

    @property
    def wavenumber(self) -> float:
        """That of the first mode, in rad/L."""
        return self.critical[0].wavenumber

    @property
    def buckling(self) -> Value:
        """The first load that the straight rod meets: end force at s = 1 in B/L², tension positive."""
        return Computed(self.case, self.critical, (), 0.0).buckling

    @cached_property
    def computed(self) -> Computed:
        """The first branch to lift-off: with twist the arm that counts."""
        problem, rtol = self.case.problem, self.case.rtol
        branch, other = to_lift_off(problem, self.critical[0], rtol, self.largest_step)
        return Computed(self.case, self.critical, (branch,), float(branch.force[-1]), other)

    @property
    def branch(self) -> Branch:
        """The branch of the first mode."""
        return self.computed.first

    @cached_property
    def at_load(self) -> AtLoad:
        """The rod at its load; the branch is followed on to it where lift-off does not end it before."""
        load = self.case.applied[0]
        if load.force >= self.buckling.value:
            return AtLoad(load, STRAIGHT, LoadedRod("at the applied load", self.case.problem, load.force))
        found = self.computed
        if found.lift_off is None:
            found = replace(found, branches=(followed_on(found.first, load.force),))
        return Assessment(found).applied[0]
