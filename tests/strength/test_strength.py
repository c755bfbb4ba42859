"""Strength along the rod: stress, safety, tables and figures of it, in the report and as data."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from typing import Any

import numpy as np
import pytest
from strong_rods import BAR, PIPE, G, case, plain

import rodwell
from rodwell import Answer, Case, Problem, answer
from rodwell.analysis.straight.fields import straight_fields
from rodwell.answers.data.along import along, along_table, along_tables, shown
from rodwell.answers.result.assessment import BUCKLED
from rodwell.answers.words.meaning import sentences
from rodwell.answers.words.verdict import verdict
from rodwell.strength.limits import LIFTS_OFF, YIELDS
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.section import rod_section
from rodwell.studies.audit.audit import audit


@pytest.fixture(scope="module")
def drilling() -> Answer:
    """An inclined pipe with different fluids inside and outside, under pressure, and a load between the two loads."""
    return answer(
        case(
            PIPE,
            rod={"grade": "E-75"},
            mud={"inside": "1100 kg/m^3", "outside": "1400 kg/m^3"},
            pressure={"inside": "20 MPa", "outside": "3 MPa"},
            load={"applied": "-140 kN", "at": "bottom", "kind": "effective"},
        )
    )


def test_straight_rod_in_closed_form_is_the_state_at_the_critical_load() -> None:
    branch = rodwell.follow(Problem(15.0, alpha=60.0, twist=0.3), 1, rtol=1e-6)
    start, s = branch.special_points[0].solution, np.linspace(0.0, 1.0, 7)
    exact, solved = straight_fields(branch.problem, start.force, s), start.fields(s)
    for name, values in exact.items():
        assert values == pytest.approx(solved[name], abs=1e-12), name
    loaded, same = LoadedRod("", branch.problem, start.force), LoadedRod("", branch.problem, start.force, 0.0, start)
    assert loaded.contact.value == pytest.approx(same.contact.value)
    assert loaded.total_contact.value == pytest.approx(same.total_contact.value)


def test_force_at_the_bottom_is_that_at_the_top_less_the_axial_weight(drilling: Answer) -> None:
    """N(0) = F − mg L cos α, for the buckled rod too, whose clamped end lies along the hole."""
    state = drilling.assessment.at_lift_off
    assert state is not None
    found = state.fields(np.array([0.0]))["rod_F1"][0]
    assert found == pytest.approx(state.at_bottom, rel=1e-9)
    figures, weight = drilling.key_numbers, drilling.case.problem.axial_weight
    for name in ("critical_load_1", "lift_off_load"):
        assert figures[f"{name}_bottom"].value == pytest.approx(figures[name].value - weight, rel=1e-14)


def test_real_force_in_the_wall_grows_by_the_weight_in_air(drilling: Answer) -> None:
    """Between two sections of a plain pipe nothing but its own weight pulls at the wall: dN_real/ds = w_air cos α."""
    section, rod = drilling.assessment.section, drilling.case.rod
    assert section is not None
    assert rod is not None
    real = section.loading(drilling.assessment.at_buckling.fields(np.array([0.0, 1.0]))).force
    assert real[1] - real[0] == pytest.approx(rod.weight_in_air * 90.0 * math.cos(math.radians(30.0)), rel=1e-9)
    outer, bore = rod.outer_area, rod.bore_area
    top = drilling.critical[0].force * drilling.case.scales.factor("force")  # type: ignore[union-attr]
    assert real[1] == pytest.approx(top + 20e6 * bore - 3e6 * outer, rel=1e-12)


def test_stress_again_from_the_dataset(drilling: Answer) -> None:
    """Second way: force and moments of the rod in SI from the dataset, with the effective force as Lubinski has it."""
    a, rod, state = drilling.assessment, drilling.case.rod, drilling.at_lift_off
    assert state is not None
    assert rod is not None
    data = state.dataset(2001, length=90.0, stiffness=rod.stiffness)
    force, along_z = data["rod_F1"].values, data["z"].values
    moment = np.hypot(data["rod_M2"].values, data["rod_M3"].values)
    ro, ri = 0.0635, 0.0543
    inertia, area = math.pi / 4.0 * (ro**4 - ri**4), math.pi * (ro**2 - ri**2)
    drop = (90.0 - along_z) * math.cos(math.radians(30.0))
    excess = (20e6 + 1100.0 * G * drop) - (3e6 + 1400.0 * G * drop)
    squares = [
        (np.abs(force) / area + moment * r / inertia) ** 2
        + 3.0 * (excess * ri**2 * ro**2 / ((ro**2 - ri**2) * r**2)) ** 2
        for r in (ro, ri)
    ]
    loaded = a.at_lift_off
    assert loaded is not None
    found = a.stress(loaded)
    assert found is not None
    assert found.value == pytest.approx(float(np.sqrt(np.max(squares))), rel=1e-5)
    assert found.safety is not None
    assert found.safety.value == pytest.approx(75e3 * 6894.757293168 / found.value, rel=1e-9)
    figure = drilling.key_numbers["rod_stress_lift_off"].physical(drilling.case)
    assert figure is not None
    assert figure[0] == pytest.approx(found.value)


def test_torsion_is_the_end_torque() -> None:
    result = answer(case(BAR, load={"twist": "3 kN m"}))
    found = result.assessment.stress(result.assessment.at_buckling)
    assert found is not None
    shear, axial = 16.0 * 3e3 / (math.pi * 0.1**3), found.axial
    assert found.torsion == pytest.approx(shear)
    assert found.value == pytest.approx(math.sqrt(axial**2 + 3.0 * shear**2), rel=1e-12)


def test_errors_cover_what_a_finer_tolerance_changes() -> None:
    fine, rough = (answer(case(BAR, analysis={"rtol": rtol})) for rtol in (1e-10, 1e-4))
    states = [one.assessment.at_lift_off for one in (fine, rough)]
    assert states[0] is not None
    assert states[1] is not None
    exact, found = fine.assessment.stress(states[0]), rough.assessment.stress(states[1])
    assert exact is not None
    assert found is not None
    assert 0.0 < abs(found.value - exact.value) <= found.error + exact.error


def test_the_same_in_other_units() -> None:
    field = case(
        BAR,
        rod={"length": "98.42519685039370 ft", "outer_diameter": "3.937007874015748 in", "yield_strength": "40 ksi"},
        hole={"diameter": "27.55905511811024 in"},
    )
    si = case(BAR, rod={"yield_strength": f"{40e3 * 6894.757293168361} Pa"})
    one, other = (answer(x).key_numbers for x in (field, si))
    assert one.keys() == other.keys()
    for name in ("rod_stress_buckling", "safety_factor_lift_off", "window"):
        assert one[name].value == pytest.approx(other[name].value, rel=1e-9), name


def test_safety_is_one_where_the_rod_yields() -> None:
    """First yield on the branch: the stress there, once more from the dataset on a fine grid, is the strength."""
    result = answer(case(BAR, rod={"yield_strength": "80 MPa"}))
    limit = next(one for one in result.assessment.window.limits if one.kind == YIELDS)
    assert limit.buckled
    assert limit.force is not None
    assert result.lift_off is not None
    assert result.lift_off.force < limit.force < result.critical[0].force
    data = result.first.at(limit.force).dataset(4001, length=30.0, stiffness=result.case.scales.stiffness)  # type: ignore[union-attr]
    bending = 32.0 * np.hypot(data["rod_M2"].values, data["rod_M3"].values) / (math.pi * 0.1**3)
    stress = np.abs(data["rod_F1"].values) / (math.pi * 0.05**2) + bending
    assert np.max(stress) == pytest.approx(80e6, rel=2e-7)
    place = data["s"].values[np.argmax(stress)] / 30.0
    assert limit.s is not None
    assert min(place, 1.0 - place) == pytest.approx(min(limit.s, 1.0 - limit.s), abs=1e-3)
    state = LoadedRod("", result.case.problem, limit.force, limit.error, result.first.at(limit.force))
    section = rod_section(result.case)
    assert section is not None
    safety = section.largest(state).safety
    assert safety is not None
    assert safety.value == pytest.approx(1.0, abs=1e-7)
    assert "it yields already at" in verdict(result.assessment)


def test_the_same_load_at_either_end(drilling: Answer) -> None:
    """−140 kN at the bottom is that and the buoyed weight along the hole at the top; real less the pressures there."""
    fluids = {"mud": {"inside": "1100 kg/m^3", "outside": "1400 kg/m^3"}}
    fluids["pressure"] = {"inside": "20 MPa", "outside": "3 MPa"}
    (load,), scales, rod = drilling.case.applied, drilling.case.scales, drilling.case.rod
    assert scales is not None
    assert rod is not None
    drop = 90.0 * math.cos(math.radians(30.0))
    buoyed = rod.weight_in_air + G * (1100.0 * rod.bore_area - 1400.0 * rod.outer_area)
    top = -140e3 + buoyed * drop
    assert load.force * scales.factor("force") == pytest.approx(top, rel=1e-9)
    real = top + 20e6 * rod.bore_area - 3e6 * rod.outer_area
    other = case(PIPE, **fluids, load={"applied": f"{real!r} N", "kind": "real"})
    assert other.applied[0].force == pytest.approx(load.force, rel=1e-9)
    (at,) = drilling.assessment.applied
    assert at.what == BUCKLED
    assert "At 140 kN of compression at the bottom the rod is buckled but stays" in verdict(drilling.assessment)
    assert "safety factor" in verdict(drilling.assessment)


def test_formulas_are_those_of_the_audit(drilling: Answer) -> None:
    whole, rows = audit(drilling.case), drilling.assessment.formulas
    assert {"dawson_paslay", "chen_lin_cheatham", "wu_juvkam_wold"} <= {row.formula.key for row in rows}
    for row in rows:
        other = whole.row(row.formula.key)
        assert row.value == other.value
        main, same = row.main, other.beside(row.against, row.formula.place)
        assert main is not None
        assert same is not None
        assert main.exact == pytest.approx(same.exact, rel=1e-9)
        assert (main.safe, row.valid) == (same.safe, other.valid)


def test_length_over_the_local_limit(drilling: Answer) -> None:
    """Up to where −N(s) = limit."""
    a, problem, scales = drilling.assessment, drilling.case.problem, drilling.case.scales
    assert scales is not None
    state = LoadedRod("", problem, drilling.critical[0].force - 30.0)
    over = a.over_local(state)
    assert over is not None
    assert 0.0 < over.to < 1.0
    there = straight_fields(problem, state.force, np.array([over.to]))["rod_F1"][0]
    assert -there * scales.factor("force") == pytest.approx(over.limit, rel=1e-12)
    short = answer(case(BAR)).assessment
    assert short.local is not None
    assert not short.local.applies
    assert short.over_local(short.at_buckling) is None


def test_table_along_the_rod(drilling: Answer) -> None:
    table, states = along_table(along_tables(drilling.assessment)), along(drilling.assessment)
    assert [one.state.name for one in states] == ["at buckling", "at lift-off", "at the applied load"]
    assert shown(states).state.name == "at the applied load"
    assert len(table.rows) == 3 * len(states[0].s)
    first = dict(zip(table.columns, table.rows[0], strict=True))
    bottom = drilling.key_numbers["critical_load_1_bottom"].physical(drilling.case)
    assert bottom is not None
    assert first["axial force F1, effective, tension positive [N]"] == pytest.approx(bottom[0])
    assert first["distance below s = 1 along the rod [m]"] == pytest.approx(90.0)
    strength = drilling.case.yield_strength
    assert strength is not None
    product = first["largest von Mises stress [Pa]"] * first["safety factor against yield"]  # type: ignore[operator]
    assert product == pytest.approx(strength)
    assert [table.name for table in along_tables(drilling.assessment)] == [one.state.name for one in states]
    bare = along_table(along_tables(plain({}).assessment))
    assert len(bare.columns) == 10


def test_solid_rod_without_diameter_has_no_stress() -> None:
    given = {
        "rod": {"length": "30 m", "bending_stiffness": "1e6 N m^2", "weight_per_length": "600 N/m"},
        "hole": {"clearance": "30 cm", "angle_from_vertical": "90 deg"},
        "analysis": {"modes": 1},
    }
    result = answer(Case.from_dict(given))
    assert result.assessment.section is None
    assert "rod_stress_lift_off" not in result.key_numbers
    assert "von Mises" not in " ".join(sentences(result))


@pytest.mark.parametrize(("base", "turned"), [(PIPE, True), (BAR, False)])
def test_figures_put_depth_downwards_in_inclined_holes(base: dict[str, Any], turned: bool) -> None:
    from rodwell.plots.along import plot_along, plot_force, plot_stress

    result = answer(case(base, rod={"yield_strength": "150 MPa"}))
    states, scales = along(result.assessment), result.case.scales
    assert scales is not None
    ax = plot_along(states, states[-1], scales, result.assessment.local, 150e6)
    assert bool(ax.yaxis_inverted()) is turned
    assert len(ax.figure.axes) == 2
    force, stress = plot_force(states, scales), plot_stress(states[-1], scales, 150e6)
    peak = result.key_numbers["rod_stress_lift_off"].physical(result.case)
    assert peak is not None
    drawn = next(line for line in stress.lines if line.get_label().startswith("von Mises"))
    values = drawn.get_xdata() if turned else drawn.get_ydata()
    assert np.max(values) * 1e6 == pytest.approx(peak[0], rel=2e-3)
    assert any("at buckling" in line.get_label() for line in force.lines)


def test_section_of_the_report(drilling: Answer) -> None:
    """The numbers of the answer, in its units, and every table that the case has."""
    from rodwell.report.reports.strength import strength_sections

    page = json.dumps([asdict(section) for section in strength_sections(drilling.assessment)], ensure_ascii=False)
    lift, scales = drilling.lift_off, drilling.case.scales
    assert lift is not None
    assert scales is not None
    for words in (
        "At the loads that act",
        "The safe window",
        "Stress in the rod",
        "Formulas of practice beside",
        "along-rod",
    ):
        assert words in page
    compression = (drilling.case.problem.axial_weight - lift.force) * scales.factor("force") / 1e3
    assert str(compression)[:5] in page  # in kN, at the bottom, where the load is given
    assert "Dawson–Paslay" in page
    bare = json.dumps([asdict(section) for section in strength_sections(plain({}).assessment)], ensure_ascii=False)
    assert "Stress in the rod" not in bare
    assert "At the loads that act" not in bare


def test_answer_as_data(drilling: Answer) -> None:
    whole = json.loads(json.dumps(drilling.as_dict(), allow_nan=False))
    assert whole["verdict"] == verdict(drilling.assessment)
    data = whole["assessment"]
    assert [state["name"] for state in data["states"]] == ["at buckling", "at lift-off", "at the applied load"]
    assert data["applied"][0] | {"force": 0} == {
        "given": -140e3, "at": "bottom", "kind": "effective", "force": 0, "what": "buckled", "reached": True, "why": "",
        "state": "at the applied load",
    }  # fmt: skip
    assert all("error" in one["force"] for one in data["states"])
    assert data["window"]["ends_by"] == LIFTS_OFF
