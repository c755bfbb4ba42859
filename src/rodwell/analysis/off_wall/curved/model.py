"""The rod in a curved hole as a model for chains of stretches: as in a straight one, with the hole beside each place.

On the wall the density of :mod:`rodwell.physics.on_wall.curved` serves, off it that of
:mod:`rodwell.physics.off_wall.curved_energy`; they are equal where both hold. Both take the hole where the undeformed
rod is (:mod:`rodwell.analysis.discrete.curved`), or where tables say.

A section of a string has b times the energy of a rod of stiffness 1 under 1/b of the loads, in a hole of its own
clearance. The terms of the energy that are linear in the curvature of the offset, b k₁ x″ among them, are no total
derivative where b has steps: the densities keep them, and so a string is off the wall beside its steps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.analysis.discrete.curved import HoleAlong, along_rod, along_uniform_rod, carried
from rodwell.analysis.discrete.family import parameters
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.varying.model import RodBesideVaryingWall
from rodwell.physics.off_wall._curved_density import curved_hole_density
from rodwell.physics.off_wall.curved_forces import in_curved_hole, radially_at_curved_wall
from rodwell.physics.off_wall.forces import InSpace
from rodwell.physics.on_wall._curved_density import curved_density
from rodwell.physics.on_wall.curved import CENTRE, FIRST, FUNCTIONS, SCALE, STIFFNESS, TERMS, strand
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, TWIST
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

K1, K2, G1, G2, LIFT, OFFSET = range(len(FUNCTIONS))

FIRM = 1e4
"""Largest contact force per length over the clearance, in B/L⁴, up to which soft walls serve as in a straight hole."""

PLACES = np.linspace(0.0, 1.0, 33)
"""Places in each section at which it is seen how much the rod is compressed and pressed."""

STEP = 1e-30
"""Imaginary part of a complex step."""

_ACROSS = slice(FIRST + G1 * TERMS, FIRST + LIFT * TERMS)
_ALONG = slice(FIRST + LIFT * TERMS, FIRST + (OFFSET + 1) * TERMS)
"""Coefficients of g₁ and g₂, and of A and C."""


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
        """The tables of the hole; of a string with g₁, g₂ of weight ratio 1, and A of its own weight."""
        if self.along is not None:
            return self.along
        found = along_rod(self.problem)
        return alike_in_sections(found, along_uniform_rod(self.problem)) if self.problem.sections else found

    @cached_property
    def beside(self) -> HoleBeside:
        """The hole beside each place of the rod."""
        return HoleBeside(self.tables)

    def parameters(self, load: float) -> FloatArray:
        """Parameters at an end force, as kernels on the wall take them: the weight is the whole one."""
        return parameters(self.problem, load)

    @cached_property
    def given(self) -> FloatArray:
        """Of each section b, q, d and ρ, and what it carries on of the force along the hole, (n, 5)."""
        return np.concatenate([super().given, carried(self.problem)[:, None]], axis=1)

    def farther(self, s: FloatArray, k1: Any) -> Any:
        """(1 + rk₁) c at places ``s``, where N is that many times F − wA + C: see :func:`carried`."""
        section = self.problem.rod.clearance.piece_of(s.ravel()).reshape(s.shape)
        return (1.0 + self.problem.clearance * self.given[section, 3] * k1) * self.given[section, 4]

    def farther_at_end(self, k1: Any) -> Any:
        """How much farther the loaded end moves than a place on the hole's axis, 1 + Δk₁."""
        return 1.0 + self.problem.clearance * float(self.given[-1, 3]) * k1

    def _farther(self, k1: Any, given: FloatArray) -> Any:
        """The same as for places, of elements."""
        return (1.0 + self.problem.clearance * given[3] * k1) * given[4]

    def _drive(self, hole: Any, load: float) -> Any:
        """F − wA + C."""
        return load - self.problem.weight * hole[LIFT] + hole[OFFSET]

    def drive(self, s: FloatArray, load: float) -> FloatArray:
        """N (m,): the force that drives the rod at ``s`` along the hole, reduced to its axis, in B/L²."""
        hole = self.beside(s)
        return np.asarray(self.farther(s, hole[K1]) * self._drive(hole, load))

    def pressed(self, s: FloatArray, load: float) -> FloatArray:
        """By how much the undeformed rod is pressed to the wall at places of any shape, per length, for small slopes.

        It is ∫ b(κ + x″)²/2 − N(1 + κx) ds with the weight that is least, x the height above the wall.
        """
        hole, drive, rod, at = self.beside(s), self.drive(s, load), self.problem.rod, s.ravel()
        weight, b = rod.weight(at).reshape(s.shape), rod.stiffness(at).reshape(s.shape)
        return np.asarray(self.problem.weight * weight * hole[G1] - drive * hole[K1] + b * hole[K1] ** 3)

    def drift(self, s: FloatArray, u: FloatArray, load: float, mixed: FloatArray, given: FloatArray) -> FloatArray:
        """The derivative of the gradient by s: by N, w g₁ and w g₂, in which the densities are linear, and k₁, k₂."""
        rates, weight, d = self.beside.rates(s), self.problem.weight, self.problem.clearance
        out = (rates[OFFSET] - weight * rates[LIFT]) * mixed
        first, second = weight / d * given[1] * rates[G1], weight / d * given[1] * rates[G2]
        if u.shape[0] == 1:
            out[0, 0] += given[3] * (first * np.sin(u[0, 0]) + second * np.cos(u[0, 0]))
        else:
            out[0, 0] += first
            out[1, 0] += second
        if np.any(rates[:2]):
            hole = self.beside(s).astype(complex)
            hole[:2] += 1j * STEP * rates[:2]
            out += self._drift_of_bends(hole, u, load, given)
        return np.asarray(out)

    def _drift_of_bends(self, hole: FloatArray, u: FloatArray, load: float, given: FloatArray) -> FloatArray:
        """The part of k₁′ and k₂′, by a complex step: the densities take k₁ and k₂ as they are."""
        found = (self._on_rim if u.shape[0] == 1 else self._within)(hole, u, load, given)[2]
        b, d = given[0], self.problem.clearance
        slope = b * given[3] / d if u.shape[0] == 1 else b / d
        parts = [np.broadcast_to(slope * np.imag(one) / STEP, u.shape[2:]) for one in found]
        return np.stack(parts).reshape(u.shape)

    def rim(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density on the wall and its derivatives, from the angle with two derivatives, (1, 3, e, q)."""
        d, b, ratio = self.problem.clearance, given[0], given[3]
        e, rate, g, m, h = self._on_rim(self.beside(s), u, load, given)
        gradient, mixed, hessian = *np.empty((2, 1, 3, *s.shape)), np.empty((1, 3, 1, 3, *s.shape))
        slope, curvature = b * ratio * (1.0 / d), b * ratio**2
        for i in range(3):
            np.multiply(g[i], slope, out=gradient[0, i])
            np.multiply(m[i], slope, out=mixed[0, i])
            for j in range(3):
                np.multiply(h[i][j], curvature, out=hessian[0, i, 0, j])
        return b * e / d**2, b * rate / d**2, gradient, mixed, hessian

    def _on_rim(self, hole: FloatArray, u: FloatArray, load: float, given: FloatArray) -> Any:
        """The density on the wall of a rod of stiffness 1 with what a hole is there; ``hole`` is written to."""
        b, radius, own = given[0], self.problem.clearance * given[3], self._own(load, given)
        y, y1, y2 = radius * u[0]
        further = given[4]
        hole[[G1, G2]] *= given[1]
        hole[LIFT], hole[OFFSET] = further * hole[LIFT], further / b * hole[OFFSET]
        own[FORCE] = further * own[FORCE]
        along: list[Any] = [0.0] * len(own)
        along[FORCE] = further / b
        return curved_density(y, y1, y2, tuple(hole), radius, own, along)

    def _own(self, load: float, given: FloatArray) -> list[Any]:
        """Parameters of a rod of stiffness 1: 1/b of the loads."""
        out: list[Any] = self.parameters(load).tolist()
        for one in (FORCE, AXIAL_WEIGHT, TWIST):
            out[one] = out[one] / given[0]
        return out

    def interior(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density off the wall and its derivatives, from X and Y with two derivatives, (2, 3, e, q)."""
        d, b = self.problem.clearance, given[0]
        e, rate, g, m, h = self._within(self.beside(s), u, load, given)
        gradient, mixed, hessian = *np.empty((2, 6, *s.shape)), np.empty((6, 6, *s.shape))
        for i in range(6):
            np.multiply(g[i], b * (1.0 / d), out=gradient[i])
            np.multiply(m[i], b * (1.0 / d), out=mixed[i])
            for j in range(6):
                np.multiply(h[i][j], b, out=hessian[i, j])
        pair = (2, 3, *s.shape)
        return b * e / d**2, b * rate / d**2, gradient.reshape(pair), mixed.reshape(pair), hessian.reshape(2, 3, *pair)

    def _within(self, hole: FloatArray, u: FloatArray, load: float, given: FloatArray) -> Any:
        """The density off the wall of a rod of stiffness 1 with what a hole is there."""
        d, b, weight = self.problem.clearance, given[0], self.problem.weight / given[0] * given[1]
        farther = self._farther(hole[K1], given)
        loads = farther * self._drive(hole, load) / b, weight * hole[G1], weight * hole[G2]
        return curved_hole_density(
            d * u.reshape(6, *u.shape[2:]), hole[:2], d * given[3], self.problem.twist / b, loads,
            (farther / b, 0.0, 0.0),
        )  # fmt: skip

    def rim_reaction(
        self, s: FloatArray, angle: FloatArray, rate: FloatArray, bend: FloatArray, given: FloatArray
    ) -> tuple[FloatArray, ...]:
        """What a rod on the wall exerts radially at a cut, (k,) each: see :func:`radially_at_curved_wall`."""
        d, bends, rates = self.problem.clearance, self.beside(s)[:2], self.beside.rates(s)[:2]
        b, radius = given[0], d * given[3]
        found = radially_at_curved_wall((angle, rate, bend), bends, rates, radius, self.problem.twist / b)
        return tuple(b * one / d for one in found)

    def pressure(self, s: FloatArray, angle: FloatArray, load: float, given: FloatArray) -> FloatArray:
        """Contact pressure p on the wall, negative in contact, from the angle with three derivatives (4, …)."""
        rows = np.moveaxis(self.tables(s.ravel()).reshape(*s.shape, -1), -1, 0)
        radius, own = self.problem.clearance * given[3], self.parameters(load).tolist()
        further = given[4]
        rows = np.concatenate([np.broadcast_to(given[0], s.shape)[None], rows[1:]])
        rows[_ACROSS] *= given[1]
        rows[_ALONG] *= further
        own[FORCE], own[CLEARANCE] = further * load, radius
        return np.asarray(strand(s, radius * angle, rows, own)[-1])

    def in_space(self, s: FloatArray, x: FloatArray, y: FloatArray, load: float) -> InSpace:
        """Tangent and internal force by N₁, N₂, T of the hole there, from x and y with three derivatives, (4, k)."""
        bends, rates, b = self.beside(s)[:2], self.beside.rates(s)[:2], self.problem.rod.stiffness(s)
        t, n, curvature, tension = in_curved_hole(x, y, bends, rates, self.drive(s, load) / b, self.problem.twist / b)
        return InSpace(t, b * n, curvature, b * tension)

    def resultants(self, load: float) -> FloatArray:
        """The largest and the least of N along each section, (2, n)."""
        drive = self.drive(self._looked_at, load)
        return np.array([np.max(drive, axis=1), np.min(drive, axis=1)])

    @cached_property
    def _looked_at(self) -> FloatArray:
        breaks = self.problem.rod.breaks
        return np.asarray(breaks[:-1, None] + np.diff(breaks)[:, None] * PLACES)

    def bed(self, load: float) -> FloatArray:
        """√(P/(bΔ)) of the largest contact force per length P that weight and bend press each section with, (n,)."""
        hole, (b, q, _, radius, _) = self.beside(self._looked_at), self.given.T[..., None]
        bent = np.hypot(hole[K1], hole[K2])
        pressed = self.problem.weight * np.abs(q) * np.hypot(hole[G1], hole[G2])
        pressed = pressed + bent * (np.abs(self.drive(self._looked_at, load)) + b * bent)
        return np.asarray(np.sqrt(np.max(pressed / (b * radius), axis=1) / self.problem.clearance))

    def firmness(self, load: float) -> float:
        """How many times as stiff soft walls must be as in a straight hole: the curve presses the rod into them."""
        return max(1.0, float(np.max(self.bed(load))) ** 2 / FIRM)


def alike_in_sections(own: HoleAlong, uniform: HoleAlong) -> HoleAlong:
    """Tables with A and C of a string, and all else of a uniform rod on the same pieces: sections do the rest."""
    rows = own.rows.copy()
    rows[:, STIFFNESS], rows[:, _ACROSS] = 1.0, uniform.rows[:, _ACROSS]
    return HoleAlong(own.breaks, rows)


def rod_in_hole(problem: Problem, stiffness: float = math.inf) -> RodInHole:
    """The rod of a problem as a model for chains of stretches, behind a hard wall, or one of this stiffness in B/L⁴."""
    if problem.ramps:
        return RodBesideVaryingWall(problem, stiffness)
    return RodInHole(problem, stiffness) if problem.hole is None else RodOffCurvedWall(problem, stiffness)
