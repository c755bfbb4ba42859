"""What is computed for a case whose clearance varies smoothly: critical loads, lift-off, stress on the wall."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.missed import missed
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.straight.critical import CriticalLoads, critical_loads
from rodwell.analysis.straight.ramps import least_contact_on_ramps
from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.errors import InputError, NotConvergedError
from rodwell.quantities.value import Peak
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.section import RodSection, RodStress, StringSections, rod_section


@dataclass(frozen=True, eq=False)
class Varying:
    """A case whose clearance varies along the rod, without steps.

    Attributes
    ----------
    case
        The case.
    critical
        Critical loads at which the wall presses the rod everywhere.
    least
        Least contact force per length at the first of them, in B/L³, and where.
    applied
        Loads that act, each with the least contact force per length there.
    branch
        The branch of mode 1 up to lift-off; None where it could not be followed.
    unfollowed
        Why not.
    """

    case: Case
    critical: CriticalLoads
    least: Peak
    applied: tuple[tuple[AppliedLoad, Peak], ...]
    branch: Branch | None
    unfollowed: str

    def buckles(self, load: AppliedLoad) -> bool:
        """Whether the rod has buckled under a load."""
        return load.force <= self.critical[0].force

    def lies(self, least: Peak) -> bool:
        """Whether the wall presses the rod everywhere, from its least contact force."""
        return least.value > least.error

    @property
    def lift_off(self) -> SpecialPoint | None:
        """Where the buckled rod lifts off the wall; None: not found."""
        return None if self.branch is None else self.branch.lift_off

    def lifted(self, load: AppliedLoad) -> bool:
        """Whether the rod has lifted off under a load."""
        return self.lift_off is not None and load.force <= self.lift_off.force

    def under(self, number: int) -> LoadedRod | None:
        """The rod on the wall under a load that acts; None where it is not there, or not known."""
        load, least = self.applied[number]
        problem, name = self.case.problem, "under the load that acts"
        if not self.buckles(load):
            return LoadedRod(name, problem, load.force) if self.lies(least) else None
        if self.branch is None or self.lift_off is None or self.lifted(load):
            return None
        try:
            return LoadedRod(name, problem, load.force, solution=self.branch.at(load.force))
        except (InputError, NotConvergedError):
            return None

    @cached_property
    def states(self) -> tuple[LoadedRod, ...]:
        """The rod at buckling, and at lift-off, as far as it is known."""
        problem, first = self.case.problem, self.critical[0]
        found = [LoadedRod("at buckling", problem, first.force, first.error)]
        if self.lift_off is not None:
            lift = self.lift_off
            found.append(LoadedRod("at lift-off", problem, lift.force, lift.error, lift.solution))
        return tuple(found)

    @cached_property
    def _section(self) -> RodSection | StringSections | None:
        return rod_section(self.case)

    def stress(self, state: LoadedRod | None) -> RodStress | None:
        """Largest von Mises stress in a state; None where that or the section is not known."""
        return None if state is None or self._section is None else self._section.largest(state)

    @cached_property
    def missed(self) -> tuple[str, ...]:
        """What misses the tolerance, in words."""
        return () if self.branch is None else tuple(missed(self.branch))


def varying_answer(case: Case) -> Varying:
    """Critical loads of a case, lift-off, and whether its rod lies on the wall under the loads that act.

    Raises
    ------
    InputError
        Where the wall would have to pull the rod at its critical load.
    NotConvergedError
        If the tolerance cannot be met.
    """
    loads = critical_loads(case.problem, case.modes, rtol=case.rtol)
    applied = tuple((load, least_contact_on_ramps(case.problem, load.force)) for load in case.applied)
    branch, why = None, ""
    try:
        branch = follow(case.problem, loads[0], rtol=case.rtol)
        why = "" if branch.lift_off is not None else branch.ended_because
    except NotConvergedError as error:
        why = str(error)
    least = least_contact_on_ramps(case.problem, loads[0].force)
    return Varying(case, loads, least, applied, branch, why)
