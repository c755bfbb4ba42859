"""How a case stands, in a word for each question, and what to do next: for those who decide."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.answers.result.answer import Answer
from rodwell.answers.words.meaning import SMALL_LOAD
from rodwell.answers.words.wording import force_text
from rodwell.case.applied import AppliedLoad
from rodwell.quantities.text import amount, percent

GOOD, CAUTION, BAD, OPEN = "good", "caution", "bad", "open"
"""Levels of a status; "open" where no load was given that could be judged."""

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
    found = (_buckling(answer), _contact(answer), _rod(answer), _cylinder(answer), _numbers(answer))
    return tuple(status for status in found if status is not None)


def judged(answer: Answer) -> float | None:
    """The end force at s = 1 in B/L² that is judged: the most compressive load that acts, or else the one asked for."""
    applied = _most(answer)
    return answer.case.until if applied is None else applied.force


def _most(answer: Answer) -> AppliedLoad | None:
    """The most compressive load that acts."""
    return min(answer.case.applied, key=lambda load: load.force, default=None)


def _buckling(answer: Answer) -> Status:
    load, limit, error = judged(answer), answer.critical[0].force, answer.critical[0].error
    if load is None:
        reason = f"straight as long as the end force at s = 1 is above {force_text(answer, limit, error)}"
        return Status("Buckling", OPEN, "no load given", reason)
    if load >= limit:
        level, margin = _margin(answer, load, limit, error)
        word = "straight" if level == GOOD else "straight, close to buckling"
        return Status(
            "Buckling", level, word, f"{margin} the load at which it buckles, {force_text(answer, limit, error)}"
        )
    reason = f"at {force_text(answer, load)}, beyond {force_text(answer, limit, error)}"
    if answer.first.at(load).stable:
        return Status("Buckling", CAUTION, "buckled, stable", reason)
    return Status("Buckling", BAD, "buckled, shape unstable", f"{reason}: the rod takes another shape")


def _contact(answer: Answer) -> Status:
    load, lift = judged(answer), answer.lift_off
    subject = "Contact"
    if load is None:
        if lift is None:
            return Status(subject, OPEN, "no load given", "no lift-off over the range computed")
        return Status(
            subject, OPEN, "no load given", f"leaves the wall at {force_text(answer, lift.force, lift.error)}"
        )
    if load >= answer.critical[0].force and answer.first.lift_off_at_buckling:
        return Status(subject, GOOD, "straight", "no lateral weight: nothing presses it to the wall")
    if lift is None:
        return Status(subject, GOOD, "on the wall", "no lift-off down to the load asked for")
    if load <= lift.force:
        return Status(subject, BAD, "leaves the wall", f"lift-off is at {force_text(answer, lift.force, lift.error)}")
    level, margin = _margin(answer, load, lift.force, lift.error)
    word = "on the wall" if level == GOOD else "on the wall, close to lift-off"
    return Status(subject, level, word, f"{margin} the lift-off load, {force_text(answer, lift.force, lift.error)}")


def _margin(answer: Answer, force: float, limit: float, error: float) -> tuple[str, str]:
    """Level of a force that has not reached a limit, and how far from it that is, measured where the load was given."""
    most = _most(answer)
    size = abs(limit - answer.case.problem.axial_weight) if most is not None and most.bottom else abs(limit)
    share = (force - limit) / size if size >= SMALL_LOAD else None
    if share is None:
        return GOOD, "above"
    return (CAUTION if share < CLOSE else GOOD), f"{percent(share, error * (1.0 + share) / size)} short of"


def _rod(answer: Answer) -> Status | None:
    """Strength of the rod under the most compressive load that acts, or else at lift-off or buckling."""
    a = answer.assessment
    at = min(a.applied, key=lambda one: one.load.force) if a.applied else None
    state = (a.at_lift_off or a.at_buckling) if at is None else at.state
    found = None if state is None else a.stress(state)
    if state is None or found is None or found.safety is None:
        return None
    factor = found.safety[0]
    level = BAD if factor < 1.0 else CAUTION if factor < 1.0 / (1.0 - CLOSE) else GOOD
    return Status(
        "Rod", level, "yields" if factor < 1.0 else "holds", f"safety factor {amount(*found.safety, 3)} {state.name}"
    )


def _cylinder(answer: Answer) -> Status | None:
    cylinder, scales = answer.case.cylinder, answer.case.scales
    figure = answer.figures.get("cylinder_stress")
    if cylinder is None or scales is None or figure is None:
        return None
    unit = scales.factor("stress") / cylinder.yield_strength
    part = figure.value * unit
    level = BAD if part > 1.0 else CAUTION if part > 1.0 - CLOSE else GOOD
    word = "yields" if part > 1.0 else "holds"
    reason = f"at lift-off its stress is {percent(part, figure.error * unit)} of the strength"
    return Status("Cylinder", level, word, reason)


def _numbers(answer: Answer) -> Status:
    tolerance = f"{answer.case.rtol:g}".replace("-", "−")
    if answer.converged:
        return Status("Numbers", GOOD, "converged", f"every number meets the tolerance {tolerance}")
    return Status("Numbers", BAD, "not converged", f"not every number meets the tolerance {tolerance}: see the errors")


def next_steps(answer: Answer) -> tuple[str, ...]:
    """What to do next, most urgent first."""
    case, out = answer.case, []
    if not answer.converged:
        out.append(
            "Trust only the digits that the errors leave; if they are enough, give a larger analysis.rtol than "
            f"{case.rtol:g}.".replace("-", "−")
        )
    out += _about_the_load(answer)
    if not case.uncertain and case.scales is not None:
        out.append(
            'Give inputs that are not known well with their uncertainty ("30 m ± 0.1 m"): the loads then get one too.'
        )
    if case.scales is not None:
        out.append(f"Hold the formulas of practice against these loads: rodwell audit {case.source}.")
    else:
        out.append(f"Have the loads checked by another program: rodwell verify {case.source}.")
    return tuple(out)


def _about_the_load(answer: Answer) -> list[str]:
    load, lift = judged(answer), answer.lift_off
    limit, error = answer.critical[0].force, answer.critical[0].error
    if load is None:
        return ["Give the end force that acts as load.applied in the case file: this page then judges it."]
    if load >= limit:
        return []
    out = [f"To keep the rod straight, keep the end force at s = 1 above {force_text(answer, limit, error)}."]
    if lift is not None and load <= lift.force and lift.force < limit:
        out.append(
            f"To keep it on the wall, keep the end force at s = 1 above {force_text(answer, lift.force, lift.error)}."
        )
    return out
