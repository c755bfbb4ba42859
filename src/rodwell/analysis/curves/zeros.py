"""What defines curves of states: functions of equilibria that vanish on them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rodwell.analysis.branch.functionals import Number, value_on
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.symmetry import kept_parity
from rodwell.analysis.curves.points import CurveStart, CurveTangent, NearbyStates, PlanePoint, Zero
from rodwell.analysis.curves.secant import CurveLostError, zero_from
from rodwell.analysis.discrete.family import IN_CURVED_HOLE, WHERE_CLEARANCE_VARIES, in_other_hole, path, spline_ends
from rodwell.errors import InputError
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter, ParameterPath, varied
from rodwell.quantities.arrays import FloatArray


class AlongForce(Zero):
    """Zeros among the equilibria of a problem along the end force, at each value of another parameter."""

    touch = False

    def __init__(self, problem: Problem, over: Parameter, load: str = "force") -> None:
        super().__init__(over, load)
        if problem.ramps and "twist" in (over.names if isinstance(over, ParameterPath) else (over,)):
            raise InputError("over", over, "must leave the twist at 0 where the clearance varies along the rod")
        self.problem = problem
        self.kept = {parity: kept_parity(problem, parity, over, load) for parity in (-1, 0, 1)}

    def at(self, x: float) -> Problem:
        """The problem at a value of the parameter."""
        return varied(self.problem, self.over, x)

    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        """The same meshes with the equilibria along the end force at ``spot``."""
        problem, parity = self.at(spot.x), self.kept[meshes.coarse.parity]
        if self.problem.hole is None and problem.hole is None and not problem.ramps:
            return meshes.on_path(path(problem, "force", spot.value), spline_ends(problem), parity)
        return meshes.changed(lambda family: replace(in_other_hole(family, problem, spot.value), parity=parity))

    def solution(self, meshes: TwoMeshes, point: MeshedState, spot: PlanePoint) -> Solution:
        """A point as a solution."""
        return Solution(self.at(spot.x), point, meshes)


class Touching(AlongForce):
    """Lift-off: the contact pressure at its maximum vanishes."""

    touch = True

    def function(self, family: Family, state: State) -> float:
        """The contact pressure there."""
        return self.touching.at(family, state)


class TwistAtLiftOff(Touching):
    """Second lift-off in twist, at the end force of the first, which is solved for at each value of the parameter."""

    def __init__(self, problem: Problem, over: Parameter, start: float, lifting: Solution) -> None:
        super().__init__(problem, over, load="twist")
        self.first, self.lifting, self.lifting_at = Touching(problem, over), lifting, start

    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        """The same meshes with the equilibria along the twist, at the end force of the first lift-off."""
        if spot.x != self.lifting_at:
            near = CurveStart(spot.x, self.lifting)
            self.lifting = self.first.solve(near.meshes, near.guess, PlanePoint(spot.x, self.lifting.force)).solution
            self.lifting_at = spot.x
        problem, parity = self.at(spot.x), self.kept[meshes.coarse.parity]
        return meshes.on_path(path(problem, "twist", self.lifting.force), spline_ends(problem), parity)

    def solution(self, meshes: TwoMeshes, point: MeshedState, spot: PlanePoint) -> Solution:
        """A point as a solution."""
        return Solution(self.at(spot.x).but(twist=spot.value), point, meshes)


class Branching(AlongForce):
    """Loss of symmetry: an eigenvalue of the Hessian vanishes."""

    def __init__(self, problem: Problem, over: Parameter, branching: Solution) -> None:
        super().__init__(problem, over)
        self.softest = Softest(branching)

    def function(self, family: Family, state: State) -> float:
        """That eigenvalue."""
        return self.softest(family, state)


class Folding(AlongForce):
    """A fold: equilibria turn back in the end force."""

    noise = 1e-6

    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        """The same meshes, with tangents taken at the states themselves."""
        line = super().meshes(meshes, spot)
        line.coarse, line.fine = line.coarse.with_exact_tangent(), line.fine.with_exact_tangent()
        return line

    def function(self, family: Family, state: State) -> float:
        """The share of the parameter in the tangent."""
        return state.tangent_lam / family.lam_scale

    def zero_across(
        self,
        meshes: TwoMeshes,
        guess: NearbyStates,
        spot: PlanePoint,
        travel: CurveTangent,
        mesh: int,
        slope: float = math.inf,
    ) -> tuple[float, State, float]:
        """The fold on the hyperplane normal to ``travel``; where that fails, the one at the end force of ``spot``.

        Where branches meet, or a closed loop is born, the curve turns back in the parameter, and equilibria along the
        end force are not regular. Those along the parameter are, and their folds are the same: the Hessian is singular.
        """
        try:
            return super().zero_across(meshes, guess, spot, travel, mesh, slope)
        except CurveLostError:
            return *self._zero_at_load(meshes, (guess.coarse, guess.fine)[mesh], spot, travel, mesh), math.inf

    def _zero_at_load(
        self, meshes: TwoMeshes, c: FloatArray, spot: PlanePoint, travel: CurveTangent, mesh: int
    ) -> tuple[float, State]:
        """The fold of the equilibria along the parameter, at the end force of ``spot``, on one of both meshes."""
        if self.at(spot.x).ramps and self.over not in WHERE_CLEARANCE_VARIES:
            raise CurveLostError(f"it turns back in {self.over}, in which no state is followed where Δ varies")
        if self.at(spot.x).hole is not None and self.over not in IN_CURVED_HOLE:
            raise CurveLostError(f"it turns back in {self.over}, along which states in a curved hole are not followed")
        line = self.meshes(meshes, spot)
        along = path(self.at(spot.x), self.over, spot.value)
        family = replace((line.coarse, line.fine)[mesh], path=along, lam_scale=travel.unit)
        row, _, _, _ = family.covector((travel.coarse, travel.fine)[mesh], 0.0)
        outcome, state, _ = family.correct(c, spot.x, row, 0.0, float(row @ c))
        if state is None:
            raise CurveLostError(family.advice(outcome))
        fold = zero_from(family, state, self.function)
        there = self.meshes(meshes, PlanePoint(fold.lam, spot.value))
        found = (there.coarse, there.fine)[mesh].state(fold.c, spot.value, fold.tangent, 0.0, fold.index)
        return fold.lam, replace(found, energy=fold.energy)


class Vanishing(AlongForce):
    """Any number of a state vanishes."""

    def __init__(self, problem: Problem, over: Parameter, which: Number) -> None:
        super().__init__(problem, over)
        self.which = which
        self._value: Callable[[Family, State], float] | None = None

    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        """The same meshes; the number is that of the problem at ``spot``."""
        line = super().meshes(meshes, spot)
        self._value = value_on(self.at(spot.x), "force", line, self.which)
        return line

    def function(self, family: Family, state: State) -> float:
        """That number."""
        assert self._value is not None
        return self._value(family, state)


class Softest:
    """The eigenvalue that vanishes at a branch point, followed by its vector."""

    def __init__(self, branching: Solution) -> None:
        self.vectors: dict[int, np.ndarray] = {}
        self.parity = -branching.point.fine.symmetry

    def __call__(self, family: Family, state: State) -> float:
        """The eigenvalue at a state."""
        size = state.c.size
        if size not in self.vectors:
            vector = np.random.default_rng(0).standard_normal(size)
            self.vectors[size] = vector + self.parity * vector[::-1]
            family.nearest_curvature(state, self.vectors[size], 8)
        return family.nearest_curvature(state, self.vectors[size], 3)[0]
