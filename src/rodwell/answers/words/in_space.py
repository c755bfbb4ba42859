"""How a rod lies in a hole that leaves the vertical plane, and where that ends, in sentences."""

from __future__ import annotations

import math

import numpy as np

from rodwell.analysis.branch.special import LIFT_OFF, SpecialPoint
from rodwell.analysis.loads.lying_rod import LyingRod
from rodwell.analysis.state.fields import fields_at
from rodwell.answers.result.assessment import Assessment
from rodwell.answers.result.lying import followed_from
from rodwell.answers.words.steps import IF_HELD, held
from rodwell.answers.words.wording import around_text, forces_of, place_text, places_text, size_text
from rodwell.case.case import Case
from rodwell.quantities.value import Value
from rodwell.strength.loaded import LoadedRod

ROUND = 2.0 * math.pi
"""Added to angles, which then are positive."""

GIVES_WAY = "there it loses its stability and takes another shape"


NOT_GIVEN = ": what it does beyond that is not given"


def what_ends(lying: LyingRod) -> str:
    """What ends the way of the rod as it lies, as a noun."""
    if lying.buckled is not None:
        return "buckling"
    if lying.end is None:
        return "nothing as far as it was followed"
    return "leaving the wall" if lying.end.kind == LIFT_OFF else "the loss of its stability"


def no_window(lying: LyingRod) -> str:
    """Why there is no way from buckling to lift-off of a rod that lies along such a hole without buckling."""
    why = "the rod moves around the hole with every change of the load, and does not buckle"
    if lying.end is None:
        return f"{why} as far as it was followed."
    if lying.end.kind == LIFT_OFF:
        return f"{why} before it leaves the wall."
    return f"{why} into a shape beside its own; where it loses its stability it takes another one."


def lies_until(a: Assessment, lying: LyingRod) -> str:
    """Down to which end force the rod lies along its hole, and what happens there."""
    said, load, end = forces_of(a.case), lying.lowest, lying.end
    compression = said.compression(load)
    if said.scales is None:
        until = f"until it is under {said.load(load)}"
    elif compression.value < 0.0:
        until = f"only under a tension of at least {said.size(load)}{said.at_end}{said.other(load)}"
    else:
        until = f"until the compression{said.at_end} reaches {said.size(load)}{said.other(load)}"
    if_held = "".join(f"if {holds}, " for holds in held(a.case.problem.rod, IF_HELD))
    text = f"The rod lies along the hole, on the wall and stable, {if_held}{until}"
    if end is None:
        return f"{text}, and was followed no farther{_why(lying)}"
    if lying.buckled is not None:
        return f"{text}; there it buckles"
    followed = followed_from(a.case.problem, load.value)
    if end.kind == LIFT_OFF:
        return f"{text}; there it leaves the wall at {_where(a.case, end)}{'' if followed else NOT_GIVEN}"
    return f"{text}; {GIVES_WAY}{'' if followed else ', not given here'}"


def _why(lying: LyingRod) -> str:
    return "" if lying.pressed.reached_end else f" ({lying.pressed.ending})"


def _where(case: Case, end: SpecialPoint) -> str:
    """The places where a rod leaves the wall, and on which side of the hole the first is."""
    state = end.solution
    angles = [fields_at(state.problem, f, one, np.array(end.s[:1]))["xi2"][0] for f, one in state.levels]
    angle = Value(float(angles[1]), abs(float(angles[1] - angles[0])))
    return f"{places_text(case, end)}, on {around_text(angle, case.problem)}"


def lies_from(a: Assessment, lying: LyingRod, *, first: bool = True) -> str:
    """Up to which end force, or down to how little compression, it lies there, and what happens beyond.

    ``first``: as the beginning of a sentence.
    """
    said, load, end = forces_of(a.case), lying.highest, lying.end_in_tension
    if said.scales is None:
        beyond = f"Above {said.load(load)}"
    elif said.compression(load).value > 0.0:
        beyond = f"Under less compression than {said.size(load)}{said.at_end}{said.other(load)}"
    else:
        beyond = f"Under more than {said.load(load, other=True)}"
    beyond = beyond if first else beyond[:1].lower() + beyond[1:]
    if end is None:
        why = "" if lying.pulled.reached_end else f" ({lying.pulled.ending})"
        return f"{beyond} it was not followed{why}."
    if end.kind == LIFT_OFF:
        return f"{beyond} it leaves the wall, first at {_where(a.case, end)}."
    return f"{beyond} it loses its stability and takes another shape."


def how_it_lies(a: Assessment, lying: LyingRod) -> str:
    """At which angles around the hole the rod lies at rest and at the end of its way, and what it presses there."""
    said, last = forces_of(a.case), lying.last
    parts = []
    for state in (a.at_rest, a.at_buckling):
        assert state is not None
        free = state.force == 0.0 and said.weight == 0.0
        parts.append(f"{'without end force' if free else f'under {said.load(state.load)}'} {_angles(state)}")
    push, total = (
        size_text(a.case.scales, number, dimension, unit)
        for number, dimension, unit in (
            (last.wall.contact, "force_per_length", "B/L³"), (last.wall.total, "force", "B/L²")
        )
    )  # fmt: skip
    most = f"{around_text(last.wall.angle, a.case.problem)} at {place_text(a.case, Value(last.wall.contact.s))}"
    return (
        "Weight and bend press the rod to different sides of this hole, so that it lies on no straight line along it "
        f"and moves with every change of the load: {'; '.join(parts)}. There the wall bears at most {push}, {total} in "
        "all, "
        f"the most on {most}."
    )


def _angles(state: LoadedRod) -> str:
    """Between which angles around the hole a state lies."""
    high, low = state.largest(lambda f: ROUND + f["xi2"]), state.largest(lambda f: ROUND - f["xi2"])
    ends = Value(ROUND - low.value, low.error), Value(high.value - ROUND, high.error)
    first, last = (around_text(angle, state.problem) for angle in ends)
    return f"on {first} all along" if first == last else f"from {first} to {last}"
