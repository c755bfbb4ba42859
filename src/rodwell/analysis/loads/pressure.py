"""How the contact pressure at given places changes along equilibria, as one parameter varies and the others stay."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.starts import at_state
from rodwell.analysis.discrete.measures import shape
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.strand import towards_lift_off

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
    here = solution.value_of(parameter)
    size = 1.0 if parameter in ("alpha", "twist") else abs(here) or 1.0
    step = STEPS[parameter] * size
    meshes, point = at_state(solution.problem, solution, parameter, here + size, solution.meshes.rtol)
    at = np.array(places)

    def rate(family: Family, state: State, h: float) -> np.ndarray:
        direction = state.tangent / state.tangent_lam
        p = {k: _pressure(family, state, state.c + k * h * direction, state.lam + k * h, at) for k in (-2, -1, 1, 2)}
        return np.asarray((8.0 * (p[1] - p[-1]) - (p[2] - p[-2])) / (12.0 * h))

    fine = rate(meshes.fine, point.fine, step)
    errors = estimated_error(fine, rate(meshes.coarse, point.coarse, step))
    errors = errors + np.abs(rate(meshes.fine, point.fine, 2.0 * step) - fine)
    return tuple(map(float, fine)), tuple(map(float, errors))


def _pressure(family: Family, state: State, c: np.ndarray, lam: float, places: np.ndarray) -> np.ndarray:
    u = shape(family, state, places, 4, c)
    return np.asarray(towards_lift_off(places, u[0], u[1], u[2], u[3], family.parameters(lam)))
