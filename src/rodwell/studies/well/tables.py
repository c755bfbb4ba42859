"""A screened well as table and as plain data, and what it means in sentences."""

from __future__ import annotations

import math

import numpy as np

from rodwell.analysis.loads.long_rod import HALF_WAVES, LIFT_OFF_HALF_WAVES
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.table import Cell, Table
from rodwell.quantities.text import amount, percent
from rodwell.quantities.units import in_unit_of
from rodwell.quantities.value import Value
from rodwell.studies.well.screening import BESIDE, CRITICAL_PRECISION, LIFT_OFF_PRECISION, Screening

FORCE_UNITS = {"m": "kN", "ft": "klbf"}
"""Unit of forces in tables and figures, by the survey's unit of depth."""

PER = {"m": 30.0, "ft": 100.0}
"""Build rates are given per so many of the survey's unit of depth."""

NOT_NEGLIGIBLE = 0.01
"""Effect of the local rod's length that is worth a sentence."""


def units(screening: Screening) -> tuple[str, float, str, float]:
    """Unit of depth and its size in m, unit of force and its size in N."""
    depth = screening.survey.depth_unit
    force = FORCE_UNITS[depth]
    return depth, in_unit_of(1.0, depth, "m"), force, in_unit_of(1.0, force, "N")


def screening_table(screening: Screening) -> Table:
    """One row for each station; the weakest station, and that of largest utilisation, are marked."""
    survey = screening.survey
    depth, metre, force, newton = units(screening)
    rate = PER[depth] * metre
    columns: dict[str, FloatArray] = {
        f"measured depth [{depth}]": survey.md / metre,
        f"vertical depth below the first station [{depth}]": survey.tvd / metre,
        "inclination [deg]": survey.inclination,
        f"build rate [deg/{PER[depth]:g} {depth}]": np.degrees(survey.build) * rate,
        f"turn rate, sin α dφ/ds [deg/{PER[depth]:g} {depth}]": np.degrees(survey.turn) * rate,
        f"exact critical compression [{force}]": screening.critical.values / newton,
        f"± error [{force}]": screening.critical.errors / newton,
        f"exact lift-off compression [{force}]": screening.lift_off.values / newton,
        f"± error of lift-off [{force}]": screening.lift_off.errors / newton,
    }
    for key, name in BESIDE.items():
        columns[f"{name} [{force}]"] = screening.formulas[key] / newton
    columns[f"length of the local rod [{depth}]"] = screening.lengths / metre
    if screening.compression is not None and screening.utilisation is not None:
        columns[f"compression of the string [{force}]"] = screening.compression / newton
        columns["utilisation, compression/critical"] = screening.utilisation
    rows: list[tuple[Cell, ...]] = []
    for i in range(len(survey)):
        cells = [None if math.isnan(values[i]) else float(values[i]) for values in columns.values()]
        rows.append((i + 1, *cells, screening.remarks(i)))
    marked = frozenset({screening.weakest if screening.worst is None else screening.worst})
    return Table("Stations", ("station", *columns, "remarks"), tuple(rows), marked, tuple(assumptions(screening)))


def sentences(screening: Screening) -> list[str]:
    """What was found, the verdict first."""
    depth, metre, force, newton = units(screening)
    survey, out = screening.survey, []

    def at(i: int) -> str:
        return f"{survey.md[i] / metre:.6g} {depth}, {survey.inclination[i]:.3g}° from the vertical"

    def load(value: float, error: float = 0.0) -> str:
        return f"{amount(Value(value / newton, error / newton))} {force}"

    exact = screening.critical

    worst, used = screening.worst, screening.utilisation
    if used is not None and worst is not None and screening.compression is not None:
        past = int(np.sum(used > 1.0))
        above = screening.compression > screening.formulas["he_kyllingstad"]
        bent = int(np.sum(np.logical_and(screening.dropping, above)))
        verdict = "The string buckles" if past else "By the straight-hole loads the string does not buckle"
        out.append(
            f"{verdict}: the largest utilisation is {percent(_used(screening, worst))} at {at(worst)}, where it bears "
            f"{load(screening.compression[worst])} and buckles at {load(exact.values[worst], exact.errors[worst])}."
        )
        if past:
            over = np.nonzero(used > 1.0)[0]
            first, last = int(over[0]), int(over[-1])
            text = f"{past} of {len(survey)} stations are past buckling, from {at(first)} to {at(last)}"
            lifted = int(np.sum(screening.compression > screening.lift_off.values))
            out.append(f"{text}; {lifted} are past lift-off.")
        if bent:
            out.append(
                f"At {bent} stations where the hole's curvature takes the pipe off the low side, the compression is "
                "above He–Kyllingstad, which has the curvature: expect buckling there."
            )
    elif used is not None:
        out.append("The string is in tension at every station: it does not buckle.")
    weakest = screening.weakest
    out.append(
        f"Least compression buckles it at {at(weakest)}: {load(exact.values[weakest], exact.errors[weakest])} there "
        "(exact local load, compression positive)."
    )
    ratio = screening.formulas["dawson_paslay"] / screening.critical.values
    inclined = screening.local > 0.0
    if np.any(inclined):
        known = [i for i in np.flatnonzero(inclined) if np.isfinite(ratio[i])]
        low, high = min(known, key=lambda i: ratio[i]), max(known, key=lambda i: ratio[i])
        least, most = (percent(Value(ratio[i], ratio[i] * exact.errors[i] / exact.values[i])) for i in (low, high))
        out.append(
            f"Dawson–Paslay, which is 0 in a vertical hole, is {least} to {most} of the exact "
            "load at the inclined stations."
        )
    dropping = int(np.sum(screening.dropping))
    if dropping:
        out.append(
            f"At {dropping} stations the hole's curvature takes the pipe off the low side: the loads of a "
            "straight hole are too high there; He–Kyllingstad says by how much, about."
        )
    missing = sorted({*screening.critical.reasons, *screening.lift_off.reasons})
    if missing:
        out.append(f"{len(missing)} stations lack an exact load; the table says why.")
    return out


def _used(screening: Screening, i: int) -> Value:
    """Utilisation at a station; its error is that of the exact load."""
    assert screening.utilisation is not None
    used = float(screening.utilisation[i])
    return Value(used, abs(used) * float(screening.critical.errors[i] / screening.critical.values[i]))


def assumptions(screening: Screening) -> list[str]:
    """What the loads are, and what is not in them."""
    first, last = screening.string.ends
    effects = ", ".join(f"{100 * v:.2g} % at {a:.3g}°" for a, v in screening.length_effect.items())
    out = [
        *screening.survey.notes,
        "Compression positive, at the station, which is the lower end of the local rod.",
        f"Local rod: straight hole of the station's inclination, uphill from the station, {HALF_WAVES} half waves "
        f"of the long-rod wave long ({LIFT_OFF_HALF_WAVES} for lift-off), ends {first} (at the station) and {last}.",
        f"Estimated effect of its length on the critical load: {effects}; on the lift-off load about 1 %.",
        "Friction, pressure, joints and curvature of the hole are not in the exact loads; He–Kyllingstad has "
        "the curvature.",
    ]
    if screening.critical.interpolated > 0.0 or screening.lift_off.interpolated > 0.0:
        out.append(
            f"Loads at {len(screening.survey)} stations from {screening.critical.solved} exact critical loads and "
            f"{screening.lift_off.solved} exact lift-off loads; largest difference seen between interpolated and exact "
            f"ones: {100 * screening.critical.interpolated:.2g} % and {100 * screening.lift_off.interpolated:.2g} %; "
            f"errors are given as {100 * CRITICAL_PRECISION.tolerance:g} % and "
            f"{100 * LIFT_OFF_PRECISION.tolerance:g} % at least."
        )
    if any(value > NOT_NEGLIGIBLE for value in screening.length_effect.values()):
        out.append(
            "Near the vertical the load falls with the length of the rod, ever more slowly, without a foundation."
        )
    return out
