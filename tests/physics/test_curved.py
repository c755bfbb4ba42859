"""The energy in a curved hole: generated, that of the straight hole without curvature, and that of the curve in space.

The second method is the rod as a curve in space: the hole's axis and frame in closed form, positions on its wall, and
derivatives of them by Chebyshev interpolation. Nothing of the formulas enters it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial import chebyshev

from rodwell.physics.on_wall import _curved_density, curved_energy
from rodwell.physics.on_wall._curved_density import curved_density, curved_strand
from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.parameters import RAMP
from rodwell.physics.on_wall.strand import contact_pressure, curvatures, strand_force
from rodwell.problem.hole import Hole

D, TWIST = 0.03, 2.5
NODES = 36
PARAMETERS = np.array([-80.0, 7.0, 11.0, D, TWIST, 1.0, 0.0])
U = np.array([0.02, 0.31, -1.7, 23.0])


def test_formulas_are_those_that_the_symbolic_energy_generates() -> None:
    assert Path(_curved_density.__file__).read_text(encoding="utf-8") == curved_energy.generate()


def test_without_curvature_it_is_the_energy_of_the_straight_hole() -> None:
    s, weight = 0.3, 9.0
    wa, wl = weight * 0.6, weight * 0.8
    ours = np.array([*PARAMETERS[:1], weight, *PARAMETERS[2:]])
    straight = np.array([PARAMETERS[0], wa, wl, *PARAMETERS[3:]])
    rates = np.zeros(RAMP + 1)
    rates[0] = 1.0
    hole = (0.0, 0.0, 0.8, 0.0, (1.0 - s) * 0.6, 0.0)
    found = curved_density(*U[:3], hole, D, ours, rates)
    known = rod_density(s, *U[:3], straight, rates)
    for a, b in zip(found, known, strict=True):
        np.testing.assert_allclose(np.array(a, dtype=float), np.array(b, dtype=float), rtol=1e-13, atol=1e-13)
    strand = curved_strand(*U, hole, (0.0,) * 4, D, TWIST, ours[0], weight)
    np.testing.assert_allclose(strand[:3], np.array(curvatures(*U[1:], D))[1:4], rtol=1e-13)
    np.testing.assert_allclose(strand[3:6], strand_force(s, *U[1:], straight), rtol=1e-12)
    assert strand[6] == pytest.approx(contact_pressure(s, *U, straight), rel=1e-12)


class Curve:
    """A rod θ(s) on the wall of an arc in space, and its derivatives along s from interpolation between nodes."""

    def __init__(self, build: float, walk: float) -> None:
        self.hole, self.k = Hole.arc(50.0, build, walk), (build, -walk)
        self.s = 0.5 * (1.0 + chebyshev.chebpts1(NODES))
        self.angle, self.y1 = 0.5 * np.sin(3.0 * self.s), D * 1.5 * np.cos(3.0 * self.s)
        self.y2, self.y3 = -D * 4.5 * np.sin(3.0 * self.s), -D * 13.5 * np.cos(3.0 * self.s)
        places = 0.4 + 0.0 * self.s
        for _ in range(60):  # S′ = cos η/h
            inwards = self.k[0] * np.cos(self.angle) - self.k[1] * np.sin(self.angle)
            places = 0.1 + self.integral(np.sqrt(1.0 - self.y1**2) / (1.0 + D * inwards))
        n1, n2, self.tangent = self.hole.frame(places).transpose(1, 0, 2)
        cos, sin = np.cos(self.angle)[:, None], np.sin(self.angle)[:, None]
        self.d1, self.u2 = cos * n1 - sin * n2, sin * n1 + cos * n2
        self.n1, self.n2, self.centre = n1, n2, self.hole.points(places) - D * self.d1

    def integral(self, f: np.ndarray) -> np.ndarray:
        c = chebyshev.chebint(chebyshev.chebfit(2.0 * self.s - 1.0, f, NODES - 1), lbnd=-1.0)
        return 0.5 * chebyshev.chebval(2.0 * self.s - 1.0, c)

    def rate(self, f: np.ndarray) -> np.ndarray:
        c = chebyshev.chebder(chebyshev.chebfit(2.0 * self.s - 1.0, f, NODES - 1))
        return 2.0 * chebyshev.chebval(2.0 * self.s - 1.0, c).T


@pytest.mark.parametrize(("build", "walk"), [(0.9, 0.0), (-0.7, 0.0), (0.6, 0.8)])
def test_bending_and_twist_are_those_of_the_curve_in_space(build: float, walk: float) -> None:
    rod = Curve(build, walk)
    t = rod.rate(rod.centre)
    np.testing.assert_allclose(np.linalg.norm(t, axis=1), 1.0, atol=1e-10)  # the rod does not stretch
    u = np.array([D * rod.angle, rod.y1, rod.y2, rod.y3])
    hole = (*rod.k, 0.0, 0.0, 0.0, 0.0)
    omega = curved_strand(*u, hole, (0.0,) * 4, D, 0.0, 0.0, 0.0)[:3]
    bent = rod.rate(t)
    u1 = np.cross(t, rod.d1)
    np.testing.assert_allclose(np.sum(bent * rod.d1, axis=1), omega[2], atol=1e-10)
    np.testing.assert_allclose(np.sum(bent * u1, axis=1), -omega[1], atol=1e-10)
    np.testing.assert_allclose(np.sum(rod.rate(rod.d1) * u1, axis=1), omega[0], atol=1e-10)


def test_energy_is_bending_height_and_the_work_of_loads() -> None:
    build, walk = 0.6, 0.8
    rod = Curve(build, walk)
    n1, n2 = (rod.hole.frame(np.array([0.5]))[0, i, 2] for i in (0, 1))  # any vertical will do, at one place
    force, weight, lift, offset = -30.0, 8.0, 0.21, 0.4
    hole = (*rod.k, n1, n2, lift, offset)
    parameters = np.array([force, weight, 0.0, D, TWIST, 1.0, 0.0])
    u = np.array([D * rod.angle, rod.y1, rod.y2])
    energy = curved_density(*u, hole, D, parameters, np.zeros(RAMP + 1))[0]
    k1, k2 = rod.k
    t = rod.rate(rod.centre)
    bending = 0.5 * np.sum(rod.rate(t) ** 2, axis=1)
    lying = 1.0 + D * k1
    straight = 0.5 * (k1**2 + k2**2) / lying**2
    speed = np.sum(t * rod.tangent, axis=1) / (1.0 + D * (k1 * np.cos(rod.angle) - k2 * np.sin(rod.angle)))
    drive = lying * (force - weight * lift + offset)
    height = -D * (n1 * np.cos(rod.angle) - n2 * np.sin(rod.angle)) + D * n1
    # torque: turn of the rod's frame {t, d₁, u₁} against one that does not rotate about T, N₁ with it
    turn = np.sum(rod.rate(rod.d1) * np.cross(t, rod.d1), axis=1)
    work = -TWIST * (turn + rod.y1 / D)
    known = bending - straight - drive * (speed - 1.0 / lying) + weight * height + work
    inside = slice(1, -1)  # at the last node, second derivatives of the interpolant are known to 1e-8 only
    np.testing.assert_allclose(energy[inside], known[inside], atol=1e-10)
