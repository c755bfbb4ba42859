"""What a problem assumes of ends, sections and hole, in words."""

from __future__ import annotations

from collections.abc import Mapping

from rodwell.problem.problem import Problem


def ends_text(problem: Problem, words: Mapping[str, str] | None = None) -> str:
    """End conditions in words: names, or what ``words`` says of each; how many sections, and whether the rod floats."""
    first, last = (words[end] if words else end for end in problem.ends)
    ends = f"both ends {first}" if first == last else f"end s = 0 {first}, end s = 1 {last}"
    if problem.sections:
        ends += f", string of {len(problem.sections)} sections" if len(problem.sections) > 1 else ", one section"
        ends += ", tapered" if problem.tapered else ""
    return f"{ends}, rod floats: pressed to the upper side" if problem.floats else ends


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
