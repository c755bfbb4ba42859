"""Loads that lie beyond what is followed by itself, or beyond what can be followed: they lose nothing else."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rodwell.answers.result.answer import Answer, answer
from rodwell.answers.result.assessment import LEFT, STRAIGHT, UNKNOWN
from rodwell.answers.result.reach import passes
from rodwell.answers.words.advice import next_steps, statuses
from rodwell.answers.words.meaning import sentences
from rodwell.case.case import Case
from rodwell.cli.main import cli
from rodwell.report.reports.case import case_report
from rodwell.studies.sweep.study import study

STEEP = {"weight": 16.5, "alpha": 90, "clearance": 0.3}
ONE = {"modes": 1, "rtol": 1e-4}


def case(load: dict[str, Any], **rod: float) -> Case:
    """A case without dimensions, of one mode at a coarse tolerance."""
    rod = {"weight": 15, "alpha": 90, "clearance": 0.01} | rod
    return Case.from_dict({"dimensionless": rod, "load": load, "analysis": ONE})


@pytest.mark.parametrize(
    ("rod", "load"),
    [
        ({}, -280.0),
        ({"weight": 0}, -285.0),
        ({"weight": 1000, "alpha": 0}, 100.0),
    ],
)
def test_the_branch_goes_on_to_a_load_that_acts(rod: dict[str, float], load: float) -> None:
    result = answer(case({"applied": load}, **rod))
    at = result.assessment.applied[0]
    assert (at.what, at.reached, at.why) == (LEFT, True, "")
    assert passes(result.first, load)
    assert result.until > load  # other modes are not followed so far


def test_the_branch_goes_on_to_a_load_in_newtons() -> None:
    rod = {"outer_diameter": "8.625 in", "inner_diameter": "7.375 in", "material": "steel", "length": "100 m"}
    hole = {"diameter": "11.5 in", "angle_from_vertical": "90 deg"}
    data = {"rod": rod, "hole": hole, "load": {"applied": "-2 MN"}, "analysis": ONE}
    at = answer(Case.from_dict(data)).assessment.applied[0]
    assert (at.what, at.reached) == (LEFT, True)


@pytest.fixture(scope="module")
def steep() -> Answer:
    """The branch ends at −59.5 B/L², where the rod turns across the cylinder."""
    return answer(case({"applied": [-30, -55, -65, -80]}, **STEEP))


def test_what_cannot_be_reached_is_said_once_for_each_reason(steep: Answer) -> None:
    at = steep.assessment.applied
    assert [one.what for one in at] == [STRAIGHT, LEFT, LEFT, LEFT]
    assert [one.reached for one in at] == [True, True, False, False]
    told = [text for text in sentences(steep) if "Not reached" in text]
    assert len(told) == 1
    assert told[0].startswith(
        "Not reached: the end force −65 B/L² at s = 1; the end force −80 B/L² at s = 1: the branch of mode 1 goes no"
    )
    assert "−59.5" in told[0]
    assert "the rod turned across the cylinder" in told[0]


def test_what_cannot_be_reached_stands_in_the_data_and_the_report(steep: Answer) -> None:
    applied = steep.as_dict()["assessment"]["applied"]
    assert [one["reached"] for one in applied] == [True, True, False, False]
    assert [bool(one["why"]) for one in applied] == [False, False, True, True]
    section = next(s for s in case_report(steep).sections if s.title == "At the loads that act")
    assert "Not reached: the end force −65 B/L²" in section.blocks[-1].text  # type: ignore[union-attr]


def test_the_front_page_judges_a_load_out_of_reach(steep: Answer) -> None:
    by_subject = {status.subject: status for status in statuses(steep)}
    assert (by_subject["Buckling"].level, by_subject["Buckling"].word) == ("bad", "buckled, shape not known")
    assert by_subject["Contact"].word == "leaves the wall"
    assert next_steps(steep)


def test_without_lift_off_nothing_is_said_to_stay_on_the_wall(monkeypatch: pytest.MonkeyPatch) -> None:
    """A branch that ends on the wall before the load: its state there is not known."""
    monkeypatch.setattr("rodwell.analysis.branch.watching.MOST_WORK", 1000.0)  # it ends before it lifts off
    result = answer(case({"applied": [-100, -122]}))
    first, last = result.assessment.applied
    assert (first.what, last.what, last.reached) == (STRAIGHT, UNKNOWN, False)
    assert "the work allowed for one branch is used up" in last.why
    text = sentences(result)[0]
    assert text.startswith("At −122 B/L² at s = 1 (compression) the state of the rod is not known: the branch")
    window = next(s for s in case_report(result).sections if s.title.startswith("The safe window"))
    assert "No lift-off was found down to the end force −11" in window.blocks[0].text  # type: ignore[union-attr]
    words = {status.subject: (status.level, status.word) for status in statuses(result)}
    assert words["Buckling"] == ("bad", "buckled, shape not known")
    assert words["Contact"] == ("bad", "not known")


def test_an_end_that_is_out_of_reach_loses_nothing() -> None:
    result = answer(case({"until": -65}, **STEEP))
    assert result.lift_off is not None
    until = result.as_dict()["until"]
    assert (until["force"]["value"], until["reached"]) == (-65.0, False)
    assert any(text.startswith("Not reached: the end force −65 B/L² at s = 1, asked for") for text in sentences(result))
    assert answer(case({"until": -50}, **STEEP)).as_dict()["until"] | {"force": 0} == {
        "force": 0, "reached": True, "why": "",
    }  # fmt: skip


def test_a_load_larger_than_can_be_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rodwell.analysis.branch.watching.MOST_WORK", 20000.0)
    result = answer(case({"applied": -1e12}))
    assert not result.assessment.applied[0].reached
    assert result.lift_off is not None


def test_loads_of_a_study_that_are_out_of_reach() -> None:
    rod = STEEP | {"alpha": [80, 90]}
    found = study({"dimensionless": rod, "load": {"applied": [-30, -65, -80]}, "analysis": {"rtol": 1e-4}})
    assert [[one.what for one in point.loads] for point in found.points] == [[STRAIGHT, LEFT, LEFT]] * 2
    assert not found.incomplete


def test_a_study_whose_branches_end_early(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rodwell.analysis.branch.watching.MOST_WORK", 1000.0)
    found = study({
        "dimensionless": {"weight": [14, 15], "alpha": 90, "clearance": 0.01}, "load": {"applied": [-100, -125]},
        "analysis": {"rtol": 1e-4},
    })  # fmt: skip
    for point in found.as_dict()["points"]:
        assert [one["reached"] for one in point["applied"]] == [True, False]
        assert "goes no farther than" in point["applied"][1]["why"]
        assert "is used up" in point["reasons"]["lift_off"]


@pytest.fixture
def steep_file(tmp_path: Path) -> Path:
    file = tmp_path / "steep.toml"
    rod = "\n".join(f"{name} = {value}" for name, value in STEEP.items())
    file.write_text(f"[dimensionless]\n{rod}\n[analysis]\nrtol = 1e-4\n", encoding="utf-8")
    return file


def test_verify_compares_what_is_reached(steep_file: Path) -> None:
    options = ["verify", str(steep_file), "--at", "-44.2", "--at", "-80", "--rtol", "1e-4", "--json"]
    result = CliRunner().invoke(cli, options)
    assert result.exit_code == 0, result.output
    data = json.loads(result.stdout)
    assert [state["force"] for state in data["states"]] == [-44.2]
    assert [(one["force"], one["reached"]) for one in data["not_reached"]] == [(-80.0, False)]
    assert "goes no farther than the end force −59.5" in data["not_reached"][0]["why"]


@pytest.mark.parametrize("command", [["verify"], ["export", "--to", "rod.csv"]])
def test_a_single_load_out_of_reach_is_named_as_it_was_written(steep_file: Path, command: list[str]) -> None:
    result = CliRunner().invoke(cli, [command[0], str(steep_file), *command[1:], "--at", "-80"])
    assert str(result.exception).startswith("--at = -80 cannot be reached: the branch of mode 1 goes no farther than")


@settings(max_examples=6, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(
    weight=st.sampled_from([0.0, 1.0, 15.0, 62.0, 300.0]),
    alpha=st.sampled_from([0.0, 5.0, 44.0, 89.0, 90.0]),
    clearance=st.sampled_from([0.002, 0.01, 0.3]),
    loads=st.lists(st.floats(-600.0, 500.0, allow_nan=False), min_size=1, max_size=3),
)
def test_no_load_raises(weight: float, alpha: float, clearance: float, loads: list[float]) -> None:
    result = answer(case({"applied": loads}, weight=weight, alpha=alpha, clearance=clearance))
    assert all(at.reached or at.why for at in result.assessment.applied)
    assert sentences(result)
    assert len(statuses(result)) >= 3
    assert all(math.isfinite(key.value) for key in result.key_numbers.values())
