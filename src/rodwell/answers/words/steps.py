"""What steps of the bending stiffness mean for a buckled string, in words and as plain data."""

from __future__ import annotations

from typing import Any

from rodwell.analysis.state.wall import StepLoad


def steps_note(steps: tuple[StepLoad, ...]) -> str:
    """What the wall would have to exert at steps of a buckled string, and what it means; nothing where it is nothing."""
    lifting = [step for step in steps if step.lifts]
    if not lifting:
        return ""
    shown = ", ".join(f"{step.s:.4g}" for step in lifting[:MOST]) + (", …" if len(lifting) > MOST else "")
    largest = max(abs(step.couple.value) for step in lifting)
    return (
        f"Where the bending stiffness has a step (s/L = {shown}) the wall would have to hold the buckled rod by a "
        f"couple, of {largest:.3g} B/L at most. A wall only pushes: unless something there holds the rod's slope across "
        "the wall, the rod leaves the wall beside the step as soon as it buckles, over a short stretch. The lift-off "
        "load is that of the stretches between steps."
    )


MOST = 6
"""Steps that are named."""


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
