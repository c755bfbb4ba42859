"""The rod in a hole whose clearance varies smoothly: fields in units of the clearance Δρ(s) where they are.

With U = u/(Δρ) contact is |U| = 1 as in a hole of one clearance, and chains of stretches need not know of it. The
density is that of :mod:`rodwell.physics.off_wall` with u = ΔρU, u′ = Δ(ρU′ + ρ′U), u″ = Δ(ρU″ + 2ρ′U′ + ρ″U), on the
wall with U = −exp(−iφ): no other energy is stated. It counts from the rod that lies along the wall, U = −1, which bends
and shortens where the clearance varies.

The hole is taken where the undeformed rod is. So the wall pushes across the hole, and N(s) is F and weight alone: what
its inclination pushes along it, p Δρ′ per length, goes with the displacement along the hole, which is left out.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from rodwell.analysis.off_wall.model import RodInHole
from rodwell.physics.off_wall.forces import in_space
from rodwell.physics.on_wall.tapered import stiffness_rates
from rodwell.quantities.arrays import ComplexArray, FloatArray

TERMS = 5
"""Coefficients of a clearance along a section, a quartic."""

STEP = 1e-30
"""Complex step."""


class RodBesideVaryingWall(RodInHole):
    """The densities of a problem whose clearance varies along sections.

    What is given in an element: that of a section, then the origin of its clearance and the coefficients of ρ.
    """

    inclined = True

    @cached_property
    def given(self) -> FloatArray:
        """That of sections, (n, 4) or (n, 18), and origin and coefficients of the clearance, (n, 6)."""
        profile = self.problem.rod.clearance
        rows = np.pad(profile.coefficients, ((0, 0), (0, TERMS - profile.coefficients.shape[1])))
        return np.concatenate([super().given, self.problem.rod.breaks[:-1, None], rows], axis=1)

    def unit(self, s: FloatArray) -> FloatArray:
        """ρ(s), the unit of fields over Δ."""
        return self.problem.rod.clearance(np.ravel(s)).reshape(np.shape(s))

    def across(self, s: FloatArray, fields: FloatArray) -> FloatArray:
        """x, y with derivatives in L, (2, orders, k), from fields with derivatives."""
        profile, rates = self.problem.rod.clearance, []
        for _ in range(fields.shape[1]):
            rates.append(profile(s))
            profile = profile.derivative
        return np.asarray(self.problem.clearance * times(rates, fields))

    @staticmethod
    def _rates(s: FloatArray, given: Any) -> list[FloatArray]:
        """ρ with four derivatives."""
        x, terms = s - given[-TERMS - 1], list(given[-TERMS:])
        out = []
        for _ in range(TERMS):
            value = 0.0 * x
            for one in terms[::-1]:
                value = value * x + one
            out.append(value)
            terms = [(k + 1.0) * one for k, one in enumerate(terms[1:])]
        return out

    def _own(self, given: Any, rates: list[FloatArray]) -> Any:
        """What a section of one clearance would be given."""
        return [*given[: -TERMS - 2], rates[0]]

    def interior(self, s: FloatArray, u: FloatArray, load: float, given: Any) -> tuple[FloatArray, ...]:
        """Density off the wall and its derivatives, from X and Y with two derivatives, (2, 3, e, q)."""
        rates = self._rates(s, given)
        own = self._own(given, rates)
        energy, rate, gradient, mixed, hessian = super().interior(s, times(rates, u), load, own)
        lies = super().interior(s, _lying(rates), load, own)
        t = product(rates)
        return (
            energy - lies[0], rate - lies[1], _drawn_back(t, gradient), _drawn_back(t, mixed),
            _drawn_back(t, np.moveaxis(_drawn_back(t, np.moveaxis(hessian, (2, 3), (0, 1))), (2, 3), (0, 1))),
        )  # fmt: skip

    def rim(self, s: FloatArray, u: FloatArray, load: float, given: Any) -> tuple[FloatArray, ...]:
        """Density on the wall and its derivatives, from the angle with two derivatives, (1, 3, e, q)."""
        fields, first, second = around(u[0])
        energy, rate, g, mixed, h = self.interior(s, fields, load, given)
        hessian = np.einsum("fkglab,fkiab,gljab->ijab", h, first, first) + np.einsum("fkab,fkijab->ijab", g, second)
        return (
            energy, rate, np.einsum("fkab,fkiab->iab", g, first)[None],
            np.einsum("fkab,fkiab->iab", mixed, first)[None], hessian[None, :, None],
        )  # fmt: skip

    def drift(self, s: FloatArray, u: FloatArray, load: float, mixed: FloatArray, given: Any) -> FloatArray:
        """The derivative of the gradient of a density by s at the same fields (f, 3, e, q) and load."""
        if u.shape[0] == 1:
            fields, first, _ = around(u[0])
            return np.asarray(np.einsum("fkab,fkiab->iab", self._drift(s, fields, load, given), first)[None])
        return self._drift(s, u, load, given)

    def _drift(self, s: FloatArray, u: FloatArray, load: float, given: Any) -> FloatArray:
        rates = self._rates(s, given)
        own, v, faster = self._own(given, rates), times(rates, u), times(rates[1:], u)
        _, _, g, mixed, h = super().interior(s, v, load, own)
        along = super().drift(s, v, load, mixed, own) + np.sum(h * faster, axis=(2, 3))
        return _drawn_back(product(rates), along) + _drawn_back(product(rates[1:]), g)

    def work_drift(self, s: FloatArray, u: FloatArray, mixed: FloatArray, given: Any) -> FloatArray:
        """The derivative of the density's derivative by the load by s, at the same fields (f, 3, e, q)."""
        rates = self._rates(s, given)
        own, found = self._own(given, rates), 0.0 * s
        for sign, field in ((1.0, around(u[0])[0] if u.shape[0] == 1 else u), (-1.0, _still(s))):
            by_load = super().interior(s, times(rates, field), 0.0, own)[3]
            found = found + sign * np.sum(by_load * times(rates[1:], field), axis=(0, 1))
        return np.asarray(found)

    def inclined_reaction(self, s: FloatArray, jet: FloatArray, load: float, given: Any) -> tuple[FloatArray, ...]:
        """What a rod on the wall does radially at cuts (k,), from φ with three derivatives (4, k).

        With the density e in units of the clearance and r̂ outwards, θ̂ around the hole: the moment M = ∂e/∂U″·r̂, its
        derivatives by φ, φ′ and the place, the outward force R = −(∂e/∂U′ − (∂e/∂U″)′)·r̂ − φ′ ∂e/∂U″·θ̂, (k,) each, and
        the derivative of M by φ″.
        """
        fields, first, _ = (one[..., None] for one in around(jet[:3]))
        place, columns = s[:, None], [one[:, None] for one in given]
        _, _, g, _, h = self.interior(place, fields, load, columns)
        faster = self._drift(place, fields, load, columns)
        third = np.array(_turned(_rates_of_turn(jet), jet[0]))[:, 3:, :, None]
        onward = np.concatenate([fields[:, 1:], third], axis=1)  # U′, U″, U‴
        growth = faster[:, 2] + np.sum(h[:, 2] * onward, axis=(1, 2))
        cos, sin = np.cos(jet[0])[:, None], np.sin(jet[0])[:, None]
        radial, turning = np.stack([-cos, sin]), np.stack([sin, cos])
        moment = np.sum(g[:, 2] * radial, axis=0)
        by = np.einsum("fglab,fab,gliab->iab", h[:, 2], radial, first)
        across = np.sum(g[:, 2] * turning, axis=0)
        by[0] += across
        outward = -np.sum((g[:, 1] - growth) * radial, axis=0) - jet[1][:, None] * across
        by_place = np.sum(faster[:, 2] * radial, axis=0)
        return tuple(one[:, 0] for one in (moment, by[0], by[1], by_place, outward, by[2]))

    def pressure(self, s: FloatArray, angle: FloatArray, load: float, given: Any) -> FloatArray:
        """Contact pressure p across the hole, negative in contact, from the angle with three derivatives (4, …).

        From the balance of forces n′ = wₗ i + wₐ k − p r̂, n of moment balance (``forces``) and its derivative by a
        complex step. The fourth derivative of the angle, which n′ has, follows from what is around the hole.
        """
        problem, rates = self.problem, self._rates(s, given)
        b, q, *_ = self._at(s, self._own(given, rates))
        stiffer, more = stiffness_rates(s, given) if self.tapered else (0.0 * s, 0.0 * s)
        turn = _rates_of_turn(angle)
        fields = np.stack(_turned(turn, angle[0]))  # U to U‴
        fourth = np.stack(_fourth(turn, angle[0]))
        x = problem.clearance * times(rates, fields)
        x4 = problem.clearance * (rates[0] * fourth + 4.0 * rates[1] * fields[:, 3] + 6.0 * rates[2] * fields[:, 2]
                                  + 4.0 * rates[3] * fields[:, 1] + rates[4] * fields[:, 0])  # fmt: skip
        n = load + problem.axial_weight * problem.rod.lever(s.ravel()).reshape(s.shape)
        out, turning = np.stack([-np.cos(angle[0]), np.sin(angle[0])]), np.stack([np.sin(angle[0]), np.cos(angle[0])])
        coefficients = (
            n + 1j * STEP * problem.axial_weight * q, problem.twist, b + 1j * STEP * stiffer,
            stiffer + 1j * STEP * more,
        )  # fmt: skip
        none = np.zeros_like(x4)
        left, by_fourth = (_onward(x, one, coefficients) for one in (x4, turning))
        by_fourth = by_fourth - _onward(x, none, coefficients)
        left[0] -= problem.foundation * q
        further = -np.sum(left * turning, axis=0) / np.sum(by_fourth * turning, axis=0)
        return np.asarray(-np.sum((left + further * by_fourth) * out, axis=0))

    def bed(self, load: float) -> FloatArray:
        """√(wₗ/(bΔ)) of each section, (n,): its least stiffness, its largest weight, its least clearance."""
        problem, rod = self.problem, self.problem.rod
        b, q, radius = rod.ranges["stiffness"][0], rod.sizes_of_weight, rod.ranges["clearance"][0]
        return np.asarray(np.sqrt(problem.lateral_weight * q / (b * problem.clearance * radius)))


def times(rates: list[FloatArray], fields: FloatArray) -> FloatArray:
    """The product of a function and fields (2, orders, …), with derivatives, from the function's derivatives."""
    out = np.zeros((*fields.shape[:2], *np.broadcast_shapes(fields.shape[2:], np.shape(rates[0]))))
    for k in range(fields.shape[1]):
        for j in range(k + 1):
            out[:, k] += _BINOMIAL[k][j] * rates[k - j] * fields[:, j]
    return out


_BINOMIAL = ((1.0,), (1.0, 1.0), (1.0, 2.0, 1.0), (1.0, 3.0, 3.0, 1.0))


def product(rates: list[FloatArray]) -> list[list[Any]]:
    """Derivatives of u, u′, u″ by U, U′, U″: rows of three, 0 where there is none."""
    r, r1, r2 = rates[:3]
    return [[r, 0.0, 0.0], [r1, r, 0.0], [r2, 2.0 * r1, r]]


def _drawn_back(t: list[list[Any]], gradient: FloatArray) -> FloatArray:
    """A gradient (2, 3, …) by the derivatives of U, from that by those of u."""
    return np.stack([sum(t[k][j] * gradient[:, k] for k in range(j, 3)) for j in range(3)], axis=1)


def _still(s: FloatArray) -> FloatArray:
    """The fields of the rod that lies along the wall."""
    out = np.zeros((2, 3, *s.shape))
    out[0, 0] = -1.0
    return out


def _lying(rates: list[FloatArray]) -> FloatArray:
    return times(rates, _still(rates[0]))


def _rates_of_turn(angle: FloatArray) -> list[ComplexArray]:
    """zₖ/z of z = −exp(−iφ) = X + iY, from φ with derivatives: as many of them."""
    out = [np.ones_like(angle[0], dtype=complex), -1j * angle[1]]
    if len(angle) > 2:
        out.append(-1j * angle[2] - angle[1] ** 2)
    if len(angle) > 3:
        out.append(-1j * angle[3] - 3.0 * angle[1] * angle[2] + 1j * angle[1] ** 3)
    return out


def _turned(turn: list[ComplexArray], angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """X and Y on the wall with derivatives, (orders, …) each."""
    z = -np.exp(-1j * angle) * np.array(turn)
    return z.real, z.imag


def _fourth(turn: list[ComplexArray], angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """X⁗ and Y⁗ where φ⁗ = 0: (z‴)′ with z′ = cz, c = −iφ′."""
    c, c1, c2 = turn[1], turn[2] - turn[1] ** 2, turn[3] - 3.0 * turn[1] * turn[2] + 2.0 * turn[1] ** 3
    z = -np.exp(-1j * angle) * (c * turn[3] + 3.0 * c1 * turn[2] + 3.0 * c2 * turn[1])
    return z.real, z.imag


def around(angle: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """X, Y with two derivatives on the wall, (2, 3, …), and their derivatives by φ, φ′, φ″, (2, 3, 3, …), and second.

    From the angle with two derivatives (3, …).
    """
    z, one, shape = -np.exp(-1j * angle[0]), np.ones_like(angle[0]), angle.shape[1:]
    c = _rates_of_turn(angle)
    by = np.zeros((3, 3, *shape), dtype=complex)  # zₖ/z by each
    by[0, 0], by[1, 0], by[2, 0] = (-1j * each for each in c)
    by[1, 1], by[2, 1], by[2, 2] = -1j * one, -2.0 * angle[1], -1j * one
    twice = np.zeros((3, 3, 3, *shape), dtype=complex)
    twice[:, 0] = twice[:, :, 0] = -1j * by
    twice[2, 1, 1] = -2.0
    return tuple(np.stack([(z * each).real, (z * each).imag]) for each in (np.array(c), by, twice))  # type: ignore[return-value]


def _onward(x: FloatArray, x4: FloatArray, coefficients: tuple[Any, ...]) -> FloatArray:
    """n′ across the hole, (2, …), from x and y with three derivatives, (2, 4, …), and the fourth ones, (2, …)."""
    onward = np.concatenate([x[:, 1:], x4[:, None]], axis=1)
    here = x + 1j * STEP * onward
    n, twist, b, rate = coefficients
    found = in_space(here[0], here[1], n, twist, b, rate)
    return np.asarray(found.n[:2].imag / STEP)
