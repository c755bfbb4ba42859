"""Loads that the tests of diagrams expect, found once more by shooting, without the engine."""

from __future__ import annotations

import pytest
from shooting import critical, special
from test_diagram import FAR, FIG3C, HEAVIER, special_points

CRITICAL = {
    "mode 1": (-1, -112.0, -110.0),
    "mode 2": (1, -130.0, -120.0),
    "mode 3": (1, -210.0, -200.0),
    "mode 4": (-1, -255.0, -245.0),
}
"""Parity of the mode, and end forces between which it is met."""

GUESSES = {
    ("mode 1", "lift_off"): (-1, -123.17, 0.0328, -1.268),
    ("mode 1", "branch_point"): (-1, -362.63, 0.1303, -2.791),
    ("mode 2", "lift_off"): (1, -136.57, -0.6693, 0.2734),
    ("mode 2", "branch_point"): (1, -164.78, -1.848, 0.6182),
    ("mode 3", "lift_off"): (1, -211.50, 0.2683, 0.1757),
    ("mode 4", "lift_off"): (-1, -252.60, -0.01154, -0.4756),
    ("mode 4", "branch_point"): (-1, -403.73, -0.08517, -2.050),
}
"""Parity of the branch, end force, and ξ₂ and η' in the middle of an even state, η and V of an odd one."""


@pytest.mark.parametrize(("branch", "kind"), GUESSES)
def test_special_points_of_symmetric_branches(branch: str, kind: str) -> None:
    (expected,) = (row for row in special_points(FIG3C[branch]) if row[0] == kind)
    parity, *guess = GUESSES[branch, kind]
    force, index = special(15.0, parity, kind, guess)
    assert force == pytest.approx(expected[1], abs=1e-6)
    assert index == min(expected[2:])


@pytest.mark.parametrize("branch", CRITICAL)
def test_critical_loads(branch: str) -> None:
    assert critical(15.0, *CRITICAL[branch]) == pytest.approx(special_points(FIG3C[branch])[0][1], abs=1e-6)


def test_secondary_branches_start_and_end_on_symmetric_ones() -> None:
    symmetric = {row[1] for branch, _ in GUESSES for row in special_points(FIG3C[branch])}
    assert {row[1] for name in ("secondary 1", "secondary 2") for row in special_points(FIG3C[name])} < symmetric


def test_a_fold_next_to_a_branch_point() -> None:
    guesses = (-206.91, -2.091, 0.8318), (-206.57, -2.4525, 0.8830), (-206.56, -2.484, 0.8880)
    for (kind, force, *index), guess in zip(special_points(HEAVIER), guesses, strict=True):
        found, lower = special(22.0, 1, kind, guess)
        assert found == pytest.approx(force, abs=1e-6)
        assert lower == min(index)


def test_second_branch_point_far_out() -> None:
    assert special(15.0, -1, "branch_point", (-1442.3, 0.27747, 0.17394))[0] == pytest.approx(FAR[1], abs=1e-6)
