"""A wall that gives way in case files: [hole] wall_stiffness, in N/m², counts beyond lift-off, and says so."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from rodwell import Case, InputError, Problem, answer, audit, load_path
from rodwell import map as rodwell_map
from rodwell.answers.data.beyond import beyond_dict
from rodwell.answers.result import beyond
from rodwell.answers.words.meaning import sentences
from rodwell.cli.main import cli
from rodwell.errors import InputWarning

STIFF = 1e6
DIMENSIONLESS = {"dimensionless": {"weight": 15.0, "alpha": 90.0, "wall_stiffness": STIFF}}


def physical(**hole: Any) -> Case:
    rod = {"length": "10 m", "bending_stiffness": "1e3 N m^2", "weight_per_length": "15 N/m"}
    return Case.from_dict({"rod": rod, "hole": {"clearance": "10 cm", "angle_from_vertical": "90 deg", **hole}})


def test_the_stiffness_by_hand() -> None:
    """k L⁴/B: 1e5 N/m² · 1e4 m⁴ / 1e3 N m² = 1e6."""
    assert physical(wall_stiffness="1e5 N/m^2").wall_stiffness == pytest.approx(1e6)
    assert physical(wall_stiffness="0.1 MPa").wall_stiffness == pytest.approx(1e6)
    assert physical().wall_stiffness == math.inf
    assert Case.from_dict(DIMENSIONLESS).wall_stiffness == STIFF
    with pytest.raises(InputError, match="above 0"):
        Case.from_dict({"dimensionless": {"weight": 15.0, "wall_stiffness": -1.0}})
    with pytest.raises(InputError, match="needs a unit"):
        physical(wall_stiffness=1e5)


def test_an_answer_follows_the_rod_behind_it_and_says_what_does_not_know_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beyond, "reach", lambda _: (-124.5, -124.0))  # not as far as a report goes
    case = Case.from_dict({**DIMENSIONLESS, "analysis": {"modes": 1}})
    found = answer(case)
    text = " ".join(sentences(found))
    assert "1\u202f000\u202f000 B/L⁴ of push per length and depth" in text
    assert "takes the wall as rigid" in text
    path = found.beyond.path
    assert path is not None
    assert path.wall_stiffness == STIFF
    alone = load_path(Problem(15.0), until=path.until, wall_stiffness=STIFF, seeds=1)
    for kind in ("critical", "lift_off"):
        mine, theirs = path.first(kind), alone.first(kind)
        assert mine is not None
        assert theirs is not None
        assert mine.force.value == pytest.approx(theirs.force.value, rel=1e-8)
    data = beyond_dict(case, found.beyond)
    assert data["wall_stiffness"] == STIFF
    assert "wall of stiffness" in data["assumptions"]


def test_a_path_of_a_case(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text(
        'rod = {length = "10 m", bending_stiffness = "1e3 N m^2", weight_per_length = "15 N/m"}\n'
        'hole = {clearance = "10 cm", angle_from_vertical = "90 deg", wall_stiffness = "1e5 N/m^2"}\n'
    )
    done = CliRunner().invoke(cli, ["path", str(file), "--until", "-1.2 kN", "--seeds", "1", "--json"])
    assert done.exit_code == 0, done.output
    data = json.loads(done.stdout)
    assert data["wall_stiffness"] == pytest.approx(1e6)
    assert data["unit_N"] == pytest.approx(10.0)
    assert [event["kind"] for event in data["events"]] == ["critical"]
    assert data["events"][0]["force"]["value"] == pytest.approx(-111.23344016, rel=0.01)
    for wrong in (["--until", "-1.2"], ["--weight", "3", "--until", "-1.2 kN"]):
        refused = CliRunner().invoke(cli, ["path", str(file), *wrong])
        assert isinstance(refused.exception, InputError)


def test_commands_on_the_wall_say_that_they_leave_it_aside(tmp_path: Path) -> None:
    file = tmp_path / "case.toml"
    file.write_text("[dimensionless]\nweight = 15\nalpha = 90\nwall_stiffness = 1e6\n")
    done = CliRunner().invoke(cli, ["export", str(file), "--at", "-120", "--to", str(tmp_path / "rod.csv")])
    assert done.exit_code == 0, done.output
    assert "wall_stiffness is left aside" in done.stderr


def test_functions_on_the_wall_say_it_too() -> None:
    with pytest.warns(InputWarning, match="wall_stiffness is left aside"):
        audit(Case.from_dict(DIMENSIONLESS))
    with pytest.warns(InputWarning, match="wall_stiffness is left aside"):
        rodwell_map(DIMENSIONLESS, "critical", over={"dimensionless.weight": [15.0, 16.0]}, halvings=0)
