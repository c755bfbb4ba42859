"""Answers in a curved hole: the hole's own bending in every stress, where the rod lies, which wall it presses."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.interpolate import make_interp_spline

import rodwell
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.state.in_hole import InHole
from rodwell.answers.data.plain import answer_dict
from rodwell.answers.result.assessment import BUCKLED, LEFT, PULLED, STRAIGHT
from rodwell.answers.words.advice import statuses
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.wording import around_text
from rodwell.cli.main import cli
from rodwell.quantities.value import Value
from rodwell.strength.section import RodSection

EXAMPLE = Path(__file__).parents[2] / "examples" / "build-section.toml"
BUILD, WEIGHT, CLEARANCE = 0.2, 15.0, 0.01


def bent(build: float = BUILD, **load: Any) -> rodwell.Case:
    """The dimensionless rod of the theory of curved holes."""
    case = rodwell.Case.from_dict(
        {"dimensionless": {"weight": WEIGHT, "alpha": 90.0}, "load": load, "analysis": {"modes": 1}}
    )
    return replace(case, problem=case.problem.but(build=build))


@pytest.fixture(scope="module")
def build_section() -> rodwell.Answer:
    return rodwell.answer(rodwell.Case.read(EXAMPLE))


def modulus(section: RodSection) -> float:
    """Young's modulus in Pa: stiffness over the second moment of area, π/64 (3.5⁴ − 2.25⁴) in⁴."""
    return section.rod.stiffness / (math.pi / 64.0 * (0.0889**4 - 0.05715**4))


def test_the_lying_rod_has_the_stress_of_the_hole(build_section: rodwell.Answer) -> None:
    """Closed form: bending stress E r κ/(1 + κΔ), axial stress of F − B κᵣ² at s = 1, both by hand in SI units."""
    a, scales = build_section.assessment, build_section.case.scales
    assert scales is not None
    assert isinstance(a.section, RodSection)
    problem = build_section.case.problem
    kappa = problem.build / scales.length
    curvature = kappa / (1.0 + kappa * problem.clearance * scales.length)
    f = a.at_buckling.fields(np.array([0.0, 1.0]))
    loading, stress = a.section.loading(f), a.section.stresses(f)
    assert stress.bending == pytest.approx(modulus(a.section) * 0.5 * 0.0889 * curvature, rel=1e-9)
    effective = a.at_buckling.force * scales.factor("force") - scales.stiffness * curvature**2
    less = build_section.case.fluids.effective_minus_real(a.section.rod, 0.0)
    assert loading.force[1] == pytest.approx(effective - less, rel=1e-9)
    key = build_section.key_numbers["hole_bending"]
    assert key.value * scales.factor("moment") == pytest.approx(scales.stiffness * curvature, rel=1e-9)


def curvature_in_space(state: Solution, s: np.ndarray) -> np.ndarray:
    """|r″| of the centreline in space, from a spline of degree 7 through its points: no formula of the hole in it."""
    places = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 301))
    centre, _ = InHole(state.problem, *state.levels[1]).frames(places)
    return np.asarray(np.linalg.norm(make_interp_spline(places, centre, 7).derivative(2)(s), axis=1))


def test_the_buckled_rod_bends_as_its_centreline_in_space(build_section: rodwell.Answer) -> None:
    """Theory of curved holes: total curvature of the rod's centre line; a second way, without κₙ and κ_g."""
    state, a = build_section.at_lift_off, build_section.assessment
    assert state is not None
    assert isinstance(a.section, RodSection)
    assert a.at_lift_off is not None
    s = np.linspace(0.05, 0.95, 37)
    bending = a.section.stresses(a.at_lift_off.fields(s)).bending
    per_curvature = modulus(a.section) * 0.5 * 0.0889 / a.section.scales.length
    assert bending == pytest.approx(per_curvature * curvature_in_space(state, s), rel=1e-7)


def test_places_for_the_pressures_are_the_heights_in_space(build_section: rodwell.Answer) -> None:
    state, a = build_section.at_lift_off, build_section.assessment
    assert state is not None
    assert isinstance(a.section, RodSection)
    s = np.linspace(0.0, 1.0, 9)
    height = InHole(state.problem, *state.levels[1]).frames(s)[0][:, 2] * a.section.scales.length
    drop = a.section.drop(state.fields(s))
    assert np.ptp(drop + height) < 1e-9
    assert a.section.drop(a.at_buckling.fields(np.array([1.0])))[0] == pytest.approx(0.0, abs=1e-12)
    rise = a.section.drop(a.at_buckling.fields(np.array([0.0])))[0]
    assert rise * state.problem.weight / a.section.scales.length == pytest.approx(state.problem.hung_weight, rel=1e-9)


def test_loads_that_act_are_assessed(build_section: rodwell.Answer) -> None:
    low, high, pull = build_section.assessment.applied
    assert low.what == STRAIGHT
    assert low.state is not None
    stress = build_section.assessment.stress(low.state)
    assert stress is not None
    assert stress.safety is not None
    assert stress.safety.value < 55000 * 6894.757 / stress.bending  # the hole's bending is in it
    assert high.what == BUCKLED
    assert high.state is not None
    assert pull.what == PULLED
    assert pull.state is None


def test_an_almost_straight_hole_gives_the_straight_holes_answer() -> None:
    """κ → 0: every key number that both have, to 1e-6."""
    straight, nearly = rodwell.answer(bent(0.0)), rodwell.answer(bent(1e-9))
    shared = set(straight.key_numbers) & set(nearly.key_numbers)
    assert {"lift_off_load", "largest_wall_force", "end_shear", "end_shortening", "window"} <= shared
    for name in shared:
        one, other = straight.key_numbers[name], nearly.key_numbers[name]
        assert other.value == pytest.approx(one.value, rel=1e-6, abs=1e-6 * one.scale), name


def test_tension_takes_the_rod_off_the_low_side_of_a_build() -> None:
    """F = w cos(κᵣ/2)/κᵣ + κᵣ², at the ends first."""
    curvature = BUILD / (1.0 + BUILD * CLEARANCE)
    limit = WEIGHT * math.cos(0.5 * curvature) / curvature + curvature**2
    found = rodwell.answer(bent(applied=[0.99 * limit, 1.01 * limit]))
    inside, beyond = found.assessment.applied
    assert found.key_numbers["leaves_wall_in_tension"].value == pytest.approx(limit, rel=1e-6)
    assert inside.what == STRAIGHT
    assert beyond.what == PULLED
    text = " ".join(sentences(found))
    assert "the rod has left the low side at s/L = 0, pressed away from it by the curve" in text
    assert "does not buckle" not in text
    data = answer_dict(found)
    assert data["lying"]["highest_force"]["value"] == pytest.approx(limit, rel=1e-6)
    assert data["without_wall"] is None
    assert [one["what"] for one in data["assessment"]["applied"]] == [STRAIGHT, PULLED]


def test_a_rod_that_leaves_the_wall_of_a_drop_before_it_buckles_is_told_so() -> None:
    """The same closed form for a drop: the low side is the inside of the curve, compression lifts the rod off."""
    curvature = 0.4 / (1.0 - 0.4 * CLEARANCE)
    limit = -WEIGHT * math.cos(0.5 * curvature) / curvature + curvature**2
    found = rodwell.answer(bent(-0.4, applied=[0.99 * limit, 1.01 * limit]))
    assert found.left_before is not None
    assert found.buckling.value == pytest.approx(limit, rel=1e-6)
    assert found.critical[0].force < limit
    lies, gone = found.assessment.applied
    assert (lies.what, gone.what) == (STRAIGHT, LEFT)
    text = sentences(found)
    assert "has left the wall" in text[0]
    assert any("there it leaves the low side at s/L = 0" in line for line in text)
    assert not any("It buckles" in line or "stays on the wall until" in line for line in text)
    assert answer_dict(found)["lift_off"]["coincides_with_buckling"]


def test_which_wall_is_pressed(build_section: rodwell.Answer) -> None:
    state = build_section.at_lift_off
    assert state is not None
    place = state.wall.contact.s
    angle = state.wall.angle
    assert angle.value == pytest.approx(state.fields(np.array([place]))["xi2"][0], abs=1e-9)
    assert build_section.key_numbers["largest_wall_force_angle"].value == angle.value
    with pytest.raises(rodwell.InputError, match="computed in straight holes only"):
        _ = state.wall.torque
    low, high = (rodwell.Problem(15.0, build=0.2, floats=floats) for floats in (False, True))
    assert around_text(Value(0.0), low) == "the low side"
    assert around_text(Value(math.pi), low) == "the high side"
    assert around_text(Value(0.5, 1e-9), low) == "28.6° to the left of the low side"
    assert around_text(Value(-0.5, 1e-9), low) == "28.6° to the right of the low side"
    assert around_text(Value(0.0), high) == "the high side"
    assert around_text(Value(0.5, 1e-9), high) == "28.6° to the right of the high side"


def test_the_whole_folder(tmp_path: Path) -> None:
    """Figures, report, tables, viewer, data: what is not told of a curved hole is said, and nothing is refused."""
    result = CliRunner().invoke(cli, ["run", str(EXAMPLE), "--out", str(tmp_path / "out"), "--quiet"])
    assert result.exit_code == 0, result.output
    names = {file.name for file in (tmp_path / "out").iterdir()}
    assert {"report.html", "answer.json", "rod-3d.html", "wall-loads.svg", "along-rod.csv", "branches.nc"} <= names
    assert "cylinder.svg" not in names
    data = json.loads((tmp_path / "out" / "answer.json").read_text(encoding="utf-8"))
    assert "states off the wall" not in data["lying"]["left_out"]
    assert {"load-path.csv", "load-path.svg", "load-path-3d.html"} <= names
    assert [event["kind"] for event in data["beyond_lift_off"]["events"]][:2] == ["critical", "lift_off"]
    assert "derivatives" not in data["lying"]["left_out"]
    assert [set(load["derivatives"]) for load in data["sensitivities"]] == [
        {"weight", "alpha", "clearance", "build"}
    ] * 2
    assert data["assessment"]["states"][0]["shape"] == "along the hole"
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Not told of a curved hole" in page
    assert "curvature of the hole" in page[page.index("What the inputs do to the loads") :]
    assert "Beyond lift-off" in page
    assert "the rod that lies along the hole buckles" in page
    assert "straight rod" not in page


def test_a_stiff_rod_in_a_bend_that_comes_and_goes_needs_compression_to_lie_there() -> None:
    """κ = 0.4 (1 + cos 2π(s − ½)), no weight: P = κ″ − κ(F − ½κ²) to Δ → 0, so that F = κ″/κ + ½κ² in the middle."""
    s = np.linspace(0.0, 1.0, 201)
    turned = 0.4 * (s - 0.5) + 0.4 * np.sin(2.0 * np.pi * (s - 0.5)) / (2.0 * np.pi)
    steps = np.stack([np.cos(turned), np.zeros_like(s), np.sin(turned)])
    points = np.concatenate([np.zeros((3, 1)), np.cumsum(0.5 * (steps[:, 1:] + steps[:, :-1]) * 0.005, axis=1)], axis=1)
    expected = -0.4 * 4.0 * np.pi**2 / 0.8 + 0.5 * 0.8**2
    case = rodwell.Case.from_dict(
        {"dimensionless": {"weight": 1e-6}, "load": {"applied": -10.0}, "analysis": {"modes": 1, "rtol": 1e-6}}
    )
    found = rodwell.answer(replace(case, problem=rodwell.Problem(1e-6, clearance=1e-3, axis=points.T)))
    assert found.left_in_tension is not None
    assert found.left_in_tension.value == pytest.approx(expected, rel=5e-3)
    assert found.assessment.applied[0].what == PULLED
    text = " ".join(sentences(found))
    assert "It lies there only if the compression at s = 1 is at least 19.3707 B/L²: under less the rod leaves" in text
    assert "above the end force −19.3707 B/L² at s = 1" in " ".join(status.reason for status in statuses(found))


def test_of_a_string_that_nothing_holds_at_its_steps_the_load_is_told_beside_that_of_the_held_one() -> None:
    """It buckles before the held one in this hole: in the verdict, in the words, and of a load that acts between."""
    case = rodwell.Case.read(EXAMPLE.with_name("assembly-in-build.toml"))
    first = rodwell.load_path(case.problem, rtol=case.rtol).first("critical")
    assert first is not None
    held = rodwell.critical_loads(case.problem)[0].force
    between = replace(case.applied[0], force=0.5 * (first.force.value + held))
    found = rodwell.answer(replace(case, applied=(between,), modes=1))
    assert found.not_held_at_steps == first.force
    assert found.buckling.value < first.force.value  # the unsafe one of both is the held one
    told = " ".join(sentences(found))
    assert "lbf if nothing holds it there" in told
    assert "sideways, before the one that is held, at" in told
    assert "it has buckled, whatever is told" in told
