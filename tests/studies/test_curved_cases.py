"""What commands make of a case in a curved hole: audit and study take it, tubing in packers is refused."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from click.testing import CliRunner

from rodwell import Case, InputError, Problem, audit, equilibrium, lying_rod, packer
from rodwell.answers.comparison.beside import load_rows
from rodwell.answers.comparison.exact_loads import critical
from rodwell.answers.result.assessment import LEFT, PULLED, STRAIGHT
from rodwell.cli.main import cli
from rodwell.formulas import FORMULAS
from rodwell.report.reports.audit import conditions
from rodwell.studies.sweep.study import study
from rodwell.studies.sweep.tables import holes, sentences, study_table

ROOT = Path(__file__).parents[2]
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


def test_of_a_long_string_in_a_surveyed_well_only_the_lower_end_matters(tmp_path: Path) -> None:
    """120 joints, 1,164 m, and the lowest 30 of them buckle at the same compression at the lower end.

    The inclination at stations 30 m apart wavers about 60°, so the curvature of the hole changes its sign some twenty
    times along the string; what is above the buckled part does not matter.
    """
    rows = [f"{30 * i},{60.0 + 0.2 * math.sin(1.7 * i):.4f},40" for i in range(101)]
    (tmp_path / "well.csv").write_text("MD [m],Inc [deg],Azi [deg]\n" + "\n".join(rows), encoding="utf-8")
    lower = []
    for joints in (120, 30):
        string = {"pipe": "5 in 19.5 lb/ft drill pipe", "joints": joints, "joint_length": "9.7 m"}
        hole = {"diameter": "8.5 in", "survey": "well.csv", "to": "2990 m"}
        data = {"string": [string], "rod": {"ends": "clamped-clamped"}, "hole": hole, "mud": {"density": "10 lb/gal"}}
        found = Case.from_dict(data, folder=tmp_path).problem
        mode = critical(found)
        assert mode.error < 1e-7 * abs(mode.force)
        lower.append((found.hung_weight - mode.force) / joints**2)
    assert lower[0] == pytest.approx(lower[1], rel=1e-6)


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
    found = study(file)
    straight, bent = found.points
    assert straight.critical is not None
    assert bent.critical is not None
    assert bent.critical.value < straight.critical.value  # more compression: a build presses the rod to its low side
    assert bent.without_wall is None
    assert bent.lift_off is not None
    assert holes(found) == "straight hole at 1 point, curved hole at 1 point"
    assert any("straight hole at 1 point, curved hole at 1 point" in note for note in study_table(found).notes)
    problem = Case.from_dict({"rod": ROD, "hole": HOLE}).problem
    assert problem.build == pytest.approx(math.radians(6.0))
    assert bent.critical.value == pytest.approx(critical(problem).force, rel=1e-6)


def test_a_study_assesses_the_loads_that_act(tmp_path: Path) -> None:
    """Stress at a load that acts, in a study as in the answer of each case: closed form of the hole's own bending."""
    file = tmp_path / "study.toml"
    lines = [f'{name} = "{value}"' for name, value in ROD.items()]
    file.write_text(
        "\n".join(["[rod]", *lines, "[hole]", 'diameter = "216 mm"', 'angle_from_vertical = "90 deg"',
                   'build = "3..6 deg/30 m in 2"', "[load]", 'applied = ["-50 kN", "300 kN tension"]',
                   "[analysis]", "rtol = 1e-6"]), encoding="utf-8",
    )  # fmt: skip
    for point in study(file).points:
        pushed, pulled = point.loads
        assert (pushed.what, pulled.what) == (STRAIGHT, PULLED)
        problem, scales = point.case.problem, point.case.scales
        assert scales is not None
        assert pushed.stress is not None
        curvature = problem.build / (1.0 + problem.build * problem.clearance) / scales.length
        area, inertia = math.pi / 4.0 * (0.127**2 - 0.1086**2), math.pi / 64.0 * (0.127**4 - 0.1086**4)
        bending = scales.stiffness * curvature * 0.0635 / inertia
        sag = (1.0 - math.cos(0.5 * curvature * scales.length)) / curvature  # the middle lies lowest and bears most
        hung = problem.weight * scales.factor("force_per_length") * sag
        axial = (50e3 + hung + scales.stiffness * curvature**2) / area
        assert pushed.stress.value == pytest.approx(axial + bending, rel=1e-9)


def test_a_study_takes_holes_that_leave_the_vertical_plane(tmp_path: Path) -> None:
    """Each point as the answer of its case has it: no critical load, where the rod leaves the wall, and stress."""
    file = tmp_path / "study.toml"
    lines = [f'{name} = "{value}"' for name, value in ROD.items()]
    file.write_text(
        "\n".join(["[rod]", *lines, "[hole]", 'diameter = "216 mm"', 'angle_from_vertical = "90 deg"',
                   'walk = "6..8 deg/30 m in 2"', "[load]", 'applied = ["-20 kN", "-3 MN"]',
                   "[analysis]", "rtol = 1e-6"]), encoding="utf-8",
    )  # fmt: skip
    found = study(file)
    for point in found.points:
        assert point.case is not None
        assert point.critical is None
        assert point.reasons is not None
        assert "moves around the hole with every change of the load" in point.reasons["critical"]
        rod = lying_rod(point.case.problem, rtol=1e-6)
        assert rod.end is not None
        assert point.lift_off is not None
        assert point.lift_off.value == pytest.approx(rod.end.force, rel=1e-6)
        lies, gone = point.loads
        assert (lies.what, gone.what) == (STRAIGHT, LEFT)
        assert lies.stress is not None
        assert "buckling" not in lies.spare
        assert lies.spare["lift-off"].value == pytest.approx(lies.load.force - rod.end.force, rel=1e-6)
    assert not any("could not be computed" in line for line in sentences(found))
    assert holes(found) == "curved hole"
    assert "Curved hole, no friction" in conditions(Problem(15.0, build=0.1, twist=0.5))


def test_the_published_map_of_formulas_in_builds_has_exact_loads_and_the_rate_of_long_pipe() -> None:
    """Loads of the stored map again, and by how much He and Kyllingstad's are below them: about like 1/L²."""
    stored = json.loads((ROOT / "benchmarks" / "results" / "curved_formulas.json").read_text(encoding="utf-8"))
    stiffness, weight, clearance = (stored[name] for name in ("stiffness", "weight", "clearance"))
    i, shares = stored["rates"].index(3.0), []
    for j in (10, 13):
        length, bend = stored["lengths"][j], math.radians(3.0) / 30.0
        problem = Problem(weight * length**3 / stiffness, clearance=clearance / length, build=bend * length)
        ends = -critical(problem).force * stiffness / length**2
        lying = 1.0 / bend + clearance  # radius of the arc in which the pipe lies
        middle = ends + weight * lying * (1.0 - math.cos(0.5 * length / lying))
        assert stored["compression"][i][j] == pytest.approx(middle, abs=0.1)
        formula = FORMULAS["he_kyllingstad"].function(stiffness, weight, 90.0, clearance, bend, 0.0)
        shares.append((1.0 - formula / middle) * length**2)
    assert shares[1] == pytest.approx(shares[0], rel=0.15)


def test_tubing_in_a_packer_is_refused() -> None:
    with pytest.raises(InputError, match="curved"):
        packer(Case.from_dict({"rod": ROD, "hole": HOLE, "packer": {"bore": "120 mm", "motion": "all"}}))


def test_out_of_the_vertical_plane_the_load_up_to_which_the_rod_lies_is_audited() -> None:
    """κ₁ = 0.2, w = 15, hardly any walk: −177.320540182, theory of curved holes by two programs, is where it buckles.

    With more walk, and unlike ends, it leaves the wall: there the contact pressure of its state vanishes.
    """
    level = audit(Problem(15.0, build=0.2, walk=1e-6))
    assert level.critical.force == pytest.approx(-177.320540182, abs=5e-9)
    assert level.critical.label == "load at which the rod, as it lies, buckles"
    assert [load.name for load in level.loads] == ["critical", "lift_off"]
    assert "has none" in level.not_found[0]
    bent = level.row("he_kyllingstad")
    assert bent.comparisons[0].exact == pytest.approx(177.320540182, abs=5e-9)
    tilted = audit(Problem(15.0, 80.0, build=0.2, walk=0.3))
    assert tilted.critical.label.endswith("leaves the wall")
    state = equilibrium(tilted.problem, tilted.critical.force + 1e-3)
    assert -0.1 < state.number("largest_pressure").value < 0.0
    assert [load.name for load in tilted.loads] == ["critical"]
