"""What steps of the bending stiffness mean for a buckled string, in words and as plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rodwell.analysis.state.wall import StepLoad
from rodwell.answers.words.wording import forces_of, place_text, size_text
from rodwell.quantities.text import amount, plain
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.case.case import Case
    from rodwell.problem.rod import Rod

ASSUMED = ("its slope held at steps of its stiffness", "held to the wall at kinks of its stiffness")
IF_HELD = ("its slope is held at steps of its stiffness", "it is held to the wall at kinks of its stiffness")
HOLDS = (
    "up to lift-off, something holds the rod's slope across the wall at steps of the bending stiffness",
    "up to lift-off, something holds the rod to the wall where the bending stiffness begins to fall or ceases to rise",
)
"""What is assumed of a buckled string at steps, and at kinks, of its stiffness: in short, as a condition, at length."""

MOST = 6
"""Steps that are named."""


def held(rod: Rod, words: tuple[str, str] = ASSUMED) -> list[str]:
    """What has to be held of a rod where its stiffness has steps, and kinks, at which a wall would have to pull."""
    return [text for text, met in zip(words, (rod.stepped, rod.kinked), strict=True) if met]


def steps_note(
    steps: tuple[StepLoad, ...], case: Case | None = None, *, bent: bool = False, off: float | None = None
) -> str:
    """What the wall would have to exert at steps of a buckled string, and what it means; nothing without any.

    In the units of ``case``; without one in those with B = L = 1. ``bent``: of one that lies along a curved hole,
    buckled or not, with the length ``off`` in L over which it is off the wall at least, if that is known.
    """
    lifting = [step for step in steps if step.lifts]
    if not lifting:
        return ""
    scales = None if case is None else case.scales
    if bent:
        return _bent_note(lifting, case, off)
    jumps = [step for step in lifting if step.couple.value != 0.0]
    kinks = [step for step in lifting if step.couple.value == 0.0]
    said = []
    if jumps:
        largest = max((step.couple for step in jumps), key=lambda couple: abs(couple.value))
        couple = size_text(scales, Value(abs(largest.value), largest.error), "moment", "B/L")
        said.append(
            f"Where the bending stiffness has a step ({_places(jumps, case)}) the wall would have to hold the buckled "
            f"rod by a couple, of {couple} at most there."
        )
    if kinks:
        largest = min((step.force for step in kinks), key=lambda force: force.value)
        force = size_text(scales, largest.times(-1.0), "force", "B/L²")
        said.append(
            f"Where it has a kink ({_places(kinks, case)}), and falls off or ceases to grow towards s = 1, the wall "
            f"would have to pull it, by {force} at most."
            if jumps else f"Where the bending stiffness has a kink ({_places(kinks, case)}) the wall would have to "
            f"pull the buckled rod, by {force} at most there."
        )  # fmt: skip
    said.append(
        "A wall only pushes: unless something holds the rod's slope across the wall, the rod leaves the wall beside "
        "the step as soon as it buckles, over a short stretch. The lift-off load is that of the stretches between "
        "steps."
        if jumps else "A wall only pushes: unless something holds the rod there, it leaves the wall as soon as it "
        "buckles, over a short stretch. The lift-off load is that of the stretches between."
    )  # fmt: skip
    return " ".join(said)


def _bent_note(lifting: list[StepLoad], case: Case | None, off: float | None) -> str:
    """The same of a string that the hole bends wherever it is stiff."""
    scales = None if case is None else case.scales
    kinks = [step for step in lifting if step.couple.value == 0.0]
    lifting = [step for step in lifting if step.couple.value != 0.0]
    pulled = ""
    if kinks:
        largest = min((step.force for step in kinks), key=lambda force: force.value)
        pulled = (
            f"The hole bends the rod, and where its bending stiffness has a kink ({_places(kinks, case)}) the wall "
            f"would have to pull it before it buckles, by {size_text(scales, largest.times(-1.0), 'force', 'B/L²')} at "
            "most. A wall only pushes: the loads told are those of a rod that is held there."
        )
    if not lifting:
        return pulled
    largest = max((step.couple for step in lifting), key=lambda couple: abs(couple.value))
    couple = size_text(scales, Value(abs(largest.value), largest.error), "moment", "B/L")
    far = "a stretch"
    if off is not None:
        length = f"{plain(off, 2)} L" if scales is None else scales.text(off, "length", 2)
        far = f"about {length} or more"
    return (
        f"The hole bends a stiffer section by a larger moment. Where the bending stiffness has a step "
        f"({_places(lifting, case)}) the wall would have to hold the rod by a couple, of up to {couple}, and a wall "
        f"only pushes: unless something holds the rod's slope across the wall there, the rod is off the wall beside "
        f"the step, over {far}, before it buckles. The loads told are those of a rod that is held there."
        + (f" {pulled}" if pulled else "")
    )


def not_held_aside(load: Value | str | None, case: Case) -> str:
    """The load of a string that nothing holds at its steps in a bend, beside that of the held one; or nothing."""
    if load is None:
        return ""
    return f", {'not known' if isinstance(load, str) else forces_of(case).size(load)} if nothing holds it there"


def _places(steps: list[StepLoad], case: Case | None) -> str:
    places = (Value(step.s) for step in steps[:MOST])
    shown = ", ".join(f"s/L = {amount(place)}" if case is None else place_text(case, place) for place in places)
    return shown + (", …" if len(steps) > MOST else "")


def steps_data(steps: tuple[StepLoad, ...]) -> list[dict[str, Any]]:
    """Steps with what the wall exerts on the rod there: couple about u₁ in B/L, force towards the axis in B/L²."""
    return [
        {
            "s": step.s,
            "couple": step.couple.as_dict(),
            "force": step.force.as_dict(),
            "leaves_wall": step.lifts,
        }
        for step in steps
    ]
