"""What a problem assumes of ends, sections and hole, in words."""

from __future__ import annotations

from collections.abc import Mapping

from rodwell.problem.problem import Problem

QUARTERS = 4
"""Sections of equal length that make one smooth change of the clearance."""


def ends_text(problem: Problem, words: Mapping[str, str] | None = None) -> str:
    """End conditions in words: names, or what ``words`` says of each; how many sections, and whether the rod floats."""
    first, last = (words[end] if words else end for end in problem.ends)
    ends = f"both ends {first}" if first == last else f"end s = 0 {first}, end s = 1 {last}"
    if problem.sections:
        count = sections_given(problem)
        ends += f", string of {count} sections" if count > 1 else ", one section"
        ends += ", tapered" if problem.tapered else ""
    return f"{ends}, rod floats: pressed to the upper side" if problem.floats else ends


def sections_given(problem: Problem) -> int:
    """How many sections a string has, a smooth change of the clearance (:func:`rodwell.ramp`) counted as one."""
    sections, i, count = problem.sections, 0, 0
    while i < len(sections):
        quarters = sections[i : i + QUARTERS]
        varying = [isinstance(section[3], tuple) for section in quarters]
        is_ramp = len(quarters) == QUARTERS and all(varying) and len({section[0] for section in quarters}) == 1
        i, count = i + (QUARTERS if is_ramp else 1), count + 1
    return count


def where_it_bridges(problem: Problem) -> str:
    """Where a string leaves the wall by itself: at steps of the clearance, or where it begins to float."""
    if floats_in_part(problem):
        return "where some sections sink and others float"
    return "where the clearance has steps" if problem.bridges else "where a curved hole bends sections"


def floats_in_part(problem: Problem) -> bool:
    """Whether a string leaves the wall because some of its sections float, and for no step of the clearance."""
    return problem.bridges and not problem.rod.clearance_steps.size


def side_of_wall(problem: Problem) -> str:
    """The side of the hole that the rod lies on before it buckles: "low" or "high"."""
    return "high" if problem.on_top != problem.floats else "low"


def counted_around(problem: Problem) -> tuple[str, str]:
    """From which side of the hole ξ₂ counts, and which way, looking towards s = 0: "low", "left", or the others."""
    return ("high", "right") if problem.floats else ("low", "left")


def hole_text(problem: Problem) -> str:
    """Whether the hole is straight or curved, in words."""
    return "straight hole" if problem.hole is None else "curved hole"
