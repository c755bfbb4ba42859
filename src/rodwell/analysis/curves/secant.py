"""Zeros of a function of equilibria near one of them, by the secant method in arclength."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.quantities.arrays import FloatArray

PROBE, SETTLED, FARTHEST, MOST_SECANTS = 1e-5, 1e-9, 0.1, 30
"""First step, last step (the error left is about its square) and longest step of the secant method, in the metric."""

Function = Callable[[Family, State], float]


class CurveLostError(RuntimeError):
    """A point of the curve could not be found."""


def zero_at(family: Family, c: FloatArray, lam: float, near: State | None, function: Function) -> State:
    """Zero of a function of the equilibria of a family, by the secant method in arclength from ``(c, λ)``.

    It begins on the hyperplane normal to the tangent of ``near``, so it works where the equilibria fold too; without
    such a state, at λ.
    """
    if near is None or near.space is not family.space:
        outcome, state, _ = family.at(c, lam)
    else:
        outcome, state, _ = family.correct(c, lam, near.row, near.row_lam, float(near.row @ c) + near.row_lam * lam)
    if state is None:
        raise CurveLostError(family.advice(outcome))
    return zero_from(family, state, function)


def zero_from(family: Family, state: State, function: Function) -> State:
    """Zero of a function of the equilibria of a family, by the secant method in arclength from one of them."""
    value, step = function(family, state), PROBE
    for _ in range(MOST_SECANTS):
        new = family.step(state, step)
        if new is None:
            raise CurveLostError("a state near the curve could not be solved")
        if abs(step) <= SETTLED:
            return new
        f = function(family, new)
        if f == value:
            raise CurveLostError("the function does not change along the line")
        state, value, step = new, f, float(np.clip(-f * step / (f - value), -FARTHEST, FARTHEST))
    raise CurveLostError("the secant method did not settle")
