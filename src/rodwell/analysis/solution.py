"""One equilibrium: every field of rod and cylinder, with error estimates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.analysis.measures import Measured, pressure_maxima
from rodwell.numerics.families import Family, State
from rodwell.numerics.ladder import Ladder, Point, estimated_error
from rodwell.numerics.spaces import FloatArray, SplineSpace
from rodwell.physics import braid
from rodwell.physics.parameters import FORCE
from rodwell.physics.strand import contact_pressure
from rodwell.problem import Problem

GRID = 201
"""Places along the rod at which fields are reported by default."""

ZOOMS = 5
"""Times that the search for the largest value of a field looks ten times closer: nine digits of the value."""

_GAUSS = {count: np.polynomial.legendre.leggauss(count) for count in (3, 6)}


@dataclass(frozen=True)
class Solution:
    """An equilibrium of ``problem`` at one end force.

    Created by :func:`rodwell.follow` and :func:`rodwell.equilibrium`; all numbers are in units B = L = 1.
    """

    problem: Problem
    point: Point
    ladder: Ladder

    def __repr__(self) -> str:
        return f"<Solution at F = {self.force:.10g} B/L², stability index {self.stability_index}>"

    @property
    def force(self) -> float:
        """End force F at s = 1 in B/L², tension positive."""
        return float(self.ladder.fine.parameters(self.point.lam)[FORCE])

    @property
    def stability_index(self) -> int:
        """Number of negative eigenvalues of the energy's second variation under dead loads F and T₁."""
        return self.point.fine.index

    @property
    def stable(self) -> bool:
        """Whether the state is a minimum of the energy among states on the wall, under dead loads."""
        return self.stability_index == 0

    @property
    def converged(self) -> bool:
        """Whether every measured number meets the tolerance asked for."""
        return self.point.accurate

    def number(self, which: Measured) -> tuple[float, float]:
        """Return a measured number and its error estimate."""
        return float(self.point.values[which]), float(self.point.error[which])

    @cached_property
    def highest_pressure(self) -> tuple[float, float, tuple[float, ...]]:
        """Largest contact pressure max p (negative: in contact everywhere), its error, and where.

        More than one place if they agree to within the error (or to eight digits).
        """
        places, values, lowest = pressure_maxima(self.ladder.fine, self.point.fine)
        top, error = self.number(Measured.P_MAX)
        within = max(2.0 * error, 1e-8 * max(abs(top), abs(lowest)))
        return top, error, tuple(float(s) for s in places[values >= top - within])

    def fields(self, s: FloatArray | int = GRID) -> dict[str, FloatArray]:
        """Fields along the rod at ``s`` (m,), or at that many evenly spaced places; names as in nomenclature."""
        places = np.linspace(0.0, 1.0, s) if isinstance(s, int) else np.asarray(s, dtype=float)
        return _fields(self.problem, self.ladder.fine, self.point.fine, places)

    def field_errors(self, s: FloatArray | int = GRID) -> dict[str, float]:
        """Error estimate of each field, the largest over ``s``: from the two nested meshes."""
        return self.fields_with_errors(s)[1]

    def fields_with_errors(self, s: FloatArray | int = GRID) -> tuple[dict[str, FloatArray], dict[str, float]]:
        """Return :meth:`fields` and :meth:`field_errors` together."""
        places = np.linspace(0.0, 1.0, s) if isinstance(s, int) else np.asarray(s, dtype=float)
        coarse, fine = (_fields(self.problem, f, state, places) for f, state in _levels(self))
        return fine, {k: float(np.max(estimated_error(fine[k], coarse[k]))) for k in fine}

    def largest(self, name: str) -> tuple[float, float, float]:
        """Largest size of a field over s, its error estimate, and where (the first place, if there are more)."""
        values, places = zip(*(_largest(self.problem, f, state, name) for f, state in _levels(self)), strict=True)
        return values[1], float(estimated_error(values[1], values[0])), places[1]

    @cached_property
    def end_reactions(self) -> dict[str, tuple[float, float]]:
        """What the fitting at s = 1 exerts on the rod across the axis, each with its error estimate.

        ``shear``: circumferential force in B/L², at a clamped end F₃(1) = ω₂′(1) along u₁; ``moment``: bending moment
        M₂(1) = ω₂(1) in B/L, about d₁. What the end does not hold is zero. The axial force there is F, the twisting
        moment −T₁.
        """
        coarse, fine = (_end(f, state) for f, state in _levels(self))
        return {
            "shear": (fine.shear, float(estimated_error(fine.shear, coarse.shear))),
            "moment": (fine.omega2, float(estimated_error(fine.omega2, coarse.omega2))),
        }

    @cached_property
    def total_wall_force(self) -> tuple[float, float]:
        """∫|p| ds, the contact force with all directions added, and its error estimate."""
        totals = [_total(f, state) for f, state in _levels(self)]
        return totals[1], float(estimated_error(totals[1], totals[0]))

    @cached_property
    def certificate(self) -> float:
        """Largest disagreement of independent routes to the same force or moment, scaled by its size.

        Two routes to T₂ (distributed torque, and moment balance of the whole braid), and axial against
        tangential force balance of the rod: near zero for a true solution, whatever the mesh.
        """
        f = self.fields()
        torque = np.max(np.abs(f["T2"] - f["T2_by_moments"]))
        shear = self.problem.clearance * np.max(np.abs(f["braid_F3"] - f["rod_F3"]))
        scale = np.max(np.abs(f["T2"])) + shear + _TINY
        balance = np.max(np.abs(f["tangential_balance"]))
        return float(max(torque / scale, balance / (np.max(np.abs(f["rod_F1"])) + _TINY)))


_TINY = 1e-300


def _levels(solution: Solution) -> tuple[tuple[Family, State], tuple[Family, State]]:
    ladder, point = solution.ladder, solution.point
    return (ladder.coarse, point.coarse), (ladder.fine, point.fine)


def _end(family: Family, state: State) -> braid.EndForce:
    """What acts on the rod at s = 1, and where that is."""
    y, y1 = state.space.evaluate(state.c, np.array([1.0]), 2)[:, 0]
    return braid.end_force(*family.end_reactions(state), float(y), float(y1), family.parameters(state.lam))


def _total(family: Family, state: State) -> float:
    space = state.space
    u = space.evaluate(state.c, space.points, 4)
    pressure = contact_pressure(space.points, u[0], u[1], u[2], u[3], family.parameters(state.lam))
    return float(space.weights @ np.abs(pressure))


def _fields(problem: Problem, family: Family, state: State, s: FloatArray) -> dict[str, FloatArray]:
    p = family.parameters(state.lam)
    space, c = state.space, state.c
    u = space.evaluate(c, s, 4)
    end = _end(family, state)

    def rates(places: FloatArray) -> FloatArray:
        values = space.evaluate(c, places, 4)
        return braid.rates(places, values, p, problem.torsional_stiffness, end)

    from_left, from_right = _running_integrals(rates, s, space)
    out = braid.reconstruct(s, u, from_left, from_right, p, end)
    if problem.on_top:
        out["xi2"] = out["xi2"] + np.pi
    return out


def _largest(problem: Problem, family: Family, state: State, name: str) -> tuple[float, float]:
    """Largest size of a field and its place, by looking ever closer between its neighbours on a grid."""
    s = np.linspace(0.0, 1.0, GRID)
    for _ in range(ZOOMS):
        size = np.abs(_fields(problem, family, state, s)[name])
        i = int(np.argmax(size))
        value, place = float(size[i]), float(s[i])
        s = np.linspace(s[max(i - 1, 0)], s[min(i + 1, s.size - 1)], 21)
    return value, place


def _running_integrals(rates, s: FloatArray, space: SplineSpace) -> tuple[FloatArray, FloatArray]:  # type: ignore[no-untyped-def]
    """Integrals from 0 to ``s`` and from ``s`` to 1: Gauss quadrature between grid points and mesh points."""
    nodes = np.union1d(np.union1d(space.breaks, s), [0.0, 1.0])
    half = 0.5 * np.diff(nodes)
    gauss, weights = _GAUSS[3 if half.max() < 0.2 * np.diff(space.breaks).max() else 6]
    places = (nodes[:-1, None] + half[:, None] * (gauss + 1.0)).ravel()
    values = rates(places).reshape(-1, half.size, gauss.size)
    pieces = np.einsum("kpq,q,p->kp", values, weights, half)
    start = np.zeros((pieces.shape[0], 1))
    left = np.concatenate([start, np.cumsum(pieces, axis=1)], axis=1)
    right = np.concatenate([np.cumsum(pieces[:, ::-1], axis=1)[:, ::-1], start], axis=1)
    where = np.searchsorted(nodes, s)
    return left[:, where], right[:, where]
