"""Exact loads in the build of each station of a well, and formulas there."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from rodwell.analysis.loads.by_inclination import Loads
from rodwell.analysis.loads.in_bends import loads_in_bends
from rodwell.analysis.loads.long_rod import PipeString, critical_compression
from rodwell.formulas import FORMULAS
from rodwell.quantities.arrays import FloatArray
from rodwell.survey.survey import Survey

TOLERANCE = 1e-3
"""Relative error at best of loads in the hole's build, where they are interpolated."""

COUNTS = 0.01
"""Part of a load by which curvature must change it, by He–Kyllingstad, to count."""


def loads_in_build(string: PipeString, survey: Survey, local: list[float], tell: Callable[[float], None]) -> Loads:
    """Exact critical loads in the build of each station where that counts."""
    straight, bent = (formula_at(string, key, survey, turn=False) for key in ("dawson_paslay", "he_kyllingstad"))
    counts = np.flatnonzero(np.abs(bent - straight) > COUNTS * straight)
    formula, same = FORMULAS["he_kyllingstad"].function, (string.stiffness, string.weight)

    def he_kyllingstad(alpha: float, build: float) -> float:
        return float(formula(*same, alpha, string.clearance, build, 0.0))

    found = loads_in_bends(
        [(local[i], float(survey.build[i])) for i in counts],
        lambda alpha, build: critical_compression(string, alpha, build=build),
        he_kyllingstad,
        TOLERANCE,
        tell,
    )
    values, errors = np.full(len(survey), math.nan), np.full(len(survey), math.nan)
    values[counts], errors[counts] = found.values, found.errors
    reasons = {int(counts[i]): reason for i, reason in found.reasons.items()}
    return Loads(values, errors, reasons, found.solved, found.interpolated, found.tolerance)


def formula_at(string: PipeString, key: str, survey: Survey, *, turn: bool = True) -> FloatArray:
    """Loads of a formula; what it takes is looked up once, not at 100,000 stations."""
    turns = survey.turn if turn else np.zeros(len(survey))
    known = {"alpha": survey.inclination.tolist(), "build": survey.build.tolist(), "turn": turns.tolist()}
    same = {"B": string.stiffness, "w": string.weight, "r": string.clearance}
    function, takes = FORMULAS[key].function, FORMULAS[key].takes
    columns = [known[name] if name in known else [same[name]] * len(survey) for name in takes]
    rows = zip(*columns, strict=True)
    return np.array([float(function(**dict(zip(takes, values, strict=True)))) for values in rows])
