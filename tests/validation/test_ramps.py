"""Clearances that vary smoothly: critical loads by shooting, the second variation from the energy of any slope."""

from __future__ import annotations

import json
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp

from rodwell import Problem, critical_loads, follow, ramp, sensitivities, tensile_loads
from rodwell.analysis.straight.ramps import least_contact_on_ramps, steepest
from rodwell.cli.main import cli
from rodwell.errors import InputError
from rodwell.problem.sections import checked_sections, sections_from, sections_text

NARROWS = ((0.2,), *ramp(0.5, 1.0, 1.1), (0.3, 1.0, 1.0, 1.1))
"""A hole that widens towards s = 1."""
TAPERED = ((0.3, 2.0, 1.5, 1.2), *ramp(0.5, 1.2, 1.0, stiffness=(2.0, 0.8), weight=(1.5, 0.6)), (0.2, 0.8, 0.6))
"""A string that tapers where the hole narrows, with kinks of stiffness and weight where the wall is straight."""
CONE = ((1.0, 1.0, 1.0, (1.0, 1.4)),)
"""A clearance that goes in a straight line."""
BOWED = ((0.5, 1.0, 1.0, (1.0, 0.9875, 0.95)), (0.5, 1.0, 2.0, (0.95, 0.8875, 0.8)))
"""One parabola over both sections, with a step of the weight."""


def _pieces(problem: Problem) -> list[tuple[float, list[Polynomial]]]:
    """Length of each section; b, q, Δ and h there as polynomials of the place from 0 to its length."""
    out, above = [], 0.0
    for length, *ratios in problem.sections[::-1]:
        b, q, d = (
            Polynomial(np.polyfit(np.linspace(0.0, length, np.size(r)), np.atleast_1d(r), np.size(r) - 1)[::-1])
            for r in ratios[:3]
        )
        whole = q.integ()
        out.append((length, [b, q, problem.clearance * d, whole - whole(length) - above]))
        above += whole(length)
    return out[::-1]


def _misfit(problem: Problem, force: float) -> float:
    """Determinant that vanishes at a critical load: (b v″)″ − (N v′)′ + (P/Δ) v = 0 integrated along the rod."""
    whole = np.eye(4)
    for length, (b, q, d, h) in _pieces(problem):
        axial = force + problem.axial_weight * h
        pushed = problem.foundation * q + (axial * d.deriv()).deriv() - (b * d.deriv(2)).deriv(2)

        def rates(x: float, y: np.ndarray, *of: Polynomial) -> np.ndarray:
            b, axial, pushed, d = (one(x) for one in of)
            v, slope, moment, shear = y.reshape(4, 4)
            return np.concatenate([slope, moment / b, shear + axial * slope, -pushed / d * v])

        found = solve_ivp(rates, (0.0, length), whole.ravel(), method="DOP853", rtol=1e-13, atol=1e-13,
                          args=(b, axial, pushed, d))  # fmt: skip
        whole = found.y[:, -1].reshape(4, 4)
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
    signs = np.sign([_misfit(problem, force) for force in grid])
    assert int(np.sum(signs[1:] != signs[:-1])) == 2


def _energy_variation(problem: Problem, force: float) -> tuple[float, float]:
    """∂²E/∂ε² of the rod at (−Δ cos εφ, Δ sin εφ) for a shape φ with the energy of any slope, and of constant Δ."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    breaks = problem.rod.breaks
    ends = np.unique(np.concatenate([np.linspace(a, b, 9) for a, b in pairwise(breaks)]))
    h = 0.5 * np.diff(ends)
    s = (ends[:-1, None] + h[:, None] * (nodes + 1.0)).ravel()
    w = (h[:, None] * weights).ravel()
    phi, own = Polynomial([0, 0, 1, -2, 1]) * Polynomial([30.0, 10.0]), problem.rod.clearance
    d = problem.clearance * np.array([own(s), own.derivative(s), own.derivative.derivative(s)])
    f = np.array([phi(s), phi.deriv()(s), phi.deriv(2)(s)])
    axial = force + problem.axial_weight * (s - 1.0)

    def energy(eps: float) -> float:
        e = np.exp(1j * eps * f[0])  # Δ e^{iεφ}: −x + iy
        r = d[0] * e
        r1 = (d[1] + 1j * eps * f[1] * d[0]) * e
        r2 = (d[2] + 2j * eps * f[1] * d[1] + (1j * eps * f[2] - (eps * f[1]) ** 2) * d[0]) * e
        slope, bend = np.abs(r1) ** 2, np.real(r1 * np.conj(r2))
        bent = 0.5 * (np.abs(r2) ** 2 + bend**2 / (1.0 - slope))
        return float(w @ (bent - problem.lateral_weight * r.real + axial * (1.0 - np.sqrt(1.0 - slope))))

    def second(eps: float) -> float:
        return 2.0 * (energy(eps) - energy(0.0)) / eps**2  # even in ε

    exact = (4.0 * second(0.005) - second(0.01)) / 3.0
    v, v1, v2 = (d[0] * f[0], d[1] * f[0] + d[0] * f[1], d[2] * f[0] + 2.0 * d[1] * f[1] + d[0] * f[2])
    third, fourth = own.derivative.derivative.derivative, own.derivative.derivative.derivative.derivative
    assert np.any(third(s) != 0.0)
    pushed = problem.lateral_weight + problem.axial_weight * d[1] + axial * d[2] - problem.clearance * fourth(s)
    return exact, float(w @ (v2**2 + axial * v1**2 + pushed / d[0] * v**2))


def test_second_variation_is_that_of_the_energy_but_for_the_square_of_the_slope() -> None:
    """Contact force over clearance, not weight over clearance, to the order of Δ′²."""
    misses = []
    for clearance in (0.02, 0.04):
        lateral, axial = 3000.0 * clearance, 20.0
        problem = Problem(
            np.hypot(lateral, axial), np.degrees(np.arctan2(lateral, axial)), clearance=clearance,
            sections=((0.1,), *ramp(0.8, 1.0, 1.3), (0.1, 1, 1, 1.3)),
        )  # fmt: skip
        exact, ours = _energy_variation(problem, -60.0)
        misses.append(abs(ours - exact) / abs(exact))
        assert misses[-1] < 20.0 * steepest(problem) ** 2
    assert misses[1] / misses[0] == pytest.approx(4.0, rel=0.1)


def test_clearances_that_are_alike_are_one() -> None:
    plain = Problem(60.0, 60.0)
    assert Problem(60.0, 60.0, sections=((0.4, 1, 1, (1, 1, 1)), *ramp(0.6, 1.0, 1.0))) == plain
    near = Problem(60.0, 60.0, sections=((0.2,), *ramp(0.5, 1.0, 1.0 + 1e-9), (0.3, 1, 1, 1.0 + 1e-9)))
    assert critical_loads(near, 3).forces == pytest.approx(critical_loads(plain, 3).forces, rel=3e-9)


def test_contact_in_closed_form_and_seen_from_the_other_end() -> None:
    problem = CASES["cone"]
    least = least_contact_on_ramps(problem, -123.0)
    assert least.value == pytest.approx(problem.lateral_weight + problem.axial_weight * 0.4 * 0.01, rel=1e-12)
    assert steepest(problem) == pytest.approx(0.004, rel=1e-12)
    widens = CASES["widens"]
    assert least_contact_on_ramps(widens, 0.0).s == pytest.approx(0.2 + 0.5 * 0.25, abs=0.15)
    back = widens.turned_round
    loads, other = critical_loads(widens, 2), critical_loads(back, 2)
    assert other.forces == pytest.approx(loads.forces - widens.axial_weight, rel=1e-10)
    assert tensile_loads(widens) == ()
    half = 0.5 * 0.05 / 0.5**4 * 768.0 * 0.01
    level = Problem(60.0, 90.0, sections=((0.25,), *ramp(0.5, 1.0, 1.05), (0.25, 1, 1, 1.05)))
    assert least_contact_on_ramps(level, 0.0).value == pytest.approx(60.0 - 2.0 * half, rel=1e-9)


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


@pytest.mark.parametrize("what", [follow, sensitivities])
def test_what_needs_one_clearance_is_refused(what: Any) -> None:
    with pytest.raises(InputError, match=r"must have one clearance.*there are critical loads"):
        what(CASES["widens"])


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
    assert told["varying_clearance"]["slope_squared"] == pytest.approx(steepest(CASES["widens"]) ** 2)
    least = least_contact_on_ramps(CASES["widens"], loads[0].force)
    assert told["varying_clearance"]["least_contact"]["value"] == pytest.approx(least.value)
    refused = CliRunner().invoke(cli, [*arguments[:-1], "0.2:1,0.5:1:1:1~2,0.3:1:1:2"])
    assert isinstance(refused.exception, InputError)
    assert "bridges" in str(refused.exception)
