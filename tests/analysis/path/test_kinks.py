"""Kinks of the stiffness off the wall: against smooth blends, the rod kept on the wall, and the beam that is lifted."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rodwell import Problem, Solution, follow, load_path
from rodwell.analysis.off_wall.arrange import solved
from rodwell.analysis.off_wall.conditions import kink_force
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.state import contact_state
from rodwell.analysis.path.load_path import LoadPath
from rodwell.numerics.stretches.carry import sampler
from rodwell.physics.off_wall.kinks import shortest

RISES = Problem(15.0, sections=((0.4, 0.5), (0.6, (0.5, 1.0))))
FALLS = Problem(15.0, sections=((0.4, 1.0), (0.6, (1.0, 0.5))))


def blended(problem: Problem, width: float) -> Problem:
    """The kink at s = 0.4 made smooth by a parabola over a width."""
    (_, start, *_), (_, (_, end), *_) = problem.sections
    assert isinstance(start, float)
    rate, x = (end - start) / 0.6, np.array([0.0, 0.5, 1.0]) * width
    blend = tuple(start + 0.5 * rate * x**2 / width)
    last = 0.6 - 0.5 * width
    return problem.but(sections=((0.4 - 0.5 * width, start), (width, blend), (last, (start + 0.5 * rate * width, end))))


@pytest.fixture(scope="module")
def loop() -> LoadPath:
    return load_path(FALLS, until=-112.0, unload_to=-70.0, seeds=1)


def test_the_force_at_a_rising_kink_is_what_a_smooth_blend_concentrates() -> None:
    """Contact force over the blend less that beside it, as it becomes short."""
    force, missed = -86.0, []
    (kink,) = load_path(RISES, until=force, seeds=1).at(force)[0].state.point_forces
    assert (kink.kind, kink.s.value) == ("kink", 0.4)
    assert kink.force.value == pytest.approx(_kept(RISES, force), rel=1e-8)
    for width in (0.02, 0.01):
        s = np.array([0.4 - 0.75 * width, 0.4, 0.4 + 0.75 * width])
        pressure = _at(blended(RISES, width), force).fields(s)["contact_pressure"]
        concentrated = -width * (pressure[1] - 0.5 * (pressure[0] + pressure[2]))
        missed.append(abs(concentrated - kink.force.value) / kink.force.value)
    assert missed[1] < 0.6 * missed[0]
    assert missed[1] < 0.02


def _at(problem: Problem, force: float) -> Solution:
    """The buckled rod that is kept on the wall."""
    return follow(problem, until=force).states_at(force)[0]


def _kept(problem: Problem, force: float) -> float:
    """The force towards the axis of the wall that holds the rod at its kink, by the balance of forces on the wall."""
    (loads,) = _at(problem, force).step_loads
    return float(loads.force.value)


def test_the_gap_at_a_falling_kink_is_that_of_a_smooth_blend(loop: LoadPath) -> None:
    """Far longer than the blend: its ends, its height, the forces at its ends, the energy."""
    force = -111.0
    ours = loop.at(force)[0].state
    start, missed = ours.fine.solved.shape, []
    for width in (2e-4, 1e-4):
        solution = solved(RodInHole(blended(FALLS, width)), ours.fine.pattern, start.breaks, force, sampler(start))
        assert solution is not None
        smooth = contact_state(solution)
        assert smooth.certificate.passed
        gap, other = (one.gaps[0] for one in (ours, smooth))
        point, pushed = (one.point_forces[0] for one in (ours, smooth))
        missed.append([
            gap.start.value - other.start.value, gap.end.value - other.end.value,
            1.0 - other.largest.value / gap.largest.value, 1.0 - pushed.force.value / point.force.value,
            1.0 - smooth.energy.value / ours.energy.value,
        ])  # fmt: skip
    assert np.array(missed[0]) / np.array(missed[1]) == pytest.approx(np.full(5, 4.0), rel=0.05)
    assert np.all(np.abs(missed[1]) < [1e-6, 1e-6, 0.01, 3e-3, 1e-8])


def test_the_gap_is_that_of_a_heavy_beam_lifted_at_one_place(loop: LoadPath) -> None:
    """Length 3P/2q, forces qa/3 at its ends, height qa⁴/72b, where it begins to count."""
    state = next(one for run in loop.legs[0].runs for one in run if one.pattern.text() == "=-=")
    load = state.load - 0.01
    found = loop.at(load)[0].state
    gap, half = found.gaps[0], 0.5 * (found.gaps[0].end.value - found.gaps[0].start.value)
    on_wall = _at(FALLS, load)
    pulled = -float(on_wall.step_loads[0].force.value)
    push = -float(np.mean(on_wall.fields(np.array([0.4 - 1e-6, 0.4 + 1e-6]))["contact_pressure"]))
    assert 2.0 * half == pytest.approx(1.5 * pulled / push, rel=2e-3)
    assert gap.largest.value * FALLS.clearance == pytest.approx(push * half**4 / 72.0, rel=1e-2)
    for point in found.point_forces[:2]:
        assert point.force.value == pytest.approx(push * half / 3.0, rel=2e-2)


def test_the_loop_closes_where_it_opened_and_every_state_balances(loop: LoadPath) -> None:
    assert loop.reached
    assert not loop.missed
    up, down = ([event for event in loop.events if event.leg == leg] for leg in ("loading", "unloading"))
    assert [event.kind for event in up] == ["critical", "lift_off", "gap_opens"]
    assert [event.kind for event in down] == ["gap_closes", "touch_down", "critical"]
    for one, other in zip(up, down[::-1], strict=True):
        assert one.force.value == pytest.approx(other.force.value, abs=1e-7)
    for force in (-99.0, -106.38, -106.4, -108.0, -111.5):
        for state in loop.at(force):
            assert state.state.certificate.passed
            assert (
                min([point.force.value for point in state.state.point_forces if point.kind != "kink"], default=1.0)
                > 0.0
            )


def test_a_force_that_pulls_is_within_the_contact_only_where_its_gap_does_not_count(loop: LoadPath) -> None:
    (kink,) = loop.at(-104.0)[0].state.point_forces
    assert kink.kind == "kink"
    assert -0.05 < kink.force.value < 0.0
    push, stiffness = 20.0, 0.7
    least = shortest(FALLS.clearance, stiffness, push)
    assert push * (0.5 * least) ** 4 / (72.0 * stiffness) == pytest.approx(1e-11 * FALLS.clearance, rel=1e-12)
    assert loop.at(-107.0)[0].state.certificate.least_force > 0.0


@pytest.mark.parametrize("problem", [RISES, FALLS], ids=["rises", "falls"])
def test_energy_changes_by_the_work_of_the_load(problem: Problem) -> None:
    path = load_path(problem, until=-92.0 if problem is RISES else -113.0, seeds=1)
    force, h = path.until + 1.0, 1e-3
    low, here, high = (path.at(force + d)[0].state for d in (-h, 0.0, h))
    slope = (high.energy.value - low.energy.value) / (2.0 * h)
    assert slope == pytest.approx(here.shortening.value, rel=1e-6)


def test_a_kink_that_is_hardly_one_changes_nothing() -> None:
    """References: test_load_path."""
    rod = Problem(15.0, sections=((0.4, 1.0), (0.6, (1.0, 1.0 + 1e-9))))
    found = load_path(rod, until=-127.0, seeds=1)
    assert [event.kind for event in found.events] == ["critical", "lift_off", "gap_opens"]
    loads: list[Any] = [event.force.value for event in found.events]
    assert loads == pytest.approx([-111.23344016, -123.173074, -124.1911865], abs=1e-6)
    assert kink_force(found.at(-120.0)[0].state.fine, 0.4) == pytest.approx(0.0, abs=1e-6)


def test_a_taper_buckles_without_a_snap_and_ends_of_gaps_go_back_over_its_kinks() -> None:
    """A soft tip, a taper, a stiff shaft, which hardly weigh anything: up to a limit point and back."""
    taper = (0.0625, 0.1526, 0.3164, 0.5862, 1.0)
    rod = Problem(0.09, clearance=0.017, sections=((0.2, taper[0]), (0.33, taper), (0.47, 1.0)))
    path = load_path(rod, until=-10.5, unload_to=-9.0, seeds=1)
    up, down = ([event for event in path.events if event.leg == leg] for leg in ("loading", "unloading"))
    assert [event.kind for event in up[:2]] == ["critical", "lift_off"]  # it grows out of the straight rod
    assert path.ended_because == ""
    for kinds_up, kinds_down in (({"lift_off"}, {"touch_down"}), ({"contact_lost", "contact_point"}, {"contact_line"})):
        loads = [event.force.value for event in up if event.kind in kinds_up]
        back = [event.force.value for event in down if event.kind in kinds_down]
        assert loads == pytest.approx(back[::-1], abs=1e-7)
    assert down[-1].kind == "critical"
