"""Strings off the wall of a curved hole: beams of small slopes in closed form, transfer matrices, limits, symmetries.

A beam of stiffness b(s) by a height y above the wall of a hole of curvature κ has the energy b(κ + y″)²/2 + Ny′²/2 −
Nκy + wy where slopes are small: it is pressed by P = w − Nκ, and where b has a step, b(κ + y″) and by‴ − Ny′ go on.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq, fsolve

from rodwell import InputError, Problem, critical_loads, load_path
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.path.bridged_slopes import sensitivities
from rodwell.analysis.path.bridging import bridged

Array = np.ndarray
Strings = tuple[tuple[float, ...], ...]

STIFFER: Strings = ((0.5, 1, 1), (0.5, 3, 1))
NARROWER: Strings = ((0.4, 1, 1, 1), (0.2, 1, 1, 0.5), (0.4, 1, 1, 1))
"""A stabiliser, say."""


def buckling(problem: Problem) -> ContactState:
    found = load_path(problem, rtol=1e-10).first("critical")
    assert found is not None
    assert found.state is not None
    assert found.met
    assert found.state.certificate.passed  # the balance of forces in space, which the solver does not use
    return found.state


def branch(x: float, amplitude: float, b: float, pressed: float, compression: float) -> Array:
    """By y⁗ + Cy″ = −P, from y = y′ = y″ = 0 where contact ends: y, y′, y″, by‴ at the distance x."""
    k = math.sqrt(compression / b)
    q, s, c = pressed / compression, math.sin(k * x), math.cos(k * x)
    return np.array([
        amplitude * (k * x - s) / k**2 - q * (x**2 / 2.0 + (c - 1.0) / k**2),
        amplitude * (1.0 - c) / k - q * (x - s / k),
        amplitude * s - q * (1.0 - c),
        b * (amplitude * k * c - q * k * s),
    ])  # fmt: skip


def over_step(sides: tuple[float, float], heights: float, pressed: float, bend: float, compression: float) -> Array:
    """How far from a step contact ends, its forces there and on the edge: (a, c, left, edge, right).

    ``sides`` are b on both, ``heights`` by how much the second wall is nearer to the axis; without that no edge.
    """
    (low, high), jump = sides, (sides[1] - sides[0]) * bend
    length = (27.0 * heights / pressed) ** 0.25 if heights else math.sqrt(3.0 * abs(jump) / pressed)

    def misses(unknown: Array) -> Array:
        a, c, left, right = (unknown * [length, length, pressed * length, pressed * length]).tolist()
        one = branch(a, left / math.sqrt(compression / low) / low, low, pressed, compression)
        other = branch(c, right / math.sqrt(compression / high) / high, high, pressed, compression)
        last = other[0] if heights else one[3] + other[3] + compression * (one[1] + other[1])
        scale = length**4 * pressed
        return np.array([
            (one[0] - other[0] - heights) / scale, (one[1] + other[1]) / scale * length,
            (low * one[2] - high * other[2] - jump) / scale * length**2,
            last / scale * (1.0 if heights else length**3),
        ])  # fmt: skip

    guess = [1.0, 0.8, 0.4, 0.2] if heights else [0.25, 1.4, 2.0, 0.5]
    found, _, done, _ = fsolve(misses, guess, xtol=1e-13, full_output=True)
    assert done == 1
    a, c, left, right = found * [length, length, pressed * length, pressed * length]
    one = branch(a, left / math.sqrt(compression / low) / low, low, pressed, compression)
    other = branch(c, right / math.sqrt(compression / high) / high, high, pressed, compression)
    return np.array([a, c, left, -one[3] - other[3], right])


def sideways(problem: Problem, compression: float) -> float:
    """Zero at a buckling load of two clamped sections: bv⁗ + Cv″ + (P/Δ)v = 0 on the wall, springs at point forces."""
    (_, low, weight, wide, _), (_, high, _, tight, _) = problem.sections
    wide, tight, bend = wide * problem.clearance, tight * problem.clearance, problem.build
    pressed = problem.weight * weight + compression * bend
    a, c, left, edge, right = over_step((low, high), wide - tight, pressed, bend, compression)

    def along(length: float, b: float, bed: float) -> Array:
        """Of v, v′, bv″, bv‴."""
        rates = np.diag([1.0, 1.0 / b, 1.0], 1)
        rates[3, 0], rates[3, 2] = -bed, -compression / b
        return np.asarray(expm(length * rates))

    def spring(force: float, radius: float) -> Array:
        jump = np.eye(4)
        jump[3, 0] = -force / radius
        return jump

    whole = along(0.5 - a, low, pressed / wide)
    for part in (spring(left, wide), along(a, low, 0.0), spring(edge if wide > tight else 0.0, tight),
                 along(c, high, 0.0), spring(right, tight), along(0.5 - c, high, pressed / tight)):  # fmt: skip
        whole = part @ whole
    return float(np.linalg.det(whole[:2, 2:]))


def test_beside_a_step_of_the_stiffness_the_gap_is_that_of_a_beam() -> None:
    """Small slopes, no end force: y = Ax³/6 − wx⁴/24b on both sides, from where contact ends."""
    weight, bend, stiff = 2.0, 1e-3, 3.0

    def misses(unknown: Array) -> list[float]:
        a, c, left, right = unknown
        return [
            left * a**3 / 6 - a**4 / 24 - (right * c**3 / 6 - c**4 / 24) / stiff,
            left * a**2 / 2 - a**3 / 6 + (right * c**2 / 2 - c**3 / 6) / stiff,
            (left * a - a**2 / 2) - (right * c - c**2 / 2) - (stiff - 1.0),
            left - a + right - c,
        ]  # fmt: skip

    a, c, left, right = fsolve(misses, [0.5, 3.0, 4.0, 1.0], xtol=1e-14)
    assert np.max(np.abs(misses(np.array([a, c, left, right])))) < 1e-12
    size = math.sqrt(bend / weight)  # lengths in √(Bκ/w), forces in √(Bκw)
    problem = Problem(weight, clearance=1e-3, sections=STIFFER, build=bend)
    found = bridged(rod_in_hole(problem), 0.0)
    assert found is not None
    state = contact_state(found)
    assert state.certificate.passed
    assert [point.s.value for point in state.point_forces] == pytest.approx([0.5 - a * size, 0.5 + c * size], abs=3e-7)
    force = math.sqrt(bend * weight)
    assert [point.force.value for point in state.point_forces] == pytest.approx([left * force, right * force], rel=1e-5)


@pytest.mark.parametrize("sections", [STIFFER, ((0.5, 1, 1, 1), (0.5, 1, 1, 0.6)), ((0.5, 1, 1, 1), (0.5, 2, 1, 0.6))])
def test_the_buckling_load_is_that_of_transfer_matrices_for_small_slopes(sections: Strings) -> None:
    problem = Problem(0.05, clearance=1e-4, sections=sections, build=1e-3)
    load = -buckling(problem).force
    near = np.array([0.98, 1.02]) * load
    assert brentq(lambda c: sideways(problem, c), *near, xtol=1e-10) == pytest.approx(load, rel=2e-5)


def test_of_a_step_that_vanishes_the_load_is_that_on_the_wall() -> None:
    """A step of the weight alone takes nothing off the wall; one of the stiffness the less the smaller it is."""
    for stiffness, rel in ((1.0, 1e-9), (1.01, 1e-6)):
        problem = Problem(50.0, 60.0, 1e-3, build=0.2, sections=((0.5, 1, 1), (0.5, stiffness, 3)))
        assert buckling(problem).force == pytest.approx(critical_loads(problem, 1)[0].force, rel=rel)


def test_in_a_hole_that_is_nearly_straight_the_string_bridges_as_in_a_straight_one() -> None:
    for sections in (NARROWER, ((0.4, 1, 1), (0.2, 1, -1), (0.4, 1, 1))):
        straight = Problem(30.0, 60.0, 1e-3, sections=sections)
        ends = [bridged(rod_in_hole(straight.but(build=build)), 30.0) for build in (0.0, 1e-11)]
        one, other = (contact_state(end) for end in ends if end is not None)
        assert [p.s.value for p in one.point_forces] == pytest.approx([p.s.value for p in other.point_forces], abs=1e-8)
        forces = [[p.force.value for p in state.point_forces] for state in (one, other)]
        assert forces[0] == pytest.approx(forces[1], rel=1e-8)
    straight = straight.but(sections=NARROWER)
    assert buckling(straight.but(build=1e-11)).force == pytest.approx(buckling(straight).force, rel=1e-9)


def test_a_string_is_the_same_from_its_other_end() -> None:
    """A level arc: sections reversed, and what the other end bears at s = 1 then."""
    for sections in (((0.3, 1, 1), (0.7, 2, 1)), ((0.3, 1, 1, 1), (0.1, 3, 2, 0.5), (0.6, 1, 1, 1))):
        problem = Problem(40.0, clearance=2e-3, build=0.1, sections=sections)
        force = buckling(problem).force
        borne = rod_in_hole(problem).drive(np.zeros(1), force)[0] / (1.0 + problem.clearance * problem.build)
        assert buckling(problem.but(sections=sections[::-1])).force == pytest.approx(borne, rel=1e-8)


def test_upside_down_a_string_that_floats_is_one_that_sinks() -> None:
    problem = Problem(40.0, 70.0, 2e-3, build=0.1, sections=NARROWER)
    other = problem.but(alpha=110.0, build=-0.1, floats=True)
    assert buckling(other).force == pytest.approx(buckling(problem).force, rel=1e-10)


def test_with_its_own_places_the_energy_is_that_in_space() -> None:
    """Bending, height and the work of the end force, each section at its own clearance: the model's to second order."""
    state = buckling(Problem(50.0, 60.0, 1e-3, build=0.2, sections=((0.4, 1, 1, 1), (0.2, 2, 3, 0.5), (0.4, 1, 1, 1))))
    assert state.place_errors["energy"] < 1e-4 * abs(state.energy.value)
    assert state.place_errors["contact_total"] < 1e-4 * state.contact_total.value


def test_sections_that_float_lie_on_the_upper_side() -> None:
    problem = Problem(50.0, 60.0, 1e-3, build=0.2, sections=((0.4, 1, 1), (0.2, 1, -1), (0.4, 1, 1)))
    state = load_path(problem, until=10.0).at(10.0)[0].state
    assert state.certificate.passed
    assert max(abs(point.angle) for point in state.point_forces) == pytest.approx(math.pi)


def test_derivatives_are_those_of_differences() -> None:
    problem = Problem(50.0, 60.0, 1e-2, build=0.2, sections=NARROWER)
    (found,) = sensitivities(problem)
    for name, step in (("build", 1e-4), ("weight", 1e-2), ("clearance", 1e-6)):
        value = getattr(problem, name)
        above, below = (buckling(problem.but(**{name: value + sign * step})).force for sign in (1.0, -1.0))
        assert found.derivatives[name].value == pytest.approx((above - below) / (2.0 * step), rel=1e-6)


def test_what_is_not_computed_is_refused() -> None:
    with pytest.raises(InputError, match="must have one clearance in a hole that leaves the vertical plane"):
        Problem(50.0, 60.0, 1e-3, build=0.2, walk=0.1, sections=NARROWER)
    with pytest.raises(InputError, match="must not taper"):
        load_path(Problem(50.0, 60.0, 1e-3, build=0.2, sections=((0.5, (1, 2), 1), (0.5, 2, 1))))
    with pytest.raises(InputError, match="walk"):
        load_path(Problem(50.0, 60.0, 1e-3, build=0.2, walk=0.1, sections=STIFFER))
    with pytest.raises(InputError, match="stays on the wall"):
        critical_loads(Problem(50.0, 60.0, 1e-3, build=0.2, sections=NARROWER))
