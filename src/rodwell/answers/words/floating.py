"""What it means that a rod floats, or that the end s = 1 is the lower one, in sentences."""

from __future__ import annotations

from rodwell.answers.words.wording import size_text
from rodwell.case.case import Case
from rodwell.quantities.value import Value

NOT_COMPARED = (
    " Formulas of practice and local limits, which count from the end that weight loads, are not set beside its loads."
)


def floating(case: Case) -> list[str]:
    """On which side a rod that floats lies, which end is the lower one, and what is not told then."""
    problem, out = case.problem, []
    if problem.floats:
        lift = size_text(case.scales, Value(problem.weight), "force_per_length", "B/L³")
        text = f"The rod is lighter than what surrounds it: it is lifted by {lift} of its length"
        out.append(text + (", and presses on the upper side of the hole." if problem.lateral_weight > 0.0 else "."))
    if problem.alpha > 90.0:
        out.append("The end s = 1 is the lower one: the hole climbs towards s = 0, from which places are counted.")
    if problem.hung_weight < 0.0:
        place = "s = 1" if problem.alpha > 90.0 else "the top, s = 1"
        out.append(f"Compression is largest at {place}.{NOT_COMPARED}")
    return out
