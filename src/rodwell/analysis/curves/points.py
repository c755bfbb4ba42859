"""Points of a curve in the plane of a load and another parameter: what defines them, and how one is solved for."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.curves.curve import CurvePoint
from rodwell.analysis.curves.secant import FARTHEST, MOST_SECANTS, PROBE, SETTLED, CurveLostError, zero_at
from rodwell.analysis.discrete.measures import pressure_maxima
from rodwell.analysis.straight.scale import EULER
from rodwell.numerics.equilibria.error import CLAIMED_GAIN
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.numerics.splines.spaces import Prolongation
from rodwell.problem.varying import Parameter
from rodwell.quantities.arrays import FloatArray

MOST_REFINEMENTS = 3

NEAR = 0.03
"""Maxima of the contact pressure closer than this, or than this part of a half wave if they are short, are one."""


class NearbyStates(NamedTuple):
    """Coefficients close to a point of the curve on both meshes, and states near it along the load."""

    coarse: FloatArray
    fine: FloatArray
    near: tuple[State | None, State | None] = (None, None)


@dataclass(frozen=True)
class PlanePoint:
    """A place in the plane: parameter and load."""

    x: float
    value: float


@dataclass(frozen=True)
class CurveTangent:
    """Direction in which the curve is travelled: coefficients on both meshes, load and parameter x, and unit of x."""

    coarse: FloatArray
    fine: FloatArray
    value: float
    x: float
    unit: float


@dataclass(frozen=True)
class CurveStart:
    """A known state on the curve; ``along`` if its tangents are those along the load, which may turn back there."""

    x: float
    solution: Solution
    along: bool = False

    @property
    def meshes(self) -> TwoMeshes:
        """The meshes it stands on."""
        return self.solution.meshes

    @property
    def guess(self) -> NearbyStates:
        """Coefficients on both meshes, and the states."""
        states = (self.solution.point.coarse, self.solution.point.fine) if self.along else (None, None)
        return NearbyStates(self.solution.point.coarse.c, self.solution.point.fine.c, states)


@dataclass(frozen=True)
class SolvedPoint:
    """A point of the curve: the curve passes within ``error`` in load and ``x_error`` in x of it.

    ``places`` are those that lift off, of curves of touching states.
    """

    spot: PlanePoint
    error: float
    x_error: float
    solution: Solution
    places: tuple[float, ...]

    @property
    def guess(self) -> NearbyStates:
        """Coefficients on both meshes, and the states."""
        point = self.solution.point
        return NearbyStates(point.coarse.c, point.fine.c, (point.coarse, point.fine))

    def as_point(self) -> CurvePoint:
        """The point as users see it."""
        allowed = self.solution.meshes.rtol * (abs(self.spot.value) + EULER)
        known = self.error <= allowed and self.x_error <= self.solution.meshes.rtol * abs(self.spot.x)
        return CurvePoint(
            self.spot.x,
            self.spot.value,
            self.error,
            self.places,
            self.solution.accurate and known,
            self.solution,
            self.x_error,
        )


class ContactMaximum:
    """The place that lifts off, followed along a curve: each maximum of the contact pressure is a function of its own.

    ``place`` is None as long as the highest one is meant. Of a symmetric state it lies in the first half.
    """

    def __init__(self) -> None:
        self.place: float | None = None
        self.near = NEAR

    def at(self, family: Family, state: State) -> float:
        """Contact pressure at the maximum that is followed, with the sign that makes contact negative."""
        places, values, _ = _maxima(family, state)
        if self.place is None:
            return float(values.max())
        here = np.abs(places - self.place) < self.near
        if not here.any():
            raise CurveLostError("the place that lifts off is lost")
        return float(values[here].max())

    def moved(self, solution: Solution) -> float:
        """Where the maximum that is followed lies at a state."""
        places, values, _ = _maxima(*solution.levels[1])
        if self.place is None:
            return float(places[np.argmax(values)])
        here = np.abs(places - self.place) < self.near
        return float(places[here][np.argmax(values[here])])

    def rival(self, solution: Solution, mesh: int = 1) -> tuple[float, float | None]:
        """Highest contact pressure at any other maximum, and where; the lowest pressure where there is none."""
        places, values, lowest = _maxima(*solution.levels[mesh])
        other = np.abs(places - self.moved(solution)) >= self.near
        if not other.any():
            return lowest, None
        best = int(np.argmax(np.where(other, values, -np.inf)))
        return float(values[best]), float(places[best])


def _maxima(family: Family, state: State) -> tuple[FloatArray, FloatArray, float]:
    """Maxima of the contact pressure: places, of a symmetric state folded onto the first half, values, lowest value."""
    places, values, lowest = pressure_maxima(family, state)
    symmetric = family.parity != 0 or state.symmetry != 0
    return (np.minimum(places, 1.0 - places) if symmetric else places), values, lowest


class Zero(ABC):
    """What defines a curve: the zero of a function of equilibria, and how to reach equilibria in the plane.

    Parameters
    ----------
    over, load
        The two parameters of the plane: x, and the load ("force" or "twist").
    """

    touch: bool
    noise = 0.0  # step of the secant method in x, as a part of its unit, below which it may grow again: round-off

    def __init__(self, over: Parameter, load: str) -> None:
        self.over, self.load, self.touching = over, load, ContactMaximum()

    @abstractmethod
    def function(self, family: Family, state: State) -> float:
        """What vanishes on the curve."""

    @abstractmethod
    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        """Return ``meshes`` with the equilibria along the load at the parameter of ``spot``."""

    @abstractmethod
    def solution(self, meshes: TwoMeshes, point: MeshedState, spot: PlanePoint) -> Solution:
        """Return a point as a solution of the problem at ``spot``."""

    def value(self, solution: Solution) -> float:
        """Load of a solution."""
        return solution.force if self.load == "force" else solution.problem.twist

    def solve(
        self, meshes: TwoMeshes, guess: NearbyStates, spot: PlanePoint, travel: CurveTangent | None = None
    ) -> SolvedPoint:
        """Return the zero at the parameter of ``spot``, from coefficients close to it.

        With ``travel``: the zero on the hyperplane through the guess normal to that direction, in the space of states
        and load. The parameter is then found too. So the curve can be followed where it turns back in the parameter.
        """
        for refinement in range(MOST_REFINEMENTS + 1):
            line = self.meshes(meshes, spot)
            if travel is None:
                coarse = zero_at(line.coarse, guess.coarse, spot.value, guess.near[0], self.function)
                fine = zero_at(line.fine, guess.fine, coarse.lam, guess.near[1], self.function)
                places = spot.x, spot.x
            else:
                first, coarse, slope = self.zero_across(meshes, guess, spot, travel, 0)
                # the same hyperplane, not another place along the curve
                same = NearbyStates(coarse.c, meshes.up(coarse.c))
                second, fine, _ = self.zero_across(meshes, same, PlanePoint(first, coarse.lam), travel, 1, slope)
                places, line = (first, second), self.meshes(meshes, PlanePoint(second, fine.lam))
            point = line.point(coarse, fine)
            finer = None if point.accurate or refinement == MOST_REFINEMENTS else line.refined(point)
            if finer is None:
                break
            meshes = finer
            up, up_fine = (Prolongation(a.space, b.space) for a, b in zip(_meshes(line), _meshes(finer), strict=True))
            near = _carried(finer.coarse, coarse, up), _carried(finer.fine, fine, up_fine)
            guess = NearbyStates(near[0].c, near[1].c, near)
            spot = PlanePoint(places[1], float(fine.lam))
            if travel is not None:
                travel = replace(travel, coarse=up(travel.coarse), fine=up_fine(travel.fine))
        there, error = PlanePoint(places[1], float(fine.lam)), float(point.lam_gap + 2e-13 * abs(fine.lam))
        solution = self.solution(line, point, there)
        touching = solution.highest_pressure[2] if self.touch else ()
        return SolvedPoint(there, error, abs(places[1] - places[0]) / CLAIMED_GAIN, solution, touching)

    def zero_across(
        self,
        meshes: TwoMeshes,
        guess: NearbyStates,
        spot: PlanePoint,
        travel: CurveTangent,
        mesh: int,
        slope: float = math.inf,
    ) -> tuple[float, State, float]:
        """Zero on the hyperplane normal to ``travel``, by the secant method in the parameter, on one of both meshes.

        Returns the parameter, the state and the slope of the function; ``slope`` is that on the other mesh, if known.
        """
        c, family = (guess.coarse, guess.fine)[mesh], _meshes(meshes)[mesh]
        row, row_lam, _, _ = family.covector((travel.coarse, travel.fine)[mesh], travel.value)
        target = float(row @ c) + row_lam * spot.value

        def at(x: float, c: FloatArray, lam: float) -> tuple[State, float]:
            family = _meshes(self.meshes(meshes, PlanePoint(x, lam)))[mesh]
            outcome, state, _ = family.correct(c, lam, row, row_lam, target)
            if state is None:
                raise CurveLostError(family.advice(outcome))
            return state, self.function(family, state)

        x, farthest = spot.x, FARTHEST * travel.unit
        state, value = at(x, c, spot.value)
        step = PROBE * travel.unit if math.isinf(slope) else float(np.clip(-value / slope, -farthest, farthest))
        for _ in range(MOST_SECANTS):
            x += step
            state, new = at(x, state.c, state.lam)
            if abs(step) <= SETTLED * travel.unit:
                return float(x), state, slope
            if new == value:
                raise CurveLostError("the function does not change along the line")
            slope = (new - value) / step
            before, value, step = step, new, float(np.clip(-new / slope, -farthest, farthest))
            if 2.0 * abs(step) >= abs(before) and abs(before) <= self.noise * travel.unit:
                return float(x), state, slope  # round-off: no nearer than that
        raise CurveLostError("the secant method did not settle")


def _meshes(meshes: TwoMeshes) -> tuple[Family, Family]:
    return meshes.coarse, meshes.fine


def _carried(family: Family, state: State, up: Prolongation) -> State:
    """A state as one of a finer mesh, with its tangent: close to an equilibrium there."""
    return family.state(up(state.c), state.lam, up(state.tangent), state.tangent_lam, state.index)
