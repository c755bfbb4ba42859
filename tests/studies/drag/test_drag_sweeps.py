"""Road maps over the depth of the bit, and friction factors from measurements."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from drag_wells import FRICTION, PIPE, WEIGHT, operation, well, well_a_survey

from rodwell.errors import InputError
from rodwell.studies.drag.calibration import calibrate
from rodwell.studies.drag.drag import drag
from rodwell.studies.drag.laws import exact
from rodwell.studies.drag.measured import read_measured
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.road_map import road_map
from rodwell.studies.drag.run import run
from rodwell.studies.drag.well_case import Well
from rodwell.survey.survey import Survey

TWO = [
    {"name": "casing", "to": "1900 m", "friction": 0.2},
    {"name": "open hole", "from": "1900 m", "friction": 0.3},
]


def two_frictions(**settings: object) -> Well:
    data = {
        "hole": {"diameter": "8.5 in", "section": TWO},
        "string": [PIPE],
        "well": {"operation": [{"kind": "run-in"}], **settings},
    }
    return Well.from_dict(data, survey=well_a_survey())


def test_a_road_map_is_the_operation_at_every_depth_for_every_friction() -> None:
    asked = {"from": "500 m", "depths": 5, "friction": [0.2, 0.3], "kinds": ["run-in", "pull-out"]}
    found = road_map(two_frictions(road_map=asked))
    assert found is not None
    assert [(curve.kind, curve.label) for curve in found.curves] == [
        ("run-in", "0.2"), ("pull-out", "0.2"), ("run-in", "0.3"), ("pull-out", "0.3"),
    ]  # fmt: skip
    assert found.depths.tolist() == [500.0, 1225.0, 1950.0, 2675.0, 3400.0]
    survey = well_a_survey()
    cut = Cutter(well(survey, {"kind": "run-in"}, friction=0.3))
    single = run(cut, operation("run-in", survey), exact(), "early", depth=2675.0)
    curve = found.curves[2]
    assert abs(curve.hook_load[3] - single.force) <= curve.error[3] + 1e-6
    assert curve.hook_load[0] == pytest.approx(WEIGHT * 500.0, rel=1e-9)  # hangs free
    more, less = found.curves[3].hook_load, found.curves[1].hook_load
    assert np.all(more[1:] > less[1:])
    assert np.all(found.curves[2].hook_load[1:] < found.curves[0].hook_load[1:])


def test_a_road_map_marks_where_an_operation_is_not_possible() -> None:
    survey = Survey.of([0.0, 6000.0], [90.0, 90.0])
    found = drag(well(survey, {"kind": "run-in"}, road_map={"depths": 6, "kinds": "run-in"}, push="50 kN")).road_map
    assert found is not None
    assert not np.any(found.curves[0].possible)  # the first depth is 1000 m: 60 kN of friction
    assert np.isnan(found.curves[0].hook_load[-1])


@pytest.mark.parametrize(
    ("asked", "field"),
    [
        ({"to": "4000 m"}, "well.road_map.to"),
        ({"from": "3400 m"}, "well.road_map.from"),
        ({"friction": [3.0]}, "well.road_map.friction"),
        ({"friction": [0.2], "friction_times": [1.0]}, "well.road_map.friction_times"),
        ({"kinds": ["ream"]}, "well.road_map.kinds"),
        ({"kinds": ["slide"], "bit_force": "50 kN"}, "well.road_map.bit_force"),
    ],
)
def test_bad_road_maps_are_explained(asked: dict[str, object], field: str) -> None:
    with pytest.raises(InputError) as told:
        road_map(two_frictions(road_map=asked))
    assert told.value.field == field


def measurements(tmp_path: Path, noise: float, frictions: tuple[float, float] = (0.17, 0.31)) -> Path:
    """Hook loads and torques of a well of known friction, with noise."""
    made = two_frictions()
    cut = Cutter(made, frictions)
    draw = np.random.default_rng(7)
    lines = ["# made for the test", "bit depth [m],kind,hook_load [kN],torque [kN m]"]
    for depth in np.linspace(1200.0, 3400.0, 12):
        for kind in ("run-in", "pull-out", "rotate-off-bottom"):
            one = run(cut, replace(operation(kind, made.survey), bit_depth=float(depth)), exact(), "equal-energy")
            hook = one.force / 1e3 + noise * draw.normal()
            torque = one.torque / 1e3 + 0.02 * noise * draw.normal()
            lines.append(f"{float(depth)!r},{kind},{hook!r},{repr(torque) if one.torque else ''}")
    file = tmp_path / "measured.csv"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def test_friction_that_made_the_loads_is_found(tmp_path: Path) -> None:
    made = two_frictions()
    found = calibrate(made, read_measured(measurements(tmp_path, 0.0), made))
    assert [value.value for value in found.friction] == pytest.approx([0.17, 0.31], abs=1e-7)
    assert found.notes == ()


def test_its_uncertainty_covers_the_noise(tmp_path: Path) -> None:
    made = two_frictions()
    found = calibrate(made, read_measured(measurements(tmp_path, 2.0), made))
    for value, truth in zip(found.friction, (0.17, 0.31), strict=True):
        assert 0.0 < value.error < 0.02
        assert abs(value.value - truth) < 3.0 * value.error
    assert 1e3 < found.spread[0] < 3e3  # noise of 2 kN
    assert found.correlation[0, 0] == pytest.approx(1.0)
    assert found.well.hole[1].friction == found.friction[1].value


def test_sections_that_nothing_is_measured_of_keep_their_friction_and_say_so(tmp_path: Path) -> None:
    file = tmp_path / "shallow.csv"
    lines = ["bit_depth [m],kind,hook_load [kN]"]
    lines += [f"{depth},pull-out,{load}" for depth, load in ((1600, 400), (1700, 410), (1800, 420))]
    file.write_text("\n".join(lines), encoding="utf-8")
    made = two_frictions()
    found = calibrate(made, read_measured(file, made))
    assert found.not_told == ("open hole",)
    assert found.friction[1].value == 0.3
    assert np.isnan(found.friction[1].error)


def test_a_fit_at_its_bound_says_so(tmp_path: Path) -> None:
    """Hook loads a tenth of what hangs there, as with a wrong unit: no friction explains them."""
    file = tmp_path / "wrong.csv"
    lines = ["bit_depth [m],kind,hook_load [kN]", *(f"{depth},pull-out,40" for depth in (1600, 1700, 1800))]
    file.write_text("\n".join(lines), encoding="utf-8")
    made = two_frictions()
    notes = calibrate(made, read_measured(file, made)).notes
    assert "casing is at its bound, 0" in notes[0]
    assert any("All measured hook loads are below" in note for note in notes)
    assert any("of their size" in note for note in notes)


def test_the_torque_of_the_bit_is_no_friction(tmp_path: Path) -> None:
    made = two_frictions()
    line = "bit_depth [m],kind,torque [kN m],bit_torque [kN m],bit_force [kN]\n3000,drill,12,3,-50\n"
    file = tmp_path / "drill.csv"
    file.write_text(line, encoding="utf-8")
    one = read_measured(file, made)[0]
    assert (one.operation.bit_torque, one.operation.bit_force, one.torque) == (3e3, -50e3, 12e3)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("bit_depth [m],kind,hook_load\n100,run-in,5\n", "has no unit"),
        ("bit_depth [m],kind\n100,run-in\n", "is missing"),
        ("bit_depth [m],kind,hook_load [kN],mud [s]\n100,run-in,5,6\n", "is not known"),
        ("bit_depth [m],kind,hook_load [kN]\n100,slipping,5\n", "must be run-in"),
        ("bit_depth [m],kind,hook_load [kN]\n5000,run-in,5\n", "at most 3400 m"),
        ("bit_depth [m],kind,hook_load [kN]\n1500,run-in,five\n", "is not a number"),
        ("bit_depth [m],kind,hook_load [kN]\n1500,run-in,\n", "measures nothing"),
        ("bit_depth [m],kind,hook_load [kN]\n1500,run-in,300\n2500,run-in,300\n", "too few"),
        ("bit_depth [m],kind,hook_load [kN]\n1500,rotate-off-bottom,300\n1600,rotate-off-bottom,300\n", "depends on"),
        ("bit_depth [m],kind,torque [kN m]\n1500,drill,9\n", "bit_torque"),
        ("bit_depth [m],kind,hook_load [kN],wob [kN]\n1500,run-in,9,-5\n", "off bottom"),
        ("bit_depth [m],kind,hook_load [kN],wob [kN]\n1500,pull-out,9,-5\n", "overpull is positive"),
        ("", "has no measurements"),
    ],
)
def test_bad_measurements_are_explained(tmp_path: Path, text: str, says: str) -> None:
    file = tmp_path / "measured.csv"
    file.write_text(text, encoding="utf-8")
    made = two_frictions()
    with pytest.raises(InputError, match=says):
        calibrate(made, read_measured(file, made))


def test_friction_of_one_section_is_that_of_the_file() -> None:
    assert well(well_a_survey(), {"kind": "run-in"}).hole[0].friction == FRICTION
