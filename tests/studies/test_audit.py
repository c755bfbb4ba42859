"""The audit of formulas: places, errors, verdicts, charts, and tables of known ratios."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

import rodwell
from rodwell.answers.comparison.beside import compare
from rodwell.answers.comparison.exact_loads import PLACES, ExactLoad, critical, exact_loads
from rodwell.errors import InputError
from rodwell.formulas import FORMULAS
from rodwell.studies.audit.audit import audit
from rodwell.studies.audit.error_map import chart_weights, error_map, hanging_coefficients

# exact load over Dawson–Paslay's at top, middle, bottom: clamped, Δ/L = 0.01
RATIOS = {
    (90.0, 40.0): (1.258, 1.258, 1.258), (90.0, 140.0): (1.141, 1.141, 1.141), (90.0, 280.0): (1.107, 1.107, 1.107),
    (90.0, 1000.0): (1.058, 1.058, 1.058), (90.0, 16000.0): (1.015, 1.015, 1.015),
    (60.0, 140.0): (0.983, 1.142, 1.301), (60.0, 280.0): (0.868, 1.093, 1.317), (30.0, 140.0): (0.814, 1.177, 1.539),
    (30.0, 280.0): (0.544, 1.056, 1.569), (10.0, 280.0): (0.050, 1.038, 2.027),
}  # fmt: skip


@pytest.mark.parametrize(("alpha", "weight"), RATIOS)
def test_exact_load_over_dawson_paslay(alpha: float, weight: float) -> None:
    load = critical(rodwell.Problem(weight, alpha=alpha))
    formula = FORMULAS["dawson_paslay"].function(1.0, weight, alpha, 0.01)
    assert [round(load.at(place) / formula, 3) for place in PLACES] == list(RATIOS[alpha, weight])


def test_places_are_the_axial_resultant() -> None:
    """N(s) = F + γ cos α (s − 1): the bottom, s = 0, is the most compressed; vertical clamped rod of (87)."""
    load = critical(rodwell.Problem(74.628569, alpha=0))
    assert load.at("top") == pytest.approx(0.0, abs=1e-6)
    assert load.at("middle") == pytest.approx(0.5 * 74.628569, abs=1e-6)
    assert load.at("bottom") == pytest.approx(74.628569, abs=1e-6)


def test_dellinger_beside_the_exact_load() -> None:
    """F3: 149.1, 286.4, 411.0 beside 159.2, 270.1, 370.5; at 30°, 303.8 beside 128.7."""
    for weight, alpha, fit, exact in ((40, 90, 149.1, 159.2), (140, 90, 286.4, 270.1), (280, 90, 411.0, 370.5),
                                      (280, 30, 303.8, 128.7)):  # fmt: skip
        value = FORMULAS["dellinger"].function(1.0, weight, alpha, 0.01)
        main = compare(value, critical(rodwell.Problem(weight, alpha=alpha)), "top")
        assert round(value, 1) == fit
        assert round(main.exact, 1) == exact
        assert main.percent == pytest.approx(100.0 * (fit / exact - 1.0), abs=0.15)
        assert main.safe == (weight == 40)
    row = audit(rodwell.Problem(280, alpha=30)).row("dellinger")
    assert row.main == main


def test_verdicts_and_errors() -> None:
    load = ExactLoad("critical", "", -90.0, 0.9, 20.0)
    found = compare(99.0, load, "top")
    assert found.percent == pytest.approx(10.0)
    assert found.percent_error == pytest.approx(1.1)
    assert not found.safe
    assert compare(99.0, load, "middle").safe
    assert compare(99.0, load, "bottom").percent == pytest.approx(-10.0)
    assert compare(90.5, load, "top").safe  # within the error of the exact load
    tension = compare(5.0, ExactLoad("critical", "", 30.0, 1e-9, 20.0), "bottom")
    assert tension.exact == -10.0
    assert tension.percent is None
    assert not tension.safe


def test_which_exact_load_is_meant() -> None:
    found = audit(rodwell.Problem(15))
    loads = {load.name: load for load in found.loads}
    assert loads["lift_off"].force == pytest.approx(-123.1730743, abs=1e-6)
    assert -125.0 < loads["equal_energy"].force < -119.0  # one turn has less energy from about −121 down
    assert found.row("dawson_paslay").against == "critical"
    assert found.row("chen_lin_cheatham").against == "equal_energy"
    assert found.row("wu_juvkam_wold").against == "lift_off"
    assert found.row("mitchell_unloading").against == "touch_down"
    inclined = audit(rodwell.Problem(15, alpha=60))
    assert inclined.row("chen_lin_cheatham").against == "lift_off"
    assert any("equal energy" in note for note in inclined.not_found)
    free = audit(rodwell.Problem(15, alpha=0))
    assert free.row("chen_lin_cheatham").against == "critical"
    assert free.row("dawson_paslay").value == 0.0


def test_coil_of_equal_energy_is_in_contact_and_needs_the_least() -> None:
    """A coil of one turn off the wall does not count at γ = 280; at 1000 it does, and two turns need more."""
    for weight, turns, start in ((280, 2, -350.0), (1000, 1, -760.0)):
        loads, notes = exact_loads(rodwell.Problem(weight))
        assert notes == ()
        found = {load.name: load for load in loads}["equal_energy"]
        assert found.label.startswith(f"coil of {turns} turn")
        one = rodwell.coil(rodwell.Problem(weight, turns=1), start=start, until=1.4 * start)
        point = next(p for p in one.special_points if p.kind == "equal_energy")
        assert (point.solution.highest_pressure[0] < 0.0) == (turns == 1)
        if turns == 1:
            assert found.force == pytest.approx(point.force, rel=1e-8)
    two = rodwell.coil(rodwell.Problem(1000, turns=2), start=-680.0, until=-950.0)
    assert next(p.force for p in two.special_points if p.kind == "equal_energy") < found.force


def test_every_formula_has_its_place_in_the_audit() -> None:
    found = audit(rodwell.Problem(280, alpha=60), extra={"mu": 0.2, "build": 0.1})
    keys = [row.formula.key for row in found.rows] + [other.formula.key for other in found.others]
    assert sorted(keys) == sorted(FORMULAS)
    curved = found.row("he_kyllingstad")
    assert curved.comparisons == ()
    assert "straight hole" in curved.reasons[-1]
    assert found.row("gao_miska").value is not None
    contact = next(other for other in found.others if other.formula.key == "helical_contact")
    force = found.critical.at("bottom")
    assert contact.value == pytest.approx(0.01 * force**2 / 4.0)
    assert contact.relative_error is not None
    assert -0.1 < contact.relative_error < 0.0
    needs = next(other for other in found.others if other.formula.key == "helical_push")
    assert needs.value is None
    assert needs.missing == ("x",)


def test_no_value_is_none_and_not_nan() -> None:
    for problem in (rodwell.Problem(0), rodwell.Problem(0, alpha=0), rodwell.Problem(50, alpha=0, ends="free-pinned"),
                    rodwell.Problem(100, on_top=True), rodwell.Problem(15, twist=1.0)):  # fmt: skip
        data = audit(problem, extra={"mu": 0.7}).as_dict()
        json.dumps(data, allow_nan=False)
        assert data["exact"][0]["name"] == "critical"
        assert data["left_out"][0]["reason"]


def test_lift_off_is_that_of_the_twisted_rod_on_the_arm_that_leaves_first() -> None:
    """T₁ = 1, γ = 15, horizontal, clamped: the arms of ``follow`` under this twist; untwisted, −123.173 is unsafe."""
    twisted = rodwell.Problem(15.0, twist=1.0)
    data = audit(twisted, rtol=1e-6).as_dict()
    arms = [rodwell.follow(twisted, 1, mirror=mirror, rtol=1e-6).lift_off for mirror in (False, True)]
    exact = {load["name"]: load for load in data["exact"]}
    assert exact["lift_off"]["force"] == pytest.approx(max(arm.force for arm in arms if arm is not None), rel=1e-6)
    assert exact["lift_off"]["force"] > -121.4
    assert exact["lift_off"]["label"] == "lift-off of mode 1, under the end twist"
    assert exact["equal_energy"]["label"].endswith("straight rod, without the end twist")
    assert data["problem"]["twist"] == 1.0


def test_numbers_of_lubinski_from_the_engine() -> None:
    first = {6: 2.041, 8: 1.937, 10: 1.870, 14: 1.785, 20: 1.711, 30: 1.642}
    second = {6: 4.201, 8: 4.100, 10: 4.032, 14: 3.950, 20: 3.881, 30: 3.816}
    values, errors = hanging_coefficients([float(x) for x in first])
    assert [round(v, 3) for v in values[:, 0]] == pytest.approx(list(first.values()), abs=1.01e-3)
    assert [round(v, 3) for v in values[:, 1]] == pytest.approx(list(second.values()), abs=1.01e-3)
    assert errors.max() < 1e-8
    from scipy.special import ai_zeros, airy, itairy

    values, _ = hanging_coefficients((20.0,), ("pinned", "free"), 2)
    assert values[0] == pytest.approx(-ai_zeros(2)[1], rel=1e-8)
    values, _ = hanging_coefficients((20.0,), ("clamped", "free"), 1)
    assert values[0] == pytest.approx(-ai_zeros(1)[0], rel=1e-8)
    assert airy(-values[0][0])[0] == pytest.approx(0.0, abs=1e-7)
    assert itairy(0.0)[0] == 0.0


def test_map_is_made_of_the_same_loads() -> None:
    problem = rodwell.Problem(280, alpha=30, clearance=0.02, ends="pinned-clamped")
    chart = error_map(problem, (40.0, 280.0), (0.0, 30.0, 90.0))
    assert chart.force.shape == (3, 2)
    single = critical(problem)
    assert chart.force[1, 1] == single.force
    for place in PLACES:
        assert chart.exact(place)[1, 1] == pytest.approx(single.at(place), rel=1e-14)
    row = audit(problem).row("dawson_paslay").beside("critical", "middle")
    assert row is not None
    assert chart.percent("dawson_paslay", "middle")[1, 1] == pytest.approx(row.percent, rel=1e-12)
    assert chart.percent("dawson_paslay", "top")[0, 1] == math.inf  # tension is needed at the top
    assert chart.percent("dawson_paslay", "bottom")[0, 0] == -100.0


def test_weights_of_the_chart() -> None:
    for weight in (0.0, 1.0, 300.0, 5e5, 1e8, 1e9):
        found = chart_weights(weight, 9)
        assert np.all(np.diff(found) > 0.0)
        assert found[0] >= 1.0 - 1e-12
        assert found[-1] <= 1e9 * (1.0 + 1e-12)
        if weight >= 1.0:
            assert found[0] <= weight * (1.0 + 1e-12)
            assert found[-1] >= weight * (1.0 - 1e-12)


@pytest.mark.parametrize(
    ("extra", "match"), [({"mu": -0.1}, "mu"), ({"nu": 0.3}, "nu"), ({"build": math.nan}, "build")]
)
def test_bad_extra(extra: dict[str, float], match: str) -> None:
    with pytest.raises(InputError, match=match):
        audit(rodwell.Problem(15), extra=extra)


def test_bad_case() -> None:
    with pytest.raises(InputError, match="Problem"):
        audit("case.toml")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="turns"):
        audit(rodwell.Problem(15, turns=1))
    with pytest.raises(InputError, match="at least one"):
        error_map(rodwell.Problem(15), (), (30.0,))


FIELD: dict[str, Any] = {
    "rod": {"pipe": "5 in 19.5 lb/ft drill pipe", "length": "300 ft", "grade": "S-135"},
    "mud": {"density": "10 lb/gal"},
    "hole": {"diameter": "8.5 in", "angle_from_vertical": "30 deg"},
    "load": {"applied": ["-20000 lbf", "-35000 lbf", "90000 lbf tension"], "at": "bottom"},
}


def test_other_formulas_at_the_loads_that_act() -> None:
    """Contact r F²/(4B) and pitch π√(8B/F) with the compression of the bottom: given there, so as it was given."""
    case = rodwell.Case.from_dict(FIELD)
    found = audit(case)
    scales = case.scales
    assert scales is not None
    assert [one.load for one in found.applied] == list(case.applied)
    assert [one.straight for one in found.applied] == [True, False, True]
    lbf, radius = 4.4482216152605, 1.75 * 0.0254
    for one, given in zip(found.applied, (20e3 * lbf, 35e3 * lbf), strict=False):
        values = {other.formula.key: other.value for other in one.others}
        assert values["helical_contact"] is not None
        contact = values["helical_contact"] * scales.factor("force_per_length")
        assert contact == pytest.approx(radius * given**2 / (4.0 * scales.stiffness), rel=1e-9)
        pitch = next(other for other in one.others if other.formula.key == "lubinski_woods_pitch")
        assert pitch.value is not None
        assert pitch.value * scales.length == pytest.approx(math.pi * math.sqrt(8.0 * scales.stiffness / given))
    pulled = {other.formula.key: other for other in found.applied[2].others}
    assert pulled["helical_contact"].value is None
    assert pulled["helical_contact"].missing == ("F",)


def test_loads_that_act_in_the_data() -> None:
    data = audit(rodwell.Case.from_dict(FIELD)).as_dict()
    loads = data["at_applied_loads"]
    assert [load["load"].partition(",")[0] for load in loads] == [f"applied load {i}" for i in (1, 2, 3)]
    assert [load["straight"] for load in loads] == [True, False, True]
    keys = [other["key"] for other in data["other_formulas"]]
    assert all([other["key"] for other in load["other_formulas"]] == keys for load in loads)
    assert audit(rodwell.Problem(15.0)).as_dict()["at_applied_loads"] == []
    without = audit(rodwell.Case.from_dict({k: v for k, v in FIELD.items() if k != "load"})).as_dict()
    assert without["at_applied_loads"] == []
    assert without["other_formulas"] == data["other_formulas"]


def test_loads_that_act_in_a_case_without_dimensions() -> None:
    case = rodwell.Case.from_dict({"dimensionless": {"weight": 280.0}, "load": {"applied": -400.0}})
    (one,) = audit(case).applied
    assert one.exact.label == "applied load, −400 B/L² at the top"
    contact = next(other for other in one.others if other.formula.key == "helical_contact")
    assert contact.value == pytest.approx(0.01 * 400.0**2 / 4.0)


@pytest.mark.parametrize(
    "problem", [rodwell.Problem(280, alpha=30), rodwell.Problem(15), rodwell.Problem(1e4, alpha=88)]
)
def test_safe_is_said_only_of_formulas_that_are_valid(problem: rodwell.Problem) -> None:
    found = audit(problem)
    for row, data in zip(found.rows, found.as_dict()["formulas"], strict=True):
        main = row.main
        assert data["verdict"] == row.verdict
        if main is None:
            assert row.verdict == ""
        elif row.verdict == "safe":
            assert row.valid
            assert main.safe
            assert row.value != 0.0
        elif row.verdict == "unsafe":
            assert not main.safe
        else:
            assert row.verdict == ("no load" if row.value == 0.0 else "low")
            assert row.value == 0.0 or (main.safe and not row.valid)
    assert {row.verdict for row in found.rows} >= {"unsafe", "low"}
