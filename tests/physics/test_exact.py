"""Closed forms against the paper's printed values, mpmath, other forms of the same equations, and limits."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell import Problem, coil, critical_loads
from rodwell.errors import NotConvergedError
from rodwell.physics import exact
from rodwell.physics.exact.twisted import SERIES, _rest, twisted_loads

PI2 = math.pi**2

TABLE_1 = """
1 3 8.7668 98.6960 1, 2 4 62.3418 197.3921 1, 1 5 24.3523 256.6097 2, 3 5 219.1705 335.5665 1, 2 6 140.2691 394.7842 2,
4 6 561.0764 513.2194 1, 1 7 47.7305 493.4802 3, 3 7 429.5741 572.4371 2, 5 7 1193.2614 730.3507 1,
2 8 249.3673 671.1331 3, 4 8 997.4691 789.5684 2, 6 8 2244.3055 986.9604 1, 1 9 78.9014 809.3076 4,
3 9 710.1123 888.2644 3, 5 9 1972.5341 1046.1781 2, 7 9 3866.1668 1283.0486 1, 2 10 389.6364 1026.4389 4,
4 10 1558.5455 1144.8741 3, 6 10 3506.7273 1342.2662 2, 8 10 6234.1818 1618.6151 1
"""
"""The paper's Table 1 as printed: n, m, γ_c, −F_c, modal pair."""


@given(st.floats(0.1, 30.0), st.floats(0.01, 30.0))
def test_even_and_odd_factor_make_up_77(k1: float, more: float) -> None:
    k3 = k1 + more
    p, q = 0.5 * (k3 + k1), 0.5 * (k3 - k1)
    odd = exact.odd_factor(q, k1 * k3) * (p - q)
    assert odd == pytest.approx(q * math.sin(p) - p * math.sin(q), abs=1e-11 * p)
    product = -4.0 * exact.even_factor(q, k1 * k3) * odd
    assert product == pytest.approx(exact.buckling_equation(k1, k3), abs=1e-11 * k3**2)


@pytest.mark.parametrize("weight", [0.003, 3.0, 200.0, 3000.0, 1e6])
def test_loads_are_all_the_roots_of_77(weight: float) -> None:
    """As many as a scan of (77) from −2√b down finds, each at a change of sign."""
    loads = np.array(exact.horizontal_loads(weight / 0.01, 6))

    def equation(force: float) -> float:
        return float(exact.buckling_equation(*exact.wavenumbers(force, weight / 0.01)))

    limit = exact.infinite_load(weight, 0.01)
    scan = np.linspace(limit * (1 + 1e-9), 1.0005 * loads[-1] - 0.0005 * limit, 20_001)
    values = np.array([equation(f) for f in scan])
    assert np.sum(values[:-1] * values[1:] < 0.0) == 6
    for load in loads:
        step = 1e-9 * abs(load - limit)
        assert equation(load - step) * equation(load + step) < 0.0


@pytest.mark.parametrize(("pair", "weight"), [(1, 5.0), (1, 15.0), (1, 100.0), (2, 20.0), (2, 30.0), (3, 40.0)])
def test_even_mode_first_between_every_other_switching(pair: int, weight: float) -> None:
    c = math.sqrt(weight / 0.01)
    even, odd = exact.pair_loads(pair, c)
    assert exact.even_first(pair, c) == (even > odd)
    assert max(even, odd) > -(4.0 * pair**2 * PI2 + 2.0 * c) > min(even, odd)


def test_table_1_of_the_paper() -> None:
    rows = [row.split() for row in TABLE_1.replace("\n", " ").split(",")]
    computed = exact.switchings(10, 0.01)
    assert len(rows) == len(computed) == 20
    for n, m, weight, load, pair in rows:
        (row,) = [item for item in computed if (item.n, item.m) == (int(n), int(m))]
        assert f"{row.weight:.4f}" == weight
        assert f"{-row.force:.4f}" == load
        assert row.pair == int(pair)
        q, c = 0.5 * (row.m - row.n) * math.pi, math.sqrt(row.weight / 0.01)
        assert exact.load_of_q(q, c) == pytest.approx(row.force, rel=1e-14)
        assert abs(exact.even_factor(q, c)) < 1e-12 * c
        assert abs(exact.odd_factor(q, c)) < 1e-12 * c
    with pytest.raises(ValueError, match="both even or both odd"):
        exact.switching(1, 4, 0.01)


@pytest.mark.parametrize("on_top", [False, True])
@pytest.mark.parametrize("ends", [("clamped", "clamped"), ("pinned", "clamped"), ("clamped", "guided"),
                                  ("pinned", "pinned"), ("guided", "pinned")])  # fmt: skip
@pytest.mark.parametrize("foundation", [1e-6, 3.0, 900.0, 2e5])
def test_horizontal_loads_solve_the_end_conditions(foundation: float, ends: tuple[str, str], on_top: bool) -> None:
    """The 4 × 4 determinant of e^{κs} and its derivatives at the ends (mpmath) changes sign at each load."""
    b = -foundation if on_top else foundation
    rows = {"clamped": (0, 1), "pinned": (0, 2), "guided": (1, 3)}  # guided: y' = 0 and no shear, so y''' = 0

    def determinant(force: float) -> mpmath.mpf:
        with mpmath.workdps(160):
            root = mpmath.sqrt(mpmath.mpf(force) ** 2 - 4 * mpmath.mpf(b))
            kappa = [s * mpmath.sqrt((force + t * root) / 2) for s in (1, -1) for t in (1, -1)]
            lines = [[k**d for k in kappa] for d in rows[ends[0]]]
            lines += [[k**d * mpmath.exp(k) for k in kappa] for d in rows[ends[1]]]
            vandermonde = mpmath.det(mpmath.matrix([[k**d for k in kappa] for d in range(4)]))
            return mpmath.re(mpmath.det(mpmath.matrix(lines)) / vandermonde)

    for load in exact.horizontal_loads(foundation, 3, ends, on_top=on_top):
        step = 1e-9 * (abs(load) + 40.0)
        assert determinant(load - step) * determinant(load + step) < 0.0


def test_guided_ends_as_pinned_ones() -> None:
    """cos nπs solves (64) with guided ends as sin nπs does with pinned ones."""
    assert exact.horizontal_loads(700.0, 4, ("guided", "guided")) == exact.horizontal_loads(700.0, 4, ("pinned",) * 2)
    loads = sorted((-(n**2 * PI2 + 700.0 / (n**2 * PI2)) for n in range(1, 40)), reverse=True)
    assert exact.sine_loads(700.0, 4) == pytest.approx(loads[:4], rel=1e-14)
    heavy = sorted((-(n**2 * PI2 + 1e8 / (n**2 * PI2)) for n in range(1, 400)), reverse=True)
    assert exact.sine_loads(1e8, 6) == pytest.approx(heavy[:6], rel=1e-14)


@pytest.mark.parametrize(
    ("ends", "multiples"),
    [
        (("clamped", "clamped"), [4.0, 8.1830, 16.0]),
        (("clamped", "pinned"), [2.0457, 6.0468]),
        (("guided", "clamped"), [1.0, 4.0, 9.0]),
        (("clamped", "free"), [0.25, 2.25]),
        (("pinned", "pinned"), [1.0, 4.0]),
        (("pinned", "guided"), [0.25, 2.25]),
        (("free", "pinned"), [0.0, 1.0, 4.0]),
        (("free", "free"), [0.0, 1.0]),
        (("guided", "guided"), [1.0, 4.0]),
        (("free", "guided"), [0.25, 2.25]),
    ],
)
def test_weightless_columns(ends: tuple[str, str], multiples: list[float]) -> None:
    """−F/π² (Timoshenko and Gere, section 2.2)."""
    loads = exact.weightless_loads(len(multiples), ends)
    assert [-load / PI2 for load in loads] == pytest.approx(multiples, abs=5e-5)


@pytest.mark.parametrize(("force", "weight"), [(-20.0, 60.0), (14.0, 100.0), (-150.0, 30.0), (0.0, 200.0)])
def test_airy_determinants_against_mpmath(force: float, weight: float) -> None:
    """(86) and (88) with Ai, Bi and Gi of mpmath, and integrals by quadrature."""
    with mpmath.workdps(25):
        w, f = mpmath.mpf(weight), mpmath.mpf(force)
        t = [(f / w - 1) * mpmath.cbrt(w), f / mpmath.cbrt(w) ** 2]
        functions = (mpmath.airyai, mpmath.airybi, mpmath.scorergi)
        rows = [[function(x) for function in functions] for x in t]
        rows.append([mpmath.quad(function, mpmath.linspace(t[0], t[1], 6)) for function in functions])
        full, sway = mpmath.det(mpmath.matrix(rows)), rows[0][0] * rows[1][1] - rows[1][0] * rows[0][1]
    assert exact.as_float(exact.scorer_determinant, force, weight) == pytest.approx(float(full), rel=1e-11)
    assert exact.as_float(exact.sway_determinant, force, weight) == pytest.approx(float(sway), rel=1e-13)


@given(st.floats(0.5, 500.0))
@settings(max_examples=40)
def test_bessel_form_of_88(weight: float) -> None:
    """Both sides of (88) at F = 0: with Γ(⅔), not its square as printed."""
    airy = exact.as_float(exact.sway_determinant, 0.0, weight)
    assert exact.as_float(exact.sway_bessel, weight) == pytest.approx(airy, rel=1e-12, abs=1e-14)


def test_weights_without_end_force() -> None:
    """(87), with the second root corrected; (88); section 4.3; L_cr; 1.58 in section 5."""
    clamped, sway = exact.self_weights(3), exact.sway_weights(3)
    assert [f"{w:.6f}" for w in clamped] == ["74.628569", "157.032780", "325.513452"]
    assert f"{sway[0]:.6f}" == "18.956266"
    assert [f"{w:.4f}" for w in exact.weights_on_top(3, 0.01)] == ["5.0056", "38.0354", "146.1763"]
    for weight in clamped:
        forces = critical_loads(Problem(weight, alpha=0.0), 3).forces
        assert np.min(np.abs(forces)) < 1e-9
    for weight in sway:
        forces = critical_loads(Problem(weight, alpha=0.0, ends=("clamped", "guided")), 3).forces
        assert np.min(np.abs(forces)) < 1e-9
    length = exact.critical_length(2.0, 5.0)
    assert 5.0 * length**3 / 2.0 == pytest.approx(74.6285687190407, rel=1e-13)
    assert f"{(clamped[0] / sway[0]) ** (1 / 3):.2f}" == "1.58"
    with pytest.raises(NotConvergedError, match="bits are needed"):
        exact.as_float(exact.scorer_determinant, -400.0, 0.5)


def test_lines_79_are_chords_and_half_is_the_tangent() -> None:
    assert f"{exact.chord_slope(1):.4f}" == "0.5290"
    assert f"{exact.chord_slope(2):.4f}" == "0.5143"
    light, none = (critical_loads(Problem(w, alpha=0.0), 2, rtol=1e-11).forces for w in (1e-2, 0.0))
    assert (light - none) / 1e-2 == pytest.approx([exact.tangent_slope()] * 2, abs=1e-5)


@pytest.mark.parametrize("eta", [0.05, 0.3, 0.48])
def test_weightless_helix(eta: float) -> None:
    """The load makes the energy per length stationary; shape and pressure are those that the solver finds there."""
    radius = math.sin(eta) / (2.0 * math.pi)  # one turn on the length 1
    helix = exact.weightless_helix(eta, radius)

    def energy(angle: float) -> float:
        return exact.coil_energy(math.sin(angle) / radius, helix.force, 0.0, radius)

    slope = (energy(eta + 1e-5) - energy(eta - 1e-5)) / 2e-5
    assert abs(slope) < 1e-6 * abs(helix.force)
    problem = Problem(0.0, clearance=radius, turns=1, ends=("pinned", "pinned"))
    state = coil(problem, until=1.02 * helix.force).at(helix.force)
    fields = state.fields()
    assert np.asarray(fields["contact_pressure"]) == pytest.approx(helix.pressure, rel=1e-6)
    assert np.sin(fields["eta"]) == pytest.approx(math.sin(eta), rel=1e-8)
    assert np.asarray(fields["omega2"]) == pytest.approx(0.0, abs=1e-6)
    assert helix.rate == pytest.approx(2.0 * math.pi, rel=1e-12)


def test_helix_in_the_limit_of_small_slope() -> None:
    """F = −2θ'² and p = −ΔF²/(4B) (Lubinski and Woods; Mitchell); the largest compression is 4/(3√3) B/Δ²."""
    helix = exact.weightless_helix(0.01, 0.02)
    assert helix.force == pytest.approx(-2.0 * helix.rate**2, rel=1e-4)
    assert helix.pressure == pytest.approx(-0.02 * helix.force**2 / 4.0, rel=3e-4)
    angles = np.linspace(0.0, 1.5, 3001)
    loads = np.array([exact.weightless_helix(eta, 1.0).force for eta in angles])
    assert -loads.min() == pytest.approx(4.0 / (3.0 * math.sqrt(3.0)), rel=1e-6)
    assert angles[np.argmin(loads)] == pytest.approx(exact.STEEPEST, abs=1e-3)


def test_equal_energy_of_long_coils() -> None:
    """Least over the winding rate: 2√2 √(wₗ/Δ), √2 times the lateral buckling load (Chen, Lin and Cheatham)."""
    weight, radius = 300.0, 1e-3
    load, rate = exact.least_equal_energy_load(weight, radius)
    assert load == pytest.approx(math.sqrt(2.0) * exact.infinite_load(weight, radius), rel=1e-14)
    rates = rate * np.linspace(0.5, 2.0, 301)
    loads = [exact.equal_energy_load(q, weight, radius, small_slope=True) for q in rates]
    assert max(loads) == pytest.approx(load, rel=1e-14)
    assert rates[np.argmax(loads)] == pytest.approx(rate, rel=1e-12)
    steep = exact.equal_energy_load(rate, weight, radius)
    assert steep == pytest.approx(load, rel=(radius * rate) ** 2)
    assert exact.coil_energy(rate, steep, weight, radius) == pytest.approx(0.0, abs=1e-10 * abs(steep))


def test_equal_energy_of_coils_that_the_solver_finds() -> None:
    """Pinned ends: the uniform coil is one of the rod's shapes, so its load bounds the true one from the far side."""
    problem = Problem(15.0, turns=1, ends=("pinned", "pinned"))
    (point,) = [p for p in coil(problem).special_points if p.kind == "equal_energy"]
    bound = exact.equal_energy_load(2.0 * math.pi, 15.0, 0.01)
    assert bound < point.force < 0.85 * bound


@pytest.mark.parametrize(
    ("ends", "wavenumbers"),
    [("ball", [math.pi, 2.0 * math.pi, 3.0 * math.pi]), ("clamped", [2.0 * math.pi, 8.986818916, 4.0 * math.pi])],
)
def test_loads_of_a_twisted_rod_without_twist_are_those_of_the_column(ends: str, wavenumbers: list[float]) -> None:
    """Roots of sin k, and of sin ½k (½k cos ½k − sin ½k) (Timoshenko & Gere, *Theory of Elastic Stability*, 2.4)."""
    assert twisted_loads(0.0, 3, ends) == pytest.approx([-k * k for k in wavenumbers], rel=1e-9)


@given(st.floats(-SERIES, SERIES))
def test_series_of_the_determinant_is_its_closed_form(k: float) -> None:
    with mpmath.workdps(60):
        x = mpmath.mpf(k)
        exact_value = (x * mpmath.cos(x / 2) - 2 * mpmath.sin(x / 2)) / x**3 if abs(k) > 1e-12 else -mpmath.mpf(1) / 12
        assert _rest(k) == pytest.approx(float(exact_value), rel=1e-14)
