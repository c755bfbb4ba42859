"""Special points of branches: where they lie, how exactly, and branches in other parameters than the load."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from special_points import special

from rodwell import InputError, Problem, critical_loads, equilibrium, follow
from rodwell.analysis.discrete.measures import Measured


def test_two_places_lift_off_at_once() -> None:
    lift = follow(Problem(1000.0)).lift_off
    assert lift is not None
    assert len(lift.s) == 2
    assert lift.s[0] == pytest.approx(1.0 - lift.s[1], abs=1e-7)
    assert lift.solution.highest_pressure[0] == pytest.approx(0.0, abs=1e-4)


@settings(max_examples=8)
@given(st.floats(1.0, 500.0), st.floats(5.0, 90.0), st.floats(0.002, 0.04))
def test_errors_of_lift_off_are_honest(weight: float, alpha: float, clearance: float) -> None:
    problem = Problem(weight, alpha=alpha, clearance=clearance)
    rough, sharp = follow(problem, rtol=1e-4).lift_off, follow(problem, rtol=1e-9).lift_off
    assert rough is not None
    assert sharp is not None
    assert abs(rough.force - sharp.force) <= rough.error + sharp.error + 1e-12 * abs(sharp.force)


def test_largest_values_lie_between_grid_points() -> None:
    state = follow(Problem(15.0), 1, until=-150.0)[-1]
    s = np.linspace(0.0, 1.0, 40_001)
    fields = state.fields(s)
    for name in ("contact_pressure", "T2", "rod_M2"):
        value, error, place = state.largest(name)
        assert value == pytest.approx(np.max(np.abs(fields[name])), rel=1e-7)
        assert value >= np.max(np.abs(fields[name])) * (1.0 - 1e-12)
        assert error < 1e-7 * value
        assert np.abs(state.fields(np.array([place]))[name][0]) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("weight", [5.0, 8.0, 16.0, 16.5, 18.0, 25.0, 40.0, 60.0, 200.0])
def test_located_points_meet_the_tolerance_too(weight: float) -> None:
    branch = follow(Problem(weight))
    assert branch.converged
    assert all(point.solution.converged for point in branch.special_points)


def test_forces_asked_for_are_met_exactly() -> None:
    assert follow(Problem(15.0), until=-200.0).force[-1] == -200.0
    assert equilibrium(Problem(15.0, turns=1), -160.0).force == -160.0


@pytest.mark.parametrize(
    ("weight", "mode", "odd"), [(5.0, 2, True), (15.0, 1, True), (5.0, 1, False), (15.0, 2, False)]
)
def test_which_twist_delays_lift_off(weight: float, mode: int, odd: bool) -> None:
    """Paper, section 4.2, by mode and arm: T₁ > 0 delays lift-off of odd modes on the arm with ω₂(1) > 0 only."""

    def lift_off(twist: float, mirror: bool) -> float:
        point = follow(Problem(weight, twist=twist), mode, mirror=mirror).lift_off
        assert point is not None
        return point.force

    plain = lift_off(0.0, mirror=False)
    if odd:
        assert lift_off(0.5, mirror=True) < plain < lift_off(0.5, mirror=False)
        assert lift_off(-0.5, mirror=False) == pytest.approx(lift_off(0.5, mirror=True), rel=1e-7)
    else:
        assert lift_off(0.5, mirror=False) == pytest.approx(lift_off(-0.5, mirror=False), rel=1e-7)
        assert plain < lift_off(0.5, mirror=False)


LIFTING = [5.0, 16.0, 40.0, 300.0]


@pytest.mark.parametrize("weight", LIFTING)
def test_errors_at_lift_off_include_that_of_its_place(weight: float) -> None:
    """Against a tolerance a hundred times finer: reactions change fast along the branch, so the place matters."""
    rough, fine = follow(Problem(weight), rtol=1e-6).lift_off, follow(Problem(weight), rtol=1e-9).lift_off
    assert rough is not None
    assert fine is not None
    assert abs(rough.force - fine.force) <= rough.error + fine.error
    pairs = [(rough.solution.total_wall_force, fine.solution.total_wall_force)]
    pairs += [(rough.solution.end_reactions[k], fine.solution.end_reactions[k]) for k in ("shear", "moment")]
    pairs += [(rough.solution.number(k), fine.solution.number(k)) for k in (Measured.SHORTENING, Measured.ENERGY)]
    for (a, error_a), (b, error_b) in pairs:
        assert abs(a - b) <= error_a + error_b


def test_an_index_change_in_the_first_step_from_a_state_is_found() -> None:
    start = follow(Problem(15.0), until=-362.579)[-1]
    branch = follow(Problem(15.0), start=start, until=-365.6, largest_step=1.0)
    assert special(branch, "branch_point") == pytest.approx([-362.629366], abs=1e-6)


def test_a_start_takes_its_own_tolerance_and_no_mode() -> None:
    start = follow(Problem(15.0), until=-150.0, rtol=1e-5)[-1]
    assert follow(Problem(15.0), start=start, until=-160.0, rtol=1e-9)[-1].meshes.rtol == 1e-9
    assert follow(Problem(15.0), start=start, until=-160.0, rtol=1e-9).converged
    for wrong in ({"mode": 1}, {"mirror": True}):
        with pytest.raises(InputError, match="neither mode nor mirror"):
            follow(Problem(15.0), start=start, until=-160.0, **wrong)  # type: ignore[arg-type]


def test_touch_down_is_told_from_lift_off() -> None:
    """From below the lift-off load upwards contact becomes complete, and then the rod straight."""
    below = follow(Problem(15.0), until=-140.0)[-1]
    branch = follow(Problem(15.0), start=below, until=-100.0)
    assert [p.kind for p in branch.special_points] == ["touch_down", "branch_point", "end"]
    assert branch.lift_off is None
    assert special(branch, "touch_down") == pytest.approx([-123.173074], abs=5e-7)
    assert branch.ended_because == "it meets the straight rod"
    assert branch.force[-1] == pytest.approx(critical_loads(Problem(15.0), 1)[0].force, abs=1e-7)


@pytest.mark.parametrize(
    ("parameter", "until", "changed"),
    [("alpha", 60.0, {"alpha": 60.0}), ("clearance", 0.012, {"clearance": 0.012}), ("weight", 18.0, {"weight": 18.0})],
)
def test_another_parameter_leads_to_the_state_of_the_other_problem(
    parameter: str, until: float, changed: dict[str, float]
) -> None:
    """Round the other way: first along the force in one problem, then along a parameter at constant force."""
    problem, force = Problem(15.0), -150.0
    along = follow(problem, start=follow(problem, until=force)[-1], until=until, parameter=parameter)
    direct = follow(problem.but(**changed), until=force)[-1]
    assert along.reached_end
    assert along[-1].problem == direct.problem
    assert along[-1].force == force
    for which in (Measured.ENERGY, Measured.P_MAX, Measured.SHORTENING):
        (a, error_a), (b, error_b) = along[-1].number(which), direct.number(which)
        assert abs(a - b) <= error_a + error_b


def test_twist_reaches_the_state_of_the_twisted_rod() -> None:
    problem = Problem(15.0)
    along = follow(problem, start=follow(problem, until=-118.0)[-1], until=0.4, parameter="twist")
    direct = follow(problem.but(twist=0.4), until=-118.0)[-1]
    assert along[-1].number(Measured.ENERGY).value == pytest.approx(direct.number(Measured.ENERGY).value, rel=1e-8)


def test_a_coiled_rod_keeps_its_symmetry_past_its_branch_point() -> None:
    coil = equilibrium(Problem(15.0, turns=1), -160.0)
    branch = follow(coil.problem, start=coil, until=-300.0)
    assert branch.reached_end
    assert branch.converged
    assert [p.kind for p in branch.special_points] == ["branch_point", "lift_off", "end"]
