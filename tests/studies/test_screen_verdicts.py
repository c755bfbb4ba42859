"""No verdict of a screening is milder than its own lines, and signs that contradict a force's name are questioned."""

from __future__ import annotations

import math
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from programs import CAMPAIGNS, loaded

import rodwell
from rodwell import Case, InputError, Survey
from rodwell.analysis.loads.by_inclination import Loads
from rodwell.cli.main import cli
from rodwell.cli.screen import _stations
from rodwell.plots.wells.survey import plot_screening
from rodwell.studies.sweep.varied import varied_inputs
from rodwell.studies.well import verdict
from rodwell.studies.well.plain import screening_dict
from rodwell.studies.well.screening import BESIDE, Beside
from rodwell.studies.well.tables import screening_table, sentences

ROOT = Path(__file__).parents[2]
DATA: dict[str, Any] = {
    "rod": {"length": "200 m", "bending_stiffness": "1.228e6 N m^2", "weight_per_length": "241 N/m"},
    "hole": {"clearance": "44.45 mm", "angle_from_vertical": "90 deg"},
}


@pytest.fixture(scope="module")
def campaign() -> ModuleType:
    """The campaign of 1,000 wells, of which a few are looked at here."""
    return loaded(CAMPAIGNS / "screen_verdicts.py")


def test_no_verdict_is_milder_than_its_lines(campaign: ModuleType) -> None:
    seen = set()
    for seed in range(8):
        data = campaign.random_well(seed)
        assert campaign.faults(data) == [], seed
        seen.add(data["verdict"])
    assert len(seen) >= 3


def screening(**changes: Any) -> rodwell.Screening:
    """Four stations with loads and forces as they are given, in N: what a screening could find, without computing."""
    n = 4
    exact = np.asarray(changes.get("exact", [100.0] * n)) * 1e3
    lift = np.asarray(changes.get("lift", [150.0] * n)) * 1e3
    errors = np.full(n, changes.get("error", 0.1) * 1e3)
    formulas = {
        "dawson_paslay": np.full(n, 95e3),
        "chen_lin_cheatham": np.full(n, 134e3),
        "he_kyllingstad": np.asarray(changes.get("curved", [95.0] * n)) * 1e3,
    }
    reasons = {i: "no luck" for i in range(n) if math.isnan(exact[i])}
    survey = Survey.of([0.0, 100.0, 200.0, 300.0], [60.0, 60.0, 60.0, 60.0])
    case = Case.from_dict(DATA)
    force = None if changes.get("force") is None else np.asarray(changes["force"]) * 1e3
    critical = Loads(exact, errors, reasons, 4, 0.0, 1e-3)
    string = rodwell.screen(case, survey).string
    bent = Loads(np.asarray(changes.get("bent", [math.nan] * n)) * 1e3, errors, {}, 4, 0.0, 1e-3)
    return rodwell.Screening(
        case, survey, string, critical, Loads(lift, errors, {}, 4, 0.0, 1e-2), bent, formulas, force, {60.0: 0.0}
    )


def test_one_more_formula_beside_the_loads_has_a_column_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """On the terminal, in the file and in the figure: none of the others shifts."""
    found = screening(force=[10, 20, 30, 40])
    monkeypatch.setitem(BESIDE, "fourth", Beside("A fourth, sinusoidal", "fourth"))
    found.formulas["fourth"] = np.full(4, 77e3)
    shown: Any = _stations(found)
    cells = {str(column.header): next(iter(column.cells)) for column in shown.columns}
    assert (cells["He–K."], cells["fourth"], cells["the string"], cells["used"]) == ("95", "77", "10", "10 %")
    table = screening_table(found)
    row = dict(zip(table.columns, table.rows[0], strict=True))
    assert (row["A fourth, sinusoidal [kN]"], row["compression of the string [kN]"]) == (77.0, 10.0)
    labels = plot_screening(found).axes[1].get_legend_handles_labels()[1]
    assert "A fourth, sinusoidal" in labels


NAN = math.nan


@pytest.mark.parametrize(
    ("changes", "level", "headline"),
    [
        ({}, verdict.NO_FORCE, "Least compression"),
        ({"force": [-1, -2, -3, -4]}, verdict.TENSION, "The string is in tension"),
        ({"force": [0, 0, 0, 0]}, verdict.TENSION, "The string is in tension"),
        ({"force": [10, 20, 30, 40]}, verdict.STRAIGHT, "By the straight-hole loads the string does not buckle:"),
        ({"force": [10, 20, 30, 99.95]}, verdict.CLOSE, "The string buckles or comes so close"),
        ({"force": [10, 20, 30, 101]}, verdict.BUCKLES, "The string buckles:"),
        ({"force": [10, 20, 30, 40], "curved": [95, 95, 25, 95]}, verdict.EXPECTED, "Expect the string to buckle"),
        ({"force": [10, 20, -30, 40], "curved": [95, 95, 25, 95]}, verdict.STRAIGHT, "By the straight-hole loads"),
        ({"force": [1, 2, 30, 101], "curved": [95, 95, 25, 95]}, verdict.BUCKLES, "The string buckles:"),
        ({"force": [1, 2, 30, 99.95], "curved": [95, 95, 25, 95]}, verdict.EXPECTED, "Expect the string to buckle"),
        ({"force": [1, 2, 3, 4], "exact": [100, 100, NAN, 100]}, verdict.UNJUDGED, "Not every station can be judged"),
        ({"force": [1, 2, -3, 4], "exact": [100, 100, NAN, 100]}, verdict.STRAIGHT, "By the straight-hole loads"),
        ({"force": [1, 2, 3, 101], "exact": [100, 100, NAN, 100]}, verdict.BUCKLES, "The string buckles:"),
        ({"force": [1, 2, 160, 4], "exact": [100, 100, NAN, 100]}, verdict.BUCKLES, "The string buckles"),
        (
            {"force": [1, 2, 160, 4], "bent": [170, 170, 170, NAN]},
            verdict.STRAIGHT,
            "By the exact loads, with the hole",
        ),
        # a build that is shorter than the local rod does not hold it better
        ({"force": [1, 2, 160, 4], "bent": [NAN, NAN, 170, NAN]}, verdict.BUCKLES, "The string buckles:"),
        (
            {"force": [1, 2, 160, 4], "exact": [100, NAN, 100, 100], "bent": [NAN, 170, 170, NAN]},
            verdict.BUCKLES,
            "The string buckles:",
        ),
        ({"force": [1, 2, 26, 4], "bent": [NAN, NAN, 25, NAN]}, verdict.BUCKLES, "The string buckles:"),
        ({"force": [1, 2, 24, 4], "bent": [NAN, NAN, 25, NAN], "curved": [95, 95, 20, 95]}, verdict.STRAIGHT, "By the"),
    ],
)
def test_the_worst_line_leads(changes: dict[str, Any], level: int, headline: str) -> None:
    found = screening(**changes)
    assert verdict.level_of(found) == level
    assert sentences(found)[0].startswith(headline)
    levels = [line.level for line in verdict.verdict_lines(found)]
    assert levels == sorted(levels, reverse=True)
    if levels:
        assert levels[0] == level
        assert screening_dict(found)["verdict"] == verdict.LEVELS[level]


def test_stations_past_buckling_whose_lift_off_is_not_known_are_told() -> None:
    found = screening(force=[10, 120, 160, 120], lift=[150, NAN, 150, 150])
    assert any("3 of 4 stations are past buckling" in line for line in sentences(found))
    assert any(line.endswith("; 1 are past lift-off; at 1 of them lift-off is not known.") for line in sentences(found))
    assert not any("not known" in line for line in sentences(screening(force=[10, 120, 160, 120])))


def run(tmp_path: Path, *options: str) -> Any:
    (tmp_path / "well.csv").write_text("MD [ft],Inc\n0,40\n1000,60\n", encoding="utf-8")
    line = ["screen", str(tmp_path / "well.csv"), "--case", str(ROOT / "examples" / "well-string.toml")]
    return CliRunner().invoke(cli, [*line, "--out", str(tmp_path / "out"), *options], catch_exceptions=False)


@pytest.mark.parametrize(
    ("option", "text", "remedies"),
    [
        ("--bit-force", "20klbf", ['"-20klbf"', '"20klbf tension"']),
        ("--bit-force", "+90 kN", ['"-90 kN"', '"90 kN tension"']),
        ("--hook-force", "-90 kN", ['"90 kN"', '"90 kN compression"']),
        ("--bit-force", "-90 kN tension", ["without the word"]),
        ("--bit-force", "-35,000 lbf", ['"-35000 lbf"', '"-35.000 lbf"']),
    ],
)
def test_a_sign_that_contradicts_the_option_is_questioned(
    tmp_path: Path, option: str, text: str, remedies: list[str]
) -> None:
    with pytest.raises(InputError, match=option) as caught:
        run(tmp_path, f"{option}={text}")
    for remedy in remedies:
        assert remedy in str(caught.value)


def test_words_say_what_is_meant(tmp_path: Path) -> None:
    assert "in tension at every station" in run(tmp_path, "--bit-force=20 klbf tension").output
    pushed = [
        run(tmp_path, f"--bit-force={text}").output for text in ("20 klbf compression", "-20klbf", "-20 kip push")
    ]
    assert "buckle" in pushed[0]
    assert pushed[0] == pushed[1] == pushed[2]


def test_signs_from_python() -> None:
    case, survey = Case.from_dict(DATA), Survey.of([0.0, 30.0], [40.0, 41.0])
    with pytest.raises(InputError, match=r"bit_force = 20000.*write -20000.*signs_meant"):
        rodwell.screen(case, survey, bit_force=20e3)
    with pytest.raises(InputError, match=r"hook_force = -20000.*write 20000"):
        rodwell.screen(case, survey, hook_force=-20e3)
    assert rodwell.screen(case, survey, bit_force=20e3, signs_meant=True).compression is not None


@pytest.mark.parametrize(
    ("load", "remedy"),
    [
        ({"applied": "20 klbf"}, '"-20 klbf"'),
        ({"applied": "20 kN", "at": "bottom"}, '"20 kN tension"'),
        ({"applied": ["-20 kN", "20 kN"]}, '"-20 kN"'),
    ],
)
def test_loads_that_leave_the_whole_rod_in_tension_are_questioned(load: dict[str, Any], remedy: str) -> None:
    with pytest.raises(InputError, match=r"load\.applied = .*reads as tension all along the rod") as caught:
        Case.from_dict({**DATA, "load": load})
    assert remedy in str(caught.value)


@pytest.mark.parametrize(
    ("load", "sign"),
    [
        ({"applied": "20 kN tension"}, 1.0),
        ({"applied": "20 kN pull"}, 1.0),
        ({"applied": "20 kN compression"}, -1.0),
        ({"applied": "20 kN in compression"}, -1.0),
        ({"applied": "-20 kN"}, -1.0),
    ],
)
def test_loads_may_say_how_they_act(load: dict[str, Any], sign: float) -> None:
    (applied,) = Case.from_dict({**DATA, "load": load}).applied
    assert applied.given == sign * 20e3


def test_tension_at_the_top_of_a_hanging_string_is_no_question() -> None:
    """Its lower end is in compression: 48.2 kN of weight hang below the top."""
    data = {**DATA, "hole": {**DATA["hole"], "angle_from_vertical": "0 deg"}, "load": {"applied": "20 kN"}}
    assert Case.from_dict(data).applied[0].given == 20e3


def test_a_range_from_compression_to_tension_means_both() -> None:
    (found,) = varied_inputs({"load": {"applied": "-20..20 kN in 3"}})
    assert found.values == ("-20.0 kN", "0.0 kN", "20.0 kN tension")
