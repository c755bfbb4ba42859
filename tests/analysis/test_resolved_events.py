"""Loads of events whose watched number is known only roughly: against that of the number itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rodwell import Problem, load_path
from rodwell.analysis.off_wall.following import followed
from rodwell.analysis.off_wall.happening import PathEvent
from rodwell.analysis.off_wall.resolve import resolved_event
from rodwell.numerics.stretches.newton import Solved


@pytest.fixture(scope="module")
def opening() -> PathEvent:
    """The gap that opens at −124.1911865 at weight 15."""
    before = load_path(Problem(15.0), until=-124.0, unload_to=-123.9, seeds=1).legs[0].runs[0][-1]
    path = followed(before, -124.3)
    return next(event for event in path.events if event.kind == "gap_opens")


def _rough(value: Callable[[Solved], float], size: float, seed: int) -> Callable[[Solved], float]:
    """The number with noise of a size that any change of the state draws anew."""

    def number(state: Solved) -> float:
        there = value(state)
        bits = int(np.float64(there).view(np.int64)) & 0xFFFFFFFF
        return there + size * float(np.random.default_rng([seed, bits]).uniform(-1.0, 1.0))

    return number


def test_the_load_of_an_event_is_as_good_as_it_says_where_the_number_that_vanishes_there_is_rough(
    opening: PathEvent,
) -> None:
    assert opening.value is not None
    assert opening.between is not None
    true = resolved_event(opening, 1e-9).load
    before, after = opening.between
    slope = (opening.value(after.solved) - opening.value(before.solved)) / (after.load - before.load)
    size = 1e-9 * abs(slope * true.value)
    for seed in range(12):
        found = resolved_event(replace(opening, value=_rough(opening.value, size, seed)), 1e-7)
        assert abs(found.load.value - true.value) <= found.load.error + true.error, seed
        assert found.load.error < 1e-8 * abs(true.value)
