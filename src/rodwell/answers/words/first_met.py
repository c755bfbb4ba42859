"""The first load that the straight rod meets, with the wall's help and without, and which arm it may take, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rodwell.answers.words.wording import forces_of
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from rodwell.answers.result.computed import Computed  # slow to import, and a command needs one sentence only

KEPT = (
    "Buckled branches are those of a rod kept on the wall. Nothing keeps this one there: twist makes it leave the wall "
    "before it reaches them."
)
"""What stands beside branches of a twisted rod that nothing presses to the wall."""


def without_wall(computed: Computed) -> str:
    """Both loads where twist counts, or would: with the wall's help and without; empty for a rod without twist."""
    said = forces_of(computed.case)
    if computed.case.problem.twist == 0.0 or computed.without_wall is None:
        return ""
    alone = Value(computed.without_wall.force, computed.without_wall.error)
    if not computed.untouched:
        return (
            "Its weight keeps the straight rod on the wall, where twist does not make it buckle; without the wall's "
            f"help it would buckle at {said.load(alone)}."
        )
    kept = computed.critical[0].load
    return (
        "Nothing presses this rod to the wall, so twist counts: with the wall's help it buckles at "
        f"{said.load(computed.buckling)}, without it at {said.load(alone)}; a rod kept on the wall would at "
        f"{said.load(kept)}. {KEPT}"
    )


def other_arm(computed: Computed) -> str:
    """The other arm of mode 1 where twist makes the two differ, as a sentence that follows that on the first."""
    other = computed.other_arm
    if other is None:
        return ""
    if other.lift_off is None:
        return f" That is the arm that lifts off first; the other was not followed to lift-off ({other.ended_because})."
    text = (
        " Twist makes the two arms of the mode differ, and the rod may take either: this one counts, the other lifts "
        f"off at {forces_of(computed.case).load(other.lift_off.load)}"
    )
    first, second = (branch.special_points[0].index_after for branch in (computed.first, other))
    return text + (", and is stable at first." if first > 0 == second else ".")
