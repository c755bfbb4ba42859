"""Load paths in curved holes beyond lift-off: against the states on the wall, the straight hole, and a rod in space."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from analysis.curved.space_form import SpaceRod
from analysis.curved.whole_rod import on_the_whole_rod

import rodwell
from rodwell import InputError, LoadPath, Problem, critical_loads, follow, load_path
from rodwell.analysis.off_wall.conditions import OPENS, conditions
from rodwell.analysis.straight.lying import lies_between

BUILD = Problem(15.0, 90.0, clearance=0.01, build=0.2)
DROP = BUILD.but(build=-0.2)


@cache
def path_of(problem: Problem, until: float) -> LoadPath:
    return load_path(problem, until=until, seeds=1)


def test_lift_off_is_that_of_the_branch_on_the_wall() -> None:
    path, branch = path_of(BUILD, -350.0), follow(BUILD, 1, until=None)
    assert path.first("critical").force.value == pytest.approx(-177.320540182, abs=1e-9)  # theory-2
    assert path.lift_off.force.value == pytest.approx(branch.lift_off.force, rel=1e-9)
    least = [one for one in conditions(path.lift_off.state.fine) if one.kind == OPENS][:2]  # the lowest first
    assert sorted(one.s for one in least) == pytest.approx(branch.lift_off.s, abs=1e-7)
    assert [one.kind for one in path.events] == ["critical", "lift_off", "gap_opens", "fold", "snap"]


def test_a_buckled_state_on_the_wall_has_the_energy_of_two_programs() -> None:
    """κ = 0.2, w = 15, F = −200: ΔE = −1.516491516e−3, least contact 35.90317; by the hole as it is, 8.5e−6 off."""
    state = path_of(BUILD, -350.0).at(-200.0)[0].state
    assert state.own_places.energy.value == pytest.approx(-1.516491516e-3, abs=6e-13)
    assert state.place_errors["energy"] == pytest.approx(8.5e-6 * 1.5165e-3, rel=0.02)
    assert float(np.min(-state.own_places.fields(401)["contact_pressure"])) == pytest.approx(35.90317, abs=1e-4)


def test_without_curvature_it_is_the_path_of_the_straight_hole() -> None:
    """κ → 0 like κ: curvature 1e−10 changes the contact κ|F|/w by 1e−9, and loads and states by no more than that."""
    straight, bent = (path_of(BUILD.but(build=build), -148.5) for build in (0.0, 1e-10))
    assert [one.kind for one in bent.events] == [one.kind for one in straight.events]
    for one, other in zip(bent.events, straight.events, strict=True):
        assert one.force.value == pytest.approx(other.force.value, rel=3e-9)
        assert one.s == pytest.approx(other.s, abs=1e-6)
    one, other = (path.at(-140.0)[0].state for path in (bent, straight))
    assert one.energy.value == pytest.approx(other.energy.value, rel=1e-8)
    assert [p.force.value for p in one.point_forces] == pytest.approx([p.force.value for p in other.point_forces], 1e-6)


@pytest.mark.parametrize(
    ("problem", "until", "loads"),
    [(BUILD, -350.0, (-250.0, -340.0, -349.0)), (DROP, -90.0, (-62.5, -63.3, -70.0, -85.0))],
)
def test_states_pass_their_certificate(problem: Problem, until: float, loads: tuple[float, ...]) -> None:
    path = path_of(problem, until)
    assert path.reached
    for load in loads:
        for one in path.at(load):
            assert one.state.certificate.passed
            assert one.stability_index == 0
            assert one.state.own_places.certificate.worst < 1e-7


@pytest.mark.parametrize(("problem", "until", "load"), [(BUILD, -350.0, -340.0), (DROP, -90.0, -63.3)])
def test_forces_and_moments_on_the_whole_rod_add_up_to_nothing(problem: Problem, until: float, load: float) -> None:
    """Supports, weight, distributed and concentrated contact: as vectors in space, about the origin."""
    force, moment = on_the_whole_rod(path_of(problem, until).at(load)[0].state.own_places)
    assert np.max(np.abs(force)) < 1e-8 * abs(load)
    assert np.max(np.abs(moment)) < 3e-8 * abs(load)


@pytest.mark.parametrize("load", [-70.0, -85.0])
def test_a_rod_in_space_touches_the_wall_where_and_as_hard_as_the_state_says(load: float) -> None:
    """In the plane with one point of contact, and as a helix with two: collocation of the equations in space."""
    state = path_of(DROP, -90.0).at(load)[0].state.own_places
    assert not any(state.fine.pattern.touching)
    rod = SpaceRod(state)
    found, _ = rod.solved()
    m = rod.points.size
    assert m == (1 if load == -70.0 else 2)
    assert found[:m] == pytest.approx(rod.points, abs=1e-8)
    assert found[m : 2 * m] == pytest.approx([one.force.value for one in state.point_forces], rel=1e-7)


def test_seen_from_its_other_end_the_rod_does_the_same() -> None:
    """α → 180° − α, and the end force less the weight over the rod's rise: places from the other end, same loads."""
    problem = BUILD.but(alpha=70.0)
    other = problem.but(alpha=110.0)
    change = problem.hung_weight
    one, turned = path_of(problem, -300.0), path_of(other, -300.0 - change)
    assert [event.kind for event in one.events] == [event.kind for event in turned.events]
    for event, image in zip(one.events, turned.events, strict=True):
        assert image.force.value == pytest.approx(event.force.value - change, rel=1e-7)
        assert sorted(1.0 - s for s in image.s) == pytest.approx(list(event.s), abs=1e-5)


def test_a_rod_in_a_drop_leaves_the_low_side_where_the_curve_lifts_it() -> None:
    """Before it buckles, beside its ends, at the load in closed form; then it crosses to the outside of the curve."""
    problem = BUILD.but(build=-0.5)
    path = path_of(problem, -45.0)
    lowest = lies_between(problem)[0]
    assert lowest.value > critical_loads(problem, 1)[0].force
    assert path.lift_off.force.value == pytest.approx(lowest.value, rel=1e-10)
    assert path.first("touches") is not None
    top = path.at(-45.0)[0].state
    assert top.certificate.passed
    assert float(np.max(top.fields(201)["x"])) == pytest.approx(0.01, abs=1e-9)


def test_branches_go_on_off_the_wall_as_the_path_does() -> None:
    branch = follow(BUILD, 1, until=-347.0, off_wall=True)
    assert branch.beyond is not None
    opened = next(one for one in branch.beyond.special_points if one.kind == "gap_opens")
    path = path_of(BUILD, -350.0)
    assert opened.force == pytest.approx(path.first("gap_opens").force.value, rel=1e-9)
    assert all(one.state.certificate.passed for one in branch.beyond.special_points)


def test_a_state_is_followed_from_the_straight_hole_into_a_curved_one() -> None:
    """And is the one that the load path of the curved hole has, gaps and point forces included."""
    start = path_of(BUILD.but(build=0.0), -148.5).at(-140.0)[0].state
    there = rodwell.follow_contact(start, BUILD.but(build=0.02), -150.0)
    known = path_of(BUILD.but(build=0.02), -151.0).at(-150.0)[0].state
    assert there.energy.value == pytest.approx(known.energy.value, rel=1e-8)
    assert [one.force.value for one in there.point_forces] == pytest.approx(
        [one.force.value for one in known.point_forces], rel=1e-6
    )


def test_a_contact_that_comes_up_to_an_end_of_the_rod_raises_nothing() -> None:
    """It shrinks to a point 10⁻⁵ L beside a guided end: a stretch in its place would reach beyond it."""
    leaving = Problem(10.1985, 93.196, clearance=0.00211026, build=-0.459015, ends=("guided", "guided"))
    path = path_of(leaving, -40.0)
    assert path.reached or path.ended_because
    assert all(one.state.certificate.passed for one in path.events if one.state is not None)


def test_where_a_bend_presses_hard_the_rod_is_seen_to_snap() -> None:
    """Six half-waves under 373 B/L³ of contact: soft walls on which shapes are sought yield to that, unless stiffer."""
    long = Problem(10.287563, 60.0, clearance=1.176075e-3, build=0.19477874)
    path = path_of(long, -1900.0)
    assert path.reached, path.ended_because
    assert path.snaps
    assert path.at(-1900.0)[0].state.certificate.passed


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"sections": ((0.5, (1.0, 0.6)), (0.5, 0.6))}, "sections"),
        ({"build": -0.5, "weight": 0.0}, "build"),
        ({"build": -0.5, "twist": 1.0}, "twist"),
    ],
)
def test_what_has_no_path_is_refused_with_the_reason(changes: dict[str, object], field: str) -> None:
    with pytest.raises(rodwell.InputError) as caught:
        load_path(BUILD.but(**changes), until=-100.0)
    assert caught.value.field == field


def test_soft_walls_are_refused() -> None:
    with pytest.raises(rodwell.InputError, match="wall_stiffness"):
        load_path(BUILD, until=-100.0, wall_stiffness=1e6)


def test_states_just_beyond_lift_off_have_their_balance() -> None:
    """With its own places a gap opens at another load, 10⁻⁴ of it away: balance is that of the same length of gap."""
    bent = Problem(35.72105, 83.900286, clearance=0.02221269, build=0.56925649)
    path = path_of(bent, -264.0)
    lift = path.lift_off.force.value
    for load in (lift - 0.005, lift - 0.05, -264.0):
        assert path.at(load)[0].state.certificate.passed


def test_tension_that_pulls_the_rod_off_the_outside_of_the_curve_is_refused_with_the_load_and_the_place() -> None:
    """Level at the middle, at κr N = w cos(ψ) first at an end."""
    limit = lies_between(BUILD)[1]
    assert limit is not None
    words = (
        rf"until = .* must be at most {limit.value:.8g} B/L². under more tension the rod leaves .* s/L = {limit.s:g}"
    )
    with pytest.raises(InputError, match=words):
        load_path(BUILD, until=1.001 * limit.value)
    with pytest.raises(InputError, match="unload_to"):
        load_path(BUILD, until=-10.0, unload_to=1.001 * limit.value)
    assert load_path(BUILD, until=0.999 * limit.value).reached


def test_on_the_way_back_the_rod_lies_along_the_hole_again() -> None:
    path = load_path(BUILD, until=-190.0, unload_to=-150.0)
    there, back = path.events
    assert (there.kind, back.kind) == ("critical", "critical")
    assert there.force.value == pytest.approx(back.force.value, abs=1e-9)
    assert (there.meaning, back.meaning) == (
        "the rod that lies along the hole buckles", "the rod lies along the hole again",
    )  # fmt: skip


def test_a_gap_that_closes_at_an_end_of_its_neighbour_raises_nothing_where_the_shortening_is_controlled() -> None:
    path = load_path(Problem(15.0, 70.0, build=0.3), until=0.003, control="shortening", seeds=1)
    assert path.events[0].kind == "critical"
    assert path.reached or path.ended_because


def test_gaps_that_open_one_after_another_close_at_the_same_loads() -> None:
    """A wire in a bent vessel: short gaps, the second and third within 5e-5 of the load, at which forces decide."""
    rod = Problem(0.04, clearance=0.0213, ends="clamped-pinned", build=1.5)
    path = load_path(rod, until=-804.0, unload_to=-780.0, seeds=1)
    assert path.ended_because == ""
    assert not path.missed
    opened, closed = ([event for event in path.events if event.kind == kind] for kind in ("gap_opens", "gap_closes"))
    places = sorted(s for event in closed for s in event.s)
    assert sorted(s for event in opened for s in event.s) == pytest.approx(places, abs=1e-4)
    loads = {round(event.s[0], 2): event.force.value for event in closed}
    for event in opened:
        assert event.force.value == pytest.approx(loads[round(event.s[0], 2)], abs=1e-6)
