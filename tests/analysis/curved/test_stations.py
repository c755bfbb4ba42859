"""A hole known at stations, where the second derivative of its curvature jumps: meshes that break there.

The second method knows no spline: from the exact curvature of the hole between stations the equation of the straight
rod's second variation is integrated from station to station (Runge and Kutta), and its determinant made zero.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rodwell import Problem, Survey, critical_loads, equilibrium
from rodwell.analysis.discrete import curved
from rodwell.analysis.state.in_hole import InHole
from rodwell.analysis.straight.lying import lying_contact
from rodwell.analysis.straight.lying_pencil import Pencil
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray
from rodwell.survey.path import path_of_survey

D = 0.01
WELL = Survey.of([0.0, 38.0, 100.0], [83.0, 86.0, 86.0])
"""A build of 3 degrees along the upper 38 % of the rod, straight below: the curvature vanishes at the station."""


STRING = ((0.3, 1.0, 1.0), (0.4, 0.4, 0.6), (0.3, 2.0, 1.5))
"""Sections in that well: length, stiffness, weight."""


def rod(weight: float = 15.0, survey: Survey = WELL, sections: tuple[tuple[float, ...], ...] = ()) -> Problem:
    axis = path_of_survey(survey).piece(0.0, 100.0).axis
    return Problem(weight, clearance=D, axis=axis, sections=sections)  # type: ignore[arg-type]


def rod_at(problem: Problem, s: float) -> tuple[float, float]:
    """Stiffness and weight at a place, as ratios."""
    for length, stiffness, weight, *_ in problem.sections:
        if s < length:
            return float(stiffness), float(weight)  # type: ignore[arg-type]
        s -= length
    return 1.0, 1.0


def between(problem: Problem) -> list[tuple[float, float, Chebyshev, Chebyshev, Chebyshev]]:
    """Each stretch between stations and steps: ends, slope ψ, curvature κᵣ and height as polynomials in s."""
    assert problem.hole is not None
    ends = np.union1d(curved.stations_along(problem), [0.0, *np.cumsum([x[0] for x in problem.sections]), 1.0])
    out = []
    for low, high in itertools.pairwise(ends):
        s = 0.5 * (low + high) - 0.5 * (high - low) * np.cos(np.pi * np.arange(25) / 24)
        (k1, _), frames, points = (
            part.T for part in problem.hole.at(np.clip(curved.undeformed_place(problem, s), 0.0, 1.0))
        )
        slope = np.arcsin(frames[2, 2])
        height = points[2] - D * frames[2, 0]
        of_s = [Chebyshev.fit(s, values, 24, domain=[low, high]) for values in (slope, k1 / (1.0 + D * k1), height)]
        out.append((low, high, *of_s))
    return out


def determinant(force: float, problem: Problem) -> float:
    """Zero where (b v″)″ − (A v′)′ + (P/Δ) v = 0 has a solution that is clamped at both ends.

    Balance of the rod in the plane: tension N − bκᵣ² with N′ = q w ψ-rise + b κᵣκᵣ′ and N(1) = F, see the page on
    curved holes, and shear bκᵣ′; so P = q w cos ψ − κᵣ(N − bκᵣ²) + bκᵣ″, and A = N − 2bκᵣ². At a step of b the wall's
    couple −[b]κᵣ and force [b]κᵣ′ are part of that contact: b v″ jumps by −[b]κᵣv/Δ, the shear by [b](κᵣv′ − κᵣ′v)/Δ.
    """
    stretches, drive, drives = between(problem), force, []
    for low, high, _, curvature, height in stretches[::-1]:
        b, q = rod_at(problem, 0.5 * (low + high))
        along = q * problem.weight * height + 0.5 * b * curvature**2
        drives.append(along - along(high) + drive)
        drive = drives[-1](low)
    states, before = np.zeros((4, 2)), None
    states[2, 0] = states[3, 1] = 1.0
    for (low, high, slope, curvature, _), tension in zip(stretches, drives[::-1], strict=True):
        b, q = rod_at(problem, 0.5 * (low + high))
        first, bend = curvature.deriv(), curvature.deriv(2)
        if before is not None:
            step, (v, v1, *_) = (b - before) / D, states.copy()
            states[2] -= step * curvature(low) * v
            states[3] += step * (curvature(low) * v1 - first(low) * v)
        before = b

        def rate(  # type: ignore[no-untyped-def]
            s: float, flat: FloatArray, c=curvature, n=tension, psi=slope, k2=bend, b: float = b, q: float = q
        ) -> FloatArray:
            kr, here = c(s), n(s)
            contact = q * problem.weight * math.cos(psi(s)) - kr * (here - b * kr**2) + b * k2(s)
            v, v1, moment, shear = flat.reshape(4, 2)
            return np.concatenate([v1, moment / b, shear + (here - 2.0 * b * kr**2) * v1, -contact / D * v])

        states = solve_ivp(rate, (low, high), states.ravel(), method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        states = states.reshape(4, 2)
    return float(np.linalg.det(states[:2]))


def test_contact_of_the_lying_rod_jumps_at_a_station_as_its_balance_says() -> None:
    problem, force = rod(), -60.0
    station, high, slope, curvature, height = between(problem)[1]
    s = np.linspace(station, high, 9)
    kr, last, top = curvature(s), curvature(high), height(high)
    drive = force - 15.0 * (top - height(s)) + 0.5 * (kr**2 - last**2)
    known = 15.0 * np.cos(slope(s)) - kr * (drive - kr**2) + curvature.deriv(2)(s)
    assert lying_contact(problem, force, s) == pytest.approx(known, rel=1e-7)
    below, above = lying_contact(problem, force, station + np.array([-1e-9, 1e-9]))
    assert abs(above - below) > 1.0


def softest(force: float, pencil: Pencil) -> float:
    """Lowest eigenvalue of the second variation on a mesh: zero at its first critical load."""
    return float(pencil.softest(force)[0][0])


def errors_on_meshes(problem: Problem, load: float, kinks: FloatArray) -> FloatArray:
    """Of the first critical load on a mesh of degree 5 that breaks at ``kinks``, and on the one of half elements."""
    space = SplineSpace(np.union1d(np.linspace(0.0, 1.0, 9), kinks), 5, kinks=kinks)
    return np.array(
        [
            abs(brentq(softest, load - 2.0, load + 2.0, args=(Pencil(problem, mesh),), xtol=1e-11) - load)
            for mesh in (space, space.refined())
        ]
    )


def test_critical_loads_of_a_string_along_stations_are_those_of_the_second_method() -> None:
    problem = rod(sections=STRING)
    found = critical_loads(problem, 1)[0]
    load = brentq(determinant, found.force - 0.1, found.force + 0.1, args=(problem,), xtol=1e-12)
    assert found.force == pytest.approx(load, rel=1e-10)


def test_critical_loads_converge_in_the_order_of_the_splines_to_that_of_the_second_method() -> None:
    problem = rod()
    found = critical_loads(problem, 1)[0]
    load = brentq(determinant, found.force - 1.0, found.force + 1.0, args=(problem,), xtol=1e-12)
    assert found.force == pytest.approx(load, rel=1e-10)
    broken = errors_on_meshes(problem, load, curved.stations_along(problem))
    whole = errors_on_meshes(problem, load, np.empty(0))
    assert math.log2(broken[0] / broken[1]) > 7.5  # 2(p − 1) = 8
    assert math.log2(whole[0] / whole[1]) < 7.0


TURNING = Survey.of([0.0, 25.0, 50.0, 75.0, 100.0], [60.0, 61.5, 60.5, 62.0, 61.0], [40.0, 42.0, 41.0, 43.5, 42.0])


def test_contact_of_a_rod_in_space_is_known_to_the_tolerance_and_balances_at_its_own_places() -> None:
    """Stiff and light: the jumps of its contact at stations are as large as the contact."""
    state = equilibrium(rod(50.0, TURNING), -5.0)
    kinks = state.meshes.coarse.space.kinks
    below, above = (state.fields(kinks + side * 1e-9)["contact_pressure"] for side in (-1.0, 1.0))
    assert np.max(np.abs(above - below)) > 30.0
    assert state.accurate
    assert state.certificate.worst < 1e-8  # forces and moments in space; 7e-4 on a mesh that does not break there
    own = state.own_places
    moved = own.meshes.fine.space.kinks
    assert own.problem.hole is not None
    assert np.max(np.abs(moved - kinks)) > 1e-6
    places = InHole(own.problem, own.meshes.fine, own.point.fine).place(moved)
    assert np.max(np.abs(places - own.problem.hole.stations)) < 2e-9
    assert own.accurate
