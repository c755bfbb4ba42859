"""Clearances that vary smoothly: critical loads by shooting, the second variation from the energy of any slope."""

from __future__ import annotations

import json
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from numpy.polynomial import Chebyshev, Polynomial
from scipy.integrate import solve_ivp

from rodwell import Problem, critical_loads, ramp, tensile_loads
from rodwell.analysis.discrete.meshes import linear_space
from rodwell.analysis.straight.lying_pencil import variation_factors
from rodwell.analysis.straight.ramps import axial_contact, least_contact_on_ramps, steepest
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.problem.sections import checked_sections, sections_from, sections_text
from rodwell.problem.words import ends_text, sections_given

NARROWS = ((0.2,), *ramp(0.5, 1.0, 1.1), (0.3, 1.0, 1.0, 1.1))
"""A hole that widens towards s = 1."""
TAPERED = ((0.3, 2.0, 1.5, 1.2), *ramp(0.5, 1.2, 1.0, stiffness=(2.0, 0.8), weight=(1.5, 0.6)), (0.2, 0.8, 0.6))
"""A string that tapers where the hole narrows, with kinks of stiffness and weight where the wall is straight."""
CONE = ((1.0, 1.0, 1.0, (1.0, 1.4)),)
"""A clearance that goes in a straight line."""
BOWED = ((0.5, 1.0, 1.0, (1.0, 0.9875, 0.95)), (0.5, 1.0, 2.0, (0.95, 0.8875, 0.8)))
"""One parabola over both sections, with a step of the weight."""


def _pieces(problem: Problem) -> list[tuple[float, list[Polynomial]]]:
    """Length of each section; b, q, Δ there as polynomials of the place from 0 to its length."""
    return [
        (length, [Polynomial(np.polyfit(np.linspace(0.0, length, np.size(r)), np.atleast_1d(r), np.size(r) - 1)[::-1])
                  * size for r, size in zip(ratios[:3], (1.0, 1.0, problem.clearance), strict=True)])
        for length, *ratios in problem.sections
    ]  # fmt: skip


def _statics(problem: Problem, force: float) -> list[tuple[float, list[Any]]]:
    """Of each section b, λ = T − bk², R and Δ as functions of the place in it, of the plane rod that lies on the wall.

    Along the normal towards the axis the curvature is k, the shear S = −(bk)′; T′ = kS − w·t, T z′ + SΔ′ = F at s = 1.
    """
    out: list[tuple[float, list[Any]]] = []
    tension: float | None = None
    for length, (b, q, d) in _pieces(problem)[::-1]:

        def plane(x: Any, b: Any = b, d: Any = d) -> Any:
            d1, d2, d3, d4 = (d.deriv(k)(x) for k in (1, 2, 3, 4))
            z = np.sqrt(1.0 - d1**2)
            k, k1 = -d2 / z, -d3 / z - d1 * d2**2 / z**3
            k2 = -d4 / z - (3.0 * d1 * d2 * d3 + d2**3) / z**3 - 3.0 * d1**2 * d2**3 / z**5
            shear = -(b.deriv()(x) * k + b(x) * k1)
            return d1, z, k, shear, -(b.deriv(2)(x) * k + 2.0 * b.deriv()(x) * k1 + b(x) * k2)

        def along(x: Any, q: Any = q, plane: Any = plane) -> Any:
            d1, z, k, shear, _ = plane(x)
            return k * shear - q(x) * (problem.foundation * d1 - problem.axial_weight * z)

        rate = Chebyshev.interpolate(along, 40, domain=[0.0, length]).integ(lbnd=length)
        if tension is None:
            d1, z, _, shear, _ = plane(length)
            tension = (force - shear * d1) / z

        def lam(x: Any, rate: Any = rate, end: float = tension, b: Any = b, plane: Any = plane) -> Any:
            return rate(x) + end - b(x) * plane(x)[2] ** 2

        def push(x: Any, rate: Any = rate, end: float = tension, q: Any = q, plane: Any = plane) -> Any:
            d1, z, k, _, shear_rate = plane(x)
            heavy = -q(x) * (problem.foundation * z + problem.axial_weight * d1)
            return -((rate(x) + end) * k + shear_rate + heavy) * z

        tension = float(rate(0.0)) + tension
        out.append((length, [b, lam, push, d]))
    return out[::-1]


def _misfit(problem: Problem, force: float, rtol: float = 1e-13) -> float:
    """Determinant that vanishes at a critical load: (b v″)″ − (λ v′)′ + (R/Δ) v = 0 integrated along the rod.

    It is the balance of forces across the plane of the rod that lies, v = Δθ being the displacement there. A pinned end
    turns about the radius: t keeps the component Δ′ along it, and v″ + Δ′Δ″v′/z′² vanishes there.
    """
    whole = np.eye(4)
    for length, functions in _statics(problem, force):
        b, _, _, d = functions

        def rates(x: float, y: np.ndarray, *of: Any) -> np.ndarray:
            stiffness, axial, pushed, clearance = (one(x) for one in of)
            v, slope, moment, shear = y.reshape(4, 4)
            return np.concatenate([slope, moment / stiffness, shear + axial * slope, -pushed / clearance * v])

        found = solve_ivp(rates, (0.0, length), whole.ravel(), method="DOP853", rtol=rtol, atol=rtol,
                          args=functions)  # fmt: skip
        whole = found.y[:, -1].reshape(4, 4)
    whole[2] += b(length) * d.deriv()(length) * d.deriv(2)(length) / (1.0 - d.deriv()(length) ** 2) * whole[1]
    first, last = ({"clamped": (0, 1), "pinned": (0, 2), "free": (2, 3)}[end] for end in problem.ends)
    return float(np.linalg.det(whole[np.ix_(last, [i for i in range(4) if i not in first])]))


CASES = {
    "widens": Problem(60.0, 60.0, sections=NARROWS),
    "tapers too": Problem(60.0, 80.0, ends="pinned-clamped", sections=TAPERED),
    "cone": Problem(30.0, 45.0, sections=CONE),
    "bowed": Problem(40.0, 90.0, ends="clamped-pinned", sections=BOWED),
    "constant at a free end": Problem(60.0, 60.0, ends="pinned-free", sections=NARROWS),
    "below": Problem(60.0, 120.0, sections=NARROWS),
}


@pytest.mark.parametrize("case", CASES)
def test_loads_are_those_of_shooting(case: str) -> None:
    problem = CASES[case]
    modes = critical_loads(problem, 3)
    assert len(modes) >= 2
    for mode in modes:
        width = max(2.0 * mode.error, 1e-10 * abs(mode.force))
        below, above = (_misfit(problem, mode.force + sign * width) for sign in (-1.0, 1.0))
        assert below * above < 0.0
        assert mode.error < 1e-8 * abs(mode.force)


def test_no_load_of_shooting_is_left_out() -> None:
    problem = CASES["widens"]
    forces = critical_loads(problem, 3).forces
    grid = np.linspace(0.0, 0.5 * (forces[1] + forces[2]), 41)
    signs = np.sign([_misfit(problem, force, 1e-7) for force in grid])
    assert int(np.sum(signs[1:] != signs[:-1])) == 2


def _energy(problem: Problem, force: float, eps: float) -> float:
    """Energy of the rod at the angles εφ(s), each cross-section on the wall where it has got to, less that at ε = 0.

    The way σ along the wall's generator that a cross-section has come obeys σ′² + Δ(σ)²θ′² = 1; positions in space are
    differentiated numerically.
    """
    nodes = np.polynomial.chebyshev.chebpts1(24)
    ends = np.unique(np.concatenate([np.linspace(a, b, 7) for a, b in pairwise(problem.rod.breaks)]))
    half = 0.5 * np.diff(ends)[:, None]
    s = ends[:-1, None] + half * (nodes + 1.0)
    values = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes, 23))
    identity = np.eye(24)
    rate, running = (
        np.array([np.polynomial.chebyshev.chebval(nodes, f(row)) for row in identity]).T @ values
        for f in (np.polynomial.chebyshev.chebder, lambda row: np.polynomial.chebyshev.chebint(row, lbnd=-1.0))
    )
    whole = np.array([np.polynomial.chebyshev.chebval(1.0, np.polynomial.chebyshev.chebint(row, lbnd=-1.0))
                      for row in identity]) @ values  # fmt: skip

    def integral(f: np.ndarray) -> np.ndarray:
        pieces = (f @ whole)[:, None] * half
        return np.concatenate([[[0.0]], np.cumsum(pieces, axis=0)[:-1]]) + f @ running.T * half

    own = problem.rod.clearance

    def clearance(places: np.ndarray) -> np.ndarray:
        return problem.clearance * own(places.ravel()).reshape(places.shape)

    phi = Polynomial([0, 0, 1, -2, 1]) * Polynomial([30.0, 10.0])
    angle, slope = eps * phi(s), eps * phi.deriv()(s)
    sigma = s
    for _ in range(12):
        ahead = np.sqrt(1.0 - (clearance(sigma) * slope) ** 2)
        sigma = integral(ahead)
    d = clearance(sigma)
    rise = problem.clearance * own.derivative(sigma.ravel()).reshape(s.shape)
    z = integral(np.sqrt(1.0 - rise**2) * ahead)
    r = np.array([-d * np.cos(angle), d * np.sin(angle), z])
    bent = (r @ rate.T / half) @ rate.T / half
    stored = 0.5 * np.sum(bent**2, axis=0) + problem.lateral_weight * r[0] + problem.axial_weight * z
    end = float(np.sum((np.sqrt(1.0 - rise**2) * ahead) @ whole * half[:, 0]))
    return float(np.sum(stored @ whole * half[:, 0])) - force * end


def test_second_variation_is_that_of_a_rod_whose_cross_sections_find_the_wall_where_they_get_to() -> None:
    """The wall's push along the hole is in it, and no power of its slope is left out."""
    problem = Problem(300.0, 80.0, clearance=0.08, sections=((0.1,), *ramp(0.8, 1.0, 1.3), (0.1, 1, 1, 1.3)))
    force, base = -60.0, _energy(problem, -60.0, 0.0)

    def second(eps: float) -> float:
        return 2.0 * (_energy(problem, force, eps) - base) / eps**2  # even in ε

    exact = (4.0 * second(0.02) - second(0.04)) / 3.0
    space = linear_space(problem, 12)
    phi = Polynomial([0, 0, 1, -2, 1]) * Polynomial([30.0, 10.0])
    at_rest, pushed = variation_factors(problem, space)
    shape = problem.clearance * np.array([phi.deriv(k)(space.points) if k else phi(space.points) for k in range(3)])
    ours = np.einsum("am,abm,bm,m->", shape, at_rest + force * pushed, shape, space.weights)
    assert ours == pytest.approx(exact, rel=2e-7)
    assert abs(axial_contact(problem, force)) > 1.0


def test_clearances_that_are_alike_are_one() -> None:
    plain = Problem(60.0, 60.0)
    assert Problem(60.0, 60.0, sections=((0.4, 1, 1, (1, 1, 1)), *ramp(0.6, 1.0, 1.0))) == plain
    near = Problem(60.0, 60.0, sections=((0.2,), *ramp(0.5, 1.0, 1.0 + 1e-9), (0.3, 1, 1, 1.0 + 1e-9)))
    assert critical_loads(near, 3).forces == pytest.approx(critical_loads(plain, 3).forces, rel=3e-9)


def test_contact_in_closed_form_and_seen_from_the_other_end() -> None:
    problem = CASES["cone"]
    least, lying = least_contact_on_ramps(problem, -123.0), np.sqrt(1.0 - 0.004**2)
    normal = problem.lateral_weight * lying + problem.axial_weight * 0.004
    assert least.value == pytest.approx(normal, rel=1e-12)
    assert axial_contact(problem, -123.0) == pytest.approx(0.004 * normal, rel=1e-9)
    assert steepest(problem) == pytest.approx(0.004, rel=1e-12)
    widens = CASES["widens"]
    assert least_contact_on_ramps(widens, 0.0).s == pytest.approx(0.2 + 0.5 * 0.25, abs=0.15)
    back = widens.turned_round
    loads, other = critical_loads(widens, 2), critical_loads(back, 2)
    pushed = np.array([axial_contact(widens, force) for force in loads.forces])
    assert pushed == pytest.approx([0.05204] * 2, rel=1e-3)
    assert other.forces == pytest.approx(loads.forces - widens.axial_weight + pushed, rel=1e-10)
    assert tensile_loads(widens) == ()
    half = 0.5 * 0.05 / 0.5**4 * 768.0 * 1e-5  # of a wall of hardly any slope
    level = Problem(0.06, 90.0, clearance=1e-5, sections=((0.25,), *ramp(0.5, 1.0, 1.05), (0.25, 1, 1, 1.05)))
    assert least_contact_on_ramps(level, 0.0).value == pytest.approx(0.06 - 2.0 * half, rel=1e-9)


PULLED = ((0.2,), *ramp(0.5, 1.0, 1.6), (0.3, 1.0, 1.0, 1.6))
REFUSED: list[tuple[dict[str, Any], str]] = [
    ({"sections": PULLED}, r"contact force -.*at s/L = 0\.[34].*bridges"),
    ({"sections": NARROWS, "twist": 1.0}, "twist = 1.0: must be 0 where the clearance varies"),
    ({"sections": CONE, "ends": "clamped-free"}, "free at s = 1 where the clearance varies"),
    ({"sections": CONE, "ends": "guided-clamped"}, "guided at s = 0"),
    ({"sections": ((0.5, 1, 1, (1, 1.025, 1.1)), (0.5, 1, 1, (1.1, 1.2, 1.3)))}, "BΔ″ jumps at s/L = 0.5"),
    ({"sections": ((0.5, 1, 1, (1, 0.9875, 0.95)), (0.5, 2, 1, (0.95, 0.8875, 0.8)))}, "BΔ″ jumps at s/L = 0.5"),
    ({"sections": ((0.5, (1, 2), 1, (1, 0.9875, 0.95)), (0.5, 2, 1, (0.95, 0.8875, 0.8)))}, r"\(BΔ″\)′ jumps"),
    ({"sections": ((0.5, 1, 1, (1, 1.1)), (0.5, 1, 1, 1.1))}, "a kink at s/L = 0.5"),
    ({"sections": ((0.5, 1, 1, (1, 1.1)), (0.5, 1, 1, 1.2))}, "a step at s/L = 0.5"),
    ({"sections": NARROWS, "turns": 1}, "turns = 1: must be 0 where the clearance varies"),
    ({"sections": NARROWS, "build": 0.1}, "clearances that vary along sections are computed in straight holes only"),
    ({"sections": NARROWS, "weight": 0.0}, "contact force"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "said"), REFUSED)
def test_what_is_not_computed_is_refused_with_the_place(given: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        critical_loads(Problem(**{"weight": 60.0, "alpha": 60.0, **given}))


def test_higher_modes_at_which_the_rod_has_left_the_wall_are_left_out() -> None:
    problem = Problem(30.0, 90.0, sections=((0.2,), *ramp(0.6, 1.0, 1.05), (0.2, 1, 1, 1.05)))
    few, edge = critical_loads(problem, 30), None
    assert 1 <= len(few) < 30
    assert least_contact_on_ramps(problem, few[-1].force).value > 0.0
    edge = critical_loads(problem.but(weight=0.999 * problem.weight), len(few))
    assert len(edge) <= len(few)


def test_written_in_a_line_and_told_by_the_command() -> None:
    line = "0.2:1,0.5:1:1:1~1.1,0.3:1:1:1.1"
    assert checked_sections(sections_from(line)) == checked_sections(NARROWS)
    assert checked_sections(sections_from(sections_text(NARROWS))) == checked_sections(NARROWS)
    arguments = ["critical", "--weight", "60", "--alpha", "60", "--modes", "2", "--sections", line]
    shown = CliRunner().invoke(cli, arguments)
    assert shown.exit_code == 0, shown.output
    assert "clearance varies" in shown.output
    told = json.loads(CliRunner().invoke(cli, [*arguments, "--json"]).output)
    loads = critical_loads(CASES["widens"], 2)
    assert told["critical_loads"] == pytest.approx(list(loads.forces), rel=1e-12)
    pushed = axial_contact(CASES["widens"], loads[0].force)
    assert told["varying_clearance"]["axial_contact"] == pytest.approx(pushed) == pytest.approx(loads.axial_contact)
    least = least_contact_on_ramps(CASES["widens"], loads[0].force)
    assert told["varying_clearance"]["least_contact"]["value"] == pytest.approx(least.value)
    refused = CliRunner().invoke(cli, [*arguments[:-1], "0.2:1,0.5:1:1:1~2,0.3:1:1:2"])
    assert isinstance(refused.exception, InputError)
    assert "bridges" in str(refused.exception)


def test_a_smooth_change_of_the_clearance_counts_as_one_section() -> None:
    """It is made of four, which nobody gave; sections that are given one by one count one by one."""
    given = sections_from("0.4:1:1:1,0.2:1:1:1~1.4,0.2:1:1:1.4,0.1:1:1:1.4~1.5,0.1:1:1:1.5")
    assert sections_given(Problem(15.0, sections=given)) == 5
    assert "string of 5 sections" in ends_text(Problem(15.0, sections=given))
    assert sections_given(Problem(15.0, sections=((0.5, 1.0), (0.5, 2.0)))) == 2
