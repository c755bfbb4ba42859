"""In which curved holes states off the wall are computed."""

from __future__ import annotations

from rodwell.errors import InputError
from rodwell.problem.problem import Problem


def in_such_a_hole(problem: Problem) -> bool:
    """Whether states off the wall are computed in a hole like that of a problem."""
    return problem.hole is None or not problem.sections


def refuse_holes(problem: Problem, strings: bool = False) -> None:
    """Raise in a curved hole in which no states off the wall are computed, with the reason.

    ``strings``: those of sections are computed, in the vertical plane.
    """
    if in_such_a_hole(problem):
        return
    if problem.in_space:
        field, value, must = "walk", str(problem.walk), "be 0"
        if problem.axis:
            field, value = "axis", f"{len(problem.axis)} points, or stations of a survey, that leave the vertical plane"
            must = "stay in a vertical plane"
        raise InputError(
            field, value, f"must {must} beside sections: off the wall a string is followed in the vertical plane, till "
            "it buckles out of it; how it lies in this hole, up to where it leaves the wall: rodwell.lying_rod",
        )  # fmt: skip
    if not strings:
        raise InputError(
            "sections", f"{len(problem.sections)} of them", "must be left out in a curved hole: it bends a stiffer "
            "section by a larger moment, so that a string is off the wall beside its steps before it buckles; how it "
            "lies and when it buckles sideways: rodwell.load_path, `rodwell path`",
        )  # fmt: skip
    if problem.tapered:
        raise InputError(
            "sections", f"{len(problem.sections)} of them", "must not taper in a curved hole, off its wall: give them "
            "as several of one stiffness and weight each, or a straight hole",
        )  # fmt: skip
