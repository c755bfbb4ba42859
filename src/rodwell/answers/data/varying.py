"""A case whose clearance varies along its rod as plain data, for JSON, and as a table."""

from __future__ import annotations

from typing import Any

from rodwell.answers.result.varying import Varying
from rodwell.answers.words.varying import varying_sentences
from rodwell.problem.profile import extremes
from rodwell.quantities.table import Table
from rodwell.quantities.value import Peak
from rodwell.strength.loaded import LoadedRod


def _peak(least: Peak) -> dict[str, float]:
    return {**least.as_dict(), "s": least.s}


def _lift_off(found: Varying) -> dict[str, Any] | None:
    lift = found.lift_off
    if lift is None:
        return None
    return {**lift.load.as_dict(), "s": list(lift.s), "axial_contact_error": lift.solution.axial_contact_error}


def _stress(found: Varying, state: LoadedRod | None) -> dict[str, Any] | None:
    """Largest von Mises stress in Pa, where, and the safety factor; None where that is not known."""
    stress = found.stress(state)
    if stress is None:
        return None
    safety = None if stress.safety is None else stress.safety.as_dict()
    return {**_peak(stress), "unit": "Pa", "safety_factor": safety}


def varying_dict(found: Varying) -> dict[str, Any]:
    """Critical loads, lift-off, stress, and contact at the first load and under those that act; units B = L = 1."""
    case = found.case
    return {
        "title": case.title,
        "summary": varying_sentences(found),
        "pieces": [
            {"name": one.name, "from": one.start, "to": one.end, "clearance_m": extremes(one.clearance)[::2]}
            for one in case.pairs
        ],
        "critical_loads": [mode.load.as_dict() for mode in found.critical],
        "axial_contact": found.critical.axial_contact,
        "least_contact": _peak(found.least),
        "lift_off": _lift_off(found),
        "not_followed": found.unfollowed or None,
        "stress": {state.name: _stress(found, state) for state in found.states},
        "applied": [
            {"given": load.given, "at": "bottom" if load.bottom else "top", "force": load.force,
             "buckled": found.buckles(load), "lifted_off": found.lifted(load) if found.lift_off else None,
             "least_contact": _peak(least), "stress": _stress(found, found.under(number))}
            for number, (load, least) in enumerate(found.applied)
        ],
        "converged": not found.missed,
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; places in L, contact force per length in B/L^3",
    }  # fmt: skip


def varying_table(found: Varying) -> Table:
    """A row for each critical load, and for lift-off."""
    columns = ("what", "mode", "end force at s = 1, tension positive [B/L^2]", "error [B/L^2]")
    rows: list[tuple[str, int, float, float]] = [
        ("buckling", mode.number, mode.force, mode.error) for mode in found.critical
    ]
    if found.lift_off is not None:
        rows.append(("lift-off", 1, found.lift_off.force, found.lift_off.error))
    return Table("critical", columns, tuple(rows))
