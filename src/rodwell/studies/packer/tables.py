"""The numbers of tubing in a packer by name, and as a table for CSV and XLSX."""

from __future__ import annotations

from typing import NamedTuple

from rodwell.quantities.known import INCH
from rodwell.quantities.table import Table
from rodwell.quantities.text import minus, plain, supported
from rodwell.quantities.units import SI, System
from rodwell.quantities.value import Value
from rodwell.studies.packer.lengths import KINDS, total
from rodwell.studies.packer.packer import PackerAnswer

CHANGES = {
    "piston": "forces on the end",
    "buckling": "",
    "ballooning": "pressure in and around it",
    "temperature": "",
}
"""What makes each change of length, for the remark."""

CHANGE = "change"
"""Dimension of a change of length: shown in the small unit, so that all of them have one."""

SIGNS = (
    "Lengths are positive where the tubing is longer or its end moves down; forces are tension positive.",
    "The packer's force acts on the end of the tubing: tension holds it down, compression carries it.",
    "Without friction and flow; fluids at rest. Buckled places as the load grows, see the bounds in an inclined hole.",
)


class Row(NamedTuple):
    """A number of the answer: name, label, SI value, dimension, remark."""

    name: str
    label: str
    number: Value
    dimension: str
    note: str = ""


def rows(answer: PackerAnswer) -> list[Row]:
    """Changes of length, movement, forces and stresses, with both histories where they differ."""
    m, other = answer.moved, answer.unloading
    differ = answer.tubing.angle > 0.0 and other.free.value != m.free.value
    out = [Row(kind, kind, m.changes[kind], CHANGE, CHANGES[kind]) for kind in KINDS]
    out.append(Row("change", "all changes", total(m.changes), CHANGE, "free to move"))
    if m.landed_with:
        what, way = ("slack-off", "lowered") if m.landed_with < 0.0 else ("pick-up", "raised")
        out.append(Row("landed", what, m.landed, CHANGE, f"the upper end was {way} by this"))
    out.append(Row("free", "movement if free", m.free, CHANGE))
    if differ:
        out.append(Row("free_unloading", "the same, load falling", other.free, CHANGE, "helical as long as it can be"))
    out.append(Row("movement", "movement", m.movement, CHANGE, _stopped(m.stopped)))
    out.append(Row("packer_force", "packer's force on the end", m.packer, "force", _holds(m.packer.value)))
    if differ:
        out.append(Row("packer_force_unloading", "the same, load falling", other.packer, "force"))
    out.append(Row("real_force", "real force above the packer", m.real, "force"))
    out.append(Row("effective_force", "effective force there", m.effective, "force", answer.state))
    out.append(Row("neutral", "neutral point", m.neutral, "length", "along the hole, above the packer"))
    return out + _stresses(answer)


def shown(row: Row, system: System) -> tuple[str, str]:
    """Number and error as texts, with the digits that the error supports."""
    if row.number.value == 0.0:
        number = system.text(0.0, "length" if row.dimension == CHANGE else row.dimension)
    elif row.dimension == CHANGE and system.name == "field":
        digits = supported(row.number, 6)
        number = minus(f"{plain(row.number.value / INCH, max(digits, 1))} in")
    else:
        number = system.beside_error(row.number, _dimension(row))
    return number, "exact" if row.number.error == 0.0 else _error(row, system)


def _error(row: Row, system: System) -> str:
    if row.dimension == CHANGE and system.name == "field":
        return minus(f"{plain(row.number.error / INCH, 1)} in")
    return system.text(row.number.error, _dimension(row), 1)


def _dimension(row: Row) -> str:
    return "length" if row.dimension == CHANGE else row.dimension


def _stresses(answer: PackerAnswer) -> list[Row]:
    stress, strength = answer.stress, answer.case.yield_strength
    out = []
    for i, place in enumerate(("above the packer", "at the top")):
        name = ("bottom", "top")[i]
        out += [
            Row(f"bending_stress_{name}", f"bending stress {place}", _about(float(stress.bending[i])), "stress"),
            Row(f"von_mises_{name}", f"equivalent stress {place}", _about(float(stress.von_mises[i])), "stress"),
        ]
    if strength is not None:
        factor = strength / max(float(value) for value in stress.von_mises)
        out.append(Row("safety", "yield strength / stress", _about(factor), "1", "of the larger of the two"))
    return out


def _about(number: float) -> Value:
    """A number that is known as the table of states is."""
    return Value(number, 1e-5 * abs(number))


def _stopped(side: str) -> str:
    return {"": "nothing stops it", "up": "stopped on the way up", "down": "stopped on the way down"}[side]


def _holds(force: float) -> str:
    return "none" if force == 0.0 else "holds the tubing down" if force > 0.0 else "carries the tubing"


def packer_table(answer: PackerAnswer) -> Table:
    """All numbers, in the units of the case."""
    assert answer.case.scales is not None
    system = answer.case.scales.system
    cells = tuple((row.label, *_numbers(row, system), row.note) for row in rows(answer))
    return Table("packer", ("what", "value", "± error", "unit", "remark"), cells, notes=SIGNS)


def _numbers(row: Row, system: System) -> tuple[float, float, str]:
    if row.dimension == CHANGE and system.name == "field":
        return row.number.value / INCH, row.number.error / INCH, "in"
    unit, text = system.unit(_dimension(row))
    return row.number.value / unit, row.number.error / unit, "" if text == "1" else text


def packer_dict(answer: PackerAnswer) -> dict[str, object]:
    """Everything as plain data, for JSON: SI units."""
    numbers = {
        row.name: {"value": row.number.value, "error": row.number.error, "unit": SI.unit(_dimension(row))[1]}
        for row in rows(answer)
    }
    return {
        "title": answer.case.title,
        "motion": answer.given.motion,
        **numbers,
        "stopped": answer.moved.stopped or None,
        "state": answer.state,
        "converged": answer.converged,
        "convention": " ".join(SIGNS[:2]),
        "unit": "SI",
    }
