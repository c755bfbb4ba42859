"""A problem in a curved hole: what may be given together, and what a straight one is."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from rodwell import InputError, Problem
from rodwell.problem.hole import Hole

POINTS = tuple(map(tuple, Hole.arc(70.0, 0.3).points(np.linspace(0.0, 1.0, 31))))

STATIONS = ((0.0, 1.0, *[0.0] * 8), (1.0, math.cos(0.2), 0.0, math.sin(0.2), *[0.0] * 6))
"""Arclength, direction, and its two derivatives: from horizontal to 0.2 rad above it, straight at both ends."""


@pytest.mark.parametrize(
    ("given", "field", "why"),
    [
        ({"build": float("nan")}, "build", "finite"),
        ({"build": 200.0}, "build", "above the clearance"),
        ({"build": 6.4}, "build", "run into itself"),
        ({"walk": 0.1, "alpha": 0.0}, "walk", "no high side"),
        ({"build": 0.1, "turns": 1}, "turns", "must be 0 in a curved hole"),
        (
            {"walk": 0.1, "sections": ((0.5, 1.0, 1.0, 1.2), (0.5, 2.0))},
            "sections",
            "must have one clearance in a hole that leaves the vertical plane",
        ),
        ({"build": 0.1, "ends": "loose-clamped"}, "ends", "leaves the wall"),
        ({"axis": POINTS, "build": 0.1}, "build", "left out"),
        ({"axis": POINTS, "alpha": 60.0}, "alpha", "left out"),
        ({"axis": POINTS[:2]}, "axis", "points"),
        ({"axis": STATIONS[:1]}, "axis", "at least 2"),
        ({"axis": STATIONS[::-1]}, "axis", "rising from 0"),
        ({"axis": (STATIONS[0], (1.0, *[0.1] * 9))}, "axis", "station 2 with a direction of length 0.173"),
        ({"axis": (STATIONS[0], (1.0, -1.0, *[0.0] * 8))}, "axis", "turns by 90° or more"),
        ({"axis": (STATIONS[0], (0.5, *STATIONS[1][1:]))}, "axis", "must be 1 long"),
    ],
)
def test_bad_input_is_explained(given: dict[str, Any], field: str, why: str) -> None:
    with pytest.raises(InputError, match=why) as error:
        Problem(15.0, **given)
    assert error.value.field == field


def test_a_straight_hole_stays_one() -> None:
    assert Problem(15.0).hole is None
    assert Problem(15.0, build=0.0) == Problem(15.0)
    line = Problem(15.0, axis=tuple((s, 0.0, 0.2 * s) for s in np.linspace(0.0, 1.0, 9) / np.hypot(1.0, 0.2)))
    assert line.hole is None
    assert line.alpha == pytest.approx(np.degrees(np.arctan2(1.0, 0.2)), abs=1e-9)


def test_stations_make_a_hole_that_turns_by_what_they_say() -> None:
    problem = Problem(15.0, axis=STATIONS)
    assert problem.alpha == pytest.approx(90.0 - math.degrees(0.1), abs=1e-9)
    assert problem.hole is not None
    assert problem.hole.planar
    assert problem.hole.turning == pytest.approx(0.2, rel=1e-3)
    assert np.allclose(problem.hole.curvatures(np.array([0.0, 1.0])), 0.0, atol=1e-12)


def test_axis_gives_the_inclination_and_survives_a_change() -> None:
    problem = Problem(15.0, axis=POINTS)
    assert problem.alpha == pytest.approx(70.0, abs=1e-8)
    assert problem.but(weight=20.0).axis == problem.axis
    assert not problem.symmetric
    assert Problem(15.0, build=0.3).symmetric
    assert not Problem(15.0, 80.0, build=0.3).symmetric
    assert Problem(15.0, build=0.3, walk=0.1).symmetric  # y(s) → y(1 − s): a level arc is alike from both ends
    assert not Problem(15.0, 80.0, build=0.3, walk=0.1).symmetric
