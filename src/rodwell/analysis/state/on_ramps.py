"""A state on a wall whose clearance varies: where it is in space, and every field along it."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from rodwell.analysis.discrete.curved import lifted
from rodwell.analysis.discrete.pieces import PiecewisePolynomial
from rodwell.analysis.state.in_hole import InHole, in_hole
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.frames import material_curvatures
from rodwell.physics.on_wall.parameters import CLEARANCE, FORCE, LATERAL_WEIGHT, TWIST
from rodwell.physics.on_wall.ramps import BY_FORCE, Strand, Wall, axial_resultant, lying_push, slack_of, strand, wall_at
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray


class OnRamps:
    """A state on its wall, with the tables (``family.given``) that it was solved with; axes i, j, k as in a cylinder.

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

    def wall(self, s: FloatArray) -> Wall:
        """Rod and wall at places (m,)."""
        return wall_at(s, self.given(s))

    def rod(self, s: FloatArray) -> Strand:
        """Curvatures, forces, contact at places (m,)."""
        return strand(s, self.shape(s, 4), self.given(s), self.parameters)

    def pushed_along(self, s: FloatArray) -> FloatArray:
        """What the wall pushes the rod that lies along k, per length, (m,)."""
        given = self.given(s)
        wall = wall_at(s, given)
        return np.asarray(lying_push(s, given, wall, self.parameters) * wall.clearance[1] / wall.lying[0])

    def push(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """What the wall pushes this rod with across the hole, towards its axis, per length, (m,); and Δ′/z₀′ (m,)."""
        wall, rod = self.wall(s), self.rod(s)
        cos = np.sqrt(1.0 - rod.sin_eta**2)
        rise = wall.clearance[1]
        return np.asarray(-(rod.pressure * cos + self.pushed_along(s) * rise) / rod.ahead), rise / wall.lying[0]

    @cached_property
    def _ahead(self) -> PiecewisePolynomial:
        return lifted(self.state.space.breaks, lambda s: np.asarray(self.rod(s).ahead))

    @cached_property
    def _turning(self) -> PiecewisePolynomial:
        return lifted(self.state.space.breaks, lambda s: np.asarray(self.rod(s).omega[0]))

    def frames(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Centre of the rod (m, 3) and its frame t₁, d₁, u₁ (m, 3, 3) along i, j, k."""
        wall, rod = self.wall(s), self.rod(s)
        angle = self.angle(self.shape(s, 1)[0])
        (d, rise, *_), sin, none = wall.clearance, rod.sin_eta, np.zeros_like(s)
        cos = np.sqrt(1.0 - sin**2)
        outwards = np.stack([-np.cos(angle), np.sin(angle), none], axis=1)
        around = np.stack([np.sin(angle), np.cos(angle), none], axis=1)
        axis = np.array([0.0, 0.0, 1.0])
        up, ahead = (rise / cos)[:, None], (rod.ahead / cos)[:, None]
        along, d1 = up * outwards + ahead * axis, up * axis - ahead * outwards
        tangent = cos[:, None] * along + sin[:, None] * around
        u1 = cos[:, None] * around - sin[:, None] * along
        centre = d[:, None] * outwards + self._z(s)[:, None] * axis
        return centre, np.stack([tangent, d1, u1], axis=1)

    def _z(self, s: FloatArray) -> FloatArray:
        return np.asarray(self._ahead(np.zeros(1)) - self._ahead(s))

    def angle(self, y: FloatArray) -> FloatArray:
        """ξ₂ (m,) from the low side."""
        return y / self.clearance + (np.pi if self.problem.on_top else 0.0)

    def fields(self, s: FloatArray, balance: bool = True) -> dict[str, FloatArray]:
        """Fields at places (m,) in units B = L = 1: those of the rod, by their names in the nomenclature.

        ``y`` is Δξ₂ with the clearance of the problem; components refer to t₁, d₁, u₁, of which d₁ is normal to the rod
        and to the direction around the hole. ``z`` is that of each cross-section at the clearance that it has lying.
        """
        out, p, torsion = self.strand(s), self.parameters, self.problem.torsional_stiffness
        xi1 = self._turning(np.zeros(1)) - self._turning(s)
        material = material_curvatures(xi1, out["omega2"], out["omega3"], p[TWIST],
                                       torsion * self.problem.rod.torsion(s))  # fmt: skip
        return out | {
            "xi2": self.angle(out["y"]),
            "material_omega1": material[0],
            "material_omega2": material[1],
            "material_omega3": material[2],
            "z": self._z(s),
            "xi1": xi1,
        }

    def strand(self, s: FloatArray) -> dict[str, FloatArray]:
        """Those of the fields that take no integral along the rod: shape, curvatures, forces, moments, contact."""
        rod, stiffness = self.rod(s), self.wall(s).stiffness[0]
        names = [f"{kind}{i}" for kind in ("omega", "rod_F") for i in (1, 2, 3)]
        return {
            "y": self.shape(s, 1)[0],
            "eta": np.arcsin(rod.sin_eta),
            **{name: np.asarray(one) for name, one in zip(names, (*rod.omega, *rod.force), strict=True)},
            "contact_pressure": np.asarray(rod.pressure),
            "rod_M1": np.full_like(s, -self.parameters[TWIST]),
            "rod_M2": np.asarray(stiffness * rod.omega[1]),
            "rod_M3": np.asarray(stiffness * rod.omega[2]),
        }

    def steps(self) -> tuple[FloatArray, FloatArray]:
        """Couple about u₁ and force along d₁, (k,) each, of the wall on the rod at the k ends of sections.

        From the balance of moments and of forces: −[b ω₃] and −[F₂], as in curved holes.
        """
        steps = self.problem.rod.breaks[1:-1]
        below, above = (self.strand(s) for s in (np.nextafter(steps, 0.0), steps))
        return below["rod_M3"] - above["rod_M3"], below["rod_F2"] - above["rod_F2"]

    def end_loads(self) -> dict[tuple[str, float], tuple[FloatArray, FloatArray]]:
        """Force and moment of the supports on the rod along i, j, k, by ("rod", s)."""
        ends = np.array([0.0, 1.0])
        fields, frame = self.strand(ends), self.frames(ends)[1]
        out: dict[tuple[str, float], tuple[FloatArray, FloatArray]] = {}
        for end, sign in ((0, -1.0), (1, 1.0)):
            force, moment = (np.array([fields[f"rod_{kind}{i}"][end] for i in (1, 2, 3)]) for kind in ("F", "M"))
            out["rod", float(end)] = sign * force @ frame[end], sign * moment @ frame[end]
        return out

    def energies(self) -> dict[str, float]:
        """Parts of the energy relative to the rod that lies, by name.

        ``axial_energy`` holds what weight and the wall's push on the rod that lies do along the hole.
        """
        space, p = self.state.space, self.parameters
        s, w = space.points, space.weights
        u, given = space.at_points(self.state.c), self.family.mesh.given.T
        wall, ahead = wall_at(s, given), slack_of(s, u, given, p)
        height = 2.0 * wall.weight * wall.clearance[0] * np.sin(0.5 * u[0] / self.clearance) ** 2
        lateral, end = float(p[LATERAL_WEIGHT] * (w @ height)), float(p[FORCE] * (w @ (ahead * given[BY_FORCE])))
        along = float(w @ (axial_resultant(s, given, wall, p) / wall.lying[0] * ahead))
        return {
            "bending_energy": self.state.energy - lateral - along,
            "twist_energy": 0.0,
            "lateral_energy": lateral,
            "axial_energy": along - end,
            "end_work": -end,
        }

    def axial_contact_error(self) -> float:
        """By how much the axial force is off somewhere at most, in B/L²: this rod is pushed along by other contact.

        It is the largest of ∫ₛ¹ (R − R of the rod that lies) Δ′/z₀′ ds.
        """
        off = lifted(self.state.space.breaks, self._other_push)
        places = np.unique(np.concatenate([self.state.space.breaks, np.linspace(0.0, 1.0, 201)]))
        return float(np.max(np.abs(off(places))))

    def _other_push(self, s: FloatArray) -> FloatArray:
        push, slope = self.push(s)
        return np.asarray(push * slope - self.pushed_along(s))


def on_even_wall(problem: Problem) -> bool:
    """Whether the hole is straight and of one clearance, so that the paper's own equations hold."""
    return problem.hole is None and not problem.ramps


def beside_wall(problem: Problem, family: Family, state: State) -> InHole | OnRamps:
    """A state on a wall that is curved or whose clearance varies, with its fields."""
    return OnRamps(problem, family, state) if problem.ramps else in_hole(problem, family, state)
