"""What an answer means for strength: stress and safety in each state, the safe window, limits, formulas beside it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from rodwell.answers.comparison.beside import FormulaRow, load_rows
from rodwell.answers.comparison.exact_loads import ExactLoad
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.reach import UNSOLVED, out_of_reach, passes, why_out_of_reach
from rodwell.case.applied import AppliedLoad
from rodwell.errors import InputError, NotConvergedError
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value
from rodwell.strength.cylinder import Stress, cylinder_stress
from rodwell.strength.limits import LIFTS_OFF, UNSTABLE, Limit, limits, limits_as_it_lies
from rodwell.strength.loaded import Fields, LoadedRod
from rodwell.strength.local import Exceeded, LocalLimits, exceeded, local_limits
from rodwell.strength.section import RodSection, RodStress, StringSections, rod_section
from rodwell.strength.supports import Support, support_loads
from rodwell.strength.validity import Validity, validity

STRAIGHT, BUCKLED, OTHER_SHAPE, LEFT, UNKNOWN = "straight", "buckled", "other shape", "left the wall", "unknown"
PULLED = "pulled off the wall"
"""What has become of the rod at a load: straight and stable; buckled, on the wall and stable; mode 1 has lost its
stability before; it has left the wall; the branch does not reach so far; tension, or too little compression, has taken
it off the wall of a curved hole."""

KNOWN = ("dawson_paslay", "he_kyllingstad", "chen_lin_cheatham", "wu_juvkam_wold", "mitchell_loading")
"""Formulas shown beside the exact loads even where the rod is outside their validity."""


@dataclass(frozen=True)
class Window:
    """From buckling to lift-off: buckled, but on the wall. End forces F at s = 1 in B/L², tension positive.

    Attributes
    ----------
    buckling, lift_off
        ``lift_off`` is None where none was found.
    limits
        What gives on the way, the least compressive first; the last is the end of the window.
    bottom
        Compression at the lower end s = 0 at buckling, against which widths are given in percent.
    """

    buckling: Value
    lift_off: Value | None
    limits: tuple[Limit, ...]
    bottom: float

    @property
    def width(self) -> Value | None:
        """How much compression can be added from buckling to the end of the window.

        The end is lift-off, or the loss of stability before it; None where neither was found.
        """
        end = self.end
        if end is None or end.load is None:
            return None
        return Value(self.buckling.value - end.load.value, self.buckling.error + end.load.error)

    @property
    def percent(self) -> float | None:
        """The width in percent of the compression at the lower end at buckling."""
        return None if self.share is None else 100.0 * self.share.value

    @property
    def share(self) -> Value | None:
        """The width as a part of the compression at the lower end at buckling."""
        if self.width is None or self.bottom <= 0.0:
            return None
        part = self.width.value / self.bottom
        return Value(part, (self.width.error + abs(part) * self.buckling.error) / self.bottom)

    @property
    def end(self) -> Limit | None:
        """Where the window ends: lift-off, or the loss of stability before it."""
        return next((limit for limit in self.limits if limit.kind in (LIFTS_OFF, UNSTABLE)), None)

    @property
    def stable_until(self) -> Limit | None:
        """Where the buckled shape loses its stability before lift-off, None if it does not."""
        return next((limit for limit in self.limits if limit.kind == UNSTABLE), None)


@dataclass(frozen=True)
class AtLoad:
    """The rod at a load that acts.

    Attributes
    ----------
    load
        The load.
    what
        One of STRAIGHT, BUCKLED, OTHER_SHAPE, LEFT, UNKNOWN, PULLED.
    state
        The straight or buckled state; None for the others.
    why
        For UNKNOWN, and for a load out of reach, why.
    reached
        Whether the branch of mode 1, for a rod kept on the wall, goes so far; True where it was not asked to.
    """

    load: AppliedLoad
    what: str
    state: LoadedRod | None = None
    why: str = ""
    reached: bool = True


class Assessment:
    """Strength, window, limits and formulas of an answer; everything is computed when it is first asked for."""

    def __init__(self, computed: Computed) -> None:
        self.computed, self.case = computed, computed.case
        self.buckling, self.branch = computed.buckling, computed.first

    @cached_property
    def section(self) -> RodSection | StringSections | None:
        """The rod's section, None where stresses cannot be had."""
        return rod_section(self.case)

    @cached_property
    def at_buckling(self) -> LoadedRod:
        """The straight rod at its first critical load; in a curved hole where it leaves the wall, if that is before.

        In a hole that leaves the vertical plane where the rod, as it lies, loses its stability, or was followed to.
        """
        computed, problem = self.computed, self.case.problem
        name = "at buckling" if computed.left_before is None else "where it leaves the wall"
        if computed.lying is None:
            return LoadedRod(name, problem, self.buckling.value, self.buckling.error)
        if computed.left_before is None and computed.lying.buckled is None:
            name = "at the last load followed" if computed.lying.end is None else "where it loses its stability"
        return LoadedRod(name, problem, self.buckling.value, self.buckling.error, computed.lying.last, lies=True)

    @cached_property
    def at_rest(self) -> LoadedRod | None:
        """The rod at rest in a hole that leaves the vertical plane, from which its states are followed; else None."""
        lying = self.computed.lying
        if lying is None:
            return None
        return LoadedRod("at rest", self.case.problem, lying.rest.force, solution=lying.rest, lies=True)

    @cached_property
    def at_lift_off(self) -> LoadedRod | None:
        """The buckled rod at lift-off, None where lift-off coincides with buckling or was not found."""
        lift, state = self.computed.lift_off, self.computed.at_lift_off
        if lift is None or state is None:
            return None
        return LoadedRod("at lift-off", self.case.problem, lift.force, lift.error, state)

    @cached_property
    def applied(self) -> tuple[AtLoad, ...]:
        """The rod at each load that acts, in the order of the case file."""
        return tuple(self._at(load) for load in self.case.applied)

    @cached_property
    def states(self) -> tuple[LoadedRod, ...]:
        """The states that are known: as it lies at rest, straight at buckling, at lift-off, at the applied loads."""
        out = [self.at_rest, self.at_buckling, self.at_lift_off, *(at.state for at in self.applied)]
        return tuple(state for state in out if state is not None)

    @cached_property
    def validity(self) -> Validity:
        """How far the loads shown are from what the theory assumes: strain, slenderness, slope, shortening."""
        without = [(self._name(at.load), at.load.force) for at in self.applied if at.state is None]
        return validity(self.case, self.states, without, self.computed.wavenumber)

    def _name(self, load: AppliedLoad) -> str:
        name = "at the applied load"
        return name if len(self.case.applied) == 1 else f"{name} {1 + self.case.applied.index(load)}"

    def _at(self, load: AppliedLoad) -> AtLoad:
        problem, name = self.case.problem, self._name(load)
        if self.computed.pulled_off(load.force):
            return AtLoad(load, PULLED)
        if load.force >= self.buckling.value:
            lying = self.computed.lying
            if lying is not None:
                return self._lies(load, name)
            return AtLoad(load, STRAIGHT, LoadedRod(name, problem, load.force))
        return self._buckled(load, name)

    def _lies(self, load: AppliedLoad, name: str) -> AtLoad:
        """The rod as it lies in a hole that leaves the vertical plane, at a load that it bears, if it is known to."""
        lying = self.computed.lying
        assert lying is not None
        if load.force > lying.highest.value:
            lost = lying.end_in_tension is not None
            why = "" if lost else why_out_of_reach(lying.pulled, self.case.scales)
            return AtLoad(load, OTHER_SHAPE if lost else UNKNOWN, None, why, reached=lost)
        try:
            state = lying.at(load.force)
        except NotConvergedError:
            return AtLoad(load, UNKNOWN, None, UNSOLVED, reached=False)
        return AtLoad(load, STRAIGHT, LoadedRod(name, self.case.problem, load.force, solution=state, lies=True))

    def _buckled(self, load: AppliedLoad, name: str) -> AtLoad:
        """The rod at a load that the straight one does not bear."""
        problem, branch = self.case.problem, self.branch
        reached = not out_of_reach(branch, load.force)
        why = "" if reached else why_out_of_reach(branch, self.case.scales)
        if self.computed.off_at_once:
            return AtLoad(load, LEFT, None, why, reached)
        end = self.window.end
        if end is not None and end.force is not None and load.force <= end.force:
            return AtLoad(load, LEFT if end.kind == LIFTS_OFF else OTHER_SHAPE, None, why, reached)
        if not passes(branch, load.force):
            return AtLoad(load, UNKNOWN, None, why or why_out_of_reach(branch, self.case.scales), reached=False)
        try:
            solution = branch.at(load.force)
        except (InputError, NotConvergedError):
            return AtLoad(load, UNKNOWN, None, UNSOLVED, reached=False)
        return AtLoad(load, BUCKLED, LoadedRod(name, problem, load.force, solution=solution))

    def stress(self, state: LoadedRod) -> RodStress | None:
        """Largest von Mises stress in the rod in a state, None where the section is not known."""
        if self.section is None:
            return None
        if state.name not in self._stresses:
            self._stresses[state.name] = self.section.largest(state)
        return self._stresses[state.name]

    @cached_property
    def _stresses(self) -> dict[str, RodStress]:
        return {}

    def bending_stress(self, f: Fields) -> FloatArray:
        """Largest bending stress of each cross-section in Pa, (m,), from fields along the rod."""
        assert self.section is not None
        return self.section.stresses(f).bending

    def cylinder(self, state: LoadedRod) -> Stress | None:
        """Largest equivalent stress in the cylinder in a buckled state; None if its section is unknown or it curves."""
        case = self.case
        if case.cylinder is None or case.scales is None or state.solution is None or case.problem.hole is not None:
            return None
        return cylinder_stress(state.solution, case.cylinder, case.scales)

    def supports(self, state: LoadedRod) -> tuple[Support, ...]:
        """The most loaded supports in a state, where capacities are given."""
        if self.case.supports is None or self.case.scales is None:
            return ()
        return support_loads(state, self.case.supports, self.case.scales)

    @cached_property
    def window(self) -> Window:
        """From buckling to lift-off, and what gives on the way."""
        lying = self.computed.lying
        if lying is None:
            gives = limits(self.case, self.branch, self.buckling, left=self.computed.left_before)
        else:
            gives = limits_as_it_lies(self.case, lying)
        bottom = self.case.problem.hung_weight - self.buckling.value
        return Window(self.buckling, self.computed.lift_off_load, gives, bottom)

    @cached_property
    def local(self) -> LocalLimits | None:
        """Local limits of the string, None where there are none."""
        return local_limits(self.case)

    def over_local(self, state: LoadedRod) -> Exceeded | None:
        """Where the compression exceeds the local critical one in a state, None where there is none."""
        if self.local is None or self.local.critical.compression is None or self.case.scales is None:
            return None
        return exceeded(state, self.local.critical.compression.value, self.case.scales.factor("force"))

    @cached_property
    def formulas(self) -> tuple[FormulaRow, ...]:
        """Formulas of practice that apply, and the best known ones, beside the exact loads of this answer.

        None of a string of sections: they are those of a uniform rod; nor of a rod whose weight acts towards s = 1, for
        they count from the end that weight loads; nor of one that does not buckle.
        """
        problem, lying = self.case.problem, self.computed.lying
        if problem.sections or problem.hung_weight < 0.0 or (lying is not None and lying.buckled is None):
            return ()
        weight = self.case.problem.hung_weight
        first = self.buckling if not self.computed.left_before else self.computed.critical[0].load
        loads = [ExactLoad("critical", "first critical load", first.value, first.error, weight)]
        lift = self.computed.lift_off
        if lift is not None and not self.computed.off_at_once:
            loads.append(ExactLoad("lift_off", "lift-off of mode 1", lift.force, lift.error, weight))
        rows = load_rows(self.case, tuple(loads))
        shown = [row for row in rows if row.value and row.main is not None and (row.valid or row.formula.key in KNOWN)]
        return tuple(shown)

    @property
    def limiting(self) -> Limit | None:
        """What gives first before the window ends, None if nothing does."""
        return next((limit for limit in self.window.limits if limit.kind not in (LIFTS_OFF, UNSTABLE)), None)

    @property
    def converged(self) -> bool:
        """Whether the states at the applied loads meet the tolerance."""
        states = [at.state.solution for at in self.applied if at.state is not None]
        return all(solution is None or solution.converged for solution in states)
