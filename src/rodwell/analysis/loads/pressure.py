"""How the contact pressure at given places changes along equilibria, as one parameter varies and the others stay."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.starts import at_state
from rodwell.analysis.discrete.family import IN_CURVED_HOLE, WHERE_CLEARANCE_VARIES, given_in_kernels, in_other_hole
from rodwell.analysis.discrete.moved_sections import moved_section
from rodwell.analysis.straight.lying_slopes import beside as changed
from rodwell.analysis.straight.lying_slopes import step_in
from rodwell.numerics.equilibria.differences import central_slope
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines import banded
from rodwell.problem.problem import Problem
from rodwell.problem.rod import Rod
from rodwell.problem.sections import COLUMNS
from rodwell.quantities.arrays import FloatArray

STEPS = {"force": 1e-3, "weight": 1e-4, "alpha": 1e-3, "clearance": 1e-4, "twist": 1e-4}
"""Half the step of the central differences of the pressure, which is a formula: the states themselves move along
tangents. Of α in degrees, of T₁ in B/L, of the others relative."""


Rates = tuple[tuple[float, ...], tuple[float, ...]]
"""Rates of the pressure at places, and the estimates of their errors: from the two meshes and from twice the step."""


def pressure_rates(solution: Solution, places: tuple[float, ...], parameter: str) -> Rates:
    """dp/dλ along equilibria at given places, for a parameter λ of ``families.PATHS``, the others constant.

    p carries the sign that makes contact negative. In a curved hole λ may also be its curvature, "build".
    """
    known = WHERE_CLEARANCE_VARIES if solution.problem.ramps else IN_CURVED_HOLE
    if (solution.problem.hole is not None or solution.problem.ramps) and parameter not in known:
        return _hole_rates(solution, places, parameter)
    here = solution.value_of(parameter)
    size = 1.0 if parameter in ("alpha", "twist") else abs(here) or 1.0
    step = STEPS[parameter] * size
    meshes, point = at_state(solution.problem, solution, parameter, here, here + size, solution.meshes.rtol)
    at = np.array(places)

    def rate(family: Family, state: State, h: float) -> FloatArray:
        direction = state.tangent / state.tangent_lam
        return central_slope(lambda x: _pressure(family, state, at, x * direction, x), h)

    return _with_errors(rate, ((meshes.coarse, point.coarse), (meshes.fine, point.fine)), step)


def _with_errors(
    rate: Callable[[Family, State, float], FloatArray], levels: tuple[tuple[Family, State], ...], step: float
) -> Rates:
    """Rates on the finer of two meshes, and what is left of their errors."""
    coarse, fine = (rate(*level, step) for level in levels)
    errors = estimated_error(fine, coarse) + np.abs(rate(*levels[1], 2.0 * step) - fine)
    return tuple(map(float, fine)), tuple(map(float, errors))


def _pressure(family: Family, state: State, places: FloatArray, more: FloatArray, further: float) -> FloatArray:
    """Contact pressure (m,), negative in contact, at the coefficients and the parameter of a state and more of both."""
    u = state.space.evaluate(state.c + more, places, 4)
    given = None if family.given is None else family.given(places).T
    return np.asarray(family.model.observed(places, u, given, family.parameters(state.lam + further)))


Slope = Callable[[Callable[[float], FloatArray], float], FloatArray]
"""A derivative at 0 by differences with a step."""


def _moved_rates(
    solution: Solution,
    places: tuple[float, ...],
    beside: Callable[[Family, float], Family],
    step: float,
    span: float,
    slope: Slope = central_slope,
) -> Rates:
    """dp/dq along equilibria at a constant load: states move along δc = −H⁻¹ ∂g/∂q.

    ``beside`` gives the equations with q changed by a step; ``span`` is that of the differences of the gradient g.
    """
    at = np.array(places)

    def direction(family: Family, state: State) -> FloatArray:
        return _moved(family, state, slope(lambda x: beside(family, x).assemble(state.c, state.lam)[1], span))

    directions = {state.c.size: direction(family, state) for family, state in solution.levels}

    def rate(family: Family, state: State, h: float) -> FloatArray:
        moving = directions[state.c.size]
        return central_slope(lambda x: _pressure(beside(family, x), state, at, x * moving, 0.0), h)

    return _with_errors(rate, solution.levels, step)


def _moved(family: Family, state: State, gradient: FloatArray) -> FloatArray:
    """How a state moves (n,) as its gradient would become that, to first order: by −H⁻¹ of it."""
    factors = family.held.free_part(family.assemble(state.c, state.lam)[2])
    banded.factorise(factors)
    moved = -family.held.gather(gradient)
    banded.solve(factors, moved)
    return family.held.spread(moved)


def _linear_slope(function: Callable[[float], FloatArray], h: float) -> FloatArray:
    return np.asarray((function(h) - function(-h)) / (2.0 * h))


def _hole_rates(solution: Solution, places: tuple[float, ...], parameter: str) -> Rates:
    """The same for an input that changes the curved hole beside the rod."""
    problem = solution.problem

    def beside(family: Family, step: float) -> Family:
        return in_other_hole(family, changed(problem, parameter, step), 0.0)

    step = 0.2 * step_in(problem, parameter)
    return _moved_rates(solution, places, beside, step, step)


SECTION_RATIOS = ("stiffness", "weight")
"""Ratios of a section on which states depend."""

SECTION_STEP = 1e-4
"""Half the step in a ratio, relative, of the differences of the pressure."""

GRADIENT_STEP = 0.25
"""The same of the gradient, which is linear in both ratios."""


def section_pressure_rates(solution: Solution, places: tuple[float, ...], number: int, ratio: str) -> Rates:
    """dp/dq along equilibria at a constant load, for a ratio q of section ``number`` (from 0), or a factor on a taper.

    Returned as by :func:`pressure_rates`.
    """
    problem = solution.problem
    size = ratio_size(problem, number, ratio)

    moved = None if problem.hole is None else moved_section(problem, number, ratio)

    def beside(family: Family, step: float) -> Family:
        given = given_in_kernels(_other_rod(problem, number, ratio, step)) if moved is None else moved(step)
        return replace(family, given=given)

    return _moved_rates(solution, places, beside, SECTION_STEP * size, GRADIENT_STEP * size, _linear_slope)


def ratio_size(problem: Problem, number: int, ratio: str) -> float:
    """The size in which a change of a ratio of section ``number`` (from 0) is measured; of a taper, by a factor."""
    given = problem.sections[number][COLUMNS.index(ratio)]
    return 1.0 if isinstance(given, tuple) else given or 1.0


def _other_rod(problem: Problem, number: int, ratio: str, step: float) -> Rod:
    """The string with a ratio of section ``number`` (from 0) moved by a step, of a taper by a factor 1 + step.

    It is not checked: a weight may be below zero.
    """
    sections = list(problem.sections)
    length, stiffness, weight, clearance, twisting = sections[number]
    given = stiffness if ratio == "stiffness" else weight
    moved = tuple(one * (1.0 + step) for one in given) if isinstance(given, tuple) else given + step
    pair = (moved, weight) if ratio == "stiffness" else (stiffness, moved)
    sections[number] = (length, *pair, clearance, twisting)
    return Rod(tuple(sections))


def pressure_elsewhere(solution: Solution, places: tuple[float, ...], problem: Problem) -> FloatArray:
    """Pressure (m,) at places in the hole of another problem nearby at the same load, to first order in what differs.

    The state moves by −H⁻¹ of the gradient that it has in that hole.
    """
    family, state = solution.levels[1]
    other = in_other_hole(family, problem, 0.0)
    moved = _moved(family, state, other.assemble(state.c, state.lam)[1])
    return _pressure(other, state, np.array(places), moved, 0.0)
