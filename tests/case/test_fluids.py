"""Mud, pressures and the end at which the force is given: the field example, and the same force by other routes."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq
from scipy.special import jv

from rodwell import Case, Problem, answer, critical_loads
from rodwell.answers.comparison.beside import rod_of
from rodwell.answers.result.key_numbers import STANDING, critical_length
from rodwell.formulas import FORMULAS
from rodwell.studies.audit.audit import audit

INCH, FOOT, LBF, PPG = 0.0254, 0.3048, 4.4482216152605, 0.45359237 / (231.0 * 0.0254**3)
G = 9.80665
EXAMPLES = Path(__file__).parents[2] / "examples"


def field_case(angle: float, **more: Any) -> Case:
    return Case.from_dict(
        {
            "rod": {"pipe": "5 in 19.5 lb/ft drill pipe", "length": "300 m", "grade": "S-135"},
            "mud": {"density": "10 lb/gal"},
            "hole": {"diameter": "8.5 in", "angle_from_vertical": f"{angle} deg"},
            **more,
        }
    )


@pytest.mark.parametrize(("angle", "load"), [(90, 36705.0), (60, 34158.0), (30, 25954.0)])
def test_field_example(angle: float, load: float) -> None:
    """I = 14.269 in⁴, w = 1.3769 lb/in, and the sinusoidal load of Dawson and Paslay in lbf (formulas.md)."""
    case = field_case(angle)
    assert case.rod is not None
    assert case.scales is not None
    assert case.rod.inertia / INCH**4 == pytest.approx(14.269, abs=5e-4)
    assert case.scales.stiffness == pytest.approx(30e6 * LBF / INCH**2 * case.rod.inertia, rel=1e-12)
    weight = case.problem.weight * case.scales.factor("force_per_length")
    assert weight / (LBF / INCH) == pytest.approx(1.3769, abs=5e-5)
    assert case.problem.clearance * 300.0 / INCH == pytest.approx(1.75, rel=1e-12)
    value = FORMULAS["dawson_paslay"].of(rod_of(case.problem)) * case.scales.factor("force")
    assert value / LBF == pytest.approx(load, abs=0.51)
    assert case.yield_strength == pytest.approx(135e3 * LBF / INCH**2)


def test_buoyed_weight_of_different_fluids() -> None:
    """w_air + ρᵢ g Aᵢ − ρₒ g Aₒ for a plain tube, where the metal is the section."""
    case = Case.from_dict({
        "rod": {"outer_diameter": "5 in", "inner_diameter": "4 in", "material": "titanium", "length": "50 m"},
        "mud": {"inside": "1200 kg/m^3", "outside": "1500 kg/m^3"},
        "hole": {"diameter": "8 in", "angle_from_vertical": "20 deg"},
    })  # fmt: skip
    outer, inner = math.pi / 4.0 * (5 * INCH) ** 2, math.pi / 4.0 * (4 * INCH) ** 2
    weight = G * (4430.0 * (outer - inner) + 1200.0 * inner - 1500.0 * outer)
    assert case.scales is not None
    assert case.problem.weight * case.scales.factor("force_per_length") == pytest.approx(weight, rel=1e-12)
    assert case.problem.poisson == 0.342


def test_tool_joints_displace_mud() -> None:
    """A weight above that of the body is more metal, which displaces more: Archimedes on all of it."""
    case = field_case(45.0, mud={"inside": "0 lb/gal", "outside": "12 lb/gal"})
    metal = 19.5 * LBF / FOOT / (65.5 * PPG * G)
    bore = math.pi / 4.0 * (4.276 * INCH) ** 2
    expected = 19.5 * LBF / FOOT - 12.0 * PPG * G * (metal + bore)
    assert case.scales is not None
    assert case.problem.weight * case.scales.factor("force_per_length") == pytest.approx(expected, rel=1e-12)


def test_only_the_outer_circle_counts_where_the_density_is_not_known() -> None:
    case = Case.read(EXAMPLES / "guidewire.toml")
    weight = 0.04 - 1060.0 * G * math.pi / 4.0 * (0.035 * INCH) ** 2
    assert case.scales is not None
    assert case.problem.weight * case.scales.factor("force_per_length") == pytest.approx(weight, rel=1e-12)
    assert case.scales.stiffness == pytest.approx(1.4e-3, rel=1e-12)


def until(**more: Any) -> float:
    """End force at s = 1 in N that a tube of 100 m gets."""
    case = Case.from_dict({
        "rod": {"outer_diameter": "60 mm", "inner_diameter": "50 mm", "material": "steel", "length": "100 m"},
        **more,
    })  # fmt: skip
    assert case.until is not None
    assert case.scales is not None
    return case.until * case.scales.factor("force")


@given(
    st.integers(-100_000, 100_000), st.integers(0, 90), st.integers(0, 3000), st.integers(0, 2000),
    st.integers(0, 10**8), st.integers(0, 10**8),
)  # fmt: skip
@settings(max_examples=60)
def test_real_force_at_either_end(
    force: int, angle: int, inner_density: int, outer_density: int, pi: int, po: int
) -> None:
    """In the wall of the pipe, the force grows upwards by the weight in air: both ends lead to one problem."""
    sections = {
        "hole": {"diameter": "100 mm", "angle_from_vertical": f"{angle!r} deg"},
        "mud": {"inside": f"{inner_density!r} kg/m^3", "outside": f"{outer_density!r} kg/m^3"},
        "pressure": {"inside": f"{pi!r} Pa", "outside": f"{po!r} Pa"},
    }
    outer, inner = math.pi / 4.0 * 0.06**2, math.pi / 4.0 * 0.05**2
    hanging = 65.5 * PPG * G * (outer - inner) * 100.0 * math.cos(math.radians(angle))
    top = until(**sections, load={"until": f"{force + hanging!r} N", "kind": "real", "at": "top"})
    bottom = until(**sections, load={"until": f"{force!r} N", "kind": "real", "at": "bottom"})
    size = 1e5 + 1e8 * outer
    assert bottom == pytest.approx(top, abs=1e-9 * size)
    assert top == pytest.approx(force + hanging - pi * inner + po * outer, abs=1e-9 * size)


def test_effective_force_at_the_bottom() -> None:
    """N(0) = F − mg L cos α is what was asked for."""
    case = field_case(30.0, load={"until": "-60000 lbf", "at": "bottom"})
    assert case.scales is not None
    assert case.until is not None
    at_bottom = (case.until - case.problem.axial_weight) * case.scales.factor("force")
    assert at_bottom / LBF == pytest.approx(-60000.0, rel=1e-12)
    plain = Case.from_dict(
        {"dimensionless": {"weight": 50.0, "alpha": 60.0}, "load": {"until": -100.0, "at": "bottom"}}
    )
    assert plain.until == pytest.approx(-75.0, rel=1e-12)


def test_horizontal_rods_have_one_force() -> None:
    forces = [field_case(90.0, load={"until": "-40 kN", "at": end}).until for end in ("top", "bottom")]
    assert forces[0] == forces[1]


def test_coiled_tubing_example() -> None:
    """Real −2000 lbf in the wall, 2500 psi inside and 1500 psi outside: effective by hand."""
    case = Case.read(EXAMPLES / "coiled-tubing.toml")
    bore = 2.0 - 2.0 * 0.156
    effective = -2000.0 - 2500.0 * math.pi / 4.0 * bore**2 + 1500.0 * math.pi / 4.0 * 2.0**2
    assert case.scales is not None
    (load,) = case.applied
    assert load.force * case.scales.factor("force") / LBF == pytest.approx(effective, rel=1e-12)
    assert case.scales.system.name == "field"


def test_loads_as_real_forces() -> None:
    """In the wall of the pipe: N + pᵢ Aᵢ − pₒ Aₒ, for the first critical load and the lift-off load."""
    case = Case.from_dict({
        "rod": {"pipe": "2 in x 0.156 in coiled tubing", "length": "40 ft"},
        "pressure": {"inside": "2500 psi", "outside": "1500 psi"},
        "hole": {"diameter": "4 in", "angle_from_vertical": "90 deg"},
        "analysis": {"modes": 1, "rtol": 1e-5},
    })  # fmt: skip
    figures = answer(case).key_numbers
    assert case.scales is not None
    less = (2500.0 * 1.688**2 - 1500.0 * 2.0**2) * math.pi / 4.0 * LBF / case.scales.factor("force")
    for name in ("critical_load_1", "lift_off_load"):
        assert figures[f"{name}_real"].value - figures[name].value == pytest.approx(less, rel=1e-9)
    plain = Case.from_dict({"dimensionless": {"weight": 5.0}, "analysis": {"modes": 1, "rtol": 1e-5}})
    assert not any(name.endswith("_real") for name in answer(plain).key_numbers)


def test_audit_takes_section_and_strength_from_the_catalogue() -> None:
    """Yield load σ_y/(1/A + r D/(4I)) of the buckled pipe."""
    case = field_case(90.0, analysis={"modes": 1, "rtol": 1e-5}, rod={
        "pipe": "5 in 19.5 lb/ft drill pipe", "length": "60 ± 1 m", "grade": "S-135"})  # fmt: skip
    result = audit(case)
    load = next(row for row in result.others if row.formula.key == "coiled_tubing_yield").value
    area, inertia = math.pi / 4.0 * (5.0**2 - 4.276**2), math.pi / 64.0 * (5.0**4 - 4.276**4)
    assert load is not None
    assert load * result.factor((1, 0)) / LBF == pytest.approx(
        135e3 / (1 / area + 1.75 * 5.0 / (4 * inertia)), rel=1e-9
    )


def test_standing_lengths() -> None:
    """Without end force these are the weights that buckle: paper, Bessel zeros, and the loads computed."""
    for ends, weight in STANDING.items():
        force = critical_loads(Problem(weight, alpha=0.0, ends=ends), 1).forces[0]
        slope = 0.25  # at least, of F over γ
        assert abs(force) < 5e-7 / slope
    third = [brentq(lambda x, n=n: jv(n, x), *bracket) for n, bracket in ((1 / 3, (2, 4)), (-1 / 3, (1, 3)))]
    assert np.allclose([2.25 * x**2 for x in third], list(STANDING.values())[1:], rtol=0, atol=6e-7)


def test_climbing_robot() -> None:
    case = Case.read(EXAMPLES / "climbing-robot.toml")
    (length,) = critical_length(case.problem)
    stiffness, weight = 3.6e9 * math.pi / 64.0 * 0.006**4, 1300.0 * G * math.pi / 4.0 * 0.006**2
    assert case.scales is not None
    assert length.value * 3.0 == pytest.approx((74.628569 * stiffness / weight) ** (1 / 3), rel=1e-9)
    assert critical_length(case.problem.but(alpha=1.0)) == []
    assert critical_length(case.problem.but(ends="pinned-pinned")) == []
    assert critical_length(Problem(0.0, alpha=0.0)) == []
