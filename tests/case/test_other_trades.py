"""Inputs of other trades: a shaft of measured stiffness without a bore, torsional stiffness, the turned end, titles."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

import rodwell
from rodwell import Case, InputError, Problem
from rodwell.analysis.discrete.measures import Measured
from rodwell.strength.section import rod_section

EXAMPLES = Path(__file__).parents[2] / "examples"
CATHETER = {
    "pipe": "5 Fr catheter", "length": "150 mm", "bending_stiffness": "200 N·mm²", "weight_per_length": "0.02 N/m",
}  # fmt: skip
VESSEL = {"diameter": "6 mm", "angle_from_vertical": "90 deg"}


def case(rod: dict[str, Any], **more: Any) -> Case:
    return Case.from_dict({"rod": rod, "hole": VESSEL, **more})


def without(key: str) -> dict[str, str]:
    return {name: value for name, value in CATHETER.items() if name != key}


def test_a_catheter_of_known_stiffness_and_weight_needs_no_bore() -> None:
    found = case(CATHETER)
    assert found.rod is not None
    assert not found.rod.bore_known
    assert found.scales is not None
    assert found.scales.stiffness == pytest.approx(2e-4)
    assert found.problem.clearance == pytest.approx(0.5 * (6.0 - 5.0 / 3.0) / 150.0)
    assert rod_section(found) is None  # no stress of a section that is not known
    known = case({**CATHETER, "inner_diameter": "1 mm"})
    assert known.problem == found.problem
    assert rod_section(known) is not None


def test_blood_around_it_lifts_by_the_outer_circle() -> None:
    found = case(CATHETER | {"weight_per_length": "0.04 N/m"}, mud={"outside": "1060 kg/m^3"})
    assert found.scales is not None
    weight = found.problem.weight * found.scales.factor("force_per_length")
    assert weight == pytest.approx(0.04 - 1060.0 * 9.80665 * math.pi / 4.0 * (5e-3 / 3.0) ** 2, rel=1e-12)


@pytest.mark.parametrize(
    ("rod", "more", "key", "words"),
    [
        (without("bending_stiffness") | {"material": "peek"}, {}, "rod.inner_diameter", "to work out the stiffness"),
        (without("weight_per_length"), {}, "rod.inner_diameter", "to work out the weight"),
        (CATHETER | {"yield_strength": "100 MPa"}, {}, "rod.inner_diameter", "for stresses"),
        (CATHETER | {"material": "peek", "grade": "none"}, {}, "rod.inner_diameter", "for stresses"),
        (CATHETER, {"mud": {"density": "1060 kg/m^3"}}, "mud.density", "mud.outside alone"),
        (CATHETER, {"mud": {"inside": "1060 kg/m^3"}}, "mud.inside", "give rod.inner_diameter"),
        (CATHETER, {"pressure": {"inside": "20 kPa"}}, "pressure.inside", "give rod.inner_diameter"),
    ],
)
def test_the_bore_is_asked_for_where_it_counts(rod: dict[str, Any], more: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(InputError) as caught:
        case(rod, **more)
    assert caught.value.field == key
    assert words in str(caught.value)


def test_torsional_stiffness_is_that_given() -> None:
    found = case({**CATHETER, "torsional_stiffness": "2600 N·mm²"}, load={"twist": "1 N mm"})
    assert found.problem.torsional_stiffness == pytest.approx(13.0, rel=1e-12)
    assert any("C/B = 13" in fact.note for fact in found.facts)
    plain = case(CATHETER).problem
    assert plain.torsion is None
    assert plain.torsional_stiffness == pytest.approx(1.0 / 1.3)
    with_material = case({"material": "steel", "length": "1 m", "outer_diameter": "1 mm",
                          "torsional_stiffness": "1 N·mm²"})  # fmt: skip
    assert with_material.problem.torsion is not None
    same = Case.from_dict({"dimensionless": {"weight": 5, "torsion": 13.0}}).problem
    assert same == Problem(5, torsion=13.0)


@pytest.mark.parametrize("torsion", [0.0, -1.0, math.nan, math.inf, 1e7, "13", True])
def test_torsion_of_a_problem_is_checked(torsion: Any) -> None:
    with pytest.raises(InputError, match="torsion"):
        Problem(5, torsion=torsion)


@pytest.mark.parametrize("ends", ["clamped-clamped", "clamped-guided"])
def test_end_rotation_is_what_the_torque_works_on(ends: str) -> None:
    """dE/dT₁ at a given force is the rotation beyond that of the straight rod, T₁/C, with the sign turned."""
    energy, rotation, h, force = {}, 0.0, 0.01, -130.0 if ends == "clamped-clamped" else -80.0
    problem = Problem(15, 75, clearance=0.02, ends=ends)
    for twist in (0.5 - h, 0.5, 0.5 + h):
        state = rodwell.follow(problem.but(twist=twist), 1, until=force - 10.0).at(force)
        energy[twist] = state.number(Measured.ENERGY).value
        if twist == 0.5:
            rotation = state.end_rotation.value
    slope = (energy[0.5 + h] - energy[0.5 - h]) / (2.0 * h)
    assert abs(slope) > 1e-5
    assert rotation - 0.5 / problem.torsional_stiffness == pytest.approx(-slope, rel=1e-4)


def test_torsional_stiffness_changes_the_rotation_and_nothing_else() -> None:
    states = [
        rodwell.follow(Problem(15, 75, twist=0.5, torsion=torsion), 1, until=-140.0).at(-130.0)
        for torsion in (None, 13.0)
    ]
    soft, stiff = states
    assert stiff.number(Measured.ENERGY) == soft.number(Measured.ENERGY)
    assert stiff.end_rotation.value - 0.5 / 13.0 == pytest.approx(soft.end_rotation.value - 0.65, abs=1e-12)
    assert stiff.certificate.passed
    assert soft.dataset().attrs.get("torsion") is None
    assert stiff.dataset().attrs["torsion"] == 13.0


def test_rotation_is_a_key_number_where_there_is_twist() -> None:
    found = rodwell.answer(Case.read(EXAMPLES / "catheter.toml"))
    straight, lifted = (found.key_numbers[name] for name in ("end_rotation_straight", "end_rotation"))
    assert straight.value == pytest.approx(1.0 * 150.0 / 3900.0)  # T₁ L/GJ in N mm, mm, N mm²
    assert lifted.value == pytest.approx(straight.value, rel=0.01)
    assert lifted.text(found.case) == "0.0384615 rad"
    assert found.as_dict()["problem"]["torsion"] == pytest.approx(13.0)
    without_twist = rodwell.answer(Case.from_dict({"dimensionless": {"weight": 5}}))
    assert "end_rotation" not in without_twist.key_numbers
    assert "torsion" not in without_twist.as_dict()["problem"]


def test_a_case_without_title_has_the_name_of_its_file(tmp_path: Path) -> None:
    file = tmp_path / "deep-well.toml"
    file.write_text("[dimensionless]\nweight = 5\n", encoding="utf-8")
    assert Case.read(file).title == "deep-well"
    assert "ntitled" not in Case.from_dict({"dimensionless": {"weight": 5}}).title
