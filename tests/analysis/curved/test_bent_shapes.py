"""The rod in a curved hole in space: the shape that is drawn and exported is the one that forces balance on."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell import InputError, Problem, Solution, follow
from rodwell.analysis.space.surfaces import cylinder, straight_contact, tube, wall_places, wall_rings, within_wall
from rodwell.analysis.state.in_hole import InHole

PROBLEM = Problem(15.0, 70.0, clearance=0.02, build=0.6)


@pytest.fixture(scope="module")
def buckled() -> Solution:
    branch = follow(PROBLEM, 1, until=-260.0)
    return branch.at(-250.0)


def test_in_true_scale_it_is_the_curve_of_the_certificate(buckled: Solution) -> None:
    rod = buckled.geometry(201)
    assert PROBLEM.hole is not None
    centre, frames = InHole(PROBLEM, buckled.meshes.fine, buckled.point.fine).frames(rod.s)
    middle = np.array([0.5])
    turn = PROBLEM.hole.frame(middle)[0]
    moved = (centre - PROBLEM.hole.points(middle)) @ turn.T + np.array([0.0, 0.0, 0.5])
    assert np.max(np.abs(moved - rod.centreline)) < 1e-14
    assert np.max(np.abs(frames @ turn.T - np.stack([rod.t1, rod.d1, rod.u1], axis=1))) < 1e-14
    assert np.allclose(np.linalg.norm(rod.centreline - rod.axis, axis=1), 0.02, atol=1e-14)


def test_the_wall_is_a_bent_tube_around_the_axis_and_the_rod_lies_within(buckled: Solution) -> None:
    rod = buckled.geometry(201, rod_radius=0.006)
    assert rod.bent
    wall = cylinder(rod, 32)
    off = wall.vertices - rod.axis[wall.place]
    assert np.allclose(np.linalg.norm(off, axis=1), 0.026, atol=1e-14)
    assert len(wall_places(rod)) == 161
    body = tube(rod, 24)
    across = np.einsum("nic,nc->ni", rod.across[body.place], body.vertices - rod.axis[body.place])
    assert np.max(np.hypot(*across.T)) < 0.026 * (1.0 + 1e-3)  # cross-sections are a little aslant of those of the hole
    beyond = within_wall(rod, rod.axis + 0.05 * rod.across[:, 0], np.arange(201))
    assert np.allclose(np.linalg.norm(beyond - rod.axis, axis=1), 0.026, atol=1e-14)


def test_the_line_of_the_lying_rod_is_the_low_side(buckled: Solution) -> None:
    rod = buckled.geometry(201)
    places = wall_places(rod)
    low = rod.axis[places] - rod.wall_radius * rod.across[places, 0]
    assert np.max(np.abs(straight_contact(rod) - low)) < 1e-14
    ring = wall_rings(rod, np.array([0.0]), np.array([100]))[0, 0]
    assert np.allclose(ring, rod.axis[100] + rod.wall_radius * rod.across[100, 0])


def test_a_picture_is_not_enlarged_beyond_the_bend(buckled: Solution) -> None:
    drawn = buckled.geometry(101, radial_scale=None)
    assert 1.0 < drawn.radial_scale <= 0.5 / (0.6 * (0.02 + drawn.rod_radius))
    with pytest.raises(InputError, match="at which the wall reaches the centre of the hole's bend"):
        buckled.geometry(101, radial_scale=80.0)
