"""A screening as plain data, for JSON."""

from __future__ import annotations

import math
from typing import Any

from rodwell._version import __version__
from rodwell.quantities.arrays import BoolArray, FloatArray
from rodwell.studies.well.screening import Screening
from rodwell.studies.well.tables import assumptions, remarks_of, sentences
from rodwell.studies.well.verdict import LEVELS, found, level_of


def screening_dict(screening: Screening) -> dict[str, Any]:
    """Everything as plain data in SI units (m, N, degrees), for JSON; null where there is no value."""
    survey = screening.survey

    def listed(values: FloatArray | None) -> list[float | None] | None:
        return None if values is None else [None if math.isnan(v) else float(v) for v in values]

    string, judged = screening.string, found(screening)
    return {
        "title": screening.case.title,
        "rodwell_version": __version__,
        "conventions": "SI units, angles in degrees; compression positive, at the station",
        "assumptions": assumptions(screening),
        "verdict": LEVELS[level_of(screening)],
        "summary": sentences(screening),
        "survey": survey.source,
        "ignored_columns": list(survey.ignored),
        "string": {
            "bending_stiffness": string.stiffness,
            "weight_per_length": string.weight,
            "clearance": string.clearance,
            "ends": list(string.ends),
        },
        "measured_depth": listed(survey.md),
        "vertical_depth": listed(survey.tvd),
        "inclination": listed(survey.inclination),
        "azimuth": listed(survey.azimuth),
        "local_rod_length": listed(screening.lengths),
        "critical_compression": listed(screening.critical.values),
        "critical_error": listed(screening.critical.errors),
        "lift_off_compression": listed(screening.lift_off.values),
        "lift_off_error": listed(screening.lift_off.errors),
        "critical_compression_in_build": listed(screening.bent.values),
        "critical_error_in_build": listed(screening.bent.errors),
        "formulas": {key: listed(values) for key, values in screening.formulas.items()},
        "compression": listed(screening.compression),
        "utilisation": listed(screening.utilisation),
        "stations_past_buckling": _numbers(judged.past),
        "stations_within_the_error": _numbers(judged.close),
        "stations_above_he_kyllingstad": _numbers(judged.curved),
        "stations_not_judged": _numbers(judged.unjudged),
        "stations_missing_the_tolerance": sorted(
            {int(i) + 1 for i in (*screening.critical.missed, *screening.lift_off.missed, *screening.bent.missed)}
        ),
        "weakest_station": screening.weakest + 1,
        "worst_station": None if screening.worst is None else screening.worst + 1,
        "length_effect": [{"inclination": a, "relative": v} for a, v in screening.length_effect.items()],
        "remarks": {str(i + 1): text for i in range(len(survey)) if (text := remarks_of(screening, judged, i))},
    }


def _numbers(stations: BoolArray) -> list[int]:
    """Stations, counted from 1."""
    return [i + 1 for i, said in enumerate(stations) if said]
