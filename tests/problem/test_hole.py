"""The hole's axis: closed forms of circle and helix, what its frame must obey, and holes that cannot be."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rodwell.errors import InputError
from rodwell.problem.axis import tabulate
from rodwell.problem.hole import Hole
from rodwell.survey.path import path_of_survey
from rodwell.survey.survey import Survey

ALONG = np.linspace(-0.01, 1.01, 41)
RADIUS, PITCH = 0.7, 0.3
C = math.hypot(RADIUS, PITCH)


def helix(places: np.ndarray, tilt: float = 0.0) -> np.ndarray:
    """Points of a helix by arclength, its axis tilted from the vertical."""
    u = places / C
    x, y, z = RADIUS * np.sin(u), RADIUS * np.cos(u), PITCH * u
    return np.stack([x * math.cos(tilt) + z * math.sin(tilt), y, z * math.cos(tilt) - x * math.sin(tilt)], axis=1)


def holes() -> dict[str, Hole]:
    places = np.linspace(0.0, 1.0, 81)
    return {
        "straight": Hole.arc(60.0),
        "arc": Hole.arc(60.0, 0.5, -0.8),
        "points": Hole.through(helix(places, 0.4)),
        "drop": Hole.arc(120.0, -0.7),
    }


@pytest.mark.parametrize("name", ["straight", "arc", "points", "drop"])
def test_frame_is_right_handed_without_twist_and_its_rates_are_the_curvatures(name: str) -> None:
    hole = holes()[name]
    frames, curvatures = hole.frame(ALONG), hole.curvatures(ALONG)
    assert np.max(np.abs(frames @ frames.transpose(0, 2, 1) - np.eye(3))) < 1e-14
    assert np.allclose(np.linalg.det(frames), 1.0, atol=1e-14)
    h = 1e-3
    inner = np.linspace(0.05, 0.95, 13)
    steps = h * np.array([-2, -1, 1, 2])
    weights = np.array([1, -8, 8, -1]) / (12 * h)  # central differences, O(h⁴)
    rate = sum(w * hole.frame(inner + d) for w, d in zip(weights, steps, strict=True))
    velocity = sum(w * hole.points(inner + d) for w, d in zip(weights, steps, strict=True))
    frames, curvatures = hole.frame(inner), hole.curvatures(inner)
    assert np.max(np.abs(velocity - frames[:, 2])) < 1e-11
    assert np.max(np.abs(rate[:, :2] + curvatures[:, :, None] * frames[:, 2, None])) < 1e-11
    assert np.max(np.abs(rate[:, 2] - np.einsum("nk,nkc->nc", curvatures, frames[:, :2]))) < 1e-11


@pytest.mark.parametrize("name", ["straight", "arc", "points", "drop"])
def test_first_normal_is_the_high_side_in_the_middle_and_alpha_the_inclination_there(name: str) -> None:
    hole = holes()[name]
    first, second, tangent = hole.frame(np.array([0.5]))[0]
    assert tangent[2] == pytest.approx(math.cos(math.radians(hole.alpha)), abs=1e-14)
    assert first[2] == pytest.approx(math.sin(math.radians(hole.alpha)), abs=1e-14)
    assert second[2] == pytest.approx(0.0, abs=1e-14)


def test_build_is_concave_upward_and_walk_to_the_right_looking_down_the_hole() -> None:
    places = np.array([0.0, 0.5, 1.0])
    build, walk = Hole.arc(60.0, build=0.5), Hole.arc(60.0, walk=0.5)
    below, middle, above = build.points(places)
    assert 0.5 * (below + above)[2] > middle[2]  # a chord above: concave upward
    inclination = np.degrees(np.arccos(build.frame(places)[:, 2, 2]))
    assert np.allclose(inclination, 60.0 + np.degrees(0.5) * np.array([0.5, 0.0, -0.5]))  # it grows with depth
    down = -walk.frame(places)[:, 2]
    right = np.cross(down[1], [0.0, 0.0, 1.0])
    assert down[0] @ right > 0.0 > down[2] @ right


def test_an_arc_is_a_circle_of_its_curvature() -> None:
    hole = Hole.arc(30.0, 0.4, 0.3)
    points = hole.points(np.array([0.0, 0.5, 1.0]))
    assert np.linalg.norm(points[2] - points[0]) == pytest.approx(2.0 * math.sin(0.25) / 0.5, abs=1e-15)
    assert np.array_equal(points[0], np.zeros(3))
    assert hole.turning == pytest.approx(0.5)
    assert not hole.planar
    assert Hole.arc(30.0, 0.4).planar


@pytest.mark.parametrize(("count", "tolerance"), [(21, 5e-8), (81, 2e-11)])
def test_an_axis_through_points_of_a_helix_has_its_curvature_and_torsion(count: int, tolerance: float) -> None:
    hole = Hole.through(helix(np.linspace(0.0, 1.0, count)))
    places = np.linspace(0.0, 1.0, 57)
    curvatures = hole.curvatures(places)
    middle = np.abs(places - 0.5) < 0.35
    assert np.max(np.abs(hole.points(places) - helix(places))) < tolerance
    assert np.max(np.abs(np.hypot(*curvatures.T) - RADIUS / C**2)[middle]) < 100 * tolerance
    turned = np.unwrap(np.arctan2(curvatures[:, 1], curvatures[:, 0]))
    assert np.polyfit(places[middle], turned[middle], 1)[0] == pytest.approx(-PITCH / C**2, abs=tolerance)
    assert hole.error < 1e-13


def test_points_of_an_arc_give_the_arc_and_those_of_a_line_a_straight_hole() -> None:
    arc = Hole.arc(75.0, 0.6)
    same = Hole.through(arc.points(np.linspace(0.0, 1.0, 61)))
    assert same.alpha == pytest.approx(75.0, abs=1e-9)
    assert same.planar
    assert np.max(np.abs(same.curvatures(ALONG) - arc.curvatures(ALONG))) < 1e-8
    assert np.max(np.abs(same.points(ALONG) - arc.points(ALONG))) < 1e-11
    straight = Hole.through(Hole.arc(40.0).points(np.linspace(0.0, 1.0, 9)))
    assert straight.straight
    assert straight.alpha == pytest.approx(40.0, abs=1e-12)


def test_holes_are_equal_by_value() -> None:
    points = Hole.arc(75.0, 0.6).points(np.linspace(0.0, 1.0, 9))
    assert Hole.through(points) == Hole.through(points.tolist())
    assert hash(Hole.through(points)) == hash(Hole.through(points.tolist()))
    assert Hole.arc(75.0, 0.6) != Hole.arc(75.0, 0.61)


def test_a_vertical_hole_has_no_high_side_to_walk_from() -> None:
    with pytest.raises(InputError, match="no high side"):
        Hole.arc(0.0, walk=0.1)
    bent = Hole.through(Hole.arc(0.0, 0.2).points(np.linspace(0.0, 1.0, 31)))
    assert bent.alpha == pytest.approx(0.0, abs=1e-9)
    assert bent.curvatures(np.array([0.5]))[0] == pytest.approx([0.2, 0.0], abs=1e-9)


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ([[0, 0, 0], [0, 0, 0.5], [0, 0, 1]], "at least 4"),
        ([[0, 0], [0, 1], [1, 1], [1, 2]], "not \\(4, 2\\)"),
        ([[0, 0, 0], [0, 0, 0.3], [0, 0, 0.3], [0, 0, 1]], "point 3.*same point"),
        ([[0, 0, 0], [0, 0, 0.4], [0, 0, 0.3], [0, 0, 1]], "point 2.*turns back"),
        ([[0, 0, 0], [0, 0, 0.3], [0, 0, math.nan], [0, 0, 1]], "finite"),
        ([[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]], "length 3': must be 1 long"),
        ("well.csv", "must be points"),
    ],
)
def test_points_that_are_no_axis_are_refused(points: object, said: str) -> None:
    with pytest.raises(InputError, match=said):
        Hole.through(points)  # type: ignore[arg-type]


def test_a_wall_cannot_bend_more_sharply_than_the_clearance() -> None:
    Hole.arc(90.0, 3.0).check(0.3)
    with pytest.raises(InputError, match=r"radius of 0\.3333 L.*above the clearance Δ = 0.35"):
        Hole.arc(90.0, 3.0).check(0.35)


def test_a_hole_that_runs_into_itself_is_refused() -> None:
    circle = Hole.arc(90.0, walk=6.0)  # ends 2 sin(3)/6 = 0.0470 apart
    circle.check(0.0235)
    with pytest.raises(InputError, match=r"walk = 6.*s = 0 and at s = 1 is 0.047"):
        circle.check(0.0236)
    u = np.linspace(0.0, 8.0, 201)  # a coil of pitch 2π · 0.1 and radius 0.7
    length = 8.0 * math.hypot(0.7, 0.1)
    apart = 2.0 * math.pi * 0.1 * 0.7 / math.hypot(0.7, 0.1)  # of neighbouring turns, across them
    coil = Hole.through(np.stack([0.7 * np.cos(u), 0.7 * np.sin(u), 0.1 * u], axis=1) / length)
    coil.check(0.499 * apart / length)
    with pytest.raises(InputError, match="run into itself"):
        coil.check(0.502 * apart / length)


def test_a_table_is_refined_until_it_is_resolved() -> None:
    def motion(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:  # a straight line, unevenly: X = u + 10 u⁶
        along = np.stack([1.0 + 60.0 * u**5, 0.0 * u, 0.0 * u], axis=1)
        return along, np.stack([300.0 * u**4, 0.0 * u, 0.0 * u], axis=1)

    axis = tabulate(np.array([0.0, 1.0]), motion, np.zeros(3))
    assert axis.length == pytest.approx(11.0, abs=1e-13)
    assert np.allclose(axis.at(np.array([5.5]))[2], [[5.5, 0.0, 0.0]], atol=1e-13)
    assert axis.error < 1e-13


@pytest.mark.parametrize("name", ["arc", "points", "stations", "drop"])
def test_upside_down_is_turned_by_half_a_turn_and_its_high_side_is_the_low_one(name: str) -> None:
    """Heights and tangents change their sign, normals are −N1, −N2 turned along: a mirror would leave one of these."""
    if name == "stations":
        survey = Survey.of([0.0, 100.0, 200.0], [52.0, 44.0, 36.0], [70.0, 78.0, 80.0])
        hole = Hole.through(path_of_survey(survey).piece(0.0, 200.0).axis)
    else:
        hole = holes()[name]
    turned, half_turn = hole.upside_down, np.array([1.0, -1.0, -1.0])
    places = np.linspace(0.0, 1.0, 21)
    assert turned.alpha == pytest.approx(180.0 - hole.alpha, abs=1e-9)
    np.testing.assert_allclose(turned.curvatures(places), -hole.curvatures(places), atol=1e-9)
    signs = np.array([-1.0, -1.0, 1.0])[:, None]
    np.testing.assert_allclose(turned.frame(places), signs * half_turn * hole.frame(places), atol=1e-10)
    ways = (np.diff(one.points(places), axis=0) for one in (turned, hole))
    np.testing.assert_allclose(next(ways), half_turn * next(ways), atol=1e-10)
