"""Torque and drag as tables: one row for each operation, and what is along the string."""

from __future__ import annotations

import math

from rodwell.quantities.table import Cell, Table
from rodwell.quantities.value import Value
from rodwell.studies.drag.calibration import Calibration
from rodwell.studies.drag.contact import NAMES
from rodwell.studies.drag.drag import Drag, OperationResult
from rodwell.studies.drag.road_map import RoadMap
from rodwell.studies.drag.words import assumptions, level_of_one, units


def operations_table(found: Drag) -> Table:
    """One row for each operation; those that fail are marked."""
    by = units(found.well)
    (m, depth), (n, force), (nm, torque), (pa, stress) = (by[k] for k in ("depth", "force", "torque", "stress"))
    columns = (
        "operation", f"bit depth [{depth}]", f"bit force [{force}]", f"hook load [{force}]", f"± error [{force}]",
        f"hook load, helix early [{force}]", f"hook load, helix late [{force}]", f"without buckling [{force}]",
        f"by correlation [{force}]", f"torque at surface [{torque}]", f"± error [{torque}]", f"push left [{force}]",
        f"locks up at bit depth [{depth}]", f"push ends at bit depth [{depth}]", f"largest von Mises stress [{stress}]",
        "part of yield strength", "stress not judged in", f"stretch [{depth}]", "twist [turns]", "verdict",
    )  # fmt: skip
    rows = []
    for one in found.operations:
        s = one.strength
        compared = {name: ends.hook_load for name, ends in one.compared.items()}
        rows.append((
            one.operation.name, one.operation.bit_depth / m, one.operation.bit_force / n,
            *_both(one.ends.hook_load, n), *(_cell(one.bounds[rule].hook_load, n) for rule in ("early", "late")),
            _cell(compared.get("straight"), n), _cell(compared.get("correlation"), n), *_both(one.ends.torque, nm),
            _cell(one.margin, n), _cell(worst_depth(one, "lock_up"), m), _cell(worst_depth(one, "push_ends"), m),
            *((_peak(s.von_mises, pa), _peak(s.used, 1.0), ", ".join(s.not_judged) or None, _cell(s.stretch, m),
               _cell(s.twist, 2.0 * math.pi)) if one.run.arrived else (None,) * 5), level_of_one(one),
        ))  # fmt: skip
    marked = frozenset(i for i, one in enumerate(found.operations) if level_of_one(one) == "fails")
    return Table("Operations", columns, tuple(rows), marked, tuple(assumptions(found)))


def along_table(found: Drag, one: OperationResult) -> Table:
    """What is along the string in one operation, from the bit up."""
    by = units(found.well)
    (m, depth), (n, force), (q, per), (nm, torque), (pa, stress) = by.values()
    columns = (
        f"measured depth [{depth}]", f"effective force [{force}]", f"± error [{force}]", f"true force [{force}]",
        f"contact force [{per}]", f"torque [{torque}]", f"bending stress [{stress}]", f"von Mises stress [{stress}]",
        "state",
    )  # fmt: skip
    s, run = one.strength, one.run
    arrays = (run.measured_depth / m, run.forces / n, one.force_errors / n, s.true_force / n, run.contacts / q,
              run.torques / nm, s.bending / pa, s.von_mises / pa)  # fmt: skip
    rows = tuple(
        (*(_known(float(values[i])) for values in arrays), NAMES[int(run.states[i])]) for i in range(len(run.rows))
    )
    return Table(_sheet(one.operation.name), columns, rows, notes=tuple(assumptions(found)))


def road_map_table(found: RoadMap) -> Table:
    """Hook load and torque at every depth of the bit, a column for each curve."""
    by = units(found.well)
    (m, depth), (n, force), (nm, torque) = by["depth"], by["force"], by["torque"]
    columns, arrays = [f"bit depth [{depth}]"], [found.depths / m]
    for curve in found.curves:
        columns += [f"hook load, {curve.kind}, friction {curve.label} [{force}]", f"± error [{force}]"]
        arrays += [curve.hook_load / n, curve.error / n]
        if any(abs(t) > 0.0 for t in curve.torque if t == t):  # noqa: PLR0124
            columns.append(f"torque, {curve.kind}, friction {curve.label} [{torque}]")
            arrays.append(curve.torque / nm)
        columns.append(f"possible, {curve.kind}, friction {curve.label}")
        arrays.append(curve.possible)
    rows = tuple(
        tuple(("yes" if a[i] else "no") if a.dtype == bool else _known(float(a[i])) for a in arrays)
        for i in range(len(found.depths))
    )
    return Table("Road map", tuple(columns), rows, notes=("Empty: the string locks up.",))


def calibration_table(found: Calibration) -> Table:
    """What was measured, beside what is computed with the friction found."""
    by = units(found.well)
    (m, depth), (n, force), (nm, torque) = by["depth"], by["force"], by["torque"]
    columns = ("line", "operation", f"bit depth [{depth}]", f"hook load, measured [{force}]", f"computed [{force}]",
               f"torque, measured [{torque}]", f"computed [{torque}]")  # fmt: skip
    rows = tuple(
        (one.line, one.operation.kind, one.operation.bit_depth / m, _known(one.hook_load / n),
         _known((one.hook_load - left[0]) / n), _known(one.torque / nm), _known((one.torque - left[1]) / nm))
        for one, left in zip(found.measured, found.residuals, strict=True)
    )  # fmt: skip
    factors = tuple(
        f"{name}: friction factor {value.value:.5g}"
        + (f" ± {value.error:.2g}" if math.isfinite(value.error) else ", on which nothing is measured")
        for name, value in zip(found.names, found.friction, strict=True)
    )
    return Table("Calibration", columns, rows, notes=factors)


def worst_depth(one: OperationResult, name: str) -> Value | None:
    """The lesser of a depth by the two bounds: the worse."""
    depths = [depth for found in one.reach.values() if (depth := getattr(found, name)) is not None]
    return min(depths, key=lambda depth: float(depth.value), default=None)


def _sheet(name: str) -> str:
    return "".join(c for c in name if c.isalnum() or c in " -")[:31] or "operation"


def _known(value: float) -> Cell:
    return value if math.isfinite(value) else None


def _cell(value: Value | None, unit: float) -> Cell:
    return None if value is None else _known(value.value / unit)


def _both(value: Value | None, unit: float) -> tuple[Cell, Cell]:
    return (None, None) if value is None else (_known(value.value / unit), _known(value.error / unit))


def _peak(values, unit: float) -> Cell:  # type: ignore[no-untyped-def]
    known = [float(v) for v in values if math.isfinite(v)]
    return max(known) / unit if known else None
