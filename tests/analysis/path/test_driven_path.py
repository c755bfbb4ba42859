"""Paths of a rod that is driven: what gives way in series, its own strain or a spring, decides whether it snaps.

With c = 1/EA + 1/k the driven end moves by δ = u − cF. The rigid path u(F) knows all of them: δ turns where du/dF = c,
so the rod snaps if and only if c is above the least du/dF on the part of the path on which a dead load is unstable; for
c → ∞ it snaps at the limit points of a dead load (−147.1580802, −103.6731326: two independent programs).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import rodwell
from rodwell.analysis.off_wall.control import Control, shortening
from rodwell.analysis.path.follow import load_path
from rodwell.analysis.path.load_path import LoadPath
from rodwell.errors import InputError
from rodwell.numerics.stretches.walk import step, tangent_in_load

PROBLEM = rodwell.Problem(weight=15)


@pytest.fixture(scope="module")
def rigid() -> LoadPath:
    return load_path(PROBLEM, until=0.0022, control="shortening", seeds=1)


def rates(path: LoadPath) -> np.ndarray:
    """du/dF at the states of a rigid path."""
    own = shortening(PROBLEM)
    out = []
    for state in path.legs[0].runs[0]:
        along = tangent_in_load(state.solved, 1.0)
        out.append(own.rate(state.solved, along) / along.load)
    return np.array(out)


def test_the_rate_of_the_shortening_is_that_of_differences(rigid: LoadPath) -> None:
    way = Control("shortening", PROBLEM.clearance**2, 3e-6)
    for state in rigid.legs[0].runs[0][10::25]:
        one = state.solved
        along = tangent_in_load(one, -1.0)
        h = 1e-4
        ahead, behind = (step(one.model, one, along, size)[1] for size in (h, -h))
        difference = (way.value(ahead) - way.value(behind)) / (2.0 * h)
        assert way.rate(one, along) == pytest.approx(difference, rel=1e-5)


def test_a_spring_decides_whether_the_rod_snaps(rigid: LoadPath) -> None:
    unstable = rates(rigid)
    least = float(np.min(unstable[unstable > 0.0]))  # to the step of the path: a few parts in a thousand
    c = 0.95 * least
    below = load_path(PROBLEM, until=0.0022 + c * 110.0, control="shortening", spring=1.0 / c, seeds=1)
    assert below.reached
    assert not below.snaps
    c = 1.5 * least
    way = Control("shortening", PROBLEM.clearance**2, c)
    driven = [way.value(state.solved) for state in rigid.legs[0].runs[0]]
    turns = next(here for here, ahead in pairwise(driven) if ahead < here)  # so far, and a little farther
    above = load_path(PROBLEM, until=1.001 * turns, control="shortening", spring=1.0 / c, seeds=1)
    (snap,) = above.snaps
    fold = above.first("fold")
    assert (snap.to.kind, abs(snap.to.turns)) in (("helix", 1), ("partial contact", 0))
    assert snap.to.force.value > snap.force.value + 1.0  # the load drops
    # where it gives way the rigid path has du/dF = c
    own, h = fold.state.shortening.value, 1e-7
    forces = [rigid.at(own + side)[0].state.force for side in (-h, 0.0, h)]
    assert forces[1] == pytest.approx(snap.force.value, abs=1e-6)
    assert 2 * h / (forces[2] - forces[0]) == pytest.approx(c, rel=1e-4)
    # and δ is the same before and after
    before = own - c * fold.force.value
    after = snap.state.shortening.value - c * snap.to.force.value
    assert before == pytest.approx(after, rel=1e-9)
    assert above.driven(snap).value == pytest.approx(after, rel=1e-12)


def test_a_very_soft_spring_is_a_dead_load() -> None:
    """δ turns where du/dF = c: next to a limit point u ~ √(F₀ − F), so F − F₀ ∝ c⁻², and nothing is left of it here."""
    c = 1e-2
    path = load_path(PROBLEM, until=c * 149.0, unload_to=c * 103.0, control="shortening", spring=1.0 / c, seeds=1)
    up, down = path.snaps
    assert up.force.value == pytest.approx(-147.1580802, abs=3e-6)
    assert down.force.value == pytest.approx(-103.6731326, abs=4e-5)  # u turns more slowly there
    assert (up.to.kind, down.to.kind) == ("helix", "straight")


def test_strain_and_spring_are_in_series() -> None:
    one = load_path(PROBLEM, until=0.0126, control="shortening", spring=2e4, axial_stiffness=2e4, seeds=1)
    other = load_path(PROBLEM, until=0.0126, control="shortening", axial_stiffness=1e4, seeds=1)
    assert one.compliance == other.compliance == pytest.approx(1e-4)
    for path in (one, other):
        straight = path.at(0.005)[0]
        assert straight.state.kind == "straight"
        assert straight.state.force == pytest.approx(-50.0, rel=1e-12)
        for driven in (0.0115, 0.0125):
            state = path.at(driven)[0].state
            assert state.shortening.value - 1e-4 * state.force == pytest.approx(driven, rel=1e-12)
    kinds = [event.kind for event in one.events]
    assert kinds == [event.kind for event in other.events]
    assert one.as_dict()["events"][0]["driven"]["value"] == pytest.approx(0.011123344016, rel=1e-10)
    axes = one.plot()  # the figure has the driven end on its abscissa: at first what gives way, by itself
    across, load = (np.asarray(line) for line in axes.lines[0].get_data())
    assert across[:2] == pytest.approx(0.1 * load[:2], rel=1e-12)
    assert across[-1] == pytest.approx(12.6, rel=1e-9)


@pytest.mark.parametrize(
    ("field", "given"),
    [
        ("spring", {"spring": 0.0, "control": "shortening"}),
        ("spring", {"spring": -3.0, "control": "shortening"}),
        ("axial_stiffness", {"axial_stiffness": float("nan"), "control": "shortening"}),
        ("axial_stiffness", {"axial_stiffness": 1e5}),
        ("spring", {"spring": 1e5, "control": "force"}),
    ],
)
def test_what_makes_no_sense_is_refused(field: str, given: dict) -> None:
    with pytest.raises(InputError) as caught:
        load_path(PROBLEM, until=0.02 if "control" in given and given["control"] != "force" else -130.0, **given)
    assert caught.value.field == field
