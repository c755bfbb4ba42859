"""Load paths off the wall of holes that leave the vertical plane: against the wall, a plane, a rod in space."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from analysis.curved.space_form import SpaceRod
from analysis.curved.whole_rod import on_the_whole_rod

import rodwell
from rodwell import InputError, LoadPath, Problem, Survey, diagram, load_path, lying_rod
from rodwell.analysis.discrete.curved import stations_along
from rodwell.survey.path import path_of_survey

BUILD = Problem(15.0, 90.0, clearance=0.01, build=0.2)
TURN = BUILD.but(walk=0.15)
DROP = BUILD.but(build=-0.2)
WELL = Survey.of([0.0, 30.0, 60.0, 100.0], [83.0, 86.0, 88.5, 92.0], [10.0, 14.0, 17.0, 20.5])
SURVEYED = Problem(15.0, clearance=0.01, axis=path_of_survey(WELL).piece(0.0, 100.0).axis)


@cache
def path_of(problem: Problem, until: float) -> LoadPath:
    return load_path(problem, until=until, seeds=1)


@cache
def there_and_back() -> LoadPath:
    return load_path(SURVEYED, until=-390.0, unload_to=-370.0, seeds=1)


@pytest.mark.parametrize(("problem", "until"), [(TURN, -455.0), (SURVEYED, None)])
def test_lift_off_is_that_of_the_rod_as_it_lies(problem: Problem, until: float | None) -> None:
    """Another program, of rods kept on the wall: splines, and contact as a field of them."""
    path, lying = there_and_back() if until is None else path_of(problem, until), lying_rod(problem)
    assert path.events[0].kind == "lift_off"
    assert lying.end is not None
    assert path.lift_off.force.value == pytest.approx(lying.end.force, rel=1e-9)
    assert path.lift_off.s == pytest.approx(lying.end.s, abs=1e-6)
    assert path.legs[0].runs[0][0].load == pytest.approx(0.0, abs=1e-9)
    assert path.at(-100.0)[0].state.kind == "on the wall"


def test_a_turn_to_the_left_is_the_mirror_image_of_one_to_the_right() -> None:
    right, left = path_of(TURN, -455.0), path_of(TURN.but(walk=-0.15), -410.0)
    assert [one.kind for one in right.events[:2]] == [one.kind for one in left.events]
    for one, other in zip(right.events, left.events, strict=False):
        assert one.force.value == pytest.approx(other.force.value, abs=3.0 * (one.force.error + other.force.error))
    here, there = (path.at(-400.0)[0].state.fields(51) for path in (right, left))
    assert np.max(np.abs(here["y"])) > 1e-3
    assert there["y"] == pytest.approx(-here["y"], abs=1e-12)
    assert there["contact_pressure"] == pytest.approx(here["contact_pressure"], rel=1e-9, abs=1e-7)


def test_a_turn_that_vanishes_gives_the_numbers_of_the_vertical_plane() -> None:
    """κ₂ → 0: the rod as it lies loses its symmetry where that of the plane buckles; then gaps, limit point, snap."""
    flat, turned = (path_of(problem, -350.0) for problem in (BUILD, BUILD.but(walk=1e-7)))
    kinds = [one.kind for one in flat.events]
    assert [one.kind for one in turned.events] == ["branch_point", *kinds[1:]]
    for one, other in zip(turned.events, flat.events, strict=True):
        assert one.force.value == pytest.approx(other.force.value, rel=1e-7)
    assert turned.meaning[0].startswith("Under growing compression the rod goes over to another shape at 177.32")
    one, other = (path.at(-340.0)[0].state for path in (turned, flat))
    assert one.energy.value == pytest.approx(other.energy.value, rel=1e-10)
    assert one.shortening.value == pytest.approx(other.shortening.value, rel=1e-10)


@pytest.mark.parametrize(("walk", "load"), [(0.02, -85.0), (0.1, -70.0)])
def test_a_rod_in_space_touches_the_wall_where_and_as_hard_as_the_state_says(walk: float, load: float) -> None:
    """As a helix with two points of contact, and with one: collocation of the equations in space."""
    state = path_of(DROP.but(walk=walk), min(load - 5.0, -75.0)).at(load)[0].state.own_places
    assert not any(state.fine.pattern.touching)
    rod = SpaceRod(state)
    found, _ = rod.solved()
    m = rod.points.size
    assert m == (2 if walk == 0.02 else 1)
    assert found[:m] == pytest.approx(rod.points, abs=1e-9)
    assert found[m : 2 * m] == pytest.approx([one.force.value for one in state.point_forces], rel=1e-9)


@pytest.mark.parametrize(
    ("problem", "until", "loads"),
    [(TURN, -455.0, (-340.0, -449.0, -455.0)), (TURN.but(twist=3.0), -248.0, (-226.0, -247.0)),
     (SURVEYED, None, (-312.0, -320.0, -389.0))],
)  # fmt: skip
def test_forces_and_moments_add_up_to_nothing(problem: Problem, until: float | None, loads: tuple[float, ...]) -> None:
    """Along the rod by the certificate, and on the whole of it as vectors in space about the origin."""
    path = there_and_back() if until is None else path_of(problem, until)
    for load in loads:
        state = path.at(load)[0].state
        assert state.certificate.passed
        assert state.own_places.certificate.worst < 1e-7
        force, moment = on_the_whole_rod(state.own_places)
        assert np.max(np.abs(force)) < 5e-8 * abs(load)
        assert np.max(np.abs(moment)) < 5e-8 * abs(load)


def test_no_state_on_the_way_is_unstable() -> None:
    """A contact at each end is about to vanish at −451.15 when the symmetric state, stable till then, ceases to be."""
    path = path_of(TURN, -455.0)
    assert all(state.solved.index == 0 for leg in path.legs for run in leg.runs for state in run[:-1])
    assert [one.kind for one in path.events] == ["lift_off", "gap_opens", "snap"]
    snap = path.snaps[0]
    assert -451.15 < snap.force.value < -450.5
    assert snap.to.agree == snap.to.starts


def test_the_branch_of_the_rod_as_it_lies_goes_on_off_the_wall_as_the_path_does() -> None:
    """And past the load at which it loses its stability, with two ends of contact that vanish then."""
    lying = diagram(TURN, until=-452.0, off_wall=True).branches[0]
    assert lying.beyond is not None
    points, path = lying.beyond.special_points, path_of(TURN, -455.0)
    assert [one.kind for one in points] == ["gap_opens", "branch_point", "contact_lost", "end"]
    assert points[0].force == pytest.approx(path.first("gap_opens").force.value, rel=1e-9)
    assert points[1].force == pytest.approx(path.snaps[0].force.value, rel=1e-8)
    assert [one.index_after for one in points] == [0, 1, 1, 1]


def test_a_limit_point_on_the_wall_is_not_stepped_over() -> None:
    """That of the rod kept on the wall; another path is near, on which energies would not be ∫u dF from there."""
    rod = Problem(123.946, 117.5516, clearance=0.0057, build=0.37181, walk=-0.2187)
    lying = lying_rod(rod)
    assert lying.end is not None
    assert lying.end.kind == "fold"
    path = path_of(rod, lying.end.force - 20.0)
    assert [one.kind for one in path.events] == ["fold", "snap"]
    assert path.events[0].force.value == pytest.approx(lying.end.force, rel=1e-9)


def test_nothing_is_told_of_another_path_on_the_way_back() -> None:
    """A gap beside a point of contact closes ahead, not behind, where its pattern also ends."""
    path = there_and_back()
    assert path.reached
    assert not path.missed
    for leg, sense in zip(path.legs, (-1.0, 1.0), strict=True):
        loads = [state.load for run in leg.runs for state in run]
        assert all((after - before) * sense > -1e-9 * abs(after) for before, after in pairwise(loads))
    back = [one for one in path.events if one.leg == "unloading"]
    assert [one.kind for one in back] == ["gap_opens", "contact_point", "gap_closes"]


def test_elements_end_at_stations_and_are_set_over_by_ends_of_stretches() -> None:
    stations = stations_along(SURVEYED)
    assert stations.size == 2
    runs = [state for leg in there_and_back().legs for run in leg.runs for state in run]
    sides = set()
    for state in runs:
        away = np.min(np.abs(state.solved.shape.places[:, None] - stations), axis=0)
        assert np.max(away) < 1e-12
        sides.add(tuple(np.searchsorted(state.bounds, stations)))
    assert len(sides) > 2


def test_a_rod_leaves_the_wall_on_one_side_of_a_station_where_contact_jumps() -> None:
    """Contact, of which κᵣ″ is a part, comes to nought before the station and is far from it behind."""
    survey = Survey.of([0.0, 33.3, 66.7, 100.0], [90.7, 92.3, 88.2, 91.9], [37.0, 42.3, 35.8, 41.3])
    axis = path_of_survey(survey).piece(0.0, 100.0).axis
    rod = Problem(59.0, clearance=0.0025, axis=axis)
    lying = lying_rod(rod)
    station = stations_along(rod)
    assert lying.end is not None
    lift = path_of(rod, lying.end.force - 3.0).lift_off
    assert lift.force.value == pytest.approx(lying.end.force, rel=1e-9)
    near = station[np.argmin(np.abs(station - lift.s[0]))]
    before, behind = lift.state.fields(near + np.array([-1e-9, 1e-9]))["contact_pressure"]
    assert abs(before) < 1e-4
    assert behind < -10.0


def test_the_shortening_may_be_controlled() -> None:
    path = load_path(BUILD.but(walk=0.1), until=5e-4, control="shortening", seeds=1)
    assert path.reached
    lying = lying_rod(BUILD.but(walk=0.1))
    assert path.events[0].force.value == pytest.approx(lying.end.force, rel=1e-6)
    assert path.at(3e-4)[0].state.shortening.value == pytest.approx(3e-4, rel=1e-9)


def test_a_state_is_followed_out_of_the_vertical_plane() -> None:
    """From one that keeps to it, in a drop: it must be let go, and is then the one of the other hole's load path."""
    start = path_of(DROP, -72.0).at(-70.0)[0].state
    assert start.fine.pattern.planar
    there = rodwell.follow_contact(start, DROP.but(walk=0.02))
    known = path_of(DROP.but(walk=0.02), -90.0).at(-70.0)[0].state
    assert there.energy.value == pytest.approx(known.energy.value, rel=1e-11)
    assert there.fields(51)["y"] == pytest.approx(known.fields(51)["y"], abs=1e-11)
    assert np.max(np.abs(known.fields(51)["y"])) > 1e-3


@pytest.mark.parametrize(
    ("changes", "options", "field"),
    [
        ({"sections": ((0.5, 1.0, 1.0), (0.5, 0.6, 0.8))}, {}, "walk"),
        ({"ends": "ball-clamped"}, {}, "ends"),
        ({"ends": "clamped-loose"}, {}, "ends"),
        ({"on_top": True}, {}, "on_top"),
        ({}, {"mirror": True}, "mirror"),
        ({}, {"until": 0.0}, "until"),
        ({}, {"until": 10.0}, "until"),
        ({}, {"unload_to": 10.0}, "unload_to"),
        ({}, {"wall_stiffness": 1e6}, "wall_stiffness"),
    ],
    ids=str,
)
def test_what_is_not_followed_is_refused(changes: dict[str, object], options: dict[str, object], field: str) -> None:
    with pytest.raises(InputError) as caught:
        load_path(TURN.but(**changes), **{"until": -100.0, **options})
    assert caught.value.field == field
