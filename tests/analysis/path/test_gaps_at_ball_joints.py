"""A gap at a ball joint closes where the slope there goes through zero, and opens again: both sides tell the load.

The truth: a free stretch there has the length 2|φ′|√(Δ/wₗ) (theory of the rod in a hole), on either side of the load at
which φ′ = 0, which the program finds in the state of complete contact in between.
"""

from __future__ import annotations

import numpy as np
import pytest

import rodwell
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.off_wall.vanishing import unbalanced
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath

PROBLEM = rodwell.Problem(1.458300134282979, 65.24078317315349, clearance=0.033974673891570835, ends="ball-free")
"""Number 71 of the campaign of load paths: it ended where the gap was too short for its balance."""


@pytest.fixture(scope="module")
def path() -> LoadPath:
    return load_path(PROBLEM, until=-13.4, seeds=1)


def slope(state: ContactState) -> float:
    return float(state.fine.solved.shape.nodes[0, 3])


def test_it_closes_and_opens_again(path: LoadPath) -> None:
    assert path.reached
    assert not path.missed
    assert [one.kind for one in path.events] == ["critical", "lift_off", "gap_opens", "gap_closes", "gap_opens"]
    closes, opens = path.events[-2:]
    assert closes.s == opens.s == (0.0,)
    assert closes.force == opens.force
    assert closes.state.certificate.passed
    assert [len(closes.state.gaps), len(closes.state.contacts)] == [1, 1]
    assert abs(slope(closes.state)) < 1e-8


def test_states_on_either_side_tell_its_load(path: LoadPath) -> None:
    at = path.events[-2].force.value
    loads = at + np.array([0.2, 0.1, -0.1, -0.2])
    states = [path.at(load)[0].state for load in loads]
    slopes = np.array([slope(state) for state in states])
    assert slopes[0] * slopes[-1] < 0.0
    zero = np.polynomial.Polynomial(np.polyfit(slopes, loads - at, 3)[::-1])(0.0)
    assert abs(zero) < 2e-3 * 0.2
    for state, rate in zip(states, slopes, strict=True):
        assert state.certificate.passed
        length = 2.0 * abs(rate) * np.sqrt(PROBLEM.clearance / PROBLEM.lateral_weight)
        assert state.gaps[0].end.value == pytest.approx(length, rel=0.2)


def test_no_state_is_given_that_misses_its_balance(path: LoadPath) -> None:
    """Right beside that load the gap is too short for third derivatives: such a state is not given, and says so."""
    at = path.events[-2].force.value
    with pytest.raises(rodwell.NotConvergedError, match="no state of the loading path was found"):
        path.at(at + 1e-4)
    assert all(unbalanced(state) is None for state in path.legs[0].runs[-1])
