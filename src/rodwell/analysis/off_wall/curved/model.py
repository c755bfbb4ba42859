"""The rod in a curved hole as a model for chains of stretches: as in a straight one, with the hole beside each place.

On the wall the density of :mod:`rodwell.physics.on_wall.curved` serves, off it that of
:mod:`rodwell.physics.off_wall.curved_energy`; they are equal where both hold. Both take the hole where the undeformed
rod is (:mod:`rodwell.analysis.discrete.curved`), or where tables say.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rodwell.analysis.discrete.curved import HoleAlong, along_rod
from rodwell.analysis.discrete.family import parameters
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.physics.off_wall._curved_density import curved_hole_density
from rodwell.physics.off_wall.curved_forces import in_curved_hole, radially_at_curved_wall
from rodwell.physics.off_wall.forces import InSpace
from rodwell.physics.on_wall._curved_density import curved_density
from rodwell.physics.on_wall.curved import CENTRE, FIRST, FUNCTIONS, SCALE, TERMS, strand
from rodwell.physics.on_wall.parameters import FORCE
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

K1, K2, G1, G2, LIFT, OFFSET = range(len(FUNCTIONS))

FIRM = 1e4
"""Largest contact force per length over the clearance, in B/L⁴, up to which soft walls serve as in a straight hole."""

PLACES = np.linspace(0.0, 1.0, 33)
"""Places at which it is seen how much the rod is compressed and pressed."""


@dataclass(frozen=True)
class HoleBeside:
    """What tables say of the hole beside the rod: k₁, k₂, g₁, g₂, A and C as polynomials, piece by piece."""

    along: HoleAlong

    @cached_property
    def _coefficients(self) -> tuple[FloatArray, FloatArray]:
        """Of the functions and of their derivatives, (TERMS, pieces, 6) each; the second without the scale."""
        shape = (-1, len(FUNCTIONS), TERMS)
        found = self.along.rows[:, FIRST:].reshape(shape).transpose(2, 0, 1)
        return np.ascontiguousarray(found), found[1:] * np.arange(1.0, TERMS)[:, None, None]

    def _at(self, s: FloatArray, order: int) -> FloatArray:
        piece = np.searchsorted(self.along.breaks[1:-1], s, side="right")
        rows, coefficients = self.along.rows, self._coefficients[order]
        x = ((s - rows[piece, CENTRE]) * rows[piece, SCALE])[..., None]
        value = coefficients[-1][piece]
        for one in coefficients[-2::-1]:
            value = value * x + one[piece]
        return np.moveaxis(value * rows[piece, SCALE, None] if order else value, -1, 0)

    def __call__(self, s: FloatArray) -> FloatArray:
        """The six functions at places of any shape, (6, …)."""
        return self._at(s, 0)

    def rates(self, s: FloatArray) -> FloatArray:
        """Their derivatives along the rod, (6, …)."""
        return self._at(s, 1)


@dataclass(frozen=True)
class RodOffCurvedWall(RodInHole):
    """The two densities of a problem in a curved hole; ``along`` are tables of it, None: beside the undeformed rod."""

    along: HoleAlong | None = field(default=None, compare=False)

    @cached_property
    def tables(self) -> HoleAlong:
        """The tables of the hole."""
        return along_rod(self.problem) if self.along is None else self.along

    @cached_property
    def beside(self) -> HoleBeside:
        """The hole beside each place of the rod."""
        return HoleBeside(self.tables)

    def parameters(self, load: float) -> FloatArray:
        """Parameters at an end force, as kernels on the wall take them: the weight is the whole one."""
        return parameters(self.problem, load)

    def drive(self, s: FloatArray, load: float) -> FloatArray:
        """N (m,): the force that drives the rod at ``s`` along the hole, reduced to its axis, in B/L²."""
        return np.asarray(self._loads(self.beside(s), load)[0])

    def drift(self, s: FloatArray, u: FloatArray, load: float, mixed: FloatArray, given: FloatArray) -> FloatArray:
        """The derivative of the gradient by s: by N, w g₁ and w g₂, in which the densities are linear, and k₁, k₂."""
        rates, weight, d = self.beside.rates(s), self.problem.weight, self.problem.clearance
        out = (rates[OFFSET] - weight * rates[LIFT]) * mixed
        first, second = weight / d * rates[G1], weight / d * rates[G2]
        if u.shape[0] == 1:
            out[0, 0] += first * np.sin(u[0, 0]) + second * np.cos(u[0, 0])
        else:
            out[0, 0] += first
            out[1, 0] += second
        if np.any(rates[:2]):
            out += self._drift_of_bends(s, u, load, rates)
        return np.asarray(out)

    def _drift_of_bends(self, s: FloatArray, u: FloatArray, load: float, rates: FloatArray) -> FloatArray:
        """The part of k₁′ and k₂′, by a complex step: the densities take k₁ and k₂ as they are."""
        d, hole, step = self.problem.clearance, self.beside(s).astype(complex), 1e-30
        hole[:2] += 1j * step * rates[:2]
        if u.shape[0] == 1:
            y, y1, y2 = d * u[0]
            along = np.zeros(self.parameters(load).size)
            gradient = curved_density(y, y1, y2, tuple(hole), d, self.parameters(load), along)[2]
        else:
            loads = self._loads(hole, load)
            gradient = curved_hole_density(
                d * u.reshape(6, *s.shape), hole[:2], d, self.problem.twist, loads, (0.0, 0.0, 0.0)
            )[2]
        parts = [np.broadcast_to(np.imag(one) / (step * d), s.shape) for one in gradient]
        return np.stack(parts).reshape(u.shape)

    def _loads(self, hole: FloatArray, load: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """N = (1 + Δk₁)(F − w A + C), w g₁ and w g₂ of the hole beside places."""
        weight = self.problem.weight
        drive = (1.0 + self.problem.clearance * hole[K1]) * (load - weight * hole[LIFT] + hole[OFFSET])
        return drive, weight * hole[G1], weight * hole[G2]

    def rim(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density on the wall and its derivatives, from the angle with two derivatives, (1, 3, e, q)."""
        d, own = self.problem.clearance, self.parameters(load)
        y, y1, y2 = d * u[0]
        along = np.zeros(own.size)
        along[FORCE] = 1.0
        e, rate, g, m, h = curved_density(y, y1, y2, tuple(self.beside(s)), d, own, along)
        gradient, mixed, hessian = *np.empty((2, 1, 3, *s.shape)), np.empty((1, 3, 1, 3, *s.shape))
        for i in range(3):
            np.multiply(g[i], 1.0 / d, out=gradient[0, i])
            np.multiply(m[i], 1.0 / d, out=mixed[0, i])
            for j in range(3):
                hessian[0, i, 0, j] = h[i][j]
        return e / d**2, rate / d**2, gradient, mixed, hessian

    def interior(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density off the wall and its derivatives, from X and Y with two derivatives, (2, 3, e, q)."""
        d, hole = self.problem.clearance, self.beside(s)
        e, rate, g, m, h = curved_hole_density(
            d * u.reshape(6, *s.shape), hole[:2], d, self.problem.twist, self._loads(hole, load),
            (1.0 + d * hole[K1], 0.0, 0.0),
        )  # fmt: skip
        gradient, mixed, hessian = *np.empty((2, 6, *s.shape)), np.empty((6, 6, *s.shape))
        for i in range(6):
            np.multiply(g[i], 1.0 / d, out=gradient[i])
            np.multiply(m[i], 1.0 / d, out=mixed[i])
            for j in range(6):
                hessian[i, j] = h[i][j]
        pair = (2, 3, *s.shape)
        return e / d**2, rate / d**2, gradient.reshape(pair), mixed.reshape(pair), hessian.reshape(2, 3, *pair)

    def rim_reaction(
        self, s: FloatArray, angle: FloatArray, rate: FloatArray, bend: FloatArray, given: FloatArray
    ) -> tuple[FloatArray, ...]:
        """What a rod on the wall exerts radially at a cut, (k,) each: see :func:`radially_at_curved_wall`."""
        d, bends, rates = self.problem.clearance, self.beside(s)[:2], self.beside.rates(s)[:2]
        found = radially_at_curved_wall((angle, rate, bend), bends, rates, d, self.problem.twist)
        return tuple(one / d for one in found)

    def pressure(self, s: FloatArray, angle: FloatArray, load: float, given: FloatArray) -> FloatArray:
        """Contact pressure p on the wall, negative in contact, from the angle with three derivatives (4, …)."""
        rows = np.moveaxis(self.tables(s.ravel()).reshape(*s.shape, -1), -1, 0)
        return np.asarray(strand(s, self.problem.clearance * angle, rows, self.parameters(load))[-1])

    def in_space(self, s: FloatArray, x: FloatArray, y: FloatArray, load: float) -> InSpace:
        """Tangent and internal force by N₁, N₂, T of the hole there, from x and y with three derivatives, (4, k)."""
        bends, rates = self.beside(s)[:2], self.beside.rates(s)[:2]
        return in_curved_hole(x, y, bends, rates, self.drive(s, load), self.problem.twist)

    def resultants(self, load: float) -> FloatArray:
        """The largest and the least of N along the rod, (2, 1)."""
        drive = self.drive(PLACES, load)
        return np.array([[np.max(drive)], [np.min(drive)]])

    def bed(self, load: float) -> FloatArray:
        """√(P/Δ) of the largest contact force per length P that weight and bend press the rod with, (1,)."""
        hole, d = self.beside(PLACES), self.problem.clearance
        bent = np.hypot(hole[K1], hole[K2])
        pressed = self.problem.weight * np.hypot(hole[G1], hole[G2]) + bent * (np.abs(self.drive(PLACES, load)) + bent)
        return np.array([math.sqrt(float(np.max(pressed)) / d)])

    def firmness(self, load: float) -> float:
        """How many times as stiff soft walls must be as in a straight hole: the curve presses the rod into them."""
        return max(1.0, float(self.bed(load)[0]) ** 2 / FIRM)


def rod_in_hole(problem: Problem, stiffness: float = math.inf) -> RodInHole:
    """The rod of a problem as a model for chains of stretches, behind a hard wall, or one of this stiffness in B/L⁴."""
    return RodInHole(problem, stiffness) if problem.hole is None else RodOffCurvedWall(problem, stiffness)
