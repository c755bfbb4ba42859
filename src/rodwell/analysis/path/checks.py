"""Which problems have a load path."""

from __future__ import annotations

from rodwell.errors import InputError
from rodwell.problem.problem import Problem


def checked_problem(problem: Problem) -> None:
    """Raise if a rod has no load path here, with the reason."""
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
