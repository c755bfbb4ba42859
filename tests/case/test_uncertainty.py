"""Inputs with "±": reading them, carrying them through, and refusing nonsense."""

from __future__ import annotations

import copy
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rodwell
from rodwell import Case, InputError
from rodwell.analysis.loads.derivatives import Sensitivity
from rodwell.analysis.loads.ends import of_lift_off
from rodwell.analysis.loads.sensitivity import of_critical_load
from rodwell.answers.result.spread import spread_of_load

STRING: dict[str, Any] = {
    "rod": {
        "length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3",
    },
    "hole": {"diameter": "70 cm", "angle_from_vertical": "60 deg"},
}  # fmt: skip


def case(**changes: str) -> Case:
    data = copy.deepcopy(STRING)
    for key, value in changes.items():
        section, name = key.split("__")
        data[section][name] = value
    return Case.from_dict(data)


def critical(of: Case) -> float:
    assert of.scales is not None
    return rodwell.critical_loads(of.problem, 1)[0].force * of.scales.factor("force")


@pytest.mark.parametrize(
    "text",
    ["30 m ± 10 cm", "30 ± 0.1 m", "30 m +/- 0.1 m", "30 m +- 100 mm", "3000 cm ± 0.1 m"],
)
def test_ways_to_write_it_are_the_same(text: str) -> None:
    found = case(rod__length=text)
    assert found.problem == case().problem
    (given,) = found.uncertain
    assert given.key == "rod.length"
    assert given.written == text
    assert found.given["rod"]["length"] == text
    assert given.up is not None
    assert given.up[1] is not None
    assert given.up[1].length == pytest.approx(30.1, rel=1e-9)


@pytest.mark.parametrize(
    ("key", "text", "down", "up"),
    [
        ("rod__length", "30 m ± 0.03 m", "29.97 m", "30.03 m"),
        ("rod__outer_diameter", "10 cm ± 0.1 mm", "9.99 cm", "10.01 cm"),
        ("rod__youngs_modulus", "200 GPa ± 0.5 %", "199 GPa", "201 GPa"),
        ("rod__density", "7800 kg/m^3 ± 0.1 %", "7792.2 kg/m^3", "7807.8 kg/m^3"),
        ("hole__diameter", "70 cm ± 1 mm", "69.9 cm", "70.1 cm"),
        ("hole__angle_from_vertical", "60 deg ± 0.1 deg", "59.9 deg", "60.1 deg"),
    ],
)
def test_spread_is_that_of_the_load_computed_at_both_ends(key: str, text: str, down: str, up: str) -> None:
    found = case(**{key: text})
    mode = rodwell.critical_loads(found.problem, 1)[0]
    spread = spread_of_load(of_critical_load(mode), found.scales, found.uncertain)
    assert spread is not None
    half = 0.5 * (critical(case(**{key: up})) - critical(case(**{key: down})))
    assert spread.parts[key.replace("__", ".")] == pytest.approx(half, rel=2e-4)
    assert spread.total == pytest.approx(abs(half), rel=2e-4)


def test_several_inputs_add_as_independent_ones_and_as_a_monte_carlo_run_has_it() -> None:
    found = case(rod__length="30 m ± 0.1 m", hole__diameter="70 cm ± 1 cm", rod__youngs_modulus="200 GPa ± 1 %")
    mode = rodwell.critical_loads(found.problem, 1)[0]
    spread = spread_of_load(of_critical_load(mode), found.scales, found.uncertain)
    assert spread is not None
    assert spread.total == pytest.approx(math.sqrt(sum(p**2 for p in spread.parts.values())))
    assert spread.largest == max(spread.parts, key=lambda k: abs(spread.parts[k]))
    rng = np.random.default_rng(3)
    loads = []
    for _ in range(300):
        length, hole, young = rng.normal([30.0, 70.0, 200.0], [0.1, 1.0, 2.0])
        loads.append(
            critical(case(rod__length=f"{length} m", hole__diameter=f"{hole} cm", rod__youngs_modulus=f"{young} GPa"))
        )
    assert np.std(loads) == pytest.approx(spread.total, rel=0.15)  # 300 draws: 4 % standard deviation


def test_an_angle_at_its_limit_moves_one_way() -> None:
    limits = [case(hole__angle_from_vertical=f"{degrees} ± 1 deg").uncertain[0] for degrees in (0, 180)]
    assert [(given.up is None, given.down is None) for given in limits] == [(False, True), (True, False)]
    found = case(hole__angle_from_vertical="90 ± 1 deg")
    (given,) = found.uncertain
    assert given.up is not None
    assert given.down is not None
    spread = spread_of_load(
        of_critical_load(rodwell.critical_loads(found.problem, 1)[0]), found.scales, found.uncertain
    )
    assert spread is not None
    assert found.scales is not None
    expected = -found.problem.weight * math.pi / 360.0 * found.scales.factor("force")
    assert spread.parts["hole.angle_from_vertical"] == pytest.approx(expected, rel=1e-6)


def test_dimensionless_cases() -> None:
    found = Case.from_dict({"dimensionless": {"weight": "15 ± 0.5", "alpha": 90}})
    assert found.problem.weight == 15.0
    spread = spread_of_load(of_critical_load(rodwell.critical_loads(found.problem, 1)[0]), None, found.uncertain)
    assert spread is not None
    assert spread.total == pytest.approx(1.9957240653 * 0.5, rel=1e-6)  # dF/dγ by finite differences


@pytest.mark.parametrize(
    ("key", "text", "message"),
    [
        ("rod__length", "30 m ± ", "rod.length"),
        ("rod__length", "30 m ± much", "must be like"),
        ("rod__length", "30 m ± 2 kg", "do not go together"),
        ("rod__length", "30 m ± 0 m", "above 0"),
        ("rod__length", "30 m ± -1 m", "above 0"),
        ("rod__length", "30 m ± 31 m", "103 % of its value"),
        ("rod__length", "30 m ± 30 m", "100 % of its value"),
        ("hole__diameter", "70 cm ± 80 cm", "below 100 %"),
        ("rod__youngs_modulus", "200 GPa ± 150 %", "150 % of its value"),
        ("rod__density", "7,800 kg/m^3 ± 1 %", '"7800 kg/m.3" if the comma separates thousands'),
    ],
)
def test_nonsense_is_refused(key: str, text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        case(**{key: text})


def test_an_angle_may_be_smaller_than_its_uncertainty() -> None:
    """Below 0° there is no angle: the other side then serves."""
    (given,) = case(hole__angle_from_vertical="0.3 deg ± 0.5 deg").uncertain
    assert given.down is None
    assert given.up is not None


@pytest.mark.usefixtures("nothing_drawn")
def test_answer_and_report_carry_it(tmp_path) -> None:
    from rodwell.answers.words.meaning import sentences
    from rodwell.report.folders.case import write_results

    result = rodwell.answer(case(rod__length="30 m ± 0.1 m"))
    data = result.as_dict()
    assert data["sensitivities"][-1]["name"] == "lift-off load"
    assert data["sensitivities"][-1]["from_inputs"]["parts"]["rod.length"] != 0.0
    assert any("most of it from rod.length" in line for line in sentences(result))
    write_results(result, tmp_path / "out")
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    assert "rod.length = 30 m ± 0.1 m" in page
    size = result.case.scales.system.text(result.spreads[-1].total, "force", 2)
    assert f"± {size}" in page.partition('id="section-1"')[0]  # there ± is the uncertainty of the inputs


SURVEY = {
    "in a vertical plane": "0,0,90\n900,0,90\n1000,10,90\n1030,13.5,90\n1060,17,90\n1090,20,90\n1200,30,90\n",
    "that turns": "0,0,90\n900,0,90\n1000,10,90\n1030,13.5,84\n1060,17,78\n1090,20,74\n1200,30,70\n",
}


@pytest.mark.parametrize("kind", SURVEY)
def test_an_input_that_moves_the_hole_of_a_survey(kind: str, tmp_path: Path) -> None:
    """Depth and length move the piece of the hole in which the rod lies; against cases computed at both ends."""
    (tmp_path / "well.csv").write_text(f"MD (m),Inc (deg),Azi (deg)\n{SURVEY[kind]}")

    def along(**changes: str) -> Case:
        rod = {"outer_diameter": "5 in", "inner_diameter": "3 in", "material": "steel", "length": "45 m"}
        data: dict[str, dict[str, Any]] = {"rod": rod, "hole": {"diameter": "8.5 in", "survey": "well.csv"}}
        data["hole"]["to"] = "1080 m"
        for key, value in changes.items():
            section, name = key.split("__")
            data[section][name] = value
        return Case.from_dict(data, folder=tmp_path)

    def load_of(case: Case) -> tuple[Sensitivity, float]:
        assert case.scales is not None
        if case.problem.hole is not None and case.problem.hole.planar:
            load = of_critical_load(rodwell.critical_loads(case.problem, 1, rtol=1e-10)[0])
        else:
            end = rodwell.lying_rod(case.problem, rtol=1e-9).end
            assert end is not None
            load = of_lift_off(end)
        return load, load.force * case.scales.factor("force")

    for key, text, by in (("hole__to", "{:.2f} m", 0.05), ("rod__length", "{:.2f} m", 0.02)):
        middle = 1080.0 if key == "hole__to" else 45.0
        case = along(**{key: f"{text.format(middle)} ± {by} m"})
        spread = spread_of_load(load_of(case)[0], case.scales, case.uncertain)
        assert spread is not None
        low, high = (load_of(along(**{key: text.format(middle + move)}))[1] for move in (-by, by))
        assert spread.parts[key.replace("__", ".")] == pytest.approx(0.5 * (high - low), rel=3e-4)
