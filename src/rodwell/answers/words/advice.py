"""How a case stands, in a word for each question, and what to do next: for those who decide."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.verifying.other_program import takes
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.assessment import Assessment
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.key_number import KeyNumber
from rodwell.answers.result.reach import passes
from rodwell.answers.words.in_space import what_ends
from rodwell.answers.words.meaning import SMALL_LOAD
from rodwell.answers.words.wording import forces_of
from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.errors import NotConvergedError
from rodwell.quantities.text import amount, percent, plain
from rodwell.quantities.value import Value

GOOD, CAUTION, BAD, OPEN = "good", "caution", "bad", "open"
"""Levels of a status; "open" where no load was given that could be judged."""

UNCERTAIN = {"si": "30 m ± 0.1 m", "field": "300 ft ± 1 ft", "mm": "120 mm ± 1 mm"}
"""An input with its uncertainty as it may be written, in the reader's units."""

CONVERGED = "numerically converged"
"""The one word on numerical errors that stands on the front; the errors themselves stand in the tables."""

CLOSE = 0.1
"""A load that comes nearer to a limit than this part of the limit calls for caution."""


@dataclass(frozen=True)
class Status:
    """The answer to one question: what it is about, its level, the answer in a word or two, and the reason."""

    subject: str
    level: str
    word: str
    reason: str


def statuses(answer: Answer) -> tuple[Status, ...]:
    """Buckling, contact with the wall and strength under the force asked for, and the numbers themselves."""
    cylinder = _cylinder(answer.case, answer.key_numbers.get("cylinder_stress"))
    numbers = _numbers(answer.case, answer.converged)
    theory = _theory(answer.assessment)
    every = (_buckling(answer), _contact(answer), _rod(answer.assessment), cylinder, theory, numbers)
    return tuple(status for status in every if status is not None)


def judged(case: Case) -> float | None:
    """The end force at s = 1 in B/L² that is judged: the most compressive load that acts, or else the one asked for."""
    applied = most_compressive(case)
    return case.until if applied is None else applied.force


def most_compressive(case: Case) -> AppliedLoad | None:
    """The most compressive load that acts."""
    return min(case.applied, key=lambda load: load.force, default=None)


def _buckling(computed: Computed) -> Status:
    load, limit = judged(computed.case), computed.buckling
    where = forces_of(computed.case).load(limit)
    if load is None or load >= limit.value or computed.left_before is not None:
        return _not_buckled(computed, load)
    lying = computed.lying
    if lying is not None and lying.buckled is None:
        known = lying.end is None
        reason = f"beyond {'the last load followed' if known else 'the load at which it loses its stability'}, {where}"
        return Status("Buckling", BAD, "not known" if known else "takes another shape", reason)
    reason = f"beyond the load at which it buckles, {where}"
    if computed.untouched:
        return Status("Buckling", BAD, "buckled, off the wall", f"{reason}: nothing presses it to the wall")
    state = _state(computed, load)
    if state is None:
        return Status("Buckling", BAD, "buckled, shape not known", f"{reason}: its branch could not be followed so far")
    if state.stable:
        return Status("Buckling", CAUTION, "buckled, stable", reason)
    return Status("Buckling", BAD, "buckled, shape unstable", f"{reason}: the rod takes another shape")


def _not_buckled(computed: Computed, load: float | None) -> Status:
    """A rod that has not buckled: straight or as the hole is; or off the wall of a curved hole before it could."""
    limit, said = computed.buckling, forces_of(computed.case)
    if load is None:
        reason = f"{_unbuckled(computed.case)} as long as it keeps {said.below(limit)}"
        return Status("Buckling", OPEN, "no load given", reason)
    if computed.lying is not None and load > computed.lying.highest.value and not computed.pulled_off(load):
        known, where = computed.lying.end_in_tension is not None, said.load(computed.lying.highest)
        word, what = ("takes another shape", "the load at which it loses its stability") if known else ("not known", "")
        return Status("Buckling", BAD, word, f"beyond {what or 'the last load followed'}, {where}")
    if load < limit.value or computed.pulled_off(load):
        return Status(
            "Buckling", BAD, "off the wall", f"{_off(computed, load)}: the curve presses it away from the wall"
        )
    level, margin = _margin(computed.case, load, limit)
    word, does, next_up = _unbuckled(computed.case), "buckles", "buckling"
    if computed.left_before is not None:
        does, next_up = "leaves the wall", "leaving the wall"
    elif computed.lying is not None:
        if computed.lying.end is None:
            return Status("Buckling", GOOD, word, f"stable down to {said.load(limit)}, and not followed farther")
        next_up = what_ends(computed.lying)
        does = "buckles" if computed.lying.buckled is not None else "loses its stability"
    word += "" if level == GOOD else f", close to {next_up}"
    return Status("Buckling", level, word, f"{margin} the load at which it {does}, {said.load(limit)}")


def _off(computed: Computed, load: float) -> str:
    """By which load a rod has left the wall of a curved hole without buckling."""
    pulled = computed.left_in_tension if computed.pulled_off(load) else None
    at, said = computed.buckling if pulled is None else Value(pulled.value, pulled.error), forces_of(computed.case)
    if pulled is not None and said.scales is None:
        return f"above {said.load(at)}"
    less = pulled is not None and said.compression(at).value > 0.0  # too little compression to bend it to this side
    return f"{'under less than' if less else 'beyond'} {said.load(at)}"


def _unbuckled(case: Case) -> str:
    """What the rod is that has not buckled."""
    return "straight" if case.problem.hole is None else "along the hole"


def _state(computed: Computed, load: float) -> Solution | None:
    """The buckled state of mode 1 at an end force; None where it is not known."""
    try:
        return computed.first.at(load) if passes(computed.first, load) else None
    except NotConvergedError:
        return None


def _contact(computed: Computed) -> Status:
    load, subject = judged(computed.case), "Contact"
    limit = computed.lift_off_load
    where = "" if limit is None else forces_of(computed.case).load(limit)
    if load is None:
        reason = f"leaves the wall at {where}" if where else "no lift-off over the range computed"
        return Status(subject, OPEN, "no load given", reason)
    if load >= computed.buckling.value and computed.first.lift_off_at_buckling:
        return Status(subject, GOOD, "straight", "no lateral weight: nothing presses it to the wall")
    if computed.pulled_off(load) or (limit is not None and load <= limit.value):
        reason = _off(computed, load) if computed.pulled_off(load) else f"lift-off is at {where}"
        return Status(subject, BAD, "leaves the wall", reason)
    if limit is None and not _followed_to(computed, load):
        return Status(subject, BAD, "not known", "no lift-off was found, but the branch could not be followed so far")
    if limit is None:
        return Status(subject, GOOD, "on the wall", "no lift-off down to the load asked for")
    level, margin = _margin(computed.case, load, limit)
    word = "on the wall" if level == GOOD else "on the wall, close to lift-off"
    return Status(subject, level, word, f"{margin} the lift-off load, {where}")


def _followed_to(computed: Computed, load: float) -> bool:
    """Whether the states of the rod are known at a load; a straight one is in tension."""
    lying = computed.lying
    if lying is not None and lying.lowest.value <= load <= lying.highest.value:
        return True
    if lying is not None and (lying.buckled is None or load > lying.highest.value):
        return False
    return passes(computed.first, min(load, computed.first.force[0]))


def _margin(case: Case, force: float, limit: Value) -> tuple[str, str]:
    """Level of a force that has not reached a limit, and how far from it that is, at the end shown."""
    said = forces_of(case)
    load, size = said.compression(Value(force)).value, abs(said.compression(limit).value)
    if size < SMALL_LOAD:
        return GOOD, "above"
    share = (said.compression(limit).value - load) / size
    part = Value(share, limit.error * (1.0 + share) / size)
    return (CAUTION if share < CLOSE else GOOD), f"{percent(part)} short of"


def _rod(a: Assessment) -> Status | None:
    """Strength of the rod under the most compressive load that acts, or else at lift-off or buckling."""
    at = min(a.applied, key=lambda one: one.load.force) if a.applied else None
    state = (a.at_lift_off or a.at_buckling) if at is None else at.state
    stress = None if state is None else a.stress(state)
    if state is None or stress is None or stress.safety is None:
        return None
    factor = stress.safety.value
    level = BAD if factor < 1.0 else CAUTION if factor < 1.0 / (1.0 - CLOSE) else GOOD
    reason = f"safety factor {amount(stress.safety, 3)} {state.name}"
    return Status("Rod", level, "yields" if factor < 1.0 else "holds", reason)


def _cylinder(case: Case, stress: KeyNumber | None) -> Status | None:
    """Strength of the cylinder under its largest stress at lift-off."""
    if case.cylinder is None or case.scales is None or stress is None:
        return None
    part = stress.number.times(case.scales.factor("stress") / case.cylinder.yield_strength)
    level = BAD if part.value > 1.0 else CAUTION if part.value > 1.0 - CLOSE else GOOD
    word = "yields" if part.value > 1.0 else "holds"
    return Status("Cylinder", level, word, f"at lift-off its stress is {percent(part)} of the strength")


def _theory(a: Assessment) -> Status | None:
    """Whether the theory's assumptions are left at the loads shown; nothing where they hold."""
    if not a.validity.left:
        return None
    return Status("Theory", BAD, "small strain is left", a.validity.why)


def _numbers(case: Case, converged: bool) -> Status:
    tolerance = plain(case.rtol)
    if converged:
        return Status("Numbers", GOOD, CONVERGED, f"every number to {tolerance}; errors stand in the tables")
    return Status(
        "Numbers", BAD, f"not {CONVERGED}", f"not every number meets the tolerance {tolerance}: see the errors"
    )


def next_steps(answer: Answer) -> tuple[str, ...]:
    """What to do next, most urgent first."""
    case, out = answer.case, []
    if not answer.converged:
        out.append(
            "Trust only the digits that the errors leave; if they are enough, give a larger analysis.rtol than "
            f"{plain(case.rtol)}."
        )
    out += _about_the_load(answer)
    if not case.uncertain and case.scales is not None and answer.sensitivities:
        out.append(
            "Give inputs that are not known well with their uncertainty "
            f'("{UNCERTAIN[case.scales.system.name]}"): the loads then get one too.'
        )
    if (
        case.scales is not None
        and not case.problem.sections
        and answer.lying is None
        and case.problem.hung_weight >= 0.0
    ):
        out.append(f"Hold the formulas of practice against these loads: rodwell audit {case.source}.")
    elif takes(case.problem):
        out.append(f"Have the loads checked by another program: rodwell verify {case.source}.")
    return tuple(out)


def _about_the_load(computed: Computed) -> list[str]:
    load, limit, lift = judged(computed.case), computed.buckling, computed.lift_off_load
    said = forces_of(computed.case)
    if load is None:
        return ["Give the end force that acts as load.applied in the case file: this page then judges it."]
    if load >= limit.value:
        return []
    lies = "straight" if computed.case.problem.hole is None else "lying along the hole"
    out = [f"To keep the rod {lies}, keep {said.below(limit)}."]
    if lift is not None and load <= lift.value and lift.value < limit.value:
        out.append(f"To keep it on the wall, keep {said.below(lift)}.")
    return out
