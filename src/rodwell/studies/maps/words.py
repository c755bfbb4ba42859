"""What a map is and what came of it, in sentences."""

from __future__ import annotations

from rodwell.quantities.text import error_digit, number_text, plain
from rodwell.studies.maps.cells import CONVERGED, OUTCOMES
from rodwell.studies.maps.plain import counted_jumps, meaning, reasons
from rodwell.studies.maps.result import Map

MOST_REASONS = 4

JUMP_WORDS = {
    "place": "the place jumps at {n}",
    "mode": "the mode changes at {n}",
    "outcome": "what comes of it changes at {n}",
    "lost": "{n} could not be located",
}
"""What jumps, for people."""


def title(result: Map) -> str:
    """What is mapped over what."""
    question = result.question
    sizes = " × ".join(f"{n} {name}" for name, n in zip(question.dims, question.shape, strict=True))
    return f"{question.rods.number.label}, in {unit_text(result.unit)}: {question.size} cells ({sizes})"


def unit_text(unit: str) -> str:
    """A unit as people write it."""
    return unit.replace("^2", "²").replace("^3", "³").replace("^4", "⁴")


def sentences(result: Map) -> list[str]:
    """What came of the cells, least and largest number, where it jumps, and why numbers are missing."""
    out = []
    for name, count in result.counts.items():
        only = name == OUTCOMES[CONVERGED] and count == result.question.size
        out.append(f"{'all' if only else count} {'cells' if count != 1 else 'cell'}: {meaning(name)}")
    for word, (value, at) in zip(("least", "largest"), result.extremes, strict=False):
        where = ", ".join(
            f"{name} = {plain(x, 6)}" if isinstance(x, float) else f"{name} = {x}" for name, x in at.items()
        )
        out.append(f"{word} {number_text(value)} ± {error_digit(value.error)} at {where}")
    found = {kind: n for kind, n in counted_jumps(result).items() if n and kind in JUMP_WORDS}
    if found:
        said = ", ".join(JUMP_WORDS[kind].format(n=n) for kind, n in found.items())
        out.append(f"between neighbours of the grid {said} of its edges")
    for reason, count, _at in reasons(result)[:MOST_REASONS]:
        out.append(f"{count} {'cells' if count != 1 else 'cell'}: {reason}")
    return out
