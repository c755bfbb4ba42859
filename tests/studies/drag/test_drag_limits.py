"""What torque and drag say of the string: stretch and twist, limits of buckling, yield strength."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drag_wells import CLEARANCE, PIPE, STIFFNESS, WEIGHT, cutter, horizontal, operation, well

from rodwell.answers.words.advice import OPEN
from rodwell.quantities.value import Value
from rodwell.report.reports.drag import drag_report
from rodwell.studies.drag.drag import drag
from rodwell.studies.drag.laws import STRAIGHT_LAW
from rodwell.studies.drag.limits import limit_compression
from rodwell.studies.drag.plain import drag_dict, number
from rodwell.studies.drag.run import run
from rodwell.studies.drag.well_case import Well
from rodwell.studies.drag.words import force
from rodwell.survey.survey import Survey


def test_an_error_that_is_not_known_is_null_in_json_and_units_are_those_of_the_tables() -> None:
    assert number(Value(2.0, math.inf)) == {"value": 2.0, "error": None}
    made = well(horizontal(100.0), {"kind": "run-in"})
    assert force(made.in_units("mm"), Value(2e3)) == force(made, Value(2e3)) == "2 kN"


def test_stretch_and_twist_of_a_hanging_string() -> None:
    """Vertical: ∫F/EA = wL²/2EA; a torque at the bit twists it by TL/GJ."""
    survey = Survey.of([0.0, 2000.0], [0.0, 0.0])
    found = drag(well(survey, {"kind": "drill", "bit_torque": "3 kN m"})).operations[0]
    outer, inner = 0.127, 4.276 * 0.0254
    area, inertia = math.pi / 4.0 * (outer**2 - inner**2), math.pi / 64.0 * (outer**4 - inner**4)
    modulus = STIFFNESS / inertia
    assert found.strength.stretch is not None
    assert found.strength.stretch.value == pytest.approx(WEIGHT * 2000.0**2 / (2.0 * modulus * area), rel=1e-9)
    assert found.strength.twist is not None
    assert found.strength.twist.value == pytest.approx(3e3 * 2000.0 / (STIFFNESS / 1.3), rel=1e-9)
    top = WEIGHT * 2000.0 / area
    shear = 3e3 * 0.0635 / (2.0 * inertia)
    assert found.strength.von_mises[-1] == pytest.approx(math.sqrt(top**2 + 3.0 * shear**2), rel=1e-6)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_limits_of_buckling_in_a_build_and_in_a_drop(side: float) -> None:
    """P² = β² (B/r)(w sin α ± P/R): compression presses the string down in a build, and takes it up in a drop."""
    radius, beta = 600.0, 2.0
    first, last = (20.0, 80.0) if side > 0.0 else (80.0, 20.0)
    survey = Survey.of([0.0, radius * math.radians(60.0)], [first, last])
    one = run(cutter(survey), operation("pull-out", survey), STRAIGHT_LAW)
    alpha = np.radians(np.interp(one.measured_depth, survey.md, survey.inclination))
    half = 0.5 * side * beta**2 * STIFFNESS / (CLEARANCE * radius)
    exact_limit = half + np.sqrt(half**2 + beta**2 * STIFFNESS / CLEARANCE * WEIGHT * np.sin(alpha))
    assert limit_compression(one, beta) == pytest.approx(exact_limit, rel=1e-9)


def test_sections_without_yield_strength_are_named() -> None:
    """A strong collar below a pipe of which no grade is given: the collar alone is judged, and it is said."""
    collar = {**PIPE, "name": "collar", "length": "30 m", "yield_strength": "750 MPa"}
    data = {"hole": {"diameter": "8.5 in", "friction": 0.0}, "string": [collar, {**PIPE, "name": "pipe"}],
            "well": {"operation": [{"kind": "pull-out", "bit_force": "1500 kN"}]}}  # fmt: skip
    found = drag(Well.from_dict(data, survey=Survey.of([0.0, 1000.0], [0.0, 0.0])))
    assert found.operations[0].strength.not_judged == ("pipe",)
    told = drag_dict(found)
    assert told["operations"][0]["not_judged"] == ["pipe"]
    assert "not judged in pipe" in told["summary"][0]
    assert any("for pipe, so stresses there (up to" in line for line in told["summary"])
    status = drag_report(found).front.statuses[2]
    assert status.level == OPEN
    assert "for pipe" in status.reason


def test_limits_in_a_vertical_hole_are_zero() -> None:
    survey = Survey.of([0.0, 500.0], [0.0, 0.0])
    one = run(cutter(survey), operation("pull-out", survey), STRAIGHT_LAW)
    assert limit_compression(one, 2.0) == pytest.approx(0.0, abs=1e-6)
