"""Critical loads against the paper's closed forms, and against an independent method for every inclination."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import scipy.linalg
import scipy.special
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from rodwell import Problem, critical_loads

PI2 = math.pi**2


def equation_77(k1: float, k3: float) -> float:
    return 2.0 * k1 * k3 * (1.0 - math.cos(k1) * math.cos(k3)) - (k1**2 + k3**2) * math.sin(k1) * math.sin(k3)


def by_77(force: float, weight: float, clearance: float) -> float:
    """Left side of (77) for the wavenumbers (75) at the load F."""
    root = math.sqrt(force**2 - 4.0 * weight / clearance)
    return equation_77(math.sqrt((-force - root) / 2.0), math.sqrt((-force + root) / 2.0))


def polynomial_loads(problem: Problem, degree: int) -> np.ndarray:
    """Second method: Rayleigh–Ritz with clamped Legendre polynomials s²(1−s)² P_k, dense; all loads, falling."""
    nodes, weights = np.polynomial.legendre.leggauss(degree + 12)
    s, w = 0.5 * (nodes + 1.0), 0.5 * weights
    values = np.zeros((3, degree, s.size))
    for k in range(degree):
        p = np.polynomial.legendre.Legendre.basis(k, domain=[0.0, 1.0])
        bump = np.polynomial.Polynomial([0.0, 0.0, 1.0, -2.0, 1.0])
        full = p * bump.convert(domain=[0.0, 1.0], kind=np.polynomial.Legendre)
        norm = math.sqrt(w @ full.deriv()(s) ** 2)
        for d in range(3):
            values[d, k] = (full.deriv(d) if d else full)(s) / norm
    foundation = problem.foundation / problem.clearance
    stiffness = (values[2] * w) @ values[2].T + foundation * (values[0] * w) @ values[0].T
    stiffness += (values[1] * w * problem.axial_weight * (s - 1.0)) @ values[1].T
    gram = (values[1] * w) @ values[1].T
    return -scipy.linalg.eigh(stiffness, gram, eigvals_only=True)


def test_weightless_column() -> None:
    """k = 2nπ, and tan(k/2) = k/2 (after (77))."""
    even = [brentq(lambda k: math.tan(k / 2) - k / 2, lo * math.pi + 1e-6, hi * math.pi - 1e-6)
            for lo, hi in ((2.2, 3.0), (4.5, 5.0))]  # fmt: skip
    expected = -np.array([4 * PI2, even[0] ** 2, 16 * PI2, even[1] ** 2])
    loads = critical_loads(Problem(0.0), 4)
    assert loads.forces == pytest.approx(expected, rel=1e-10)
    assert loads.forces[:2] == pytest.approx([-39.4784176, -80.7629142], abs=5e-8)
    assert [mode.parity for mode in loads] == [1, -1, 1, -1]


def test_horizontal_w15() -> None:
    assert critical_loads(Problem(15.0), 2).forces == pytest.approx([-111.2334402, -127.2577803], abs=5e-8)


@pytest.mark.parametrize("weight", [0.01, 1.0, 5.0, 15.0, 62.0, 140.0, 1000.0, 1e4])
def test_loads_are_roots_of_77(weight: float) -> None:
    for mode in critical_loads(Problem(weight), 4):
        step = 1e-10 * abs(mode.force)
        assert by_77(mode.force - step, weight, 0.01) * by_77(mode.force + step, weight, 0.01) < 0.0


@pytest.mark.parametrize("weight", [3.0, 200.0, 3000.0])
def test_no_root_of_77_is_skipped(weight: float) -> None:
    loads = critical_loads(Problem(weight), 6).forces
    scan = np.linspace(-2.0 * math.sqrt(weight / 0.01) * (1 + 1e-9), 1.0001 * loads[-1], 40_001)
    values = np.array([by_77(f, weight, 0.01) for f in scan])
    assert np.sum(values[:-1] * values[1:] < 0.0) == 6


@pytest.mark.parametrize(("n", "m"), [(1, 3), (2, 4), (1, 5), (3, 5), (2, 6), (8, 10)])
def test_exact_double_roots(n: int, m: int) -> None:
    """(78), Table 1: both modes at (n² + m²)π², one even and one odd."""
    loads = critical_loads(Problem(n**2 * m**2 * math.pi**4 * 0.01), 6)
    pair = [mode for mode in loads if mode.force == pytest.approx(-(n**2 + m**2) * PI2, rel=1e-10)]
    assert sorted(mode.parity for mode in pair) == [-1, 1]


def airy_determinant(force: float, weight: float) -> float:
    """(86) with t₁ as defined at s = 0; the third column is a particular solution of (81), by quadrature."""
    cube = weight ** (1.0 / 3.0)
    t = [(force / weight - 1.0) * cube, force / weight * cube]

    def ai(x: float) -> float:
        return float(scipy.special.airy(x)[0])

    def bi(x: float) -> float:
        return float(scipy.special.airy(x)[2])

    nodes, weights = np.polynomial.legendre.leggauss(60)

    def integral(f: Callable[[float], float], a: float, b: float) -> float:
        half = 0.5 * (b - a)
        return half * sum(w * f(a + half * (x + 1.0)) for x, w in zip(nodes, weights, strict=True))

    def particular(x: float) -> float:
        return math.pi * (bi(x) * integral(ai, t[0], x) - ai(x) * integral(bi, t[0], x))

    rows = [[ai(x), bi(x), particular(x)] for x in t]
    rows.append([integral(f, *t) for f in (ai, bi, particular)])
    return float(np.linalg.det(np.array(rows)))


@pytest.mark.parametrize("weight", [74.628569, 157.032780, 325.513452])
def test_vertical_self_buckling_weights(weight: float) -> None:
    """(87), the second root with its last digit corrected."""
    loads = critical_loads(Problem(weight, alpha=0.0), 3).forces
    assert np.min(np.abs(loads)) < 5e-7 * 0.6


@pytest.mark.parametrize("mode", [1, 2, 3])
def test_vertical_loads_are_roots_of_the_airy_determinant(mode: int) -> None:
    force = critical_loads(Problem(100.0, alpha=0.0), 3)[mode - 1].force
    assert airy_determinant(force - 1e-6, 100.0) * airy_determinant(force + 1e-6, 100.0) < 0.0


def test_vertical_w100_buckles_in_tension() -> None:
    assert critical_loads(Problem(100.0, alpha=0.0), 1).forces[0] == pytest.approx(14.3626, abs=5e-5)


def test_two_degrees_from_the_vertical_first_load_vanishes() -> None:
    below, above = (critical_loads(Problem(w, alpha=2.0), 1).forces[0] for w in (125.945, 125.955))
    assert below < 0.0 < above


@pytest.mark.parametrize("weight", [5.0056, 38.0354, 146.1763])
def test_rod_on_top_buckles_without_force(weight: float) -> None:
    """cos x cosh x = 1 with x = (w/Δ)^¼ (paper, section 4.3)."""
    x = (weight / 0.01) ** 0.25
    root = brentq(lambda y: math.cos(y) - 1.0 / math.cosh(y), 0.98 * x, 1.02 * x)
    exact = 0.01 * root**4
    assert exact == pytest.approx(weight, abs=5e-5)
    assert np.min(np.abs(critical_loads(Problem(exact, on_top=True), 3).forces)) < 1e-7


@settings(max_examples=40)
@given(
    st.floats(0.0, 3000.0),
    st.floats(0.0, 90.0),
    st.floats(1e-3, 0.05),
    st.booleans(),
    st.integers(1, 6),
)
def test_loads_agree_with_a_second_method(w: float, alpha: float, clearance: float, top: bool, count: int) -> None:
    problem = Problem(w, alpha=alpha, clearance=clearance, on_top=top)
    loads = critical_loads(problem, count)
    expected = polynomial_loads(problem, 70)[:count]
    size = np.abs(expected) + problem.axial_weight
    assert np.all(np.abs(loads.forces - expected) <= 1e-8 * size)
    assert np.all(np.diff(loads.forces) <= 0.0)


def test_twist_does_not_enter() -> None:
    plain, twisted = (critical_loads(Problem(40.0, alpha=70.0, twist=t), 3).forces for t in (0.0, 7.0))
    assert np.array_equal(plain, twisted)


def test_clearance_does_not_enter_for_a_vertical_cylinder() -> None:
    a, b = (critical_loads(Problem(100.0, alpha=0.0, clearance=d), 2).forces for d in (1e-3, 0.3))
    assert a == pytest.approx(b, rel=1e-12)


def test_errors_are_honest_and_meet_the_tolerance() -> None:
    sharp = critical_loads(Problem(300.0, alpha=50.0), 4, rtol=1e-11)
    for rtol in (1e-3, 1e-6, 1e-8):
        rough = critical_loads(Problem(300.0, alpha=50.0), 4, rtol=rtol)
        assert np.all(np.abs(rough.forces - sharp.forces) <= rough.errors + sharp.errors)
        assert np.all(rough.errors <= rtol * (np.abs(rough.forces) + 340.0))


@pytest.mark.parametrize(("weight", "clearance"), [(1e7, 1e-4), (1e8, 1e-4)])
def test_long_string_tends_to_the_infinite_beam_on_a_foundation(weight: float, clearance: float) -> None:
    """−F → 2√(w/Δ) from above as w/Δ grows (limit of (77)); near-degenerate pairs, none skipped."""
    first = critical_loads(Problem(weight, clearance=clearance), 4)
    limit = 2.0 * math.sqrt(weight / clearance)
    assert np.all(-first.forces / limit > 1.0)
    assert -first.forces[0] / limit == pytest.approx(1.0, abs=2e-4)
    step = 1e-10 * abs(first[0].force)
    assert by_77(first[0].force - step, weight, clearance) * by_77(first[0].force + step, weight, clearance) < 0.0


def test_modes_solve_the_boundary_conditions() -> None:
    """(65), and the sign that the paper draws: y''(1) > 0, so ω₂(1) < 0."""
    for mode in critical_loads(Problem(15.0, alpha=40.0), 4):
        ends = mode.space.evaluate(mode.coefficients, np.array([0.0, 1.0]), 3)
        assert np.max(np.abs(ends[:2])) < 1e-12
        assert ends[2, 1] > 0.0
        assert np.max(np.abs(mode.shape(np.linspace(0, 1, 101)))) == pytest.approx(1.0, abs=1e-2)


def test_close_loads_that_the_meshes_count_differently() -> None:
    """Next to the double point n = 2, m = 8 of Table 1 coarse and fine mesh return different numbers of loads."""
    problem = Problem(249.36727304704394)
    loads = critical_loads(problem, 7)
    assert len(loads) == 7
    assert loads[5].force == pytest.approx(-68.0 * np.pi**2, rel=1e-9)  # −(n² + m²)π²
    assert loads[4].force == pytest.approx(loads[5].force, rel=1e-9)
