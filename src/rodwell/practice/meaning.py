"""What an answer means, in sentences: end, sign, unit and condition stated wherever a force stands."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.extent import FADED, buckled_to
from rodwell.analysis.special import CRITICAL, LIFT_OFF
from rodwell.practice.answer import Answer
from rodwell.practice.verdict import load_sentences, verdict, window_sentences
from rodwell.practice.wording import force_text, place_text
from rodwell.problem import ends_text

__all__ = ["ASSUMPTIONS", "assumptions", "force_text", "place_text", "sentences"]

ASSUMPTIONS = (
    "end force and end torque are dead loads at s = 1",
    "rod inextensible, unshearable, linearly elastic, straight when free",
    "cylinder rigid and straight; contact without friction",
    "shapes computed for a rod kept on the wall: beyond lift-off they need a wall that also pulls",
)

EFFECTIVE = (
    "forces are effective ones, N = N_real − pᵢ Aᵢ + pₒ Aₒ (tension positive), and the weight is the buoyed one: "
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


def assumptions(answer: Answer) -> tuple[str, ...]:
    """What the numbers assume, the ends first."""
    fluids = (EFFECTIVE,) if answer.case.with_fluids else ()
    return (ends_text(answer.case.problem, ENDS_HOLD), *fluids, *ASSUMPTIONS)


def sentences(answer: Answer) -> list[str]:
    """What the numbers mean, most important first."""
    out = [verdict(answer), *load_sentences(answer), _mode(answer)]
    out += _applied(answer)
    out += [_lift_off(answer), _stability(answer), *window_sentences(answer), _wall(answer), _inputs(answer)]
    return [sentence for sentence in out if sentence]


def _mode(answer: Answer) -> str:
    first = answer.critical[0]
    s = np.union1d(np.linspace(0.0, 1.0, 2001), first.space.greville)[1:-1]
    y = first.shape(s)
    farthest, y = buckled_to(first), y[np.abs(y) > FADED]
    waves = 1 + int(np.sum(np.sign(y[1:]) * np.sign(y[:-1]) < 0.0))
    why = "axial weight" if answer.case.problem.axial_weight != 0.0 else "unequal ends"
    shape = {1: "symmetric", -1: "antisymmetric", 0: f"unsymmetric ({why})"}[first.parity]
    plural = "" if waves == 1 else "s"
    text = f"It buckles sideways along the wall into {waves} half wave{plural}, {shape} about mid-length."
    if farthest < LOWER_PART:
        text += f" Beyond {place_text(answer, farthest)} the rod stays straight"
        text += f" (deflections below {FADED:g} of the largest)."
    if len(answer.critical) > 1:
        gap = abs(answer.critical[1].force - first.force) / max(abs(first.force), 1e-300)
        if gap < 0.05:
            text += f" The second mode follows within {100.0 * gap:.2g} %: imperfections may favour either."
    return text


def _applied(answer: Answer) -> list[str]:
    until = answer.case.until
    if until is None:
        return []
    first = answer.critical[0].force
    if until >= first:
        return [
            f"At the end force asked for, {force_text(answer, until)} at s = 1, the straight rod is stable; the "
            "diagrams go beyond it to show what follows."
        ]
    return []


def _lift_off(answer: Answer) -> str:
    lift = answer.lift_off
    if lift is None and not answer.first.reached_end:
        lowest, highest = (force_text(answer, force) for force in answer.first.reach)
        return (
            f"No lift-off was found on the first mode, but its branch could be followed only over end forces from "
            f"{lowest} to {highest} at s = 1: {answer.first.ended_because}."
        )
    if lift is None:
        down_to = force_text(answer, answer.until)
        return f"The first mode does not lift off the wall down to the end force {down_to} at s = 1."
    if answer.first.lift_off_at_buckling:
        return (
            "Lift-off coincides with buckling: no lateral weight presses the rod to the wall, so it leaves the wall "
            "as soon as it buckles."
        )
    places = " and ".join(place_text(answer, s) for s in lift.s)
    return (
        f"The buckled rod stays on the wall until the end force at s = 1 is {force_text(answer, lift.force)}; there it "
        f"lifts off at {places}."
    )


def _stability(answer: Answer) -> str:
    """Where the buckled shape is stable, from the special points up to lift-off in the order of travel."""
    branch = answer.first
    points = list(branch.special_points)
    to_lift_off = answer.at_lift_off is not None
    if to_lift_off:
        points = points[: 1 + next(i for i, p in enumerate(points) if p.kind == LIFT_OFF)]
    what = "up to lift-off" if to_lift_off else "over the range shown"
    if branch.lift_off_at_buckling:
        what += ", if kept on the wall"
    lost = next((p for p in points if p.index_after > 0), None)
    if lost is None:
        return f"The buckled shape of mode 1 is stable {what} (under dead loads)."
    if lost.kind == CRITICAL:
        return "The buckled shape of mode 1 is unstable from the start (under dead loads): the rod takes another shape."
    where = force_text(answer, lost.force)
    return (
        f"The buckled shape of mode 1 is stable only until the end force at s = 1 is {where} (under dead loads): "
        "there the rod takes another shape."
    )


def _inputs(answer: Answer) -> str:
    """What a change of the inputs does to the load that matters, and what their uncertainty does."""
    load, spread = answer.sensitivities[-1], answer.spreads[-1]
    if abs(load.force) < SMALL_LOAD:
        return ""
    e = {name: value for name, (value, _) in load.elasticities().items()}
    names = {"clearance": "clearance", "weight_per_length": "weight", "stiffness": "stiffness", "length": "length"}
    parts = ", ".join(f"{names[name]} {e[name]:+.2f} %" for name in names)
    text = f"One percent more of an input changes the {load.name} by: {parts}; one degree more from the vertical by "
    text += f"{e['alpha']:+.2f} %."
    text = text.replace(" -", " −")
    if spread is not None:
        scales = answer.case.scales
        size = f"{spread.total:.2g} B/L²" if scales is None else scales.system.text(spread.total, "force", 3)
        text += f" The uncertainties given make it uncertain by ±{size}, most of it from {spread.largest}."
    return text


def _wall(answer: Answer) -> str:
    if answer.at_lift_off is None:
        return ""
    figures = answer.figures
    scales = answer.case.scales

    def text(name: str, unit: str) -> str:
        figure = figures[name]
        if scales is None:
            return f"{figure.value:.4g} {unit}".replace("-", "−")
        return figure.text(answer.case, 4)

    torque = figures["support_torque"]
    support = (
        "the cylinder's supports need no torque"
        if torque.value == 0.0
        else f"the support at s = 0 must provide a torque of {text('support_torque', 'B/L')} (if the rod's weight is "
        "taken up along the cylinder; else the fittings of the rod do)"
    )
    stress = ""
    if "cylinder_stress" in figures:
        figure = figures["cylinder_stress"]
        stress = f" Its equivalent stress is then {figure.text(answer.case, 4)}, {figure.note.split(',')[0]}."
    return (
        f"At lift-off the wall bears at most {text('largest_wall_force', 'B/L³')}, "
        f"{text('total_wall_force', 'B/L²')} in all; the cylinder carries a twisting moment of up to "
        f"{text('largest_torque', 'B/L')}, and {support}.{stress}"
    )
