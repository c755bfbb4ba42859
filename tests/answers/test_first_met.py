"""The first load that the straight rod meets where nothing presses it to the wall, and the arm that lifts off first."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from rodwell.analysis.loads.sensitivity import sensitivities
from rodwell.analysis.straight.critical import critical_loads
from rodwell.answers.comparison.exact_loads import exact_loads
from rodwell.answers.result.answer import Answer, answer
from rodwell.answers.result.assessment import LEFT, STRAIGHT
from rodwell.answers.words.advice import statuses
from rodwell.answers.words.first_met import KEPT
from rodwell.answers.words.meaning import sentences
from rodwell.case.case import Case
from rodwell.cli.main import cli
from rodwell.problem.problem import Problem
from rodwell.report.reports.case import case_report
from rodwell.studies.sweep.study import study

INWARDS = -24.17692105  # clamped, T₁ = 5, no weight: complex u⁗ − iT₁u‴ − (Nu′)′ = 0
ONE = {"modes": 2, "rtol": 1e-6}


def case(load: dict[str, Any], **rod: Any) -> Case:
    """A case without dimensions."""
    rod = {"weight": 0, "alpha": 0, "clearance": 0.01} | rod
    return Case.from_dict({"dimensionless": rod, "load": load, "analysis": ONE})


@pytest.fixture(scope="module")
def twisted() -> Answer:
    """A weightless rod under T₁ = 5: straight, between both loads, and beyond that of a rod kept on the wall."""
    return answer(case({"twist": 5, "applied": [-20, -30, -45]}))


def test_beyond_the_load_that_is_met_no_rod_is_straight(twisted: Answer) -> None:
    assert [at.what for at in twisted.assessment.applied] == [STRAIGHT, LEFT, LEFT]
    told = sentences(twisted)
    assert "86.1 % beyond buckling (−24.1769 B/L² there)" in told[0]
    assert "17.3 % short of buckling (−24.1769 B/L² there)" in told[1]
    both = next(text for text in told if text.startswith("Nothing presses this rod to the wall"))
    assert both.count("−24.1769") == 2
    assert "−39.4784" in both
    assert both.endswith(KEPT)


def test_a_rod_in_feet_and_pounds() -> None:
    """⅞ in, 100 ft, 300 ft·lbf, −20 lbf without weight: "straight and stable" it is not, it buckles at 14.5 lbf."""
    data = {
        "rod": {"outer_diameter": "0.875 in", "inner_diameter": "0 in", "material": "steel", "length": "100 ft",
                "weight_per_length": "0 N/m"},
        "hole": {"diameter": "2 in", "angle_from_vertical": "0 deg"},
        "load": {"applied": "-20 lbf", "twist": "300 lbf ft"},
    }  # fmt: skip
    result = answer(Case.from_dict(data).in_units("field"))
    assert result.assessment.applied[0].what == LEFT
    assert "has left the wall, 38.1 % beyond buckling (14.48 lbf there)" in sentences(result)[0]
    assert result.buckling.value * result.case.scales.factor("force") / 4.4482216 == pytest.approx(-14.5, abs=0.05)


def test_both_loads_stand_in_the_data(twisted: Answer) -> None:
    data = twisted.as_dict()
    assert data["critical_loads"] == pytest.approx([INWARDS], rel=1e-9)
    assert data["without_wall"]["loads"] == pytest.approx([INWARDS], rel=1e-9)
    assert data["kept_on_wall"]["loads"][0] == pytest.approx(-39.4784176, rel=1e-9)
    assert data["lift_off"]["force"] == data["critical_loads"][0]
    keys = data["figures"]
    assert keys["first_load_met"]["value"] == keys["critical_load_without_wall"]["value"]
    assert keys["critical_load_1"]["label"] == "Critical load of mode 1 if kept on the wall, end force at s = 1"


def test_window_and_formulas_go_by_the_load_that_is_met(twisted: Answer) -> None:
    window = twisted.assessment.window
    assert window.end is not None
    assert window.end.force == window.buckling.value == twisted.buckling.value
    assert exact_loads(Problem(0, 0, twist=5))[0][0].force == pytest.approx(INWARDS, rel=1e-9)


def test_the_front_page_judges_by_the_load_that_is_met() -> None:
    result = answer(case({"twist": 5, "until": -30}))
    words = {status.subject: (status.level, status.word) for status in statuses(result)}
    assert words["Buckling"] == ("bad", "buckled, off the wall")
    assert words["Contact"] == ("bad", "leaves the wall")


def test_branches_of_a_rod_kept_on_the_wall_say_so(twisted: Answer) -> None:
    report = case_report(twisted)
    points = next(s for s in report.sections if s.title == "Special points of every branch")
    assert points.blocks[-1].text == KEPT  # type: ignore[union-attr]
    assert not any(text == KEPT for text in sentences(answer(case({"applied": -20}))))


def test_a_diagram_of_a_rod_kept_on_the_wall_says_so(tmp_path: Path) -> None:
    options = [
        "diagram",
        "--weight",
        "0",
        "--alpha",
        "0",
        "--until",
        "-45",
        "--rtol",
        "1e-4",
        "--out",
        str(tmp_path / "a"),
    ]
    for twist, said in (("5", True), ("0", False)):
        text = " ".join(CliRunner().invoke(cli, [*options, "--twist", twist]).output.split())
        assert (KEPT in text) == said


def test_the_load_that_is_met_has_its_derivatives(twisted: Answer) -> None:
    load = twisted.sensitivities[-1]
    assert load.name == "load at which it buckles"
    up, down = (critical_loads(Problem(0, 0, twist=t), 1).first_met.force for t in (5.001, 4.999))
    assert load.derivatives["twist"].value == pytest.approx((up - down) / 0.002, rel=1e-5)
    # F = (B/L²) f(T L/B): of the torque the stiffness and the length take a part each
    e, part = load.elasticities(), 5.0 * load.derivatives["twist"].value / load.force
    assert e["stiffness"].value == pytest.approx(1.0 - part)
    assert e["length"].value == pytest.approx(part - 2.0)
    assert [one.name for one in sensitivities(Problem(0, 0, twist=5))][-1] == load.name
    assert "twist" not in sensitivities(Problem(0, 0))[-1].derivatives


def test_a_study_takes_the_load_that_is_met() -> None:
    rod = {"weight": 0, "alpha": 0, "clearance": 0.01}
    found = study({"dimensionless": rod, "load": {"twist": [0, 5], "applied": -30}})
    plain, twisted = found.points
    assert plain.critical is not None
    assert twisted.critical is not None
    assert (plain.critical.value, twisted.critical.value) == pytest.approx((-39.4784176, INWARDS), rel=1e-8)
    assert twisted.lift_off is not None
    assert twisted.lift_off.value == pytest.approx(INWARDS, rel=1e-8)
    assert [point.loads[0].what for point in found.points] == [STRAIGHT, LEFT]


def test_weight_keeps_a_rod_on_the_wall_only_where_it_does() -> None:
    pressed = answer(case({"twist": 5}, weight=15, alpha=90))
    assert any(text.startswith("Its weight keeps the straight rod on the wall") for text in sentences(pressed))
    assert pressed.buckling.value == pressed.critical[0].force
    without = pressed.as_dict()["without_wall"]["loads"]
    assert without == pytest.approx([INWARDS], rel=1e-8)  # horizontal: the axial weight is nothing
    assert not any("keeps the straight rod" in text for text in sentences(answer(case({"twist": 5}))))


def test_twist_that_needs_tension() -> None:
    result = answer(case({"twist": 10, "applied": 1}))
    assert result.buckling.value > 1.0
    assert result.assessment.applied[0].what == LEFT
    assert any(text.startswith("The rod buckles under its twist: it stays straight only") for text in sentences(result))


def test_twist_so_large_that_the_wall_s_help_is_not_computed() -> None:
    result = answer(case({"twist": 250}))
    assert result.buckling.value == result.without_wall.force > 0.0


ARMS = (-133.0206448, -160.5143868)


def test_the_arm_that_lifts_off_first_counts() -> None:
    result = answer(case({"twist": 4}, weight=30, alpha=60))
    assert result.lift_off_load is not None
    assert result.lift_off_load.value == pytest.approx(ARMS[0], rel=1e-6)
    data = result.as_dict()
    assert data["other_arm"]["force"] == pytest.approx(ARMS[1], rel=1e-6)
    assert data["figures"]["lift_off_load_other_arm"]["value"] == pytest.approx(ARMS[1], rel=1e-6)
    told = next(text for text in sentences(result) if "Twist makes the two arms of the mode differ" in text)
    assert "the other lifts off at the end force −160.514 B/L² at s = 1, and is stable at first" in told


def test_the_mirror_arm_counts_under_the_opposite_twist() -> None:
    result = answer(case({"twist": -4, "until": -170}, weight=30, alpha=60))
    assert result.first.origin.mirror
    assert result.lift_off_load is not None
    assert result.lift_off_load.value == pytest.approx(ARMS[0], rel=1e-6)
    assert result.first.reached_end


def test_without_twist_there_is_one_arm() -> None:
    assert answer(case({}, weight=30, alpha=60)).as_dict()["other_arm"] is None


def test_command_liftoff_shows_both_arms() -> None:
    options = ["liftoff", "--weight", "30", "--alpha", "60", "--twist", "4"]
    text = CliRunner().invoke(cli, options).output
    assert "lift-off            −133.0206448" in text
    assert "on the other arm    −160.5143868" in text
    assert "the one that lifts off first, at −133.0206448" in " ".join(text.split())
    data = json.loads(CliRunner().invoke(cli, [*options, "--mirror", "--json"]).output)
    assert (data["lift_off"]["force"], data["other_arm"]["force"]) == pytest.approx(ARMS[::-1], rel=1e-9)
    assert json.loads(CliRunner().invoke(cli, [*options[:-2], "--json"]).output)["other_arm"] is None


def test_command_liftoff_where_nothing_presses_the_rod() -> None:
    data = json.loads(
        CliRunner().invoke(cli, ["liftoff", "--weight", "0", "--alpha", "0", "--twist", "5", "--json"]).output
    )
    assert data["lift_off"]["force"] == pytest.approx(INWARDS, rel=1e-9)
