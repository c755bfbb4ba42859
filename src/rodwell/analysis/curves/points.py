"""Points of a curve in the plane of a load and another parameter: what defines them, and how one is solved for."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.curves.contact import ContactMaximum
from rodwell.analysis.curves.curve import CurvePoint
from rodwell.analysis.curves.secant import FARTHEST, MOST_SECANTS, PROBE, SETTLED, CurveLostError, zero_at
from rodwell.analysis.straight.scale import EULER
from rodwell.numerics.equilibria.error import CLAIMED_GAIN
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.numerics.splines.spaces import Prolongation
from rodwell.problem.varying import Parameter
from rodwell.quantities.arrays import FloatArray

MOST_REFINEMENTS = 3


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


STALLED = 0.7
"""Finer meshes that reduce the gap between the places on both by less do not help any more: round-off is left."""

NO_GAIN = 2.0
"""Error over the gap between two meshes where no gain is seen: round-off grows with the mesh, and the finer one may be
off by all of the gap, and by what the coarser one is off."""


@dataclass(frozen=True)
class _Resolved:
    """A point solved for on two meshes, at the values ``places`` of the parameter.

    ``without`` is how far, in load and parameter, finer meshes put it that brought it no nearer: no gain is claimed.
    """

    meshes: TwoMeshes
    point: MeshedState
    places: tuple[float, float]
    without: tuple[float, float] | None = None

    @property
    def spot(self) -> PlanePoint:
        """Where it lies, by the finer of its meshes."""
        return PlanePoint(self.places[1], float(self.point.fine.lam))

    @property
    def error(self) -> float:
        """How far the curve may pass from it in the load."""
        gap = float(self.point.lam_gap)
        known = gap if self.without is None else NO_GAIN * max(CLAIMED_GAIN * gap, self.without[0])
        return known + 2e-13 * abs(self.spot.value)

    @property
    def x_error(self) -> float:
        """The same in the parameter."""
        apart = abs(self.places[1] - self.places[0])
        return apart / CLAIMED_GAIN if self.without is None else NO_GAIN * max(apart, self.without[1])

    @property
    def gap(self) -> float:
        """The larger of both as parts of load and parameter."""
        return max(self.error / (abs(self.spot.value) + EULER), self.x_error / (abs(self.spot.x) or 1.0))

    def without_gain(self, finer: _Resolved) -> _Resolved:
        """The same point, known to be no nearer to the curve than to where finer meshes put it."""
        apart = abs(finer.spot.value - self.spot.value), abs(finer.spot.x - self.spot.x)
        return replace(self, without=apart)


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
        found: _Resolved | None = None
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
            before, found = found, _Resolved(line, point, places)
            if before is not None and found.gap >= STALLED * before.gap:
                found = before.without_gain(found)  # round-off: finer meshes bring the place no nearer
                break
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
        assert found is not None
        if not found.point.accurate and found.without is None:
            found = found.without_gain(found)  # finer meshes there are none, or they help no more
        solution = self.solution(found.meshes, found.point, found.spot)
        touching = solution.highest_pressure[2] if self.touch else ()
        return SolvedPoint(found.spot, found.error, found.x_error, solution, touching)

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
