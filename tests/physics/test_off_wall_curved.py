"""The energy anywhere in a curved hole: generated, that of the curve in space, that of the models it goes over into.

The second method is the rod as a curve in space, in 60 digits: the hole's axis and frame as a circle, the place along
it from |r′| = 1 alone, derivatives by differences. Nothing of the formulas enters it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodwell.physics.off_wall import _curved_density
from rodwell.physics.off_wall._curved_density import curved_hole_density
from rodwell.physics.off_wall._density import hole_density
from rodwell.physics.off_wall.curved_forces import in_curved_hole, radially_at_curved_wall
from rodwell.physics.off_wall.forces import in_space
from rodwell.physics.on_wall._curved_density import curved_density, curved_strand

mp = pytest.importorskip("mpmath")

D, TWIST = 0.03, 2.5
LOADS = np.array([-80.0, 7.0, -4.0])
U = np.array([-0.011, 0.31, -1.7, 0.017, -0.23, 2.9])
DIGITS = 60


def test_density_is_generated_from_its_symbols() -> None:
    energy = pytest.importorskip("rodwell.physics.off_wall.curved_energy")
    assert Path(_curved_density.__file__).read_text(encoding="utf-8") == energy.generate()


class Curve:
    """A rod X(S) + x N₁ + y N₂ near s = 0 beside an arc, x and y as Taylor series, S(s) so that it does not stretch."""

    def __init__(self, build: float, walk: float) -> None:
        self.k1, self.k2 = mp.mpf(build), mp.mpf(-walk)
        self.q, self.bend = mp.mpf(1), mp.mpf(0)
        self.h = mp.mpf(10) ** -15
        self.q = mp.findroot(lambda q: self._speed(q) - 1, mp.mpf(1))
        self.bend = mp.findroot(self._stretching, mp.mpf(0))

    def _speed(self, q: object) -> object:
        self.q = q
        return mp.norm(self.rate(self.r)(mp.mpf(0)))

    def _stretching(self, bend: object) -> object:
        self.bend = bend
        at = mp.mpf(0)
        return (self.rate(self.r)(at).T * self.rate(self.rate(self.r))(at))[0]

    def frame(self, s: object) -> tuple[object, object]:
        """N₁, N₂, T as columns, and the axis, in their components at s = 0."""
        place = self.q * s + self.bend * s**2 / 2
        kappa = mp.sqrt(self.k1**2 + self.k2**2)
        towards = mp.matrix([self.k1, self.k2, 0]) / kappa
        tangent, normal = mp.matrix([0, 0, 1]), mp.matrix([-self.k2, self.k1, 0]) / kappa
        cos, sin = mp.cos(kappa * place), mp.sin(kappa * place)
        turned = {0: cos * towards - sin * tangent, 1: normal, 2: sin * towards + cos * tangent}
        columns = mp.matrix(3, 3)
        for i in range(3):  # along N₁, N₂ as combinations of towards and normal
            share = (towards[i], normal[i], 0) if i < 2 else (0, 0, 1)
            column = sum((share[k] * turned[k] for k in range(3)), mp.zeros(3, 1))
            for j in range(3):
                columns[j, i] = column[j]
        return columns, (sin * tangent.T[2] * tangent + (1 - cos) * towards) / kappa

    def across(self, s: object) -> object:
        x, x1, x2, y, y1, y2 = map(mp.mpf, U)
        return mp.matrix([x + x1 * s + x2 * s**2 / 2, y + y1 * s + y2 * s**2 / 2, 0])

    def r(self, s: object) -> object:
        frame, axis = self.frame(s)
        return axis + frame * self.across(s)

    def rate(self, f: object) -> object:
        """The derivative, of the fourth order in the step."""
        h = self.h
        return lambda s: (8 * (f(s + h) - f(s - h)) - f(s + 2 * h) + f(s - 2 * h)) / (12 * h)

    def carried(self, s: object) -> object:
        """N₁ and N₂ as the smallest rotation from T to the tangent of the rod carries them."""
        frame, _ = self.frame(s)
        t, axis = self.rate(self.r)(s), frame[:, 2]
        cos = (t.T * axis)[0]
        along = mp.matrix([axis[1] * t[2] - axis[2] * t[1], axis[2] * t[0] - axis[0] * t[2],
                           axis[0] * t[1] - axis[1] * t[0]])  # fmt: skip
        cross = mp.matrix([[0, -along[2], along[1]], [along[2], 0, -along[0]], [-along[1], along[0], 0]])
        return (mp.eye(3) + cross + cross * cross / (1 + cos)) * frame

    def twisting(self) -> object:
        """How fast that frame turns about the tangent."""
        first = self.rate(lambda s: self.carried(s)[:, 0])(mp.mpf(0))
        return (first.T * self.carried(mp.mpf(0))[:, 1])[0]


@pytest.mark.parametrize(("build", "walk"), [(0.9, 0.0), (-0.7, 0.0), (0.6, 0.8)])
def test_energy_is_bending_height_and_the_work_of_loads(build: float, walk: float) -> None:
    """To 1e-12. The rod carries the torque −T₁ about its tangent, the paper's sign: −T₁ times the turn is stored."""
    with mp.workdps(DIGITS):
        rod = Curve(build, walk)
        bent = rod.rate(rod.rate(rod.r))(mp.mpf(0))
        lying = 1 + D * rod.k1
        force, push1, push2 = map(mp.mpf, LOADS)
        known = (bent.T * bent)[0] / 2 - (rod.k1**2 + rod.k2**2) / lying**2 / 2
        known += -force * (rod.q - 1 / lying) + push1 * (mp.mpf(U[0]) + D) + push2 * mp.mpf(U[3])
        known -= TWIST * rod.twisting()
    found = curved_hole_density(U, (build, -walk), D, TWIST, LOADS, np.zeros(3))[0]
    assert found == pytest.approx(float(known), abs=1e-12)


def test_work_of_the_loads_is_the_shift_along_the_hole_and_the_height() -> None:
    """∂e/∂N = 1/(1 + Δk₁) − S′ and ∂e/∂(w g₁) = x + Δ, with their gradients."""
    rates = np.array([1.0, 0.0, 0.0])
    step = 1e-5
    _, rate, _, mixed, _ = curved_hole_density(U, (0.6, -0.8), D, TWIST, LOADS, rates)
    up, down = (curved_hole_density(U, (0.6, -0.8), D, TWIST, LOADS + sign * step * rates, rates) for sign in (1, -1))
    assert rate == pytest.approx((up[0] - down[0]) / (2 * step), rel=1e-9)
    np.testing.assert_allclose(mixed, (np.array(up[2]) - np.array(down[2])) / (2 * step), atol=1e-8)


def test_without_curvature_it_is_the_energy_of_the_straight_hole() -> None:
    rates, s = np.array([1.0, 0.3, 0.0]), 0.3
    straight = np.array([-80.0 - 3.0 * (s - 1.0), 3.0, 7.0, D, TWIST])
    found = curved_hole_density(U, (0.0, 0.0), D, TWIST, np.array([-80.0, 7.0, 0.0]), rates)
    known = hole_density(s, U[0], U[1], U[2], U[4], U[5], straight, np.array([1.0, 0.0, 0.3, 0.0, 0.0]))
    assert found[:2] == pytest.approx(known[:2], rel=1e-13)
    kept = [0, 1, 2, 4, 5]  # y does not enter there
    np.testing.assert_allclose(np.array(found[2])[kept], known[2], rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(np.array(found[3])[kept], known[3], rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(np.array(found[4])[np.ix_(kept[1:], kept[1:])], known[4], rtol=1e-13, atol=1e-12)
    assert not np.any(np.array(found[4])[[0, 3]])


@settings(max_examples=60, deadline=None)
@given(st.floats(-3.0, 3.0), st.floats(-20.0, 20.0), st.floats(-300.0, 300.0), st.floats(-0.9, 0.9), st.floats(-8, 8))
def test_on_the_wall_both_densities_are_equal(phi: float, phi1: float, phi2: float, walk: float, twist: float) -> None:
    """x = −Δ cos φ, y = Δ sin φ in the energy off the wall is the energy on it, place by place, torque included."""
    hole, weight, force = (0.6, -walk, 0.7, 0.2, 0.21, 0.4), 9.0, -123.0
    sin, cos = np.sin(phi), np.cos(phi)
    x, y = -D * cos, D * sin
    u = (x, D * sin * phi1, D * (cos * phi1**2 + sin * phi2), y, D * cos * phi1, D * (-sin * phi1**2 + cos * phi2))
    drive = (1.0 + D * hole[0]) * (force - weight * hole[4] + hole[5])
    off = curved_hole_density(u, hole[:2], D, twist, (drive, weight * 0.7, weight * 0.2), np.zeros(3))[0]
    loads = np.array([force, weight, weight, D, twist, 1.0, 0.0])
    on = curved_density(D * phi, D * phi1, D * phi2, hole, D, loads, np.zeros(7))[0]
    scale = 1.0 + 0.5 * (u[2] ** 2 + u[5] ** 2) + 123.0 * (u[1] ** 2 + u[4] ** 2)
    assert off == pytest.approx(on, abs=2e-14 * scale)


def test_derivatives_are_those_of_the_energy() -> None:
    """Complex steps, exact to round-off: the gradient of the energy, and the Hessian of the gradient."""
    found = curved_hole_density(U, (0.6, -0.8), D, TWIST, LOADS, np.zeros(3))
    for i in range(6):
        u = U.astype(complex)
        u[i] += 1e-40j
        there = curved_hole_density(u, (0.6, -0.8), D, TWIST, LOADS, np.zeros(3))
        assert there[0].imag * 1e40 == pytest.approx(found[2][i], rel=1e-13, abs=1e-12)
        np.testing.assert_allclose(np.array(there[2]).imag * 1e40, np.array(found[4])[i], rtol=1e-12, atol=1e-11)


def test_radial_moment_and_force_at_the_wall_are_derivatives_of_the_energy_off_it() -> None:
    """Complex steps along φ = 0.7 + 4s − 7s² + 5s³, in a hole whose curvature changes along the rod."""
    d, twist = 0.2, 3.0

    def shape(s: complex) -> tuple[complex, complex, complex]:
        return 0.7 + 4.0 * s - 7.0 * s**2 + 5.0 * s**3, 4.0 - 14.0 * s + 15.0 * s**2, -14.0 + 30.0 * s

    def moments(s: complex) -> tuple[np.ndarray, np.ndarray]:
        """∂e/∂u′ and ∂e/∂u″ at the rod's own place."""
        phi, phi1, phi2 = shape(s)
        sin, cos = np.sin(phi), np.cos(phi)
        u = (-d * cos, d * sin * phi1, d * (cos * phi1**2 + sin * phi2),
             d * sin, d * cos * phi1, d * (-sin * phi1**2 + cos * phi2))  # fmt: skip
        g = curved_hole_density(u, (0.9 + 0.4 * s, -0.6 - 0.5 * s), d, twist, (-123.0, 0.0, 0.0), (1.0, 0.0, 0.0))[2]
        return np.array([g[1], g[4]]), np.array([g[2], g[5]])

    def at(phi: complex, phi1: complex, s: complex = 0.0) -> tuple:
        place = np.array([0.9 + 0.4 * s, -0.6 - 0.5 * s])
        return radially_at_curved_wall((phi, phi1, -14.0), place, np.array([0.4, -0.5]), d, twist)

    tiny = 1e-40
    first, second = moments(0.0)
    shear = first - moments(tiny * 1j)[1].imag / tiny
    phi, phi1, _ = shape(0.0)
    out, around = np.array([-np.cos(phi), np.sin(phi)]), np.array([np.sin(phi), np.cos(phi)])
    found = at(phi, phi1)
    assert found[0] == pytest.approx(second @ out, rel=1e-13)
    assert found[1] == pytest.approx(at(phi + tiny * 1j, phi1)[0].imag / tiny, rel=1e-13)
    assert found[2] == pytest.approx(at(phi, phi1 + tiny * 1j)[0].imag / tiny, rel=1e-13)
    assert found[3] == pytest.approx(at(phi, phi1, tiny * 1j)[0].imag / tiny, rel=1e-13)
    assert -found[4] == pytest.approx(shear @ out + phi1 * second @ around, rel=1e-12)


def test_internal_force_is_that_of_the_rod_on_the_wall_and_in_the_straight_hole() -> None:
    """In t, d₁, u₁: F₁, F₂, F₃ of the curved wall; without curvature the force in space of the straight hole."""
    k, rates, drive = (0.6, -0.8), (0.3, 0.5), -70.0
    phi, phi1, phi2, phi3 = 0.4, 1.3, -2.1, 7.0
    cos, sin = np.cos(phi), np.sin(phi)
    r, around = np.array([-cos, sin]) * D, np.array([sin, cos]) * D
    position = np.stack([r, phi1 * around, phi2 * around - phi1**2 * r,
                         (phi3 - phi1**3) * around - 3.0 * phi1 * phi2 * r], axis=1)[:, :, None]  # fmt: skip
    one = np.ones(1)
    found = in_curved_hole(*position, np.outer(k, one), np.outer(rates, one), drive * one, TWIST)
    force = (drive / (1.0 + D * k[0])) * 1.0
    hole = (*k, 0.0, 0.0, 0.0, 0.0)
    known = curved_strand(D * phi, D * phi1, D * phi2, D * phi3, hole, (*rates, 0.0, 0.0), D, TWIST, force, 0.0)
    t, d1 = found.t[:, 0], np.array([cos, -sin, 0.0])
    u1 = np.cross(t, d1)
    np.testing.assert_allclose([t @ found.n[:, 0], d1 @ found.n[:, 0], u1 @ found.n[:, 0]], known[3:6], rtol=1e-12)
    assert found.curvature[0] == pytest.approx(np.hypot(known[1], known[2]), rel=1e-13)
    straight = in_curved_hole(*position, np.zeros((2, 1)), np.zeros((2, 1)), drive * one, TWIST)
    plain = in_space(*position, drive * one, TWIST, one, 0.0 * one)
    np.testing.assert_allclose(straight.n, plain.n, rtol=1e-13, atol=1e-12)


def test_the_opposite_wall_of_the_opposite_curve_under_the_opposite_weight_is_the_same() -> None:
    """Half a turn about T: x, y, k₁, k₂, the weight across and the generator x = −Δ change signs, nothing else."""
    one = curved_hole_density(U, (0.6, -0.8), D, TWIST, LOADS, np.array([1.0, 0.0, 0.0]))
    other = curved_hole_density(-U, (-0.6, 0.8), -D, TWIST, LOADS * [1.0, -1.0, -1.0], np.array([1.0, 0.0, 0.0]))
    assert other[:2] == pytest.approx(one[:2], rel=1e-14)
    np.testing.assert_allclose(other[2], -np.array(one[2]), rtol=1e-13)
    np.testing.assert_allclose(np.array(other[4]), np.array(one[4]), rtol=1e-12, atol=1e-12)
