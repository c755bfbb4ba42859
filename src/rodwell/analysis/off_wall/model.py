"""The rod in its hole as a model for chains of stretches: both energies, in the unit of length Δ across the axis.

Lateral position and y are measured in Δ, the energy in BΔ²/L³, so that numbers are of order one; places s stay in L.
On the wall the density of :mod:`rodwell.physics.on_wall` serves, off it that of :mod:`rodwell.physics.off_wall`; they
are equal where both hold. A section of a string is a uniform rod of its own constants, on the wall and off it
(:mod:`rodwell.physics.on_wall.sections`), in a hole of its own clearance; what is ``given`` in an element are these: b,
q, d and the clearance ρ in Δ, in that order; where sections taper, the polynomials of
:mod:`rodwell.physics.on_wall.tapered` in place of b, q and d.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from rodwell.analysis.discrete.family import polynomials
from rodwell.numerics.stretches.descent import pressed_in
from rodwell.physics.off_wall._density import hole_density
from rodwell.physics.off_wall.forces import InSpace, in_space, radially_at_wall
from rodwell.physics.on_wall._density import rod_density
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, COUNT, FORCE, LATERAL_WEIGHT, SIDE, TWIST
from rodwell.physics.on_wall.sections import of_section, section_density
from rodwell.physics.on_wall.strand import contact_pressure
from rodwell.physics.on_wall.tapered import here, more_pressure, stiffness_rates, weight_rate
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

_FREE = ((0, 1), (0, 2), (1, 1), (1, 2))
"""Field and derivative that the Hessian off the wall belongs to."""

_BY_FORCE = np.eye(COUNT)[FORCE].tolist()
"""Rates of the parameters as the end force grows."""


@dataclass(frozen=True)
class RodInHole:
    """The two densities of a problem, behind a hard wall, or one of this stiffness, in B/L⁴."""

    problem: Problem
    stiffness: float = math.inf

    inclined: ClassVar[bool] = False
    """Whether the clearance varies along sections."""

    @cached_property
    def soft(self) -> bool:
        """Whether the wall gives way."""
        return math.isfinite(self.stiffness)

    @cached_property
    def tapered(self) -> bool:
        """Whether what is given in an element are polynomials."""
        return self.problem.tapered

    @cached_property
    def _unloaded(self) -> FloatArray:
        out, problem = np.zeros(COUNT), self.problem
        out[AXIAL_WEIGHT], out[LATERAL_WEIGHT] = problem.axial_weight, problem.foundation
        out[CLEARANCE], out[TWIST], out[SIDE] = problem.clearance, problem.twist, 1.0
        return out

    @cached_property
    def given(self) -> FloatArray:
        """b, q, d and ρ of each section, (n, 4); where sections taper their polynomials and ρ, (n, 18)."""
        rod = self.problem.rod
        if self.tapered:
            return np.concatenate([polynomials(rod), rod.clearance.coefficients[:, :1]], axis=1)
        offset, weight = rod.lever.coefficients.T
        return np.stack([rod.stiffness.coefficients[:, 0], weight, offset, rod.clearance.coefficients[:, 0]], axis=1)

    def _at(self, s: FloatArray, given: FloatArray) -> Any:
        """b, q, d and ρ at places."""
        return (*here(s, given), given[-1]) if self.tapered else given

    def drift(self, s: FloatArray, u: FloatArray, load: float, mixed: FloatArray, given: FloatArray) -> FloatArray:
        """The derivative of the gradient of a density by s at the same fields (f, 3, e, q) and load.

        The density is linear in b, N and q wₗ, and N′ = q wₐ: in a section of constants nothing else depends on s.
        """
        out = self._at(s, given)[1] * self.problem.axial_weight * mixed
        if not self.tapered:
            return np.asarray(out)
        own, lateral, d, radius = self._beside(0.0, given), np.zeros(COUNT), self.problem.clearance, given[-1]
        lateral[LATERAL_WEIGHT] = self.problem.foundation
        for each in (AXIAL_WEIGHT, LATERAL_WEIGHT, TWIST):
            own[each] = 0.0
        rate, heavier = stiffness_rates(s, given)[0], weight_rate(s, given)
        if u.shape[0] == 1:
            y = (d * radius) * u[0]
            _, _, g, m, _ = section_density(s, y[0], y[1], y[2], (1.0, 1.0, 0.0), own, lateral)
            return np.asarray(out + radius / d * (rate * _stacked(g, s.shape) + heavier * _stacked(m, s.shape)))
        (x, x1, x2), (_, y1, y2) = d * u
        _, _, g, m, _ = hole_density(s, x, x1, x2, y1, y2, own, lateral)
        for i, (f, k) in enumerate(((0, 0), *_FREE)):
            out[f, k] += (rate * g[i] + heavier * m[i]) / d
        return np.asarray(out)

    def parameters(self, load: float) -> FloatArray:
        """Parameters at an end force: those of the rod kept on the wall, the first of which serve off it."""
        out = self._unloaded.copy()
        out[FORCE] = load
        return out

    def _beside(self, load: float, given: FloatArray) -> list[Any]:
        """Parameters at an end force, with the clearance beside each element."""
        out: list[Any] = self.parameters(load).tolist()
        out[CLEARANCE] = self.problem.clearance * given[-1]
        return out

    def rim(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density on the wall and its derivatives, from the angle with two derivatives, (1, 3, e, q)."""
        d, radius, loads = self.problem.clearance, given[-1], self._beside(load, given)
        given = self._at(s, given)
        b, (y, y1, y2) = given[0], (d * radius) * u[0]
        own, along = (of_section(given[:3], one, 1.0 / b) for one in (loads, _BY_FORCE))
        e, rate, g, m, h = rod_density(s, y, y1, y2, own, along)
        gradient, mixed, hessian = *np.empty((2, 1, 3, *s.shape)), np.empty((1, 3, 1, 3, *s.shape))
        slope, curvature = b * radius / d, b * radius**2
        for i in range(3):
            np.multiply(g[i], slope, out=gradient[0, i])
            np.multiply(m[i], slope, out=mixed[0, i])
            for j in range(3):
                np.multiply(h[i][j], curvature, out=hessian[0, i, 0, j])
        return b / d**2 * e, b / d**2 * rate, gradient, mixed, hessian

    def interior(self, s: FloatArray, u: FloatArray, load: float, given: FloatArray) -> tuple[FloatArray, ...]:
        """Density off the wall and its derivatives, from X and Y with two derivatives, (2, 3, e, q)."""
        d = self.problem.clearance
        (x, x1, x2), (_, y1, y2) = d * u
        given = self._at(s, given)
        b = given[0]  # of the softness 1/b under every load, as in the sections of a rod on the wall
        own = of_section(given[:3], self._beside(load, given), 1.0 / b)
        e, rate, g, m, h = hole_density(s, x, x1, x2, y1, y2, own, _BY_FORCE)
        gradient, mixed, hessian = *np.zeros((2, 2, 3, *s.shape)), np.zeros((2, 3, 2, 3, *s.shape))
        energy, slope = b / d**2 * e, b / d
        gradient[0, 0], mixed[0, 0] = slope * g[0], m[0] / d
        for i, (f, k) in enumerate(_FREE):
            np.multiply(g[1 + i], slope, out=gradient[f, k])
            np.divide(m[1 + i], d, out=mixed[f, k])
            for j, (other, order) in enumerate(_FREE):
                np.multiply(h[i][j], b, out=hessian[f, k, other, order])
        if self.soft:
            energy = energy + pressed_in(self.stiffness, u[:, 0], gradient, hessian)
        return energy, rate / d**2, gradient, mixed, hessian

    def rim_reaction(
        self, s: FloatArray, angle: FloatArray, rate: FloatArray, bend: FloatArray, given: FloatArray
    ) -> tuple[FloatArray, ...]:
        """Radial moment at a cut of a rod on the wall, its derivatives by φ, φ′ and the place, its outward force, (k,).

        From φ′ and φ″ there, whatever φ: :func:`rodwell.physics.off_wall.forces.radially_at_wall`. Where the stiffness
        tapers, the moment of bending, −b Δ φ′², changes with it along the rod, and a force bears that too.
        """
        stiffer = stiffness_rates(s, given)[0] if self.tapered else 0.0
        given = self._at(s, given)
        d, radius = self.problem.clearance, self.problem.clearance * given[3]
        moment, by_rate, outward = radially_at_wall(rate, bend, radius, self.problem.twist, given[0])
        by_place = -stiffer * radius * rate**2
        return moment / d, np.zeros_like(angle), by_rate / d, by_place / d, (outward + by_place) / d

    def in_space(self, s: FloatArray, x: FloatArray, y: FloatArray, load: float) -> InSpace:
        """Tangent and internal force in space, from x and y with three derivatives, (4, k) each."""
        problem, stiffness = self.problem, self.problem.rod.stiffness
        n = load + problem.axial_weight * problem.rod.lever(s)
        return in_space(x, y, n, problem.twist, stiffness(s), stiffness.derivative(s))

    def unit(self, s: FloatArray) -> FloatArray | float:
        """The unit of fields at places, over Δ."""
        return 1.0

    def across(self, s: FloatArray, fields: FloatArray) -> FloatArray:
        """x, y with derivatives in L, (2, orders, k), from fields with derivatives."""
        return np.asarray(self.problem.clearance * fields)

    def resultants(self, load: float) -> FloatArray:
        """N at both ends of each section, (2, n)."""
        problem, breaks = self.problem, self.problem.rod.breaks
        return np.stack([load + problem.axial_weight * problem.rod.lever(s) for s in (breaks[:-1], breaks[1:])])

    def bed(self, load: float) -> FloatArray:
        """√(wₗ/(bΔ)) of each section, (n,): its least stiffness, its largest weight."""
        problem, rod = self.problem, self.problem.rod
        b, q, radius = rod.ranges["stiffness"][0], rod.sizes_of_weight, self.given[:, -1]
        return np.asarray(np.sqrt(problem.lateral_weight * q / (b * problem.clearance * radius)))

    def firmness(self, load: float) -> float:
        """How many times as stiff soft walls must be, on which shapes are sought, as where weight alone presses."""
        return 1.0

    def pressure(self, s: FloatArray, angle: FloatArray, load: float, given: FloatArray) -> FloatArray:
        """Contact pressure p on the wall, negative in contact, from the angle with three derivatives (4, k)."""
        y, at = self.problem.clearance * given[-1] * angle, self._at(s, given)
        own = of_section(at[:3], self._beside(load, given))
        pressure = contact_pressure(s, y[0], y[1], y[2], y[3], own, at[0])
        if self.tapered:
            pressure = pressure + more_pressure(y[1], y[2], y[3], own[CLEARANCE], *stiffness_rates(s, given))
        return np.asarray(pressure)


def _stacked(rows: Any, shape: tuple[int, ...]) -> FloatArray:
    out = np.zeros((1, 3, *shape))
    for i, row in enumerate(rows):
        out[0, i] = row
    return out
