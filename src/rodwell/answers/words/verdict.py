"""The verdict in one sentence, and what it rests on: loads that act, the safe window, what gives on the way."""

from __future__ import annotations

import math

from rodwell.answers.result.assessment import BUCKLED, LEFT, OTHER_SHAPE, PULLED, STRAIGHT, Assessment, AtLoad
from rodwell.answers.result.lying import followed_from
from rodwell.answers.words.in_space import NOT_GIVEN, lies_from, lies_until, what_ends
from rodwell.answers.words.steps import IF_HELD, held, not_held_aside
from rodwell.answers.words.wording import forces_of, place_text, quantity, side_of, size_text
from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.problem.words import ends_text, hole_text
from rodwell.quantities.forces import end_name
from rodwell.quantities.text import amount, percent, plain
from rodwell.quantities.value import Value
from rodwell.strength.limits import LIFTS_OFF, UNSTABLE, YIELDS
from rodwell.strength.loaded import LoadedRod


def verdict(a: Assessment) -> str:
    """The answer in one sentence with its assumptions.

    For the loads that act the most compressive one; without such loads, where the rod buckles and how far it is from
    there to lift-off. What the theory does not cover is said first.
    """
    text = _range(a) if not a.applied else _at(a, min(a.applied, key=lambda at: at.load.force))
    rough = f"Only a rough guide, since the theory assumes small strain ({a.validity.why}): " if a.validity.left else ""
    return f"{rough}{text}; assumptions: {_assumed(a.case)}."


def load_sentences(a: Assessment) -> list[str]:
    """What becomes of the rod at the loads that act, other than the one of the verdict; then where it buckles."""
    if not a.applied:
        return []
    most = min(a.applied, key=lambda at: at.load.force)
    return [_at(a, at) + "." for at in a.applied if at is not most] + [_range(a) + "."]


def window_sentences(a: Assessment) -> list[str]:
    """What gives before lift-off, stress at buckling and lift-off, and where the local limit is exceeded."""
    out = []
    for limit in a.window.limits:
        if limit.kind in (LIFTS_OFF, UNSTABLE):
            continue
        if limit.load is None:
            at = "any end force" if a.computed.lying is None else "every end force that was followed"
            out.append(f"{limit.name[:1].upper()}{limit.name[1:]} is reached at {at}.")
            continue
        before = "before buckling" if a.computed.lying is None else "as the rod lies"
        when = "after buckling, before lift-off" if limit.buckled else f"{before}: the elastic loads come too late"
        where = forces_of(a.case).load(limit.load, other=True)
        out.append(f"{limit.name[:1].upper()}{limit.name[1:]} at {where}, {when}.")
    return [*out, *_stresses(a), local_sentence(a)]


def _assumed(case: Case) -> str:
    """The assumptions in a few words."""
    fluids = ", effective forces" if case.with_fluids else ""
    at_steps = "".join(f", {text}" for text in held(case.problem.rod))
    hole = hole_text(case.problem)
    hole += "" if math.isinf(case.wall_stiffness) else ", wall rigid up to lift-off"
    return f"frictionless, elastic, {hole}, {ends_text(case.problem)}{at_steps}{fluids}"


def _range(a: Assessment) -> str:
    """Where the straight rod buckles, and how far it is from there to lift-off."""
    load, said = a.window.buckling, forces_of(a.case)
    if a.case.problem.hole is not None:
        return _range_in_curved_hole(a) + _window(a)
    if said.compression(load).value < 0.0:
        cause = "own weight" if not a.computed.untouched else "weight and twist" if a.case.problem.weight else "twist"
        text = (
            f"The rod buckles under its {cause}: it stays straight only if it is held in tension of at least "
            f"{said.size(load)}{said.at_end}{said.other(load)}"
        )
    else:
        text = (
            f"The straight rod is stable until the compression{said.at_end} reaches {said.size(load)}{said.other(load)}"
        )
    return text + _window(a)


def _range_in_curved_hole(a: Assessment) -> str:
    """Up to which load the rod lies along its hole."""
    if a.computed.lying is not None:
        return lies_until(a, a.computed.lying)
    load, said, left = a.window.buckling, forces_of(a.case), a.computed.left_before
    what = "on the wall, stable" if left is None else "on the wall"
    what += "".join(f", if {holds}" for holds in held(a.case.problem.rod, IF_HELD))
    compression = said.compression(load)
    if compression.value < 0.0:
        text = f"The rod lies along the hole, {what}, only under a tension of at least {said.size(load)}{said.at_end}"
    else:
        text = f"The rod lies along the hole, {what}, until the compression{said.at_end} reaches {said.size(load)}"
    text += said.other(load) + not_held_aside(a.computed.not_held_at_steps, a.case)
    if left is None:
        return text
    return f"{text}; there it leaves {_side(a, left.s)}{'' if followed_from(a.case.problem, left.value) else NOT_GIVEN}"


def _side(a: Assessment, s: float) -> str:
    """The side of a curved hole that the rod leaves, and where first: the curve presses it away from the wall."""
    return f"the {side_of(a.case)} side at {place_text(a.case, Value(s))}, pressed away from it by the curve"


def in_tension(a: Assessment) -> str:
    """Where tension, or too little compression, takes the rod off its side of a curved hole; or nothing."""
    if a.computed.lying is not None:
        return lies_from(a, a.computed.lying)
    off, said = a.computed.left_in_tension, forces_of(a.case)
    if off is None:
        return ""
    load = Value(off.value, off.error)
    if said.compression(load).value > 0.0:
        return (
            f"It lies there only if the compression{said.at_end} is at least {said.size(load)}{said.other(load)}: "
            f"under less the rod leaves {_side(a, off.s)}{NOT_GIVEN}."
        )
    return f"Under more than {said.load(load, other=True)} the rod leaves {_side(a, off.s)}{NOT_GIVEN}."


def _window(a: Assessment) -> str:
    """The way from buckling to lift-off as the end of a sentence."""
    window, scales = a.window, a.case.scales
    if a.computed.no_window and not a.branch.lift_off_at_buckling:
        return "" if a.computed.lying is None else _yields(a, "")
    if a.branch.lift_off_at_buckling:
        return "; it leaves the wall as soon as it buckles"
    end, width = window.end, window.width
    if end is None or width is None:
        return ""
    if not end.buckled:
        return "; the shape it buckles into is unstable from the start"
    part, holds = share_shown(a), " and ".join(held(a.case.problem.rod, IF_HELD))
    further = size_text(scales, width) + ("" if part is None else f" ({percent(part)})")
    condition = f", if {holds}" if holds else ""
    text = f"; buckled, it stays on the wall{condition}, stable, for another {further} until it "
    text += "lifts off" if end.kind == LIFTS_OFF else "loses its stability and takes another shape"
    if end.kind == LIFTS_OFF and a.at_lift_off is not None and a.stress(a.at_lift_off) is not None:
        text += f", {_stress(a, a.at_lift_off)}"
    yields = next((limit for limit in window.limits if limit.kind == YIELDS), None)
    return text if yields is None else text + _yields(a, f", before it {'lifts off' if yields.buckled else 'buckles'}")


def _yields(a: Assessment, before: str) -> str:
    """That the rod yields on the way, as the end of a sentence; nothing where it does not."""
    yields = next((limit for limit in a.window.limits if limit.kind == YIELDS), None)
    if yields is None:
        return ""
    where = "at any load" if yields.load is None else f"already at {forces_of(a.case).load(yields.load)}"
    return f"; but it yields {where}{before}"


def _stress(a: Assessment, state: LoadedRod) -> str:
    """Largest stress and safety factor in a state, as the end of a sentence."""
    largest, scales = a.stress(state), a.case.scales
    if largest is None or scales is None:
        return ""
    text = f"with a largest von Mises stress of {quantity(scales.system, largest, 'stress', 3)} in the rod"
    if largest.safety is None:
        return text
    text += f", safety factor {amount(largest.safety, 3)} against yield"
    return text if largest.safety.value >= 1.0 or state.name == "at lift-off" else text + ": it yields"


def share_shown(a: Assessment) -> Value | None:
    """Width of the window as a part of the compression at buckling, at the end at which loads are shown."""
    width, size = a.window.width, forces_of(a.case).compression(a.window.buckling)
    if width is None or size.value <= size.error:
        return None
    part = width.value / size.value
    return Value(part, (width.error + abs(part) * size.error) / size.value)


def load_text(case: Case, load: AppliedLoad) -> str:
    """A load as it was given: "35 000 lbf of compression at the bottom"."""
    sign = "compression" if load.given < 0.0 else "tension"
    end = end_name(case.scales, bottom=load.bottom)
    if case.scales is None:
        return f"{plain(load.given, 6)} B/L² at {'s = 0' if load.bottom else 's = 1'} ({sign})"
    kind = ", real force in the wall" if load.real else ""
    at = "" if case.problem.hung_weight == 0.0 and not load.real else f" at {end}"
    return f"{case.scales.system.text(abs(load.given), 'force', 6)} of {sign}{at}{kind}"


def _at(a: Assessment, at: AtLoad) -> str:
    """What becomes of the rod at a load that acts."""
    start = f"At {load_text(a.case, at.load)}"
    if at.what == STRAIGHT:
        state = "is straight and stable" if a.case.problem.hole is None else "lies along the hole"
        lying = a.computed.lying
        next_up = "buckling" if a.computed.left_before is None else "leaving the wall"
        if lying is not None and lying.end is None:
            text = f"{start} the rod {state} on the wall, stable"
        else:
            next_up = next_up if lying is None else what_ends(lying)
            text = f"{start} the rod {state}, {_apart(a.case, at, a.window.buckling, next_up)}"
    elif at.what == BUCKLED:
        far, last = "", a.window.end
        if last is not None and last.load is not None:
            what = "lift-off" if last.kind == LIFTS_OFF else "the loss of its stability"
            far = f", {_apart(a.case, at, last.load, what)}"
        text = f"{start} the rod is buckled but stays on the wall and stable{far}"
    elif at.what == OTHER_SHAPE:
        return f"{start} {_other_shape(a, at)}: it takes another shape, not given here"
    elif at.what in (LEFT, PULLED):
        return f"{start} {_left(a, at) if at.what == LEFT else _pulled(a)}"
    else:
        return f"{start} the state of the rod is not known: {at.why}"
    assert at.state is not None
    return f"{text}{', ' if a.stress(at.state) else ''}{_stress(a, at.state)}"


def _other_shape(a: Assessment, at: AtLoad) -> str:
    """A rod that has lost the stability of the shape that was followed."""
    lying, lost = a.computed.lying, a.window.stable_until
    if lying is not None and (lying.buckled is None or at.load.force > lying.highest.value):
        ends = lying.lowest if at.load.force < lying.lowest.value else lying.highest
        return f"the rod no longer lies as it did, which is stable to {forces_of(a.case).load(ends)} only"
    where = "" if lost is None or lost.load is None else f", which ends at {forces_of(a.case).load(lost.load)}"
    part = "mode 1" if lying is None else "the shape into which it buckles"
    return f"the rod is buckled beyond the stable part of {part}{where}"


def _pulled(a: Assessment) -> str:
    """A rod that tension, or too little compression, has taken off the wall of a curved hole."""
    if a.computed.lying is not None:
        return f"the rod has left the wall: {lies_from(a, a.computed.lying, first=False)[:-1]}"
    assert a.computed.left_in_tension is not None
    return f"the rod has left {_side(a, a.computed.left_in_tension.s)}"


def _left(a: Assessment, at: AtLoad) -> str:
    """A rod that has left the wall at a load that acts."""
    assert a.window.lift_off is not None
    at_once = a.computed.left_before is None and a.computed.off_at_once
    text = f"the rod has left the wall, {_apart(a.case, at, a.window.lift_off, 'buckling' if at_once else 'lift-off')}"
    text += ", where nothing presses it to the wall" if at_once else ""
    return text + ": its shape and stresses are no longer those of a rod on the wall and are not given"


def _apart(case: Case, at: AtLoad, limit: Value, what: str) -> str:
    """How far a load lies from another, measured where it was given: "12 % short of lift-off (−38.5 kN there)"."""
    more, scales = case.problem.hung_weight if at.load.bottom else 0.0, case.scales
    load, other = more - at.load.force, more - limit.value
    word = "short of" if load <= other else "beyond"
    far = (
        size_text(scales, Value(abs(other - load), limit.error))
        if other <= 0.0 or load < 0.0
        else percent(Value(abs(1.0 - load / other), limit.error * load / other**2))
    )
    if scales is None:
        there = f"{amount(Value(-other, limit.error), 6)} B/L²"
    else:
        there = size_text(scales, Value(abs(other), limit.error)) + (" of tension" if other < 0.0 else "")
    return f"{far} {word} {what} ({there}{' effective' if at.load.real else ''} there)"


def _stresses(a: Assessment) -> list[str]:
    """Stress at buckling and lift-off."""
    scales = a.case.scales
    if scales is None or a.section is None:
        return []
    parts = []
    for state in (a.at_rest, a.at_buckling, a.at_lift_off):
        largest = None if state is None else a.stress(state)
        if state is None or largest is None:
            continue
        safety = "" if largest.safety is None else f" (safety factor {amount(largest.safety, 3)})"
        parts.append(f"{quantity(scales.system, largest, 'stress', 3)} {state.name}{safety}")
    return [f"Largest von Mises stress in the rod: {', '.join(parts)}."]


def local_sentence(a: Assessment) -> str:
    """Where along the string buckling starts, by the local limit; empty where there is none."""
    over, scales = a.over_local(a.at_buckling), a.case.scales
    if over is None or scales is None or a.local is None or a.local.critical.compression is None:
        return ""
    # the error of the rod that was computed, and of its length
    error = a.local.critical.compression.error + abs(a.local.length_effect) * over.limit
    text = (
        f"Locally, an endless rod in a straight hole of this inclination would buckle at "
        f"{quantity(scales.system, Value(over.limit, error), 'force')} of compression"
    )
    if over.to <= 0.0:
        return f"{text}: nowhere exceeded when this string buckles."
    if over.to >= 1.0:
        return (
            f"{text}: exceeded all along the string when it buckles, since its ends hold it; the string's exact load "
            "decides."
        )
    slope = a.case.problem.hung_weight * scales.factor("force")
    lowest = size_text(scales, Value(over.to, error / slope), "length")
    return (
        f"{text}: when this string buckles, that is exceeded over its lowest {lowest}, where "
        "buckling starts; the string's exact load decides."
    )
