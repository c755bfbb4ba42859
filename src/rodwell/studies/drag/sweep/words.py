"""What a parameter study of torque and drag means, in sentences: the worst first."""

from __future__ import annotations

from rodwell.quantities.value import Value
from rodwell.studies.drag.sweep.points import OperationAt, WellPoint
from rodwell.studies.drag.sweep.study import DragStudy
from rodwell.studies.drag.words import AT_DEPTH, BUCKLES, FAILS, depth, force

NO_ROAD_MAP = "A study computes the operations; the road map of the file is left out."


def sentences(study: DragStudy) -> list[str]:
    """What was found, the verdict first."""
    out = [_verdict(study)]
    for number in range(len(study.names)):
        out += _of_operation(study, number)
    open_ = dict.fromkeys(name for point in study.points for one in point.operations for name in one.not_judged)
    if open_:
        out.append(f"No yield strength is given for {', '.join(open_)}: stresses there are not judged.")
    lacking = [point for point in study.points if point.reason]
    if lacking:
        out.append(f"{len(lacking)} of {len(study.points)} points could not be computed; the table says why.")
    if has_road_map(study):
        out.append(NO_ROAD_MAP)
    return out


def has_road_map(study: DragStudy) -> bool:
    """Whether the file asks for a road map."""
    settings = study.given.get("well")
    return isinstance(settings, dict) and "road_map" in settings


def failing(study: DragStudy) -> list[WellPoint]:
    """Points at which an operation fails."""
    return [point for point in study.points if any(one.level == FAILS for one in point.operations)]


def _verdict(study: DragStudy) -> str:
    computed, bad = [point for point in study.points if point.operations], failing(study)
    if bad:
        names = [name for i, name in enumerate(study.names) if any(one.level == FAILS for _, one in study.results(i))]
        return (
            f"At {len(bad)} of {len(computed)} points something is not possible or beyond the yield strength: "
            f"{', '.join(names)}."
        )
    buckled = sum(any(one.level == BUCKLES for one in point.operations) for point in computed)
    where = f"the string buckles at {buckled} of them" if buckled else "the string stays straight on the wall"
    way = AT_DEPTH if study.well.settings.string == "stiff" else ""
    return f"Every operation is possible{way} at every one of {len(computed)} points computed; {where}."


def _of_operation(study: DragStudy, number: int) -> list[str]:
    """How the hook load of an operation varies, where its margin is least, how deep it comes, and where it fails."""
    name, well = study.names[number][:1].upper() + study.names[number][1:], study.well
    out = []
    loads = [(one.hook_load, point) for point, one in study.results(number) if one.hook_load is not None]
    if loads:
        low, high = (pick(loads, key=lambda pair: pair[0].value) for pick in (min, max))
        said = f"{name}: hook load from {force(well, low[0])}"
        if low[1] is not high[1]:
            said += f" ({study.inputs(low[1])}) to {force(well, high[0])} ({study.inputs(high[1])})"
        margins = [(one.margin, point) for point, one in study.results(number) if one.margin is not None]
        if margins and study.pushed:
            least, point = min(margins, key=lambda pair: pair[0].value)
            said += f"; least push left at surface {force(well, least)} ({study.inputs(point)})"
        out.append(said + ".")
    out += _depths(study, number, name)
    bad = [(point, one) for point, one in study.results(number) if one.level == FAILS]
    if bad:
        (point, first), count = bad[0], f"{len(bad)} point{'s' if len(bad) > 1 else ''}"
        out.append(f"{name} fails at {count}; with {study.inputs(point)} it {first.why}.")
    return out


def _depths(study: DragStudy, number: int, name: str) -> list[str]:
    """Least depths of lock-up and of the end of the push."""
    parts = []
    for what, pick in (("locks up", _lock_up), ("needs more push than there is", _push_ends)):
        known = [(at, point) for point, one in study.results(number) if (at := pick(one)) is not None]
        if known:
            at, point = min(known, key=lambda pair: pair[0].value)
            parts.append(f"{what} with the bit at {depth(study.well, at.value, at.error)} ({study.inputs(point)})")
    return [f"{name}, at the earliest, {', and '.join(parts)}."] if parts else []


def _lock_up(one: OperationAt) -> Value | None:
    return one.lock_up


def _push_ends(one: OperationAt) -> Value | None:
    return one.push_ends
