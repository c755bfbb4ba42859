"""Loads of the straight rod without the wall, and of its touch where nothing presses it there."""

from __future__ import annotations

import numpy as np

from rodwell import Problem, WallTouch, loads_without_wall


def free(problem: Problem, count: int = 1) -> np.ndarray:
    return loads_without_wall(problem, count).forces


def touch_of(problem: Problem) -> WallTouch:
    touch = loads_without_wall(problem).at_wall
    assert touch is not None
    return touch
