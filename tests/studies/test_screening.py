"""A screened well: loads, curvature and forces at its stations, against limits and closed forms; the command."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import openpyxl
import pytest
from click.testing import CliRunner
from local_pipe import PIPE, dawson_paslay

import rodwell
from rodwell import Case, InputError, Problem, Survey, critical_loads
from rodwell.analysis.loads.by_inclination import Precision, loads_at
from rodwell.analysis.loads.in_bends import loads_in_bends
from rodwell.analysis.loads.long_rod import (
    LocalLoad,
)
from rodwell.cli.main import cli
from rodwell.quantities.value import Value
from rodwell.studies.well.plain import screening_dict

EXAMPLES = Path(__file__).parents[2] / "examples"
DATA = {
    "rod": {"length": "200 m", "bending_stiffness": "1.228e6 N m^2", "weight_per_length": "241 N/m"},
    "hole": {"clearance": "44.45 mm", "angle_from_vertical": "90 deg"},
}


@pytest.fixture(scope="module")
def well() -> rodwell.Screening:
    """Vertical, built, dropped, horizontal, a little uphill: 90 stations of a well in a plane."""
    md = np.linspace(0.0, 2670.0, 90)
    alpha = np.interp(md, [0.0, 500.0, 1200.0, 1500.0, 2200.0, 2670.0], [0.0, 0.0, 50.0, 40.0, 90.0, 92.0])
    return rodwell.screen(Case.from_dict(DATA), Survey.of(md, alpha), bit_force=-1.2e5)


def test_loads_of_the_well(well: rodwell.Screening) -> None:
    vertical = well.local == 0.0
    assert np.all(well.lift_off.values[vertical] == well.critical.values[vertical])
    assert np.all(well.lift_off.values[~vertical] > well.critical.values[~vertical])
    assert np.all(well.critical.values > 0.99 * well.formulas["dawson_paslay"])
    steep = [dawson_paslay(alpha) for alpha in well.survey.inclination]
    assert well.formulas["dawson_paslay"] == pytest.approx(np.array(steep), rel=1e-9)
    assert well.formulas["chen_lin_cheatham"] == pytest.approx(math.sqrt(2.0) * np.array(steep), rel=1e-9)


def test_curvature_of_the_well(well: rodwell.Screening) -> None:
    """In a build section F = (2B b/r)[1 + √(1 + w sin α r/(B b²))]; the drop, and only that, is pointed out."""
    i = 30  # in the first build
    b, w_lateral = float(well.survey.build[i]), PIPE.weight * math.sin(math.radians(well.survey.inclination[i]))
    root = math.sqrt(1.0 + w_lateral * PIPE.clearance / (PIPE.stiffness * b * b))
    closed = 2.0 * PIPE.stiffness * b / PIPE.clearance * (1.0 + root)
    assert well.formulas["he_kyllingstad"][i] == pytest.approx(closed, rel=1e-9)
    assert np.array_equal(well.dropping, well.survey.build < -1e-9)
    assert "curvature" in well.remarks(int(np.nonzero(well.dropping)[0][0]))


def test_loads_in_the_build_are_those_of_the_arc(well: rodwell.Screening) -> None:
    """`rodwell critical --build` of that arc, put together by hand; elsewhere they are those of the straight hole."""
    i = 30
    build, alpha = float(well.survey.build[i]), float(well.local[i])
    root = math.sqrt(build**2 + PIPE.weight * math.sin(math.radians(alpha)) * PIPE.clearance / PIPE.stiffness)
    length = 20.0 * math.pi * math.sqrt(PIPE.clearance / (build + root))
    turned = 0.5 * math.degrees(build * length / (1.0 + build * PIPE.clearance))
    arc = Problem(
        PIPE.weight * length**3 / PIPE.stiffness, alpha - turned, PIPE.clearance / length, build=build * length
    )
    load = (arc.hung_weight - critical_loads(arc, 1)[0].force) * PIPE.stiffness / length**2
    assert well.bent.values[i] == pytest.approx(load, rel=1e-9)
    straight = well.formulas["dawson_paslay"]
    alike = np.abs(well.formulas["he_kyllingstad"] - straight) <= 0.01 * straight
    assert np.all(np.isnan(well.bent.values[alike]))
    known = np.isfinite(well.bent.values)
    assert well.bent.values[known] == pytest.approx(well.formulas["he_kyllingstad"][known], rel=0.4)
    assert well.limit[0][i] == pytest.approx(well.bent.values[i], rel=1e-12)
    assert np.all(well.limit[0][known] <= well.bent.values[known] * (1.0 + 1e-12))
    begins = int(np.flatnonzero(known & (well.survey.build > 0.0))[0])  # above it the hole is straight
    assert well.limit[0][begins] == pytest.approx(well.critical.values[begins], rel=1e-12)
    assert not np.any(well.turning)


def test_loads_of_many_stations_are_interpolated_to_the_error_that_is_told() -> None:
    """A load that goes like that of a bent pipe, in closed form: its table, and where there is none."""
    draw = np.random.default_rng(5)
    pairs = list(zip(draw.uniform(20.0, 90.0, 300), draw.uniform(1e-4, 4e-3, 300), strict=True))

    def formula(alpha: float, build: float) -> float:
        return 1e5 * (1.0 + 300.0 * build) * math.sin(math.radians(alpha))

    def solve(alpha: float, build: float) -> LocalLoad:
        if build > 3.5e-3 and alpha < 30.0:
            return LocalLoad(None, reason="none here")
        return LocalLoad(Value(formula(alpha, build) * (1.0 + 0.3 * math.exp(-500.0 * build - alpha / 90.0)), 1.0))

    loads = loads_in_bends(pairs, solve, formula, 1e-3)
    assert loads.solved <= 17 * 17 + 24
    lost = np.isnan(loads.values)
    assert set(np.flatnonzero(lost)) == set(loads.reasons)
    assert 0 < np.sum(lost) < 30
    for i in np.flatnonzero(~lost):
        exact = solve(*pairs[i]).compression
        assert exact is not None
        assert abs(loads.values[i] - exact.value) <= loads.errors[i] <= 3e-3 * exact.value


def test_forces_of_the_well(well: rodwell.Screening) -> None:
    """Force at the bit and force at the hook describe the same string; weight acts along the vertical."""
    assert well.compression is not None
    assert well.compression[-1] == pytest.approx(1.2e5)
    hook = -float(well.compression[0])
    assert hook == pytest.approx(PIPE.weight * well.survey.tvd[-1] - 1.2e5, rel=1e-9)
    few = Survey.of(well.survey.md[[30, 50, 80]], well.survey.inclination[[30, 50, 80]])
    pulled = rodwell.screen(Case.from_dict(DATA), few, hook_force=5e4)
    assert pulled.compression is not None
    assert pulled.compression == pytest.approx(PIPE.weight * few.tvd - 5e4, rel=1e-9)
    assert pulled.compression[-1] > 0.0
    other = rodwell.screen(Case.from_dict(DATA), few)
    assert other.compression is None
    assert other.utilisation is None
    assert other.worst is None
    used = well.utilisation
    assert used is not None
    assert well.worst == int(np.argmax(used))
    assert np.all((used == 0.0) == (well.compression <= 0.0))


def test_uphill_is_the_mirror_image(well: rodwell.Screening) -> None:
    mirror = rodwell.screen(Case.from_dict(DATA), Survey.of([0.0, 30.0], [88.0, 92.0]))
    assert mirror.critical.values[0] == mirror.critical.values[1]
    assert "uphill" in mirror.remarks(1)
    assert "uphill" in well.remarks(89)


def test_forces_in_the_survey_and_twice() -> None:
    survey = Survey.of([0.0, 30.0], [40.0, 41.0], force=[1e4, -2e4])
    result = rodwell.screen(Case.from_dict(DATA), survey)
    assert result.compression is not None
    assert result.compression.tolist() == [-1e4, 2e4]
    with pytest.raises(InputError, match="twice"):
        rodwell.screen(Case.from_dict(DATA), survey, bit_force=0.0)
    with pytest.raises(InputError, match="finite"):
        rodwell.screen(Case.from_dict(DATA), Survey.of([0.0, 1.0], [3.0, 3.0]), hook_force=math.nan)


def test_cases_that_cannot_be_set_into_a_well() -> None:
    survey = Survey.of([0.0, 30.0], [40.0, 41.0])
    with pytest.raises(InputError, match="dimensions"):
        rodwell.screen(Case.from_dict({"dimensionless": {"weight": 15}}), survey)
    weightless = {**DATA, "rod": {**DATA["rod"], "weight_per_length": "0 N/m"}}
    with pytest.raises(InputError, match="weightless"):
        rodwell.screen(Case.from_dict(weightless), survey)


def test_command_writes_the_same_numbers_everywhere(tmp_path: Path) -> None:
    (tmp_path / "well.csv").write_text("MD [ft],Inc\n0,0\n100,0\n2000,30\n4000,80\n", encoding="utf-8")
    line = [str(tmp_path / "well.csv"), "--case", str(EXAMPLES / "well-string.toml"), "--bit-force", "-20 klbf"]
    result = CliRunner().invoke(
        cli, ["screen", *line, "--out", str(tmp_path / "out"), "--json"], catch_exceptions=False
    )
    assert result.exit_code == 0
    data = json.loads(result.stdout)
    files = {file.name for file in (tmp_path / "out").iterdir()}
    assert files == {"limits.png", "limits.svg", "report.html", "screening.json", "stations.csv", "stations.xlsx"}
    ElementTree.parse(tmp_path / "out" / "limits.svg")
    with (tmp_path / "out" / "stations.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    klbf = 4448.2216152605
    column = [float(row["exact critical compression [klbf]"]) * klbf for row in rows]
    assert column == pytest.approx(data["critical_compression"], rel=1e-12)
    lifts = [float(row["exact lift-off compression [klbf]"]) * klbf for row in rows]
    assert lifts == pytest.approx(data["lift_off_compression"], rel=1e-12)
    assert lifts[3] > column[3]
    assert [float(row["measured depth [ft]"]) for row in rows] == pytest.approx([0.0, 100.0, 2000.0, 4000.0])
    assert data["compression"][-1] == pytest.approx(20.0 * klbf)
    sheet = openpyxl.load_workbook(tmp_path / "out" / "stations.xlsx")["Stations"]
    read = list(sheet.iter_rows(values_only=True))
    assert list(read[0]) == list(rows[0])
    at = read[0].index("exact critical compression [klbf]")
    assert [row[at] * klbf for row in read[1:5]] == pytest.approx(data["critical_compression"], rel=1e-12)
    worst = read[0].index("measured depth [ft]")
    assert sheet.cell(data["worst_station"] + 1, worst + 1).font.bold
    assert not sheet.cell(2, worst + 1).font.bold


def test_command_says_what_is_wrong(tmp_path: Path) -> None:
    (tmp_path / "well.csv").write_text("MD [m],Inc\n0,0\n100,10\n", encoding="utf-8")
    line = [
        "screen",
        str(tmp_path / "well.csv"),
        "--case",
        str(EXAMPLES / "well-string.toml"),
        "--out",
        str(tmp_path / "o"),
    ]
    with pytest.raises(InputError, match="--bit-force"):
        CliRunner().invoke(cli, [*line, "--bit-force", "100 kg"], catch_exceptions=False)
    assert not (tmp_path / "o").exists()


def test_plain_data_hold_no_nan(well: rodwell.Screening) -> None:
    data = screening_dict(well)
    json.dumps(data, allow_nan=False)
    assert len(data["critical_compression"]) == len(data["critical_error"]) == 90
    assert data["summary"][0].startswith("By the exact loads, with the hole's build, the string does not buckle")
    assert len(data["critical_compression_in_build"]) == 90


@pytest.mark.parametrize(("count", "missed"), [(60, 0), (20_000, 1)])
def test_where_a_load_jumps_few_are_solved_for_and_many_say_by_how_much_they_may_be_off(
    count: int, missed: int
) -> None:
    def solve(alpha: float) -> LocalLoad:
        return LocalLoad(Value(100.0 + alpha if alpha < 50.0 else 160.0 + alpha, 1e-6))

    alphas = np.linspace(3.0, 90.0, count)
    loads = loads_at(list(alphas), solve, Precision(1e-2, 7))
    exact = np.array([solve(alpha).compression.value for alpha in alphas])  # type: ignore[union-attr]
    assert bool(loads.missed.size) == bool(missed)
    assert np.all(np.abs(loads.values - exact) <= 1.01 * loads.errors)
    assert np.all(np.abs(alphas[loads.missed] - 50.0) < 1.0)
