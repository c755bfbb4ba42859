"""What happens beyond lift-off, in sentences: the loop first, then the loads that act."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rodwell.analysis.off_wall.state import HELIX, ON_WALL, OTHER_SIDE, PARTIAL, STRAIGHT
from rodwell.analysis.path.events import LIFT_OFF, LOADING, SNAP, TOUCHES, UNLOADING, PathPoint, unbuckled
from rodwell.analysis.path.load_path import ASSUMPTIONS, HARD
from rodwell.analysis.path.words import gradually, is_gradual
from rodwell.answers.result.beyond import Beyond, StateBeyond, Step
from rodwell.answers.words.verdict import load_text
from rodwell.answers.words.wording import forces_of, place_text, quantity, size_text
from rodwell.case.applied import AppliedLoad
from rodwell.case.case import Case
from rodwell.problem.words import ends_text
from rodwell.quantities.text import amount
from rodwell.quantities.value import Value

HOW = "frictionless, without inertia"


def beyond_sentences(case: Case, found: Beyond) -> list[str]:
    """The whole story in one sentence, what the wall and the rod bear, and the states at the loads that act."""
    if found.path is None:
        return [f"What happens beyond lift-off is not told: {found.why}."]
    return [story(case, found), *_largest(case, found), *(_at(case, *pair) for pair in found.applied)]


def assumed_beyond(case: Case) -> str:
    """What is assumed of a load path, with the stiffness of the wall in the case's units."""
    if math.isinf(case.wall_stiffness):
        return ASSUMPTIONS
    size = size_text(case.scales, Value(case.wall_stiffness), "stress", "B/L⁴")
    return ASSUMPTIONS.replace(HARD, f"wall of stiffness {size}")


def story(case: Case, found: Beyond) -> str:
    """The loop in one sentence: lift-off, partial contact, snap, and the way back."""
    assert found.path is not None
    path = found.path
    up, down = ([one for one in path.events if one.leg == leg] for leg in (LOADING, UNLOADING))
    lift = next((one for one in up if one.kind == LIFT_OFF), None)
    snaps = [one for one in up if one.kind == SNAP]
    at_steps = case.problem.rod.stepped and case.problem.lateral_weight > 0.0
    stepped = "as soon as it buckles, at steps of its stiffness, " if at_steps else ""
    parts = [] if lift is None else [f"lifts off {stepped}at {_load(case, lift.force)}"]
    parts += [gradually(one, _load(case, one.force)) for one in up if is_gradual(case.problem, one)]
    if not snaps:
        known = f"at {_load(case, Value(path.until))}, as far as it was followed"
        last = known if path.reached else "to the last state found"
        loading = [one for one in found.events if one.event.leg == LOADING]
        parts.append(f"keeps {_contact(loading)} {last}")
    for i, snap in enumerate(snaps):
        where = _load(case, snap.force)
        keeps = f"keeps {_contact(_until(found.events, snap))} until {where}; then " if i == 0 else ""
        parts.append(f"{keeps}snaps{'' if i == 0 else f' again at {where}'} to {_named(snap)}")
    if snaps:
        parts[-1] += _back(case, found, down)
    said = forces_of(case)
    ended = "" if path.reached else f"; it was not followed to the end: {said.retold(path.ended_because)}"
    return f"As compression{said.at_end} grows, the rod {'; '.join(parts)}{ended} ({ends_text(case.problem)}; {HOW})."


def _back(case: Case, found: Beyond, down: Sequence[PathPoint]) -> str:
    """What becomes of the last state as the load is taken off, as the end of a clause."""
    assert found.path is not None
    leaves = next((one for one in down if one.kind == SNAP), None)
    if leaves is None:
        back = found.path.unload_to
        known = found.path.reached and back is not None
        return f" that is still there at {_load(case, Value(back or 0.0))} on unloading" if known else ""
    assert leaves.to is not None
    then = (
        f", where the rod falls back to {unbuckled(leaves.curved)}"
        if leaves.to.kind == STRAIGHT
        else f", then {_named(leaves)}"
    )
    return f" that stays until {_load(case, leaves.force)} on unloading{then}"


def _load(case: Case, force: Value) -> str:
    """A load without its sign where it is compression, else with it."""
    said = forces_of(case)
    return said.load(force) if said.compression(force).value < 0.0 else said.size(force)


def _named(snap: PathPoint) -> str:
    """The state that a snap leads to."""
    assert snap.to is not None
    count = abs(snap.to.turns)
    turns = f" of {count} turn{'s' if count != 1 else ''}" if count else ""
    names = {
        HELIX: "a helix", STRAIGHT: unbuckled(snap.curved), PARTIAL: "another state of partial contact",
        OTHER_SIDE: f"the shape {OTHER_SIDE}", ON_WALL: f"a shape {ON_WALL}",
    }  # fmt: skip
    return f"{names.get(snap.to.kind, 'a sinusoidal shape on the wall')}{turns}"


def _until(steps: Sequence[Step], snap: PathPoint) -> list[Step]:
    """Steps before a snap, the state just before it included."""
    return [one for one in steps if (one.event.leg == snap.leg and one.event.force.value > snap.force.value)
            or (one.event is snap and one.before)]  # fmt: skip


def _contact(steps: Sequence[Step]) -> str:
    """What a rod keeps that has not snapped: partial contact, unless all contact was lost, or is complete again."""
    known = [one.state.state for one in steps if one.state is not None]
    if known and known[-1].fine.everywhere:
        return "full contact"
    anew = bool(steps) and steps[-1].event.kind == TOUCHES  # without force at first
    lost = bool(known) and not anew and known[-1].contact_total.value <= known[-1].contact_total.error
    return "its side of the hole, off the wall," if lost else "partial contact"


def _largest(case: Case, found: Beyond) -> list[str]:
    """The largest point force and the largest stress over all events, with the load and the place."""
    states = [one.state for one in found.events if one.state is not None]
    out = []
    points = [(point, one) for one in states if (point := one.largest_point_force) is not None]
    if points:
        point, one = max(points, key=lambda pair: pair[0].force.value)
        out.append(
            f"The largest concentrated force on the wall at any event is {size_text(case.scales, point.force)}, at "
            f"{place_text(case, point.s)}, at {_load(case, one.load)} ({one.leg})."
        )
    stressed = [(one.stress, one) for one in states if one.stress is not None]
    if stressed and case.scales is not None:
        _, one = max(stressed, key=lambda pair: pair[0].value)
        out.append(f"The largest von Mises stress at any event is {_stress(case, one)}, at {_load(case, one.load)} "
                   f"({one.leg}, {_kind(one)}).")  # fmt: skip
    return out


def _kind(one: StateBeyond) -> str:
    turns = abs(one.state.turns)
    return f"{one.state.kind} of {turns} turn{'s' if turns != 1 else ''}" if turns else one.state.kind


def _stress(case: Case, one: StateBeyond) -> str:
    """Largest stress and safety factor of a state."""
    assert one.stress is not None
    assert case.scales is not None
    text = quantity(case.scales.system, one.stress, "stress", 3)
    safety = one.stress.safety
    if safety is None:
        return text
    yields = "" if safety.value >= 1.0 else ": it yields, and no elastic state beyond that is real"
    return f"{text}, safety factor {amount(safety, 3)} against yield{yields}"


def _at(case: Case, load: AppliedLoad, found: StateBeyond | str) -> str:
    """The state at a load that acts beyond lift-off, as that load grows from nought."""
    start = f"At {load_text(case, load)}, as the load grows to it,"
    if isinstance(found, str):
        return f"{start} the state of the rod off the wall is not known: {found}."
    gap, point = found.largest_gap, found.largest_point_force
    text = f"{start} the rod is in the state {_kind(found)}"
    text += (
        ""
        if gap is None
        else f", with gaps of up to {size_text(case.scales, gap.times(case.problem.clearance), 'length', 'L')}"
    )
    text += f"; the wall bears {size_text(case.scales, found.state.contact_total)} in all"
    text += "" if point is None else f", at most {size_text(case.scales, point.force)} at one point"
    if found.stress is not None:
        text += f"; largest von Mises stress {_stress(case, found)}"
    return f"{text} ({HOW})."
