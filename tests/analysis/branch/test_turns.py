"""Coils from any start: wide, heavy, and the number of turns of least energy."""

from __future__ import annotations

import math

import pytest

from rodwell import InputError, NotConvergedError, Problem, coil, equilibrium, turns_of_least_energy
from rodwell.physics.exact.helix import coil_energy


@pytest.mark.parametrize("clearance", [0.08, 0.1, 0.12])
def test_wide_coils_start(clearance: float) -> None:
    """Clamped ends with 2·2πnΔ ≥ 1: a winding that is twice as steep in the middle would turn across."""
    state = equilibrium(Problem(15.0, 90.0, clearance=clearance, turns=1), 0.0)
    assert state.stable
    assert state.converged


def test_heavy_coils_are_approached_from_lighter_ones() -> None:
    """Equal energy −1505.9 and touch-down −1507.0 of γ = 3000 lie in the default range; γ = 15,120 starts."""
    branch = coil(Problem(3000.0, 90.0, clearance=0.0094, turns=1))
    assert branch.labelled("equal_energy 1").force == pytest.approx(-1505.9, abs=0.05)
    assert branch.labelled("touch_down 1").force == pytest.approx(-1507.0, abs=0.05)
    state = equilibrium(Problem(15120.0, 90.0, clearance=0.0094, turns=1), 0.0)
    assert state.stable
    assert state.problem.weight == 15120.0


def test_a_coarse_mesh_does_not_hold_a_coil_that_is_unstable() -> None:
    """The wave on this helix moves nearly for nothing; 66 elements held it in the middle, where it is a saddle."""
    rod = Problem(0.0, 90.0, clearance=0.001669, twist=-0.124, turns=3, ends="pinned-pinned")  # type: ignore[arg-type]
    state = equilibrium(rod, -2570.0)
    assert state.stable
    assert state.converged
    again = equilibrium(rod, -2570.0, rtol=1e-10)
    assert again.number("energy").value == pytest.approx(state.number("energy").value, rel=1e-7)
    assert state.point.fine.symmetry == 0


def test_a_coil_is_refined_where_one_mesh_gains_little() -> None:
    """Of these meshes one has a quarter of the error left, the next a hundredth of that: no round-off."""
    state = equilibrium(Problem(15.0, 90.0, clearance=0.00222, turns=4), 0.0)
    assert state.converged
    finer = equilibrium(Problem(15.0, 90.0, clearance=0.00222, turns=4), 0.0, rtol=1e-10)
    one, two = state.number("largest_pressure"), finer.number("largest_pressure")
    assert one.value == pytest.approx(two.value, abs=one.error + two.error)


def test_energy_that_falls_until_the_rod_turns_across_is_said() -> None:
    """Beyond its last fold the coil has no minimum: Problem number 17 of benchmarks/campaigns/coils.py, rounded."""
    rod = Problem(5.56, 90.0, clearance=0.01235, turns=-6)
    with pytest.raises(NotConvergedError, match=r"\|η\| = 90°"):
        equilibrium(rod, -11016.0)


def test_turns_of_least_energy_of_a_weightless_rod() -> None:
    """Between pinned ends uniform helices are the coils: the energy of the closed form is least where it says."""
    rod, force = Problem(0.0, 90.0, clearance=0.005, ends="pinned-pinned"), -1200.0  # type: ignore[arg-type]
    found = turns_of_least_energy(rod, force)
    exact = {n: coil_energy(2.0 * math.pi * n, force, 0.0, rod.clearance) for n in found.coils}
    assert found.turns == min(exact, key=lambda n: exact[n])
    for turns, energy in exact.items():
        assert found.energies[turns].value <= energy + 1e-9 * abs(energy)
        if turns >= found.turns:  # with fewer turns the even winding is no minimum
            assert found.energies[turns].value == pytest.approx(energy, rel=1e-9)
    assert found.solution is not None
    assert found.solution.problem.turns == found.turns
    assert max(found.coils) >= found.turns + 3


def test_a_straight_rod_has_least_energy_at_small_loads() -> None:
    found = turns_of_least_energy(Problem(15.0, 90.0), -20.0)
    assert found.turns == 0
    assert found.solution is None
    assert found.energies[1].value > 0.0


def test_what_cannot_be_wound_is_said() -> None:
    found = turns_of_least_energy(Problem(15.0, 90.0, clearance=0.1), -50.0)
    assert "cannot wind around so often" in found.missing[2]
    with pytest.raises(InputError, match="clamp or pin both"):
        turns_of_least_energy(Problem(15.0, 90.0, ends="free-clamped"), -50.0)  # type: ignore[arg-type]
