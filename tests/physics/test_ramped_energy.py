"""The rod on a wall whose clearance varies: generated, that of one clearance without slope, and the curve in space.

The second method is the rod as a curve in space, differentiated by Chebyshev interpolation.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial import chebyshev

from rodwell import Problem, ramp
from rodwell.analysis.discrete.family import parameters
from rodwell.analysis.discrete.ramped import along_ramps
from rodwell.physics.on_wall import _ramped_density, ramped_energy
from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, COUNT, FORCE, LATERAL_WEIGHT
from rodwell.physics.on_wall.ramps import RodOnRamps, axial_resultant, lying_push, strand, wall_at
from rodwell.physics.on_wall.strand import contact_pressure, curvatures, strand_force
from rodwell.quantities.arrays import FloatArray

TAPERED = ((0.3, 2.0, 1.5, 1.2), *ramp(0.5, 1.2, 1.0, stiffness=(2.0, 0.8), weight=(1.5, 0.6)), (0.2, 0.8, 0.6))
STEEP = Problem(60.0, 55.0, clearance=0.09, sections=TAPERED)
NODES = 40


def test_formulas_are_those_that_the_symbolic_energy_generates() -> None:
    assert Path(_ramped_density.__file__).read_text(encoding="utf-8") == ramped_energy.generate()


def test_where_the_clearance_is_constant_it_is_the_rod_of_one_clearance() -> None:
    """Beside a ramp whose push along the hole is in N."""
    own, s = parameters(STEEP, -80.0), np.array([0.87])
    given = along_ramps(STEEP)(s).T
    wall = wall_at(s, given)
    rates = np.zeros(COUNT)
    rates[[FORCE, AXIAL_WEIGHT, LATERAL_WEIGHT]] = 1.0, 0.3, 0.4
    u = np.array([0.02, 0.31, -1.7, 23.0])[:, None]
    b, q = 0.8, 0.6
    as_one = own / np.array([b, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    as_one[FORCE] = float(axial_resultant(s, given, wall, own)[0]) / b
    as_one[AXIAL_WEIGHT], as_one[LATERAL_WEIGHT] = 0.0, q * own[LATERAL_WEIGHT] / b
    along = np.zeros(COUNT)
    along[FORCE], along[LATERAL_WEIGHT] = (1.0 - 0.3 * q * 0.13) / b, 0.4 * q / b
    found = RodOnRamps.density(s, u[:3], given, own, rates)
    known = rod_density(s, *u[:3], as_one, along)
    for ours, theirs in zip(found, known, strict=True):
        for x, y in zip(_flat(ours), _flat(theirs), strict=True):
            np.testing.assert_allclose(x, b * y, rtol=1e-12, atol=1e-12)
    rod = strand(s, u, given, own)
    np.testing.assert_allclose(rod.omega, np.array(curvatures(*u[1:], own[CLEARANCE]))[1:4], rtol=1e-12)
    np.testing.assert_allclose(rod.force, b * np.array(strand_force(s, *u[1:], as_one)), rtol=1e-11)
    np.testing.assert_allclose(rod.pressure, b * contact_pressure(s, *u, as_one), rtol=1e-11)


def _flat(values: object) -> list[FloatArray]:
    rows = values if isinstance(values, tuple) else (values,)
    return [np.asarray(x, dtype=float) for row in rows for x in (row if isinstance(row, tuple) else (row,))]


class Curve:
    """A rod θ(s) on the wall between two places of a ramp, in space: x up, z along the hole; and its derivatives."""

    def __init__(self, shape: float) -> None:
        self.s = 0.36 + 0.06 * 0.5 * (1.0 + chebyshev.chebpts1(NODES))
        self.given, self.own = along_ramps(STEEP)(self.s).T, parameters(STEEP, -150.0)
        self.wall = wall_at(self.s, self.given)
        self.u = shape * STEEP.clearance * np.array([k * f(3.0 * self.s) for k, f in (
            (0.5, np.sin), (1.5, np.cos), (-4.5, np.sin), (-13.5, np.cos))])  # fmt: skip
        angle, turn = self.u[:2] / STEEP.clearance
        d, d1, *_ = self.wall.clearance
        self.outwards = np.array([-np.cos(angle), np.sin(angle), 0.0 * angle])
        self.around = np.array([np.sin(angle), np.cos(angle), 0.0 * angle])
        self.z1 = np.sqrt(1.0 - d1**2 - (d * turn) ** 2)
        self.tangent = d1 * self.outwards + d * turn * self.around + self.z1 * np.array([[0.0], [0.0], [1.0]])

    def rate(self, f: FloatArray) -> FloatArray:
        c = chebyshev.chebder(chebyshev.chebfit((self.s - 0.39) / 0.03, f.T, NODES - 1))
        return np.atleast_2d(chebyshev.chebval((self.s - 0.39) / 0.03, c)) / 0.03


def test_curvatures_and_forces_are_those_of_the_curve_in_space() -> None:
    rod = Curve(1.0)
    found, b = strand(rod.s, rod.u, rod.given, rod.own), rod.wall.stiffness[0]
    np.testing.assert_allclose(np.linalg.norm(rod.tangent, axis=0), 1.0, rtol=1e-14)
    bent = rod.rate(rod.tangent)
    u1 = rod.around - np.sum(rod.around * rod.tangent, axis=0) * rod.tangent
    u1 /= np.linalg.norm(u1, axis=0)
    d1 = np.cross(u1, rod.tangent, axis=0)
    assert np.all(np.sum(d1 * rod.outwards, axis=0) < -0.99)
    omega = np.array(found.omega)
    scale = np.max(np.abs(omega))
    np.testing.assert_allclose(omega[2], np.sum(bent * d1, axis=0), atol=1e-9 * scale)
    np.testing.assert_allclose(omega[1], -np.sum(bent * u1, axis=0), atol=1e-9 * scale)
    np.testing.assert_allclose(omega[0], np.sum(rod.rate(d1) * u1, axis=0), atol=1e-9 * scale)
    force = found.force[0] * rod.tangent + found.force[1] * d1 + found.force[2] * u1
    moment = b * np.cross(rod.tangent, bent, axis=0)
    left = rod.rate(moment) + np.cross(rod.tangent, force, axis=0)
    assert np.max(np.abs(left)) < 1e-7 * np.max(np.abs(force))
    resultant = axial_resultant(rod.s, rod.given, rod.wall, rod.own)
    np.testing.assert_allclose(force[2], resultant, rtol=1e-12)
    pushed = lying_push(rod.s, rod.given, rod.wall, rod.own) * rod.wall.clearance[1] / rod.wall.lying[0]
    q = rod.wall.weight
    np.testing.assert_allclose(rod.rate(resultant)[0], q * rod.own[AXIAL_WEIGHT] - pushed, atol=1e-8 * 150.0)
    weight = np.array([-q * rod.own[LATERAL_WEIGHT], 0.0 * q, pushed - q * rod.own[AXIAL_WEIGHT]])
    missing = rod.rate(force) + weight  # this rod is in no equilibrium around the hole: something acts there, too
    push, across = (np.sum(missing * way, axis=0) for way in (rod.outwards, rod.around))
    d, rise, *_ = rod.wall.clearance
    around = d * rod.u[1] / STEEP.clearance
    push -= across * around * rise / (1.0 - rise**2)  # which the balance along the rod takes for the wall's
    known = -(push * rod.z1 + pushed * rise) / np.sqrt(1.0 - around**2)
    np.testing.assert_allclose(found.pressure, known, rtol=1e-7)


def test_the_lying_rod_is_pressed_along_the_normal_of_the_wall() -> None:
    rod = Curve(0.0)
    found, push = strand(rod.s, rod.u, rod.given, rod.own), lying_push(rod.s, rod.given, rod.wall, rod.own)
    np.testing.assert_allclose(found.pressure, -push / rod.wall.lying[0], rtol=1e-12)
    assert np.array(found.omega[:2]) == pytest.approx(0.0)
