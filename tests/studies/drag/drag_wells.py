"""Wells and strings for tests of torque and drag."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.well_case import Operation, Well
from rodwell.survey.survey import Survey

PIPE = {
    "outer_diameter": "5 in", "inner_diameter": "4.276 in", "bending_stiffness": "1228241.4795 N m^2",
    "weight_per_length": "241.07826285 N/m",
}  # fmt: skip
WEIGHT, STIFFNESS, RADIUS, CLEARANCE = 241.07826285, 1228241.4795, 0.0635, 0.04445
FRICTION = 0.25


def well_a_survey() -> Survey:
    """Vertical to 1000 m, 3°/30 m to 90° at 1900 m, horizontal to 3400 m."""
    md = [0.0, *np.arange(1000.0, 1901.0, 30.0), 3400.0]
    return Survey.of(md, [0.0, *np.arange(0.0, 91.0, 3.0), 90.0])


def well(survey: Survey, *operations: dict[str, Any], pipe: dict[str, Any] | None = None, **settings: Any) -> Well:
    """A well of one pipe in a hole of 8.5 in with friction 0.25."""
    friction = settings.pop("friction", FRICTION)
    data = {
        "hole": {"diameter": "8.5 in", "friction": friction},
        "string": [pipe or PIPE],
        "well": {"operation": list(operations), **settings},
    }
    return Well.from_dict(data, survey=survey)


def cutter(survey: Survey, **more: Any) -> Cutter:
    """The string of such a well, ready to be cut."""
    return Cutter(well(survey, {"kind": "run-in"}, **more))


def operation(kind: str, survey: Survey, force: float = 0.0, **more: Any) -> Operation:
    """An operation with the bit at the last station."""
    return replace(Operation(kind, kind, float(survey.md[-1]), force), **more)


def horizontal(length: float) -> Survey:
    return Survey.of([0.0, length], [90.0, 90.0])
