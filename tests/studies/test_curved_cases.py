"""What commands make of a case in a curved hole: audit and study take it, reports with strength and packers refuse."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from rodwell import Case, InputError, Problem, answer, packer
from rodwell.answers.comparison.beside import load_rows
from rodwell.answers.comparison.exact_loads import critical
from rodwell.cli.main import cli
from rodwell.formulas import FORMULAS
from rodwell.studies.sweep.study import study

ROD = {"outer_diameter": "127 mm", "inner_diameter": "108.6 mm", "material": "steel", "length": "30 m"}
HOLE = {"diameter": "216 mm", "angle_from_vertical": "90 deg", "build": "6 deg/30 m"}


def test_formulas_take_the_curvature_of_the_hole_and_are_held_against_its_exact_load() -> None:
    """κ = 0.2, w = 15, D = 0.01, clamped, horizontal: −177.320540182, theory of curved holes by two programs."""
    problem = Problem(15.0, 90.0, build=0.2)
    load = critical(problem)
    assert load.force == pytest.approx(-177.320540182, abs=1e-6)
    rows = {row.formula.key: row for row in load_rows(problem, (load,))}
    bent = rows["he_kyllingstad"]
    w, r = 15.0, 0.01  # He and Kyllingstad: F² = 4 (B/r) √((w sin α + F κ)²), the weight and the bend pressing together
    assert bent.value is not None
    assert bent.value**2 == pytest.approx(4.0 / r * (w + bent.value * 0.2), rel=1e-9)
    assert {pair.place: pair for pair in bent.comparisons}["top"].percent == pytest.approx(
        100.0 * (bent.value / -load.force - 1.0), rel=1e-9
    )
    assert "for straight holes, and this one is curved" in rows["dawson_paslay"].reasons
    with pytest.raises(InputError, match="given twice: the hole of the problem is curved"):
        load_rows(problem, (load,), {"build": 0.2})
    assert FORMULAS["he_kyllingstad"].takes


@pytest.mark.parametrize(("option", "key"), [("--build", "hole.build"), ("--turn", "hole.walk")])
def test_the_old_meaning_of_build_and_turn_is_refused_with_the_remedy(tmp_path: Path, option: str, key: str) -> None:
    case = tmp_path / "case.toml"
    case.write_text("[dimensionless]\nweight = 15\n", encoding="utf-8")
    result = CliRunner().invoke(cli, ["audit", str(case), option, "3"])
    assert isinstance(result.exception, InputError)
    assert f"write {option}-angle 3" in result.exception.reason
    assert key in result.exception.reason


def test_a_range_of_build_is_computed_point_by_point(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    lines = [f'{name} = "{value}"' for name, value in ROD.items()]
    file.write_text(
        "\n".join(["[rod]", *lines, "[hole]", 'diameter = "216 mm"', 'angle_from_vertical = "90 deg"',
                   'build = "0..6 deg/30 m in 2"', "[analysis]", "rtol = 1e-6"]), encoding="utf-8",
    )  # fmt: skip
    straight, bent = study(file).points
    assert straight.critical is not None
    assert bent.critical is not None
    assert bent.critical.value < straight.critical.value  # more compression: a build presses the rod to its low side
    assert bent.without_wall is None
    assert bent.lift_off is not None
    problem = Case.from_dict({"rod": ROD, "hole": HOLE}).problem
    assert problem.build == pytest.approx(math.radians(6.0))
    assert bent.critical.value == pytest.approx(critical(problem).force, rel=1e-6)


@pytest.mark.parametrize("what", [answer, packer])
def test_what_has_no_bending_by_the_hole_refuses(what: Any) -> None:
    more = {"packer": {"bore": "82 mm", "motion": "all"}} if what is packer else {}
    with pytest.raises(InputError, match="curved"):
        what(Case.from_dict({"rod": ROD, "hole": HOLE} | more))
