"""What it means that a string leaves the wall by itself, at steps of its clearance or where it floats, in sentences."""

from __future__ import annotations

from collections import Counter

import numpy as np

from rodwell.analysis.off_wall.state import PointForce
from rodwell.answers.result.beyond import StateBeyond
from rodwell.answers.result.bridged import PART_OF_HOLE, THICKER, TOOL_JOINT, Bridged
from rodwell.answers.words.advice import BAD, GOOD, OPEN, Status
from rodwell.answers.words.wording import forces_of, place_text, size_text
from rodwell.case.case import Case
from rodwell.problem.words import floats_in_part, where_it_bridges
from rodwell.quantities.text import amount
from rodwell.quantities.value import Value

LIMITS = (
    "Computed is how the string lies in the vertical plane, {over}, and the load at which it "
    "buckles sideways. Not computed {where}: what becomes of it after it has buckled, "
    "its way back, friction, torque, and formulas of practice beside it.",
    "{what} is taken at its place along the rod; quasi-static, frictionless, hard walls.",
)
"""What is computed, and what is not."""

STEPS, FLOATS = ("over the edges at its steps", "A step"), ("off its lower side where it floats", "A section")
"""What it lies over, and what has its place along the rod."""

MANY_JOINTS = 6
"""From so many equal joints on, the endless string of them is near enough to be named."""

ENDLESS = (
    "Not computed here is the endless string of such joints, to whose buckling load that of long strings comes down: "
    "`rodwell endless --joint CASE.toml` has it, for a case of these joints alone."
)
"""Where to find what many equal joints come to."""


def bridged_sentences(found: Bridged) -> list[str]:
    """The verdict first; then where the string lies, its loads, and what is not computed."""
    under = (_under(found, i) for i in range(len(found.applied)))
    return [verdict(found), *_lies(found), *under, *limits(found)]


def limits(found: Bridged) -> tuple[str, ...]:
    """What is computed, and what is not, of what was given too."""
    case = found.case
    given = ["[supports]"] * (case.supports is not None) + ["[cylinder]"] * (case.cylinder is not None)
    given += ["uncertainties of inputs"] * bool(case.uncertain)
    unused = (f"Given, and not used here: {', '.join(given)}.",) if given else ()
    over, what = FLOATS if floats_in_part(case.problem) else STEPS
    told = (text.format(over=over, what=what, where=where_it_bridges(case.problem)) for text in LIMITS)
    return (*told, *((ENDLESS,) if _most_joints(case) >= MANY_JOINTS else ()), *unused)


def _most_joints(case: Case) -> int:
    """How many equal joints of pipe on tool joints one section of the string has at most."""
    members = () if case.string is None else case.string.members
    jointed = {one.number for one in members if one.tool_joint}
    bodies = Counter(one.number for one in members if one.number in jointed and not one.tool_joint)
    return max(bodies.values(), default=0)


def verdict(found: Bridged) -> str:
    """In one sentence: whether it buckles under the loads that act, and when."""
    said = forces_of(found.case)
    if found.buckling is None:
        why = said.retold(found.path.ended_because) or "no load was found at which it does"
        return f"Whether the string buckles was not found: {why}."
    load = said.load(found.buckling[0].force, other=True)
    if not found.applied:
        return f"The string {_does(found)} and buckles sideways at {load}."
    worst = min(found.applied, key=lambda one: one[0].force)[0]
    share = found.share(worst)
    assert share is not None
    if share >= 1.0:
        return f"The string buckles sideways under the load that acts: at {load}."
    return (
        f"The string {_does(found)} and is stable under the loads that act: it buckles sideways at "
        f"{load}; {100.0 * max(share, 0.0):.0f} % of that is used."
    )


def _does(found: Bridged) -> str:
    """What the string does by itself."""
    if floats_in_part(found.case.problem):
        return "leaves the lower side of the hole where it begins to float,"
    return "bridges the steps of its clearance"


def _sides(found: Bridged) -> list[str]:
    """On which side of the hole the string lies where, without compression, where a part of it floats."""
    if not found.case.problem.rod.mixed:
        return []
    state, scales = found.alone.state, found.case.scales
    places: dict[str, list[str]] = {"lower": [], "upper": []}
    touched = [(one.start, one.end) for one in state.contacts]
    touched += [(one.s, one.s) for one in state.point_forces if one.kind == "point"]
    for start, end in sorted(touched, key=lambda ends: ends[0].value):
        height = state.fields(np.array([0.5 * (start.value + end.value)]))["x"][0]
        text = size_text(scales, start, "length", "L")
        text = f"at {text}" if start is end else f"from {text} to {size_text(scales, end, 'length', 'L')}"
        places["upper" if height > 0.0 else "lower"].append(text)
    said = [f"on the {side} side {' and '.join(those)}" if those else f"nowhere on the {side} side"
            for side, those in places.items()]  # fmt: skip
    return [f"Where nothing is compressed it lies {', and '.join(said)}, from the end s = 0; its ends are held at the "
            "bottom."]  # fmt: skip


def _lies(found: Bridged) -> list[str]:
    """Where it lies without compression, and the edges that it touches: how many, of what, the largest force on one."""
    edges, levered = found.edges, found.levered
    if not edges:
        return _sides(found)
    kinds = Counter(found.edge_of(point.s.value) for point in edges)
    rests = " and ".join(_edges(kind, number) for kind, number in kinds.items())
    free = [point for point in edges if point not in levered]
    largest, rest = max(edges, key=_force), max(free, key=_force, default=None)
    said = f"{'with' if len(edges) == 1 else 'with at most'} {_force_at(found, largest)}"
    if largest in levered:
        said += ". That edge is next to an end that holds the string's slope: the end levers against it, and part of "
        said += "the force is the couple of the end, not weight"
        said += "" if rest is None else f"; on all other edges there are at most {_force_at(found, rest)}"
    return [f"Where nothing is compressed it rests on {rests} {said}.", *_sides(found)]


def _edges(kind: str, number: int) -> str:
    """So many edges of a kind."""
    several = {PART_OF_HOLE: "narrower parts of the hole", TOOL_JOINT: "tool joints", THICKER: "thicker sections"}
    return f"the edge of a {kind}" if number == 1 else f"{number} edges of {several[kind]}"


def _force(point: PointForce) -> float:
    return point.force.value


def _force_at(found: Bridged, point: PointForce) -> str:
    return f"{size_text(found.case.scales, point.force)}, {place_text(found.case, point.s)}"


def _under(found: Bridged, number: int) -> str:
    """What is known under a load that acts."""
    load, there = found.applied[number]
    said = forces_of(found.case)
    at = said.load(Value(load.force))
    if isinstance(there, str):
        return f"Under {at}: {there}."
    return f"Under {at} it lies still, with gaps of up to {_gap(found, there)}{_stress(found, there)}."


def _gap(found: Bridged, there: StateBeyond) -> str:
    gap = there.largest_gap
    assert gap is not None
    return size_text(found.case.scales, gap.times(found.case.problem.clearance), "length", "L")


def _stress(found: Bridged, there: StateBeyond) -> str:
    if there.stress is None or found.case.scales is None:
        return ""
    stress = found.case.scales.system.amount(there.stress, "stress", 4)
    safety = there.stress.safety
    return f" and a von Mises stress of at most {stress}" + (
        "" if safety is None else f", a safety factor of {amount(safety, 3)}"
    )


def bridged_statuses(found: Bridged) -> tuple[Status, ...]:
    """Buckling, strength and the numbers, each in a word with its reason."""
    shares = [share for load, _ in found.applied if (share := found.share(load)) is not None]
    if found.buckling is None:
        why = forces_of(found.case).retold(found.path.ended_because)
        buckling = Status("Buckling", OPEN, "not found", why or "no load was found")
    elif not shares:
        buckling = Status("Buckling", OPEN, "no load given", "load.applied says what acts")
    else:
        bad = max(shares) >= 1.0
        buckling = Status("Buckling", BAD if bad else GOOD, "buckles sideways" if bad else "stable",
                          f"{100.0 * max(shares):.0f} % of the buckling load is used")  # fmt: skip
    factors = [one.stress.safety.value for _, one in found.applied
               if not isinstance(one, str) and one.stress is not None and one.stress.safety is not None]  # fmt: skip
    if not factors or any(isinstance(one, str) for _, one in found.applied):
        rod = Status("Strength", OPEN, "not judged", "no strength is given, or no state known under a load that acts")
    else:
        least = min(factors)
        rod = Status(
            "Strength",
            GOOD if least >= 1.0 else BAD,
            "yields" if least < 1.0 else "bears it",
            f"least safety factor {least:.3g}",
        )
    numbers = Status("Numbers", GOOD if found.converged else BAD, "converged" if found.converged else "NOT CONVERGED",
                     "every load is within its tolerance" if found.converged else "see the errors")  # fmt: skip
    return buckling, rod, numbers
