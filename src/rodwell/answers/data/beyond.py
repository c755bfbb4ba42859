"""What happens beyond lift-off as plain data, for JSON, and as a table."""

from __future__ import annotations

import math
from typing import Any

from rodwell.analysis.path.load_path import ASSUMPTIONS
from rodwell.answers.result.beyond import Beyond, StateBeyond
from rodwell.answers.words.beyond import assumed_beyond, beyond_sentences
from rodwell.case.case import Case
from rodwell.quantities.table import Cell, Table
from rodwell.quantities.value import Value


def beyond_dict(case: Case, found: Beyond) -> dict[str, Any]:
    """Events in order with the states there, states at the loads that act; units B = L = 1, SI beside."""
    path = found.path
    return {
        "summary": beyond_sentences(case, found),
        "assumptions": ASSUMPTIONS if path is None else path.assumptions,
        "wall_stiffness": None if math.isinf(case.wall_stiffness) else case.wall_stiffness,
        "computed": path is not None,
        "why": found.why or None,
        "until": None if path is None else path.until,
        "unload_to": None if path is None else path.unload_to,
        "reached": path is not None and path.reached,
        "ended_because": None if path is None else path.ended_because or None,
        "missed": list(found.missed),
        "events": [
            one.event.as_dict()
            | state_dict(case, one.state, one.event.force)
            | {"before": one.before, "meaning": one.meaning}
            for one in found.events
        ],
        "applied": [
            {"given": load.given, "at": "bottom" if load.bottom else "top"}
            | ({"why": one} if isinstance(one, str) else one.state.as_dict() | state_dict(case, one, one.load))
            for load, one in found.applied
        ],
    }


def state_dict(case: Case, one: StateBeyond | None, force: Value) -> dict[str, Any]:
    """What stands beside an event: load in SI, gaps, forces on the wall, stress."""
    out: dict[str, Any] = {} if case.scales is None else {"si": case.scales.si(force, "force")}
    if one is None:
        return out
    shown = ("kind", "turns", "gaps", "contacts", "point_contacts", "contact_total", "shortening")
    state = one.state.as_dict()
    out |= {"state": {name: state[name] for name in shown}}
    if one.stress is not None:
        safety = one.stress.safety
        out["rod_stress"] = {
            "von_Mises_Pa": one.stress.value, "error_Pa": one.stress.error, "s": one.stress.s,
            "axial_Pa": one.stress.axial, "bending_Pa": one.stress.bending, "torsion_Pa": one.stress.torsion,
            "safety_factor": None if safety is None else safety.value,
            "safety_factor_error": None if safety is None else safety.error,
        }  # fmt: skip
    return out


def beyond_table(case: Case, found: Beyond) -> Table:
    """A row for each event: load, what happens, gaps, forces on the wall, stress; SI, or B = L = 1."""
    physical = case.scales is not None
    force, length = ("N", "m") if physical else ("B/L²", "L")
    columns = (
        "leg", f"end force at s = 1, tension positive [{force}]", f"± error [{force}]", "what happens", "state",
        "places s/L", "gaps", f"largest gap [{length}]", f"all forces on the wall [{force}]",
        f"largest point force [{force}]", "at s/L", f"shortening [{length}]", "largest von Mises stress [Pa]",
        "safety factor",
    )  # fmt: skip
    rows: list[tuple[Cell, ...]] = []
    n, m = (1.0, 1.0) if case.scales is None else (case.scales.factor("force"), case.scales.factor("length"))
    for one in found.events:
        event, there = one.event, one.state
        start = (event.leg, event.force.value * n, event.force.error * n, one.meaning)
        places = ", ".join(f"{s:.6g}" for s in event.s) or None
        if there is None:
            rows.append((*start, None, places, *[None] * 8))
            continue
        gap, point = there.largest_gap, there.largest_point_force
        rows.append((
            *start, there.state.kind, places, len(there.state.gaps),
            None if gap is None else gap.value * case.problem.clearance * m, there.state.contact_total.value * n,
            None if point is None else point.force.value * n, None if point is None else point.s.value,
            there.state.shortening.value * m, None if there.stress is None else there.stress.value,
            None if there.stress is None or there.stress.safety is None else there.stress.safety.value,
        ))  # fmt: skip
    assumed = assumed_beyond(case)
    return Table("Load path", columns, tuple(rows), notes=(f"{assumed[:1].upper()}{assumed[1:]}.",))
