"""How the contact pressure at given places changes along equilibria, as one parameter varies and the others stay."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.starts import at_state
from rodwell.analysis.discrete.family import given_in_kernels
from rodwell.analysis.discrete.measures import shape
from rodwell.analysis.state.fields import pressure_at
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines import banded
from rodwell.problem.problem import Problem
from rodwell.problem.rod import Rod
from rodwell.problem.sections import COLUMNS

STEPS = {"force": 1e-3, "weight": 1e-4, "alpha": 1e-3, "clearance": 1e-4, "twist": 1e-4}
"""Half the step of the central differences of the pressure, which is a formula: the states themselves move along
tangents. Of α in degrees, of T₁ in B/L, of the others relative."""


def pressure_rates(
    solution: Solution, places: tuple[float, ...], parameter: str
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """dp/dλ along equilibria at given places, for a parameter λ of ``families.PATHS``, the others constant.

    p carries the sign that makes contact negative. Returns the rates and the estimates of their errors: from the two
    meshes and from twice the step.
    """
    solution.problem.refuse_curved("rates of the contact pressure are computed")
    here = solution.value_of(parameter)
    size = 1.0 if parameter in ("alpha", "twist") else abs(here) or 1.0
    step = STEPS[parameter] * size
    meshes, point = at_state(solution.problem, solution, parameter, here, here + size, solution.meshes.rtol)
    at = np.array(places)

    def rate(family: Family, state: State, h: float) -> np.ndarray:
        direction = state.tangent / state.tangent_lam
        p = {
            k: _pressure(solution.problem, family, state, state.c + k * h * direction, state.lam + k * h, at)
            for k in (-2, -1, 1, 2)
        }
        return np.asarray((8.0 * (p[1] - p[-1]) - (p[2] - p[-2])) / (12.0 * h))

    fine = rate(meshes.fine, point.fine, step)
    errors = estimated_error(fine, rate(meshes.coarse, point.coarse, step))
    errors = errors + np.abs(rate(meshes.fine, point.fine, 2.0 * step) - fine)
    return tuple(map(float, fine)), tuple(map(float, errors))


def _pressure(
    problem: Problem, family: Family, state: State, c: np.ndarray, lam: float, places: np.ndarray
) -> np.ndarray:
    sense = -1.0 if problem.outside else 1.0
    return sense * pressure_at(problem.rod, family.parameters(lam), places, shape(family, state, places, 4, c))


SECTION_RATIOS = ("stiffness", "weight")
"""Ratios of a section on which states depend."""

SECTION_STEP = 1e-4
"""Half the step in a ratio, relative, of the differences of the pressure."""


def section_pressure_rates(
    solution: Solution, places: tuple[float, ...], number: int, ratio: str
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """dp/dq along equilibria at a constant load, for a ratio q of section ``number`` (from 0), or a factor on a taper.

    Returned as by :func:`pressure_rates`. States move along δc = −H⁻¹ ∂g/∂q.
    """
    problem, at = solution.problem, np.array(places)
    given = problem.sections[number][COLUMNS.index(ratio)]
    size = 1.0 if isinstance(given, tuple) else given or 1.0

    def changed(step: float) -> Rod:
        sections = list(problem.sections)
        length, stiffness, weight, clearance, twisting = sections[number]
        moved = tuple(one * (1.0 + step) for one in given) if isinstance(given, tuple) else given + step
        pair = (moved, weight) if ratio == "stiffness" else (stiffness, moved)
        sections[number] = (length, *pair, clearance, twisting)
        return Rod(tuple(sections))  # not checked: a weight may be below zero by the step

    def rate(family: Family, state: State, h: float) -> np.ndarray:
        factors = family.held.free_part(family.assemble(state.c, state.lam)[2])
        banded.factorise(factors)
        half = 0.5 * size
        low, high = (  # the gradient is linear in both ratios
            replace(family, given=given_in_kernels(changed(step))).assemble(state.c, state.lam)[1]
            for step in (-half, half)
        )
        moved = family.held.gather(low - high) / size
        banded.solve(factors, moved)
        direction, parameters = family.held.spread(moved), family.parameters(state.lam)
        p = {
            k: pressure_at(changed(k * h), parameters, at, shape(family, state, at, 4, state.c + k * h * direction))
            for k in (-2, -1, 1, 2)
        }
        return np.asarray((8.0 * (p[1] - p[-1]) - (p[2] - p[-2])) / (12.0 * h))

    sense, h = -1.0 if problem.outside else 1.0, SECTION_STEP * size
    (coarse, fine) = (rate(*level, h) for level in solution.levels)
    errors = estimated_error(fine, coarse) + np.abs(rate(*solution.levels[1], 2.0 * h) - fine)
    return tuple(map(float, sense * fine)), tuple(map(float, errors))
