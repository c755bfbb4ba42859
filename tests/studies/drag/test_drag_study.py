"""Parameter studies of torque and drag: every point is the well with those values; one that is wrong ends nothing."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from click.testing import CliRunner
from drag_wells import PIPE, well_a_survey

import rodwell
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.plots.wells.drag_study import plot_drag_study
from rodwell.report.reports.content import Grid
from rodwell.report.reports.drag_study import drag_study_report
from rodwell.studies.drag.sweep.tables import points_table
from rodwell.studies.drag.sweep.words import sentences

TEXT = """
{top}
title = "Well A"
[hole]
survey = "a.csv"
diameter = "8.5 in"
[[hole.section]]
to = "1900 m"
friction = {cased}
[[hole.section]]
name = "open hole"
friction = {open}
[[string]]
{pipe}
[mud]
density = {mud}
[well]
block_weight = {block}
state_rule = "equal-energy"
[[well.operation]]
kind = "pull-out"
bit_depth = {depth}
[[well.operation]]
name = "slide"
kind = "slide"
bit_force = {force}
"""
PLAIN = {
    "top": "", "cased": "0.25", "open": "0.25", "mud": '"0 kg/m^3"', "block": '"100 kN"', "depth": '"3400 m"',
    "force": '"-50 kN"', "pipe": "\n".join(f"{key} = {json.dumps(value)}" for key, value in PIPE.items()),
}  # fmt: skip


def written(folder: Path, **changes: str) -> Path:
    """The file of well A with other values, and its survey beside it."""
    survey = well_a_survey()
    rows = [f"{md},{inclination}" for md, inclination in zip(survey.md, survey.inclination, strict=True)]
    (folder / "a.csv").write_text("MD (m),Inc (deg)\n" + "\n".join(rows) + "\n")
    (folder / "well.toml").write_text(TEXT.format(**(PLAIN | changes)))
    return folder / "well.toml"


def single(folder: Path, **changes: str) -> rodwell.Drag:
    (folder / "one").mkdir(exist_ok=True)
    return rodwell.drag(rodwell.Well.read(written(folder / "one", **changes)))


def test_a_point_is_the_well_with_its_values(tmp_path: Path) -> None:
    """Each of a grid of a range and a list, against the same well with those two values; loads in every digit."""
    study = rodwell.drag_study(
        written(tmp_path, top="study = true", open='"0.2..0.3 in 3"', force='["-20 kN", "-50 kN"]')
    )
    assert [v.name for v in study.varied] == ["[[hole.section]] 2, friction", "[[well.operation]] 2, bit_force"]
    assert [v.called for v in study.varied] == ["friction of open hole", "bit force of slide"]
    assert [point.at for point in study.points] == [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)]
    for point, friction, force in ((study.points[1], "0.2", '"-50 kN"'), (study.points[4], "0.3", '"-20 kN"')):
        one = single(tmp_path, open=friction, force=force)
        for mine, theirs in zip(point.operations, one.operations, strict=True):
            assert mine.hook_load is not None
            assert theirs.ends.hook_load is not None
            assert mine.hook_load.value == theirs.ends.hook_load.value
            assert mine.margin == theirs.margin
            assert sum(mine.buckled.values()) == sum(low - high for low, high, _ in theirs.run.buckled)


def test_well_a_in_the_middle_of_a_study(tmp_path: Path) -> None:
    """Friction 0.25 is well A of the theory: 502,594.800142 N pulling out, 146,042.6008 N sliding, equal energy."""
    study = rodwell.drag_study(written(tmp_path, top="study = true", cased="[0.25, 0.3]", mud='"0 kg/m^3"'))
    pull, slide = study.points[0].operations
    assert pull.hook_load is not None
    assert slide.hook_load is not None
    assert pull.hook_load.value == pytest.approx(502594.800142, rel=1e-9)
    assert slide.hook_load.value == pytest.approx(146042.6008, rel=1e-7)
    assert study.points[1].operations[0].hook_load.value > pull.hook_load.value  # type: ignore[union-attr]


def test_one_bad_combination_does_not_end_a_study(tmp_path: Path) -> None:
    study = rodwell.drag_study(written(tmp_path, depth='["3000 m", "3400 m", "3500 m"]', top="study = true"))
    assert [bool(point.operations) for point in study.points] == [True, True, False]
    assert "[[well.operation]] 1, bit_depth = '3500 m': is below the last station" in study.points[2].reason
    assert "1 of 3 points could not be computed" in sentences(study)[-1]
    table = points_table(study)
    assert len(table.rows) == 5
    assert table.rows[-1][-2] == "not computed"
    assert "below the last station" in str(table.rows[-1][-1])
    assert study.as_dict()["points"][2]["reason"] == study.points[2].reason
    report = drag_study_report(study)
    assert report.front.statuses[0].word == "incomplete"


def test_where_all_are_wrong_the_first_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="below the last station"):
        rodwell.drag_study(written(tmp_path, depth='["3500 m", "3600 m"]', top="study = true"))


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"open": "[0.2, 0.3]"}, "declare it with study = true at the top of the file"),
        ({"top": "study = true"}, "has no input that varies"),
        ({"top": "study = true", "open": "[0.2]"}, "must hold at least two values"),
        ({"open": '"0.1...0.4 in 4"'}, "has three dots"),
        ({"open": '"0.1..0.4 in 5 steps"'}, "is not a range"),
        ({"open": '"0.1..0.4 in 401"'}, "must have from 2 to 400 values"),
        ({"open": '"0.1..0.4 in 30"', "cased": '"0.1..0.4 in 30"'}, "makes 30 × 30 = 900 points"),
        ({"open": '"0.1..0.4 in 3"', "cased": '"0.1..0.4 in 3"', "mud": '"0..9 kg/m^3 in 3"'}, "is the third input"),
        ({"pipe": PLAIN["pipe"].replace('"5 in"', '"4..5 in in 3"')}, "one [[string]] for each section"),
        ({"open": '"2..3 in 3"'}, "must be from 0 to 1"),
    ],
)
def test_what_is_no_study_is_explained(tmp_path: Path, changes: dict[str, str], says: str) -> None:
    result = CliRunner().invoke(cli, ["drag", str(written(tmp_path, **changes)), "--out", str(tmp_path / "out")])
    assert isinstance(result.exception, InputError)
    assert says in str(result.exception)
    assert not (tmp_path / "out").exists()


def test_lists_where_the_path_of_the_hole_stands_or_a_road_map_are_refused(tmp_path: Path) -> None:
    path = written(tmp_path, top="study = true")
    text = path.read_text()
    path.write_text(text.replace('survey = "a.csv"', 'survey = ["a.csv", "b.csv"]'))
    with pytest.raises(InputError, match="make a file for each"):
        rodwell.drag_study(path)
    path.write_text(text + '[well.road_map]\nto = "1000..2000 m in 3"\n')
    with pytest.raises(InputError, match="no road map"):
        rodwell.drag_study(path)
    with pytest.raises(InputError, match="single values"):
        rodwell.drag_study(written(tmp_path, top="study = true", open="[[0.2, 0.3], 0.3]"))


def test_a_well_says_how_its_study_is_computed(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="this is a range, a parameter study: compute it with `rodwell drag`"):
        rodwell.Well.read(written(tmp_path, open='"0.2..0.3 in 3"'))
    with pytest.raises(InputError, match="the file is a parameter study: compute it with `rodwell drag`"):
        rodwell.Well.read(written(tmp_path, top="study = true", open="[0.2, 0.3]"))


def test_the_folder_of_a_study(tmp_path: Path) -> None:
    """Table, workbook and JSON hold the same numbers; the figure one curve for each operation and value."""
    road_map = '"-50 kN"\n[well.road_map]\nfrom = "300 m"\ndepths = 3'
    path = written(tmp_path, open='"0.2..0.3 in 3"', block='["0 kN", "100 kN"]', top="study = true", force=road_map)
    out = tmp_path / "out"
    result = CliRunner().invoke(cli, ["drag", str(path), "--out", str(out), "--json", "--units", "field"])
    assert result.exit_code == 0, result.output
    data: dict[str, Any] = json.loads(result.output)
    assert json.loads((out / "study.json").read_text()) == data
    assert {"report.html", "curves.png", "curves.svg", "points.csv", "points.xlsx", "well.toml"} <= {
        file.name for file in out.iterdir()
    }
    rows = list(csv.DictReader((out / "points.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) == 12
    for k, row in enumerate(rows):
        one = data["points"][k // 2]["operations"][k % 2]
        assert float(row["hook load [lbf]"]) * 4.4482216152605 == pytest.approx(one["hook_load"]["value"], rel=1e-12)
    sheet = openpyxl.load_workbook(out / "points.xlsx").active
    assert sheet is not None
    assert any(
        cell.value == pytest.approx(float(rows[0]["hook load [lbf]"]), rel=1e-12)
        for line in sheet.iter_rows()
        for cell in line
    )
    assert any("the road map of the file is left out" in line for line in data["summary"])
    study = rodwell.drag_study(path)
    figure = plot_drag_study(study)
    assert len(figure.axes) == 2
    assert len(figure.axes[0].containers) == 2 * 2
    grid = next(block for block in drag_study_report(study).sections[0].blocks if isinstance(block, Grid))
    assert len(grid.rows) == 12


def test_measurements_need_single_values(tmp_path: Path) -> None:
    path = written(tmp_path, open='"0.2..0.3 in 3"')
    result = CliRunner().invoke(cli, ["drag", str(path), "--calibrate", "m.csv", "--out", str(tmp_path / "out")])
    assert isinstance(result.exception, InputError)
    assert "takes a file of single values" in str(result.exception)
