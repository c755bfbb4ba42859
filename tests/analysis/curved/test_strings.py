"""Strings of sections in curved holes: loads against limits and a second method, states against balance in space."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from rodwell import Branch, Problem, critical_loads, equilibrium, follow, load_branch, save_branch
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.state.in_hole import InHole
from rodwell.analysis.state.wall import lying_step_loads
from rodwell.analysis.straight.lying import lying_contact, lying_fields, off_at_steps

D, BUILD = 0.01, 0.3
STRING = ((0.6, 1.0, 1.0), (0.4, 0.3, 0.5))
BENT = Problem(15.0, 60.0, D, build=BUILD, sections=STRING)  # type: ignore[arg-type]
CURVATURE = BUILD / (1.0 + D * BUILD)


def slope(s: np.ndarray) -> np.ndarray:
    """ψ, from the horizontal, of the rod in that arc, whose inclination at mid-length is 60° from the vertical."""
    return np.asarray(math.pi / 6.0 + CURVATURE * (s - 0.5))


def test_a_hole_that_is_nearly_straight_has_the_loads_of_a_straight_one() -> None:
    """They go linearly with the curvature, the clearance also counts."""
    straight, bent = (critical_loads(BENT.but(build=build), 3).forces for build in (0.0, 1e-8))
    assert bent == pytest.approx(straight, rel=1e-7)
    known = (-54.290445115953, -73.536263059112, -131.937687248667)  # checked by shooting with 40 digits
    assert straight == pytest.approx(known, rel=1e-11)


def test_a_string_seen_from_its_other_end_is_the_same() -> None:
    """In constant curvature F acts at the other end, less what hangs between; sections alike are a uniform rod."""
    turned = critical_loads(BENT.turned_round, 2).forces
    assert turned == pytest.approx(critical_loads(BENT, 2).forces - BENT.hung_weight, rel=1e-10)
    assert BENT.but(sections=((0.3, 1.0, 1.0), (0.7, 1.0, 1.0))).sections == ()


def test_half_the_stiffness_and_weight_bear_half_the_load() -> None:
    one = BENT.but(sections=((0.5, 1.0, 1.0), (0.5, 2.0, 1.0)))
    two = BENT.but(weight=7.5, sections=((0.5, 0.5, 1.0), (0.5, 1.0, 1.0)))
    assert critical_loads(two, 2).forces == pytest.approx(0.5 * critical_loads(one, 2).forces, rel=1e-10)


def test_weight_hangs_as_high_as_each_section_rises() -> None:
    """N(0) = F − w Σ q Δz of an arc, by hand."""
    ends = np.array([0.0, 0.6, 1.0])
    rises = np.diff(-np.cos(slope(ends))) / CURVATURE
    assert BENT.hung_weight == pytest.approx(15.0 * (rises @ [1.0, 0.5]), rel=1e-12)


def test_contact_and_tension_of_the_lying_string() -> None:
    """P = q w cos ψ − κᵣ(N − bκᵣ²), F₁ = N − bκᵣ²; the wall holds it by −[b]κᵣ at the step, whatever the force is."""
    force, s = -40.0, np.array([0.1, 0.59, 0.61, 0.95])
    b, q = np.where(s < 0.6, 1.0, 0.3), np.where(s < 0.6, 1.0, 0.5)
    top, step = -np.cos(slope(np.array([1.0]))), -np.cos(slope(np.array([0.6])))
    height = -np.cos(slope(s))
    above = np.where(s < 0.6, 0.5 * (top - step) + step - height, 0.5 * (top - height))
    drive = force - 15.0 * above / CURVATURE
    assert lying_contact(BENT, force, s) == pytest.approx(
        q * 15.0 * np.cos(slope(s)) - CURVATURE * (drive - b * CURVATURE**2), rel=1e-10
    )
    fields = lying_fields(BENT, force, s)
    assert fields["rod_F1"] == pytest.approx(drive - b * CURVATURE**2, rel=1e-10)
    assert fields["rod_M3"] == pytest.approx(b * CURVATURE, rel=1e-12)
    (step_load,) = lying_step_loads(BENT)
    assert step_load.couple.value == pytest.approx(0.7 * CURVATURE, rel=1e-12)
    assert step_load.force.value == 0.0
    assert step_load.lifts
    off, pressed = off_at_steps(BENT, force), lying_contact(BENT, force, np.array([0.6 - 1e-12, 0.6]))
    assert off == pytest.approx(math.sqrt(2.0 * 0.7 * CURVATURE / np.max(pressed)), rel=1e-9)
    assert off_at_steps(BENT.but(sections=()), force) is None


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(BENT, 1, until=-115.0)


@pytest.fixture(scope="module")
def state(branch: Branch) -> Solution:
    return branch.at(-110.0)


def test_a_buckled_string_balances_in_space(state: Solution) -> None:
    """The certificate knows no energy; forces of the wall at the step are part of the balance."""
    assert state.certificate.passed
    assert state.certificate.residuals["moment at steps"] < 1e-8
    assert state.certificate.worst < 1e-8
    assert state.stability_index == 0


def test_the_wall_holds_a_buckled_string_at_its_step(state: Solution) -> None:
    """Jumps of the rod's force in space along t₁, d₁, u₁ are −(−cω₃, f, cω₁), of its moment about u₁ −c."""
    rod, sides = InHole(state.problem, *state.levels[1]), np.array([np.nextafter(0.6, 0.0), 0.6])
    fields, frame = rod.strand(sides), rod.frames(sides)[1]
    forces = np.einsum("ks,skx->sx", [fields[f"rod_F{i}"] for i in (1, 2, 3)], frame)
    (load,) = state.step_loads
    couple, bent, twisted = load.couple.value, fields["omega3"][1], fields["omega1"][1]
    jump = frame[1] @ (forces[1] - forces[0])
    assert jump == pytest.approx([couple * bent, -load.force.value, -couple * twisted], rel=1e-6)
    assert fields["rod_M3"][1] - fields["rod_M3"][0] == pytest.approx(-couple, rel=1e-10)


def test_energies_of_a_buckled_string_are_those_that_are_stationary(state: Solution) -> None:
    """Bending, height and work by their own integrals, against the energy of the engine; dE/dF is the shortening."""
    parts = state.energies
    whole = sum(parts[name].value for name in ("bending_energy", "lateral_energy", "axial_energy"))
    assert whole - parts["end_work"].value == pytest.approx(state.number("energy").value, rel=1e-9)


def test_a_branch_is_kept_with_its_kinks(branch: Branch, tmp_path: Path) -> None:
    save_branch(branch, tmp_path / "kept.nc")
    again = load_branch(tmp_path / "kept.nc")
    assert again.at(-110.0).number("energy").value == branch.at(-110.0).number("energy").value


def test_a_string_in_a_hole_that_leaves_the_vertical_plane_balances_in_space() -> None:
    """It lies at an angle that moves with the force; the wall holds it at the step."""
    rest = equilibrium(BENT.but(walk=0.1), -40.0)
    assert rest.certificate.passed
    assert rest.largest("xi2").value > 0.01
    (load,) = rest.step_loads
    assert load.couple.value > 0.0
