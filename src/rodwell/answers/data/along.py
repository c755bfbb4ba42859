"""Everything along the rod in the states of an answer: what figures draw, ``along-rod.csv``, sheets of a workbook."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.state.fields import GRID
from rodwell.answers.result.assessment import Assessment
from rodwell.case.case import Case
from rodwell.problem.words import counted_around
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.table import Cell, Table
from rodwell.strength.loaded import Fields, LoadedRod
from rodwell.strength.stress import Loading, Stresses

LARGEST_SAFETY = 1e6
"""Safety factors are not written larger than this: a place without stress has none."""


NOTES = ("s = 0 is the lower end; tension positive. Elastic states without friction, on the wall.",)


@dataclass(frozen=True)
class Along:
    """One state along the rod: places s/L (m,), fields in units B = L = 1, stresses and yield strengths in Pa.

    These are None where they are not known; strengths where that of any section is not.
    """

    state: LoadedRod
    s: FloatArray
    fields: Fields
    loading: Loading | None
    stresses: Stresses | None
    strength: FloatArray | None = None


def along(a: Assessment, places: int | None = None) -> tuple[Along, ...]:
    """Return every state of an answer along the rod: at buckling, at lift-off, at the applied loads.

    At evenly spaced places: two for each element of the finest mesh, or 201 if these are more.
    """
    if places is None:
        solutions = [state.solution for state in a.states if state.solution is not None]
        places = max([GRID, *(2 * solution.point.fine.space.elements + 1 for solution in solutions)])
    s, out = np.linspace(0.0, 1.0, places), list[Along]()
    if a.case.problem.sections:  # both sides of each step
        steps = a.case.problem.rod.breaks[1:-1]
        s = np.union1d(s, np.concatenate([steps, np.nextafter(steps, 0.0)]))
    for state in a.states:
        f = state.fields(s)
        if a.section is None:
            out.append(Along(state, s, f, None, None))
            continue
        strength = None if a.section.strength is None else a.section.strength_at(f)
        out.append(Along(state, s, f, a.section.loading(f), a.section.stresses(f), strength))
    return tuple(out)


def shown(states: tuple[Along, ...]) -> Along:
    """The state whose stresses are drawn: at the most compressive load that acts; else at lift-off, or at buckling."""
    applied = [one for one in states if one.state.name.startswith("at the applied")]
    if applied:
        return min(applied, key=lambda one: one.state.force)
    return states[min(1, len(states) - 1)]


def along_table(tables: Sequence[Table]) -> Table:
    """One table of every state along the rod, one below the other, from those of :func:`along_tables`."""
    rows = tuple((table.name, *row) for table in tables for row in table.rows)
    return Table("along the rod", ("state", *tables[0].columns), rows, notes=NOTES)


def along_tables(a: Assessment) -> tuple[Table, ...]:
    """A table along the rod for each state, named after it: SI units with dimensions, else B = L = 1."""
    columns = _columns(a)
    return tuple(Table(one.state.name, columns, tuple(_rows(a.case, one)), notes=NOTES) for one in along(a))


def _columns(a: Assessment) -> tuple[str, ...]:
    length, force, per_length, moment = "L", "B/L2", "B/L3", "B/L"
    if a.case.scales is not None:
        length, force, per_length, moment = "m", "N", "N/m", "N m"
    columns = [
        "s/L",
        f"distance from s = 0 along the rod [{length}]",
        f"distance below s = 1 along the rod [{length}]",
        f"sideways y [{length}]",
        f"axial force F1, effective, tension positive [{force}]",
        f"contact force per length on the wall, -p [{per_length}]",
        f"bending moment in the rod [{moment}]",
        f"twisting moment in the rod [{moment}]",
        f"twisting moment in the cylinder T2 [{moment}]"
        if a.case.problem.hole is None
        else "angle around the hole from the {} side, to the {} looking towards s = 0 [rad]".format(
            *counted_around(a.case.problem)
        ),
    ]
    if a.section is not None:
        columns += [
            "real axial force in the wall, tension positive [N]",
            "axial stress [Pa]",
            "bending stress at the outer surface, either sign [Pa]",
            "shear stress of torsion [Pa]",
            "hoop stress, outer surface [Pa]",
            "hoop stress, inner surface [Pa]",
            "largest von Mises stress [Pa]",
        ]
        if a.case.yield_strength is not None:
            columns.append("safety factor against yield")
    return tuple(columns)


def _rows(case: Case, one: Along) -> list[tuple[Cell, ...]]:
    """The numbers of one state, place by place."""
    f, scales = one.fields, case.scales
    length, force, per_length, moment = (
        1.0 if scales is None else scales.factor(name) for name in ("length", "force", "force_per_length", "moment")
    )
    parts = [
        one.s,
        one.s * length,
        (1.0 - one.s) * length,
        f["y"] * length,
        f["rod_F1"] * force,
        -f["contact_pressure"] * per_length,
        np.hypot(f["rod_M2"], f["rod_M3"]) * moment,
        np.abs(f["rod_M1"]) * moment,
        f["T2"] * moment if case.problem.hole is None else f["xi2"],
    ]
    if one.stresses is not None and one.loading is not None:
        t, strength = one.stresses, one.strength
        parts += [one.loading.force, t.axial, t.bending, t.torsion, t.hoop_outer, t.hoop_inner, t.von_mises]
        if strength is not None:
            parts.append(strength / np.maximum(t.von_mises, strength / LARGEST_SAFETY))
    data = np.stack(np.broadcast_arrays(*parts)).T + 0.0  # no −0
    return [tuple(float(x) for x in row) for row in data]
