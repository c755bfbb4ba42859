"""Formulas of practice: printed examples, limits between them, and the exact theory where it has the same load."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from steel_case import STEEL

import rodwell
from rodwell.errors import InputError
from rodwell.formulas import FORMULAS, FormulaInputs, helix, inclined, path, pushing, vertical

# Field example: 5 in × 4.276 in, 19.5 lbf/ft, hole 8.5 in, mud of 10 lb/gal, E 30e6 psi; in lbf and in
FIELD_I = math.pi / 64.0 * (5.0**4 - 4.276**4)
FIELD = {"B": 30e6 * FIELD_I, "w": path.buoyed_weight_in_mud(19.5 / 12.0, 10.0), "r": 1.75}


def test_steel_case_of_wicks_to_printed_digits() -> None:
    assert round(inclined.dawson_paslay(**STEEL) / 1e3, 1) == 251.8
    assert round(inclined.long_pipe(**STEEL), 1) == 150.6
    assert round(helix.torque_parameter(STEEL["B"], 100e3, 20e3), 4) == 0.0623
    assert round(pushing.total_lock_up(STEEL["B"], 315.0, STEEL["r"], 0.3)) == 5653


def test_helical_load_of_wicks_needs_the_digits_that_its_inputs_lack() -> None:
    """356.2 kN is printed. The inputs as printed give 356.147; one part in 10⁵ more weight gives 356.15 and more."""
    assert inclined.chen_lin_cheatham(**STEEL) / 1e3 == pytest.approx(356.147, abs=5e-4)
    assert round(inclined.chen_lin_cheatham(**{**STEEL, "w": 315.01}) / 1e3, 1) == 356.2
    assert round(inclined.chen_lin_cheatham_finite(**STEEL, L=1000.0) / 1e3, 1) == 356.2
    assert round(inclined.dawson_paslay(**{**STEEL, "w": 315.01}) / 1e3, 1) == 251.8


def test_field_example_to_printed_digits() -> None:
    assert round(FIELD_I, 3) == 14.269
    assert round(FIELD["w"], 4) == 1.3769
    found = [round(inclined.dawson_paslay(**FIELD, alpha=alpha)) for alpha in (90.0, 60.0, 30.0)]
    assert found == [36_705, 34_158, 25_954]
    assert round(inclined.chen_lin_cheatham(**FIELD, alpha=90.0)) == 51_908
    assert round(1.83 * inclined.dawson_paslay(**FIELD, alpha=90.0)) == 67_170  # the factor as printed, 1.83
    assert round(inclined.wu_juvkam_wold(**FIELD, alpha=90.0)) == 67_112  # the closed form, 2√2·2 − 2 over 2
    B, w = FIELD["B"], FIELD["w"]
    loads = [vertical.lubinski, vertical.wu_vertical_sinusoidal, vertical.wu_vertical_helical, vertical.long_hanging]
    assert [round(load(B, w)) for load in loads] == [1_810, 2_379, 5_177, 950]


def test_dellinger_values() -> None:
    found = [round(inclined.dellinger(1.0, w, 90.0, 0.01), 1) for w in (40.0, 140.0, 280.0)]
    assert found == [149.1, 286.4, 411.0]
    assert round(inclined.dellinger(1.0, 280.0, 30.0, 0.01), 1) == 303.8


def test_factors_between_the_helical_loads() -> None:
    sinusoidal = inclined.dawson_paslay(**STEEL)
    chen, wu = inclined.chen_lin_cheatham(**STEEL), inclined.wu_juvkam_wold(**STEEL)
    assert chen / sinusoidal == pytest.approx(math.sqrt(2.0), rel=1e-14)
    assert 0.5 * (wu + sinusoidal) == pytest.approx(chen, rel=1e-14)  # Chen's is the mean load of the transition
    assert round(wu / sinusoidal, 1) == 1.8
    assert round(wu / chen, 1) == 1.3
    assert round(inclined.mitchell_1997(**STEEL) / sinusoidal * 2.0, 2) == 5.66
    assert round(inclined.qiu(**STEEL) / sinusoidal * 2.0, 2) == 3.68
    assert inclined.mitchell_loading(**STEEL) == pytest.approx(2.0 * inclined.mitchell_unloading(**STEEL), rel=1e-14)
    assert inclined.mitchell_unloading(**STEEL) == pytest.approx(1.4 * sinusoidal, rel=1e-14)
    assert inclined.unsupported_end(**STEEL) / inclined.long_pipe(**STEEL) == pytest.approx(2.9 / 37.2, rel=1e-14)


@pytest.mark.parametrize(("finite", "long"), [("paslay_bogy", "dawson_paslay"),
                                              ("chen_lin_cheatham_finite", "chen_lin_cheatham")])  # fmt: skip
def test_finite_formulas_tend_to_the_long_ones(finite: str, long: str) -> None:
    limit = FORMULAS[long].function(**STEEL)
    for length, gap in ((300.0, 1e-2), (3e3, 1e-4), (3e5, 1e-8)):
        value = FORMULAS[finite].function(**STEEL, L=length)
        assert limit <= value <= limit * (1.0 + gap)


def test_paslay_bogy_takes_the_best_number_of_half_waves() -> None:
    rod = {"B": 1.0, "w": 700.0, "alpha": 70.0, "r": 0.02, "L": 1.0}
    lateral = 700.0 * math.sin(math.radians(70.0))
    every = [(n * math.pi) ** 2 + lateral / ((n * math.pi) ** 2 * 0.02) for n in range(1, 30)]
    assert inclined.paslay_bogy(**rod) == pytest.approx(min(every), rel=1e-14)
    helices = [(2 * m * math.pi) ** 2 + lateral / (2 * (m * math.pi) ** 2 * 0.02) for m in range(1, 30)]
    assert inclined.chen_lin_cheatham_finite(**rod) == pytest.approx(min(helices), rel=1e-14)


@pytest.mark.parametrize("weight", [0.0, 15.0, 140.0, 1000.0])
def test_paslay_bogy_is_exact_for_a_pinned_horizontal_rod(weight: float) -> None:
    problem = rodwell.Problem(weight, alpha=90, ends=("pinned", "pinned"))
    exact = -rodwell.critical_loads(problem, 1)[0].force
    assert inclined.paslay_bogy(1.0, weight, 90.0, 0.01, 1.0) == pytest.approx(exact, rel=1e-9)


@given(st.floats(1.0, 3e3), st.floats(0.0, 90.0))
def test_paslay_bogy_at_the_middle_is_an_upper_bound(weight: float, alpha: float) -> None:
    """Half sines see the mean force: Rayleigh's quotient at the middle, so no pinned rod bears more."""
    problem = rodwell.Problem(weight, alpha=alpha, ends=("pinned", "pinned"))
    mode = rodwell.critical_loads(problem, 1)[0]
    middle = -mode.force + 0.5 * problem.axial_weight
    assert middle <= inclined.paslay_bogy(1.0, weight, alpha, 0.01, 1.0) * (1.0 + 1e-9) + mode.error


def test_he_kyllingstad() -> None:
    B, w, r, alpha = STEEL["B"], 315.0, STEEL["r"], 50.0
    straight = inclined.dawson_paslay(B, w, alpha, r)
    assert path.he_kyllingstad(B, w, alpha, r, 0.0, 0.0) == pytest.approx(straight, rel=1e-14)
    assert path.he_kyllingstad_helical(B, w, alpha, r, 0.0, 0.0) == pytest.approx(math.sqrt(2.0) * straight, rel=1e-14)
    for radius in (1e8, 300.0, 100.0):
        lateral = w * math.sin(math.radians(alpha))
        closed = 2.0 * B / (r * radius) * (1.0 + math.sqrt(1.0 + lateral * r * radius**2 / B))
        assert path.he_kyllingstad(B, w, alpha, r, 1.0 / radius, 0.0) == pytest.approx(closed, rel=1e-12)
    for build, turn in ((-1 / 400.0, 0.0), (-1 / 90.0, 1 / 200.0), (0.01, -0.02), (0.0, 0.03)):  # drop, and sideways
        for beta, load in ((4.0, path.he_kyllingstad), (8.0, path.he_kyllingstad_helical)):
            force = load(B, w, alpha, r, build, turn)
            contact = path.path_contact_force(w, alpha, force, build, turn)
            assert force**2 == pytest.approx(beta * B / r * contact, rel=1e-11)
            lower = np.linspace(1e-3, 0.999, 200) * force  # none smaller
            gaps = [f * f - beta * B / r * path.path_contact_force(w, alpha, f, build, turn) for f in lower]
            assert max(gaps) < 0.0
    assert path.he_kyllingstad(B, 0.0, 0.0, r, 0.003, 0.004) == pytest.approx(4.0 * B / r * 0.005, rel=1e-12)


def test_gao_miska() -> None:
    assert [round(path.sinusoidal_friction(mu), 3) for mu in (0.1, 0.2, 0.3)] == [1.285, 1.481, 1.666]
    unit = inclined.dawson_paslay(**STEEL)
    assert [round(path.gao_miska_helical(**STEEL, mu=mu) / unit, 3) for mu in (0.1, 0.2, 0.3)] == [1.579, 1.786, 2.062]
    assert path.gao_miska(**STEEL, mu=0.0) == unit
    assert path.gao_miska(**STEEL, mu=1e-9) == pytest.approx(unit, rel=1e-5)
    assert path.gao_miska_helical(**STEEL, mu=0.0) == pytest.approx(inclined.chen_lin_cheatham(**STEEL), rel=1e-14)
    assert path.gao_miska_helical(**STEEL, mu=0.7) == math.inf  # past the pole the root would turn real again or fail


def test_vertical_numbers_are_those_of_the_energy_method() -> None:
    """2.55: least load of a half sine over its length. 5.55: twice the like for a helix, less the former."""
    lengths = np.linspace(2.0, 8.0, 60_001)
    sinusoidal = float(np.min(math.pi**2 / lengths**2 + 0.5 * lengths))
    helical = float(np.min(4.0 * math.pi**2 / lengths**2 + 0.5 * lengths))
    assert round(sinusoidal, 2) == 2.55
    assert sinusoidal == pytest.approx(0.75 * (4.0 * math.pi**2) ** (1 / 3), rel=1e-8)
    assert round(2.0 * helical - sinusoidal, 2) == 5.55
    assert vertical.wu_vertical_sinusoidal(1.0, 1.0) == 2.55
    assert vertical.wu_vertical_helical(1.0, 1.0) == 5.55
    length = float(lengths[np.argmin(math.pi**2 / lengths**2 + 0.5 * lengths)])
    exact = -rodwell.critical_loads(rodwell.Problem(length**3, alpha=0, ends="pinned-pinned"), 1)[0].force
    assert (exact + length**3) / length**2 < sinusoidal  # Rayleigh's quotient is an upper bound
    assert vertical.oyedokun_torque(1.0, 1.0) == pytest.approx(3.0 * math.pi / length, rel=1e-4)


def test_columns_against_exact_loads() -> None:
    from scipy.special import ai_zeros

    assert pytest.approx(-ai_zeros(1)[1][0], rel=1e-14) == vertical.HANGING
    size = 12.0
    exact = rodwell.critical_loads(rodwell.Problem(size**3, alpha=0, ends="pinned-free"), 1)[0].force
    assert vertical.long_hanging(1.0, size**3) == pytest.approx(size**3 - exact, rel=1e-9)
    for ends, length in (("clamped-clamped", vertical.tallest_clamped), ("clamped-guided", vertical.tallest_swaying)):
        problem = rodwell.Problem(length(1.0, 1.0) ** 3, alpha=0, ends=ends)
        assert rodwell.critical_loads(problem, 1)[0].force == pytest.approx(0.0, abs=1e-6)
    for weight, gap in ((0.0, 1e-10), (40.0, 0.7), (74.628569, 1e-2)):
        exact = rodwell.critical_loads(rodwell.Problem(weight, alpha=0), 1)[0].force
        assert vertical.clamped_vertical(1.0, weight, 1.0) == pytest.approx(-exact, abs=gap)
    on_top = rodwell.Problem(inclined.heaviest_on_top(1.0, 0.01, 1.0), on_top=True)
    assert on_top.weight == pytest.approx(5.0056, abs=5e-5)
    assert rodwell.critical_loads(on_top, 1)[0].force == pytest.approx(0.0, abs=1e-6)
    assert inclined.euler_clamped(1.0, 1.0) == pytest.approx(-rodwell.critical_loads(rodwell.Problem(0), 1)[0].force)


def _coil_pressure(twist: float, clearance: float) -> tuple[float, float]:
    """Compression and exact contact force of a weightless coil of one turn, free to rotate, under twist."""
    q = 2.0 * math.pi
    force = helix.twisted_helix_force(1.0, twist, 1.0)
    assert force == pytest.approx(2.0 * q * q - 1.5 * twist * q)
    problem = rodwell.Problem(0, clearance=clearance, twist=twist, turns=1, ends=("pinned", "pinned"))
    state = rodwell.equilibrium(problem, -force)
    return force, -float(state.fields(np.array([0.5]))["contact_pressure"][0])


@pytest.mark.parametrize("twist", [-3.0, 0.0, 3.0])
def test_contact_force_of_a_twisted_helix_is_that_of_the_exact_coil(twist: float) -> None:
    for clearance, gap in ((1e-3, 1e-4), (1e-4, 1e-6)):
        force, exact = _coil_pressure(twist, clearance)
        assert helix.twisted_helix_contact(1.0, clearance, force, twist) == pytest.approx(exact, rel=gap)
        if twist == 0.0:
            assert helix.helical_contact(1.0, clearance, force) == pytest.approx(exact, rel=gap)
            continue
        root = math.sqrt(9.0 * twist**2 + 32.0 * force)  # the form that is left out
        refuted = clearance * force / 128.0 * (3.0 * twist + root) * (twist + root)
        assert abs(refuted / exact - 1.0) > 0.2


def test_sinusoidal_contact_force_is_the_exact_one_at_small_amplitude() -> None:
    clearance, n = 1e-3, 3
    problem = rodwell.Problem(clearance * (n * math.pi) ** 4, clearance=clearance, ends=("pinned", "pinned"))
    modes = rodwell.critical_loads(problem, 1)
    branch = rodwell.follow(problem, modes[0], until=modes[0].force - 1.0)
    s = np.linspace(0.05, 0.95, 19)
    state = branch[-1]
    theta, pressure = state.fields(s)["xi2"], -state.fields(s)["contact_pressure"]
    beta = float(np.dot(theta, np.sin(n * math.pi * s)) / np.dot(np.sin(n * math.pi * s), np.sin(n * math.pi * s)))
    assert 0.02 < abs(beta) < 0.6
    formula = [
        helix.sinusoidal_contact(1.0, problem.weight, 90.0, clearance, -state.force, 2.0 / n, beta, x) for x in s
    ]
    deviation = float(np.max(np.abs(pressure - problem.weight)))
    assert np.max(np.abs(np.array(formula) - pressure)) < 0.02 * deviation


def test_small_angle_errors_are_those_of_the_exact_helix() -> None:
    for eta in (0.05, 0.1, 0.3):
        force = 2.0 * math.sin(eta) ** 2 * math.cos(eta)
        exact = {"helical_contact": math.sin(eta) ** 4, "helix_curvature": math.sin(eta) ** 2,
                 "helix_rate": math.sin(eta), "helix_strain": 1.0 - math.cos(eta),
                 "lubinski_woods_pitch": 2.0 * math.pi / math.tan(eta)}  # fmt: skip
        rod = FormulaInputs(1.0, 0.0, 90.0, 1.0, 1.0, more=(("F", force),))
        for key, value in exact.items():
            error = helix.small_angle_error(key, 1.0, 1.0, force)
            assert error == pytest.approx(FORMULAS[key].of(rod) / value - 1.0, abs=1e-12)
    assert helix.small_angle_error("helix_bending_stress", 1.0, 1.0, 0.1) is None
    low = [-100.0 * helix.small_angle_error("helical_contact", 1.0, 1.0, 2.0 * math.sin(e) ** 2 * math.cos(e))
           for e in (0.05, 0.1, 0.3)]  # fmt: skip
    assert [round(x, 2) for x in low] == [0.25, 1.0, 8.73]
    with pytest.raises(InputError, match=r"0\.7698"):
        helix.helix_angle(0.78)


def test_helix_relations() -> None:
    B, F, r = STEEL["B"], 100e3, STEEL["r"]
    pitch, rate = helix.lubinski_woods_pitch(B, F), helix.helix_rate(B, F)
    assert pitch == pytest.approx(40.366, abs=1e-3)
    assert rate * pitch == pytest.approx(2.0 * math.pi, rel=1e-14)
    assert helix.twisted_helix_force(B, 0.0, pitch) == pytest.approx(F, rel=1e-14)
    assert helix.twisted_helix_contact(B, r, F, 0.0) == pytest.approx(helix.helical_contact(B, r, F), rel=1e-14)
    assert helix.helix_curvature(B, r, F) == pytest.approx(r * rate**2, rel=1e-14)
    assert helix.helix_strain(B, r, F) == pytest.approx(0.5 * (r * rate) ** 2, rel=1e-14)
    chen = inclined.chen_lin_cheatham(**STEEL)
    assert helix.helical_contact(B, r, chen) == pytest.approx(2.0 * 315.0, rel=1e-14)  # twice the weight at onset
    assert helix.straight_contact(315.0, 30.0) == pytest.approx(157.5)
    area, inertia, outer = math.pi / 4 * (0.140**2 - 0.116**2), B / 207e9, 0.140
    stress = helix.helix_bending_stress(r, F, outer, inertia)
    assert stress == pytest.approx(207e9 * helix.helix_curvature(B, r, F) * outer / 2.0, rel=1e-14)
    yields = pushing.coiled_tubing_yield(550e6, area, r, outer, inertia)
    assert yields / area + helix.helix_bending_stress(r, yields, outer, inertia) == pytest.approx(550e6, rel=1e-14)
    assert helix.mitchell_lateral_rate(B, 2e5, 2e5) == 0.0
    assert helix.mitchell_lateral_rate(2.0, 3.0, 2.0) == pytest.approx(1.1227 / 2.0 * 3.0**0.04, rel=1e-14)


def test_pushing_formulas_solve_their_equations() -> None:
    from scipy.integrate import quad

    B, w, r, mu, F = STEEL["B"], 315.0, STEEL["r"], 0.3, 2e5
    shortening, _ = quad(lambda x: helix.helix_strain(B, r, F - w * x), 0.0, F / w)
    assert pushing.tubing_shortening(B, w, r, F) == pytest.approx(shortening, rel=1e-12)
    reach, _ = quad(lambda f: 1.0 / (mu * helix.helical_contact(B, r, f)), F, 3.0 * F)
    assert pushing.helical_push(B, r, mu, F, reach) == pytest.approx(3.0 * F, rel=1e-10)
    lock_up = pushing.helical_lock_up(B, r, mu, F)
    assert pushing.helical_push(B, r, mu, F, lock_up * (1.0 - 1e-9)) == pytest.approx(F * 1e9, rel=1e-5)
    with pytest.raises(InputError, match="lock-up length"):
        pushing.helical_push(B, r, mu, F, lock_up * 1.01)
    heavy, _ = quad(lambda f: 1.0 / (mu * (helix.helical_contact(B, r, f) + w)), F, 3.0 * F)
    assert pushing.helical_length(B, w, r, mu, F, 3.0 * F) == pytest.approx(heavy, rel=1e-10)
    chen = inclined.chen_lin_cheatham(**STEEL)
    whole = pushing.helical_lock_up_heavy(B, w, r, mu)
    assert pushing.helical_length(B, w, r, mu, chen, 1e15) == pytest.approx(whole, rel=1e-8)
    assert round(whole * mu / math.sqrt(B / (r * w)), 3) == 1.231
    total = chen / (mu * w) + pushing.helical_lock_up(B, r, mu, chen)
    assert pushing.total_lock_up(B, w, r, mu) == pytest.approx(total, rel=1e-14)


def test_path_formulas() -> None:
    assert path.effective_compression(5.0, 3.0, 2.0, 0.5, 1.0) == 4.5
    assert path.buoyed_weight(10.0, 2.0, 3.0, 0.5, 1.0) == 8.0
    assert path.path_contact_force(3.0, 90.0, 1.0, 0.0, 4.0) == 5.0
    steel, mud = 65.5, 10.0  # by volume: same mud on both sides
    area = 1.7
    assert path.buoyed_weight(steel * area, mud, mud, 2.0, 2.0 + area) == pytest.approx(
        path.buoyed_weight_in_mud(steel * area, mud), rel=1e-14
    )
