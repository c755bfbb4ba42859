"""Files of wells: what is wrong is told with the key, what is allowed and what to do."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from drag_wells import PIPE, well_a_survey
from written import of_page, violations

from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.report.folders.drag import write_drag
from rodwell.studies.drag.drag import drag
from rodwell.studies.drag.well_case import Well

SLIDE = {"kind": "slide", "bit_force": "-50 kN"}
GOOD: dict[str, Any] = {
    "hole": {"diameter": "8.5 in", "friction": 0.25},
    "string": [{"name": "collars", "length": "100 m", **PIPE}, PIPE],
    "well": {"operation": [SLIDE]},
}
SECTIONS = [{"from": "0 m", "to": "1200 m", "friction": 0.2}, {"from": "1200 m", "friction": 0.3}]


def read(**changes: Any) -> Well:
    data = copy.deepcopy(GOOD)
    for path, value in changes.items():
        target: Any = data
        *parts, last = path.split("__")
        for part in parts:
            target = target[int(part) if part.isdigit() else part]
        target[int(last) if last.isdigit() else last] = value
    return Well.from_dict(data, survey=well_a_survey())


def test_a_good_file_is_read() -> None:
    found = read(hole__section=SECTIONS)
    assert [part.friction for part in found.hole] == [0.2, 0.3]
    assert found.operations[0].bit_force == -50e3
    assert found.operations[0].bit_depth == 3400.0
    assert found.string[0].rod.length == 100.0


@pytest.mark.parametrize(
    ("changes", "field", "says"),
    [
        ({"hole__friction": 3}, "hole.friction", "must be from 0 to 1"),
        ({"hole__section": [{"to": "1000 m"}, {"from": "1200 m"}]}, "[[hole.section]] 2, from", "leaves a gap"),
        ({"hole__section": [{"to": "1000 m"}, {"from": "900 m"}]}, "[[hole.section]] 2, from", "overlaps"),
        ({"hole__section": [{"to": "1000 m"}, {"friction": 3}]}, "[[hole.section]] 2, friction", "from 0 to 1"),
        ({"hole__section": [{"to": "3000 m"}]}, "[[hole.section]] 1, to", "ends above the last station"),
        ({"string__1": {**PIPE, "length": "3400 m"}}, "string", "is 3500 m long, the well 3400 m"),
        ({"string__0": PIPE}, "[[string]] 1, length", "only the uppermost"),
        ({"string__0": {**PIPE, "joints": 9}}, "[[string]] 1, joint_length", "is missing"),
        ({"string__0__ends": "clamped-clamped"}, "[[string]] 1, ends", "is not known"),
        ({"string__0__outer_diameter": "9 in"}, "hole.diameter", "does not fit"),
        ({"hole__section": [{"to": "9 m"}, {"diameter": "4 in"}]}, "[[hole.section]] 2, diameter", "does not fit"),
        ({"well__operation__0__bit_force": "50 kN"}, "[[well.operation]] 1, bit_force", 'write "-50 kN"'),
        ({"well__operation__0__bit_depth": "9000 m"}, "[[well.operation]] 1, bit_depth", "below the last station"),
        ({"well__operation__0__kind": "run-out"}, "[[well.operation]] 1, kind", "must be"),
        ({"well__operation__0__rpm": 60}, "[[well.operation]] 1, rpm", "does not turn"),
        ({"well__operation": [{"kind": "ream", "rpm": 60}]}, "[[well.operation]] 1, speed", "is missing"),
        (
            {"well__operation": [{"kind": "ream", "rpm": 0, "speed": "1 m/h"}]},
            "[[well.operation]] 1, rpm",
            "must be above 0",
        ),
        ({"well__operation": [{"kind": "run-in", "bit_force": "-5 kN"}]}, "[[well.operation]] 1, bit_force", "slide"),
        ({"well__block": "200 kN"}, "well.block", "did you mean 'block_weight'?"),
        ({"rod": {}}, "rod", "[[string]]"),
        ({"hole__section": {"to": "5 m"}}, "hole.section", "[[hole.section]]"),
        ({"well__contact": "exakt"}, "well.contact", 'must be "exact"'),
        ({"string": []}, "string", "is missing"),
    ],
)
def test_bad_input_is_explained(changes: dict[str, Any], field: str, says: str) -> None:
    with pytest.raises(InputError) as told:
        read(**changes)
    assert told.value.field == field
    assert says in told.value.reason


def test_what_was_written_in_the_section_of_the_hole_is_named() -> None:
    with pytest.raises(InputError, match=r"hole\.diameter = '4\.5 in'"):
        read(hole__diameter="4.5 in")
    data = copy.deepcopy(GOOD)
    data["hole"]["survey"] = "horizontl.csv"
    with pytest.raises(InputError, match=r"hole\.survey"):
        Well.from_dict(data)


def test_a_well_without_operations_says_so() -> None:
    with pytest.raises(InputError, match=r"well.operation: is missing"):
        drag(read(well={}))


def test_a_survey_that_begins_below_the_surface_is_led_to_it_and_says_so() -> None:
    survey = well_a_survey()
    cut = type(survey).of(survey.md[1:], survey.inclination[1:])
    found = Well.from_dict(copy.deepcopy(GOOD), survey=cut)
    assert found.survey.md[0] == 0.0
    assert any("begins at 1000 m" in note for note in found.survey.notes)


def test_the_command_writes_a_folder_and_prints_json(tmp_path: Path) -> None:
    example = Path(__file__).parents[3] / "examples" / "wells" / "horizontal.toml"
    ran = CliRunner().invoke(cli, ["drag", str(example), "--out", str(tmp_path / "out"), "--json"])
    assert ran.exit_code == 0, ran.output
    assert violations(of_page(tmp_path / "out" / "report.html")) == []
    data = json.loads(ran.stdout)
    loads = {one["name"]: one["hook_load"]["value"] for one in data["operations"]}
    assert loads["run-in"] == pytest.approx(222668.1804, rel=1e-9)
    assert loads["slide"] == pytest.approx(146042.6008, rel=1e-9)
    assert set(data["operations"][0]["along"]) >= {"measured_depth", "axial_force", "contact_force", "torque", "error"}
    written = {file.name for file in (tmp_path / "out").iterdir()}
    assert {"drag.json", "operations.csv", "drag.xlsx", "well.toml"} <= written
    one = example.read_text(encoding="utf-8").partition('[[well.operation]]\nkind = "run-in"')[0]
    short = tmp_path / "short.toml"
    short.write_text(one.replace("horizontal.csv", str(example.with_suffix(".csv"))), encoding="utf-8")
    shown = CliRunner().invoke(cli, ["drag", str(short), "--out", str(tmp_path / "o2"), "--units", "field"])
    assert shown.exit_code == 0
    assert "lbf" in shown.output
    assert violations(text for text in shown.output.splitlines() if str(tmp_path) not in text) == []


def test_friction_from_measurements_on_the_command_line(tmp_path: Path) -> None:
    folder = Path(__file__).parents[3] / "examples" / "wells"
    measured = ["--calibrate", str(folder / "extended-reach-hookloads.csv")]
    ran = CliRunner().invoke(
        cli, ["drag", str(folder / "extended-reach.toml"), *measured, "--out", str(tmp_path / "out")]
    )
    assert ran.exit_code == 0, ran.output
    assert "friction factor of 9 5/8 in casing: 0.179" in ran.output  # the example was made with 0.18 and 0.27
    written = {file.name for file in (tmp_path / "out").iterdir()}
    assert {"calibration.csv", "calibration.svg", "road-map.csv", "road-map.svg", "report.html"} <= written
    data = json.loads((tmp_path / "out" / "drag.json").read_text(encoding="utf-8"))
    assert data["calibration"]["friction"][1]["value"] == pytest.approx(0.27, abs=0.01)
    assert "Friction from measurements" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_the_report_says_for_whom_it_is(tmp_path: Path) -> None:
    found = drag(read(report={"client": "Ystad Wells", "author": "N. N."}, string__1={**PIPE}))
    write_drag(found, tmp_path / "out")
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Ystad Wells" in page
    with pytest.raises(InputError, match="must be a picture"):
        read(report={"logo": "logo.gif"})
