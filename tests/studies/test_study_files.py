"""Studies of strength and of loads that act, and their files: tables, JSON, PDF, what the command writes."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import openpyxl
import pytest
from click.testing import CliRunner
from pypdf import PdfReader
from varied import string

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
from rodwell.studies.sweep.tables import sentences, study_table
from rodwell.studies.sweep.varied import is_study, varied_inputs

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
