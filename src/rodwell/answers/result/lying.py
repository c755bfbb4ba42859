"""The rod of a case along a curved hole: where it leaves the wall by itself; out of the vertical plane how it lies."""

from __future__ import annotations

from collections.abc import Callable

from rodwell.analysis.branch.special import LIFT_OFF, SpecialPoint
from rodwell.analysis.loads.lying_rod import LyingRod, lying_rod
from rodwell.analysis.off_wall.curved.refused import in_such_a_hole
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.analysis.straight.lying import lies_between
from rodwell.answers.result.key_number import KeyNumber, force_scale
from rodwell.case.case import Case
from rodwell.errors import InputError
from rodwell.problem.problem import Problem
from rodwell.problem.words import side_of_wall
from rodwell.quantities.value import Peak


def check_lying(case: Case) -> None:
    """Raise where the wall would have to pull the rod at every end force: none lies on this side of the hole."""
    low, high = (None, None) if case.problem.hole is None else lies_between(case.problem)
    if low is None or high is None or low.value < high.value:
        return
    section = "hole" if "hole" in case.given else "dimensionless"
    given = case.given.get(section, {})
    key = next((name for name in ("survey", "centerline", "build") if name in given), "build")
    side = side_of_wall(case.problem)
    raise InputError(
        f"{section}.{key}",
        given.get(key),
        f"bends the hole so that a rod lies on its {side} side at no end force: below {high.value:.6g} B/L² it leaves "
        f"the wall at s/L = {low.s:.4g}, above at s/L = {high.s:.4g}; take a shorter piece of the hole, or give the "
        "rod its weight",
    )


def lift_off_of(end: SpecialPoint | None) -> Peak | None:
    """Where a rod leaves the wall, if it does at the end of a branch: end force and place; or None."""
    return None if end is None or end.kind != LIFT_OFF else Peak(end.force, end.error, end.s[0])


def left_before(problem: Problem, critical: CriticalLoads) -> Peak | None:
    """The end force at which the rod leaves the wall of a curved hole before it buckles, with the place; or None."""
    low = None if problem.hole is None else lies_between(problem)[0]
    return None if low is None or low.value < critical[0].force else low


def lying_along(case: Case, progress: Callable[[str, float], None] | None = None) -> LyingRod:
    """Follow the rod as it lies, at least to the loads that act and to the one asked for.

    Raises
    ------
    InputError
        If the rod lies on this side of the hole at no end force that was tried.
    NotConvergedError
        If no state at rest is found.
    """
    tell = progress or (lambda _what, _done: None)
    tell("how the rod lies", 0.0)
    loads = [load.force for load in case.applied] + ([] if case.until is None else [case.until])

    def report(force: float) -> None:
        tell(f"how the rod lies at F = {force:.4g} B/L²", 0.5)

    try:
        found = lying_rod(case.problem, loads, rtol=case.rtol, progress=report)
    except InputError as error:
        given = case.given.get("hole", {})
        key = next((name for name in ("survey", "centerline", "walk") if name in given), None)
        if key is None or error.field not in ("axis", "walk"):
            raise
        raise InputError(f"hole.{key}", given[key], error.reason) from None
    tell("done", 1.0)
    return found


def lying_numbers(lying: LyingRod) -> list[KeyNumber]:
    """Where the rod, as it lies, ceases to be stable, and the angles at which it lies."""
    end, out = lying.end, []
    scale = force_scale(lying.lowest.value) + abs(lying.problem.hung_weight)
    if lying.buckled is not None:
        label = "Load at which the rod, as it lies, buckles, end force at s = 1"
        out.append(
            KeyNumber("buckling_load", label, lying.lowest, "force", scale, "hole and ends alike from both ends")
        )
    elif end is not None and end.index_after > 0:
        label = "Load at which the rod, as it lies, loses its stability, end force at s = 1"
        out.append(KeyNumber("stability_lost", label, lying.lowest, "force", scale))
    tension = lying.end_in_tension
    if tension is not None and tension.index_after > 0:
        label = "Above this the rod, as it lies, loses its stability, end force at s = 1"
        out.append(KeyNumber("stability_lost_in_tension", label, tension.load, "force", scale))
    return out


def followed_from(problem: Problem, force: float) -> bool:
    """Whether a load path follows a rod that leaves the wall of its hole before it buckles, at this end force.

    Or, where the hole leaves the vertical plane, one that loses its stability there.
    """
    pushed = force < 0.0 and not problem.on_top and in_such_a_hole(problem)
    return pushed and (problem.in_space or problem.twist == 0.0)
