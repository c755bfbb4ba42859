"""Torque and drag of a wire whose core alone bears load: stiffness, stress and stretch are those of the core."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drag_wells import well

from rodwell.studies.drag.drag import drag
from rodwell.studies.drag.strength import strength_of
from rodwell.survey.survey import Survey

CORE = {
    "outer_diameter": "20 mm", "core_diameter": "8 mm", "youngs_modulus": "200 GPa", "weight_per_length": "4 N/m",
    "yield_strength": "1500 MPa",
}  # fmt: skip
SURVEY = Survey.of([0.0, 100.0, 400.0], [0.0, 0.0, 60.0])


def test_a_core_bends_stretches_and_bears_and_its_sleeve_lies_on_the_wall() -> None:
    """E κ d/2 of bending stress and ∫ F/EA of stretch with the core's d and A; the clearance is that of the sleeve."""
    found = drag(well(SURVEY, {"kind": "pull-out"}, pipe=CORE, contact="straight"))
    one = found.operations[0].run
    area, inertia = math.pi / 4.0 * 0.008**2, math.pi / 64.0 * 0.008**4
    assert found.well.string[0].rod.stiffness == pytest.approx(200e9 * inertia, rel=1e-12)
    bears = strength_of(found.well, one)
    assert bears.bending == pytest.approx(200e9 * bears.curvature * 0.004, rel=1e-9)
    assert np.max(bears.curvature) == pytest.approx(math.radians(60.0) / 300.0, rel=1e-6)
    assert bears.true_force == pytest.approx(one.forces, abs=1e-9)
    assert bears.stretch is not None
    expected = float(np.trapezoid(one.forces, -one.measured_depth)) / (200e9 * area)
    assert abs(bears.stretch.value) == pytest.approx(abs(expected), rel=1e-3)
    assert found.well.string[0].rod.outer_diameter == 0.02
