"""What is computed for a case: critical loads, branches, and what follows from them."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.exploring import Progress
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.discrete import first_run
from rodwell.analysis.loads.derivatives import Sensitivity
from rodwell.analysis.loads.ends import of_leaving, of_lift_off
from rodwell.analysis.loads.lying_rod import LyingRod
from rodwell.analysis.loads.sensitivity import of_critical_load, of_first_met, of_lying_rod
from rodwell.analysis.state.certificate import Certificate
from rodwell.analysis.state.own_places import lift_off_with_own_places
from rodwell.analysis.straight.critical import CriticalLoads, Mode, critical_loads
from rodwell.analysis.straight.lying import lies_between
from rodwell.analysis.straight.without_wall import SpatialMode, loads_without_wall
from rodwell.answers.result.lying import check_lying, left_before, lift_off_of, lying_along
from rodwell.answers.result.reach import first_branch
from rodwell.answers.result.spread import Spread, spread_of_load
from rodwell.case.case import Case
from rodwell.errors import NotConvergedError
from rodwell.problem.clearances import refuse_ramps
from rodwell.quantities.value import Peak, Value

PATIENCE = 45.0
"""Processor time in s after which a path ends where it is."""

TOO_LONG = f"it takes longer than {PATIENCE:g} s of processor time; `rodwell path` follows it farther"


@dataclass(frozen=True)
class Computed:
    """What was computed for a case, as a record.

    Attributes
    ----------
    case
        The case.
    critical
        Critical loads and modes of the straight rod.
    branches
        Buckled branches of the modes met before ``until``; the first is that of mode 1, which goes on to the loads
        that act if these lie farther.
    until
        End force in B/L² to which they were to be followed.
    other_arm
        The other arm of mode 1, to lift-off, where twist makes the two differ: the first branch is the arm that leaves
        the wall or loses its stability at less compression. None where it is the image of the first.
    lying
        How the rod lies in a hole that leaves the vertical plane, where there are no critical loads; ``branches`` are
        those of it, the first that of the buckled rod where it buckles. None in other holes.
    """

    case: Case
    critical: CriticalLoads
    branches: tuple[Branch, ...]
    until: float
    other_arm: Branch | None = None
    lying: LyingRod | None = None

    @property
    def untouched(self) -> bool:
        """Whether twist counts for the straight rod, since nothing presses it to the wall."""
        return self.case.problem.twist != 0.0 and self.case.problem.untouched

    @cached_property
    def first_met(self) -> Mode | SpatialMode:
        """The mode that the straight rod meets first, with the wall's help.

        Where that cannot be computed (very large twist) the one without it, which comes no later.
        """
        if not self.untouched:
            return self.critical[0]
        try:
            return self.critical.first_met
        except NotConvergedError:
            return loads_without_wall(self.case.problem).modes[0]

    @property
    def without_wall(self) -> SpatialMode | None:
        """The mode that the straight rod would meet first without the wall's help; in a curved hole it is not known."""
        return None if self.case.problem.hole is not None else loads_without_wall(self.case.problem).modes[0]

    @cached_property
    def left_before(self) -> Peak | None:
        """Where the rod leaves the wall of a curved hole by itself before it buckles: end force and place; or None."""
        if self.lying is not None:
            return lift_off_of(self.lying.end)
        return left_before(self.case.problem, self.critical)

    @cached_property
    def left_in_tension(self) -> Peak | None:
        """Above which end force the rod leaves the wall of a curved hole, and where; None where it never does.

        In tension mostly; where the curvature varies, the rod's own stiffness may take it off without any.
        """
        if self.lying is not None:
            return lift_off_of(self.lying.end_in_tension)
        return None if self.case.problem.hole is None else lies_between(self.case.problem)[1]

    def pulled_off(self, force: float) -> bool:
        """Whether an end force is above that: the rod has left the wall of a curved hole."""
        return self.left_in_tension is not None and force > self.left_in_tension.value

    @cached_property
    def not_held_at_steps(self) -> Value | str | None:
        """The load at which a string buckles that nothing holds at steps of its stiffness in a bend; or why not known.

        Critical loads and branches are those of one held there. None without such steps, and out of the vertical plane.
        """
        if self.lying is not None or not self.case.problem.bent:
            return None
        from rodwell.analysis.path.follow import not_held_at_steps  # noqa: PLC0415 - others do not wait

        begun = time.process_time()

        def progress(_leg: str, _force: float) -> str | None:
            return None if time.process_time() - begun <= PATIENCE else TOO_LONG

        found = not_held_at_steps(self.case.problem, self.case.rtol, progress)
        return found if found is None or isinstance(found, str) else found.force

    @property
    def off_at_once(self) -> bool:
        """Whether the rod leaves the wall as soon as it buckles, or before: nothing presses it there by then."""
        return self.left_before is not None or self.first.lift_off_at_buckling

    @property
    def no_window(self) -> bool:
        """Whether no way leads from buckling to lift-off: it is off at once, or does not buckle into another shape."""
        return self.off_at_once or (self.lying is not None and self.lying.buckled is None)

    @property
    def buckling(self) -> Value:
        """The first load that the straight rod meets: end force F at s = 1 in B/L², tension positive.

        It buckles, or before that leaves the wall of a curved hole. In one that leaves the vertical plane it may also
        lose its stability otherwise, or nothing of this as far as it was followed: then that is the load.
        """
        if self.lying is not None:
            return self.lying.lowest
        if self.left_before is not None:
            return Value(self.left_before.value, self.left_before.error)
        return Value(self.first_met.force, self.first_met.error)

    @property
    def lift_off_load(self) -> Value | None:
        """Lift-off of the first branch; where nothing presses the rod to the wall that is where it buckles."""
        if self.off_at_once:
            return self.buckling
        return None if self.lift_off is None else self.lift_off.load

    @property
    def lift_off_places(self) -> tuple[float, ...]:
        """Where it lifts off, s/L; none where that is as soon as it buckles."""
        if self.left_before is not None:
            return (self.left_before.s,) if self.lying is None or self.lying.end is None else self.lying.end.s
        return () if self.lift_off is None else tuple(self.lift_off.s)

    @cached_property
    def lift_off_at_own_places(self) -> Value | None:
        """Lift-off in a curved hole with every cross-section at its own place along it; None where it is not known.

        Branches take the hole where the undeformed rod is: the difference is what that costs.
        """
        lies_only = self.lying is not None and self.left_before is not None
        state = self.shown if lies_only else self.at_lift_off
        if self.case.problem.hole is None or state is None:
            return None
        try:
            return lift_off_with_own_places(self.case.problem, state.meshes, state.point)
        except NotConvergedError:
            return None

    @property
    def first(self) -> Branch:
        """The branch of the first mode."""
        return self.branches[0]

    @property
    def lift_off(self) -> SpecialPoint | None:
        """Lift-off of the first mode; None where the rod has left the wall of a curved hole before it buckles."""
        lies_only = self.lying is not None and self.lying.buckled is None
        return None if self.left_before is not None or lies_only else self.first.lift_off

    @cached_property
    def at_lift_off(self) -> Solution | None:
        """The state of the first mode at lift-off, None where lift-off coincides with buckling."""
        if self.lift_off is None or self.off_at_once:
            return None
        return self.lift_off.solution

    @property
    def wavenumber(self) -> float:
        """√(∫y''²/∫y'²) of the first mode in 1/L; of a rod without one, of the state shown, at least a half wave."""
        if len(self.critical) > 0:
            return self.critical[0].wavenumber
        state = self.shown.point.fine
        return max(float(np.nan_to_num(state.space.wavenumber(state.c))), np.pi)

    @property
    def shown(self) -> Solution:
        """The state that pictures show: the first mode at lift-off, or else at the end of its branch.

        In a hole that leaves the vertical plane, of a rod that does not buckle, the last as it lies.
        """
        if self.lying is not None and self.lying.buckled is None:
            return self.lying.last
        return self.at_lift_off or self.first[-1]

    @cached_property
    def worst_certificate(self) -> Certificate:
        """Certificate of the state that solves the paper's equations least well, over all points of all branches."""
        states = [
            state for branch in self.branches for state in (*branch, *(p.solution for p in branch.special_points))
        ]
        certificates = [state.certificate for state in states]
        worst: Certificate = max(certificates, key=lambda certificate: certificate.worst)
        return worst

    @cached_property
    def sensitivities(self) -> tuple[Sensitivity, ...]:
        """How the first critical load and the lift-off load change with the inputs.

        Of a rod that leaves the wall of a drop before it buckles, how that load does; out of the vertical plane those
        at which the rod, as it lies, ceases to, and at which its buckled state lifts off.
        """
        if self.lying is not None:
            return of_lying_rod(self.lying)
        if self.left_before is not None:
            return (of_leaving(self.case.problem, self.left_before),)
        out = [of_critical_load(self.critical[0])]
        if isinstance(self.first_met, SpatialMode):
            out.append(of_first_met(self.first_met))
        if self.at_lift_off is not None and self.lift_off is not None:
            out.append(of_lift_off(self.lift_off))
        return tuple(out)

    @cached_property
    def spreads(self) -> tuple[Spread | None, ...]:
        """Uncertainty of each of these loads from those of the inputs, None where no input was given with "±"."""
        return tuple(spread_of_load(load, self.case.scales, self.case.uncertain) for load in self.sensitivities)


def compute(case: Case, progress: Progress | None = None, begun: Callable[[Computed], None] | None = None) -> Computed:
    """Compute a case: critical loads, the branch of each mode, lift-off of the first.

    Parameters
    ----------
    case
        The case.
    progress
        Called with what is being done and how much is done.
    begun
        Called once the first branch is there, with what is known then: all but the branches of the other modes.

    Raises
    ------
    InputError
        For a curved hole in which the rod lies on this side at no end force, or a clearance that varies along the rod.
    NotConvergedError
        If the critical loads cannot be computed, or the first branch cannot be started. One that ends before
        ``load.until`` or a load that acts is no error: :mod:`rodwell.answers.result.reach` says so.
    """
    tell = progress or (lambda _what, _done: None)
    problem = case.problem
    refuse_ramps(problem, "answers with all that `rodwell run` has of a uniform rod, and studies,")
    first_run.begin(case.problem)
    if problem.in_space:
        lying = lying_along(case, tell)
        return Computed(case, CriticalLoads(()), lying.branches, lying.until, lying=lying)
    tell("critical loads", 0.0)
    check_lying(case)
    critical = critical_loads(problem, case.modes, rtol=case.rtol)
    tell("lift-off", 0.1)
    first, other, until = first_branch(case, critical, lambda force: tell(f"mode 1 at F = {force:.4g} B/L²", 0.1))
    branches = [first]
    if begun is not None:
        begun(Computed(case, critical, (first,), until, other))
    followed = [mode for mode in critical if mode.force > until]
    for number, mode in enumerate(followed[1:], start=1):
        share = (0.9 / len(followed), 0.1 + 0.9 * number / len(followed))

        def report(force: float, mode: Mode = mode, share: tuple[float, float] = share) -> None:
            part = (mode.force - force) / (mode.force - until)
            tell(f"mode {mode.number} at F = {force:.4g} B/L²", share[1] + share[0] * min(max(part, 0.0), 1.0))

        branches.append(follow(problem, mode, until=until, rtol=case.rtol, progress=report))
    tell("done", 1.0)
    return Computed(case, critical, tuple(branches), until, other)
