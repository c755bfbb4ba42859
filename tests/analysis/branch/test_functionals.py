"""Numbers by name and of one's own, events and stop conditions, labels."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rodwell import Branch, InputError, Problem, Solution, branch_off, follow
from rodwell.analysis.branch.functionals import on_one_mesh
from rodwell.analysis.discrete.measures import MEASURES, Measured

PROBLEM = Problem(15.0, 89.0)
SHORTER = 5e-4


def shortened(state: Solution) -> float:
    """Zero where the ends have come closer by a given amount."""
    return state.number("end_shortening").value - SHORTER


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(PROBLEM, until=-400.0, events={"shorter": shortened, "no contact": "largest_pressure"})


def test_measured_numbers_have_names(branch: Branch) -> None:
    for which, name in MEASURES.items():
        assert branch[3].number(name) == branch[3].number(which)
        assert np.array_equal(branch.numbers(name), branch.numbers(which))
        assert np.array_equal(branch.errors(name), branch.errors(which))


def test_an_event_is_where_its_function_vanishes(branch: Branch) -> None:
    points = [point for point in branch.special_points if point.kind == "shorter"]
    signs = np.sign([shortened(state) for state in branch])
    assert len(points) == np.count_nonzero(np.diff(signs)) > 0
    for point in points:
        assert abs(shortened(point.solution)) < 1e-12
        assert point.solution.converged
        assert point.error < 1e-7


def test_an_event_by_name_is_the_event_that_is_there_already(branch: Branch) -> None:
    own = [point for point in branch.special_points if point.kind == "no contact"]
    lift = branch.lift_off
    assert lift is not None
    assert own[0].force == pytest.approx(lift.force, abs=own[0].error + lift.error)


def test_special_points_are_in_order_of_travel(branch: Branch) -> None:
    after = [point.after for point in branch.special_points]
    assert after == sorted(after)
    kinds = [point.kind for point in branch.special_points]
    assert kinds[0] == "critical"
    assert kinds[-1] == "end"
    index = branch.special_points[0].index_after
    for point in branch.special_points[1:]:
        assert point.index_before == index
        index = point.index_after


def test_events_leave_the_branch_as_it_is(branch: Branch) -> None:
    plain = follow(PROBLEM, until=-400.0)
    assert np.array_equal(plain.values, branch.values)
    own = ("shorter", "no contact")
    assert [p.value for p in plain.special_points] == [p.value for p in branch.special_points if p.kind not in own]


def test_a_stop_condition_ends_the_branch_where_it_is_met(branch: Branch) -> None:
    stopped = follow(PROBLEM, until=-400.0, stop={"shorter": shortened})
    assert stopped.reached_end
    assert stopped.ended_because == "shorter"
    first = next(point for point in branch.special_points if point.kind == "shorter")
    assert stopped[-1].force == pytest.approx(first.force, abs=2.0 * first.error)
    assert [point.kind for point in stopped.special_points][-2:] == ["shorter", "end"]
    assert stopped.special_points[-1].index_after == first.index_before
    assert stopped.converged


def test_events_on_branches_in_other_parameters_and_from_branch_points() -> None:
    rod = Problem(15.0)
    parent = follow(rod, until=-400.0)
    point = next(p for p in parent.special_points if p.kind == "branch_point")
    child = branch_off(point, until=-390.0, stop={"half": lambda state: state.number("energy").value + 0.25})
    assert child.ended_because == "half"
    assert child[-1].number("energy").value == pytest.approx(-0.25, abs=1e-12)
    heavier = {"heavier": lambda state: state.problem.weight - 15.5}
    other = follow(rod, start=point, parameter="weight", until=16.0, events=heavier)
    assert other.labelled("heavier 1").value == pytest.approx(15.5, abs=1e-9)


def test_labels_number_the_special_points(branch: Branch) -> None:
    assert list(branch.labels)[:2] == ["critical 1", "lift_off 1"]
    assert list(branch.labels.values()) == list(branch.special_points)
    assert branch.labelled("lift_off 1") is branch.lift_off
    with pytest.raises(InputError, match=r"^label = 'lift-off 1': did you mean 'lift_off 1'"):
        branch.labelled("lift-off 1")


def test_the_error_of_a_function_is_that_of_both_meshes(branch: Branch) -> None:
    def twice(state: Solution) -> float:
        return 2.0 * state.number("energy").value

    assert branch.numbers(twice) == pytest.approx(2.0 * branch.numbers("energy"), rel=1e-15)
    assert np.all(branch.errors(twice)[1:] > 0.0)
    state = branch[4]
    coarse = on_one_mesh(state, *state.levels[0])
    assert coarse.number("energy").value == pytest.approx(state.number("energy").value, rel=1e-6)
    assert coarse.fields(5)["y"] == pytest.approx(state.fields(5)["y"], rel=1e-6)


def word(_: Solution) -> str:
    return "a"


def test_what_is_no_number_is_said_before_a_branch_is_followed(branch: Branch) -> None:
    with pytest.raises(InputError, match=r"^number = 'enrgy': did you mean 'energy'\?"):
        follow(PROBLEM, until=-200.0, events={"x": "enrgy"})
    with pytest.raises(InputError, match=r"^word = 'a': must return a number"):
        follow(PROBLEM, until=-200.0, stop={"x": word})  # type: ignore[dict-item]
    with pytest.raises(InputError, match=r"^events = 'fold': must be a text of its own"):
        follow(PROBLEM, until=-200.0, events={"fold": "energy"})
    with pytest.raises(InputError, match=r"^field = 'omega': did you mean 'omega3|2|1'"):
        branch[3].largest("omega")


def test_a_function_that_is_not_defined_somewhere_has_no_zero_there() -> None:
    branch = follow(PROBLEM, until=-150.0, events={"x": lambda _state: math.nan})
    assert "x" not in [point.kind for point in branch.special_points]


def test_results_are_short_to_look_at(branch: Branch) -> None:
    shown = [branch.last[1], branch[3].point.fine, branch.special_points[1], branch.mode, branch[3]]
    assert all(len(repr(item)) < 120 for item in shown)


def test_what_differs_in_another_problem_is_said(branch: Branch) -> None:
    with pytest.raises(InputError, match=r"weight = 15\.0 there, 17\.0 here"):
        follow(PROBLEM.but(weight=17.0), start=branch[3], until=-130.0)


def test_all_measured_numbers_have_a_name() -> None:
    assert set(MEASURES) == set(Measured)
