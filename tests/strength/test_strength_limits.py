"""The safe window, limits of the rod, of the cylinder and of supports, loads that act, and the verdict."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from strong_rods import BAR, PIPE, case, plain

from rodwell import Case, InputError, answer
from rodwell.answers.data.along import along
from rodwell.answers.result.assessment import BUCKLED, LEFT, OTHER_SHAPE, STRAIGHT
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.verdict import verdict
from rodwell.strength.cylinder import cylinder_stress
from rodwell.strength.limits import CYLINDER, LIFTS_OFF, SUPPORT, UNSTABLE, YIELDS
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.supports import support_loads


def test_error_of_a_limit_covers_what_a_finer_tolerance_changes() -> None:
    limits = []
    for rtol in (1e-10, 1e-4):
        result = answer(case(BAR, rod={"yield_strength": "80 MPa"}, analysis={"rtol": rtol}))
        limits.append(next(one for one in result.assessment.window.limits if one.kind == YIELDS))
    exact, found = limits
    assert exact.force is not None
    assert found.force is not None
    assert 0.0 < abs(found.force - exact.force) <= found.error + exact.error


def test_rod_that_yields_before_it_buckles() -> None:
    """F = −A σ_y at the bottom, the axial weight less at the top."""
    result = answer(case(PIPE, rod={"yield_strength": "25 MPa"}))
    (limit,) = [one for one in result.assessment.window.limits if one.kind == YIELDS]
    rod, scales = result.case.rod, result.case.scales
    assert rod is not None
    assert scales is not None
    assert limit.force is not None
    assert not limit.buckled
    assert (limit.force - result.case.problem.axial_weight) * scales.factor("force") == pytest.approx(
        -25e6 * rod.area, rel=1e-10
    )
    assert limit.s == 0.0
    assert "before it buckles" in verdict(result.assessment)
    bursting = answer(case(PIPE, rod={"yield_strength": "25 MPa"}, pressure={"inside": "9 MPa"}))
    assert next(one for one in bursting.assessment.window.limits if one.kind == YIELDS).force is None
    assert "yields at any load" in verdict(bursting.assessment)


def test_cylinder_and_support_at_their_limits() -> None:
    """At the located loads the stress of the cylinder is its strength, and the support's reaction its capacity."""
    result = answer(
        case(
            BAR,
            cylinder={"outer_diameter": "72 cm", "yield_strength": "4 MPa"},
            supports={"moment": "9 kN m", "force": "1 MN"},
        )
    )
    found = {one.kind: one for one in result.assessment.window.limits}
    assert set(found) == {LIFTS_OFF, CYLINDER, SUPPORT}
    at = {kind: result.first.at(limit.force) for kind, limit in found.items() if kind != LIFTS_OFF}
    scales = result.case.scales
    assert scales is not None
    assert result.case.cylinder is not None
    assert cylinder_stress(at[CYLINDER], result.case.cylinder, scales).utilisation == pytest.approx(1.0, abs=1e-7)
    sizes = [float(np.linalg.norm(one.moment[:2])) for one in at[SUPPORT].reactions]
    assert max(sizes) * scales.factor("moment") == pytest.approx(9e3, rel=1e-7)
    assert result.assessment.limiting is not None
    assert "% of its capacity" in result.key_numbers["support_moment_used"].note


def test_supports_of_the_straight_rod() -> None:
    """They bear the end force at s = 1 and that and the axial weight at s = 0, and the end torque."""
    loaded = case(PIPE, supports={"force": "1 MN", "torque": "8 kN m"}, load={"twist": "2 kN m"})
    scales, problem = loaded.scales, loaded.problem
    assert scales is not None
    assert loaded.supports is not None
    force, torque = support_loads(LoadedRod("", problem, -300.0), loaded.supports, scales)
    assert (force.on, force.s) == ("rod", 0.0)
    assert force.value == pytest.approx((300.0 + problem.axial_weight) * scales.factor("force"))
    assert torque.value == pytest.approx(2e3)
    assert torque.utilisation == pytest.approx(0.25)


def test_window_of_the_paper() -> None:
    """Critical −111.2334402 and lift-off −123.1730743 at γ = 15, horizontal: 11.9396341 wide."""
    result = plain({})
    window = result.assessment.window
    assert window.width is not None
    assert window.width.value == pytest.approx(123.1730743 - 111.2334402, abs=2e-6)
    assert window.percent == pytest.approx(100.0 * (123.1730743 / 111.2334402 - 1.0), abs=1e-5)
    assert window.end is not None
    assert window.end.kind == LIFTS_OFF
    assert "stable, for another 11.94 B/L² (10.7 %) until it lifts off" in verdict(result.assessment)
    assert verdict(result.assessment).endswith("assumptions: frictionless, elastic, straight hole, both ends clamped.")


def test_window_ends_where_the_shape_loses_its_stability() -> None:
    """A pinned rod in a wide hole: its branch folds before it lifts off, and lift-off lies behind the fold."""
    result = plain({"applied": [-20.0, -25.0, -28.0]}, weight=40.0, clearance=0.3, ends="pinned-pinned")
    window, fold = result.assessment.window, next(p for p in result.first.special_points if p.kind == "fold")
    assert window.end is not None
    assert (window.end.kind, window.end.force) == (UNSTABLE, fold.force)
    assert [at.what for at in result.assessment.applied] == [STRAIGHT, BUCKLED, OTHER_SHAPE]
    assert "loses its stability" in " ".join(sentences(result))
    assert "it takes another shape, not given here" in verdict(result.assessment)


def test_loads_that_act() -> None:
    result = plain({"applied": [-100.0, -120.0, -130.0]})
    first, second, third = result.assessment.applied
    assert (first.what, second.what, third.what) == (STRAIGHT, BUCKLED, LEFT)
    assert second.state is not None
    assert second.state.solution is not None
    assert second.state.solution.force == pytest.approx(-120.0, abs=1e-12)
    assert third.state is None
    assert "left the wall, 5.54 % beyond lift-off (−123.173 B/L² there)" in verdict(result.assessment)
    text = " ".join(sentences(result))
    assert "straight and stable, 10.1 % short of buckling (−111.233 B/L² there)" in text
    assert "stays on the wall and stable, 2.58 % short of lift-off" in text
    assert plain({"applied": -130.0}, alpha=0.0).assessment.applied[0].what == LEFT
    none = plain({"until": -50.0, "applied": 10.0})
    assert none.assessment.applied[0].what == STRAIGHT
    assert "At 10 B/L² at s = 1 (tension) the rod is straight and stable, 121.2 B/L² short of" in verdict(
        none.assessment
    )


def test_local_limit_of_a_long_horizontal_string() -> None:
    """2 √(B w/Δ) of an endless horizontal rod, within what the clamped ends of the local rod add; over all of it."""
    result = answer(case(PIPE, rod={"length": "150 m"}, hole={"angle_from_vertical": "90 deg"}))
    a, scales, problem = result.assessment, result.case.scales, result.case.problem
    assert a.local is not None
    assert scales is not None
    assert a.local.applies
    endless = 2.0 * math.sqrt(problem.weight / problem.clearance) * scales.factor("force")
    assert a.local.critical.compression.value == pytest.approx(endless, rel=0.01)
    assert a.local.critical.compression.value / endless > 1.0  # the ends hold it
    over = a.over_local(a.at_buckling)
    assert over is not None
    assert over.to == 1.0
    assert a.over_local(LoadedRod("", problem, -0.9 * endless / scales.factor("force"))).to == 0.0  # type: ignore[union-attr]


BAD = [
    ({"load": {"applied": -20}}, "load.applied", "needs a unit"),
    ({"load": {"applied": "-20 kg"}}, "load.applied", "must be a force"),
    ({"load": {"applied": []}}, "load.applied", "from 1 to 12 forces"),
    ({"load": {"applied": ["-20 kN", "nan N"]}}, "load.applied", "must be finite"),
    ({"load": {"applied": "-20..-50 kN in 3"}}, "load.applied", "is not a number with a unit"),
    ({"load": {"aplied": "-20 kN"}}, "load.aplied", "did you mean 'applied'"),
    ({"load": {"applied": "-50 kN", "until": "-20 kN"}}, "load.until", "ends before load.applied"),
    ({"load": {"applied": "-50 kN"}, "pressure": {"inside": "1 MPa"}}, "load.kind", "say whether load.applied is"),
    ({"load": {"at": "bottom"}}, "load.at", "give load.until or load.applied too"),
    ({"supports": {}}, "supports", "give force, moment or torque"),
    ({"supports": {"force": "0 N"}}, "supports.force", "must be above 0"),
    ({"supports": {"moment": "3 kN"}}, "supports.moment", "must be a moment"),
    ({"supports": {"torqe": "3 kN m"}}, "supports.torqe", "did you mean 'torque'"),
    ({"supports": 5}, "supports", "must be a section"),
]


@pytest.mark.parametrize(("more", "field", "phrase"), BAD, ids=[f"{field}-{phrase[:14]}" for _, field, phrase in BAD])
def test_bad_loads_and_supports_are_refused(more: dict[str, Any], field: str, phrase: str) -> None:
    with pytest.raises(InputError) as found:
        Case.from_dict({**PIPE, **more})
    assert found.value.field == field
    assert phrase in found.value.reason


def test_bad_loads_without_dimensions() -> None:
    given = {"dimensionless": {"weight": 15}}
    for value in ("-20 kN", [True], [-20.0, float("nan")]):
        with pytest.raises(InputError, match=r"load\.applied"):
            Case.from_dict({**given, "load": {"applied": value}})
    with pytest.raises(InputError, match="no capacities"):
        Case.from_dict({**given, "supports": {"force": "1 N"}})


def test_a_list_of_loads_is_no_parameter_study(tmp_path: Path) -> None:
    from rodwell.studies.sweep.varied import is_study

    text = '[rod]\nlength = "30 m"\n[load]\napplied = ["-20 kN", "-30 kN"]\n'
    studied = "study = true\n" + text.replace('"30 m"', '["30 m", "40 m"]')
    for content, varies in ((text, False), (studied, True)):
        (tmp_path / "case.toml").write_text(content, encoding="utf-8")
        assert is_study(tmp_path / "case.toml") is varies


def test_largest_stress_of_a_long_string_is_not_passed_over() -> None:
    """124 half waves: the largest stress at lift-off on a grid of 40 001 places; 201 of them miss 7 %."""
    result = answer(
        case(PIPE, rod={"length": "1500 m"}, hole={"angle_from_vertical": "60 deg"}, analysis={"rtol": 1e-5})
    )
    a = result.assessment
    assert a.section is not None
    assert a.at_lift_off is not None
    found = a.stress(a.at_lift_off)
    assert found is not None
    assert found.value == pytest.approx(
        np.max(a.section.von_mises(a.at_lift_off.fields(np.linspace(0, 1, 40001)))), rel=1e-5
    )
    assert len(along(result.assessment)[0].s) > 1000
