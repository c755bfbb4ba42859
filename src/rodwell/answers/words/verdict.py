"""The verdict in one sentence, and what it rests on: loads that act, the safe window, what gives on the way."""

from __future__ import annotations

from rodwell.answers.result.answer import Answer
from rodwell.answers.result.assessment import BUCKLED, LEFT, OTHER_SHAPE, STRAIGHT, AtLoad
from rodwell.answers.words.wording import force_text, quantity, size_text
from rodwell.problem.problem import ends_text
from rodwell.quantities.text import amount, percent
from rodwell.strength.limits import LIFTS_OFF, UNSTABLE, YIELDS, Limit
from rodwell.strength.loaded import LoadedRod


def verdict(answer: Answer) -> str:
    """The answer in one sentence with its assumptions.

    For the loads that act the most compressive one; without such loads, where the rod buckles and how far it is from
    there to lift-off.
    """
    loads = answer.assessment.applied
    text = _range(answer) if not loads else _at(answer, min(loads, key=lambda at: at.load.force))
    return f"{text}; assumptions: {_assumed(answer)}."


def load_sentences(answer: Answer) -> list[str]:
    """What becomes of the rod at the loads that act, other than the one of the verdict; then where it buckles."""
    loads = answer.assessment.applied
    if not loads:
        return []
    most = min(loads, key=lambda at: at.load.force)
    return [_at(answer, at) + "." for at in loads if at is not most] + [_range(answer) + "."]


def window_sentences(answer: Answer) -> list[str]:
    """What gives before lift-off, stress at buckling and lift-off, and where the local limit is exceeded."""
    out = []
    for limit in answer.assessment.window.limits:
        if limit.kind in (LIFTS_OFF, UNSTABLE):
            continue
        if limit.force is None:
            out.append(f"{limit.name.capitalize()} is reached at any end force.")
            continue
        when = (
            "after buckling, before lift-off" if limit.buckled else "before buckling: the elastic loads come too late"
        )
        where = force_text(answer, limit.force, limit.error)
        out.append(f"{limit.name.capitalize()} at the end force {where} at s = 1, {when}.")
    return [*out, *_stresses(answer), local_sentence(answer)]


def _assumed(answer: Answer) -> str:
    """The assumptions in a few words."""
    fluids = ", effective forces" if answer.case.with_fluids else ""
    return f"frictionless, elastic, straight hole, {ends_text(answer.case.problem)}{fluids}"


def _range(answer: Answer) -> str:
    """Where the straight rod buckles, and how far it is from there to lift-off."""
    first = answer.critical[0]
    if first.force > 0.0:
        text = (
            "The rod buckles under its own weight: it stays straight only if the end s = 1 is held in tension of at "
            f"least {force_text(answer, first.force, first.error)}"
        )
    else:
        text = (
            "The straight rod is stable until the compression at the end s = 1 reaches "
            f"{force_text(answer, -first.force, first.error)}"
        )
    return text + _window(answer)


def _window(answer: Answer) -> str:
    """The way from buckling to lift-off as the end of a sentence."""
    window = answer.assessment.window
    if answer.first.lift_off_at_buckling:
        return "; it leaves the wall as soon as it buckles"
    end, width = window.end, window.width
    if end is None or width is None:
        return ""
    if not end.buckled:
        return "; the shape it buckles into is unstable from the start"
    share = window.share
    of_bottom = "" if share is None else f" ({percent(*share)}{_at_bottom(answer)})"
    text = f"; buckled, it stays on the wall, stable, for another {size_text(answer, *width)}{of_bottom} until it "
    text += "lifts off" if end.kind == LIFTS_OFF else "loses its stability and takes another shape"
    state = answer.assessment.at_lift_off
    if end.kind == LIFTS_OFF and state is not None and answer.assessment.stress(state) is not None:
        text += f", {_stress(answer, state)}"
    yields = _yield(answer)
    if yields is not None:
        before = "buckles" if not yields.buckled else "lifts off"
        where = (
            "at any load" if yields.force is None else f"already at {force_text(answer, yields.force, yields.error)}"
        )
        text += f"; but it yields {where}, before it {before}"
    return text


def _at_bottom(answer: Answer) -> str:
    """Of what a percentage is one, where the two ends differ."""
    return " of the compression at s = 0" if answer.case.problem.axial_weight > 0.0 else ""


def _yield(answer: Answer) -> Limit | None:
    return next((limit for limit in answer.assessment.window.limits if limit.kind == YIELDS), None)


def _stress(answer: Answer, state: LoadedRod) -> str:
    """Largest stress and safety factor in a state, as the end of a sentence."""
    found, scales = answer.assessment.stress(state), answer.case.scales
    if found is None or scales is None:
        return ""
    stress = quantity(scales.system, found.value, found.error, "stress", 3)
    text = f"with a largest von Mises stress of {stress} in the rod"
    if found.safety is None:
        return text
    text += f", safety factor {amount(*found.safety, 3)} against yield"
    return text if found.safety[0] >= 1.0 or state.name == "at lift-off" else text + ": it yields"


def _at(answer: Answer, at: AtLoad) -> str:
    """What becomes of the rod at a load that acts."""
    load = at.load
    scales = answer.case.scales
    given = f"{load.given:.6g} B/L²".replace("-", "−") if scales is None else scales.system.text(load.given, "force")
    end = "the bottom, s = 0" if load.bottom else "the top, s = 1"
    sign = "compression" if load.given < 0.0 else "tension"
    kind = "real force in the wall, " if load.real else "effective, " if answer.case.with_fluids else ""
    start = f"At {given} at {end} ({kind}{sign})"
    assessment = answer.assessment
    lift, critical = answer.lift_off, answer.critical[0]
    if at.what == STRAIGHT:
        text = (
            f"{start} the rod is straight and stable, {_apart(answer, at, critical.force, critical.error, 'buckling')}"
        )
    elif at.what == BUCKLED:
        far, last = "", assessment.window.end
        if last is not None and last.force is not None:
            what = "lift-off" if last.kind == LIFTS_OFF else "the loss of its stability"
            far = f", {_apart(answer, at, last.force, last.error, what)}"
        text = f"{start} the rod is buckled but stays on the wall and stable{far}"
    elif at.what == OTHER_SHAPE:
        lost = assessment.window.stable_until
        where = (
            ""
            if lost is None or lost.force is None
            else f", which ends at {force_text(answer, lost.force, lost.error)} at s = 1"
        )
        text = f"{start} the rod is buckled beyond the stable part of mode 1{where}"
        return f"{text}: it takes another shape, not given here"
    elif at.what == LEFT:
        assert lift is not None
        what = "buckling" if answer.first.lift_off_at_buckling else "lift-off"
        text = f"{start} the rod has left the wall, {_apart(answer, at, lift.force, lift.error, what)}"
        text += ", where nothing presses it to the wall" if answer.first.lift_off_at_buckling else ""
        return text + ": its shape and stresses are no longer those of a rod on the wall and are not given"
    else:
        return f"{start} the state of the rod is not known: {at.why}"
    assert at.state is not None
    return f"{text}{', ' if assessment.stress(at.state) else ''}{_stress(answer, at.state)}"


def _apart(answer: Answer, at: AtLoad, force: float, error: float, what: str) -> str:
    """How far a load lies from another, measured where it was given: "12 % short of lift-off (−38.5 kN there)"."""
    more = answer.case.problem.axial_weight if at.load.bottom else 0.0
    here, other = more - at.load.force, more - force
    word = "short of" if here <= other else "beyond"
    far = (
        size_text(answer, abs(other - here), error)
        if other <= 0.0 or here < 0.0
        else percent(abs(1.0 - here / other), error * here / other**2)
    )
    scales = answer.case.scales
    there = f"{amount(-other, error, 6)} B/L²" if scales is None else size_text(answer, -other, error)
    return f"{far} {word} {what} ({there}{' effective' if at.load.real else ''} there)"


def _stresses(answer: Answer) -> list[str]:
    """Stress at buckling and lift-off."""
    assessment, scales = answer.assessment, answer.case.scales
    if scales is None or assessment.section is None:
        return []
    parts = []
    for state in (assessment.at_buckling, assessment.at_lift_off):
        found = None if state is None else assessment.stress(state)
        if state is None or found is None:
            continue
        safety = "" if found.safety is None else f" (safety factor {amount(*found.safety, 3)})"
        parts.append(f"{quantity(scales.system, found.value, found.error, 'stress', 3)} {state.name}{safety}")
    return [f"Largest von Mises stress in the rod: {', '.join(parts)}."]


def local_sentence(answer: Answer) -> str:
    """Where along the string buckling starts, by the local limit; empty where there is none."""
    assessment, scales = answer.assessment, answer.case.scales
    over = assessment.over_local(assessment.at_buckling)
    if over is None or scales is None or assessment.local is None:
        return ""
    local = assessment.local
    error = local.critical.error + abs(local.length_effect) * over.limit  # of the rod that was computed, and its length
    text = (
        f"Locally, an endless rod in a straight hole of this inclination would buckle at "
        f"{quantity(scales.system, over.limit, error, 'force')} of compression"
    )
    if over.to <= 0.0:
        return f"{text}: nowhere exceeded when this string buckles."
    if over.to >= 1.0:
        return (
            f"{text}: exceeded all along the string when it buckles, since its ends hold it; the string's exact load "
            "decides."
        )
    slope = answer.case.problem.axial_weight * scales.factor("force")
    lowest = size_text(answer, over.to, error / slope, "length")
    return (
        f"{text}: when this string buckles, that is exceeded over its lowest {lowest}, where "
        "buckling starts; the string's exact load decides."
    )
