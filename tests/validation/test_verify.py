"""Engine against SciPy's solve_bvp on the paper's fifteen equations; and that a difference between them is seen."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner
from written import violations

import rodwell
from rodwell import InputError, NotConvergedError, Problem
from rodwell.analysis.branch.verifying import other_program
from rodwell.analysis.branch.verifying import verify as module
from rodwell.cli.main import cli


@pytest.fixture(scope="module")
def branch() -> rodwell.Branch:
    return rodwell.follow(Problem(5.0), until=-90.0)


@pytest.mark.parametrize(("weight", "force"), [(5.0, -120.0), (15.0, -180.0), (40.0, -260.0)])
def test_every_field_agrees_on_the_buckled_branch(weight: float, force: float) -> None:
    result = rodwell.verify(rodwell.follow(Problem(weight), until=force), [force])
    assert result.agrees
    assert result.states[0].differences[result.states[0].worst] < 1e-9
    assert result.lift_off_difference < 1e-10


@pytest.mark.parametrize(
    ("problem", "force"),
    [
        (Problem(30.0, alpha=60.0, twist=1.5), -150.0),
        (Problem(5.0, on_top=True), -40.0),
        (Problem(15.0, alpha=60.0, ends="pinned-free"), -100.0),
        (Problem(15.0, alpha=60.0, ends="guided-clamped"), -140.0),
    ],
    ids=["inclined, twisted", "on top", "pinned, free", "guided, clamped"],
)
def test_other_kinds_agree(problem: Problem, force: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_lift_off", lambda _branch, near, _rtol: near)
    assert rodwell.verify(rodwell.follow(problem, until=force), [force], rtol=1e-7).agrees


def test_a_different_problem_does_not_agree(branch: rodwell.Branch, monkeypatch: pytest.MonkeyPatch) -> None:
    original = other_program.load_of

    def heavier(problem: Problem, force: float):
        load = original(problem, force)
        return load._replace(lateral_weight=load.lateral_weight * (1.0 + 1e-5))

    monkeypatch.setattr(other_program, "load_of", heavier)
    result = rodwell.verify(branch, [-90.0], rtol=1e-7)
    assert not result.states[0].agrees
    assert not result.agrees
    assert result.lift_off_difference > 1e-7


def test_no_convergence_is_no_agreement(branch: rodwell.Branch, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(other_program, "MOST_NODES", 60)
    assert not module._state(branch, -90.0, 1e-8).agrees
    with pytest.raises(NotConvergedError, match="near lift-off"):
        rodwell.verify(branch, [-90.0])


def test_bad_input(branch: rodwell.Branch) -> None:
    with pytest.raises(InputError, match="rtol"):
        rodwell.verify(branch, rtol=0.5)
    with pytest.raises(InputError, match="this branch covers"):
        rodwell.verify(branch, [-500.0])
    other = rodwell.follow(branch.problem, start=branch[-1], parameter="weight", until=6.0)
    with pytest.raises(InputError, match="end force"):
        rodwell.verify(other)


def test_command(tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text('title = "t"\n[dimensionless]\nweight = 5\nalpha = 90\nclearance = 0.01\n')
    result = CliRunner().invoke(cli, ["verify", str(case), "--at", "-85", "--rtol", "1e-6", "--json"])
    assert result.exit_code == 0, result.output
    data = json.loads(result.output)
    assert data["agrees"]
    assert set(data["states"][0]["differences"]) == set(module.NAMES)
    assert data["lift_off"]["relative_difference"] < 1e-6
    shown = CliRunner().invoke(cli, ["verify", str(case), "--at", "-85", "--rtol", "1e-4"])
    assert "All agree." in shown.output
    assert "tension positive" in shown.output
    assert violations(shown.output.splitlines()) == []
