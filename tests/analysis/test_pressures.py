"""The contact pressure from the balance of forces, against that from the third derivative of the spline."""

from __future__ import annotations

import numpy as np
import pytest

import rodwell
from rodwell import Problem
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.measures import Measured, balanced_pressures

PLACES = np.linspace(0.0, 1.0, 41)


def both(state: Solution) -> tuple[np.ndarray, np.ndarray]:
    family, fine = state.levels[1]
    parameters = family.parameters(fine.lam)
    balanced = balanced_pressures(family, fine, parameters, PLACES)
    side = -1.0 if state.problem.outside else 1.0
    return balanced, side * state.fields(PLACES)["contact_pressure"]


@pytest.mark.parametrize(
    ("problem", "until"),
    [
        (Problem(15.0, 70.0, twist=0.8), -300.0),
        (Problem(15.0, 70.0, ends="pinned-pinned", twist=0.8), -300.0),
        (Problem(15.0, 70.0, ends="clamped-pinned"), -300.0),
        (Problem(15.0, 70.0, ends="pinned-guided"), -200.0),
        (Problem(15.0, 70.0, ends="free-free"), -200.0),
        (Problem(15.0, 70.0, ends="free-clamped"), -200.0),
        (Problem(15.0, outside=True, on_top=True), -60.0),
    ],
    ids=str,
)
def test_balance_and_third_derivative_agree(problem: Problem, until: float) -> None:
    balanced, direct = both(rodwell.follow(problem, until=until)[-1])
    np.testing.assert_allclose(balanced, direct, atol=2e-7 * np.max(np.abs(direct)))


def test_coils() -> None:
    balanced, direct = both(rodwell.coil(Problem(15.0, turns=2, clearance=0.02), start=-1200.0)[-1])
    np.testing.assert_allclose(balanced, direct, atol=2e-7 * np.max(np.abs(direct)))


@pytest.mark.parametrize("ends", ["clamped-pinned", "free-clamped"])
def test_no_moment_where_an_end_turns(ends: str) -> None:
    state = rodwell.follow(Problem(15.0, 70.0, ends=ends), until=-200.0)[-1]
    free, held = (0, 1) if ends.startswith("free") else (1, 0)
    assert state.number(Measured.OMEGA2_0 + free).value == 0.0
    assert abs(state.number(Measured.OMEGA2_0 + held).value) > 0.1
