"""The smooth axis through a survey or a centre line: what it meets, closed forms, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from rodwell import InputError, Survey
from rodwell.problem.hole import Hole
from rodwell.survey.centerline import read_centerline
from rodwell.survey.path import (
    Tortuosity,
    minimum_curvature,
    path_of_points,
    path_of_survey,
    station_directions,
)

MD = np.array([0.0, 500.0, 1000.0, *np.arange(1030.0, 1901.0, 30.0), *np.arange(1930.0, 2501.0, 30.0)])
BUILD = Survey.of(MD, np.clip((MD - 1000.0) / 10.0, 0.0, 90.0), np.maximum(MD - 1900.0, 0.0) / 30.0)
"""Vertical to 1000 m, 3°/30 m to horizontal at 1900 m, then a turn of 1°/30 m."""


def test_stations_are_met_in_depth_and_direction_and_the_axis_has_the_measured_length() -> None:
    path = path_of_survey(BUILD)
    assert path.bottom == pytest.approx(2500.0, abs=1e-9)
    assert np.max(np.abs(path.directions(MD) - station_directions(BUILD))) < 1e-14


def test_curvature_and_its_rate_are_continuous_at_stations() -> None:
    path = path_of_survey(BUILD)
    for station in (1000.0, 1030.0, 1900.0, 1930.0):
        around = station + np.array([-2e-4, -1e-4, 1e-4, 2e-4])
        curvature = np.diff(path.directions(around), axis=0) / np.diff(around)[:, None]
        assert np.max(np.abs(curvature[2] - curvature[0])) < 1e-7  # minimum curvature jumps by 1.7e-3 /m


def test_straight_courses_stay_straight_and_circles_are_circles() -> None:
    path = path_of_survey(BUILD)
    vertical = path.points(np.linspace(0.0, 1000.0, 41))
    assert np.max(np.abs(vertical[:, :2])) < 1e-12  # a bend that begins at 1000 m does not bulge the courses above
    depths = np.linspace(1060.0, 1840.0, 53)
    places = path.points(depths)
    radius = 30.0 / math.radians(3.0)
    inclination = math.radians(3.0) * (depths - 1000.0) / 30.0
    circle = radius * np.stack([0.0 * depths, -np.cos(inclination), -np.sin(inclination)], axis=1)
    assert np.max(np.abs((places - places[0]) - (circle - circle[0]))) < 1e-9


def test_minimum_curvature_goes_through_its_stations_along_circles() -> None:
    stations = np.stack([BUILD.east, BUILD.north, -BUILD.tvd], axis=1)
    assert np.max(np.abs(minimum_curvature(BUILD, MD) - stations)) < 1e-9
    two = Survey.of([0.0, 90.0], [30.0, 60.0], [0.0, 40.0])
    points = minimum_curvature(two, np.array([0.0, 45.0, 90.0]))
    radius = 90.0 / two.dogleg[0]
    assert np.linalg.norm(points[1] - points[0]) == pytest.approx(2.0 * radius * math.sin(two.dogleg[0] / 4.0))
    assert np.linalg.norm(points[2] - points[0]) == pytest.approx(2.0 * radius * math.sin(two.dogleg[0] / 2.0))


def test_two_stations_make_the_circle_of_minimum_curvature() -> None:
    two = Survey.of([0.0, 90.0], [30.0, 60.0], [0.0, 40.0])
    piece = path_of_survey(two).piece(0.0, 90.0)
    assert piece.astray < 1e-5  # in m: of a polynomial that stands for an arc of 35°
    assert piece.hole.sharpest == pytest.approx(two.dogleg[0], rel=1e-4)


def test_a_turned_survey_has_a_turned_axis() -> None:
    """The way of joining stations does not depend on where north is."""
    plain = path_of_survey(BUILD).points(np.linspace(0.0, 2500.0, 60))
    turned = path_of_survey(Survey.of(BUILD.md, BUILD.inclination, BUILD.azimuth + 37.0)).points(
        np.linspace(0.0, 2500.0, 60)
    )
    c, s = math.cos(math.radians(37.0)), math.sin(math.radians(37.0))
    back = turned @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    assert np.max(np.abs(back - plain)) < 1e-9


def test_a_piece_is_the_hole_of_a_rod_its_end_s_1_at_the_smaller_depth() -> None:
    path = path_of_survey(BUILD)
    piece = path.piece(1300.0, 1360.0)
    assert piece.hole.alpha == pytest.approx(33.0, abs=1e-9)
    assert piece.hole.planar
    assert np.max(np.abs(piece.hole.curvatures(np.linspace(0, 1, 9)) - [math.radians(6.0), 0.0])) < 1e-7
    assert piece.turned < 1e-9
    assert piece.astray < 1e-9
    ends = piece.hole.points(np.array([0.0, 1.0]))
    assert ends[1, 2] > ends[0, 2]
    turn = path.piece(2000.0, 2060.0).hole
    assert turn.alpha == pytest.approx(90.0, abs=1e-9)
    right = -turn.curvatures(np.array([0.5]))[0, 1]  # azimuth grows with depth: to the right, looking down the hole
    assert right == pytest.approx(math.radians(2.0), rel=1e-6)


@pytest.mark.parametrize(("upper", "lower"), [(1015.0, 1975.0), (1000.0, 1930.0)])
def test_a_piece_is_the_same_curve_as_the_path_and_knows_its_stations(upper: float, lower: float) -> None:
    path, length = path_of_survey(BUILD), lower - upper
    hole = path.piece(upper, lower).hole
    depths = np.linspace(upper, lower, 173)
    places = (lower - depths) / length
    apart = (path.points(depths) - path.points(np.array([lower]))) / length
    assert np.max(np.abs(hole.points(places) - apart)) < 1e-12
    assert np.max(np.abs(hole.frame(places)[:, 2] + path.directions(depths))) < 1e-12
    inside = MD[(upper < MD) & (lower > MD)]
    assert np.max(np.abs(hole.stations - (lower - inside[::-1]) / length)) < 1e-12
    step = 1e-5
    rates = (hole.curvatures(places[1:-1] + step) - hole.curvatures(places[1:-1] - step)) / (2.0 * step)
    assert np.max(np.abs(hole.curvature_rates(places[1:-1]) - rates)) < 1e-3 * np.max(np.abs(rates))
    around = hole.stations[:, None] + 1e-9 * np.array([-1.0, 1.0])
    assert np.max(np.abs(np.diff(hole.curvature_rates(around.ravel()).reshape(-1, 2, 2), axis=1))) < 1e-4


def test_beside_a_bend_the_difference_from_minimum_curvature_is_told() -> None:
    piece = path_of_survey(BUILD).piece(990.0, 1060.0)
    depths = np.array([990.0, 1000.0, 1015.0, 1030.0, 1045.0, 1060.0])
    apart = piece.path.points(depths) - minimum_curvature(BUILD, depths)
    assert piece.astray == pytest.approx(np.max(np.linalg.norm(apart - apart[0], axis=1)), rel=1e-9)
    assert 0.05 < piece.astray < 0.3
    assert piece.turned < 1e-6


def test_tortuosity_is_seeded_leaves_stations_alone_and_has_its_size() -> None:
    straight = Survey.of(np.arange(0.0, 3001.0, 100.0), np.full(31, 40.0), np.full(31, 20.0))
    size = math.radians(0.3)
    path = path_of_survey(straight, Tortuosity(size, 10.0, 7))
    same = path_of_survey(straight, Tortuosity(size, 10.0, 7))
    other = path_of_survey(straight, Tortuosity(size, 10.0, 8))
    depths = np.arange(0.0, 3000.0, 10.0)
    assert np.array_equal(path.points(depths), same.points(depths))
    assert not np.allclose(path.points(depths), other.points(depths))
    assert np.max(np.abs(path.directions(straight.md) - station_directions(straight))) < 1e-14
    between = depths[depths % 100.0 > 0.0]
    off = path.directions(between) - station_directions(straight)[0]
    assert np.sqrt(np.mean(np.sum(off**2, axis=1)) / 2.0) == pytest.approx(size, rel=0.1)  # of 540 normal numbers


@pytest.mark.parametrize(
    ("what", "said"),
    [
        (lambda: path_of_survey(BUILD).piece(2490.0, 2520.0), "is not within what survey has, 0 to 2500 m"),
        (lambda: path_of_survey(BUILD, Tortuosity(0.2, 10.0)), "at most 5 deg"),
        (lambda: path_of_survey(BUILD, Tortuosity(1e-3, 0.01)), "at most 10000"),
        (lambda: path_of_survey(Survey.of([0.0, 30.0, 60.0], [0.0, 70.0, 80.0])), "turns by 70 degrees between 0 and"),
    ],
)
def test_pieces_and_surveys_that_say_too_little_are_refused(what: object, said: str) -> None:
    with pytest.raises(InputError, match=said):
        what()  # type: ignore[operator]


HELIX = np.stack([20.0 * np.cos(np.arange(40) / 10), 20.0 * np.sin(np.arange(40) / 10), np.arange(40) * 0.8], axis=1)


@pytest.mark.parametrize("separator", [",", ";", "\t", "  "])
def test_a_centre_line_is_read_with_the_unit_of_its_header(tmp_path: Path, separator: str) -> None:
    file = tmp_path / "vessel.csv"
    rows = [separator.join(f"{value:.9f}" for value in point) for point in HELIX]
    head = separator.join(["x[mm]", "y[mm]", "z[mm]"])
    file.write_text("# scan 7\n" + "\n".join([head, *rows]) + "\n", encoding="utf-8")
    points = read_centerline(file)
    assert np.allclose(points, 1e-3 * HELIX, atol=1e-12)
    path = path_of_points(points, file.name)
    assert path.bottom == pytest.approx(1e-3 * 3.9 * math.hypot(20.0, 8.0), rel=1e-6)  # an ideal helix
    piece = path.piece(0.01, 0.06)
    assert isinstance(piece.hole, Hole)
    assert piece.hole.sharpest / piece.length == pytest.approx(20.0 / (20.0**2 + 8.0**2) * 1e3, rel=1e-3)
    assert np.allclose(piece.axis[-1], (path.points(np.array([0.01]))[0] - path.points(np.array([0.06]))[0]) / 0.05)


def test_columns_of_a_centre_line_stand_in_any_order_with_units_of_their_own(tmp_path: Path) -> None:
    file = tmp_path / "line.txt"
    file.write_text("n;Z [m];y [cm];X (mm)\n1;0,5;3;2\n2;0,6;3,5;2,5\n", encoding="utf-8")
    assert np.allclose(read_centerline(file), [[0.002, 0.03, 0.5], [0.0025, 0.035, 0.6]])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is empty"),
        ("x,y,z\n1,2,3\n", r"line 1 = 'x,y,z': does not name x, y and z with one unit each"),
        ("x [mm],y [mm]\n1,2\n", "does not name x, y and z"),
        ("x [mm],y [mm],z [furlong]\n1,2,3\n", "does not name x, y and z"),
        ("x [mm],y [mm],z [mm]\n1,2,3\n1,b,3\n", r"line 3, y = 'b': must be a number"),
        ("x [mm],y [mm],z [mm]\n1,2\n", r"line 2, z: must be a number"),
    ],
)
def test_what_is_no_centre_line_is_refused_by_its_line(tmp_path: Path, text: str, said: str) -> None:
    file = tmp_path / "vessel.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=said):
        read_centerline(file)
