"""What the curve of a hole does to the rod in it, and what is not told of a curved hole, in sentences."""

from __future__ import annotations

from rodwell.analysis.off_wall.curved.refused import in_such_a_hole
from rodwell.analysis.state.wall import lying_step_loads
from rodwell.analysis.straight.lying import off_at_steps
from rodwell.answers.result.answer import Answer
from rodwell.answers.words.steps import steps_note
from rodwell.answers.words.verdict import in_tension
from rodwell.answers.words.wording import forces_of, place_text, quantity, side_of, size_text
from rodwell.quantities.text import percent
from rodwell.quantities.value import Value


def in_curved_hole(answer: Answer) -> list[str]:
    """The bending by the hole and its steps, what tension does, what the rod's own places change, what is left out."""
    said = (_bending(answer), _at_steps(answer), in_tension(answer.assessment), _places(answer), left_out(answer))
    return [text for text in said if text]


def _bending(answer: Answer) -> str:
    """How much the hole alone bends the rod: moment and stress, which all stresses told contain."""
    case, a = answer.case, answer.assessment
    bending = answer.key_numbers["hole_bending"]
    what = "The hole alone" if answer.lying is None else "At rest the hole"
    text = f"{what} bends the rod by up to {size_text(case.scales, bending.number, 'moment', 'B/L')}"
    text += f", at {place_text(case, Value(bending.s[0]))}" if case.problem.axis else ""
    if a.section is None or case.scales is None:
        return f"{text}."
    peak = (a.at_rest or a.at_buckling).largest(a.bending_stress)
    part = f", {quantity(case.scales.system, peak, 'stress', 3)} of bending stress"
    strength = case.yield_strength
    if strength is not None:
        part += f" ({percent(Value(peak.value / strength, peak.error / strength), 2)} of the yield strength)"
    return f"{text}{part}; every stress and safety factor contains it."


def _at_steps(answer: Answer) -> str:
    """What the bend asks of the wall at steps of a string that lies along it."""
    problem, lying = answer.case.problem, answer.lying
    if lying is not None:
        return steps_note(lying.rest.step_loads, answer.case, bent=True)
    off = off_at_steps(problem, answer.critical[0].force)
    return f"{steps_note(lying_step_loads(problem), answer.case, bent=True, off=off)}{_not_held(answer)}"


def _not_held(answer: Answer) -> str:
    """When a string buckles that nothing holds there: it may be before the one that is held, by little."""
    load, held = answer.not_held_at_steps, answer.critical[0].load
    if load is None:
        return ""
    if isinstance(load, str):
        return f" When one buckles that nothing holds there was not found: {load}."
    earlier = load.value - load.error > held.value + held.error
    text = f" One that nothing holds there buckles sideways{', before the one that is held,' if earlier else ''} at "
    text += f"{forces_of(answer.case).load(load)}."
    if earlier and any(one.force < load.value for one in answer.case.applied):
        text += " Under the most compressive load that acts it has buckled, whatever is told of the one that is held."
    return text


def _places(answer: Answer) -> str:
    """By how much branches are off, which take the hole where the undeformed rod is."""
    lift = answer.lift_off_load
    if lift is None or (answer.lying is None and answer.at_lift_off is None):
        return ""
    own = answer.lift_off_at_own_places
    text = "Buckled states take the hole where the rod is before it buckles"
    if answer.lying is not None:
        side = side_of(answer.case)
        text = f"States take the hole where the rod would be on the {side} side, undeformed"
    if own is None:
        return f"{text}; what that changes of the lift-off load could not be computed."
    change = Value(abs(own.value - lift.value), own.error + lift.error)
    return (
        f"{text}; with every cross-section at its own place lift-off is at {forces_of(answer.case).load(own)}, "
        f"{size_text(answer.case.scales, change)} away."
    )


def left_out(answer: Answer) -> str:
    """What a straight hole's answer has and this one has not."""
    moments = "moments in the cylinder" + ("" if answer.case.cylinder is None else " and its stress")
    parts = [] if in_such_a_hole(answer.case.problem) else ["states off the wall"]
    parts += ["the load without the wall's help", moments]
    if not answer.sensitivities:
        parts.append("derivatives by the inputs")
        if answer.case.uncertain:
            parts[-1] += ", so that the uncertainties given are not carried through"
    return f"Not told of a curved hole: {', '.join(parts[:-1])}, and {parts[-1]}."
