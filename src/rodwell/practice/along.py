"""Everything along the rod in the states of an answer: what figures draw, and the table ``along-rod.csv``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.fields import GRID
from rodwell.numerics.spaces import FloatArray
from rodwell.practice.answer import Answer
from rodwell.practice.loaded import Fields, LoadedRod
from rodwell.practice.stress import Loading, Stresses
from rodwell.practice.table import Cell, Table

LARGEST_SAFETY = 1e6
"""Safety factors are not written larger than this: a place without stress has none."""


@dataclass(frozen=True)
class Along:
    """One state along the rod: places s/L (m,), fields in units B = L = 1, and stresses in Pa where they are known."""

    state: LoadedRod
    s: FloatArray
    fields: Fields
    loading: Loading | None
    stresses: Stresses | None


def along(answer: Answer, places: int = GRID) -> tuple[Along, ...]:
    """Return every state of an answer along the rod: at buckling, at lift-off, at the applied loads."""
    s, section, out = np.linspace(0.0, 1.0, places), answer.assessment.section, []
    for state in answer.assessment.states:
        f = state.fields(s)
        loading = None if section is None else section.loading(f)
        out.append(Along(state, s, f, loading, None if section is None else section.stresses(f)))
    return tuple(out)


def shown(answer: Answer, states: tuple[Along, ...]) -> Along:
    """The state whose stresses are drawn: at the most compressive load that acts; else at lift-off, or at buckling."""
    applied = [one for one in states if one.state.name.startswith("at the applied")]
    if applied:
        return min(applied, key=lambda one: one.state.force)
    return states[min(1, len(states) - 1)]


def along_table(answer: Answer) -> Table:
    """Table of every state along the rod: SI units where the case has dimensions, else B = L = 1."""
    scales = answer.case.scales
    length, force, per_length, moment = "L", "B/L2", "B/L3", "B/L"
    size = dict.fromkeys(("length", "force", "force_per_length", "moment"), 1.0)
    if scales is not None:
        length, force, per_length, moment = "m", "N", "N/m", "N m"
        size = {name: scales.factor(name) for name in size}
    columns = [
        "state",
        "s/L",
        f"distance from s = 0 along the rod [{length}]",
        f"distance below s = 1 along the rod [{length}]",
        f"sideways y [{length}]",
        f"axial force F1, effective, tension positive [{force}]",
        f"contact force per length on the wall, -p [{per_length}]",
        f"bending moment in the rod [{moment}]",
        f"twisting moment in the rod [{moment}]",
        f"twisting moment in the cylinder T2 [{moment}]",
    ]
    stressed = answer.assessment.section is not None
    if stressed:
        columns += [
            "real axial force in the wall, tension positive [N]", "axial stress [Pa]",
            "bending stress at the outer surface, either sign [Pa]", "shear stress of torsion [Pa]",
            "hoop stress, outer surface [Pa]", "hoop stress, inner surface [Pa]", "largest von Mises stress [Pa]",
        ]  # fmt: skip
        if answer.case.yield_strength is not None:
            columns.append("safety factor against yield")
    rows: list[tuple[Cell, ...]] = []
    for one in along(answer):
        f = one.fields
        parts = [
            one.s * 1.0, one.s * size["length"], (1.0 - one.s) * size["length"], f["y"] * size["length"],
            f["rod_F1"] * size["force"], -f["contact_pressure"] * size["force_per_length"],
            np.hypot(f["rod_M2"], f["rod_M3"]) * size["moment"], np.abs(f["rod_M1"]) * size["moment"],
            f["T2"] * size["moment"],
        ]  # fmt: skip
        if one.stresses is not None and one.loading is not None:
            t = one.stresses
            parts += [
                one.loading.force, t.axial, t.bending, t.torsion, t.hoop_outer, t.hoop_inner, t.von_mises,
            ]  # fmt: skip
            if answer.case.yield_strength is not None:
                least = answer.case.yield_strength / LARGEST_SAFETY
                parts.append(answer.case.yield_strength / np.maximum(t.von_mises, least))
        data = np.stack(np.broadcast_arrays(*parts)).T
        rows += [(one.state.name, *(float(x) for x in row)) for row in data]
    notes = ("s = 0 is the lower end. States are elastic, without friction, on the wall.",)
    return Table("along the rod", tuple(columns), tuple(rows), notes=notes)
