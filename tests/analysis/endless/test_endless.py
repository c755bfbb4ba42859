"""The endless rod: its energy against the rod's, its states against the balance, against limits and printed numbers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rodwell
from rodwell.analysis.endless.limits import limits
from rodwell.analysis.endless.state import NUMBERS, contact, on_two, periodic_state
from rodwell.analysis.endless.waves import Wave, _system, wave_at_frequency
from rodwell.errors import NotConvergedError
from rodwell.physics.exact.helix import weightless_helix
from rodwell.physics.on_wall import endless as formulas
from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.strand import contact_pressure

KINDS = ("sinusoidal", "helical")

# two programs, Fourier series to 1e-12; β = 3, small slopes. Ripple and the least contact force of the sinusoidal
# state are there the extremes over 256 places of a period: see the test of those two
REFERENCE = {
    "sinusoidal": {
        "frequency": 0.96798109, "amplitude": 0.92312708, "energy": -1.0947180159, "contact_mean": 1.38468435,
        "contact_largest": 3.55166164, "rate_largest": 0.83551433,
    },
    "helical": {
        "frequency": 1.20880593, "energy": -1.1478487038, "contact_mean": 2.24863072, "contact_least": 0.37932750,
    },
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_states_at_beta_3(kind: str) -> None:
    state = periodic_state(kind, 3.0)
    for name, value in REFERENCE[kind].items():
        assert getattr(state, name).value == pytest.approx(value, abs=1e-8), name
    assert all(getattr(state, name).error < 1e-11 for name in NUMBERS)


@pytest.mark.parametrize(("kind", "places", "printed"), [("sinusoidal", 256, 0.46523572), ("helical", 256, 0.09428393)])
def test_extremes_that_lie_between_the_places_of_the_reference(kind: str, places: int, printed: float) -> None:
    state = periodic_state(kind, 3.0)
    phase = 2.0 * np.pi * np.arange(places) / places
    if kind == "sinusoidal":
        assert np.min(contact(state.fine, phase)) == pytest.approx(printed, abs=1e-8)
        assert printed - 2e-4 < state.contact_least.value < printed - 1e-4
    else:
        assert np.max(np.abs(state.fine.angles(phase, 0)[0] - phase)) == pytest.approx(printed, abs=1e-8)
        assert printed < state.amplitude.value < printed + 1e-6
    fine = np.linspace(0.0, np.pi, 200_001)
    if kind == "sinusoidal":
        assert state.contact_least.value == pytest.approx(np.min(contact(state.fine, fine)), abs=1e-9)


def _as_rod(slope: float, beta: float) -> np.ndarray:
    """Parameters of the rod with B = 1, ℓ = 1: Δ = wₗ = ε, F = −β."""
    return np.array([-beta, 0.0, slope, slope, 0.0, 1.0])


@given(st.floats(0.05, 0.9), st.floats(0.0, 8.0), st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4))
def test_the_energy_and_the_contact_are_those_of_the_rod_on_the_wall(slope: float, beta: float, x: list[float]) -> None:
    fields = np.array([x]).T * np.array([[3.0], [0.9], [2.0], [2.0]])
    y, y1, y2, y3 = slope * fields[:, 0]
    parameters = _as_rod(slope, beta)
    energy, _, gradient, _, hessian = rod_density(0.5, y, y1, y2, parameters, np.zeros(6))
    e = formulas.density(fields[:3], beta, slope)
    assert e.energy[0] + 1.0 == pytest.approx(energy / slope**2, rel=1e-11, abs=1e-12)
    np.testing.assert_allclose(np.ravel(e[1:4]), np.array(gradient) / slope, rtol=1e-11, atol=1e-12)
    expected = np.array(hessian)[[0, 1, 1, 2], [0, 1, 2, 2]]
    np.testing.assert_allclose(np.ravel(e[4:]), expected, rtol=1e-11, atol=1e-11)
    pressure = contact_pressure(0.5, y, y1, y2, y3, parameters)
    assert formulas.contact(fields, beta, slope)[0] == pytest.approx(-pressure / slope, rel=1e-10, abs=1e-10)


def test_small_slopes_are_the_limit() -> None:
    fields = np.array([[0.7], [0.8], [-0.5], [0.4]])
    apart = [
        np.ravel(formulas.density(fields[:3], 3.0, slope))[:4] - np.ravel(formulas.density(fields[:3], 3.0, 0.0))[:4]
        for slope in (2e-3, 1e-3)
    ]
    np.testing.assert_allclose(apart[0], 4.0 * apart[1], rtol=1e-4, atol=1e-12)
    assert formulas.contact(fields, 3.0, 1e-6)[0] == pytest.approx(formulas.contact(fields, 3.0, 0.0)[0], rel=1e-10)


def _balance(kind: str, beta: float) -> None:
    """θ'''' − 6θ'²θ'' + βθ'' + sin θ = 0 and, at the best wavelength, a first integral equal to the mean."""
    state = periodic_state(kind, beta)
    angle, rate, bend, third, fourth = state.fine.angles(np.linspace(0.0, 6.0, 300), 4)
    scale = max(1.0, beta * beta)
    assert np.max(np.abs(fourth - 6.0 * rate**2 * bend + beta * bend + np.sin(angle))) < 1e-10 * scale
    energy = 0.5 * bend**2 + 0.5 * rate**4 - np.cos(angle) - 0.5 * beta * rate**2
    integral = energy - rate * (2.0 * rate**3 - beta * rate - third) - bend * bend
    np.testing.assert_allclose(integral, state.energy.value, atol=1e-11 * scale)


@settings(max_examples=15, deadline=None)
@given(st.floats(2.001, 5.2))
def test_sinusoidal_states_meet_the_balance(beta: float) -> None:
    _balance("sinusoidal", beta)


@settings(max_examples=15, deadline=None)
@given(st.floats(2.13, 60.0))
def test_helices_meet_the_balance(beta: float) -> None:
    _balance("helical", beta)


@pytest.mark.parametrize("slope", [0.0, 0.3])
def test_amplitude_near_buckling(slope: float) -> None:
    """A² = 8(β − 2)/(11 − 2ε²): θ = A sin x in the energy, of fourth order in A."""
    ratio = [
        periodic_state("sinusoidal", 2.0 + step, slope).amplitude.value ** 2 * (11.0 - 2.0 * slope**2) / (8.0 * step)
        - 1.0
        for step in (2e-3, 1e-3)
    ]
    assert abs(ratio[1]) < 1e-3
    assert ratio[0] == pytest.approx(2.0 * ratio[1], rel=0.01)


def test_helices_under_large_loads() -> None:
    """Weightless: k = √(β/2), contact β²/4; the ripple is −4/(5β²), the energy −β²/8 − 1/(5β²)."""
    for beta in (20.0, 40.0):
        state = periodic_state("helical", beta)
        order = beta**-4
        assert state.frequency.value == pytest.approx(np.sqrt(beta / 2.0), rel=2.0 * order)
        assert state.contact_mean.value == pytest.approx(beta**2 / 4.0, rel=2.0 * order)
        assert state.amplitude.value == pytest.approx(0.8 / beta**2, rel=10.0 * order)
        assert state.energy.value + beta**2 / 8.0 == pytest.approx(-0.2 / beta**2, rel=1e-3)
        assert state.shortening.value == pytest.approx(beta / 4.0, rel=2.0 * order)
        assert state.stress_factor.value == pytest.approx(1.0, abs=2.0 * beta**-2)


def test_a_steep_helix_is_the_weightless_one() -> None:
    slope, eta = 0.05, 0.5
    helix = weightless_helix(eta, slope)  # B = ℓ = 1: Δ = ε
    state = periodic_state("helical", -helix.force, slope)
    assert state.frequency.value == pytest.approx(helix.rate, rel=1e-6)
    assert state.contact_mean.value == pytest.approx(-helix.pressure / slope, rel=1e-6)


def test_the_helix_presses_by_the_weightless_amount() -> None:
    """The weight averages out round the turn: β²/4 to 0.002 at β = 2.9."""
    state = periodic_state("helical", 2.9)
    assert 0.0 < 2.9**2 / 4.0 - state.contact_mean.value < 0.002


def test_loads() -> None:
    loads = limits(0.0)
    assert loads.buckling.value == 2.0
    lift, helix = loads.sinusoidal_lift_off, loads.helix_lift_off
    assert lift is not None
    assert helix is not None
    for kind, load in (("sinusoidal", lift), ("helical", helix)):
        assert load.error < 1e-11
        state = periodic_state(kind, load.value)
        assert abs(state.contact_least.value) < 1e-10
    equal = loads.sinusoidal_helix_equal_energy
    assert equal is not None
    energies = [periodic_state(kind, equal.value).energy.value for kind in KINDS]
    assert energies[0] == pytest.approx(energies[1], abs=1e-11)
    straight = loads.straight_helix_equal_energy
    assert straight is not None
    assert periodic_state("helical", straight.value).energy.value == pytest.approx(-1.0, abs=1e-11)
    # Chen, Lin and Cheatham 1990: a helix without ripple costs as much as the straight rod at 2√2
    assert 0.0 < 2.0 * np.sqrt(2.0) - straight.value < 0.04


@pytest.mark.parametrize(("kind", "name"), [("sinusoidal", "sinusoidal_ceases"), ("helical", "helix_ceases")])
def test_states_cease_where_the_energy_loses_its_minimum(kind: str, name: str) -> None:
    end = getattr(limits(0.0), name).value
    inside = end - 1e-6 if kind == "sinusoidal" else end + 1e-6
    soft = [periodic_state(kind, end + part * (inside - end)).fine.stiffness for part in (4.0, 1.0)]
    assert soft[0] == pytest.approx(2.0 * soft[1], rel=0.01)  # like the root of the distance
    with pytest.raises(NotConvergedError, match="end near"):
        periodic_state(kind, 2.0 * end - inside)


def test_second_variation_near_buckling_is_that_of_the_straight_rod() -> None:
    """1 − βq² + q⁴ with q = k(j + ν), least over j."""
    state = periodic_state("sinusoidal", 2.0 + 1e-6)
    assert state.stability.wavenumber == 0.5
    assert state.stability.softest.value == pytest.approx((1.0 - 2.0 * 0.25 + 0.0625) / 0.25, abs=1e-4)


@pytest.mark.parametrize(
    ("kind", "beta"), [("sinusoidal", 2.1), ("sinusoidal", 3.5), ("helical", 2.75), ("helical", 9.0)]
)
def test_states_in_contact_are_stable(kind: str, beta: float) -> None:
    told = periodic_state(kind, beta).stability
    assert told.stable
    assert told.softest.value > 100.0 * told.softest.error


def test_states_past_a_fold_are_unstable_against_long_waves() -> None:
    near = periodic_state("helical", 2.123).fine
    past, _ = wave_at_frequency(near, near.frequency * 0.97)
    assert past.stiffness < 0.0
    told = on_two(past).stability
    assert not told.stable
    assert told.wavenumber < 0.05


def test_shape_and_contact_along_the_rod() -> None:
    state = periodic_state("sinusoidal", 3.0)
    wave = 2.0 * np.pi / state.frequency.value
    x = np.linspace(0.0, wave, 7).reshape(1, 7)
    assert state.angle(x).shape == (1, 7)
    assert np.max(np.abs(state.angle(x + wave) - state.angle(x))) < 1e-12
    assert state.angle(np.array(0.25 * wave)) == pytest.approx(state.amplitude.value)
    assert state.contact(np.array([0.25 * wave]))[0] == pytest.approx(state.contact_largest.value)
    assert "sinusoidal state at beta 3" in repr(state)


def test_the_middle_of_a_long_rod_is_an_endless_one_of_the_same_wavelength() -> None:
    """γ = 16000 on splines, clamped: it keeps the waves with which it buckled. Ends are felt by 1/7 per half wave."""
    weight, beta = 16000.0, 2.8
    unit, slope = (weight / 0.01) ** -0.25, (weight * 0.01**3) ** 0.25
    state = rodwell.follow(rodwell.Problem(weight), 1, until=-beta / unit**2).at(-beta / unit**2)
    places = np.linspace(0.4, 0.6, 8001)
    fields = state.fields(places)
    y, pressure = fields["y"], -fields["contact_pressure"] / weight
    at = np.flatnonzero(np.diff(np.sign(y)))
    zeros = places[at] - y[at] * np.diff(places)[0] / np.diff(y)[at]
    k = np.pi * unit / np.min(np.diff(zeros))
    amplitudes = periodic_state("sinusoidal", beta, slope).coarse.amplitudes.copy()
    for _ in range(8):
        system = _system("sinusoidal", beta, slope, amplitudes, k)
        amplitudes = amplitudes - np.linalg.solve(system.hessian[:-1, :-1], system.gradient[:-1])
    wave = Wave("sinusoidal", beta, slope, amplitudes, k, 0.0)
    phase = np.linspace(0.0, np.pi, 4001)
    assert np.max(np.abs(y)) / 0.01 == pytest.approx(np.max(wave.angles(phase, 0)[0]), rel=1e-4)
    assert np.max(pressure) == pytest.approx(np.max(contact(wave, phase)), rel=3e-4)
    assert np.min(pressure) == pytest.approx(np.min(contact(wave, phase)), rel=1e-3)
