"""How a rod snaps: when it counts as snapping, errors of turns, flows that meet, and a path that is given up."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import rodwell
from rodwell.analysis.off_wall.control import FORCE
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.path import disturbance
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.snap import Flow, _disturbed, flowed, kicked
from rodwell.analysis.path.straightening import straight_state
from rodwell.errors import NotConvergedError


def test_a_rod_that_lingers_beside_the_saddle_counts_as_one_that_snaps() -> None:
    def comes_back(angle: float) -> bool:
        if 1.52 < angle < 1.66:
            raise NotConvergedError("it lingers")
        return angle <= 1.52

    assert disturbance._threshold(comes_back, 0.0, np.pi) == pytest.approx(1.52, abs=0.02)
    assert disturbance._threshold_near(comes_back, 1.6) == pytest.approx(1.52, abs=0.02)


def test_the_error_of_a_turn_holds_what_steps_and_wall_change(monkeypatch: pytest.MonkeyPatch) -> None:
    """Thresholds that depend on both as prescribed: 2.4 as usual, 2.46 in closer steps, 2.52 behind a stiffer wall."""

    def back(_state: Any, held: disturbance.Held, angle: float) -> bool:
        closer, stiffer = held.flow.wanted == disturbance.CLOSER, held.flow.stiffness > 1e8
        return abs(angle) < 2.4 + 0.06 * closer + 0.12 * stiffer

    monkeypatch.setattr(disturbance, "comes_back", back)
    nothing: Any = None
    held = disturbance.Held(FORCE, -127.2, Flow(1e8, disturbance.ELEMENTS), nothing)
    found = disturbance.turned_over(nothing, held)
    assert found is not None
    assert found.value == pytest.approx(2.46, abs=disturbance.BRACKET)
    assert found.error == pytest.approx(0.06 + 0.12, abs=3 * disturbance.BRACKET)


def test_a_path_that_is_given_up_keeps_what_it_has() -> None:
    told: list[float] = []

    def enough(_leg: str, force: float) -> str | None:
        told.append(force)
        return "enough of it" if force < -123.5 else None

    path = load_path(rodwell.Problem(weight=15), until=-160.0, unload_to=-90.0, seeds=1, progress=enough)
    assert (path.reached, path.ended_because) == (False, "enough of it")
    assert [event.kind for event in path.events] == ["critical", "lift_off"]
    assert path.events[1].force.value == pytest.approx(-123.173074, abs=1e-6)  # AUTO-07p, see tests/validation
    assert sum(force < -123.5 for force in told) == 1


def test_flows_that_meet_go_on_as_one() -> None:
    """From the straight rod beyond its buckling load: two to one side, the third to the other, a mirror image."""
    event, ways = straight_state(RodInHole(rodwell.Problem(weight=15)), -114.0), []
    starts = [_disturbed(kicked(event.solved, sign), seed) for sign, seed in ((1.0, 0), (1.0, 1), (-1.0, 0))]
    first, second, third = (flowed(event, start, FORCE, -114.0, ways=ways) for start in starts)
    assert first is not None
    assert third is not None
    assert second is first
    assert third is not first
    assert third.out.energy == pytest.approx(first.out.energy, rel=1e-9)
    assert flowed(event, starts[1], FORCE, -114.0).out.energy == pytest.approx(first.out.energy, rel=1e-9)
