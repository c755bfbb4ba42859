"""A case whose clearance has steps as plain data, for JSON, and as a table."""

from __future__ import annotations

from typing import Any

from rodwell.answers.data.beyond import state_dict
from rodwell.answers.result.bridged import Bridged
from rodwell.answers.words.bridged import bridged_sentences
from rodwell.quantities.table import Cell, Table
from rodwell.quantities.value import Value


def bridged_dict(found: Bridged) -> dict[str, Any]:
    """Buckling, the string without compression, and under the loads that act; units B = L = 1, SI beside."""
    case, buckling = found.case, found.buckling
    return {
        "title": case.title,
        "summary": bridged_sentences(found),
        "assumptions": found.path.assumptions,
        "pieces": [
            {"name": one.name, "from": one.start, "to": one.end, "clearance_m": one.clearance} for one in case.pairs
        ],
        "clearance_m": None if case.scales is None else case.problem.clearance * case.scales.length,
        "buckling": None if buckling is None else {
            "force": {"value": buckling[0].force.value, "error": buckling[0].force.error},
            **state_dict(case, buckling[1], buckling[0].force),
        },
        "ended_because": found.path.ended_because or None,
        "without_compression": {"force": found.alone.load.value, **state_dict(case, found.alone, found.alone.load)},
        "applied": [
            {"given": load.given, "at": "bottom" if load.bottom else "top", "force": load.force,
             "share_of_buckling": found.share(load)}
            | ({"why": one} if isinstance(one, str) else state_dict(case, one, one.load))
            for load, one in found.applied
        ],
        "converged": found.converged,
        "missed": list(found.missed),
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; places in L, gaps in the clearance of the longest piece",
    }  # fmt: skip


def contact_table(found: Bridged) -> Table:
    """Contact of the string: a row for each stretch in contact and each point force, in every state that is known."""
    columns = ("state", "end force at s = 1, tension positive [B/L^2]", "contact", "from s/L", "to s/L",
               "contact force [B/L^2]", "error [B/L^2]")  # fmt: skip
    states = [("without compression", found.alone)]
    states += [("under a load that acts", one) for _, one in found.applied if not isinstance(one, str)]
    states += [] if found.buckling is None else [("at buckling", found.buckling[1])]
    rows: list[tuple[Cell, ...]] = []
    for name, one in states:

        def row(
            kind: str, start: Value, end: Value, force: Value, name: str = name, load: float = one.load.value
        ) -> tuple[Cell, ...]:
            return name, load, kind, start.value, end.value, force.value, force.error

        rows += [row("stretch", contact.start, contact.end, contact.force) for contact in one.state.contacts]
        rows += [row(point.kind, point.s, point.s, point.force) for point in one.state.point_forces]
    return Table("contact", columns, tuple(rows))
