"""Exit code 3, and one line on standard error, where a number that is shown misses its tolerance."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from bad_commands import Run

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.special import LIFT_OFF, SpecialPoint
from rodwell.analysis.curves.curve import CurvePoint
from rodwell.analysis.loads.by_inclination import Loads, loads_at
from rodwell.analysis.straight.without_wall import LoadsWithoutWall
from rodwell.answers.comparison.exact_loads import ExactLoad
from rodwell.answers.data.tables import MISSES, answer_tables
from rodwell.answers.result.answer import answer
from rodwell.answers.result.missed import missed
from rodwell.case.case import Case
from rodwell.report.reports.case import case_report
from rodwell.studies.well import screening

ROOT = Path(__file__).parents[2]
ROD = ["--weight", "15", "--alpha", "90", "--rtol", "1e-4"]
CASE = "[dimensionless]\nweight = 15\nalpha = 90\n[analysis]\nmodes = 1\nrtol = 1e-4\noff_wall = false\n"
ROD_AND_TOLERANCE = {"dimensionless": {"weight": 15, "alpha": 90}, "analysis": {"modes": 1, "rtol": 1e-4}}
STUDY = "study = true\n" + CASE.replace("alpha = 90", "alpha = [89, 90]")


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def lift_off_missed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every lift-off is known too badly."""
    meets = Branch.meets_tolerance

    def rough(branch: Branch, point: SpecialPoint) -> bool:
        return point.kind != LIFT_OFF and meets(branch, point)

    monkeypatch.setattr(Branch, "meets_tolerance", rough)


BRANCHES = {
    "liftoff": ["liftoff", *ROD],
    "liftoff-json": ["liftoff", *ROD, "--json"],
    "diagram": ["diagram", *ROD, "--until", "-130", "--modes", "1"],
    "diagram-json": ["diagram", *ROD, "--until", "-130", "--modes", "1", "--json"],
    "run": ["run", "case.toml"],
    "run-quiet": ["run", "case.toml", "--quiet"],
    "sensitivity": ["sensitivity", *ROD],
    "sensitivity-json": ["sensitivity", *ROD, "--json"],
    "twist": ["twist", "--weight", "30", "--alpha", "90", "--rtol", "1e-4"],
    "study": ["run", "study.toml", "--json"],
}


@pytest.mark.parametrize("command", BRANCHES.values(), ids=BRANCHES.keys())
@pytest.mark.usefixtures("files", "lift_off_missed", "nothing_drawn")
def test_a_lift_off_that_misses_its_tolerance(command: list[str], rodwell: Run) -> None:
    code, out, err = rodwell(*command)
    assert code == 3
    assert err.startswith("rodwell: tolerance missed: ")
    assert "lift-off" in err or "lifts off" in err
    assert err.endswith("(rtol 0.0001)\n")
    assert err.count("\n") == 1
    assert bool(out) == ("--quiet" not in command)


@pytest.mark.parametrize("command", BRANCHES.values(), ids=BRANCHES.keys())
@pytest.mark.usefixtures("files", "nothing_drawn")
def test_all_is_well(command: list[str], rodwell: Run) -> None:
    assert rodwell(*command)[::2] == (0, "")


OTHERS = {
    "curve": (CurvePoint, "converged", ["curve", "lift-off", *ROD, "--over", "weight", "--from", "15", "--to", "16"]),
    "audit": (ExactLoad, "meets", ["audit", "case.toml", "--no-chart"]),
    "critical": (LoadsWithoutWall, "scale", ["critical", *ROD[:2], "--weight", "0", "--alpha", "0", "--twist", "5"]),
}
VALUES: dict[str, Any] = {
    "curve": property(lambda _: False, lambda _, _given: None),
    "audit": lambda *_: False,
    "critical": -24.17692105,
}


@pytest.mark.parametrize("name", OTHERS)
@pytest.mark.usefixtures("files")
def test_other_numbers_that_miss_their_tolerance(name: str, monkeypatch: pytest.MonkeyPatch, rodwell: Run) -> None:
    owner, what, command = OTHERS[name]
    assert rodwell(*command)[::2] == (0, "")
    monkeypatch.setattr(owner, what, VALUES[name], raising=False)
    code, out, err = rodwell(*command)
    assert code == 3
    assert out
    assert err.startswith("rodwell: tolerance missed: ")
    assert err.count("\n") == 1


@pytest.mark.usefixtures("lift_off_missed")
def test_tables_and_report_say_which_point_it_is() -> None:
    result = answer(
        Case.from_dict({"dimensionless": {"weight": 15, "alpha": 90}, "analysis": {"modes": 1, "rtol": 1e-4}})
    )
    assert not result.converged
    assert missed(result)[0].startswith("mode 1: lift-off at force = −123.17")
    points = answer_tables(result)[1]
    assert points.columns[-1] == "remark"
    assert [row[-1] for row in points.rows] == [None, MISSES, None]
    section = next(s for s in case_report(result).sections if s.title == "Special points of every branch")
    assert [row[-1] for row in section.blocks[0].rows] == ["", "misses the tolerance", ""]  # type: ignore[union-attr]
    data = result.as_dict()["branches"][0]["special_points"]
    assert [point["converged"] for point in data] == [True, False, True]


def test_without_a_miss_there_is_no_remark() -> None:
    result = answer(
        Case.from_dict({"dimensionless": {"weight": 15, "alpha": 90}, "analysis": {"modes": 1, "rtol": 1e-4}})
    )
    assert result.converged
    assert not missed(result)
    assert "remark" not in answer_tables(result)[1].columns


@pytest.mark.parametrize("json", [[], ["--json"]])
def test_a_station_whose_load_misses_its_tolerance(
    json: list[str], files: Path, monkeypatch: pytest.MonkeyPatch, rodwell: Run
) -> None:
    (files / "well.csv").write_text("MD [m],Inclination [deg]\n0,60\n100,61\n", encoding="utf-8")
    line = ["screen", "well.csv", "--case", str(ROOT / "examples" / "well-string.toml"), *json]
    assert rodwell(*line)[0] == 0

    def rough(*arguments: Any) -> Loads:
        loads = loads_at(*arguments)
        return replace(loads, errors=0.02 * loads.values)

    monkeypatch.setattr(screening, "loads_at", rough)
    code, out, err = rodwell(*line)
    assert code == 3
    assert err == "rodwell: tolerance missed: critical load at station 1 ± 2 %, and 1 more (rtol 0.001)\n"
    assert ("stations_missing_the_tolerance" in out) == bool(json)
