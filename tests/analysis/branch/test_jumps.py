"""Branches do not jump: what is found depends neither on the step, nor on the end asked for, nor on the direction."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell import Branch, Problem, critical_loads, diagram, follow
from rodwell.analysis.discrete.measures import Measured

ENDS = ("clamped-clamped", "clamped-pinned", "pinned-clamped", "pinned-pinned", "clamped-guided")


def special(branch: Branch) -> list[tuple[str, int, int]]:
    return [(p.kind, p.index_before, p.index_after) for p in branch.special_points]


def energy(branch: Branch, force: float) -> float:
    return branch.at(force).number(Measured.ENERGY).value


@pytest.mark.parametrize("until", [-700.0, -1500.0])
def test_mode_2_next_to_an_unfolded_pitchfork(until: float) -> None:
    """w = 15, α = 89°: an independent continuation with small steps has index 1 and this energy at F = −200."""
    branch = follow(Problem(15.0, 89.0), 2, until=until)
    state = branch.at(-200.0)
    assert state.stability_index == 1
    assert state.number(Measured.ENERGY).value == pytest.approx(-0.0568224, abs=1e-7)
    assert [p.kind for p in branch.special_points] == ["critical", "lift_off", "end"]


def test_the_fold_is_there_once_and_no_branch_point_where_symmetry_forbids_it() -> None:
    result = diagram(Problem(15.0, 89.0), until=-1500.0, modes=2)
    points = [p for branch in result for p in branch.special_points]
    assert [p.force for p in points if abs(p.force + 358.9) < 1.0] == [pytest.approx(-358.8964174, abs=1e-7)]
    assert not [p for p in points if p.kind == "branch_point"]
    assert result.converged


@pytest.mark.parametrize("weight", [62.33, 62.34, 62.345, 62.40])
def test_secondary_bifurcation_next_to_a_double_load(weight: float) -> None:
    """Two loads meet at γ = 62.34181826, F = −197.392088; the second branch is crossed close by, at any of these."""
    branch = follow(Problem(weight), 2, until=-260.0)
    first = branch.special_points[1]
    assert (first.kind, first.index_before, first.index_after) == ("branch_point", 1, 0)
    assert -1.5 < first.force - branch.force[0] < 0.0


def test_clamped_ends_and_twist_let_branches_cross_without_a_reflection() -> None:
    """The first integral has −½y″² at both ends: states with y″(0) = ±y″(1) meet where both vanish."""
    branch = follow(Problem(15.0, twist=0.5), 2, until=-300.0)
    (point,) = (p for p in branch.special_points if p.kind == "branch_point")
    ends = point.solution.point.fine.space.evaluate(point.solution.point.fine.c, np.array([0.0, 1.0]), 3)[2]
    middle = point.solution.largest("omega2").value
    assert np.max(np.abs(ends)) < 1e-7 * middle
    assert point.solution.certificate.passed


def test_a_branch_point_without_a_reflection_is_known_as_well_as_any_other() -> None:
    """Twist of either sense is the mirror image of the other, and every step finds the same place."""
    found = []
    for twist, step in ((1.0, 0.06), (-1.0, 0.06), (1.0, 0.03)):
        branch = follow(Problem(15.0, twist=twist), 2, until=-180.0, largest_step=step)
        found += [p for p in branch.special_points if p.kind == "branch_point"]
    assert len(found) == 3
    for point in found:
        assert point.solution.converged
        assert point.error < 1e-8
        assert abs(point.force - found[0].force) < point.error + found[0].error


CELLS = {
    "three quarter waves": (Problem(9.393, 90.0, clearance=0.00262, ends="pinned-guided"), 3, -203.0, 1),
    "three half waves, twisted": (
        Problem(26.31, 90.0, clearance=0.01377, twist=0.008, ends="pinned-pinned"),
        2,
        -158.0,
        -1,
    ),
}


@pytest.mark.parametrize(("problem", "mode", "until", "sign"), CELLS.values(), ids=CELLS)
def test_equal_cells_let_branches_cross_that_no_reflection_of_the_whole_rod_explains(
    problem: Problem, mode: int, until: float, sign: int
) -> None:
    """A horizontal rod with pinned and guided ends goes on as a periodic one, about any zero of which it turns.

    Both sorts of states are those of a shorter rod, whose branch has no branch point there.
    """
    branches = [follow(problem, mode, until=until, largest_step=step) for step in (0.06, 0.02)]
    first, second = ([p for p in branch.special_points if p.kind == "branch_point"] for branch in branches)
    assert len(first) == len(second) > 0
    for one, other in zip(first, second, strict=True):
        assert one.solution.converged
        assert (one.index_before, one.index_after) == (other.index_before, other.index_after)
        assert abs(one.force - other.force) <= one.error + other.error
    state = first[0].solution.point.fine
    x = np.linspace(0.0, 1.0 / 3.0, 9)
    right, left = (state.space.evaluate(state.c, 1.0 / 3.0 + way * x, 1)[0] for way in (1.0, -1.0))
    np.testing.assert_allclose(right, sign * left, atol=1e-8 * np.max(np.abs(state.c)))
    assert not [p for branch in branches for p in branch.special_points if p.kind == "uncertain"]


def test_a_row_of_four_cells_may_become_one_of_two() -> None:
    """Four half waves are twice the two of half the rod (weight 1/8, clearance 2, force 1/4), odd about its middle."""
    whole = follow(Problem(60.0, 90.0, ends="pinned-pinned"), 3, until=-215.0)
    half = follow(Problem(7.5, 90.0, clearance=0.02, ends="pinned-pinned"), 2, until=-215.0 / 4.0)
    assert special(whole) == [("critical", 2, 2), ("branch_point", 2, 1), ("end", 1, 1)]
    assert special(half) == [("critical", 1, 1), ("branch_point", 1, 0), ("end", 0, 0)]
    one, other = whole.special_points[1], half.special_points[1]
    assert abs(one.force - 4.0 * other.force) <= one.error + 4.0 * other.error


@pytest.mark.parametrize("by", [0.0, 1e-12])
def test_waves_of_nearly_the_length_of_those_of_the_branch_may_branch_off(by: float) -> None:
    """Nineteen quarter waves, crossed by fifteen and by seventeen; a hair of weight more or less changes nothing."""
    problem = Problem(568.79 * (1.0 + by), 90.0, clearance=0.0013384, ends="pinned-guided")
    branch = follow(problem, 3, until=-1600.0)
    assert special(branch) == [("critical", 2, 2), ("branch_point", 2, 1), ("branch_point", 1, 0), ("end", 0, 0)]
    points = [p.solution for p in branch.special_points if p.kind == "branch_point"]
    assert all(point.converged for point in points)
    for point, waves in zip(points, (15, 17), strict=True):
        state, family = point.point.fine, point.meshes.fine
        vector = np.random.default_rng(1).standard_normal(state.c.size)
        family.nearest_curvature(state, vector, 12)
        s = np.linspace(0.0, 1.0, 400)
        shares = [
            abs(np.sum(state.space.evaluate(vector, s, 1)[0] * np.sin(k * np.pi / 2.0 * s))) for k in range(1, 40, 2)
        ]
        assert int(np.argmax(shares)) * 2 + 1 == waves


def test_what_has_the_parity_of_the_branch_does_not_branch_off() -> None:
    """A pitchfork of four half waves that a little twist unfolds: states of both branches are odd about the middle."""
    problem = Problem(143.2, 90.0, clearance=0.0208, twist=-0.00092, ends="pinned-pinned")
    usual, careful = (follow(problem, 3, until=-230.0, largest_step=step) for step in (0.06, 0.02))
    assert [p.kind for p in usual.special_points] == [p.kind for p in careful.special_points] == ["critical", "end"]
    assert usual[-1].number(Measured.ENERGY).value == pytest.approx(careful[-1].number(Measured.ENERGY).value, rel=1e-8)


@settings(max_examples=12)
@given(
    st.floats(8.0, 40.0), st.floats(-3.0, 1.0), st.sampled_from([0.0, 0.01, -0.3]), st.sampled_from(ENDS),
    st.integers(1, 3),
)  # fmt: skip
def test_what_is_found_does_not_depend_on_the_step(
    weight: float, tilt: float, twist: float, ends: str, mode: int
) -> None:
    """α from 80° to 89.999°, where pitchforks unfold: 0.1 and 5 times the usual step, and half the way."""
    problem = Problem(weight, 90.0 - 10.0**tilt, twist=twist, ends=ends)
    first = critical_loads(problem, mode)[mode - 1]
    until = first.force - 180.0
    usual = follow(problem, first, until=until)
    for step in (0.006, 0.3):
        other = follow(problem, first, until=until, largest_step=step)
        assert special(other) == special(usual)
        for one, same in zip(usual.special_points, other.special_points, strict=True):
            assert one.force == pytest.approx(same.force, abs=1e-6)
    half = follow(problem, first, until=0.5 * (first.force + until))
    if half.reached_end and usual.reached_end:
        assert energy(usual, half.force[-1]) == pytest.approx(half[-1].number(Measured.ENERGY).value, rel=1e-6)


@pytest.mark.parametrize("step", [0.06, 0.02])
def test_a_fold_right_behind_the_start_is_found_with_any_step(step: float) -> None:
    """Twist parts two loads that differ by 2e-4 of themselves: the branch folds 8e-5 behind its critical load."""
    problem = Problem(0.6358, 90.0, clearance=0.004177, twist=3.288, ends="pinned-guided")
    start, fold = follow(problem, 2, until=-64.16, largest_step=step).special_points[:2]
    assert (start.kind, start.index_after) == ("critical", 1)
    assert (fold.kind, fold.index_before, fold.index_after) == ("fold", 1, 2)
    assert 0.0 < start.force - fold.force < 2e-4


def test_two_folds_within_a_step_are_found() -> None:
    """Next to the horizontal an unfolded pitchfork has two folds 9e-5 apart in load, a tenth of a step apart."""
    problem = Problem(1.41, 89.999974, clearance=0.005659, ends="guided-clamped")
    usual, careful = (follow(problem, 2, until=-96.0, largest_step=step) for step in (0.06, 0.02))
    folds = [[p for p in branch.special_points if p.kind == "fold"] for branch in (usual, careful)]
    assert len(folds[0]) == len(folds[1]) == 2
    for one, other in zip(*folds, strict=True):
        assert abs(one.force - other.force) <= one.error + other.error


MET = {
    "clamped, guided": (Problem(5.677, 90.0, clearance=0.00866, twist=2.984, ends="clamped-guided"), -220.0),
    "pinned, guided": (Problem(0.8994, 90.0, clearance=0.01209, twist=-3.708, ends="pinned-guided"), -35.0),
}


@pytest.mark.parametrize(("problem", "until"), MET.values(), ids=MET)
@pytest.mark.parametrize("step", [0.06, 0.03])
def test_a_branch_that_comes_back_to_the_straight_rod_ends_there(problem: Problem, until: float, step: float) -> None:
    """Under twist it passes through the straight rod without turning back: that of mode 2 at the load of mode 1."""
    branch = follow(problem, 2, until=until, largest_step=step)
    loads = critical_loads(problem, 2)
    assert branch.ended_because == "it meets the straight rod"
    met = branch.special_points[-2]
    assert (met.kind, met.index_before, met.index_after) == ("branch_point", 0, 0)
    assert abs(met.force - loads[0].force) <= met.error + loads[0].error
    assert not branch[-1].point.fine.c.any()
    assert branch.converged


def test_a_change_of_the_index_is_placed_with_the_usual_step() -> None:
    """Where it is not found in one, a step is repeated with half the length: shorter ones (0.02) put it at −431.367415.

    The problem is number 2718 of the campaign of random branches.
    """
    problem = Problem(526.5214399154713, 90.0, 0.020088610341481322, twist=0.013809172470581072, ends="pinned-pinned")
    branch = follow(problem, 3, until=-450.0)
    found = [(p.kind, p.index_before, p.index_after) for p in branch.special_points]
    assert found == [("critical", 2, 2), ("branch_point", 2, 1), ("branch_point", 1, 0), ("end", 0, 0)]
    assert branch.special_points[2].force == pytest.approx(-431.3674148227, abs=1e-9)
    assert branch.converged
