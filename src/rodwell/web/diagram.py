"""The diagram of what was computed as plain data for the page: branches as lines, special points, loads in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.special import LIFT_OFF, SpecialPoint
from rodwell.analysis.discrete.measures import Measured
from rodwell.plots.ordinates import ORDINATES, telling
from rodwell.problem.profile import Ratio
from rodwell.quantities.text import plain as text
from rodwell.report.reports.texts import KINDS
from rodwell.web.explored import NO_PULL, STRAIGHT, Explored


def plain(explored: Explored) -> dict[str, Any]:
    """Return the diagram as plain data: loads as shown, ordinates in units that suit them."""
    factors = explored.factors
    named = [{"name": name, "label": label, "unit": factors[w][1]} for w, (name, label) in ORDINATES.items()]
    chosen = telling(explored.branches, explored.case.scales)
    beyond = _beyond(explored)
    lift, low_high = explored.computed.lift_off_load, explored.range
    return {
        "title": explored.case.title,
        "axis": {"label": explored.forces.axis, "unit": explored.load_unit[1], "end": explored.forces.at_end},
        "convention": explored.forces.convention,
        "ordinates": named,
        "ordinate": ORDINATES[chosen][0],
        "range": low_high,
        "suggested": explored.suggested,
        "buckles": _buckles(explored),
        "lifts_off": None if lift is None else explored.load_data(lift),
        "straight": _straight(explored),
        "branches": [
            *(_branch(explored, branch) for branch in explored.branches),
            *beyond["branches"],
        ],
        "snaps_at": beyond["snaps_at"],
        "sections": _sections(explored),
        "unexplored": list(explored.unexplored),
        "rtol": explored.case.rtol,
    }


def _sections(explored: Explored) -> list[dict[str, str]]:
    """The sections of a string of a case with dimensions from the bottom: what they are in the problem, as ratios."""
    string, names = explored.case.string, dict[str, str]()
    lengths, ratios = dict[str, float](), dict[str, tuple[Ratio, Ratio]]()
    members = [] if string is None else zip(string.members, string.sections, strict=True)
    for member, (length, stiffness, weight, *_) in members:
        lengths[member.key] = lengths.get(member.key, 0.0) + length
        ratios[member.key], names[member.key] = (stiffness, weight), member.name
    return [
        {"name": names[key], "length": text(lengths[key], 4), "stiffness": _ratio(b), "weight": _ratio(w)}
        for key, (b, w) in ratios.items()
    ]


def _ratio(ratio: Ratio) -> str:
    """A ratio in a few digits, of a taper those at its ends."""
    first, last = (ratio[0], ratio[-1]) if isinstance(ratio, tuple) else (ratio, ratio)
    return text(first, 4) if first == last else f"{text(first, 4)} to {text(last, 4)}"


def _beyond(explored: Explored) -> dict[str, Any]:
    """What is known of the rod beyond lift-off: its load path as branches, and where it snaps."""
    if explored.path is None:
        return {"branches": [], "snaps_at": {"text": explored.no_path, "load": None}}
    from rodwell.web.legs import plain_path  # noqa: PLC0415 - the first diagram does not wait for it

    return plain_path(explored, explored.path)


def _buckles(explored: Explored) -> dict[str, Any]:
    """Where the rod buckles; of one that lies in a hole out of the vertical plane and does not, that in words."""
    lying = explored.computed.lying
    if lying is None or lying.buckled is not None:
        return explored.load_data(explored.computed.buckling)
    lowest = explored.load_data(lying.lowest)
    if lying.end is None:
        return {"text": f"not up to {lowest['text']}", "load": None}
    if lying.end.kind == LIFT_OFF:
        return {"text": "not before it lifts off", "load": None}
    return lowest | {"text": f"loses its stability at {lowest['text']}"}


def _straight(explored: Explored) -> dict[str, Any] | None:
    """The straight rod: where it meets its modes; None where none lies in the hole."""
    if explored.computed.lying is not None:
        return None
    met = [explored.load_data(mode.load) | {"mode": mode.number} for mode in explored.computed.critical]
    return {"name": STRAIGHT, "critical": met, "buckles": explored.shown(explored.computed.buckling.value)}


def _branch(explored: Explored, branch: Branch) -> dict[str, Any]:
    """A branch as a line of vertices: its points, with the special points between them."""
    states: list[tuple[float, Mapping[Measured, float], int, SpecialPoint | None]] = []
    numbers = {which: branch.numbers(which) for which in Measured}
    for i, force in enumerate(branch.force):
        at = {which: float(numbers[which][i]) for which in Measured}
        states.append((float(force), at, int(branch.stability_index[i]), None))
        for point in (p for p in branch.special_points if p.after == i and p.kind not in ("critical", "end")):
            here = {which: float(point.solution.number(which).value) for which in Measured}
            states.append((point.force, here, point.index_after, point))
    lines = explored.lines(at for _, at, _, _ in states)
    measured = {which: np.array([at[which] for _, at, _, _ in states]) for which in Measured}
    images = []
    for image in branch.images[1:]:
        turned = image.numbers(measured)
        images.append(explored.lines({w: turned[w][i] for w in Measured} for i in range(len(states))))
    return {
        "name": branch.name,
        "mode": branch.mode.number if branch.mode else None,
        "parent": branch.origin.parent,
        "load": [explored.shown(force) for force, *_ in states],
        "y": lines,
        "images": images,
        "index": [index for _, _, index, _ in states],
        "off": beyond_lift_off(branch, states),
        "special": [_special(explored, branch, point) for point in branch.special_points],
        "ended": branch.ending,
        "reached": branch.reached_end,
        "converged": all(s.accurate for s in branch),
    }


def _special(explored: Explored, branch: Branch, point: SpecialPoint) -> dict[str, Any]:
    return explored.load_data(point.load) | {
        "kind": point.kind,
        "label": KINDS[point.kind],
        "y": explored.ordinates({which: point.solution.number(which).value for which in Measured}),
        "index_before": point.index_before,
        "index_after": point.index_after,
        "s": list(point.s),
        "converged": branch.meets_tolerance(point),
    }


def beyond_lift_off(branch: Branch, states: list[Any]) -> list[bool]:
    """Whether the wall would have to pull beyond each vertex, in the order of travel."""
    first = states[0][1]
    off = branch.lift_off_at_buckling or first[Measured.P_MAX] > NO_PULL * branch.problem.lateral_weight
    out = []
    for *_, point in states:
        if point is not None and point.kind in ("lift_off", "touch_down"):
            off = point.kind == "lift_off"
        out.append(off)
    return out
