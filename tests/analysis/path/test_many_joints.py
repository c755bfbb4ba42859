"""Strings of so many equal joints that several disturbances begin to grow within one step of the load."""

import numpy as np
import pytest

from rodwell import Problem, jointed_string, load_path
from rodwell.analysis.off_wall.conditions import LEAVES_EDGE, conditions
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.path.bridging import bridged


def _string(joints: int, weight: float = 0.05, clearance: float = 0.01) -> Problem:
    """Equal joints, each with half a tool joint at either end, in units of one joint."""
    half, body = (0.03 / joints, 3.0, 2.0, 0.5), (0.94 / joints, 1.0, 1.0, 1.0)
    between = (0.06 / joints, 3.0, 2.0, 0.5)
    inner = [one for _ in range(joints - 1) for one in (body, between)]
    return Problem(weight * joints**3, clearance=clearance / joints, sections=(half, *inner, body, half))


def test_the_first_load_of_many_joints_comes_down_to_the_endless_string_with_the_square_of_their_number() -> None:
    endless = jointed_string(_string(1)).load
    above = []
    for joints in (100, 200):
        first = load_path(_string(joints)).first("critical")
        assert first is not None
        assert first.met
        above.append(abs(first.force.value) / joints**2 - abs(endless.value))
    assert above[0] / above[1] == pytest.approx(4.0, rel=0.01)


def test_a_thousand_joints_lie_on_their_edges_where_the_stiffness_of_so_long_a_beam_is_round_off() -> None:
    """By balance each edge far from the ends bears half the weight of a joint."""
    problem = _string(1000, weight=0.15, clearance=0.006)
    state = bridged(RodInHole(problem), 0.0)
    assert state is not None
    forces = np.array([one.value for one in conditions(state) if one.kind == LEAVES_EDGE])
    assert forces.size == 2000
    half = 0.5 * problem.weight * problem.rod.whole_weight / 1000
    assert forces[20:-20] == pytest.approx(forces[1000] * np.ones(1960), rel=1e-4)
    assert problem.clearance * forces[1000] == pytest.approx(half, rel=1e-4)
