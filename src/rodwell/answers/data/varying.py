"""A case whose clearance varies along its rod as plain data, for JSON, and as a table."""

from __future__ import annotations

from typing import Any

from rodwell.answers.result.varying import Varying
from rodwell.answers.words.varying import varying_sentences
from rodwell.problem.profile import extremes
from rodwell.quantities.table import Table
from rodwell.quantities.value import Peak


def _peak(least: Peak) -> dict[str, float]:
    return {**least.as_dict(), "s": least.s}


def varying_dict(found: Varying) -> dict[str, Any]:
    """Critical loads, and contact at the first and under the loads that act; units B = L = 1."""
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
        "applied": [
            {"given": load.given, "at": "bottom" if load.bottom else "top", "force": load.force,
             "buckled": found.buckles(load), "least_contact": _peak(least)}
            for load, least in found.applied
        ],
        "converged": True,
        "unit": "B/L^2",
        "convention": "end force at s = 1, tension positive; places in L, contact force per length in B/L^3",
    }  # fmt: skip


def varying_table(found: Varying) -> Table:
    """A row for each critical load."""
    columns = ("mode", "end force at s = 1, tension positive [B/L^2]", "error [B/L^2]")
    return Table("critical", columns, tuple((mode.number, mode.force, mode.error) for mode in found.critical))
