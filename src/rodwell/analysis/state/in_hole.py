"""A state of a rod in a curved hole: where it is in space, and every field along it."""

from __future__ import annotations

from collections import OrderedDict
from functools import cached_property

import numpy as np

from rodwell.analysis.discrete.curved import (
    ends_of_lying_rod,
    height_of_rod,
    hole_at,
    lifted,
    wall_side,
)
from rodwell.analysis.discrete.pieces import PiecewisePolynomial
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.curved import bends_at, step_loads, strand
from rodwell.physics.on_wall.curved import hole_at as tabulated
from rodwell.physics.on_wall.frames import material_curvatures
from rodwell.physics.on_wall.parameters import AXIAL_WEIGHT, CLEARANCE, FORCE, TWIST
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray


class InHole:
    """A state in its hole, with the tables (``family.given``) that it was solved with.

    Attributes
    ----------
    problem, family, state
        The problem, its equations on a mesh, and the state.
    parameters
        As kernels take them.
    """

    def __init__(self, problem: Problem, family: Family, state: State) -> None:
        self.problem, self.family, self.state = problem, family, state
        self.parameters = family.parameters(state.lam)
        self.clearance = float(self.parameters[CLEARANCE])

    def shape(self, s: FloatArray, orders: int) -> FloatArray:
        """Y and its derivatives (orders, m) at places (m,)."""
        return self.state.space.evaluate(self.state.c, s, orders)

    def given(self, s: FloatArray) -> FloatArray:
        """What kernels are given at places (m,), one column each."""
        assert self.family.given is not None
        return self.family.given(s).T

    def step(self, s: FloatArray) -> FloatArray:
        """S′ = cos η/h (m,): arclength of the hole's axis per arclength of the rod."""
        k1, k2 = bends_at(s, self.given(s))
        y, y1 = self.shape(s, 2)
        angle = y / self.clearance
        return np.asarray(np.sqrt(1.0 - y1**2) / (1.0 + self.clearance * (k1 * np.cos(angle) - k2 * np.sin(angle))))

    @cached_property
    def place(self) -> PiecewisePolynomial:
        """S(s): the place of each cross-section on the hole's axis; the end s = 0 stays where it is undeformed."""
        ahead = lifted(self.state.space.breaks, self.step)
        place = -ahead.coefficients
        place[0] += ends_of_lying_rod(self.problem)[0] + float(ahead(np.array([0.0]))[0])
        return PiecewisePolynomial(ahead.breaks, place)

    @cached_property
    def turned(self) -> PiecewisePolynomial:
        """∫ₛ¹ ω₁: by how much the rod's frame turns about its tangent."""
        p, breaks = self.parameters, self.state.space.breaks
        return lifted(breaks, lambda s: strand(s, self.shape(s, 4), self.given(s), p)[0])

    def drive(self, s: FloatArray) -> FloatArray:
        """N (m,): the force that drives the rod along the hole, reduced to its axis, as the tables have it."""
        k1, _, _, _, lift, offset = tabulated(s, self.given(s))
        p = self.parameters
        return np.asarray((1.0 + self.clearance * k1) * (p[FORCE] - p[AXIAL_WEIGHT] * lift + offset))

    def frames(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Centre of the rod (m, 3) and its frame t₁, d₁, u₁ (m, 3, 3) in space, z vertically up."""
        hole, side = self.problem.hole, wall_side(self.problem)
        assert hole is not None
        y, y1 = self.shape(s, 2)
        places, angle = self.place(s), y / self.clearance
        _, frames, points = hole.at(places)
        n1, n2, tangent = frames.transpose(1, 0, 2)
        cos_a, sin_a = side * np.cos(angle)[:, None], side * np.sin(angle)[:, None]
        sin, cos = y1[:, None], np.sqrt(1.0 - y1**2)[:, None]
        d1, u2 = cos_a * n1 - sin_a * n2, sin_a * n1 + cos_a * n2
        along, around = sin * u2 + cos * tangent, cos * u2 - sin * tangent
        return points - self.clearance * d1, np.stack([along, d1, around], axis=1)

    def fields(self, s: FloatArray, balance: bool = True) -> dict[str, FloatArray]:
        """Fields at places (m,) in units B = L = 1: those of the rod, by their names in the nomenclature.

        ``z`` is the way along the hole's axis from s = 0; components refer to t₁, d₁, u₁. ``balance``: with
        "tangential_balance", which needs the height of the rod and takes as long as all the others.
        """
        out, p, rod = self.strand(s), self.parameters, self.problem.rod
        bent, torsion = (out["omega2"], out["omega3"]), self.problem.torsional_stiffness
        xi1 = p[TWIST] / torsion * rod.turned(s) + self._turned_in_all - self.turned(s)
        material = material_curvatures(xi1, *bent, p[TWIST], torsion * rod.torsion(s))
        out |= {
            "xi2": self._angle(out["y"]),
            "material_omega1": material[0],
            "material_omega2": material[1],
            "material_omega3": material[2],
            "z": self.place(s) - self._first_place,
            "xi1": xi1,
        }
        if balance:
            known = self._energy_along(s, *bent, out["rod_F1"])
            out["tangential_balance"] = known - self._energy_at_ends[rod.stiffness.piece_of(s)]
        return out

    def strand(self, s: FloatArray) -> dict[str, FloatArray]:
        """Those of the fields that take no integral along the rod: shape, curvatures, forces, moments, contact."""
        u, p = self.shape(s, 4), self.parameters
        omega1, omega2, omega3, f1, f2, f3, pressure = map(np.asarray, strand(s, u, self.given(s), p))
        stiffness = self.problem.rod.stiffness(s)
        return {
            "y": u[0],
            "eta": np.arcsin(u[1]),
            "omega1": omega1,
            "omega2": omega2,
            "omega3": omega3,
            "contact_pressure": pressure,
            "rod_F1": f1,
            "rod_F2": f2,
            "rod_F3": f3,
            "rod_M1": np.full_like(s, -p[TWIST]),
            "rod_M2": stiffness * omega2,
            "rod_M3": stiffness * omega3,
        }

    def steps(self) -> tuple[FloatArray, FloatArray]:
        """Couple about u₁ and force along d₁, (k,) each, of the wall on the rod at the k steps of a string."""
        steps = self.problem.rod.breaks[1:-1]
        sides = np.nextafter(steps, 0.0), steps
        shapes, given = ([take(s) for s in sides] for take in (lambda s: self.shape(s, 4), self.given))
        return step_loads(steps, shapes, given, self.problem.rod.stiffness_sides, self.parameters)

    def _angle(self, y: FloatArray) -> FloatArray:
        """ξ₂ (m,) from the low side."""
        return y / self.clearance + (np.pi if self.problem.on_top else 0.0)

    def _energy_along(self, s: FloatArray, omega2: FloatArray, omega3: FloatArray, f1: FloatArray) -> FloatArray:
        """F₁ + ½b(ω₂² + ω₃²) − w × height, constant in a section: F₁ comes from what drives the rod along the hole.

        Where sections taper, more by ∫ ½b′(ω₂² + ω₃²) + w′ × height.
        """
        height = height_of_rod(self.problem, self.place(s), self._angle(self.shape(s, 1)[0]))
        rod, weight = self.problem.rod, self.parameters[AXIAL_WEIGHT]
        bent = 0.5 * rod.stiffness(s) * (omega2**2 + omega3**2)
        tapered = self._by_tapers(s) if rod.tapered else 0.0
        return np.asarray(f1 + bent - weight * rod.weight(s) * height + tapered)

    @cached_property
    def _by_tapers(self) -> PiecewisePolynomial:
        """What tapers add to that, on the mesh."""
        rod, weight = self.problem.rod, self.parameters[AXIAL_WEIGHT]

        def rate(s: FloatArray) -> FloatArray:
            height = height_of_rod(self.problem, self.place(s), self._angle(self.shape(s, 1)[0]))
            _, omega2, omega3, *_ = strand(s, self.shape(s, 4), self.given(s), self.parameters)
            bent = 0.5 * rod.stiffness.derivative(s) * (omega2**2 + omega3**2)
            return np.asarray(-(bent + weight * rod.weight.derivative(s) * height))

        return lifted(self.state.space.breaks, rate)

    @cached_property
    def _energy_at_ends(self) -> FloatArray:
        """The same at the upper end of each section."""
        ends = self.problem.rod.breaks[1:]
        ends = np.append(np.nextafter(ends[:-1], 0.0), 1.0)
        _, omega2, omega3, f1, *_ = strand(ends, self.shape(ends, 4), self.given(ends), self.parameters)
        return self._energy_along(ends, omega2, omega3, f1)

    @cached_property
    def _first_place(self) -> float:
        return float(self.place(np.array([0.0]))[0])

    @cached_property
    def _turned_in_all(self) -> float:
        return float(self.turned(np.array([0.0]))[0])

    def energies(self) -> dict[str, float]:
        """Parts of the energy relative to θ = 0, by name, with the hole as it was tabulated."""
        space, p, d = self.state.space, self.parameters, self.clearance
        s, w = space.points, space.weights
        y, y1, y2 = space.at_points(self.state.c)
        k1, k2, g1, g2, lift, offset = tabulated(s, self.given(s))
        angle = y / d
        normal, geodesic, cos, inwards, h = curvature(angle, y1, y2, k1, k2, d)
        lying = 1.0 + d * k1
        versine, sine = 2.0 * np.sin(0.5 * angle) ** 2, np.sin(angle)
        lagging = (lying * y1**2 / (1.0 + cos) - d * (k1 * versine + k2 * sine)) / h  # (1 + Δk₁) (S₀′ − S′)
        bending = 0.5 * (normal**2 - (k1 / lying) ** 2 + geodesic**2 - (k2 / lying) ** 2)
        bending *= self.problem.rod.stiffness(s)
        twisted = y1 * (y1**2 / (1.0 + cos) / d + cos * inwards / h)
        return {
            "bending_energy": float(w @ (bending + offset * lagging)),
            "twist_energy": float(0.5 * p[TWIST] ** 2 / self.problem.whole_torsion),
            "lateral_energy": float(p[AXIAL_WEIGHT] * d * (w @ (g1 * versine + g2 * sine))),
            "axial_energy": float(-p[AXIAL_WEIGHT] * (w @ (lift * lagging))),
            "end_work": float(-p[FORCE] * (w @ lagging) + p[TWIST] * (w @ twisted)),
        }

    def energy(self) -> float:
        """Bending, height and torque less the work of the end force from S₀(1) on, at the rod's own places, in B/L."""
        space, p = self.state.space, self.parameters
        s = space.points
        y, y1, y2 = space.at_points(self.state.c)
        k1, k2, *_ = hole_at(self.problem, self.place(s))[0]
        normal, geodesic, cos, inwards, h = curvature(y / self.clearance, y1, y2, k1, k2, self.clearance)
        torque = p[TWIST] * y1 * ((1.0 - cos) / self.clearance + cos * inwards / h)
        height, rod = self.frames(s)[0][:, 2], self.problem.rod
        bent = 0.5 * rod.stiffness(s) * (normal**2 + geodesic**2)
        stored = bent + p[AXIAL_WEIGHT] * rod.weight(s) * height - torque
        return float(space.weights @ stored - p[FORCE] * self.travel())

    def travel(self) -> float:
        """∫ (1 + Δk₁) dS from S₀(1), where the undeformed rod ends, to where this one does."""
        nodes, weights = np.polynomial.legendre.leggauss(10)
        low, high = ends_of_lying_rod(self.problem)[1], float(self.place(np.array([1.0]))[0])
        half = 0.5 * (high - low)
        k1 = hole_at(self.problem, low + half * (nodes + 1.0))[0][0]
        return float(half * weights @ (1.0 + self.clearance * k1))


_KEPT: OrderedDict[tuple[int, int], InHole] = OrderedDict()
"""The states asked last, by the identity of family and state, which they hold: places and turns are integrals."""

MOST_KEPT = 8


def in_hole(problem: Problem, family: Family, state: State) -> InHole:
    """A state in its hole; of the few asked last the same record again, with what it has worked out."""
    key = (id(family), id(state))
    found = _KEPT.get(key)
    if found is None or found.problem != problem:
        found = _KEPT[key] = InHole(problem, family, state)
        while len(_KEPT) > MOST_KEPT:
            _KEPT.popitem(last=False)
    return found


def end_loads_in_hole(f: dict[str, FloatArray]) -> dict[tuple[str, float], tuple[FloatArray, FloatArray]]:
    """Force and moment of the supports on the rod along N₁, N₂, T of the hole at that end, by ("rod", s).

    From the fields at s = 0 and s = 1: t₁ = sin η u₂ + cos η T, u₁ = cos η u₂ − sin η T, and d₁, u₂ are N₁, N₂ turned
    by ξ₂.
    """
    sin, cos, sin_x, cos_x = np.sin(f["eta"]), np.cos(f["eta"]), np.sin(f["xi2"]), np.cos(f["xi2"])

    def in_hole(kind: str) -> FloatArray:
        along, inwards, around = (f[f"rod_{kind}{i}"] for i in (1, 2, 3))
        u2, axial = sin * along + cos * around, cos * along - sin * around
        return np.array([cos_x * inwards + sin_x * u2, cos_x * u2 - sin_x * inwards, axial])

    force, moment = in_hole("F"), in_hole("M")
    return {("rod", float(end)): (sign * force[:, end], sign * moment[:, end]) for end, sign in ((0, -1.0), (1, 1.0))}


def curvature(
    angle: FloatArray, y1: FloatArray, y2: FloatArray, k1: FloatArray, k2: FloatArray, clearance: float
) -> tuple[FloatArray, ...]:
    """Kₙ, K_g, cos η, κₙ and h of :mod:`rodwell.physics.on_wall.curved_energy`, (m,) each."""
    cos = np.sqrt(1.0 - y1**2)
    inwards, around = k1 * np.cos(angle) - k2 * np.sin(angle), k1 * np.sin(angle) + k2 * np.cos(angle)
    h = 1.0 + clearance * inwards
    return y1**2 / clearance + cos**2 * inwards / h, y2 / cos + cos * around / h, cos, inwards, h
