"""The straight rod without the wall's help: closed forms, shooting, what is said of it."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
import scipy.linalg
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from walls import free, touch_of

from rodwell import (
    InputError,
    Problem,
    critical_loads,
    loads_without_wall,
)
from rodwell.cli.main import cli
from rodwell.physics.exact.twisted import critical_twist, greenhill_load, twisted_loads

PI2 = math.pi**2

HELD = {
    "clamped": "x x' y y'",
    "pinned": "x x' y m_y",
    "guided": "x x' y' q_y",
    "free": "x x' m_y q_y",
    "ball": "x y m_x m_y",
    "loose": "m_x m_y q_x q_y",
}
"""What vanishes at each end; m = u″ + ½iT₁u′ and q = −u‴ − iT₁u″ + Nu′ are dual to slope and displacement."""


def rows(end: str, twist: float, axial: float) -> np.ndarray:
    """Real conditions (4, 8) at an end on (u, u′, u″, u‴), each x before y."""
    one = np.eye(2)
    i = np.array([[0.0, -1.0], [1.0, 0.0]])
    nothing = np.zeros((2, 2))
    kinds = {
        "": np.hstack([one, nothing, nothing, nothing]),
        "'": np.hstack([nothing, one, nothing, nothing]),
        "m": np.hstack([nothing, 0.5 * twist * i, one, nothing]),
        "q": np.hstack([nothing, axial * one, -twist * i, -one]),
    }
    out = []
    for name in HELD[end].split():
        kind, field = ("mq"["mq".index(name[0])], name[2]) if name[0] in "mq" else (name[1:], name[0])
        out.append(kinds[kind]["xy".index(field)])
    return np.array(out)


def shooting(problem: Problem, force: float) -> float:
    """Second method: determinant of the conditions at s = 1 for solutions of the equation that meet those at s = 0."""
    twist, weight = problem.twist, problem.axial_weight

    def rate(s: float, flat: np.ndarray) -> np.ndarray:
        u1, u2, u3 = flat.reshape(4, 2, -1)[1:]
        turned = np.array([-u3[1], u3[0]])  # iu‴
        u4 = -twist * turned + (force + weight * (s - 1.0)) * u2 + weight * u1
        return np.array([u1, u2, u3, u4]).ravel()

    start = scipy.linalg.null_space(rows(problem.ends[0], twist, force - weight))
    path = solve_ivp(rate, (0.0, 1.0), start.ravel(), method="DOP853", rtol=1e-11, atol=1e-12)
    return float(np.linalg.det(rows(problem.ends[1], twist, force) @ path.y[:, -1].reshape(8, 4)))


@pytest.mark.parametrize("twist", [0.0, 1.0, 5.0, -5.0, 12.0, 30.0])
def test_weightless_twisted_rod(twist: float) -> None:
    """Roots of elementary functions, and −24.1769211 of two programs."""
    for end in ("clamped", "ball"):
        loads = loads_without_wall(Problem(0.0, alpha=0.0, twist=twist, ends=f"{end}-{end}"), 3)
        exact = np.array(twisted_loads(twist, 3, end))
        assert np.all(np.abs(loads.forces - exact) <= loads.errors + 1e-13 * np.abs(exact))
        assert [mode.multiplicity for mode in loads.modes] == [2, 2, 2]
    assert twisted_loads(5.0)[0] == pytest.approx(-24.1769211, abs=1e-7)


def test_known_numbers() -> None:
    twist = critical_twist()
    assert twist == pytest.approx(2.0 * brentq(lambda x: math.tan(x) - x, 4.4, 4.6), rel=1e-14)
    assert twist == pytest.approx(8.986818916, abs=1e-9)
    assert free(Problem(0.0, alpha=0.0, twist=twist))[0] == pytest.approx(0.0, abs=1e-11)
    assert free(Problem(0.0))[0] == pytest.approx(-4.0 * PI2, rel=1e-13)
    assert free(Problem(0.0, ends="ball-ball"))[0] == pytest.approx(-PI2, rel=1e-13)
    assert free(Problem(0.0, ends="clamped-loose"))[0] == pytest.approx(-PI2 / 4.0, rel=1e-13)
    for ends in ("clamped-loose", "clamped-free"):  # Greenhill 1881, and 74.628569 of the paper
        assert free(Problem(7.837347438943, alpha=0.0, ends=ends))[0] == pytest.approx(0.0, abs=1e-10)
    assert free(Problem(74.6285690, alpha=0.0))[0] == pytest.approx(0.0, abs=5e-7)
    semi = 2.0 * brentq(lambda x: math.tan(x) + x / 3.0, 1.7, 3.0)  # ball ends, no end force
    assert free(Problem(0.0, twist=semi, ends="ball-ball"))[0] == pytest.approx(0.0, abs=1e-11)
    assert greenhill_load(2.0 * math.pi) == 0.0  # about a fixed axis: another torque, and more of it
    assert semi < 2.0 * math.pi


@pytest.mark.parametrize("ends", ["guided-guided", "clamped-guided"])
def test_sliding_end_leaves_the_string_its_first_eigenvalue(ends: str) -> None:
    """exp(½iT₁s)u′ = exp(iφ) sin πs: one real condition, ∫ x′ ds = 0, which a φ meets. So F = ¼T₁² − π²."""
    for twist in (0.0, 2.0, 7.0):
        assert free(Problem(0.0, twist=twist, ends=ends))[0] == pytest.approx(0.25 * twist**2 - PI2, rel=1e-12)


@pytest.mark.parametrize(
    ("weight", "twist", "ends"),
    [(20.0, 5.0, "clamped-clamped"), (30.0, 4.0, "ball-clamped"), (30.0, 4.0, "pinned-guided"),
     (10.0, 6.0, "ball-pinned"), (12.0, 0.0, "free-clamped"), (9.0, 3.0, "guided-ball"), (5.0, 0.0, "loose-ball")],
)  # fmt: skip
def test_shooting(weight: float, twist: float, ends: str) -> None:
    problem = Problem(weight, alpha=40.0, twist=twist, ends=ends)
    first = loads_without_wall(problem, 2).modes[0]
    size = max(1.0, abs(first.force))
    determinants = [shooting(problem, first.force + step * size) for step in (-2e-3, -1e-3, -1e-7, 1e-7, 1e-3, 2e-3)]
    if first.multiplicity == 1:
        assert determinants[2] * determinants[3] < 0.0
    else:  # a double root: nothing of it is left at the load
        assert abs(shooting(problem, first.force)) < 1e-6 * abs(determinants[0])
        assert determinants[1] * determinants[4] > 0.0


def polynomial_load(problem: Problem, degree: int = 26) -> float:
    """Third method, for clamped ends: Rayleigh–Ritz with s²(1−s)² P_k and complex coefficients."""
    nodes, weights = np.polynomial.legendre.leggauss(degree + 12)
    s, w = 0.5 * (nodes + 1.0), 0.5 * weights
    bump = np.polynomial.Polynomial([0.0, 0.0, 1.0, -2.0, 1.0]).convert(domain=[0.0, 1.0], kind=np.polynomial.Legendre)
    full = [np.polynomial.legendre.Legendre.basis(k, domain=[0.0, 1.0]) * bump for k in range(degree)]
    slope, bend = (np.array([f.deriv(d)(s) / math.sqrt(w @ f.deriv()(s) ** 2) for f in full]) for d in (1, 2))
    torque = (slope * w) @ bend.T
    form = (bend * w) @ bend.T + (slope * w * problem.axial_weight * (s - 1.0)) @ slope.T
    hermitian = form - 0.5j * problem.twist * (torque - torque.T)
    return float(-scipy.linalg.eigh(hermitian, (slope * w) @ slope.T, eigvals_only=True)[0])


@settings(max_examples=20, deadline=None)
@given(weight=st.floats(0.0, 200.0), twist=st.floats(0.0, 20.0), alpha=st.sampled_from([0.0, 35.0, 90.0]))
def test_even_in_twist_and_never_below(weight: float, twist: float, alpha: float) -> None:
    problem = Problem(weight, alpha=alpha, twist=twist)
    load = free(problem)[0]
    assert load == pytest.approx(polynomial_load(problem), rel=1e-8, abs=1e-7)
    assert free(problem.but(twist=-twist))[0] == pytest.approx(load, rel=1e-10, abs=1e-9)
    assert free(problem.but(twist=twist + 0.5))[0] > load  # more twist: less compression
    assert free(problem.but(clearance=0.2))[0] == load


@settings(max_examples=15, deadline=None)
@given(weight=st.floats(0.0, 300.0), ends=st.sampled_from(["clamped-clamped", "clamped-pinned", "guided-pinned"]))
def test_vertical_without_twist_is_the_rod_on_the_wall(weight: float, ends: str) -> None:
    kept = critical_loads(Problem(weight, alpha=0.0, ends=ends), 1)
    assert kept.without_wall.forces[0] == pytest.approx(kept[0].force, rel=1e-11, abs=1e-10)
    assert kept.first_met is kept[0]
    touch = kept.without_wall.at_wall
    assert touch is not None
    assert touch.moves_inward


def test_derivatives() -> None:
    for problem in (Problem(30.0, alpha=40.0, twist=5.0), Problem(30.0, alpha=40.0, twist=5.0, ends="pinned-ball")):
        mode = loads_without_wall(problem).modes[0]
        for over, step in (("weight", 1e-3), ("alpha", 1e-3), ("twist", 1e-4)):
            value = getattr(problem, over)
            ahead, behind = (free(problem.but(**{over: value + h}))[0] for h in (step, -step))
            assert mode.derivative(over) == pytest.approx((ahead - behind) / (2.0 * step), rel=1e-6)
        assert mode.derivative("clearance") == 0.0
    touch = touch_of(Problem(0.0, alpha=0.0, twist=15.0))
    rate = (touch_of(touch.problem.but(twist=15.01)).force - touch_of(touch.problem.but(twist=14.99)).force) / 0.02
    assert touch.derivative("twist") == pytest.approx(rate, rel=1e-5)
    with pytest.raises(InputError, match="poisson"):
        touch.derivative("poisson")


def run(*arguments: str) -> str:
    result = CliRunner().invoke(cli, ["critical", *arguments])
    assert result.exit_code == 0, result.output
    return result.output


def test_critical_says_both_numbers() -> None:
    unpressed = ("--weight", "0", "--alpha", "0", "--twist", "5", "--modes", "1")
    text = run(*unpressed)
    assert text.startswith("Nothing presses this rod to the wall, so twist counts: the rod buckles at\n−24.1769")
    assert "stable up to a compression of 24.1769 B/L²" in text
    data = json.loads(run(*unpressed, "--json"))
    assert data["critical_loads"] == pytest.approx([-24.1769211], abs=1e-7)
    assert data["without_wall"]["loads"] == data["critical_loads"]
    assert data["kept_on_wall"]["loads"] == pytest.approx([-4.0 * PI2], rel=1e-12)
    assert data["tensile_loads"] == []
    pressed = ("--weight", "15", "--alpha", "90", "--twist", "5", "--modes", "1")
    text = run(*pressed)
    assert text.startswith("Twist does not enter while weight keeps the rod on the wall.")
    assert "−24.17692105" in text
    data = json.loads(run(*pressed, "--json"))
    assert data["critical_loads"] == pytest.approx([-111.2334402], abs=5e-8)
    assert data["without_wall"]["loads"] == pytest.approx([-24.1769211], abs=1e-7)
    assert "any end force, not at −39.4784" in run("--weight", "0", "--alpha", "0", "--twist", "8.986818915818128")


def test_rigid_motion_is_said_in_words() -> None:
    text = run("--weight", "0", "--alpha", "90", "--ends", "pinned-free", "--modes", "2")
    assert "mode  1  0   the rod turns as a rigid body" in text
    assert "Any compression turns the straight rod as a rigid body." in text
    assert "e-15" not in text
    assert critical_loads(Problem(0.0, ends="pinned-free"), 1)[0].rigid
    assert loads_without_wall(Problem(0.0, ends="ball-loose")).modes[0].rigid
