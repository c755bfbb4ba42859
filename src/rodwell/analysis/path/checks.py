"""Which problems have a load path."""

from __future__ import annotations

import math

import numpy as np

from rodwell.analysis.off_wall.control import FORCE, NAMES, Control, shortening
from rodwell.analysis.off_wall.curved.refused import refuse_holes
from rodwell.analysis.straight.lying import lies_between
from rodwell.analysis.straight.ramps import least_contact_on_ramps
from rodwell.errors import InputError, checked_number
from rodwell.problem.clearances import check_lies
from rodwell.problem.ends import OFF_WALL_ENDS
from rodwell.problem.problem import Problem
from rodwell.problem.sections import refuse_sections
from rodwell.problem.words import where_it_bridges
from rodwell.quantities.tolerance import checked_force

SOFTEST, STIFFEST = 1e-6, 1e18
"""Range of stiffnesses in series, in units B = L = 1."""

SOFTEST_WALL, STIFFEST_WALL = 1e3, 1e10
"""Range of the stiffness of a soft wall in B/L⁴.

A rod that has buckled at 4π² presses its wall by about F²Δ/4 per length: a softer one gives way by half the clearance
and more. Stiffer ones are told from a hard one by nothing but the cost.
"""

DEEPEST = 0.5
"""Depth in Δ to which the weight may press the straight rod into the wall."""

MOST_DRIVEN = 1e9
"""Largest shortening, in L, of a driven end behind something soft."""

ALLOWED = f"a stiffness from {SOFTEST:g} to {STIFFEST:g} in units B = L = 1; leave it out for a rigid one"


def checked_problem(problem: Problem) -> None:
    """Raise if a rod has no load path here, with the reason."""
    refuse_holes(problem, strings=True)
    if problem.ramps:
        checked_ramps(problem)
    elif not problem.bridges:
        problem.refuse_bridges("load paths off the wall")  # also of clearances that vary without steps
    if problem.outside:
        raise InputError(
            "outside", True, "a rod outside a cylinder leaves it for good: there is no path beyond lift-off"
        )
    if problem.on_top:
        why = (
            "nothing presses a rod on top to the wall"
            if problem.hole is None
            else "the path of a rod on top is refused"
        )
        raise InputError("on_top", True, f"{why}: its path begins at the bottom")
    if problem.in_space and set(problem.ends) & set(OFF_WALL_ENDS):
        raise InputError(
            "ends", "-".join(problem.ends), "a ball joint or loose end is off the wall from the first in a hole that "
            "leaves the vertical plane, and a path begins there with a rod that lies on it: take clamped, pinned, "
            "guided or free",
        )  # fmt: skip
    if problem.turns:
        raise InputError("turns", problem.turns, "a load path begins with the straight rod: leave turns at 0")
    if problem.lateral_weight == 0.0 and problem.twist:
        raise InputError(
            "twist",
            problem.twist,
            "nothing presses the rod to the wall, and with twist it buckles into a curve in space that may turn as a "
            "whole until the wall stops it: no path is followed through such states; leave twist at 0, or give the "
            "rod some lateral weight",
        )
    if "loose" in problem.ends and problem.lateral_weight == 0.0:
        raise InputError(
            "ends", "-".join(problem.ends), "nothing presses the loose end to the wall, where a path begins: "
            "give the rod some lateral weight, or take ball or free",
        )  # fmt: skip


def checked_ramps(problem: Problem) -> None:
    """Raise if a rod in a hole whose clearance varies smoothly has no load path here, with the reason."""
    check_lies(problem)
    if problem.lateral_weight == 0.0:
        raise InputError(
            "alpha", 90.0 if problem.weight == 0.0 else problem.alpha, "must give the rod lateral weight where the "
            "clearance varies: without it nothing lays it along the wall, where its path begins (weight above 0, alpha "
            "above 0 and below 180)",
        )  # fmt: skip
    for end in problem.ends:
        if end in OFF_WALL_ENDS:
            what = "where the clearance varies, it leaves the wall as soon as it buckles, which is not followed there: "
            raise InputError("ends", "-".join(problem.ends), f"{end}: {what}take clamped, pinned, guided or free")
    rod = problem.rod
    if np.any(rod.stiffness_breaks):
        s = float(rod.breaks[1:-1][rod.stiffness_breaks][0])
        raise InputError(
            "sections, stiffness", f"a step or a kink at s/L = {s:.6g}", "must go over without steps and kinks where "
            "the clearance varies along the rod: load paths off the wall past them are computed in holes of one "
            "clearance, or of steps of it; critical loads are computed here: rodwell.critical_loads",
        )  # fmt: skip
    at_rest = least_contact_on_ramps(problem, 0.0)
    if at_rest.value <= at_rest.error:
        raise InputError(
            "sections, clearance", f"contact force {at_rest.value:.4g} B/L³ at s/L = {at_rest.s:.4g}",
            "must press the rod to the wall everywhere before it is compressed: the string bridges the wall there, "
            "which is computed at steps of the clearance only. Let it vary over a longer part of the rod",
        )  # fmt: skip


def checked_bridging(problem: Problem, control: str, unload_to: float | None, mirror: bool) -> None:
    """Raise if a string that leaves the wall by itself has no load path here, with the reason."""
    where = where_it_bridges(problem)
    refuse_loose(problem, where)
    if problem.lateral_weight == 0.0:
        raise InputError(
            "sections", f"{len(problem.sections)} of them", f"are not computed {where} and no lateral weight lays the "
            "string on the walls: give it some (alpha above 0 and below 180), or one clearance and one sign of weight",
        )  # fmt: skip
    for name, value, none in (("twist", problem.twist, 0.0), ("unload_to", unload_to, None), ("mirror", mirror, False)):
        if value != none:
            raise InputError(
                name, value, f"must be left out {where}: the string is followed in the vertical "
                "plane, where twist would not leave it and from which it comes back as it went, until it buckles",
            )  # fmt: skip
    if control != "force":
        raise InputError("control", control, f"must be force {where}: states beyond buckling, "
                         "for which the difference counts, are not computed there")  # fmt: skip


def refuse_loose(problem: Problem, where: str) -> None:
    """Raise if a rod has a loose end where none is followed."""
    if "loose" in problem.ends:
        raise InputError("ends", "-".join(problem.ends), f"loose ends are not followed {where}: take ball or free")


def checked_wall(problem: Problem, stiffness: float) -> float:
    """Return the stiffness of the wall in B/L⁴, infinite for a hard one, or raise."""
    if stiffness == math.inf:
        return stiffness
    if problem.hole is not None:
        raise InputError("wall_stiffness", stiffness, "must be left out in a curved hole, whose wall is hard here")
    softest = max(SOFTEST_WALL, problem.lateral_weight / (DEEPEST * problem.clearance))
    allowed = (
        f"from {softest:.6g} to {STIFFEST_WALL:g} in B/L⁴ for this rod, or left out: a hard wall (a softer one gives "
        "way to its weight, or as it buckles, by half the clearance and more, and holds it no longer)"
    )
    refuse_sections(
        problem.sections,
        "a soft wall is for uniform rods: leave wall_stiffness out, for a hard wall, or take one section",
    )
    refuse_loose(problem, "behind a soft wall, where ends stand at the clearance")
    if problem.lateral_weight == 0.0 and not problem.isotropic_ends:
        raise InputError(
            "ends", "-".join(problem.ends), "a rod that no weight presses to a soft wall is followed where every plane "
            "is as good as another for it to buckle in: take clamped or ball ends, or leave wall_stiffness out, for a "
            "hard wall",
        )  # fmt: skip
    return checked_number("wall_stiffness", stiffness, softest, STIFFEST_WALL, allowed)


def checked_control(problem: Problem, control: str, axial_stiffness: float | None, spring: float | None) -> Control:
    """Return what is controlled, with what gives way in series, or raise."""
    if control not in NAMES:
        raise InputError("control", control, f"must be one of {', '.join(NAMES)}")
    compliance = 0.0
    for field, value in (("axial_stiffness", axial_stiffness), ("spring", spring)):
        if value is None:
            continue
        if control == "force":
            raise InputError(
                field, value, "a dead load takes no notice of it: it counts where the shortening is controlled "
                "(control = shortening)",
            )  # fmt: skip
        compliance += 1.0 / checked_number(field, value, SOFTEST, STIFFEST, ALLOWED)
    return FORCE if control == "force" else shortening(problem, compliance)


def checked_range(control: Control, until: float, unload_to: float | None) -> tuple[float, float | None]:
    """Return where a path goes and comes back to, or raise: end forces, or shortenings as parts of the length."""
    if control.by_force:
        until = checked_force("until", until)
        unload_to = None if unload_to is None else checked_force("unload_to", unload_to)
        if unload_to is not None and unload_to <= until:
            raise InputError("unload_to", unload_to, f"must be above until, {until:g} B/L²: less compression")
        return until, unload_to
    high = _longest(control)
    allowed = f"above 0 and below {high:g}: a shortening in L"
    until = checked_number("until", until, 0.0, high, allowed)
    if until in (0.0, high):
        raise InputError("until", until, f"must be {allowed}")
    if unload_to is not None:
        unload_to = checked_value(control, "unload_to", unload_to)
        if unload_to >= until:
            raise InputError("unload_to", unload_to, f"must be below until, {until:g} L: less shortening")
    return until, unload_to


def check_in_space(mirror: bool, control: Control, unload_to: float | None) -> None:
    """Raise for what a path in a hole that leaves the vertical plane does not take, with the reason."""
    if mirror:
        raise InputError(
            "mirror", mirror, "must be left out where the hole leaves the vertical plane: the rod does not buckle "
            "to either side of a straight shape",
        )  # fmt: skip
    if control.by_force and unload_to is not None and unload_to > 0.0:
        raise InputError(
            "unload_to", unload_to, "must be at most 0 in a hole that leaves the vertical plane; how the rod lies in "
            "tension: rodwell.lying_rod",
        )  # fmt: skip


def check_tension(problem: Problem, control: Control, **ends: float | None) -> None:
    """Raise if a path in a curved hole goes to where tension has pulled the rod off the wall; ``ends`` by name."""
    highest = lies_between(problem)[1] if problem.hole is not None and control.by_force else None
    for name, force in ends.items():
        if highest is not None and force is not None and force > highest.value:
            raise InputError(
                name, force, f"must be at most {highest.value:.8g} B/L²: under more tension the rod leaves the side of "
                f"the hole that it lies on, at s/L = {highest.s:.4g} first, and what it does then is not computed",
            )  # fmt: skip


def checked_value(control: Control, field: str, value: object) -> float:
    """Return a value of what is controlled that can be asked for, or raise: an end force, or a shortening."""
    if control.by_force:
        return checked_force(field, value)
    high = _longest(control)
    return checked_number(field, value, 0.0, high, f"from 0 to {high:g}: a shortening in L, which is controlled")


def _longest(control: Control) -> float:
    """The largest shortening, in L, that can be asked for."""
    return MOST_DRIVEN if control.compliance else 1.0
