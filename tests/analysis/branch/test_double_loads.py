"""Critical loads that coincide: modes told apart, and the branches that leave along both of them.

A horizontal rod with pinned ends has the loads −(n²π² + γ/(n²π²)) with γ = w/Δ; those of n and m waves coincide where
γ = n²m²π⁴. Other rods are reached through limits and through rods of half the length.
"""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import pytest

from rodwell import Branch, Diagram, Problem, critical_loads, diagram, load_branch, save_branch
from rodwell.analysis.discrete.measures import Measured

CLAMPED = 62.34181826018
"""Weight at which two loads of a clamped rod coincide, F = −20π² (Δ = 0.01; paper, after Table 1)."""


def pinned(n: int, m: int, times: float = 1.0, clearance: float = 0.01, twist: float = 0.0) -> Problem:
    weight = clearance * (n * m * math.pi**2) ** 2 * times
    return Problem(weight, 90.0, clearance=clearance, twist=twist, ends="pinned-pinned")


def energy(branch: Branch, force: float) -> float:
    return branch.at(force).number(Measured.ENERGY).value


@pytest.mark.parametrize(("n", "m", "number"), [(4, 5, 1), (2, 4, 2)])
@pytest.mark.parametrize("times", [1.0, 1.0 + 1e-6])
def test_modes_of_equal_loads_are_single_waves(n: int, m: int, number: int, times: float) -> None:
    """Whatever the parities, and however many are asked for."""
    problem = pinned(n, m, times)
    gamma = problem.weight / problem.clearance
    exact = sorted((-((k * math.pi) ** 2) - gamma / (k * math.pi) ** 2, k) for k in (n, m))[::-1]
    for count in (number, number + 1, number + 2):
        for mode, (force, waves) in zip(critical_loads(problem, count)[number - 1 :], exact, strict=False):
            assert mode.force == pytest.approx(force, abs=1e-10)
            if times != 1.0:
                assert mode.wavenumber == pytest.approx(waves * math.pi, rel=1e-6)
                assert mode.together == (mode.number,)
            else:
                assert mode.wavenumber == pytest.approx((n, m)[mode.number - number] * math.pi, rel=1e-9)
                assert mode.together == (number, number + 1)


def test_the_branch_along_both_modes_is_the_limit_of_the_secondary_ones_beside() -> None:
    """Beside the double load it joins the two primary branches by a pitchfork on the second."""
    result = diagram(Problem(CLAMPED), until=-215.0, modes=2)
    mixed = result["modes 1 and 2"]
    assert (mixed.special_points[0].kind, mixed.mode, mixed.origin.parent) == ("critical", None, None)
    assert mixed.special_points[0].error < 1e-7
    assert mixed.converged
    assert not result.unexplored
    assert [p.index_after for p in mixed.special_points] == [1, 1]
    assert [branch.stability_index[-1] for branch in result] == [0, 0, 1]
    assert mixed[-1].certificate.passed
    assert len(mixed.images) == 4
    beside = [diagram(Problem(CLAMPED * (1.0 + by)), until=-215.0, modes=2)["secondary 1"] for by in (-1e-4, 1e-4)]
    mean = sum(energy(branch, -214.0) for branch in beside) / 2.0
    assert energy(mixed, -214.0) == pytest.approx(mean, rel=1e-6)
    assert abs(mean - energy(result["mode 1"], -214.0)) > 0.01 * abs(mean)


@pytest.mark.parametrize("by", [-1e-8, 1e-8, 1e-10])
def test_next_to_a_double_load_the_secondary_branch_does_not_go_to_a_primary_one(by: float) -> None:
    """The amplitude at which it leaves is 1e-6 to 1e-4 rad, far within the first step."""
    result = diagram(Problem(CLAMPED * (1.0 + by)), until=-205.0, modes=2)
    limit = diagram(Problem(CLAMPED), until=-205.0, modes=2)["modes 1 and 2"]
    point = next(p for p in result["mode 2"].special_points if p.kind == "branch_point")
    assert (point.index_before, point.index_after) == (1, 0)
    branch = result["secondary 1"]
    assert branch.special_points[0].error == point.error
    assert {p.index_after for p in branch.special_points} == {1}
    assert energy(branch, -204.0) == pytest.approx(energy(limit, -204.0), rel=1e-5)


@pytest.fixture(scope="module")
def waves_2_and_4() -> Diagram:
    return diagram(pinned(2, 4), until=-217.0, modes=3)


def test_two_waves_of_one_parity_meet_in_two_ways_that_half_the_rod_turns_into_each_other(
    waves_2_and_4: Diagram,
) -> None:
    """Half the rod is one with one and two waves: weight 1/8, clearance 2, force 1/4, energy of both halves 4."""
    names = ["modes 2 and 3", "modes 2 and 3, direction 2"]
    assert [branch.name for branch in waves_2_and_4] == ["mode 1", "mode 2", "mode 3", *names]
    half = diagram(pinned(1, 2, clearance=0.02), until=-217.0 / 4.0, modes=2)
    assert [branch.name for branch in half] == ["mode 1", "mode 2", "modes 1 and 2"]
    expected = 4.0 * energy(half["modes 1 and 2"], -54.0)
    for name in names:
        assert energy(waves_2_and_4[name], -216.0) == pytest.approx(expected, rel=1e-9)
    assert [branch.special_points[0].index_after for branch in waves_2_and_4.branches[1:]] == [1, 1, 2, 2]


def test_under_twist_both_arms_are_followed() -> None:
    """Even modes are their own mirror images up to a reflection, odd ones are not: mixtures have two arms."""
    result = diagram(pinned(4, 5, twist=1.0), until=-445.0, modes=2)
    energies = [energy(b, -444.0) for b in result if b.name.startswith("modes 1 and 2")]
    assert len(energies) == 2
    beside = diagram(pinned(4, 5, 1.0 + 1e-6, twist=1.0), until=-445.0, modes=2)
    for one, other in itertools.zip_longest(sorted(energies), sorted(energy(b, -444.0) for b in beside.secondary)):
        assert one == pytest.approx(other, rel=1e-4)


def test_such_a_branch_is_kept_in_a_file(waves_2_and_4: Diagram, tmp_path: Path) -> None:
    branch = waves_2_and_4["modes 2 and 3"]
    again = load_branch(save_branch(branch, tmp_path / "branch.nc"))
    assert (again.name, again.mode) == (branch.name, None)
    assert [(p.kind, p.force, p.error) for p in again.special_points] == [
        (p.kind, p.force, p.error) for p in branch.special_points
    ]
