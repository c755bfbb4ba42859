"""Branches: lift-off, stability, energy, symmetry, against the paper, AUTO-07p, IPOPT and the work–energy theorem."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from special_points import special

from rodwell import Branch, InputError, Problem, Solution, critical_loads, equilibrium, follow
from rodwell.analysis.discrete.measures import Measured, measure
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray


def test_lift_off_of_the_first_mode_at_w15(fig3c: dict[int, Branch]) -> None:
    lift = fig3c[1].lift_off
    assert lift is not None
    assert lift.force == pytest.approx(-123.173074, abs=5e-7)
    assert lift.s == pytest.approx((0.5,), abs=1e-7)
    assert lift.error <= 1e-8 * abs(lift.force)


def test_secondary_bifurcations_of_fig3c(fig3c: dict[int, Branch]) -> None:
    """AUTO-07p on the 15-dimensional system: −362.629366 and −164.784232. They test the y′⁴ term."""
    assert special(fig3c[1], "branch_point") == pytest.approx([-362.629366], abs=1e-6)
    assert special(fig3c[2], "branch_point") == pytest.approx([-164.784232], abs=1e-6)


def test_stability_changes_at_the_secondary_bifurcations(fig3c: dict[int, Branch]) -> None:
    """The first mode loses stability there, the second gains it (paper, section 4.1.2)."""
    first = next(p for p in fig3c[1].special_points if p.kind == "branch_point")
    second = next(p for p in fig3c[2].special_points if p.kind == "branch_point")
    assert (first.index_before, first.index_after) == (0, 1)
    assert (second.index_before, second.index_after) == (1, 0)


def test_a_zero_of_the_end_curvature_is_a_branch_point(fig3c: dict[int, Branch]) -> None:
    """Translation along the cylinder solves the linearised equations where ω₂(0) = ω₂(1) = 0 (α = 90°)."""
    point = next(p for p in fig3c[2].special_points if p.kind == "branch_point")
    slope = np.polyfit(fig3c[2].force[5:], fig3c[2].numbers(Measured.OMEGA2_1)[5:], 3)
    assert abs(point.solution.number(Measured.OMEGA2_1).value) < 1e-8 * abs(np.polyval(np.polyder(slope), point.force))


@pytest.mark.parametrize("step", [0.01, 0.08, 0.3])
def test_special_points_do_not_depend_on_the_step(fig3c: dict[int, Branch], step: float) -> None:
    branch = follow(Problem(15.0), 1, until=-400.0, largest_step=step)
    expected = fig3c[1].special_points
    assert [p.kind for p in branch.special_points] == [p.kind for p in expected]
    for found, reference in zip(branch.special_points, expected, strict=True):
        assert found.force == pytest.approx(reference.force, abs=found.error + reference.error + 1e-11)


def full_hessian(family: Family, state: State) -> FloatArray:
    band = family.assemble(state.c, state.lam)[2]
    n, full = len(band), np.zeros((len(band), len(band)))
    for k in range(band.shape[1]):
        i = np.arange(n - k)
        full[i + k, i] = full[i, i + k] = band[: n - k, k]
    return full


def test_index_is_the_count_of_negative_eigenvalues(fig3c: dict[int, Branch]) -> None:
    for state in (fig3c[1][20], fig3c[2][6], fig3c[1][-1]):
        full = full_hessian(state.meshes.fine, state.point.fine)
        assert np.sum(np.linalg.eigvalsh(full[2:-2, 2:-2]) < 0.0) == state.stability_index


def test_energy_is_that_of_the_coefficients_and_of_exact_quadrature(fig3c: dict[int, Branch]) -> None:
    """The energy is carried over the last Newton step; the meshes of branches have two Gauss points less than exact.

    With as many as are exact a Newton step, its gradient summed here, changes no measured number.
    """
    for state in (fig3c[1][3], fig3c[1][-1], fig3c[2][6]):
        family, fine = state.meshes.fine, state.point.fine
        assert family.assemble(fine.c, fine.lam)[0] == pytest.approx(fine.energy, rel=1e-11)
        exact = SplineSpace(fine.space.breaks, fine.space.degree)
        assert exact.per_element == fine.space.per_element + 2
        basis = np.array([fine.space.evaluate(one, exact.points, 3) for one in np.eye(fine.space.size)])
        u, p = np.tensordot(fine.c, basis, 1), family.parameters(fine.lam)
        energy, _, slopes, *_ = family.model.density(exact.points, u, np.empty(0), p, np.zeros_like(p))
        assert exact.weights @ energy == pytest.approx(fine.energy, rel=1e-11)
        gradient = sum(basis[:, d] @ (exact.weights * slopes[d]) for d in range(3))
        step = np.zeros(fine.space.size)
        step[2:-2] = np.linalg.solve(full_hessian(family, fine)[2:-2, 2:-2], gradient[2:-2])  # clamped
        other = dataclasses.replace(fine, c=fine.c - step, energy=float(exact.weights @ energy))
        numbers, scales, _ = measure(family, other)
        assert np.all((np.abs(numbers - state.point.values) <= 1e-10 * scales)[: len(Measured)])


def test_load_does_the_work_that_the_energy_loses() -> None:
    """dE/dF = ∂E/∂F = 1 − z(1): the energy's own derivative along the branch."""
    branch = follow(Problem(40.0, alpha=55.0, twist=0.8), 1, until=-200.0)
    force = -170.0
    h = 1e-2
    above, below = (
        branch.at(force + h).number(Measured.ENERGY).value,
        branch.at(force - h).number(Measured.ENERGY).value,
    )
    assert (above - below) / (2 * h) == pytest.approx(branch.at(force).number(Measured.SHORTENING).value, rel=1e-7)


@pytest.mark.parametrize("problem", [Problem(0.0), Problem(0.0, alpha=30.0), Problem(100.0, alpha=0.0)], ids=str)
def test_without_lateral_weight_lift_off_coincides_with_buckling(problem: Problem) -> None:
    branch = follow(problem)
    assert branch.lift_off_at_buckling
    assert branch.lift_off is not None
    assert branch.lift_off.force == critical_loads(problem, 1)[0].force
    assert branch[1].highest_pressure[0] > 0.0  # the wall would have to pull at once


def test_almost_weightless_rod_lifts_off_just_after_buckling() -> None:
    branch = follow(Problem(1e-6))
    assert branch.lift_off is not None
    assert 0.0 < branch.mode.force - branch.lift_off.force < 1e-4  # type: ignore[union-attr]
    assert branch.lift_off.s == pytest.approx((0.25, 0.75), abs=1e-5)


@pytest.mark.parametrize(("force", "energy"), [(-140.0, -0.043325), (-160.0, -0.089700), (-200.0, -0.185518)])
def test_coiled_states_have_the_energy_that_ipopt_found(force: float, energy: float) -> None:
    """One turn at w = 15, relative to the straight rod: minimisation off the wall with an interior-point method."""
    state = equilibrium(Problem(15.0, turns=1), force)
    assert state.number(Measured.ENERGY).value == pytest.approx(energy, abs=6e-7)
    assert state.stable
    assert state.highest_pressure[0] < 0.0
    assert state.fields()["xi2"][-1] == pytest.approx(2.0 * np.pi)


def test_coiled_state_lifts_off_on_unloading() -> None:
    problem = Problem(15.0, turns=1)
    branch = follow(problem, start=equilibrium(problem, -200.0), until=-60.0)
    assert special(branch, "lift_off") == pytest.approx([-110.0], abs=1.0)  # "up to about −110" in contact
    assert branch.reached_end


def test_opposite_turns_mirror_each_other() -> None:
    right, left = (equilibrium(Problem(15.0, alpha=60.0, twist=t, turns=n), -150.0) for n, t in ((2, 0.5), (-2, -0.5)))
    assert right.number(Measured.ENERGY).value == pytest.approx(left.number(Measured.ENERGY).value, rel=1e-11)
    assert right.fields()["xi2"] == pytest.approx(-left.fields()["xi2"], abs=1e-9)


@settings(max_examples=8)
@given(st.floats(2.0, 300.0), st.floats(15.0, 90.0), st.floats(0.005, 0.03), st.floats(-2.0, 2.0))
def test_mirror_symmetry(weight: float, alpha: float, clearance: float, twist: float) -> None:
    """(y, T₁) → (−y, −T₁): the other arm under the opposite twist has the same lift-off."""
    one = follow(Problem(weight, alpha=alpha, clearance=clearance, twist=twist)).lift_off
    two = follow(Problem(weight, alpha=alpha, clearance=clearance, twist=-twist), mirror=True).lift_off
    if one is None:
        assert two is None
        return
    assert two is not None
    assert one.force == pytest.approx(two.force, abs=one.error + two.error + 1e-9 * abs(one.force))
    assert one.s == pytest.approx(two.s, abs=1e-5)
    assert one.index_before == two.index_before


def test_measured_numbers_are_within_their_errors() -> None:
    problem = Problem(80.0, alpha=75.0)
    rough, sharp = (follow(problem, 1, until=-260.0, rtol=r).at(-250.0) for r in (1e-5, 1e-10))
    for which in Measured:
        (a, ea), (b, eb) = rough.number(which), sharp.number(which)
        assert abs(a - b) <= ea + eb + 1e-11 * max(1.0, abs(b)), which.name


def test_a_tolerance_out_of_reach_is_reported() -> None:
    """With few elements allowed, points do not meet the tolerance, and say so."""

    problem = Problem(15.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("rodwell.analysis.branch.starts.MOST_ELEMENTS_OF_BRANCH", 60)
        branch = follow(problem, 1, until=-300.0)
    assert branch.reached_end
    assert not branch.converged
    worst = branch[-1]
    assert not worst.converged
    exact = follow(problem, 1, until=-300.0)[-1]
    gap = abs(worst.highest_pressure[0] - exact.highest_pressure[0])
    assert gap <= worst.highest_pressure[1]


def test_branch_at_a_force() -> None:
    branch = follow(Problem(15.0), 1, until=-200.0)
    state = branch.at(-150.0)
    assert isinstance(state, Solution)
    assert state.force == -150.0
    assert state.converged
    with pytest.raises(InputError, match=r"force = -300.0.*covers -200 to -111"):
        branch.at(-300.0)


def test_inclined_branch_keeps_no_symmetry_and_vertical_has_no_torque() -> None:
    inclined = follow(Problem(40.0, alpha=60.0), 1, until=-200.0)[-1]
    y = inclined.fields(101)["y"]
    assert np.max(np.abs(y - y[::-1])) > 0.05 * np.max(np.abs(y))
    assert np.max(np.abs(y + y[::-1])) > 0.05 * np.max(np.abs(y))
    vertical = follow(Problem(100.0, alpha=0.0), 1, until=-60.0)[-1]
    assert np.max(np.abs(vertical.fields()["T2"])) == 0.0


def test_on_top_the_index_of_the_branch_counts_the_ways_to_fall() -> None:
    branch = follow(Problem(65.0, on_top=True), 1, until=500.0)
    assert branch.reached_end
    assert branch.lift_off is None
    assert np.all(branch.numbers(Measured.P_MAX) > 0.0)  # never pressed to the wall from inside


def test_dataset_holds_every_field_with_units_and_equation(fig3c: dict[int, Branch]) -> None:
    from rodwell.quantities.names import FIELDS, SCALARS

    data = fig3c[2].dataset
    for name in (*FIELDS, *SCALARS):
        assert data[name].attrs["units"]
        assert data[name].attrs["equation"].startswith("(")
        assert data[name].attrs["symbol"]
    assert data.sizes["point"] == len(fig3c[2])
    assert np.all(np.isfinite(data["field_error"]))
    assert float(data["force"][-1]) == pytest.approx(-400.0)
    assert list(data["special_kind"].values) == [p.kind for p in fig3c[2].special_points]


def test_solution_is_frozen(fig3c: dict[int, Branch]) -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        fig3c[1][0].problem = Problem(1.0)  # type: ignore[misc]
