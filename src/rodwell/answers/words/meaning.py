"""What an answer means, in sentences: end, sign, unit and condition stated wherever a force stands."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from rodwell.analysis.branch.special import CRITICAL, LIFT_OFF
from rodwell.analysis.loads.ends import BREAKS_SYMMETRY
from rodwell.analysis.state.extent import FADED, buckled_to
from rodwell.analysis.straight.critical import Mode
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.key_number import KeyNumber
from rodwell.answers.words.curved import in_curved_hole
from rodwell.answers.words.first_met import other_arm, without_wall
from rodwell.answers.words.floating import floating
from rodwell.answers.words.in_space import how_it_lies
from rodwell.answers.words.reach import unreached
from rodwell.answers.words.shown_loads import shown_sensitivities
from rodwell.answers.words.steps import HOLDS, held, steps_note
from rodwell.answers.words.verdict import load_sentences, verdict, window_sentences
from rodwell.answers.words.wording import around_text, forces_of, place_text, places_text, size_text, soft_wall
from rodwell.case.case import Case
from rodwell.problem.problem import Problem
from rodwell.problem.words import counted_around, ends_text
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import minus, percent, plain, signed
from rodwell.quantities.value import Value

ASSUMPTIONS = (
    "end force and end torque are dead loads at the {end} s = 1",
    "rod inextensible, unshearable, linearly elastic, straight when free",
    "{hole}; contact without friction",
    "shapes computed for a rod kept on the wall: beyond lift-off they need a wall that also pulls",
)

EFFECTIVE = (
    "forces are effective ones, real force − pᵢ Aᵢ + pₒ Aₒ (tension positive), and the weight is the buoyed one: "
    "fluids at rest"
)
"""What is assumed of mud and pressures."""

LOWER_PART = 0.5
"""A mode that reaches less far up the rod is said to be confined to its lower end."""

SMALL_LOAD = 1.0
"""A load below this, in B/L², is near zero: percentages of it say nothing."""

ENDS_HOLD = {
    "clamped": "clamped (y and y′ held)",
    "pinned": "pinned (y held, free to turn)",
    "guided": "guided (y′ held, free to slide around the wall)",
    "free": "free (only the axial force)",
}


def assumptions(case: Case) -> tuple[str, ...]:
    """What the numbers assume, the ends first."""
    more = (EFFECTIVE,) if case.with_fluids else ()
    more = (*more, *held(case.problem.rod, HOLDS))
    hole = "cylinder rigid and straight" if case.problem.hole is None else "hole rigid, curved as given"
    end = "lower end" if case.problem.alpha > 90.0 else "upper end"
    hole += "" if math.isinf(case.wall_stiffness) else ", up to lift-off"
    return (ends_text(case.problem, ENDS_HOLD), *more, *(text.format(hole=hole, end=end) for text in ASSUMPTIONS))


def sentences(answer: Answer) -> list[str]:
    """What the numbers mean, most important first."""
    a, tells_buckling = answer.assessment, answer.left_before is None and answer.lying is None
    bent = answer.case.problem.hole is not None
    out = [
        verdict(a),
        *floating(answer.case),
        *soft_wall(answer.case),
        *load_sentences(a),
        *unreached(a),
        without_wall(answer),
        how_it_lies(a, answer.lying) if answer.lying is not None else "",
        _mode(answer.critical, answer.case, kept=answer.untouched) if tells_buckling else "",
        _asked(answer),
        _lift_off(answer),
        "" if answer.at_lift_off is None or bent else steps_note(answer.at_lift_off.step_loads, answer.case),
    ]
    out += [
        _stability(answer) if tells_buckling or (answer.lying and answer.lying.buckled) else "",
        *window_sentences(a),
    ]
    out.append(_wall(answer.key_numbers, answer.case.scales, answer.case.problem) if answer.at_lift_off else "")
    out += [_inputs(answer)] if answer.sensitivities else []
    out += in_curved_hole(answer) if bent else []
    out.append(a.validity.sentence)
    return [sentence for sentence in out if sentence]


def _mode(critical: Sequence[Mode], case: Case, *, kept: bool) -> str:
    """How the rod buckles, and how far up; ``kept``: how it would, if it were kept on the wall."""
    first = critical[0]
    s = np.union1d(np.linspace(0.0, 1.0, 2001), first.space.greville)[1:-1]
    y = first.shape(s)
    farthest, y = buckled_to(first), y[np.abs(y) > FADED]
    waves = 1 + int(np.sum(np.sign(y[1:]) * np.sign(y[:-1]) < 0.0))
    error = shape_error(critical)
    about = "" if error < FADED else "about "
    why = "axial weight" if case.problem.axial_weight != 0.0 else "unequal ends"
    why = "as the hole is" if case.problem.axis else why
    shape = {1: "symmetric", -1: "antisymmetric", 0: f"unsymmetric ({why})"}[first.parity]
    plural = "" if waves == 1 else "s"
    text = "Kept on the wall it would buckle" if kept else "It buckles"
    text += f" sideways along the wall into {about}{waves} half wave{plural}, {shape} about mid-length."
    if farthest < LOWER_PART:
        place = place_text(case, Value(farthest, error / _falls(first, farthest)))
        text += f" Beyond {place} the rod stays straight (deflections below {FADED:g} of the largest)."
    if len(critical) > 1:
        second, size = critical[1], max(abs(first.force), 1e-300)
        gap = Value(abs(second.force - first.force) / size, (first.error + second.error) / size)
        if gap.value < 0.05:
            text += f" The second mode follows within {percent(gap, 2)}: imperfections may favour either."
    return text


def shape_error(critical: Sequence[Mode]) -> float:
    """Error of the first mode's shape, as part of its largest deflection.

    A load's error is of second order in that of its mode: their ratio to the gap to the next load is the square.
    """
    first = critical[0]
    others = [abs(mode.force - first.force) for mode in critical[1:]] or [abs(first.force)]
    return math.sqrt(first.error / max(min(others), 1e-300))


def _falls(mode: Mode, faded: float) -> float:
    """How steeply the deflection falls where it is :data:`FADED` of the largest, in largest deflections per L."""
    y, slope = mode.space.evaluate(mode.coefficients, np.array([faded]), 2)[:, 0]
    return max(abs(float(slope / y)) * FADED, 1e-300)


def _asked(computed: Computed) -> str:
    """The rod at the end force asked for, if that does not buckle it."""
    until, said = computed.case.until, forces_of(computed.case)
    if until is None or until < computed.buckling.value:
        return ""
    if computed.lying is not None and until > computed.lying.highest.value:
        return ""
    return (
        f"At the end force asked for, {said.load(Value(until), other=True)}, the "
        f"{'straight rod is stable' if computed.case.problem.hole is None else 'rod lies along the hole'}; the "
        "diagrams go beyond it to show what follows."
    )


def _lift_off(computed: Computed) -> str:
    lift, first, said = computed.lift_off, computed.first, forces_of(computed.case)
    if computed.left_before is not None or (computed.no_window and computed.lying is not None):
        return ""
    if lift is None and not first.reached_end:
        lowest, highest = (said.load(Value(force)) for force in first.reach)
        return (
            f"No lift-off was found on the first mode, but its branch could be followed only from {lowest} to "
            f"{highest}: {first.ended_because}."
        )
    if lift is None:
        far = said.load(Value(computed.until), other=True)
        return f"The first mode does not lift off the wall down to {far}."
    if first.lift_off_at_buckling:
        return (
            "Lift-off coincides with buckling: no lateral weight presses the rod to the wall, so it leaves the wall "
            "as soon as it buckles."
        )
    return (
        f"The buckled rod stays on the wall until it is under {said.load(lift.load, other=True)}; there it lifts off "
        f"at {places_text(computed.case, lift)}.{other_arm(computed)}"
    )


def _stability(computed: Computed) -> str:
    """Where the buckled shape is stable, from the special points up to lift-off in the order of travel."""
    branch, shape = computed.first, f"The buckled shape{' of mode 1' if computed.lying is None else ''}"
    points = list(branch.special_points)
    to_lift_off = computed.at_lift_off is not None
    if to_lift_off:
        points = points[: 1 + next(i for i, p in enumerate(points) if p.kind == LIFT_OFF)]
    what = "up to lift-off" if to_lift_off else "over the range shown"
    if branch.lift_off_at_buckling:
        what += ", if kept on the wall"
    lost = next((p for p in points if p.index_after > 0), None)
    if lost is None:
        return f"{shape} is stable {what} (under dead loads)."
    if lost.kind == CRITICAL:
        return f"{shape} is unstable from the start (under dead loads): the rod takes another shape."
    where = forces_of(computed.case).load(lost.load)
    return f"{shape} is stable only until it is under {where} (dead loads): there the rod takes another shape."


def _inputs(computed: Computed) -> str:
    """What a change of the inputs does to the load that matters, and what their uncertainty does."""
    load, spread = shown_sensitivities(computed)[-1]
    if abs(load.force) < SMALL_LOAD:
        return ""
    e = load.elasticities()
    names = {"clearance": "clearance", "weight_per_length": "weight", "stiffness": "stiffness", "length": "length",
             "build": "curvature of the hole", "walk": "turn of the hole"}  # fmt: skip
    parts = ", ".join(f"{names[name]} {_signed(e[name])}" for name in names if name in e)
    where = forces_of(computed.case).at_end
    text = f"One percent more of an input changes the {load.name}{where} by: {parts}"
    text += f"; one degree more from the vertical by {_signed(e['alpha'])}." if "alpha" in e else "."
    text += f" Note: {BREAKS_SYMMETRY}." if BREAKS_SYMMETRY in load.note else ""
    if spread is not None:
        scales = computed.case.scales
        size = f"{plain(spread.total, 2)} B/L²" if scales is None else scales.system.text(spread.total, "force", 2)
        text += f" The uncertainties given make it uncertain by ± {size}, most of it from {spread.largest}."
    return text


def _signed(change: Value) -> str:
    """A change in percent with its sign: two decimals, or as many as the error allows."""
    places, (value, error) = 2, change
    while places > 0 and 0.5 * 10.0**-places < error:
        places -= 1
    if 0.5 * 10.0**-places >= error:
        return minus(f"{value:+.{places}f} %")
    return f"{signed(value, 1)} ± {plain(error, 1)} %"


def _wall(numbers: Mapping[str, KeyNumber], scales: Scales | None, problem: Problem) -> str:
    """What wall and supports bear at lift-off."""

    def text(name: str, unit: str) -> str:
        return size_text(scales, numbers[name].number, numbers[name].dimension, unit)

    bears = (
        f"At lift-off the wall bears at most {text('largest_wall_force', 'B/L³')}, "
        f"{text('total_wall_force', 'B/L²')} in all"
    )
    if "support_torque" not in numbers:
        side = around_text(numbers["largest_wall_force_angle"].number, problem)
        far = around_text(numbers["largest_angle"].number, problem)
        far = far.replace(f" to the {counted_around(problem)[1]} of", " from")
        return f"{bears}, the most on {side}; the rod lies up to {far}."
    support = (
        "the cylinder's supports need no torque"
        if numbers["support_torque"].value == 0.0
        else f"the support at s = 0 must provide a torque of {text('support_torque', 'B/L')} (if the rod's weight is "
        "taken up along the cylinder; else the fittings of the rod do)"
    )
    stress = ""
    if "cylinder_stress" in numbers:
        note = numbers["cylinder_stress"].note
        stress = f" Its equivalent stress is then {text('cylinder_stress', '')}, {note}."
    return (
        f"{bears}; the cylinder carries a twisting moment of up to "
        f"{text('largest_torque', 'B/L')}, and {support}.{stress}"
    )
