"""What the cylinder carries: peaks, support torque, stress against strength."""

from __future__ import annotations

import math

import numpy as np
import pytest

import rodwell
from rodwell import Case, InputError, Problem
from rodwell.case.hole.cylinder import Cylinder
from rodwell.quantities.scales import Scales
from rodwell.strength.cylinder import cylinder_stress


def test_odd_modes_need_no_torque_even_ones_do() -> None:
    """Paper, 4.1.2: modes with symmetric T₂ balance themselves, modes with antisymmetric T₂ need a torque."""
    problem = Problem(15.0)
    even, odd = rodwell.follow(problem, 1, until=-130.0)[-1], rodwell.follow(problem, 2, until=-150.0)[-1]
    if even.point.fine.symmetry < 0:
        even, odd = odd, even
    assert even.wall.needs_torque
    assert "must provide a torque" in even.wall.meaning
    assert not odd.wall.needs_torque
    assert "balances itself" in odd.wall.meaning
    assert not rodwell.follow(Problem(0.0), until=-60.0)[-1].wall.needs_torque


def test_peaks_are_the_largest_values() -> None:
    state = rodwell.follow(Problem(40.0, alpha=60.0), until=-180.0)[-1]
    f, wall = state.fields(5001), state.wall
    for name, peak in (("contact_pressure", wall.contact), ("T2", wall.twisting), ("mu", wall.bending_mu)):
        assert peak.value == pytest.approx(np.max(np.abs(f[name])), rel=1e-6)
        assert abs(state.fields(np.array([peak.s]))[name][0]) == pytest.approx(peak.value, rel=1e-6)
    assert wall.torque.value == pytest.approx(f["T2"][0], rel=1e-8)


def test_stress_is_that_of_a_tube_under_bending_and_torsion() -> None:
    state = rodwell.follow(Problem(15.0), until=-130.0)[-1]
    cylinder, scales = Cylinder(0.3, 0.25, 3e8), Scales(20.0, 1e5)
    found = cylinder_stress(state, cylinder, scales)
    f = state.fields(4001)
    radius, inertia = 0.15, math.pi / 4.0 * (0.15**4 - 0.125**4)
    moment = 1e5 / 20.0
    bending = moment * np.hypot(f["mu"], f["lambda"] * np.cos(f["eta"])) * radius / inertia
    shear = moment * f["T2"] * radius / (2.0 * inertia)
    assert found.value == pytest.approx(np.max(np.sqrt(bending**2 + 3.0 * shear**2)), rel=1e-6)
    assert found.utilisation == pytest.approx(found.value / 3e8)


def test_torsion_alone_counts_as_in_von_mises(monkeypatch: pytest.MonkeyPatch) -> None:
    """√3 τ, with τ = T R/J of a tube."""
    from rodwell.strength import cylinder

    def twisted(_problem, _family, _state, s):
        return {"mu": 0.0 * s, "cylinder_M3": 0.0 * s, "T2": np.full_like(s, 0.02)}

    monkeypatch.setattr(cylinder, "fields_at", twisted)
    state = rodwell.follow(Problem(15.0), until=-130.0)[-1]
    found = cylinder_stress(state, Cylinder(0.3, 0.25, 3e8), Scales(20.0, 1e5))
    torque, polar = 0.02 * 1e5 / 20.0, math.pi / 2.0 * (0.15**4 - 0.125**4)
    assert found.value == pytest.approx(math.sqrt(3.0) * torque * 0.15 / polar)


TUBE = {"outer_diameter": "72 cm", "yield_strength": "250 MPa"}
CASE = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
}


def test_case_with_a_cylinder_is_checked_against_its_strength() -> None:
    given = {**CASE, "cylinder": {"outer_diameter": "72 cm", "yield_strength": "250 MPa"}, "analysis": {"modes": 1}}
    answer = rodwell.answer(Case.from_dict(given))
    figure = answer.key_numbers["cylinder_stress"]
    physical = figure.physical(answer.case)
    assert physical is not None
    assert physical[2] == "Pa"
    assert f"{100.0 * physical[0] / 250e6:.3g} % of the yield strength" in figure.note


@pytest.mark.parametrize(
    ("cylinder", "message"),
    [
        ({**TUBE, "outer_diameter": "70 cm"}, "cylinder.outer_diameter = '70 cm': must be above"),
        (
            {**TUBE, "inner_diameter": "60 cm"},
            "contradicts hole.diameter",
        ),
        ({"outer_diameter": "72 cm"}, "cylinder.yield_strength: is missing"),
        ({**TUBE, "yield_strength": "250 m"}, "must be a stress"),
        ({**TUBE, "yeild_strength": "250 MPa"}, "did you mean"),
    ],
)
def test_bad_cylinders_are_refused(cylinder: dict[str, str], message: str) -> None:
    with pytest.raises(InputError, match="cylinder") as found:
        Case.from_dict({**CASE, "cylinder": cylinder})
    assert message in str(found.value)


def test_dimensionless_case_has_no_stress() -> None:
    cylinder = {"outer_diameter": "72 cm", "yield_strength": "250 MPa"}
    with pytest.raises(InputError, match="no stresses"):
        Case.from_dict({"dimensionless": {"weight": 15}, "cylinder": cylinder})
