"""What it means that the clearance of a case varies along its rod, in sentences."""

from __future__ import annotations

from rodwell.answers.result.varying import Varying
from rodwell.answers.words.advice import BAD, GOOD, OPEN, Status
from rodwell.answers.words.wording import forces_of, place_text, size_text
from rodwell.quantities.text import plain
from rodwell.quantities.value import Value


def varying_sentences(found: Varying) -> list[str]:
    """The verdict first; then the loads that act, how the rod lies, and what is not computed."""
    return [
        verdict(found),
        *(_under(found, i) for i in range(len(found.applied))),
        _lies(found),
        *varying_limits(found),
    ]


def verdict(found: Varying) -> str:
    """In one sentence: when the rod buckles, and whether it does under the loads that act."""
    load = forces_of(found.case).load(found.critical[0].load, other=True)
    if any(found.buckles(one) for one, _ in found.applied):
        return f"The rod buckles under the load that acts: at {load}."
    stable = "is stable under the loads that act: it " if found.applied else ""
    return f"The rod lies on a wall whose clearance varies, and {stable}buckles at {load}."


def varying_limits(found: Varying) -> tuple[str, ...]:
    """What is left out, and what is not computed."""
    size = plain(found.critical.slope_squared, 2)
    return (
        f"Left out are terms of the order of the square of the wall's slope, {size} of a load.",
        "What the rod does after it has buckled: `rodwell path`. Not computed where the clearance varies: stress, "
        "formulas of practice beside it.",
    )


def _lies(found: Varying) -> str:
    case, least = found.case, found.least
    size = size_text(case.scales, least, "force_per_length", "B/L³")
    return f"Then the wall presses the rod everywhere, least by {size}, {place_text(case, Value(least.s))}."


def _under(found: Varying, number: int) -> str:
    """What is known under a load that acts."""
    load, least = found.applied[number]
    said = forces_of(found.case).load(Value(load.force))
    if found.buckles(load):
        return f"Under {said} the rod has buckled."
    if not found.lies(least):
        place = place_text(found.case, Value(least.s))
        return f"Under {said} the wall would have to pull the rod {place}: it bridges the wall there, not computed."
    return f"Under {said} it lies still, pressed to the wall everywhere."


def varying_statuses(found: Varying) -> tuple[Status, ...]:
    """Buckling and the numbers, each in a word with its reason."""
    if not found.applied:
        buckling = Status("Buckling", OPEN, "no load given", "load.applied says what acts")
    else:
        bad = any(found.buckles(load) for load, _ in found.applied)
        lifted = any(not found.lies(least) for _, least in found.applied)
        why = "see the loads that act" if bad or lifted else "pressed to the wall everywhere"
        buckling = Status("Buckling", BAD if bad else OPEN if lifted else GOOD,
                          "buckles" if bad else "leaves the wall" if lifted else "stable", why)  # fmt: skip
    return buckling, Status("Numbers", GOOD, "converged", "every load is within its tolerance")
