"""Load paths off the wall where the curvature of the hole varies along it, in a vertical plane."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from analysis.along_s import drift_and_differences
from analysis.curved.whole_rod import on_the_whole_rod, plane_axis

from rodwell import LoadPath, Problem, follow, load_path
from rodwell.analysis.off_wall.curved.model import RodOffCurvedWall

TANGENT = Problem(15.0, clearance=0.01, axis=plane_axis(lambda s: 0.2 * (1.0 - s) ** 2))
DROP = Problem(15.0, clearance=0.01, axis=plane_axis(lambda s: -0.05 - 0.1 * s, 0.1))


@cache
def path_of(problem: Problem, until: float) -> LoadPath:
    return load_path(problem, until=until, seeds=1)


def test_a_circle_given_by_points_is_an_arc() -> None:
    arc = Problem(15.0, 90.0, clearance=0.01, build=0.2)
    points = Problem(15.0, clearance=0.01, axis=plane_axis(lambda _: 0.2))
    one, other = (path_of(problem, -348.0) for problem in (arc, points))
    assert [event.kind for event in one.events] == [event.kind for event in other.events]
    for event, same in zip(one.events, other.events, strict=True):
        assert same.force.value == pytest.approx(event.force.value, rel=1e-8)
    energies = [path.at(-300.0)[0].state.own_places.energy.value for path in (one, other)]
    assert energies[1] == pytest.approx(energies[0], rel=1e-7)


@pytest.mark.parametrize(("problem", "until"), [(TANGENT, -170.0), (DROP, -230.0)])
def test_lift_off_is_that_of_the_branch_on_the_wall(problem: Problem, until: float) -> None:
    lift_off = follow(problem, 1, until=None).lift_off
    assert path_of(problem, until).lift_off.force.value == pytest.approx(lift_off.force, rel=1e-8)


@pytest.mark.parametrize(
    ("problem", "until", "load"),
    [(TANGENT, -170.0, -155.0), (TANGENT, -170.0, -169.0), (DROP, -230.0, -138.0), (DROP, -230.0, -200.0)],
)
def test_forces_and_moments_on_the_whole_rod_add_up_to_nothing(problem: Problem, until: float, load: float) -> None:
    """With own places, and every state passes its certificate of balance along the rod."""
    state = path_of(problem, until).at(load)[0].state
    assert state.certificate.passed
    assert not state.fine.pattern.full
    assert state.own_places.certificate.worst < 1e-7
    force, moment = on_the_whole_rod(state.own_places)
    assert np.max(np.abs(force)) < 3e-8 * abs(load)
    assert np.max(np.abs(moment)) < 3e-8 * abs(load)


@pytest.mark.parametrize("fields", [1, 2])
def test_what_a_density_changes_by_along_s(fields: int) -> None:
    """Against differences: on the wall and off it, with slope and twist."""
    model = RodOffCurvedWall(TANGENT.but(twist=2.0))
    drift, known = drift_and_differences(model, fields, model.given[0][:, None, None])
    assert drift == pytest.approx(known, abs=1e-8 * float(np.max(np.abs(known))))


def test_a_rod_on_the_outside_of_a_bend_meets_no_kink_where_it_reaches_beyond_the_axis() -> None:
    """The curvature goes on as it does within, −0.05 − 0.1 S, as far as the rod reaches."""
    assert DROP.hole is not None
    places = np.array([-5e-4, 1.0 + 5e-4])
    assert DROP.hole.curvatures(places)[:, 0] == pytest.approx(-0.05 - 0.1 * places, abs=1e-7)
    assert DROP.hole.curvature_rates(places)[:, 0] == pytest.approx([-0.1, -0.1], abs=1e-4)
