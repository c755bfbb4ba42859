"""Round-off in what is given: beyond what a load itself moves, nothing moves by more than the estimate of its error."""

from __future__ import annotations

import numpy as np
import pytest

from rodwell import Problem, follow

ROUGH = {
    "folds, clamped": (Problem(15.0, 89.0), 1, -500.0),
    "folds, twisted, unequal ends": (Problem(0.9, 90.0, clearance=0.012, twist=-3.7, ends="pinned-guided"), 2, -33.0),
    "lift-off, free end": (Problem(30.7, 44.1, clearance=0.019, ends="free-clamped"), 1, -40.0),
    "branch points, equal cells": (Problem(26.31, 90.0, clearance=0.01377, ends="pinned-pinned"), 2, -158.0),
}


@pytest.mark.parametrize(("problem", "mode", "until"), ROUGH.values(), ids=ROUGH)
def test_a_hair_of_weight_moves_nothing_by_more_than_its_error(problem: Problem, mode: int, until: float) -> None:
    """In weights that differ by 1e-12 of themselves, loads are a straight line but for their errors."""
    steps = np.arange(-2.0, 3.0)
    weights = [problem.weight * (1.0 + 1e-12 * step) for step in steps]
    found = [follow(problem.but(weight=weight), mode, until=until).special_points for weight in weights]
    assert len({tuple(point.kind for point in points) for points in found}) == 1
    for points in zip(*found, strict=True):
        forces = np.array([point.force - points[2].force for point in points])
        beside = forces - np.polyval(np.polyfit(steps, forces, 1), steps)
        assert np.max(np.abs(beside)) <= points[2].error
