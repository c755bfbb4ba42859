"""What steps of the bending stiffness mean for a buckled string, in words and as plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rodwell.analysis.state.wall import StepLoad
from rodwell.answers.words.wording import place_text, size_text
from rodwell.quantities.text import amount
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.case.case import Case

MOST = 6
"""Steps that are named."""


def steps_note(steps: tuple[StepLoad, ...], case: Case | None = None) -> str:
    """What the wall would have to exert at steps of a buckled string, and what it means; nothing without any.

    In the units of ``case``; without one in those with B = L = 1.
    """
    lifting = [step for step in steps if step.lifts]
    if not lifting:
        return ""
    places = (Value(step.s) for step in lifting[:MOST])
    shown = ", ".join(f"s/L = {amount(place)}" if case is None else place_text(case, place) for place in places)
    shown += ", …" if len(lifting) > MOST else ""
    largest = max((step.couple for step in lifting), key=lambda couple: abs(couple.value))
    scales = None if case is None else case.scales
    couple = size_text(scales, Value(abs(largest.value), largest.error), "moment", "B/L")
    return (
        f"Where the bending stiffness has a step ({shown}) the wall would have to hold the buckled rod by a couple, of "
        f"{couple} at most there. A wall only pushes: unless something holds the rod's slope across the wall, the rod "
        "leaves the wall beside the step as soon as it buckles, over a short stretch. The lift-off load is that of the "
        "stretches between steps."
    )


def steps_data(steps: tuple[StepLoad, ...]) -> list[dict[str, Any]]:
    """Steps with what the wall exerts on the rod there: couple about u₁ in B/L, force towards the axis in B/L²."""
    return [
        {
            "s": step.s,
            "couple": {"value": step.couple.value, "error": step.couple.error},
            "force": {"value": step.force.value, "error": step.force.error},
            "leaves_wall": step.lifts,
        }
        for step in steps
    ]
