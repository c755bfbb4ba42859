"""Which problems have a load path."""

from __future__ import annotations

from rodwell.analysis.off_wall.control import CONTROLS, Control
from rodwell.errors import InputError, checked_number
from rodwell.problem.problem import Problem
from rodwell.problem.rod import refuse_sections
from rodwell.quantities.tolerance import checked_force


def checked_problem(problem: Problem) -> None:
    """Raise if a rod has no load path here, with the reason."""
    problem.refuse_curved("load paths off the wall are followed")
    refuse_sections(
        problem.sections,
        "a rod of sections is followed on the wall only: its path off the wall is not computed; ask for its branches "
        "and lift-off, or for the path of a uniform rod",
    )
    if problem.outside:
        raise InputError(
            "outside", True, "a rod outside a cylinder leaves it for good: there is no path beyond lift-off"
        )
    if problem.on_top:
        raise InputError("on_top", True, "nothing presses a rod on top to the wall: its path begins at the bottom")
    if problem.turns:
        raise InputError("turns", problem.turns, "a load path begins with the straight rod: leave turns at 0")
    if problem.lateral_weight == 0.0:
        field, value = ("weight", problem.weight) if problem.weight == 0.0 else ("alpha", problem.alpha)
        raise InputError(
            field,
            value,
            "nothing presses the rod to the wall: until it touches the opposite side any plane of buckling is as good "
            "as another, and no path is followed through such states; give it some lateral weight",
        )
    if "loose" in problem.ends:
        raise InputError("ends", "-".join(problem.ends), "loose ends have no load path yet: take ball or free")


def checked_control(control: str) -> Control:
    """Return what is controlled, or raise."""
    if control not in CONTROLS:
        raise InputError("control", control, f"must be one of {', '.join(CONTROLS)}")
    return CONTROLS[control]


def checked_range(control: Control, until: float, unload_to: float | None) -> tuple[float, float | None]:
    """Return where a path goes and comes back to, or raise: end forces, or shortenings as parts of the length."""
    if control.by_force:
        until = checked_force("until", until)
        unload_to = None if unload_to is None else checked_force("unload_to", unload_to)
        if unload_to is not None and unload_to <= until:
            raise InputError("unload_to", unload_to, f"must be above until, {until:g} B/L²: less compression")
        return until, unload_to
    until = checked_number("until", until, 0.0, 1.0, "above 0 and below 1: a shortening in L")
    if until in (0.0, 1.0):
        raise InputError("until", until, "must be above 0 and below 1: a shortening in L")
    if unload_to is not None:
        unload_to = checked_number("unload_to", unload_to, 0.0, 1.0, "from 0 to 1: a shortening in L")
        if unload_to >= until:
            raise InputError("unload_to", unload_to, f"must be below until, {until:g} L: less shortening")
    return until, unload_to
