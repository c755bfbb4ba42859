"""What is computed for a case whose clearance varies smoothly: critical loads of the rod that lies on the wall."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.analysis.straight.critical import CriticalLoads, critical_loads
from rodwell.analysis.straight.ramps import least_contact_on_ramps
from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.quantities.value import Peak


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
    """

    case: Case
    critical: CriticalLoads
    least: Peak
    applied: tuple[tuple[AppliedLoad, Peak], ...]

    def buckles(self, load: AppliedLoad) -> bool:
        """Whether the rod has buckled under a load."""
        return load.force <= self.critical[0].force

    def lies(self, least: Peak) -> bool:
        """Whether the wall presses the rod everywhere, from its least contact force."""
        return least.value > least.error


def varying_answer(case: Case) -> Varying:
    """Critical loads of a case, and whether its rod lies on the wall under the loads that act.

    Raises
    ------
    InputError
        Where the wall would have to pull the rod at its critical load.
    NotConvergedError
        If the tolerance cannot be met.
    """
    loads = critical_loads(case.problem, case.modes, rtol=case.rtol)
    applied = tuple((load, least_contact_on_ramps(case.problem, load.force)) for load in case.applied)
    return Varying(case, loads, least_contact_on_ramps(case.problem, loads[0].force), applied)
