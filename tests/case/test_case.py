"""Case files: the paper's drill string, units, and scales."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodwell import Case, InputError, Problem
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import readable
from rodwell.quantities.units import to_si

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_drill_string_of_62_has_the_weight_of_63() -> None:
    """γ = (4ρg/E) L³/r² = 16.5."""
    case = Case.read(EXAMPLES / "drill-string.toml")
    exact = 4.0 * 7800.0 * 9.8 / 2e11 * 30.0**3 / 0.05**2
    assert case.problem.weight == pytest.approx(exact, rel=1e-13)
    assert f"{case.problem.weight:.1f}" == "16.5"
    assert case.problem.alpha == 90.0
    assert case.problem.clearance == pytest.approx(0.01, rel=1e-13)
    assert case.scales is not None
    assert case.scales.stiffness == pytest.approx(2e11 * math.pi * 0.05**4 / 4.0, rel=1e-13)


def test_field_units_and_explicit_properties_give_the_same_problem() -> None:
    """5 in × 4.276 in pipe: I = 14.269 in⁴; weight given as a force per length."""
    data = {
        "rod": {
            "length": "100 ft",
            "outer_diameter": "5 in",
            "inner_diameter": "4.276 in",
            "youngs_modulus": "30e6 psi",
            "weight_per_length": "1.3769 lbf/in",
        },
        "hole": {"diameter": "8.5 in", "angle_from_horizontal": "30 deg"},
    }
    case = Case.from_dict(data)
    inertia = math.pi / 64.0 * (5.0**4 - 4.276**4)
    assert inertia == pytest.approx(14.269, abs=5e-4)
    assert case.problem.weight == pytest.approx(1.3769 * 1200.0**3 / (30e6 * inertia), rel=1e-12)
    assert case.problem.clearance == pytest.approx(1.75 / 1200.0, rel=1e-12)
    assert case.problem.alpha == pytest.approx(60.0, rel=1e-12)
    by_stiffness = Case.from_dict(
        {
            "rod": {
                "length": "30.48 m",
                "bending_stiffness": f"{30e6 * inertia * 4.4482216152605 * 0.0254**2!r} N m^2",
                "weight_per_length": f"{1.3769 * 4.4482216152605 / 0.0254!r} N/m",
            },
            "hole": {"clearance": "1.75 in", "angle_from_vertical": "60 deg"},
        }
    )
    assert by_stiffness.problem.weight == pytest.approx(case.problem.weight, rel=1e-9)
    assert by_stiffness.problem.clearance == pytest.approx(case.problem.clearance, rel=1e-12)


def test_guidewire_without_weight() -> None:
    """Millimetres and newtons, no weight: a medical case."""
    case = Case.from_dict(
        {
            "rod": {
                "length": "300 mm",
                "outer_diameter": "0.89 mm",
                "youngs_modulus": "60 GPa",
                "weight_per_length": "0 N/m",
            },
            "hole": {"diameter": "4 mm", "angle_from_vertical": "45 deg"},
            "load": {"until": "-2 N", "twist": "1e-4 N m"},
        }
    )
    assert case.problem.weight == 0.0
    assert case.scales is not None
    assert case.until == pytest.approx(-2.0 / case.scales.factor("force"))
    assert case.problem.twist == pytest.approx(1e-4 / case.scales.factor("moment"))


@given(st.floats(1e-3, 1e4), st.floats(1e-6, 1e8))
def test_scales_are_consistent(length: float, stiffness: float) -> None:
    scales = Scales(length, stiffness)
    assert scales.factor("force_per_length") * length == pytest.approx(scales.factor("force"), rel=1e-12)
    assert scales.factor("force") * length == pytest.approx(scales.factor("moment"), rel=1e-12)
    assert scales.factor("moment") == pytest.approx(stiffness / length, rel=1e-12)
    assert scales.factor("curvature") * stiffness == pytest.approx(scales.factor("moment"), rel=1e-12)


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("30 m", "length", 30.0),
        ("5 cm", "length", 0.05),
        ("8.5 in", "length", 8.5 * 0.0254),
        ("19.5 lbf/ft", "force per length", 19.5 * 4.4482216152605 / 0.3048),
        ("15 deg", "angle", math.radians(15.0)),
        ("-20 klbf", "force", -20e3 * 4.4482216152605),
        ("200 GPa", "stress", 2e11),
        ("10 ppg", "density", 10 * 0.45359237 / 231e-6 * 1e0 / 0.0254**3 * 1e-6),
    ],
)
def test_units(text: str, kind: str, value: float) -> None:
    assert to_si(text, kind) == pytest.approx(value, rel=1e-12)


@given(st.floats(-1e12, 1e12).filter(lambda x: abs(x) > 1e-8 or x == 0.0))
def test_readable_numbers_mean_what_they_say(value: float) -> None:
    number, unit = readable(value, "N", 6).replace("−", "-").split(" ")
    factor = {"GN": 1e9, "MN": 1e6, "kN": 1e3, "N": 1.0, "mN": 1e-3, "µN": 1e-6, "nN": 1e-9}[unit]
    assert float(number) * factor == pytest.approx(value, rel=1e-5)


def test_a_case_without_dimensions_takes_sections_and_a_bent_hole() -> None:
    """As the options of the commands say them: `--sections`, `--build`, `--walk`."""
    base = {"weight": 15.0, "alpha": 60.0}
    case = Case.from_dict({"dimensionless": base | {"sections": "0.6:1:1, 0.4:0.3:0.5"}})
    assert case.problem == Problem(15.0, 60.0, sections=[(0.6, 1.0, 1.0), (0.4, 0.3, 0.5)])
    bent = Case.from_dict({"dimensionless": base | {"build": 0.2, "walk": -0.1}})
    assert bent.problem == Problem(15.0, 60.0, build=0.2, walk=-0.1)
    for wrong, what in (
        ({"sections": "0.6:one"}, r"dimensionless\.sections, section 1 = '0.6:one': must be length:stiffness"),
        ({"sections": "0.6:1,0.6:2"}, r"dimensionless\.sections = '0.6:1,0.6:2': .* must add up to 1, not to 1.2"),
        ({"sections": "0.5:1,0.5:-2"}, r"dimensionless\.section 2, stiffness = -2"),
        ({"sections": [0.5, 0.5]}, r"dimensionless\.sections"),
        ({"build": 200.0}, r"dimensionless\.build = 200.*radius"),
        ({"walk": 0.1, "sections": "0.5:1:1:1,0.5:2:1:0.8"}, r"dimensionless\.sections.*straight holes"),
    ):
        with pytest.raises(InputError, match=what):
            Case.from_dict({"dimensionless": base | wrong})
