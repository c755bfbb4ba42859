"""Load paths of other rods than the reference's: twisted, on ball joints, heavier, with loose ends; held shortening."""

from __future__ import annotations

import numpy as np
import pytest

import rodwell
from rodwell.analysis.off_wall.arrange import at_load
from rodwell.analysis.path.follow import load_path
from rodwell.errors import InputError
from rodwell.numerics.stretches.carry import sampler


def test_loads_are_the_same_on_the_way_back() -> None:
    """Gaps close where they opened, contact is complete where it was lost, the rod is straight where it buckled."""
    path = load_path(rodwell.Problem(weight=15), until=-127.0, unload_to=-105.0, seeds=1)
    kinds = [event.kind for event in path.events]
    assert kinds == ["critical", "lift_off", "gap_opens", "gap_closes", "touch_down", "critical"]
    loads = np.array([event.force.value for event in path.events])
    assert loads[:3] == pytest.approx(loads[:2:-1], rel=3e-10)


def test_with_twist_the_arms_differ() -> None:
    """T₁ = 3: one arm lifts off at −123.5219582 and ends in a limit point at −133.30092762, in a full-contact helix."""
    path = load_path(rodwell.Problem(weight=15, twist=3.0), until=-134.0, mirror=True, seeds=1)
    assert path.lift_off.force.value == pytest.approx(-123.5219582, abs=6e-8)
    assert path.first("fold").force.value == pytest.approx(-133.30092762, abs=1e-8)
    assert path.snaps[0].to.kind == "helix"
    assert path.snaps[0].state.fine.pattern.full
    assert all(event.state.certificate.passed for event in path.events[1:])


def test_the_arm_that_twist_favours_folds() -> None:
    """T₁ = 3: at −110.74756307, by two programs in two fields, less than the −111.2334 at which the rod snaps to it."""
    path = load_path(rodwell.Problem(weight=15, twist=3.0), until=-112.0, unload_to=-105.0, seeds=1)
    assert [event.kind for event in path.events] == ["critical", "snap", "fold", "snap"]
    assert path.first("fold", "unloading").force.value == pytest.approx(-110.74756307, abs=1e-8)
    assert path.snaps[1].to.kind == "straight"


def test_an_arm_that_twist_favours_little_is_found_from_its_branch() -> None:
    """T₁ = 2: its fold lies so near the buckling load that no descent finds it; numbers of the rod kept on the wall."""
    problem = rodwell.Problem(weight=15, twist=2.0)
    path = load_path(problem, until=-113.0, unload_to=-105.0, seeds=1)
    branch = rodwell.follow(problem, 1)
    fold = next(point for point in branch.special_points if point.kind == "fold")
    assert [event.kind for event in path.events] == ["critical", "snap", "fold", "snap"]
    assert path.events[1].force.value == pytest.approx(branch.force[0], abs=1e-8)
    assert path.events[1].to.kind == "sinusoidal"
    assert path.first("fold", "unloading").force.value == pytest.approx(fold.force, abs=1e-7)
    buckled = branch.states_at(branch.force[0])[-1]  # the first is the straight rod
    assert path.events[1].to.energy.value == pytest.approx(buckled.number("energy").value, rel=1e-7)


def test_ball_joints_let_the_rod_off_at_its_ends() -> None:
    """w = 15, F = −85: energy −5.901309634e-4, free stretches 0.14781215 long, gap 3.05216e-3; −5.172e-4 if held."""
    path = load_path(rodwell.Problem(weight=15, ends="ball-ball"), until=-86.0, seeds=1)
    assert [event.kind for event in path.events] == ["critical", "lift_off"]
    assert path.lift_off.force.value == pytest.approx(-77.47386148, abs=1e-8)
    state = path.at(-85.0)[0].state
    assert state.energy.value == pytest.approx(-5.901309634e-4, abs=1e-13)
    assert [gap.end.value - gap.start.value for gap in state.gaps] == pytest.approx([0.14781215] * 2, abs=1e-8)
    assert state.gaps[0].largest.value == pytest.approx(3.05216e-3, abs=5e-9)
    assert state.certificate.passed


def test_the_bifurcation_of_a_heavier_rod() -> None:
    """w = 30 gives way where the symmetry breaks, seen though the path is symmetric, and to an unsymmetric helix."""
    path = load_path(rodwell.Problem(weight=30), until=-214.0, seeds=1)
    snap = path.snaps[0]
    assert path.first("fold") is None
    assert snap.force.value == pytest.approx(-213.7, abs=0.2)  # by active sets on a fixed mesh
    assert 1e-8 < snap.force.error < 1e-8 * 213.7  # all but singular there: with round-off the load moves by 1e-8
    assert abs(snap.to.turns) == 1
    assert snap.state.fine.pattern.text() in ("-=", "=-")
    assert at_load(snap.state.fine, -214.0).solved.index == 0


def test_a_loose_end_is_pressed_to_the_wall_beyond_a_free_stretch() -> None:
    """Free over 2θ′√(Δ/w) at first, as at a ball joint (theory-2): its end pushes, and rolls round to the top.

    There it is in the vertical plane, until that loses its stability.
    """
    path = load_path(rodwell.Problem(weight=15, ends="clamped-loose"), until=-95.0, seeds=1)
    assert [event.kind for event in path.events] == ["critical", "lift_off", "branch_point"]
    first = path.legs[0].runs[0][0]
    (start,) = first.solved.shape.breaks
    slope = float(sampler(first.solved.shape)(np.array([start]))[1][1, 0])
    assert 1.0 - start == pytest.approx(2.0 * abs(slope) * np.sqrt(0.01 / 15.0), rel=0.05)
    for force, angle in ((-50.0, None), (-88.0, np.pi)):
        state = path.at(force)[0].state
        assert state.certificate.passed
        assert [point.kind for point in state.point_forces] == ["end", "tip"]
        assert min(point.force.value for point in state.point_forces) > 0.0
        assert angle is None or abs(state.fields(np.array([1.0]))["angle"][0]) == pytest.approx(angle, abs=1e-6)


@pytest.mark.parametrize(
    ("field", "change"),
    [
        ("outside", {"outside": True}),
        ("on_top", {"on_top": True}),
        ("turns", {"turns": 1}),
        ("ends", {"ends": "loose-clamped", "weight": 0.0}),
    ],
)
def test_what_has_no_path_is_refused_with_the_reason(field: str, change: dict) -> None:
    problem = rodwell.Problem(**{"weight": 15.0, **change})
    with pytest.raises(InputError) as caught:
        load_path(problem, until=-130.0)
    assert caught.value.field == field


def test_under_controlled_shortening_there_is_no_snap() -> None:
    """The limit points are extrema of the load only: the rod rolls over the hole's axis into the helix, and back.

    Shortening .001 at F = −126.38730948, .0012 at −119.61433162, two programs; no hysteresis; the energy stored in
    rod and height changes by the work of the end force.
    """
    path = load_path(rodwell.Problem(weight=15), until=0.0022, unload_to=0.0009, control="shortening", seeds=1)
    assert path.reached
    assert not path.snaps
    peaks = [event.force.value for event in path.events if event.kind == "load_peak"]
    assert peaks == pytest.approx([-147.1580802, -103.6731326, -103.6731326], abs=1e-7)
    for shortening, force in ((0.001, -126.38730948), (0.0012, -119.61433162)):
        up, down = path.at(shortening)
        assert up.state.force == pytest.approx(force, abs=1e-8)
        assert down.state.force == pytest.approx(up.state.force, abs=1e-8)
        assert up.state.stability_index == 1  # under a dead load
        assert up.stability_index == 0
        assert up.state.certificate.passed
    assert path.at(0.0022)[0].state.kind == "helix"

    def stored(state) -> float:
        return state.energy.value - state.force * state.shortening.value

    h = 1e-6
    low, here, high = (path.at(0.0011 + t)[0].state for t in (-h, 0.0, h))
    assert (stored(high) - stored(low)) / (2 * h) == pytest.approx(-here.force, rel=1e-6)


def test_a_heavy_rod_that_hangs_buckles_under_tension_and_is_straight_above_that_load_only() -> None:
    """Its weight compresses the lower end: the straight rod is stable under more tension, the buckled under less."""
    hanging = rodwell.Problem(weight=400.0, alpha=5.0)
    load = rodwell.critical_loads(hanging, 1)[0].force
    assert load > 0.0
    path = load_path(hanging, until=load - 2.0, seeds=1)
    assert [(one.state.kind, one.stability_index) for one in path.at(load + 1.0)] == [("straight", 0)]
    assert [(one.state.kind, one.stability_index) for one in path.at(load - 1.0)] == [("sinusoidal", 0)]
