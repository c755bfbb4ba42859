"""The points of a parameter study: what is computed for one case, and what its results are."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.loads.arms import to_lift_off
from rodwell.analysis.loads.lying_rod import LyingRod
from rodwell.analysis.state.compared import compared
from rodwell.analysis.state.fields import ZOOMS
from rodwell.analysis.straight.critical import CriticalLoads, critical_loads
from rodwell.analysis.straight.scale import load_scale
from rodwell.answers.result.assessment import BUCKLED
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.lying import lying_along
from rodwell.answers.result.reach import followed_on, no_lift_off
from rodwell.answers.words.in_space import no_window
from rodwell.case.case import Case
from rodwell.errors import InputError, NotConvergedError
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain
from rodwell.quantities.value import Value
from rodwell.strength.limits import uses
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.validity import Validity
from rodwell.studies.sweep.loads import LoadResult, assessed, without_branch


@dataclass(frozen=True)
class StudyPoint:
    """One case of a study.

    Attributes
    ----------
    number
        Its number, from 0.
    at
        Numbers of the values that the varied inputs take.
    case
        The case; None if the inputs do not make one.
    critical
        First critical load: end force at s = 1, tension positive.
    half_waves
        Number of half waves of its mode, √(∫y''²/∫y'²)/π.
    lift_off
        Lift-off load of the first mode: end force at s = 1, tension positive; in a vertical cylinder it is buckling.
    places
        s/L of the places that lift off.
    contact
        Largest contact force per length at lift-off; None where lift-off coincides with buckling.
    used
        Parts used at lift-off of the strengths that the case tells of, 1 is all: of the rod ("yield"), of the cylinder
        and of the most loaded support, by kind.
    loads
        The state at each of the loads that act, in the order of the case file; none where the case has none.
    reasons
        Why results are missing, by name: "case", "critical", "lift_off", "contact", "applied".
    validity
        Whether strain, slenderness, slope and shortening are what the theory assumes; None without a critical load.
    without_wall
        Load at which the straight rod would buckle without the wall's help: end force at s = 1, tension positive.
    other_arm
        Lift-off load of the other arm of a twisted rod, where the two differ: that one lifts off later.
    """

    number: int
    at: tuple[int, ...]
    case: Case | None
    critical: Value | None = None
    half_waves: float | None = None
    lift_off: Value | None = None
    places: tuple[float, ...] = ()
    contact: Value | None = None
    used: Mapping[str, Value] = field(default_factory=dict)
    loads: tuple[LoadResult, ...] = ()
    reasons: Mapping[str, str] | None = None
    validity: Validity | None = None
    without_wall: Value | None = None
    other_arm: Value | None = None

    @property
    def missed(self) -> tuple[str, ...]:
        """The results that are shown but miss the tolerance, in words."""
        if self.case is None:
            return ()
        out = ["lift-off"] if self.lift_off is not None and "lift_off" in (self.reasons or {}) else []
        size, rtol = load_scale(self.case.problem), self.case.rtol
        for state in self.loads:
            force = state.load.force
            vague = any(not one.within(rtol, size + abs(force - one.value)) for one in state.spare.values())
            if vague or (state.what == BUCKLED and state.why):
                out.append(f"the load {plain(state.load.given, 6)}")
        return tuple(out)

    @property
    def scales(self) -> Scales | None:
        """Units of the case; None without dimensions."""
        return None if self.case is None else self.case.scales

    def factor(self, dimension: str) -> float:
        """SI value of one dimensionless unit of this point; 1 without dimensions."""
        return 1.0 if self.scales is None else self.scales.factor(dimension)

    def compression(self, name: str, bottom: bool = False) -> Value | None:
        """Compression at "critical" or "lift_off", **positive**, and its error, in N (or B/L²).

        At s = 1, where the end force acts, or at the ``bottom``, s = 0.
        """
        force: Value | None = getattr(self, name)
        if force is None or self.case is None:
            return None
        extra = self.case.problem.hung_weight if bottom else 0.0
        return Value(extra - force.value, force.error).times(self.factor("force"))


@dataclass(frozen=True)
class SharedResults:
    """What points share that differ in loads and strengths only.

    Attributes
    ----------
    critical
        First critical load; None if it could not be computed.
    branch
        First branch, to lift-off; None if it could not be followed.
    why
        What went wrong.
    other
        The other arm of a twisted rod, where the two differ.
    lying
        How the rod lies in a hole that leaves the vertical plane, where there is no critical load.
    """

    critical: CriticalLoads | None
    branch: Branch | None = None
    why: str = ""
    other: Branch | None = None
    lying: LyingRod | None = None


def computed(case: Case) -> SharedResults:
    """Critical load and first branch of a case; what goes wrong is told in ``why``."""
    if case.problem.in_space:
        try:
            return SharedResults(None, lying=lying_along(case))
        except (InputError, NotConvergedError) as error:
            return SharedResults(None, why=str(error))
    try:
        critical = critical_loads(case.problem, 1, rtol=case.rtol)
    except NotConvergedError as error:
        return SharedResults(None, why=str(error))
    try:
        branch, other = to_lift_off(case.problem, critical[0], case.rtol)
        return SharedResults(critical, branch, other=other)
    except (InputError, NotConvergedError) as error:
        return SharedResults(critical, why=str(error))


def followed_to_loads(shared: SharedResults, case: Case) -> SharedResults:
    """The same with the branch followed on to the loads that act, where it was not to end before."""
    branch, loads = shared.branch, [load.force for load in case.applied]
    if shared.lying is not None and any(not shared.lying.settles(load) for load in loads):
        return computed(case)
    if branch is None or branch.lift_off is not None or not loads:
        return shared
    return replace(shared, branch=followed_on(branch, min(loads)))


def computed_point(number: int, at: tuple[int, ...], case: Case, shared: SharedResults) -> StudyPoint:
    """Results of one case, whose critical load and branch are those of ``shared``; reasons for what is missing."""
    out = StudyPoint(number, at, case)
    if shared.lying is not None:
        return _as_it_lies(out, case, shared.lying)
    if shared.critical is None:
        return replace(out, reasons={"critical": shared.why, "lift_off": "no critical load", "contact": "no lift-off"})
    computed = Computed(case, shared.critical, (), 0.0)
    mode, first = shared.critical[0], computed.buckling
    reasons: dict[str, str] = {}
    out = replace(out, critical=first, half_waves=mode.wavenumber / math.pi)
    alone, other = computed.without_wall, None if shared.other is None else shared.other.lift_off
    out = replace(
        out,
        without_wall=None if alone is None else Value(alone.force, alone.error),
        other_arm=None if other is None else other.load,
    )
    if computed.left_before is not None:
        reasons = {"contact": "the curve of the hole takes the rod off the wall before it buckles"}
        loads, valid = without_branch(computed, reasons["contact"])
        out = replace(out, lift_off=first, places=computed.lift_off_places, loads=loads, validity=valid)
        return replace(out, reasons=reasons)
    try:
        if shared.branch is None:
            raise NotConvergedError(shared.why)
        lift_off, places, contact = _at_lift_off(case, shared.branch, first, reasons)
        lift = shared.branch.lift_off
        used = {}
        if contact is not None and lift is not None:
            used = _used(case, LoadedRod("at lift-off", case.problem, lift.force, lift.error, lift.solution))
        loads, valid = assessed(Computed(case, shared.critical, (shared.branch,), shared.branch[-1].force))
        out = replace(out, lift_off=lift_off, places=places, contact=contact, used=used, loads=loads, validity=valid)
    except (InputError, NotConvergedError) as error:
        reasons = {"lift_off": str(error), "contact": "no lift-off"}
        loads, valid = without_branch(computed, str(error))
        out = replace(out, loads=loads, validity=valid)
    amiss = "; ".join(dict.fromkeys(state.why for state in out.loads if state.why))
    if amiss:
        reasons["applied"] = amiss
    return replace(out, reasons=reasons or None)


def _as_it_lies(out: StudyPoint, case: Case, lying: LyingRod) -> StudyPoint:
    """Results of a rod in a hole that leaves the vertical plane: critical load only where it buckles."""
    computed = Computed(case, CriticalLoads(()), lying.branches, lying.until, lying=lying)
    loads, valid = assessed(computed)
    reasons: dict[str, str] = {}
    if lying.buckled is None:
        reasons["critical"] = no_window(lying)
    lift, state = computed.lift_off_load, computed.at_lift_off
    if lift is None:
        reasons |= {"lift_off": no_lift_off(case.scales, computed.first), "contact": "no lift-off"}
    elif state is None:
        state = lying.last
    amiss = "; ".join(dict.fromkeys(load.why for load in loads if load.why))
    if amiss:
        reasons["applied"] = amiss
    if lift is not None and state is not None:
        there = LoadedRod("at lift-off", case.problem, lift.value, lift.error, state)
        out = replace(out, contact=state.largest("contact_pressure"), used=_used(case, there))
    return replace(
        out, critical=lying.lowest if lying.buckled is not None else None, half_waves=computed.wavenumber / math.pi,
        lift_off=lift, places=computed.lift_off_places, loads=loads, validity=valid, reasons=reasons or None,
    )  # fmt: skip


def _used(case: Case, state: LoadedRod) -> dict[str, Value]:
    """Parts of the strengths used at lift-off, with errors from the two meshes."""
    out = {}
    for use in uses(case):
        out[use.kind] = compared(*(use.size(mesh, ZOOMS)[0] for mesh in state.along))
    return out


def _at_lift_off(
    case: Case, branch: Branch, buckling: Value, reasons: dict[str, str]
) -> tuple[Value | None, tuple[float, ...], Value | None]:
    lift = branch.lift_off
    if lift is None:
        reasons.update(lift_off=no_lift_off(case.scales, branch), contact="no lift-off")
        return None, (), None
    if branch.lift_off_at_buckling:
        reasons["contact"] = "lift-off coincides with buckling: no lateral weight"
        return buckling, lift.s, None
    if not branch.converged:
        reasons["lift_off"] = (
            "the branch to it does not meet the tolerance everywhere: its error says how well it is known"
        )
    return lift.load, lift.s, lift.solution.largest("contact_pressure")
