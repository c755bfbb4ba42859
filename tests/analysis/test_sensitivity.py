"""Derivatives of loads against finite differences, closed forms and scaling."""

from __future__ import annotations

import json
import math

import pytest
from click.testing import CliRunner

import rodwell
from rodwell import InputError, Problem
from rodwell.analysis.loads.derivatives import PARAMETERS, Sensitivity
from rodwell.analysis.loads.ends import of_lift_off
from rodwell.cli.main import cli

PROBLEMS = {
    "horizontal": Problem(15.0),
    "inclined, twisted": Problem(40.0, alpha=60.0, twist=0.5),
    "pinned, guided": Problem(25.0, alpha=30.0, ends="pinned-guided"),
    "on top": Problem(3.0, alpha=80.0, on_top=True),
    "vertical": Problem(30.0, alpha=0.0),
}


def load(problem: Problem, name: str) -> float:
    if name == "lift-off load":
        found = rodwell.follow(problem, rtol=1e-10).lift_off
        assert found is not None
        return found.force
    return rodwell.critical_loads(problem, 1, rtol=1e-11)[0].force


def difference(problem: Problem, name: str, parameter: str) -> float:
    """Derivative by finite differences of fourth order; one-sided where α ends."""
    x = getattr(problem, parameter)
    h = {"weight": 0.004 * problem.weight, "alpha": 0.2, "clearance": 0.005 * problem.clearance, "twist": 0.02}[
        parameter
    ]
    if parameter == "alpha" and x in (0.0, 90.0):
        h = h if x == 0.0 else -h
        f = [load(problem.but(alpha=x + k * h), name) for k in range(5)]
        return (-25.0 / 12.0 * f[0] + 4.0 * f[1] - 3.0 * f[2] + 4.0 / 3.0 * f[3] - 0.25 * f[4]) / h
    f = {k: load(problem.but(**{parameter: x + k * h}), name) for k in (-2, -1, 1, 2)}
    return (8.0 * (f[1] - f[-1]) - (f[2] - f[-2])) / (12.0 * h)


@pytest.mark.parametrize("name", PROBLEMS)
def test_every_derivative_is_that_of_finite_differences(name: str) -> None:
    problem = PROBLEMS[name]
    found = rodwell.sensitivities(problem)
    assert len(found) == (2 if problem.pressed else 1)
    for sensitivity in found:
        for parameter, (value, _) in sensitivity.derivatives.items():
            expected = difference(problem, sensitivity.name, parameter)
            size = abs(getattr(problem, parameter)) or 1.0
            scale = max(abs(expected), 1e-3 * abs(sensitivity.force) / size)
            assert abs(value - expected) <= 1e-6 * scale, (sensitivity.name, parameter)


def test_twist_counts_for_lift_off_of_a_twisted_rod_only() -> None:
    critical, lift = rodwell.sensitivities(PROBLEMS["inclined, twisted"])
    assert set(critical.derivatives) == set(PARAMETERS)
    assert set(lift.derivatives) == {*PARAMETERS, "twist"}


@pytest.mark.parametrize("weight", [5.0, 15.0, 40.0])
def test_tilting_a_horizontal_rod_moves_the_mean_force(weight: float) -> None:
    """To first order only the force at mid-length counts: dF/dα = −γ/2 per radian, at buckling and at lift-off.

    Where the rod lifts off at two places at once, tilting tells them apart, and the lower one goes first.
    """
    critical, lift = rodwell.sensitivities(Problem(weight))
    expected = -weight * math.pi / 360.0
    assert critical.derivatives["alpha"].value == pytest.approx(expected, rel=1e-9)
    if lift.note:
        assert "several places" in lift.note
        assert lift.derivatives["alpha"].value < expected
    else:
        assert lift.derivatives["alpha"].value == pytest.approx(expected, rel=1e-8)
    assert bool(lift.note) == (weight != 15.0)


def test_horizontal_loads_depend_on_weight_over_clearance() -> None:
    """(77): only a foundation stiffness γ/Δ enters, so the elasticities of the critical load are opposite."""
    e = rodwell.sensitivities(Problem(15.0))[0].elasticities()
    assert e["weight_per_length"].value == pytest.approx(-e["clearance"].value, rel=1e-9)


def test_weightless_column_scales_as_euler() -> None:
    e = rodwell.sensitivities(Problem(0.0))[0].elasticities()
    assert e["stiffness"].value == pytest.approx(1.0, abs=1e-12)
    assert e["length"].value == pytest.approx(-2.0, abs=1e-12)


def test_elasticities_are_those_of_the_physical_load() -> None:
    """F = (B/L²) f(mg L³/B, α, Δ/L), each input moved by a thousandth with the others constant."""
    weight, length, stiffness, clearance = 300.0, 20.0, 1.5e5, 0.15

    def physical(weight: float, length: float, stiffness: float, clearance: float) -> float:
        problem = Problem(weight * length**3 / stiffness, alpha=70.0, clearance=clearance / length)
        return load(problem, "critical") * stiffness / length**2

    inputs = {"weight": weight, "length": length, "stiffness": stiffness, "clearance": clearance}
    here = physical(**inputs)
    problem = Problem(weight * length**3 / stiffness, alpha=70.0, clearance=clearance / length)
    e = rodwell.sensitivities(problem)[0].elasticities()
    for name, key in (("weight", "weight_per_length"), ("length",) * 2, ("stiffness",) * 2, ("clearance",) * 2):
        up, down = (physical(**{**inputs, name: inputs[name] * f}) for f in (1.001, 0.999))
        assert e[key].value == pytest.approx((up - down) / (0.002 * here), rel=1e-5)


def test_bad_input() -> None:
    with pytest.raises(InputError, match="must be a lift-off"):
        of_lift_off(rodwell.follow(Problem(15.0), until=-115.0).special_points[0])
    with pytest.raises(InputError, match="mode"):
        rodwell.sensitivities(Problem(15.0), 0)


def test_command() -> None:
    result = CliRunner().invoke(cli, ["sensitivity", "--weight", "15", "--alpha", "90", "--json"])
    assert result.exit_code == 0, result.output
    loads = json.loads(result.output)["loads"]
    found = {s.name: s for s in rodwell.sensitivities(Problem(15.0))}
    for given in loads:
        expected: Sensitivity = found[given["name"]]
        assert given["derivatives"]["weight"]["value"] == pytest.approx(expected.derivatives["weight"].value, rel=1e-9)
    text = CliRunner().invoke(cli, ["sensitivity", "--weight", "15", "--alpha", "90"]).output
    assert "tension positive" in text
    assert "1 % more clearance" in text
