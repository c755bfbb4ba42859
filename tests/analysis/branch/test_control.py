"""Branches under controlled shortening and rotation."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigvalsh, null_space

from rodwell import Branch, InputError, Problem, Solution, follow
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines import assembly


@pytest.fixture(scope="module")
def branch() -> Branch:
    return follow(Problem(15.0, 89.0), until=-500.0)


def dense(family: Family, state: State) -> tuple[np.ndarray, np.ndarray]:
    """Hessian of the free coefficients as a full matrix, and the derivative of the gradient by the load."""
    size, width = family.space.size, family.space.degree + 1
    gradient, mixed, band = np.empty(size), np.empty(size), np.empty((size, width))
    at = family.parameters(state.lam), family.rates(state.lam)
    assembly.assemble(family.mesh, state.c, *at, gradient, mixed, band)
    full = np.zeros((size, size))
    for k in range(width):
        full += np.diag(band[: size - k, k], k) + (np.diag(band[: size - k, k], -k) if k else 0.0)
    free = family.held.free
    return full[np.ix_(free, free)], mixed[free]


def counted(state: Solution) -> int:
    """The index by a second method: eigenvalues on the subspace that keeps the shortening."""
    hessian, row = dense(*state.levels[0])
    basis = null_space(row[None])
    return int(np.count_nonzero(eigvalsh(basis.T @ hessian @ basis) < 0.0))


def test_the_index_is_that_of_the_second_variation_with_the_shortening_held(branch: Branch) -> None:
    index = branch.under("shortening").stability_index
    for i in range(1, len(branch), 7):
        assert index[i] == counted(branch[i])
    assert not np.array_equal(index, branch.stability_index)


def test_what_is_unstable_under_a_dead_load_may_be_stable_under_control(branch: Branch) -> None:
    """Between its folds in the load the branch has index 1; its shortening goes on growing on part of the way."""
    held = branch.under("shortening")
    assert np.any((branch.stability_index == 1) & (held.stability_index == 0))
    assert np.all(held.stability_index <= branch.stability_index)
    assert np.all(held.stability_index >= branch.stability_index - 1)


def test_folds_are_where_the_shortening_turns_back(branch: Branch) -> None:
    held = branch.under("shortening")
    turns = np.flatnonzero(np.diff(np.sign(np.diff(held.values[1:]))))
    assert len(held.folds) == len(turns)
    for fold, turn in zip(held.folds, turns, strict=True):
        near = held.values[turn : turn + 4]
        value = fold.solution.number("end_shortening").value
        assert near.min() - 1e-4 <= value <= near.max() + 1e-4
        assert value >= near.max() or value <= near.min()
        assert abs(fold.index_after - fold.index_before) == 1


def test_all_states_at_a_shortening(branch: Branch) -> None:
    held = branch.under("shortening")
    value = float(0.5 * (held.values.max() + held.values[1]))
    states = held.states_at(value)
    crossings = np.count_nonzero(np.diff(np.sign(held.values - value)))
    assert len(states) == crossings > 0
    for state in states:
        assert state.number("end_shortening").value == pytest.approx(value, abs=1e-13)
    assert held.states_at(1.0) == ()
    assert held.states_at(float(held.values[5])) == (branch[5],) or len(held.states_at(float(held.values[5]))) > 1


def test_rotation_of_the_end() -> None:
    """dR/dT₁ of a buckled rod that no longer turns back: the rotation grows with the torque, so nothing changes."""
    start = follow(Problem(30.0, 60.0))[-1]
    branch = follow(start.problem, start=start, parameter="twist", until=3.0)
    held = branch.under("rotation")
    growth = np.diff(held.values) / np.diff(branch.values)
    assert np.all(growth > 0.0)
    assert np.array_equal(held.stability_index, branch.stability_index)
    assert held.folds == ()
    assert np.all(held.errors < 1e-7)


def test_the_index_with_the_rotation_held_by_a_second_method() -> None:
    """The rod's own twist as one unknown more: C θ²/2, with θ − a(c) held, where T₁ works on θ − a(c)."""
    start = follow(Problem(15.0, 90.0), until=-400.0)[-1]
    branch = follow(start.problem, start=start, parameter="twist", until=12.0)
    held = branch.under("rotation")
    for i in range(1, len(branch), 5):
        hessian, row = dense(*branch[i].levels[0])
        size, stiffness = row.size, branch.problem.torsional_stiffness
        whole = np.zeros((size + 1, size + 1))
        whole[:size, :size], whole[size, size] = hessian, stiffness
        basis = null_space(np.append(-row, 1.0)[None])
        assert held.stability_index[i] == np.count_nonzero(eigvalsh(basis.T @ whole @ basis) < 0.0)


def test_what_cannot_be_controlled(branch: Branch) -> None:
    with pytest.raises(InputError, match="did you mean 'shortening'"):
        branch.under("shorten")
    with pytest.raises(InputError, match="needs a branch in twist"):
        branch.under("rotation")
