"""Sections and tapers, place by place: polynomials, the balance of forces with a stiffness that varies, steps of it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from rodwell.physics.on_wall.braid import Taper, rates
from rodwell.physics.on_wall.end_loads import EndForce, end_force
from rodwell.physics.on_wall.linear import second_variation
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, LATERAL_WEIGHT, RAMP, SIDE, TWIST
from rodwell.physics.on_wall.sections import step_jumps, step_loads
from rodwell.physics.on_wall.strand import axial_resultant, contact_pressure, curvatures, strand_force
from rodwell.physics.on_wall.tapered import TERMS, here, more_force, more_pressure, stiffness_rates, weight_rate

ORIGIN = 0.3
B, Q, H = (Polynomial([1.3, -0.4, 0.7, 0.2, -0.5]), Polynomial([0.8, 0.3, -0.2, 0.6, 0.1]),
           Polynomial([-0.5, 0.8, 0.15, -0.07, 0.15, 0.02]))  # fmt: skip
"""b, q and h in s − ORIGIN."""


def loads(**given: float) -> np.ndarray:
    out = np.zeros(RAMP + 1)
    out[[FORCE, AXIAL_WEIGHT, LATERAL_WEIGHT, CLEARANCE, TWIST, SIDE]] = -60.0, 7.0, 11.0, 0.04, 5.0, 1.0
    for name, value in given.items():
        out[{"twist": TWIST, "axial": AXIAL_WEIGHT}[name]] = value
    return out


def test_coefficients_of_a_taper_are_polynomials_from_its_origin() -> None:
    given = np.concatenate([[ORIGIN], B.coef, Q.coef, H.coef])
    assert given.size == 2 + 3 * TERMS
    for s in (0.1, 0.3, 0.95):
        x = s - ORIGIN
        assert here(s, given) == pytest.approx((B(x), Q(x), H(x) - Q(x) * (s - 1.0)), rel=1e-14)
        assert weight_rate(s, given) == pytest.approx(Q.deriv()(x), rel=1e-13)
        assert stiffness_rates(s, given) == pytest.approx((B.deriv()(x), B.deriv(2)(x)), rel=1e-13)


def test_pressure_of_a_taper_balances_its_forces() -> None:
    """(48) along d₁: p = F₂′ + ω₃F₁ − ω₁F₃ − wₗ cos ξ₂, with F₂ differentiated along a curve by a complex step."""
    parameters, y = loads(axial=0.0), Polynomial([0.01, 0.35, -0.4, 0.3, 0.25])

    def forces(s: Any) -> tuple[Any, Any, Any]:
        slopes, b = [y.deriv(k)(s) for k in (1, 2, 3)], B(s - ORIGIN)
        plain = strand_force(s, *slopes, parameters, b)
        more = more_force(*slopes, parameters[CLEARANCE], B.deriv()(s - ORIGIN))
        return tuple(one + other for one, other in zip(plain, more, strict=True))

    for s in (0.2, 0.5, 0.8):
        slopes, x = [y.deriv(k)(s) for k in (1, 2, 3)], s - ORIGIN
        _, omega1, _, omega3, _ = curvatures(*slopes, parameters[CLEARANCE])
        f1, _, f3 = forces(s)
        weight = parameters[LATERAL_WEIGHT] * np.cos(y(s) / parameters[CLEARANCE])
        expected = forces(s + 1e-30j)[1].imag / 1e-30 + omega3 * f1 - omega1 * f3 - weight
        more = more_pressure(*slopes, parameters[CLEARANCE], B.deriv()(x), B.deriv(2)(x))
        found = contact_pressure(s, y(s), *slopes, parameters, B(x)) + more
        assert found == pytest.approx(expected, rel=1e-12)


def test_tension_and_bending_energy_change_along_a_taper_as_the_balance_along_the_rod_says() -> None:
    """(48) along t₁: F₁′ = ω₃F₂ − ω₂F₃ + q(wₐ cos η + wₗ sin η sin ξ₂); the rest by complex steps."""
    parameters, y, step = loads(), Polynomial([0.01, 0.35, -0.4, 0.3, 0.25]), 1e-30
    clearance, axial, lateral = parameters[[CLEARANCE, AXIAL_WEIGHT, LATERAL_WEIGHT]]

    def energy(s: Any) -> Any:
        _, _, omega2, omega3, _ = curvatures(*(y.deriv(k)(s) for k in (1, 2, 3)), clearance)
        weight = clearance * lateral * Q(s - ORIGIN) * np.cos(y(s) / clearance)
        return 0.5 * B(s - ORIGIN) * (omega2**2 + omega3**2) + weight

    s = np.array([0.2, 0.5, 0.8])
    x, slopes = s - ORIGIN, [y.deriv(k)(s) for k in (1, 2, 3)]
    taper = Taper(B.deriv()(x), B.deriv(2)(x), lateral * Q.deriv()(x))
    own: list[Any] = [value + 0.0 * s for value in parameters]
    own[AXIAL_WEIGHT], own[LATERAL_WEIGHT] = axial * Q(x), lateral * Q(x)
    found = rates(s, np.array([y(s), *slopes]), own, 1.0, EndForce(0.0, 0.0), B(x), taper)[8]
    more = more_force(*slopes, clearance, taper.rate)
    _, f2, f3 = (one + other for one, other in zip(strand_force(s, *slopes, own, B(x)), more, strict=True))
    cos_eta, _, omega2, omega3, _ = curvatures(*slopes, clearance)
    along = omega3 * f2 - omega2 * f3
    along += Q(x) * (axial * cos_eta + lateral * slopes[0] * np.sin(y(s) / clearance))
    assert found == pytest.approx(energy(s + 1j * step).imag / step + along, rel=1e-11)


def test_axial_resultant_is_the_end_force_and_the_weight_above() -> None:
    assert axial_resultant(1.0, loads()) == -60.0
    assert axial_resultant(0.25, loads()) == pytest.approx(-60.0 - 0.75 * 7.0, rel=1e-15)


def test_what_the_wall_exerts_at_a_step_is_what_the_rod_loses_there() -> None:
    """b ω₂ and ω₃ are the same on both sides; F₂ and the moment about u₁ are not."""
    parameters, slope, moment = loads(), 0.3, 0.8
    stiffness, rates = np.array([1.0, 2.5]), np.array([0.2, -0.7])
    cos_eta, omega3 = np.sqrt(1.0 - slope**2), slope**2 / parameters[CLEARANCE]
    across = []
    for b, rate in zip(stiffness, rates, strict=True):
        bend = -moment / b * cos_eta  # y″ from ω₂ = −y″/cos η
        more = more_force(slope, bend, 0.0, parameters[CLEARANCE], rate)
        across.append(strand_force(0.5, slope, bend, 0.0, parameters, b)[1] + more[1])
    sides: Any = stiffness[:, None], rates[:, None]
    couple, radial = step_loads(np.array([slope]), np.array([moment]), sides[0], parameters, sides[1])
    assert radial == pytest.approx([across[0] - across[1]], rel=1e-12)
    assert couple == pytest.approx([-(stiffness[1] - stiffness[0]) * omega3], rel=1e-12)


def test_jumps_of_the_force_at_steps_are_what_the_wall_exerts_turned_with_the_rod() -> None:
    """At the low side d₁ is i and u₂ is j; a quarter round, d₁ is −j and u₂ is i; a part of the way, in between."""
    clearance, slope, couple, radial = 0.04, 0.3, 1.7, -2.2
    around = -couple * slope / clearance
    angles = np.array([0.0, 0.5 * np.pi, 0.4])
    d1, u2 = np.array([np.cos(angles), -np.sin(angles)]), np.array([np.sin(angles), np.cos(angles)])
    same = np.ones(3)
    found = step_jumps(clearance * angles, slope * same, (couple * same, radial * same), clearance)
    assert found == pytest.approx(-(radial * d1 + around * u2), rel=1e-12, abs=1e-12)
    assert found[:, 0] == pytest.approx([-radial, -around])
    assert found[:, 1] == pytest.approx([-around, radial])


def test_an_end_that_turns_takes_a_part_of_the_torque() -> None:
    """sin η = 0.6, cos η = 0.8: −T₁(cos η − 1)/Δ = 0.2 · 5/0.04 = 25, and the moment is that about the turned axis."""
    end = end_force(3.0, -7.0, 0.02, 0.6, loads(), (1.5, 0.1))
    assert (end.shear, end.moment) == pytest.approx((18.0, -2.4), rel=1e-13)
    assert (end.angle, end.slope, end.stiffness, end.stiffness_rate) == (0.5, 0.6, 1.5, 0.1)


def test_second_variation_of_sections_has_the_loads_of_each() -> None:
    """wₗ q/Δ, N = F + wₐ(d + q(s − 1)) and b, of each section; of a uniform rod with q = b = 1 and d = 0."""
    places, parameters = np.array([0.1, 0.6, 0.9]), loads()
    given = np.array([[1.0, 1.0, 0.0], [2.0, 1.5, -0.2], [0.5, 0.7, 0.1]])
    b, q, d = given.T
    expected = [11.0 * q / 0.04, -60.0 + 7.0 * (d + q * (places - 1.0)), b]
    assert second_variation(places, parameters, given) == pytest.approx(np.array(expected), rel=1e-13)
    plain = [np.full(3, 11.0 / 0.04), -60.0 + 7.0 * (places - 1.0), np.ones(3)]
    assert second_variation(places, parameters) == pytest.approx(np.array(plain), rel=1e-13)
