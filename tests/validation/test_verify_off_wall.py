"""States off the wall against balance in space, by SciPy's solve_bvp; and that a difference is seen.

The other program has its own equations (theory-2, §1), unknowns, mesh and Newton's method.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import rodwell
from rodwell import InputError, Problem
from rodwell.analysis.beyond import other_program
from rodwell.analysis.branch.verifying import verify as module
from rodwell.cli.main import cli
from rodwell.quantities.arrays import FloatArray


@pytest.fixture(autouse=True)
def _without_lift_off(monkeypatch: pytest.MonkeyPatch) -> None:
    """The load of lift-off is what tests/validation/test_verify.py is for."""
    monkeypatch.setattr(module, "_lift_off", lambda _branch, near, _rtol: near)


def beyond_of(problem: Problem, until: float) -> rodwell.Branch:
    branch = rodwell.follow(problem, 1, until=until, mirror=problem.twist != 0.0, off_wall=True)
    assert branch.beyond is not None
    return branch


@pytest.mark.parametrize(
    ("problem", "until", "force", "pattern"),
    [
        (Problem(15.0), -131.0, -123.7, "=-="),
        (Problem(15.0), -147.0, -146.0, "-·-·-"),
        (Problem(15.0, twist=3.0), -125.0, -124.3, "=-="),
        (Problem(60.0, alpha=60.0), -206.0, -205.0, "=-="),
    ],
    ids=["a gap", "points of contact", "twist", "inclined"],
)
def test_states_agree(problem: Problem, until: float, force: float, pattern: str) -> None:
    branch = beyond_of(problem, until)
    assert branch.beyond is not None
    assert branch.beyond.at(force).fine.pattern.text() == pattern
    (found,) = rodwell.verify(branch, [force], rtol=1e-7).states
    assert found.off_wall
    assert found.agrees
    pressed = found.differences.pop("contact_pressure")  # third derivatives: the engine knows fewer digits of them
    assert pressed < 1e-5
    assert max(found.differences.values()) < 1e-7
    assert found.differences["ends of stretches"] < 1e-9


def test_a_different_rod_does_not_agree(monkeypatch: pytest.MonkeyPatch) -> None:
    branch, gap = beyond_of(Problem(15.0), -125.0), other_program._Chain._in_gap
    assert branch.beyond is not None

    def heavier(self: Any, v: FloatArray, n: FloatArray) -> FloatArray:
        out = gap(self, v, n)
        out[6] *= 1.0 + 1e-4
        return out

    monkeypatch.setattr(other_program._Chain, "_in_gap", heavier)
    (found,) = rodwell.verify(branch, [-123.7], rtol=1e-7).states
    assert not found.agrees


def test_what_it_does_not_know() -> None:
    for problem, field in (
        (Problem(15.0, ends="clamped-guided"), "ends"),
        (Problem(15.0, sections=((0.5, 1.0, 1.0), (0.5, 1.0, 2.0))), "sections"),
    ):
        with pytest.raises(InputError) as caught:
            other_program.check_known(problem)
        assert caught.value.field == field


def test_on_the_command_line(tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text("[dimensionless]\nweight = 15\n", encoding="utf-8")
    asked = ("verify", str(case), "--off-wall", "--at", "-123.7", "--at", "-160", "--rtol", "1e-7", "--json")
    done = CliRunner().invoke(cli, asked)
    assert done.exit_code == 0, done.output
    data = json.loads(done.output)
    (state,) = data["states"]
    assert state["off_wall"]
    assert state["agrees"]
    assert state["differences"]["ends of stretches"] < 1e-9
    assert "off the wall the branch covers" in data["not_reached"][0]["why"]
