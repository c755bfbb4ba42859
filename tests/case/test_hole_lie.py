"""[hole] with build, walk, a survey or a centre line: what the problem becomes, and what is said of contradictions."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rodwell import Case, InputError
from rodwell.studies.sweep.varied import varied_inputs

SURVEY = "MD [m],Inc [deg]\n0,0\n500,0\n1000,0\n" + "".join(f"{1000 + 30 * i},{3 * i}\n" for i in range(1, 12))
"""Vertical to 1000 m, then 3°/30 m to 33° at 1330 m."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "well.csv").write_text(SURVEY, encoding="utf-8")
    angle = np.linspace(0.0, 1.0, 60)
    rows = "".join(f"{100 * math.sin(a):.9f},0,{100 * math.cos(a):.9f}\n" for a in angle)
    (tmp_path / "vessel.csv").write_text("x [mm],y [mm],z [mm]\n" + rows, encoding="utf-8")
    return tmp_path


def case(folder: Path, length: str = "60 m", load: dict[str, Any] | None = None, **hole: Any) -> Case:
    rod = {"outer_diameter": "127 mm", "inner_diameter": "108.6 mm", "material": "steel", "length": length}
    data = {"rod": rod, "hole": {"diameter": "216 mm"} | hole, "load": load or {}}
    return Case.from_dict(data, folder=folder)


def test_build_and_walk_are_curvatures_in_the_length_of_the_rod(folder: Path) -> None:
    problem = case(folder, angle_from_vertical="40 deg", build="3 deg/30 m", walk="-1 deg/100 ft").problem
    assert problem.alpha == 40.0
    assert problem.build == pytest.approx(math.radians(6.0))
    assert problem.walk == pytest.approx(-math.radians(60.0 / 30.48))
    assert problem.hole is not None


def test_a_straight_hole_is_the_problem_that_it_was(folder: Path) -> None:
    plain = case(folder, angle_from_vertical="40 deg")
    zero = case(folder, angle_from_vertical="40 deg", build="0 deg/30 m")
    assert plain.problem == zero.problem
    assert plain.problem.hole is None


@pytest.mark.parametrize(
    ("hole", "alpha"),
    [
        ({"to": "1300 m"}, 27.0),
        ({"from": "1240 m"}, 27.0),
        ({"from": "1240 m", "to": "1300 m"}, 27.0),
        ({}, 30.0),
    ],
)
def test_the_inclination_is_that_of_the_survey_at_mid_length(folder: Path, hole: dict[str, str], alpha: float) -> None:
    found = case(folder, survey="well.csv", **hole)
    assert found.problem.alpha == pytest.approx(alpha, abs=1e-9)
    arc = case(folder, angle_from_vertical=f"{alpha} deg", build="3 deg/30 m").problem.hole
    assert found.problem.hole is not None
    assert arc is not None
    places = np.linspace(0.0, 1.0, 11)
    assert np.max(np.abs(found.problem.hole.curvatures(places) - arc.curvatures(places))) < 1e-7
    facts = {fact.label: fact for fact in found.facts}
    assert facts["hole"].value.endswith("m of well.csv")  # type: ignore[union-attr]
    assert facts["smallest radius of the hole's axis"].value == pytest.approx(30.0 / math.radians(3.0), rel=1e-6)
    assert "3°/30 m" in facts["smallest radius of the hole's axis"].note
    assert facts["largest distance from minimum curvature"].value < 1e-9  # type: ignore[operator]


def test_a_straight_piece_of_a_survey_is_a_straight_hole(folder: Path) -> None:
    found = case(folder, survey="well.csv", to="900 m")
    assert found.problem.hole is None
    assert found.problem.alpha == pytest.approx(0.0, abs=1e-9)


def test_a_centre_line_is_a_hole_from_its_first_point_on(folder: Path) -> None:
    found = case(folder, "50 mm", centerline="vessel.csv", diameter="128 mm", **{"from": "10 mm"})
    assert found.problem.hole is not None
    assert found.problem.hole.sharpest == pytest.approx(0.5, rel=1e-6)  # 50 mm on a radius of 100 mm
    assert found.problem.alpha == pytest.approx(90.0 - math.degrees(0.35), abs=1e-6)  # s = 1 at the smaller distance


def test_a_force_at_the_bottom_is_less_at_the_top_by_the_weight_over_the_height_of_the_rod(folder: Path) -> None:
    found = case(folder, load={"applied": "-50 kN", "at": "bottom"}, survey="well.csv", to="1300 m")
    assert found.scales is not None
    weight = found.problem.weight * found.scales.factor("force_per_length")
    radius, clearance = 30.0 / math.radians(3.0), found.problem.clearance * 60.0
    angle = 60.0 / (radius + clearance)  # the rod lies on the outside of the build
    height = (radius + clearance) * 2.0 * math.sin(0.5 * angle) * math.cos(math.radians(27.0))
    there = found.applied[0].force * found.scales.factor("force")
    assert there == pytest.approx(-50e3 + weight * height, rel=1e-9)


def test_tortuosity_is_seeded(folder: Path) -> None:
    def bends(**more: Any) -> float:
        hole = case(folder, survey="well.csv", to="1300 m", tortuosity="0.2 deg", **more).problem.hole
        assert hole is not None
        return hole.sharpest

    assert bends() == bends(tortuosity_seed=1)
    assert bends() != bends(tortuosity_seed=2)


@pytest.mark.parametrize(
    ("hole", "said"),
    [
        ({"survey": "well.csv", "angle_from_vertical": "30 deg"}, r"hole.angle_from_vertical: is given twice"),
        ({"survey": "well.csv", "build": "3 deg/30 m"}, r"hole.build: is given twice"),
        ({"survey": "well.csv", "centerline": "vessel.csv"}, "contradicts hole.survey"),
        ({"survey": "well.csv", "to": "1400 m"}, r"from 1340 to 1400 m, but well.csv knows the hole from 0 to 1330 m"),
        ({"survey": "well.csv", "from": "1300 m"}, r"hole.from = '1300 m': lays the rod of 60 m from 1300 to 1360 m"),
        ({"survey": "well.csv", "from": "1200 m", "to": "1300 m"}, "are 100 m apart, and the rod is 60 m long"),
        ({"survey": "nothing.csv"}, r"hole.survey = 'nothing.csv': does not exist"),
        ({"angle_from_vertical": "30 deg", "to": "1300 m"}, "hole.to: needs hole.survey or hole.centerline"),
        ({"angle_from_vertical": "30 deg", "tortuosity": "1 deg"}, "hole.tortuosity: needs hole.survey"),
        ({"survey": "well.csv", "tortuosity_seed": 3}, "hole.tortuosity: is missing"),
        ({"survey": "well.csv", "tortuosity": "20 deg"}, r"hole.tortuosity = .20 deg.: must be above 0 and at most 5"),
        ({"survey": "well.csv", "tortuosity": "1 deg", "tortuosity_seed": 0}, "a whole number from 1 to 1000000000"),
        ({"angle_from_vertical": "0 deg", "walk": "1 deg/30 m"}, "hole.walk: must be 0 at alpha = 0"),
        ({"angle_from_vertical": "90 deg", "build": "3"}, "hole.build = '3': must be a curvature"),
        ({"angle_from_vertical": "90 deg", "build": "300 deg/30 m"}, "makes the hole run into itself"),
        ({"angle_from_vertical": "90 deg", "axis": "a.csv"}, "write centerline, a file of points"),
        ({"angle_from_vertical": "90 deg", "dogleg": "3"}, "write build"),
        ({}, "is missing: give it or hole.angle_from_horizontal"),
    ],
)
def test_what_contradicts_or_does_not_fit_is_said(folder: Path, hole: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        case(folder, **hole)


def test_a_range_of_build_is_a_study() -> None:
    (varied,) = varied_inputs({"rod": {}, "hole": {"build": "0..6 deg/30 m in 4"}})
    assert varied.numbers == (0.0, 2.0, 4.0, 6.0)
    assert varied.values[1] == "2.0 deg/30 m"
    assert varied.label == "build of the hole [deg/30 m]"


def string_case(folder: Path, outer: str, **hole: Any) -> Case:
    lower = {"outer_diameter": outer, "inner_diameter": "76.2 mm", "material": "steel", "length": "20 m"}
    upper = {"outer_diameter": "127 mm", "inner_diameter": "108.6 mm", "material": "steel", "length": "40 m"}
    return Case.from_dict({"string": [lower, upper], "hole": {"diameter": "216 mm"} | hole}, folder=folder)


@pytest.mark.parametrize(
    "hole", [{"survey": "well.csv", "to": "1300 m"}, {"build": "3 deg/30 m", "walk": "1 deg/30 m"}]
)
def test_a_string_lies_along_a_curved_hole(folder: Path, hole: dict[str, str]) -> None:
    """The stiffer section hangs below a third of the length; weight goes like the metal's area, stiffness like I."""
    extra = {} if "survey" in hole else {"angle_from_vertical": "40 deg"}
    problem = string_case(folder, "127 mm", **hole, **extra).problem
    assert problem.hole is not None
    (length, stiffness, weight, *_), (_, light, hangs, *_) = problem.sections
    assert length == pytest.approx(1.0 / 3.0)
    assert stiffness / light == pytest.approx((127.0**4 - 76.2**4) / (127.0**4 - 108.6**4), rel=1e-9)
    assert weight / hangs == pytest.approx((127.0**2 - 76.2**2) / (127.0**2 - 108.6**2), rel=1e-9)


def test_a_string_of_several_clearances_is_taken_along_a_survey_that_stays_in_a_vertical_plane(folder: Path) -> None:
    problem = string_case(folder, "171 mm", survey="well.csv", to="1300 m").problem
    assert problem.bridges
    assert problem.hole is not None
    assert problem.hole.planar
