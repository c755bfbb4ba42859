"""The rod in its hole as a model for chains of stretches: both energies, in the unit of length Δ across the axis.

Lateral position and y are measured in Δ, the energy in BΔ²/L³, so that numbers are of order one; places s stay in L.
On the wall the density of :mod:`rodwell.physics.on_wall` serves, off it that of :mod:`rodwell.physics.off_wall`; they
are equal where both hold. A section of a string is a uniform rod of its own constants, on the wall and off it
(:mod:`rodwell.physics.on_wall.sections`), in a hole of its own clearance; what is ``given`` in an element are these: b,
q, d and the clearance ρ in Δ, in that order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.numerics.stretches.descent import pressed_in
from rodwell.physics.off_wall._density import hole_density
from rodwell.physics.off_wall.forces import radially_at_wall
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, COUNT, FORCE, LATERAL_WEIGHT, SIDE, TWIST
from rodwell.physics.on_wall.sections import of_section, section_density
from rodwell.physics.on_wall.strand import contact_pressure
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

_FREE = ((0, 1), (0, 2), (1, 1), (1, 2))
"""Field and derivative that the Hessian off the wall belongs to."""

_BY_FORCE = np.eye(COUNT)[FORCE]
"""Rates of the parameters as the end force grows."""


@dataclass(frozen=True)
class RodInHole:
    """The two densities of a problem, behind a hard wall, or one of this stiffness, in B/L⁴."""

    problem: Problem
    stiffness: float = math.inf

    @property
    def soft(self) -> bool:
        """Whether the wall gives way."""
        return math.isfinite(self.stiffness)

    @cached_property
    def _unloaded(self) -> FloatArray:
        out, problem = np.zeros(COUNT), self.problem
        out[AXIAL_WEIGHT], out[LATERAL_WEIGHT] = problem.axial_weight, problem.foundation
        out[CLEARANCE], out[TWIST], out[SIDE] = problem.clearance, problem.twist, 1.0
        return out

    @cached_property
    def given(self) -> FloatArray:
        """b, q, d and ρ of each section, (n, 4)."""
        rod = self.problem.rod
        offset, weight = rod.lever.coefficients.T
        return np.stack([rod.stiffness.coefficients[:, 0], weight, offset, rod.clearance.coefficients[:, 0]], axis=1)

    def load_per_length(self, given: FloatArray) -> FloatArray:
        """Axial weight q wₐ: a section's density depends on s only through N(s) = F + wₐ(d + q(s − 1))."""
        return np.asarray(given[1] * self.problem.axial_weight)

    def parameters(self, load: float) -> FloatArray:
        """Parameters at an end force: those of the rod kept on the wall, the first of which serve off it."""
        out = self._unloaded.copy()
        out[FORCE] = load
        return out

    def _beside(self, load: float, given: FloatArray) -> list[Any]:
        """Parameters at an end force, with the clearance beside each element."""
        out = list(self.parameters(load))
        out[CLEARANCE] = self.problem.clearance * given[3]
        return out

    def rim(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density on the wall and its derivatives, from the angle with two derivatives, (1, 3, e, q)."""
        d, radius = self.problem.clearance, given[3]
        y = (d * radius) * u[0]
        e, rate, g, m, h = section_density(s, y[0], y[1], y[2], given[:3], self._beside(load, given), _BY_FORCE)
        shape = s.shape
        hessian = np.empty((1, 3, 1, 3, *shape))
        for i in range(3):
            for j in range(3):
                hessian[0, i, 0, j] = h[i][j]
        gradient, mixed = radius * _stacked(g, shape) / d, radius * _stacked(m, shape) / d
        return e / d**2, rate / d**2, gradient, mixed, radius**2 * hessian

    def interior(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density off the wall and its derivatives, from X and Y with two derivatives, (2, 3, e, q)."""
        d = self.problem.clearance
        (x, x1, x2), (_, y1, y2) = d * u
        b = given[0]  # of the softness 1/b under every load, as in the sections of a rod on the wall
        own = of_section(given[:3], self._beside(load, given), 1.0 / b)
        e, rate, g, m, h = hole_density(s, x, x1, x2, y1, y2, own, _BY_FORCE)
        shape = s.shape
        gradient, mixed = np.zeros((2, 3, *shape)), np.zeros((2, 3, *shape))
        gradient[0, 0], mixed[0, 0] = g[0], m[0]
        hessian = np.zeros((2, 3, 2, 3, *shape))
        for i, (f, k) in enumerate(_FREE):
            gradient[f, k], mixed[f, k] = g[1 + i], m[1 + i]
            for j, (other, order) in enumerate(_FREE):
                hessian[f, k, other, order] = h[i][j]
        energy, gradient, hessian = b * e / d**2, b * gradient / d, b * hessian
        if self.soft:
            energy = energy + pressed_in(self.stiffness, u[:, 0], gradient, hessian)
        return energy, rate / d**2, gradient, mixed / d, hessian

    def rim_reaction(self, rate: FloatArray, bend: FloatArray, given: FloatArray) -> tuple[FloatArray, ...]:
        """Radial moment at a cut of a rod on the wall, its derivative by φ′, and its outward force, (k,) each.

        From φ′ and φ″ there: :func:`rodwell.physics.off_wall.forces.radially_at_wall`.
        """
        d, radius = self.problem.clearance, self.problem.clearance * given[3]
        moment, by_rate, outward = radially_at_wall(rate, bend, radius, self.problem.twist, given[0])
        return moment / d, by_rate / d, outward / d

    def pressure(self, s: FloatArray, angle: FloatArray, load: float, given: FloatArray) -> FloatArray:
        """Contact pressure p on the wall, negative in contact, from the angle with three derivatives (4, k)."""
        y = self.problem.clearance * given[3] * angle
        own = of_section(given[:3], self._beside(load, given))
        return np.asarray(contact_pressure(s, y[0], y[1], y[2], y[3], own, given[0]))


def _stacked(rows: Any, shape: tuple[int, ...]) -> FloatArray:
    out = np.zeros((1, 3, *shape))
    for i, row in enumerate(rows):
        out[0, i] = row
    return out
