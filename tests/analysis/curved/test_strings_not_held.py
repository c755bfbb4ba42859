"""Strings in bends that nothing holds at steps of their stiffness, however small these are; a sample of a campaign."""

from __future__ import annotations

import math

import numpy as np
import pytest
from programs import CAMPAIGNS, loaded

from rodwell import Problem, critical_loads, sensitivities
from rodwell.analysis.off_wall.curved.beside_steps import short_gap
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.path.bridged_slopes import NOT_FOUND, NOT_HELD
from rodwell.analysis.path.bridging import bridged, unstretched
from rodwell.analysis.path.events import PathPoint
from rodwell.analysis.path.follow import not_held_at_steps


def at(problem: Problem) -> PathPoint:
    found = not_held_at_steps(problem)
    assert isinstance(found, PathPoint)
    return found


def test_of_a_small_step_a_gap_is_off_by_2_plus_root_3_times_as_far_on_the_stiffer_side() -> None:
    """r⁴ − 2r³ − 6r² − 2r + 1 = 0, by hand: r + 1/r = 4."""
    gap = short_gap(0.5, (1.0, 1.0 + 1e-9), (7.0, 7.0), 0.2)
    assert gap is not None
    a, c = 0.5 - gap.ends[0], gap.ends[1] - 0.5
    assert c / a == pytest.approx(2.0 + math.sqrt(3.0), rel=1e-6)
    assert sum(gap.forces) == pytest.approx(7.0 * (a + c), rel=1e-12)
    (y, y1, y2), (below, above) = gap.heights(np.array([0.5 - 1e-15, 0.5 + 1e-15])), gap.stiffness
    assert (y[0], y1[0]) == pytest.approx((y[1], y1[1]), rel=1e-6)
    assert below * y2[0] - above * y2[1] == pytest.approx((above - below) * 0.2, rel=1e-6)
    assert not np.any(gap.heights(np.array([0.4, 0.6])))


@pytest.mark.parametrize("stiffness", [1.0005, 0.99])
def test_small_steps_have_the_gap_of_a_beam_and_the_load_on_the_wall(stiffness: float) -> None:
    problem = Problem(50.0, 60.0, 1e-3, build=0.2, sections=((0.5, 1, 1), (0.5, stiffness, 3)))
    model = rod_in_hole(problem)
    start = bridged(model, unstretched(model))
    assert start is not None
    sides = np.array([0.5 - 1e-12, 0.5 + 1e-12])
    low, high = map(float, model.pressed(sides, start.load))
    beam = short_gap(0.5, (1.0, stiffness), (low, high), 0.2)
    assert beam is not None
    assert start.bounds[1:-1] - 0.5 == pytest.approx(np.array(beam.ends) - 0.5, rel=2e-3)
    found = at(problem)
    assert found.met
    assert found.state is not None
    assert found.state.certificate.passed
    assert found.force.value == pytest.approx(critical_loads(problem, 1)[0].force, rel=1e-8)


def test_random_strings_have_a_start() -> None:
    """But number 2, a light one that two gaps lift off between them, which is said."""
    program = loaded(CAMPAIGNS / "bent_strings.py")
    for number in (0, 1, 3, 4, 5, 7, 9, 11, 13, 15):
        model = rod_in_hole(program.problem_of(number))
        assert bridged(model, unstretched(model)) is not None, number
    assert "was not found" in str(not_held_at_steps(program.problem_of(2)))


def test_a_sample_of_the_campaign() -> None:
    program = loaded(CAMPAIGNS / "bent_strings.py")
    result = program.trial(17)
    assert result["fault"] == ""
    assert result["starts"]
    assert "load" in result


def test_derivatives_of_both_loads_are_told() -> None:
    problem = Problem(50.0, 60.0, 1e-2, build=0.2, sections=((0.5, 1, 1), (0.5, 3, 1)))
    loads = {one.name: one for one in sensitivities(problem)}
    assert loads["critical load of mode 1"].force == critical_loads(problem, 1)[0].force
    found = loads[NOT_HELD]
    assert found.force == pytest.approx(at(problem).force.value, rel=1e-9)
    more = at(problem.but(build=0.2001)).force.value
    assert found.derivatives["build"].value == pytest.approx((more - found.force) / 1e-4, rel=1e-3)


def test_what_was_not_found_is_said_beside_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rodwell.analysis.path.follow.farthest", lambda _problem: -1.0)
    loads = sensitivities(Problem(50.0, 60.0, 1e-2, build=0.2, sections=((0.5, 1, 1), (0.5, 3, 1))))
    assert NOT_HELD not in [one.name for one in loads]
    assert NOT_FOUND in loads[0].note
