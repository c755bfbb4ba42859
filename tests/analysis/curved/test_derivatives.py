"""Derivatives of loads in curved holes by each section's data and out of the vertical plane, against a second way.

Those are differences of loads that are computed anew, extrapolated to no step; and Euler's theorem: all loads in a hole
that stays as it is are homogeneous of degree one in the stiffnesses, the weights and the torque.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from rodwell import InputError, Problem, critical_loads, follow, lying_rod, sensitivities
from rodwell.analysis.loads.derivatives import Sensitivity
from rodwell.analysis.loads.ends import LEAVING
from rodwell.analysis.loads.sensitivity import of_critical_load
from rodwell.cli.main import cli

SECTIONS = ((0.35, 1.0, 1.0), (0.25, 0.3, 0.5), (0.4, 2.0, 1.7))
INCLINED = Problem(15.0, 60.0, clearance=0.02, build=0.3, ends="pinned-clamped", sections=SECTIONS)
S = np.linspace(-0.5, 0.5, 41)
CURVE = np.stack([S - 0.06 * S**3, 0.0 * S, 0.15 * S**2 + 0.08 * S**3], axis=1)
LENGTH = float(np.sum(np.linalg.norm(np.diff(CURVE, axis=0), axis=1)))
ALONG = Problem(15.0, axis=(CURVE / LENGTH).tolist(), clearance=0.02, ends="pinned-clamped", sections=SECTIONS)
TURN = Problem(40.0, 90.0, clearance=0.02, build=0.3, walk=0.2)
TWISTED = Problem(
    4.0, 89.9, clearance=0.1, build=0.27, walk=0.0025, ends="guided-guided", twist=4.8,
    sections=((0.5, 1.0, 1.0), (0.5, 0.98, 1.0)),
)  # fmt: skip


def slope(load: Callable[[float], float], h: float) -> float:
    """Central differences with steps h and 2h, extrapolated to no step."""
    narrow, wide = ((load(k * h) - load(-k * h)) / (2.0 * k * h) for k in (1.0, 2.0))
    return (4.0 * narrow - wide) / 3.0


def with_section(problem: Problem, number: int, which: int, step: float) -> Problem:
    """Stiffness (1) or weight (2) of a section moved, or the place of the step above it (0)."""
    sections: list[Any] = [list(section) for section in problem.sections]
    sections[number][which] += step
    if which == 0:
        sections[number + 1][0] -= step
    return problem.but(sections=sections)


def critical(problem: Problem) -> float:
    return critical_loads(problem, 1, rtol=1e-11)[0].force


def homogeneous(load: Sensitivity) -> float:
    """Σ bᵢ ∂F/∂bᵢ + w ∂F/∂w + T₁ ∂F/∂T₁."""
    problem = load.problem
    whole = problem.weight * load.derivatives["weight"].value
    whole += problem.twist * load.derivatives["twist"].value if "twist" in load.derivatives else 0.0
    ratios = [float(section[1]) for section in problem.sections]  # type: ignore[arg-type]
    return whole + sum(b * one["stiffness"].value for b, one in zip(ratios, load.sections, strict=True))


@pytest.mark.parametrize("problem", [INCLINED, ALONG], ids=["arc", "along points"])
@pytest.mark.parametrize(("number", "which", "step"), [(0, 1, 0.01), (1, 1, 0.003), (1, 2, 0.005), (2, 2, 0.02),
                                                       (0, 0, 5e-4), (1, 0, 5e-4)])  # fmt: skip
def test_a_critical_load_by_the_data_of_a_section(problem: Problem, number: int, which: int, step: float) -> None:
    load = of_critical_load(critical_loads(problem, 1, rtol=1e-11)[0])
    found = load.sections[number][("upper_end", "stiffness", "weight")[which]]
    expected = slope(lambda x: critical(with_section(problem, number, which, x)), step)
    assert found.value == pytest.approx(expected, rel=1e-6)
    assert found.error <= 1e-6 * abs(expected)


@pytest.mark.parametrize("problem", [INCLINED, ALONG], ids=["arc", "along points"])
def test_derivatives_by_all_sections_add_up(problem: Problem) -> None:
    """A section's weight ratio does what the weight of all does, and loads are homogeneous."""
    for load in sensitivities(problem, rtol=1e-9):
        by_weight = sum(section[2] * one["weight"].value for section, one in zip(SECTIONS, load.sections, strict=True))
        part = problem.weight * load.derivatives["weight"].value
        known = 1e-10 if "critical" in load.name else 1e-6
        assert by_weight == pytest.approx(part, abs=known * abs(load.force))
        assert homogeneous(load) == pytest.approx(load.force, rel=known)


def test_a_lift_off_load_by_the_data_of_a_section() -> None:
    load = sensitivities(INCLINED, rtol=1e-10)[1]
    assert load.name == "lift-off load"
    for number, which, name in ((1, 1, "stiffness"), (2, 2, "weight")):

        def lift_off(x: float, number: int = number, which: int = which) -> float:
            lift = follow(with_section(INCLINED, number, which, x), rtol=1e-10).lift_off
            assert lift is not None
            return lift.force

        expected = slope(lift_off, 2e-3)
        assert load.sections[number][name].value == pytest.approx(expected, rel=1e-6)


def end(problem: Problem) -> float:
    found = lying_rod(problem, rtol=1e-9).end
    assert found is not None
    return found.force


@pytest.mark.parametrize(
    ("problem", "name", "steps"),
    [
        (Problem(15.0, 90.0, walk=0.3, ends="pinned-pinned"), "lift-off load",
         {"weight": 0.1, "clearance": 1e-4, "walk": 1e-3}),
        (TURN, "load at which it buckles", {"weight": 0.1, "clearance": 1e-4, "build": 1e-3, "walk": 1e-3}),
        (TWISTED, "load at which it loses its stability", {"weight": 0.02, "alpha": 0.01, "twist": 0.02}),
    ],
    ids=["lift-off", "branch point", "fold"],
)  # fmt: skip
def test_where_a_rod_as_it_lies_in_space_ceases_to(problem: Problem, name: str, steps: dict[str, float]) -> None:
    load = sensitivities(problem, rtol=1e-9)[0]
    assert load.name == name
    for key, step in steps.items():
        expected = slope(lambda x, key=key: end(problem.but(**{key: getattr(problem, key) + x})), step)  # type: ignore[misc]
        assert load.derivatives[key].value == pytest.approx(expected, rel=3e-6, abs=1e-7), key


def test_a_fold_by_the_stiffness_of_a_section() -> None:
    load = sensitivities(TWISTED, rtol=1e-9)[0]
    expected = slope(lambda x: end(with_section(TWISTED, 0, 1, x)), 1e-3)
    assert load.sections[0]["stiffness"].value == pytest.approx(expected, rel=1e-6)
    assert homogeneous(load) == pytest.approx(load.force, rel=1e-6)


def test_what_takes_a_branch_point_away_has_no_derivative() -> None:
    """Two thirds of a power: the load of a rod tilted by ε is off by about ε^⅔, which no derivative tells."""
    load = sensitivities(TURN, rtol=1e-9)[0]
    assert "alpha" not in load.derivatives
    assert "alpha" not in load.elasticities()
    assert "length" in load.elasticities()
    assert "has no derivative" in load.note


def test_a_rod_that_leaves_the_wall_of_a_drop() -> None:
    """Level at the middle: w cos(κᵣ/2) = κᵣ(F − κᵣ²) at the ends of the rod, where F also turns its end."""
    weight, build, clearance = 15.0, -0.8, 0.01
    bent, stretched = build / (1.0 + clearance * build), 1.0 + clearance * build
    load = sensitivities(Problem(weight, build=build))[-1]
    assert load.name == LEAVING
    assert load.force == pytest.approx(weight * math.cos(bent / 2.0) / bent + bent**2, rel=1e-9)
    assert load.derivatives["weight"].value == pytest.approx(math.cos(bent / 2.0) / bent, rel=1e-9)
    by_bend = -weight * (math.sin(bent / 2.0) / 2.0 / bent + math.cos(bent / 2.0) / bent**2) + 2.0 * bent
    assert load.derivatives["build"].value == pytest.approx(by_bend / stretched**2, rel=1e-9)
    assert load.derivatives["clearance"].value == pytest.approx(-by_bend * bent**2, rel=1e-9)


def test_a_string_that_leaves_the_wall_of_a_drop() -> None:
    """A string bends with the hole, b κᵣ: stiffness and weight, doubled, double the load; and a difference."""
    problem = Problem(15.0, 70.0, build=-0.8, sections=((0.5, 1.0, 1.0), (0.5, 0.8, 1.1)))
    load = next(one for one in sensitivities(problem) if one.name == LEAVING)
    assert homogeneous(load) == pytest.approx(load.force, rel=1e-10)
    for number, which, name in ((1, 2, "weight"), (1, 1, "stiffness")):

        def leaves(x: float, number: int = number, which: int = which) -> float:
            moved = sensitivities(with_section(problem, number, which, x))
            return next(one.force for one in moved if one.name == LEAVING)

        expected = slope(leaves, 1e-3)
        assert load.sections[number][name].value == pytest.approx(expected, rel=1e-6, abs=1e-8)


def test_the_command_takes_strings_in_bends_and_holes_that_turn() -> None:
    asked = ["sensitivity", "--weight", "15", "--alpha", "60", "--build", "0.3", "--sections", "0.6:1:1,0.4:0.3:0.5"]
    told = CliRunner().invoke(cli, asked)
    assert told.exit_code == 0, told.output
    assert "unit of the stiffness ratio, section 2" in told.output
    assert "L that section 1 is longer" in told.output
    told = CliRunner().invoke(
        cli, ["sensitivity", "--weight", "15", "--alpha", "80", "--build", "0.1", "--walk", "0.2"]
    )
    assert told.exit_code == 0, told.output
    assert "1 % more turn, walk" in told.output


def test_a_rod_in_space_has_one_way_only() -> None:
    with pytest.raises(InputError, match="has no critical load"):
        sensitivities(TURN, 2)
