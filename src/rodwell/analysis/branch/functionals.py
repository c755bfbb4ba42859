"""Numbers of a state: those that every state is measured by, by name, and any function of a solution, with errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from copy import copy

import numpy as np

from rodwell.analysis.branch.solution import Solution, solution_of
from rodwell.analysis.discrete.measures import Measured, measured
from rodwell.errors import InputError
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter
from rodwell.quantities.value import Value

Functional = Callable[[Solution], float | Value]
Number = Measured | str | Functional
"""A measured number, by its name in the nomenclature, or a function of a solution."""

Numbers = Mapping[str, Number]
"""Numbers by the names that users give them."""


def number_of(solution: Solution, which: Number) -> Value:
    """Return a number of a state with its error estimate: that of a function from its values on both meshes.

    Raises
    ------
    InputError
        If no measured number has that name, or the function does not return a number.
    """
    if not callable(which):
        return solution.number(which)
    result = which(solution)
    if isinstance(result, Value):
        return Value(result.value, result.error)
    fine, coarse = _checked(which, result), _checked(which, which(on_one_mesh(solution, *solution.levels[0])))
    return Value(fine, float(estimated_error(fine, coarse)))


def value_of(solution: Solution, which: Number) -> float:
    """The same number without its error, which would take a function's value on the coarser mesh too."""
    return _checked(which, which(solution)) if callable(which) else solution.number(which).value


def value_on(
    problem: Problem, parameter: Parameter, meshes: TwoMeshes, which: Number
) -> Callable[[Family, State], float]:
    """The same number, without its error, as a function of the equations and a state on one mesh."""
    if not callable(which):
        place = measured(which)
        return lambda family, state: float(meshes.measure(family, state)[0][place])

    def value(family: Family, state: State) -> float:
        whole = solution_of(problem, parameter, MeshedState(state, state, np.empty(0), np.empty(0), 0.0), meshes)
        return _checked(which, which(on_one_mesh(whole, family, state)))

    return value


def on_one_mesh(solution: Solution, family: Family, state: State) -> Solution:
    """A state of one of both meshes as a solution of its own: its fine mesh is that one, and its errors are none."""
    meshes = copy(solution.meshes)
    meshes.coarse = meshes.fine = family
    values = meshes.measure(family, state)[0]
    return Solution(solution.problem, MeshedState(state, state, values, np.zeros_like(values), 0.0), meshes)


def _checked(which: Functional, result: object) -> float:
    """The value of a function as a number; NaN is allowed: the function is not defined there."""
    value = result.value if isinstance(result, Value) else result
    if isinstance(value, bool | np.bool_) or not hasattr(value, "__float__"):
        name = getattr(which, "__name__", "function")
        raise InputError(name, value, "must return a number, or a Value, for a solution")
    return float(value)


def checked_numbers(field: str, numbers: Numbers | None) -> dict[str, Number]:
    """Return numbers by name as a dictionary, or raise if they are none, or a name is that of a special point."""
    found = dict(numbers or {})
    for name, which in found.items():
        if not isinstance(name, str) or not name or name in RESERVED:
            reason = f"must be a text of its own, none of {', '.join(RESERVED)}"
            raise InputError(field, name, reason)
        if not callable(which):
            measured(which)
    return found


RESERVED = ("critical", "lift_off", "touch_down", "branch_point", "fold", "equal_energy", "uncertain", "end")
"""Kinds of special points that are there already."""


def changes_sign(before: float, after: float) -> bool:
    """Whether a continuous function has a zero between two places, or at the second."""
    if math.isnan(before) or math.isnan(after) or before == 0.0:
        return False
    return after == 0.0 or (before < 0.0) != (after < 0.0)
