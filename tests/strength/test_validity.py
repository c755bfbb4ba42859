"""Whether the theory's assumptions hold at the loads shown, beside every verdict."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rodwell
from rodwell import Case
from rodwell.analysis.discrete.measures import Measured
from rodwell.answers.words.advice import statuses
from rodwell.answers.words.meaning import sentences
from rodwell.quantities.value import Value
from rodwell.report.reports.case import case_report
from rodwell.strength.loaded import LoadedRod
from rodwell.strength.validity import LEFT, LIMITS, UNJUDGED, WITHIN, Measure, validity
from rodwell.studies.sweep.plain import study_dict
from rodwell.studies.sweep.study import study
from rodwell.studies.sweep.tables import sentences as study_sentences

ONE = {"modes": 1, "rtol": 1e-6}
STEEL: dict[str, Any] = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "90 deg"},
    "analysis": ONE,
}
FILAMENT: dict[str, Any] = {
    "rod": {"length": "100 mm", "outer_diameter": "1.75 mm", "youngs_modulus": "26 MPa", "density": "1200 kg/m^3"},
    "hole": {"diameter": "2 mm", "angle_from_vertical": "90 deg"},
    "analysis": ONE,
}


@pytest.fixture(scope="module")
def steel() -> rodwell.Answer:
    return rodwell.answer(Case.from_dict(STEEL))


@pytest.fixture(scope="module")
def filament() -> rodwell.Answer:
    return rodwell.answer(Case.from_dict(FILAMENT | {"load": {"applied": "-13 N"}}))


def measures(answer: rodwell.Answer) -> dict[str, Measure]:
    return {measure.name: measure for measure in answer.assessment.validity.measures}


def number(measure: Measure) -> float:
    assert measure.number is not None
    return measure.number.value


def test_measures_are_what_they_say(steel: rodwell.Answer) -> None:
    found, lift, scales = measures(steel), steel.at_lift_off, steel.case.scales
    assert lift is not None
    assert scales is not None
    assert set(found) == set(LIMITS)
    radius, area, inertia = 0.05, math.pi * 0.05**2, math.pi / 4.0 * 0.05**4
    force = -lift.force * scales.factor("force")
    assert number(found["axial_strain"]) == pytest.approx(force / (200e9 * area), rel=1e-9)
    moment = lift.largest("rod_M2").value * scales.factor("moment")
    assert number(found["bending_strain"]) == pytest.approx(moment * radius / (200e9 * inertia), rel=1e-3)
    assert number(found["slenderness"]) == pytest.approx(30.0 / 0.025)
    assert number(found["slenderness_of_half_wave"]) == pytest.approx(
        1200.0 * math.pi / steel.critical[0].wavenumber, rel=1e-12
    )
    slope = np.max(np.abs(lift.fields(np.linspace(0.0, 1.0, 4001))["eta"]))
    assert number(found["slope"]) == pytest.approx(slope, rel=1e-5)
    assert number(found["shortening"]) == pytest.approx(steel.key_numbers["end_shortening"].value, rel=1e-12)
    assert {measure.status for measure in found.values()} == {WITHIN}


def test_a_rod_within_the_theory_has_its_plain_verdict(steel: rodwell.Answer) -> None:
    assert sentences(steel)[0].startswith("The straight rod is stable until")
    assert sentences(steel)[-1].startswith("Small strain: axial strain F/EA 0.00")
    assert sentences(steel)[-1].endswith("within what the theory assumes.")
    assert all(status.subject != "Theory" for status in statuses(steel))
    assert steel.as_dict()["validity"]["status"] == WITHIN


def test_a_soft_rod_under_a_large_load_has_no_plain_verdict(filament: rodwell.Answer) -> None:
    """13 N on 26 MPa and 1.75 mm: 13/(26e6 π 0.875e-3²) = 20.8 %, though the load is far beyond lift-off."""
    strain = measures(filament)["axial_strain"]
    assert number(strain) == pytest.approx(13.0 / (26e6 * math.pi * 0.875e-3**2), rel=1e-9)
    assert strain.where == "at the applied load"
    text = sentences(filament)
    assert text[0].startswith("Only a rough guide, since the theory assumes small strain (axial strain F/EA 20.8 %")
    assert "the rod has left the wall" in text[0]
    assert "the theory's assumptions are left" in text[-1]
    assert [status.subject for status in statuses(filament) if status.level == "bad"].count("Theory") == 1
    data = filament.as_dict()
    assert data["verdict"] == text[0]
    assert data["validity"]["status"] == LEFT
    assert data["validity"]["measures"]["axial_strain"]["status"] == LEFT
    assert data["validity"]["measures"]["axial_strain"]["number"]["value"] == number(strain)
    report = case_report(filament)
    section = next(s for s in report.sections if s.title.startswith("What the theory assumes"))
    assert "20.8 %" in str(section)
    assert report.front.verdict == text[0]


SHORT = {"length": "30 mm", "outer_diameter": "33 mm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"}
SLENDER_ENOUGH = SHORT | {"length": "10 m", "outer_diameter": "10 cm"}


@pytest.mark.parametrize(
    ("rod", "names"),
    [(SHORT, {"axial_strain", "slenderness", "slenderness_of_half_wave"}), (SLENDER_ENOUGH, set())],
    ids=["slenderness 3.6", "slenderness 400"],
)
def test_a_stocky_rod_has_no_plain_verdict(rod: dict[str, str], names: set[str]) -> None:
    hole = {"clearance": "0.5 mm", "angle_from_vertical": "90 deg"}
    result = rodwell.answer(Case.from_dict({"rod": rod, "hole": hole, "analysis": ONE}))
    assert {measure.name for measure in result.assessment.validity.left} == names
    assert sentences(result)[0].startswith("Only a rough guide") == bool(names)


def test_the_strain_is_that_of_the_most_loaded_end() -> None:
    """A rod under its own weight is pressed most at its lower end, a hanging one is pulled most at its upper end."""
    rod = STEEL["rod"]
    hole = {"diameter": "70 cm", "angle_from_vertical": "0 deg"}
    weight = 7800.0 * 9.80665 * 30.0 / 200e9
    for load, strain in (("-10 kN", weight + 1e4 / (200e9 * math.pi * 0.05**2)), ("60 kN", None)):
        given = {"rod": rod, "hole": hole, "load": {"applied": f"{load} tension" if strain is None else load}}
        case = Case.from_dict(given)
        (applied,) = case.applied
        state = LoadedRod("here", case.problem, applied.force)
        found = validity(case, [state], [], math.pi).measures[0]
        expected = 6e4 / (200e9 * math.pi * 0.05**2) if strain is None else strain
        assert number(found) == pytest.approx(expected, rel=1e-9)


def test_large_slopes_and_shortening_are_seen() -> None:
    """A heavy rod in a wide hole that turns across it: its ends approach by more than a fifth of its length."""
    problem = rodwell.Problem(1000, clearance=0.3)
    branch = rodwell.follow(problem, rtol=1e-5)
    case = Case.from_dict({"dimensionless": {"weight": 1000.0, "clearance": 0.3}})
    state = LoadedRod("far on", problem, branch[-1].force, solution=branch[-1])
    found = validity(case, [state], [], math.pi)
    assert {measure.name: measure.where for measure in found.left} == {"slope": "far on", "shortening": "far on"}
    assert number(found.measures[-1]) == branch[-1].number(Measured.SHORTENING).value > 0.2
    assert "take the loads as a rough guide only" in found.sentence


@pytest.mark.parametrize("name", LIMITS)
def test_limits_are_limits(name: str) -> None:
    label, limit = LIMITS[name]
    above, below = (Measure(name, label, Value(limit * part), limit).status for part in (1.001, 0.999))
    assert (above, below) == ((WITHIN, LEFT) if name.startswith("slenderness") else (LEFT, WITHIN))
    assert Measure(name, label, None, limit).status == UNJUDGED


def test_what_cannot_be_judged_is_said() -> None:
    rod = {"length": "30 m", "bending_stiffness": "1e6 N m^2", "weight_per_length": "300 N/m"}
    hole = {"clearance": "30 cm", "angle_from_vertical": "90 deg"}
    given: list[tuple[dict[str, Any], str]] = [
        ({"rod": rod, "hole": hole, "analysis": ONE}, "cannot be judged, rod.outer_diameter is not given"),
        ({"dimensionless": {"weight": 15.0}, "analysis": ONE}, "cannot be judged, the case has no dimensions"),
    ]
    for data, said in given:
        result = rodwell.answer(Case.from_dict(data))
        assert said in sentences(result)[-1]
        assert "slope |η|" in sentences(result)[-1]
        assert not sentences(result)[0].startswith("Only a rough guide")
        assert result.as_dict()["validity"]["measures"]["axial_strain"]["number"] is None


def test_studies_say_where_small_strain_is_left(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(
        'study = true\n[rod]\nlength = ["40 mm", "100 mm"]\nouter_diameter = "1.75 mm"\nyoungs_modulus = "26 MPa"\n'
        'density = "1200 kg/m^3"\n[hole]\ndiameter = "2 mm"\nangle_from_vertical = "90 deg"\n'
        '[analysis]\nrtol = 1e-6\n[load]\napplied = "-4 N"\n', encoding="utf-8",
    )  # fmt: skip
    found = study(file)
    assert study_sentences(found)[0].startswith("At 2 of 2 points the theory's small strain is left")
    data = study_dict(found)
    strain = [point["validity"]["measures"]["axial_strain"]["number"]["value"] for point in data["points"]]
    assert strain == pytest.approx([4.0 / (26e6 * math.pi * 0.875e-3**2)] * 2)


def test_a_study_within_the_theory_says_nothing_of_it(tmp_path: Path) -> None:
    file = tmp_path / "study.toml"
    file.write_text(
        'study = true\n[rod]\nlength = ["30 m", "31 m"]\nouter_diameter = "10 cm"\nmaterial = "steel"\n'
        '[hole]\ndiameter = "70 cm"\nangle_from_vertical = "90 deg"\n[analysis]\nrtol = 1e-6\n', encoding="utf-8",
    )  # fmt: skip
    found = study(file)
    assert not any("strain" in line for line in study_sentences(found))
    assert all(point["validity"]["status"] == WITHIN for point in study_dict(found)["points"])
