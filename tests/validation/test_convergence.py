"""Observed orders of convergence of the spline discretisation, against theory."""

from __future__ import annotations

import numpy as np
import pytest

import rodwell
from rodwell import Problem, critical_loads
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete.family import family as equilibria
from rodwell.analysis.discrete.family import spline_ends
from rodwell.analysis.discrete.measures import Measured
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.physics.on_wall.strand import contact_pressure

PROBLEM, FORCE = Problem(40.0, alpha=60.0, twist=0.5), -190.0
PLACES = np.linspace(0.0, 1.0, 4001)


def solve(elements: int, degree: int, start: tuple[SplineSpace, np.ndarray]) -> tuple[Family, State]:
    """The state at FORCE on a uniform mesh, from a state known on another space."""
    space = SplineSpace(np.linspace(0.0, 1.0, elements + 1), degree)
    family = equilibria(PROBLEM, space, parity=0, wavenumber=8.0, scale=50.0)
    other, c = start
    _, state, _ = family.at(space.project(other.evaluate(c, space.points, 1)[0], spline_ends(PROBLEM)), FORCE)
    assert state is not None
    return family, state


@pytest.fixture(scope="module")
def exact() -> tuple[SplineSpace, np.ndarray, np.ndarray, np.ndarray]:
    """A reference of much higher resolution: space, coefficients, y″ and p at PLACES."""
    from rodwell import follow

    state: Solution = follow(PROBLEM, 1, until=FORCE, rtol=1e-9)[-1]
    space, c = state.point.fine.space, state.point.fine.c
    family, fine = solve(200, 10, (space, c))
    u = fine.space.evaluate(fine.c, PLACES, 4)
    return fine.space, fine.c, u[2], contact_pressure(PLACES, *u, family.parameters(FORCE))


@pytest.mark.parametrize("degree", [4, 5, 6])
def test_order_in_h2_and_in_the_contact_pressure(degree: int, exact: tuple[np.ndarray, ...]) -> None:
    """‖y − y_h‖ in H² falls like h^(p−1), the largest error of p (three derivatives) like h^(p−2)."""
    space, c, bend, pressure = exact
    h2, p_error = [], []
    meshes = np.array([112, 134, 160])
    for elements in meshes:
        family, state = solve(int(elements), degree, (space, c))
        u = state.space.evaluate(state.c, PLACES, 4)
        h2.append(np.sqrt(np.trapezoid((u[2] - bend) ** 2, PLACES)))
        p = contact_pressure(PLACES, *u, family.parameters(FORCE))
        p_error.append(np.sqrt(np.trapezoid((p - pressure) ** 2, PLACES)))
    order = [-np.polyfit(np.log(meshes), np.log(error), 1)[0] for error in (h2, p_error)]
    assert order[0] == pytest.approx(degree - 1, abs=0.2)
    assert order[1] == pytest.approx(degree - 2, abs=0.2)


@pytest.mark.parametrize("degree", [4, 5])
def test_order_of_critical_loads(degree: int) -> None:
    """Eigenvalues converge like h^(2(p−1))."""
    from rodwell.analysis.straight import kept

    reference = critical_loads(PROBLEM, 1, rtol=1e-11)[0].force
    errors, meshes = [], np.array([32, 38, 44])
    for elements in meshes:
        space = SplineSpace(np.linspace(0.0, 1.0, int(elements) + 1), degree)
        values, _ = kept.loads_on_mesh(PROBLEM, space, 1, None)
        errors.append(abs(-values[0] - reference))
    order = -np.polyfit(np.log(meshes), np.log(errors), 1)[0]
    assert order == pytest.approx(2 * (degree - 1), abs=0.2)


PMAX = 275.373261479445
"""Largest pressure of the state below, by collocation in extended precision (benchmarks/campaigns/extended.py)."""


def test_errors_cover_the_round_off_of_fine_meshes() -> None:
    """AUTO-07p has 275.3732615 for the largest pressure, a second method more digits."""
    state = rodwell.follow(rodwell.Problem(15.0), until=-400.0, rtol=1e-10)[-1]
    value, error = state.number(Measured.P_MAX)
    assert abs(value - PMAX) <= error
    assert error <= 1e-10 * value
