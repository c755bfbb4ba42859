"""Coils whose end s = 1 has not come round to where it was: half a turn over, and any other part."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_bvp

from rodwell import InputError, Problem, coil, equilibrium
from rodwell.cli.main import cli


@pytest.mark.parametrize("turns", [0.25, 0.5, 1.5, 2.7])
def test_a_weightless_rod_winds_evenly(turns: float) -> None:
    """Between pinned ends y = 2πnΔs solves the equations for any n: energy ½ sin⁴η/Δ² + F(1 − cos η) per length."""
    delta, force = 0.02, -((2.0 * math.pi * turns) ** 2)  # half of that from which it winds unevenly
    state = equilibrium(Problem(0.0, 90.0, clearance=delta, turns=turns, ends=("pinned", "pinned")), force)
    sine = 2.0 * math.pi * turns * delta
    exact = 0.5 * sine**4 / delta**2 + force * (1.0 - math.sqrt(1.0 - sine**2))
    energy = state.number("energy")
    assert energy.value == pytest.approx(exact, abs=energy.error + 1e-12)
    assert state.converged
    assert state.fields(np.array([0.0, 1.0]))["xi2"] == pytest.approx([0.0, 2.0 * math.pi * turns], abs=1e-12)


@pytest.mark.parametrize("turns", [0.5, 1.5, 0.8])
def test_a_heavy_rod_by_collocation(turns: float) -> None:
    """The same state by another program: scipy's collocation of the equations of tests/analysis/branch/shooting.py."""
    weight, delta, force = 40.0, 0.02, -60.0
    state = equilibrium(Problem(weight, 90.0, clearance=delta, turns=turns), force)

    def rates(_: np.ndarray, x: np.ndarray) -> np.ndarray:
        xi, eta, kappa, v = x
        sine, cosine = np.sin(eta), np.cos(eta)
        bend = 2.0 * sine**3 * cosine / delta**2 + force * sine - v * cosine
        return np.array([sine / delta, kappa, bend, weight * np.sin(xi)])

    def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.array([a[0], a[1], b[0] - 2.0 * np.pi * turns, b[1]])

    s = np.linspace(0.0, 1.0, 101)
    fields = state.fields(s)
    start = np.array([fields["xi2"], fields["eta"], np.gradient(fields["eta"], s), np.zeros_like(s)])
    other = solve_bvp(rates, ends, s, start, tol=1e-9, max_nodes=20000)
    assert other.success
    assert other.sol(s)[0] == pytest.approx(fields["xi2"], abs=1e-6)
    assert other.sol(s)[2] == pytest.approx(-fields["omega2"], abs=1e-5)
    assert state.converged
    assert state.stability_index == 0


def test_half_a_turn_seen_from_its_other_end_begins_on_top() -> None:
    rod = Problem(30.0, 65.0, clearance=0.02, turns=1.5, ends=("clamped", "pinned"))
    other = rod.turned_round
    assert (other.alpha, other.on_top, other.ends) == (115.0, True, ("pinned", "clamped"))
    here = equilibrium(rod, -70.0)
    there = equilibrium(other, -70.0 - rod.axial_weight)
    s = np.linspace(0.0, 1.0, 21)
    one, two = here.fields(s), there.fields(1.0 - s)
    assert two["contact_pressure"] == pytest.approx(one["contact_pressure"], abs=1e-5)
    assert two["eta"] == pytest.approx(one["eta"], abs=1e-9)
    assert (here.stability_index, here.converged, there.converged) == (there.stability_index, True, True)


def test_whole_turns_are_the_limit_of_others() -> None:
    energies = [
        equilibrium(Problem(15.0, 80.0, turns=turns), -40.0).number("energy").value for turns in (1 - 1e-6, 1, 1 + 1e-6)
    ]
    assert energies[1] == pytest.approx(0.5 * (energies[0] + energies[2]), abs=1e-9)


def test_weight_takes_the_symmetry_of_an_end_on_the_other_side() -> None:
    """A coil is the same from both ends if these are on one side of the cylinder, or if weight presses it nowhere."""
    assert [Problem(w, 90.0, turns=n).symmetric for w, n in ((15.0, 1), (15.0, 1.5), (0.0, 1.5))] == [True, False, True]
    assert isinstance(Problem(15.0, turns=2.0).turns, int)
    branch = coil(Problem(15.0, 90.0, turns=1.5), until=-260.0)
    assert branch.name == "coil of 1.5 turns"
    assert branch.reached_end
    assert branch.converged
    assert "equal_energy" not in {point.kind for point in branch.special_points}


def test_the_command_line_takes_half_turns(tmp_path: Path) -> None:
    rod = ("--weight", "15", "--alpha", "90", "--turns", "0.5", "--until", "-60")
    done = CliRunner().invoke(cli, ["diagram", *rod, "--json", "--out", str(tmp_path / "half")])
    assert done.exit_code == 0, done.output
    assert json.loads(done.output)["branches"][0]["name"] == "coil of 0.5 turns"


@pytest.mark.parametrize("turns", [math.nan, 1001.0, "one", True])
def test_turns_that_are_none_are_refused(turns: object) -> None:
    with pytest.raises(InputError, match=r"^turns = "):
        Problem(15.0, turns=turns)  # type: ignore[arg-type]
