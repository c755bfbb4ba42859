"""Answers in holes that leave the vertical plane: how the rod lies, what ends that, and stress and contact of it."""

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
from rodwell.analysis.branch.special import LIFT_OFF
from rodwell.analysis.state.in_hole import InHole
from rodwell.answers.data.plain import answer_dict
from rodwell.answers.result.assessment import BUCKLED, LEFT, PULLED, STRAIGHT
from rodwell.answers.result.beyond import Beyond, StateBeyond, Step
from rodwell.answers.words.advice import next_steps, statuses
from rodwell.answers.words.meaning import sentences
from rodwell.cli.main import cli
from rodwell.plots.paths.beyond import pictured
from rodwell.strength.limits import YIELDS
from rodwell.strength.section import RodSection

EXAMPLE = Path(__file__).parents[2] / "examples" / "surveyed-well.toml"


def bent(alpha: float, build: float, walk: float, **load: Any) -> rodwell.Answer:
    """The answer to the dimensionless rod w = 15, Δ = 0.01."""
    case = rodwell.Case.from_dict({"dimensionless": {"weight": 15.0, "alpha": alpha}, "load": load})
    return rodwell.answer(replace(case, problem=case.problem.but(build=build, walk=walk)))


@pytest.fixture(scope="module")
def surveyed() -> rodwell.Answer:
    return rodwell.answer(rodwell.Case.read(EXAMPLE))


@pytest.fixture(scope="module")
def tilted() -> rodwell.Answer:
    """Its lying rod is that of tests/analysis/curved/test_lying_in_space.py."""
    return bent(80.0, 0.2, 0.3, applied=[-150.0, -260.0, 50.0])


def test_bending_is_that_of_the_centre_line_in_space(surveyed: rodwell.Answer) -> None:
    """|r″| of the centre line, from a spline of degree 7 through its points in space: no formula of the hole in it."""
    a, hole = surveyed.assessment, surveyed.case.problem.hole
    assert hole is not None
    assert not hole.planar
    assert surveyed.worst_certificate.passed
    assert isinstance(a.section, RodSection)
    inertia = math.pi / 64.0 * (0.127**4 - 0.0762**4)
    for at in (a.at_rest, a.at_buckling, a.applied[1].state):
        assert at is not None
        assert at.solution is not None
        assert at.straight
        places = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 301))
        centre, _ = InHole(at.problem, *at.solution.levels[1]).frames(places)
        s = np.linspace(0.05, 0.95, 19)
        curvature = np.linalg.norm(make_interp_spline(places, centre, 7).derivative(2)(s), axis=1)
        expected = a.section.rod.stiffness * curvature / a.section.scales.length * 0.0635 / inertia
        assert a.section.stresses(at.fields(s)).bending == pytest.approx(expected, rel=1e-4)


def test_loads_that_act_and_the_verdict(surveyed: rodwell.Answer) -> None:
    low, high, pull = surveyed.assessment.applied
    assert (low.what, high.what, pull.what) == (STRAIGHT, STRAIGHT, PULLED)
    assert high.state is not None
    assert low.state is not None
    assert high.state.contact.value > low.state.contact.value
    text = sentences(surveyed)
    assert text[0].startswith("At 400 kN of compression at the bottom the rod lies along the hole, ")
    assert "short of leaving the wall (" in text[0]
    whole = " ".join(text)
    assert "there it leaves the wall at" in whole
    assert "Weight and bend press the rod to different sides of this hole" in whole
    assert "buckles" not in whole
    assert "mode 1" not in whole
    assert not any("audit" in step or "verify" in step for step in next_steps(surveyed))


def test_lift_off_ends_the_way_on_both_sides(tilted: rodwell.Answer) -> None:
    lying = tilted.lying
    assert lying is not None
    assert lying.end is not None
    assert len(tilted.critical) == 0
    assert tilted.left_before is not None
    assert tilted.left_before.value == lying.end.force
    assert tilted.left_in_tension is not None
    assert [at.what for at in tilted.assessment.applied] == [STRAIGHT, LEFT, PULLED]
    assert tilted.lift_off_at_own_places is not None
    assert abs(tilted.lift_off_at_own_places.value - lying.end.force) < 0.1  # curvature × shortening
    keys = tilted.key_numbers
    assert keys["lift_off_load"].value == lying.end.force
    assert "window" not in keys
    assert "critical_load_1" not in keys
    data = answer_dict(tilted)
    assert data["critical_loads"] == []
    assert data["lying"]["lowest_force"]["ends_by"] == LIFT_OFF
    assert data["lying"]["highest_force"]["value"] == lying.highest.value
    assert data["assessment"]["states"][0]["shape"] == "along the hole"
    words = {status.subject: status.word for status in statuses(tilted)}
    assert words["Buckling"] == "off the wall"
    assert words["Contact"] == "leaves the wall"


def test_a_level_turn_buckles_at_a_load_of_its_own() -> None:
    """κ₁ = 0.2, walk → 0: −177.320540182, theory of curved holes; the window is that of the hole in a plane."""
    found = bent(90.0, 0.2, 1e-6, applied=[-100.0, -200.0])
    assert found.buckling.value == pytest.approx(-177.320540182, abs=2e-8)
    assert found.key_numbers["buckling_load"].value == found.buckling.value
    assert [at.what for at in found.assessment.applied] == [STRAIGHT, BUCKLED]
    planar = rodwell.follow(found.case.problem.but(walk=0.0), 1, until=-260.0)
    assert planar.lift_off is not None
    width, state = found.assessment.window.width, found.assessment.applied[1].state
    assert width is not None
    assert width.value == pytest.approx(-177.320540182 - planar.lift_off.force, rel=1e-5)
    assert state is not None
    assert state.contact.value == pytest.approx(planar.at(-200.0).wall.contact.value, rel=1e-5)
    assert any("there it buckles; buckled, it stays on the wall" in line for line in sentences(found))


def test_nothing_is_claimed_beyond_what_was_followed(tilted: rodwell.Answer) -> None:
    """The same rod, as if its way had been followed to a load at which nothing had ended it yet."""
    lying = tilted.lying
    assert lying is not None
    short = replace(lying, pressed=rodwell.follow(tilted.case.problem, start=lying.rest, until=-100.0))
    found = rodwell.Answer(tilted.case, tilted.critical, short.branches, short.until, lying=short)
    text = sentences(found)
    assert any("until it is under the end force −100 B/L² at s = 1, and was followed no farther" in one for one in text)
    assert found.lift_off_load is None
    assert found.assessment.window.end is None
    assert "lift_off_load" not in found.key_numbers
    assert "the state of the rod is not known: the rod as it lies was followed no farther than to" in text[0]
    assert {status.subject: status.word for status in statuses(found)}["Buckling"] == "not known"


def test_first_yield_is_found_as_the_rod_lies(surveyed: rodwell.Answer) -> None:
    """The yield strength set to the stress at a load that acts: that load is where it yields."""
    at = surveyed.assessment.applied[1]
    assert at.state is not None
    stress = surveyed.assessment.stress(at.state)
    assert stress is not None
    given = surveyed.case.given
    rod = {**given["rod"], "yield_strength": f"{stress.value} Pa"}
    case = rodwell.Case.from_dict({**given, "rod": rod}, folder=EXAMPLE.parent)
    weaker = rodwell.Answer(case, surveyed.critical, surveyed.branches, surveyed.until, lying=surveyed.lying)
    limit = next(one for one in weaker.assessment.window.limits if one.kind == YIELDS)
    assert limit.force == pytest.approx(at.load.force, rel=1e-6)
    assert not limit.buckled
    assert "; but it yields already at" in " ".join(sentences(weaker))


def test_the_whole_folder(tmp_path: Path) -> None:
    result = CliRunner().invoke(cli, ["run", str(EXAMPLE), "--out", str(tmp_path / "out"), "--quiet"])
    assert result.exit_code == 0, result.output
    names = {file.name for file in (tmp_path / "out").iterdir()}
    assert {"report.html", "answer.json", "rod-3d.html", "wall-loads.svg", "along-rod.csv", "branches.nc"} <= names
    assert not {"cylinder.svg", "modes.svg"} & names
    data = json.loads((tmp_path / "out" / "answer.json").read_text(encoding="utf-8"))
    assert data["lying"]["lowest_force"]["followed_because"] == "the rod lifts off"
    assert "states off the wall" not in data["lying"]["left_out"]
    assert {"load-path.csv", "load-path.svg", "load-path-3d.html"} <= names
    beyond = data["beyond_lift_off"]["events"]
    assert [event["kind"] for event in beyond if event["leg"] == "loading"][:2] == ["lift_off", "gap_opens"]
    assert beyond[-1]["kind"] == "touch_down"
    lowest = data["lying"]["lowest_force"]["value"]
    assert beyond[0]["force"]["value"] == pytest.approx(lowest, rel=1e-8)
    assert beyond[-1]["force"]["value"] == pytest.approx(lowest, rel=1e-8)
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "How the rod lies as the load grows" in page
    assert "straight rod" not in page
    assert "does not buckle before it leaves the wall" in page
    assert "Beyond lift-off" in page
    assert "what it does beyond that is not given" not in page


def test_a_figure_of_what_happens_beyond_lift_off_has_no_two_letters_in_one_place() -> None:
    """Nothing snaps: on the way back the rod comes by lift-off again."""
    path = rodwell.load_path(rodwell.Problem(15.0, build=0.2, walk=0.15), until=-370.0, unload_to=-330.0, seeds=1)
    assert [one.kind for one in path.events] == ["lift_off", "gap_opens", "gap_closes", "touch_down"]
    steps = tuple(Step(one, StateBeyond(one.leg, one.force, one.state, None)) for one in path.events)
    shown = pictured(Beyond(path, "", steps))
    assert [one.load.value for one in shown] == [one.force.value for one in path.events[:2]]
