"""A screened well as table and as plain data, and what it means in sentences."""

from __future__ import annotations

import math

import numpy as np

from rodwell.analysis.loads.long_rod import HALF_WAVES, LIFT_OFF_HALF_WAVES
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.table import Cell, Table
from rodwell.quantities.text import percent, plain
from rodwell.quantities.value import Value
from rodwell.studies.well.in_build import COUNTS
from rodwell.studies.well.screening import BESIDE, CRITICAL_PRECISION, LIFT_OFF_PRECISION, Screening
from rodwell.studies.well.verdict import Found, amount_of, found, place, units, verdict_lines

PER = {"m": 30.0, "ft": 100.0}
"""Build rates are given per so many of the survey's unit of depth."""

NOT_NEGLIGIBLE = 0.01
"""Effect of the local rod's length that is worth a sentence."""


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
        f"exact critical compression in the hole's build [{force}]": screening.bent.values / newton,
        f"± error in the build [{force}]": screening.bent.errors / newton,
    }
    for key, beside in BESIDE.items():
        columns[f"{beside.name} [{force}]"] = screening.formulas[key] / newton
    columns[f"length of the local rod [{depth}]"] = screening.lengths / metre
    if screening.compression is not None and screening.utilisation is not None:
        columns[f"compression of the string [{force}]"] = screening.compression / newton
        columns["utilisation, compression/critical"] = screening.utilisation
    rows: list[tuple[Cell, ...]] = []
    judged = found(screening)
    for i in range(len(survey)):
        cells = [None if math.isnan(values[i]) else float(values[i]) for values in columns.values()]
        rows.append((i + 1, *cells, remarks_of(screening, judged, i)))
    marked = frozenset({screening.weakest if screening.worst is None else screening.worst})
    return Table("Stations", ("station", *columns, "remarks"), tuple(rows), marked, tuple(assumptions(screening)))


def remarks_of(screening: Screening, judged: Found, i: int) -> str:
    """What must be known of a station, what becomes of the string there first."""
    said = ((judged.past, "past buckling"), (judged.close, "at the critical load, within its error"),
            (judged.curved, "compression above He–Kyllingstad: expect buckling"))  # fmt: skip
    return "; ".join([*(text for stations, text in said if stations[i]), *filter(None, [screening.remarks(i)])])


def sentences(screening: Screening) -> list[str]:
    """What was found, the verdict first: the worst of all that is said of buckling leads."""
    at, load, exact, limit = place(screening), amount_of(screening), screening.critical, screening.limit
    out = [line.text for line in verdict_lines(screening)]
    weakest = screening.weakest
    out.append(
        f"Least compression buckles it at {at(weakest)}: "
        f"{load(float(limit[0][weakest]), float(limit[1][weakest]))} there "
        "(exact local load, compression positive)."
    )
    ratio = screening.formulas["dawson_paslay"] / screening.critical.values
    known = [i for i in np.flatnonzero(screening.local > 0.0) if np.isfinite(ratio[i])]
    if known:
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
            "straight hole are too high there; those in the hole's build, and He–Kyllingstad, say by how much."
        )
    missing = sorted({*screening.critical.reasons, *screening.lift_off.reasons})
    if missing:
        out.append(f"{len(missing)} stations lack an exact load; the table says why.")
    return out


def assumptions(screening: Screening) -> list[str]:
    """What the loads are, and what is not in them."""
    first, last = screening.string.ends
    effects = ", ".join(f"{plain(100 * v, 2)} % at {plain(a, 3)}°" for a, v in screening.length_effect.items())
    out = [
        *screening.survey.notes,
        "Compression positive, at the station, which is the lower end of the local rod.",
        f"Local rod: straight hole of the station's inclination, uphill from the station, {HALF_WAVES} half waves "
        f"of the long-rod wave long ({LIFT_OFF_HALF_WAVES} for lift-off), ends {first} (at the station) and {last}.",
        f"Estimated effect of its length on the critical load: {effects}; on the lift-off load about 1 %.",
        "Friction, pressure, joints and turns of the hole are not in the exact loads; He–Kyllingstad has the turns.",
        f"Where the hole's build changes the load by more than {plain(100 * COUNTS)} % by He–Kyllingstad, the exact "
        "load in an arc of that curvature, which goes on uphill over the local rod and turns by 57° at most, decides; "
        "where a build counts less at a station beside the local rod, it counts as there. Lift-off is that of a "
        "straight hole.",
    ]
    if screening.bent.interpolated > 0.0:
        out.append(
            f"Loads in the hole's build from {screening.bent.solved} exact ones; largest difference seen between "
            f"interpolated and exact ones: {plain(100 * screening.bent.interpolated, 2)} %; the error given is twice "
            f"that, {plain(100 * screening.bent.tolerance)} % at least."
        )
    if screening.critical.interpolated > 0.0 or screening.lift_off.interpolated > 0.0:
        out.append(
            f"Loads at {len(screening.survey)} stations from {screening.critical.solved} exact critical loads and "
            f"{screening.lift_off.solved} exact lift-off loads; largest difference seen between interpolated and exact "
            f"ones: {plain(100 * screening.critical.interpolated, 2)} % and "
            f"{plain(100 * screening.lift_off.interpolated, 2)} %; "
            f"errors are given as {plain(100 * CRITICAL_PRECISION.tolerance)} % and "
            f"{plain(100 * LIFT_OFF_PRECISION.tolerance)} % at least."
        )
    if any(value > NOT_NEGLIGIBLE for value in screening.length_effect.values()):
        out.append(
            "Near the vertical the load falls with the length of the rod, ever more slowly, without a foundation."
        )
    return out
