"""Parameter studies: reading lists and ranges, points against single cases, worst cases, what goes wrong."""

from __future__ import annotations

import copy
import csv
import json
import math
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import openpyxl
import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st
from pypdf import PdfReader

import rodwell
from rodwell import InputError, NotConvergedError
from rodwell.analysis.loads import arms
from rodwell.answers.result.assessment import BUCKLED, LEFT, STRAIGHT, UNKNOWN
from rodwell.cli.main import cli
from rodwell.plots.study import plot_study
from rodwell.quantities.table import Table
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.strength.limits import LIFTS_OFF, YIELDS
from rodwell.studies.sweep.plain import study_dict
from rodwell.studies.sweep.study import Study
from rodwell.studies.sweep.tables import sentences, study_table
from rodwell.studies.sweep.varied import is_study, varied_inputs
from rodwell.studies.varied import MOST_POINTS

STRING: dict[str, Any] = {
    "rod": {"length": "30 m", "outer_diameter": "10 cm", "youngs_modulus": "200 GPa", "density": "7800 kg/m^3"},
    "hole": {"diameter": "70 cm", "angle_from_vertical": "60 deg"},
}


def string(**changes: Any) -> dict[str, Any]:
    data = copy.deepcopy(STRING)
    for key, value in changes.items():
        section, name = key.split("__")
        data.setdefault(section, {})[name] = value
    return data


@pytest.mark.parametrize(
    ("written", "numbers", "unit", "second"),
    [
        ("30..90 deg in 13", [30 + 5 * i for i in range(13)], "deg", "35.0 deg"),
        ("30 deg .. 90 deg in 3", [30, 60, 90], "deg", "60.0 deg"),
        ("90..30 deg in 3", [90, 60, 30], "deg", "60.0 deg"),
        ("8..12 in in 3", [8, 10, 12], "in", "10.0 in"),
        ("20 cm..0.4 m in 2", [0.2, 0.4], "m", "0.4 m"),
        ("-2e3..-1e3 N in 2", [-2000, -1000], "N", "-1000.0 N"),
        ("10..40 in 7", [10, 15, 20, 25, 30, 35, 40], "", 15.0),
        (".1...3 in 3", [0.1, 0.2, 0.3], "", 0.2),
        (["30 deg", "45 deg"], [30, 45], "deg", "45 deg"),
        (["1 m", "50 cm"], [1, 0.5], "m", "50 cm"),
        ([10, 20.5], [10, 20.5], "", 20.5),
    ],
)
def test_lists_and_ranges(written: Any, numbers: list[float], unit: str, second: Any) -> None:
    (found,) = varied_inputs({"hole": {"x": written}})
    assert found.numbers == pytest.approx(numbers, rel=1e-12)
    assert (found.name, found.unit, found.written) == ("hole.x", unit, written)
    assert found.values[1] == second


@pytest.mark.parametrize("text", ["../pipes.toml", "5 in", "wait ..", "clamped-clamped", "1.5 m", "a..b"])
def test_texts_that_are_no_ranges(text: str) -> None:
    assert varied_inputs({"rod": {"x": text}}) == ()


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6), st.integers(2, 50))
def test_ranges_are_even_and_include_both_ends(first: float, width: float, count: int) -> None:
    (found,) = varied_inputs({"load": {"twist": f"{first!r}..{first + width!r} N m in {count}"}})
    assert found.numbers is not None
    assert len(found.numbers) == count
    tolerance = 1e-12 * (abs(first) + width)
    assert found.numbers[0] == pytest.approx(first, abs=tolerance)
    assert found.numbers[-1] == pytest.approx(first + width, abs=tolerance)
    steps = [b - a for a, b in zip(found.numbers[:-1], found.numbers[1:], strict=True)]
    assert steps == pytest.approx([width / (count - 1)] * (count - 1), abs=2 * tolerance)


@pytest.mark.parametrize(
    ("changes", "names"),
    [
        ({}, "no input that varies"),
        ({"hole__diameter": "60..80 cm"}, "is not a range"),
        ({"hole__diameter": "60..80 cm in 1"}, "from 2 to"),
        ({"hole__diameter": "60..60 cm in 3"}, "from one finite value to another"),
        ({"hole__diameter": "60 kg..80 cm in 3"}, "do not go together"),
        ({"hole__diameter": "sixty..80 cm in 3"}, "is not a range"),
        ({"hole__diameter": f"60..80 cm in {MOST_POINTS + 1}"}, f"2 to {MOST_POINTS}"),
        ({"hole__diameter": ["60 cm"]}, "at least two"),
        ({"hole__diameter": []}, "at least two"),
        ({"hole__diameter": [["60 cm", "70 cm"], "80 cm"]}, "single values"),
        ({"hole__diameter": ["60..70 cm in 2", "80 cm"]}, "single values"),
        ({"hole__diameter": ["60 ± 1 cm", "80 cm"]}, "±"),
        ({"hole__diameter": [True, False]}, "single values"),
        ({"analysis__modes": [1, 2]}, "cannot vary"),
        ({"load__until": ["-1 kN", "-2 kN"]}, "cannot vary"),
        ({"load__applied": "-20..-10 kN"}, "is not a range.*list of loads that act"),
        ({"load__applied": "-20..-10 m in 3"}, "must be a force"),
        ({"load__applied": ["-20..-10 kN in 3"], "rod__length": ["20 m", "30 m"]}, "load.applied"),
        ({"rod__length": "20..30 m in 3", "hole__diameter": "60..80 cm in 3", "rod__poisson": [0.2, 0.3]}, "third"),
        ({"rod__length": "20..30 m in 30", "hole__diameter": "60..80 cm in 30"}, "30 × 30 = 900 points"),
        ({"hole__diametre": "60..80 cm in 3"}, "did you mean 'diameter'"),
        ({"hole__diameter": ["60 kg", "80 kg"]}, "must be a length"),
        ({"hole__diameter": "5..9 cm in 3"}, "does not fit"),
    ],
)
def test_what_is_refused(changes: dict[str, Any], names: str) -> None:
    with pytest.raises(InputError, match=names):
        rodwell.study(string(**changes))


@pytest.fixture(scope="module")
def inclined() -> Study:
    """Inclination and length: 2 × 2 points of the paper's string."""
    return rodwell.study(string(rod__length=["20 m", "30 m"], hole__angle_from_vertical="60..90 deg in 2"))


def test_points_are_the_single_cases(inclined: Study) -> None:
    """Every point is what the case alone gives, in SI units of its own."""
    assert [inclined.inputs(point) for point in inclined.points] == [
        "length of the rod 20 m, inclination from the vertical 60°",
        "length of the rod 20 m, inclination from the vertical 90°",
        "length of the rod 30 m, inclination from the vertical 60°",
        "length of the rod 30 m, inclination from the vertical 90°",
    ]
    for point, (length, alpha) in zip(inclined.points, [(20, 60), (20, 90), (30, 60), (30, 90)], strict=True):
        stiffness = 200e9 * math.pi / 64 * 0.1**4
        weight = 7800 * 9.80665 * math.pi / 4 * 0.1**2
        problem = rodwell.Problem(weight * length**3 / stiffness, alpha, 0.3 / length)
        lift = rodwell.follow(problem).lift_off
        assert lift is not None
        unit = stiffness / length**2
        critical = -rodwell.critical_loads(problem, 1)[0].force
        axial = weight * length * math.cos(math.radians(alpha))
        found, bottom = point.compression("critical"), point.compression("critical", bottom=True)
        off = point.compression("lift_off")
        assert found is not None
        assert bottom is not None
        assert off is not None
        assert found.value == pytest.approx(critical * unit, rel=1e-8)
        assert bottom.value == pytest.approx(critical * unit + axial, rel=1e-8, abs=1e-6 * unit)
        assert off.value == pytest.approx(-lift.force * unit, rel=1e-7)
        assert point.places == pytest.approx(lift.s, rel=1e-6)
        assert point.contact is not None
        assert point.contact.value == pytest.approx(lift.solution.wall.contact.value, rel=1e-6)
        assert point.reasons is None
        table = study_table(inclined)
        (at,) = (i for i, title in enumerate(table.columns) if title.startswith("largest contact force"))
        assert table.rows[point.number][at] == pytest.approx(point.contact.value * unit / length, rel=1e-12)


def test_worst_case_is_that_of_physical_forces() -> None:
    """Longer strings buckle at less force in N, although at more in B/L²."""
    result = rodwell.study(string(rod__length=["10 m", "40 m"], hole__angle_from_vertical="90 deg"))
    first, second = (point.critical for point in result.points)
    assert first is not None
    assert second is not None
    assert second.value < first.value  # in B/L², tension positive
    worst = result.worst()
    assert worst is not None
    assert worst.number == 1
    assert "length of the rod 40 m" in sentences(result)[0]


def test_weights_of_the_paper() -> None:
    """Lift-off at w = 15 is −123.1730743 B/L² (theory, section 4, checked by two programs)."""
    result = rodwell.study({"dimensionless": {"weight": [15, 5]}})
    lift = result.points[0].lift_off
    assert lift is not None
    assert lift.value == pytest.approx(-123.1730743, abs=2e-7)
    worst = result.worst("lift_off")
    assert worst is not None
    assert worst.at == (1,)


def test_points_that_fail_say_why() -> None:
    """Beyond 180° there is no case; at 0° lift-off is buckling; the others are computed."""
    result = rodwell.study({"dimensionless": {"weight": 40, "alpha": [0, 45, 190]}})
    vertical, tilted, wrong = result.points
    assert wrong.case is None
    assert wrong.critical is None
    assert "from 0 (vertical) over 90" in (wrong.reasons or {})["case"]
    assert vertical.lift_off is not None
    assert vertical.critical is not None
    assert vertical.lift_off.value == pytest.approx(vertical.critical.value)
    assert vertical.contact is None
    assert "coincides" in (vertical.reasons or {})["contact"]
    assert tilted.reasons is None
    assert result.incomplete == (vertical, wrong)
    assert any("1 of 3 points could not be computed" in line for line in sentences(result))
    row = study_table(result).rows[2]
    assert "must be from 0 (vertical) over 90" in str(row[-1])
    assert None in row
    json.dumps(study_dict(result), allow_nan=False)
    assert len(plot_study(result).axes) == 2


def test_end_conditions_can_vary() -> None:
    result = rodwell.study({"dimensionless": {"weight": 0.0, "ends": ["clamped-clamped", "pinned-pinned"]}})
    loads = [point.critical.value for point in result.points if point.critical is not None]
    assert loads == pytest.approx([-4 * math.pi**2, -(math.pi**2)], rel=1e-8)
    assert result.varied[0].numbers is None
    assert [tick.get_text() for tick in plot_study(result).axes[1].get_xticklabels()] == [
        "clamped-clamped",
        "pinned-pinned",
    ]


LOADS_FILE = """
title = "Two loads"
study = true
[rod]
length = "30 m"
outer_diameter = "10 cm"
youngs_modulus = "200 GPa"
density = "7800 kg/m^3"
yield_strength = ["10 MPa", "300 MPa"]
[hole]
diameter = "70 cm"
angle_from_vertical = "90 deg"
[load]
applied = ["-50 kN", "-100 kN"]
"""

FILE = """
title = "Weights"
[dimensionless]
weight = "10..30 in 3"
alpha = 60
"""


def test_strengths_used_at_lift_off() -> None:
    """Capacities and strengths can vary; what is used of them goes with their inverse, and is that of single cases."""
    given = string(
        rod__yield_strength=["250 MPa", "500 MPa"], cylinder__outer_diameter="75 cm",
        cylinder__yield_strength="300 MPa", supports__force="100..400 kN in 2",
    )  # fmt: skip
    found = rodwell.study(given)
    assert len(found.points) == 4
    weak, strong = found.points[0].used, found.points[3].used
    assert weak["yield"].value == pytest.approx(2.0 * strong["yield"].value, rel=1e-9)
    assert weak["support"].value == pytest.approx(4.0 * strong["support"].value, rel=1e-9)
    single = rodwell.answer(rodwell.Case.from_dict(string(
        rod__yield_strength="250 MPa", cylinder__outer_diameter="75 cm", cylinder__yield_strength="300 MPa",
        supports__force="100 kN",
    )))  # fmt: skip
    scales = single.case.scales
    assert scales is not None
    stress = single.key_numbers["cylinder_stress"].value * scales.factor("stress")
    assert weak["cylinder"].value == pytest.approx(stress / 300e6, rel=1e-7)
    assert 1.0 / weak["yield"].value == pytest.approx(single.key_numbers["safety_factor_lift_off"].value, rel=1e-7)
    header = study_table(found).columns
    column = header.index("part of the yield strength of the rod used at lift-off")
    assert study_table(found).rows[0][column] == weak["yield"].value
    assert "Most of the yield strength of the rod used at lift-off" in " ".join(sentences(found))
    assert study_dict(found)["points"][3]["used_at_lift_off"]["support"]["value"] == strong["support"].value


def test_loads_that_act_against_known_loads() -> None:
    """Buckling at −111.2334402 and lift-off at −123.1730743 for w = 15 (the paper's rod); 4π² for a clamped column."""
    found = rodwell.study({"dimensionless": {"weight": [15.0, 0.0]}, "load": {"applied": [-100.0, -120.0, -130.0]}})
    heavy, light = found.points
    assert [one.what for one in heavy.loads] == [STRAIGHT, BUCKLED, LEFT]
    for one, force in zip(heavy.loads, (-100.0, -120.0, -130.0), strict=True):
        assert one.load.force == force
        assert one.spare["buckling"].value == pytest.approx(force + 111.2334402, abs=1e-7)
        assert one.spare[LIFTS_OFF].value == pytest.approx(force + 123.1730743, abs=2e-7)
        assert 0.0 < one.spare[LIFTS_OFF].error < 1e-6
    straight, buckled, left = (one.contact for one in heavy.loads)
    assert straight is not None
    assert buckled is not None
    assert straight.value == pytest.approx(15.0)
    assert buckled.value > 15.0
    assert left is None
    assert [one.what for one in light.loads] == [LEFT] * 3
    assert light.loads[0].spare["buckling"].value == pytest.approx(4 * math.pi**2 - 100.0, abs=1e-6)
    text = " ".join(sentences(found))
    assert "straight in 1; buckled, on the wall, stable in 1; off the wall in 4, of 6 states" in text
    assert "Furthest beyond where it leaves the wall: 90.52 B/L²" in text


def test_load_can_vary_and_points_share_the_rod(monkeypatch: pytest.MonkeyPatch) -> None:
    """Safety of the straight bar is yield strength over F/A; of the buckled one, that of the single case."""
    calls = []
    follow = arms.follow
    monkeypatch.setattr(arms, "follow", lambda *a, **k: calls.append(a) or follow(*a, **k))
    given = string(
        hole__angle_from_vertical=["80 deg", "90 deg"], rod__yield_strength="250 MPa", supports__force="100 MN",
        load__applied="-135..-50 kN in 3",
    )  # fmt: skip
    found = rodwell.study(given)
    assert len(calls) == 2
    assert [point.number for point in found.points] == list(range(6))
    flat = found.points[3:]
    (light,) = flat[2].loads
    assert light.safety is not None
    assert light.what == STRAIGHT
    assert light.safety.value == pytest.approx(250e6 * math.pi / 4 * 0.1**2 / 50e3, rel=1e-9)
    (heavy,) = flat[0].loads
    single = rodwell.answer(rodwell.Case.from_dict(string(
        hole__angle_from_vertical="90 deg", rod__yield_strength="250 MPa", supports__force="100 MN",
        load__applied="-135 kN",
    )))  # fmt: skip
    (state,) = (at.state for at in single.assessment.applied)
    assert state is not None
    stress = single.assessment.stress(state)
    assert stress is not None
    assert heavy.what == BUCKLED
    assert heavy.safety is not None
    assert stress.safety is not None
    assert heavy.safety.value == pytest.approx(stress.safety.value, rel=1e-8)
    assert (YIELDS in heavy.spare) == any(limit.kind == YIELDS for limit in single.assessment.window.limits)
    assert found.worst() is not None
    assert "for inclination from the vertical" in sentences(found)[0]
    assert "load.applied" not in sentences(found)[0]
    assert len(found.rods) == 2
    assert study_table(found).marked == frozenset()
    assert len(plot_study(found).axes) == 3


def test_straight_states_are_known_without_a_branch(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the branch cannot be followed, a load short of buckling still has its stress; the others say why not."""

    def fail(*_: Any, **__: Any) -> Any:
        raise NotConvergedError("no way")

    monkeypatch.setattr(arms, "follow", fail)
    given = string(hole__angle_from_vertical="90 deg", rod__yield_strength="250 MPa", load__applied="-135..-50 kN in 2")
    beyond, short = rodwell.study(given).points
    assert (beyond.loads[0].what, short.loads[0].what) == (UNKNOWN, STRAIGHT)
    assert short.loads[0].safety is not None
    assert short.loads[0].safety.value == pytest.approx(250e6 * math.pi / 4 * 0.1**2 / 50e3, rel=1e-9)
    assert beyond.loads[0].safety is None
    assert (beyond.reasons or {})["applied"] == "no way"
    assert "applied" not in (short.reasons or {})


def test_tables_of_loads_hold_the_same_numbers(tmp_path: Path) -> None:
    """CSV, JSON and page of a study with two loads, one of them too much for the yield strength."""
    file, out = tmp_path / "case.toml", tmp_path / "out"
    file.write_text(LOADS_FILE, encoding="utf-8")
    result = CliRunner().invoke(cli, ["run", str(file), "--out", str(out)], catch_exceptions=False)
    assert "At the loads that act" in result.stdout
    data = json.loads((out / "study.json").read_text(encoding="utf-8"))
    with (out / "points.csv").open(encoding="utf-8", newline="") as opened:
        head, *rows = csv.reader(opened)
    for point, row in zip(data["points"], rows, strict=True):
        assert len(point["applied"]) == 2
        for k, load in enumerate(point["applied"], start=1):
            at = head.index(f"load {k}: compression to spare until it buckles [N]")
            assert float(row[at]) == pytest.approx(load["to_spare"]["buckling"]["si"]["value"], rel=1e-12)
            assert float(row[at + 1]) == pytest.approx(load["to_spare"]["buckling"]["si"]["error"], rel=1e-12)
            column = f"load {k}: effective end force F at s = 1, tension positive [N]"
            assert float(row[head.index(column)]) == pytest.approx(load["given"], rel=1e-12)  # horizontal, no mud
    sheet = openpyxl.load_workbook(out / "points.xlsx")["Points"]
    assert [cell.value for cell in sheet[1]] == head
    yields = head.index("load 2: compression to spare until the rod yields [N]")
    assert float(rows[0][yields]) == pytest.approx(10e6 * math.pi / 4 * 0.1**2 - 100e3, rel=1e-8)  # F = σ A
    assert rows[1][yields] == ""
    assert [load["what"] for load in data["points"][0]["applied"]] == ["straight", "straight"]
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count("At the loads that act") >= 1
    assert "not everywhere on the wall and within strength" in page


def test_command_writes_the_same_numbers_everywhere(tmp_path: Path) -> None:
    file, out = tmp_path / "weights.toml", tmp_path / "out"
    file.write_text(FILE, encoding="utf-8")
    assert is_study(file)
    result = CliRunner().invoke(cli, ["run", str(file), "--out", str(out), "--json"], catch_exceptions=False)
    data = json.loads(result.stdout)
    assert data["worst"] == {"critical": 1, "lift_off": 1}
    names = {"case.toml", "curves.png", "curves.svg", "points.csv", "points.xlsx", "report.html", "study.json"}
    assert {path.name for path in out.iterdir()} == names
    assert json.loads((out / "study.json").read_text(encoding="utf-8")) == data
    assert (out / "case.toml").read_text(encoding="utf-8") == FILE
    ElementTree.parse(out / "curves.svg")
    with (out / "points.csv").open(encoding="utf-8", newline="") as opened:
        rows = list(csv.DictReader(opened))
    loads = [-point["critical"]["value"] for point in data["points"]]
    title = "buckles: compression at s = 1 [B/L²]"
    assert [float(row[title]) for row in rows] == pytest.approx(loads, rel=1e-14)
    sheet = list(openpyxl.load_workbook(out / "points.xlsx")["Points"].iter_rows(values_only=True))
    at = sheet[0].index(title)
    assert [row[at] for row in sheet[1:4]] == pytest.approx(loads, rel=1e-14)
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count('<tr class="marked">') == 1
    assert "http" not in page.replace("http-equiv", "")


def test_single_cases_are_no_studies(tmp_path: Path) -> None:
    examples = Path(__file__).parents[2] / "examples"
    assert not is_study(examples / "drill-string.toml")
    assert is_study(examples / "study.toml")
    assert is_study(examples / "load-study.toml")
    assert varied_inputs({"load": {"applied": ["-10 kN", "-20 kN"]}}) == ()
    assert not is_study(tmp_path / "none.toml")
    with pytest.raises(InputError, match="does not exist"):
        rodwell.study(tmp_path / "none.toml")


def test_tables_refuse_nan_and_formulas(tmp_path: Path) -> None:
    """NaN is never written; text that looks like a formula stays text."""
    table = Table("T", ("a", "b"), ((math.nan, "x"),))
    with pytest.raises(ValueError, match="not finite"):
        write_csv(table, tmp_path / "t.csv")
    with pytest.raises(ValueError, match="not finite"):
        write_xlsx([table], tmp_path / "t.xlsx")
    write_xlsx([Table("T", ("a", "b"), (("=1+1", None), (2.5, "=A1")))], tmp_path / "u.xlsx")
    cells = list(openpyxl.load_workbook(tmp_path / "u.xlsx")["T"].iter_rows(values_only=True))
    assert cells == [("a", "b"), ("=1+1", None), (2.5, "=A1")]
    assert openpyxl.load_workbook(tmp_path / "u.xlsx")["T"]["A2"].data_type == "s"


def test_study_as_pdf(tmp_path: Path) -> None:
    file, out = tmp_path / "weights.toml", tmp_path / "out"
    file.write_text(FILE, encoding="utf-8")
    result = CliRunner().invoke(cli, ["run", str(file), "--out", str(out), "--json", "--pdf"], catch_exceptions=False)
    data = json.loads(result.stdout)
    front, rest = ("".join(sheet.extract_text().split()) for sheet in PdfReader(out / "report.pdf").pages)
    least = -data["points"][0]["critical"]["value"]
    assert f"{least:.6g}B/L²" in front
    assert "everyoneof3pointshasitsloads" in front
    assert rest.startswith("Allpoints")
    for point in data["points"]:
        assert f"{-point['critical']['value']:.5g}" in rest
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count("<img") == 1
    assert "data:image/svg+xml" in page
