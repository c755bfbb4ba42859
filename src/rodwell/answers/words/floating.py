"""What it means that a rod floats, or that the end s = 1 is the lower one, in sentences."""

from __future__ import annotations

from rodwell.answers.words.wording import size_text
from rodwell.case.case import Case
from rodwell.quantities.value import Value


def floating(case: Case) -> list[str]:
    """On which side the rod lies, what lifts it, where compression is largest, and what is not told of it."""
    problem = case.problem
    if not problem.floats:
        return []
    lift = size_text(case.scales, Value(problem.weight), "force_per_length", "B/L³")
    text = f"The rod is lighter than what surrounds it: it is lifted by {lift} of its length"
    text += ", and presses on the upper side of the hole." if problem.lateral_weight > 0.0 else "."
    if problem.hung_weight < 0.0:
        text += (
            " Compression is largest at the top, s = 1. Formulas of practice and local limits, which count from the end"
            " that weight loads, are not set beside its loads."
        )
    return [text]
