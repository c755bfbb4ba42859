"""One-parameter families of equilibria on one spline space, and states of them.

A family holds everything that stays fixed along a branch: the model, the direction in parameter space,
the space, the end conditions, the symmetry to keep, and the metric

    ‖(c, λ)‖² = ∫ y'² ds / slope_scale² + λ²/λ_scale²

in which arclength, step lengths and angles are measured. It is stated here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.compiling.kernels import direct
from rodwell.compiling.second_process import wait_for
from rodwell.numerics.equilibria import newton
from rodwell.numerics.equilibria.cells import branches_between, breaks
from rodwell.numerics.equilibria.newton import Tolerances
from rodwell.numerics.equilibria.outcome import OUTCOMES, Outcome
from rodwell.numerics.equilibria.state import State, _part
from rodwell.numerics.splines import assembly, banded
from rodwell.numerics.splines.held import Ends, Held, gather, spread
from rodwell.numerics.splines.records import Discretisation
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.quantities.arrays import FloatArray

EIGENVALUE_NOISE = 8.0 * float(np.finfo(float).eps)
"""Round-off left in a second variation, as a part of the size of its terms."""

Given = Callable[[FloatArray], FloatArray]
"""Coefficients that vary along s: values (m, k) at places (m,)."""

MIRROR = (-1, False)
ALL_REFLECTIONS = MIRROR, (1, True), (-1, True)
"""u → −u(s), u(1 − s), −u(1 − s)."""

_NOTHING = np.empty(0)
_newton = direct(newton.newton)
_assemble, _variation = direct(assembly.assemble), direct(assembly.variation)


def on_path(path: FloatArray, lam: float) -> FloatArray:
    """Return parameters and their derivatives at λ on a path, (2, k): see :class:`Family`."""
    out = np.empty((2, path.shape[1]))
    newton.on_path(path, lam, out[0], out[1])
    return out


@dataclass(frozen=True)
class Family:
    """Equilibria of ``model`` along a path in its parameters, with given ends: see the module's text.

    ``path`` (4, k) gives the parameters p(λ) = path[0] + λ path[1] + cos λ path[2] + sin λ path[3], λ in degrees in the
    latter two; more rows add a series (:mod:`rodwell.numerics.equilibria.series`). ``parity`` 1 or −1 keeps increments
    even or odd about the middle, 0 leaves them. ``given`` are the coefficients that vary along s, as the model names
    them. ``reflections`` (sign, turned) are those, u(s) → ± u(s) or ± u(1 − s), that make states of states all along
    the path; ``first_integral`` says that the density does not depend on s, is quadratic in u″ at rest, and both ends
    are clamped at rest; ``cells`` are signs of the reflections about
    any place (:mod:`rodwell.numerics.equilibria.cells`), of which the ends are two. Without one of these nothing
    branches.
    """

    model: Any
    path: FloatArray
    space: SplineSpace
    ends: Ends
    parity: int
    scale_c: float
    slope_scale: float
    lam_scale: float
    tolerance: float = 1e-8
    most_steps: int = 8
    extra_steps: int = 0
    given: Given | None = None
    reflections: tuple[tuple[int, bool], ...] = ALL_REFLECTIONS
    first_integral: bool = False
    cells: tuple[int, ...] = ()

    def advice(self, outcome: Outcome) -> str:
        """What came of a solve, in words; where it left the range of the model, in the model's."""
        return str(self.model.out_of_range()) if outcome is Outcome.OUT_OF_RANGE else outcome.value

    def on(self, space: SplineSpace) -> Family:
        """Return the same family on another space."""
        return replace(self, space=space)

    def with_exact_tangent(self) -> Family:
        """Return the same family with tangents and index taken at the converged state, at the cost of a step."""
        return self if self.extra_steps == 1 else self._with_extra_steps

    @property
    def quick(self) -> Family:
        """The same family without that step."""
        return self if self.extra_steps == 0 else self._with_extra_steps

    @cached_property
    def _with_extra_steps(self) -> Family:
        """The family with the other number of extra steps, on the same record of the mesh."""
        other = replace(self, extra_steps=1 - self.extra_steps)
        other.__dict__.update(mesh=self.mesh, held=self.held, _with_extra_steps=self)
        return other

    @cached_property
    def held(self) -> Held:
        """What the ends hold among the coefficients."""
        return self.ends.among(self.space.size)

    @cached_property
    def mesh(self) -> Discretisation:
        """The family on its mesh, as compiled loops take it."""
        space, (local, per_element) = self.space, self.space.tags
        quadrature = space.table, space.points, space.weights, space.slope_gram
        given = np.empty((space.points.size, 0)) if self.given is None else self.given(space.points)
        return Discretisation(
            self.model, local, per_element, *quadrature, self.held.held, self.held.follows, space.starts, given,
            self.parity,
        )  # fmt: skip

    @cached_property
    def tolerances(self) -> Tolerances:
        """When Newton's method has converged, as compiled loops take it."""
        sizes = float(self.scale_c), float(self.lam_scale), float(self.slope_scale)
        return Tolerances(self.tolerance, self.most_steps, self.extra_steps, *sizes)

    def _tolerances(self, step: float) -> Tolerances:
        """The same with another tolerance of the steps."""
        return self.tolerances if step == self.tolerance else self.tolerances._replace(step=step)

    def forget_tables(self) -> None:
        """Let go of what was computed for the mesh: it is made again where it is needed."""
        for family in (self, vars(self).get("_with_extra_steps", self)):
            vars(family).pop("mesh", None)
        self.space.forget_tables()

    @property
    def _metric(self) -> tuple[float, float]:
        return self.slope_scale**-2, self.lam_scale**-2

    def parameters(self, lam: float) -> FloatArray:
        """Return all parameters of the model at λ."""
        return np.asarray(on_path(self.path, lam)[0])

    def rates(self, lam: float) -> FloatArray:
        """Return the derivatives of all parameters of the model by λ."""
        return np.asarray(on_path(self.path, lam)[1])

    def covector(self, tangent: FloatArray, tangent_lam: float) -> tuple[FloatArray, float, FloatArray, float]:
        """Return row, row_λ and the tangent, normalised in the metric."""
        unit, row = tangent.copy(), np.empty_like(tangent)
        unit_lam, row_lam = newton.hyperplane(self.space.slope_gram, *self._metric, unit, tangent_lam, row)
        return row, row_lam, unit, unit_lam

    def state(self, c: FloatArray, lam: float, tangent: FloatArray, tangent_lam: float, index: int) -> State:
        """Return a state from parts that are known to solve the equations (the straight rod)."""
        row, row_lam, unit, unit_lam = self.covector(tangent, tangent_lam)
        return State(self.space, c, lam, unit, unit_lam, row, row_lam, index, 0.0)

    def correct(
        self,
        c: FloatArray,
        lam: float,
        row: FloatArray,
        row_lam: float,
        target: float,
        frozen: FloatArray | None = None,
    ) -> tuple[Outcome, State | None, int]:
        """Newton from ``(c, λ)`` to the equilibrium with ``row·c + row_λ λ = target``.

        Increments are kept normal to ``frozen`` (n,), if given, in the product ∫u'v' ds.
        Returns the outcome, the state (None unless converged; its tangent points towards growing
        ``row·c + row_λ λ``) and the number of Newton steps.
        """
        return self._correct(c, lam, row, row_lam, target, frozen, self.tolerance)[:3]

    def _correct(
        self,
        c: FloatArray,
        lam: float,
        row: FloatArray,
        row_lam: float,
        target: float,
        frozen: FloatArray | None,
        tolerance: float,
    ) -> tuple[Outcome, State | None, int, FloatArray]:
        """The same, with the factors of the last Hessian."""
        c = c.copy()
        tangent, new_row = np.empty(c.size), np.empty(c.size)
        direction, covector = (_NOTHING, _NOTHING) if frozen is None else self._normalised(frozen)
        wait_for("newton")
        status, lam, tangent_lam, new_row_lam, index, energy, steps, factors = _newton(
            self.mesh, self._tolerances(tolerance), self.path, row, row_lam, target, direction, covector,
            c, lam, tangent, new_row,
        )  # fmt: skip
        if status != newton.CONVERGED:
            return OUTCOMES[status], None, steps, factors
        state = State(self.space, c, lam, tangent, tangent_lam, new_row, new_row_lam, index, energy)
        return Outcome.CONVERGED, state, steps, factors

    def _normalised(self, vector: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return a vector (n,) of length one in the product ∫u'v' ds, and its covector."""
        covector = banded.multiply(self.space.slope_gram, vector)
        gather(covector, self.mesh.held, self.mesh.follows)  # what is held has no part in it
        length = float(np.sqrt(vector @ covector))
        return vector / length, covector / length

    def assemble(self, c: FloatArray, lam: float) -> tuple[float, FloatArray, FloatArray]:
        """Energy, gradient (n,) and band (n, degree+1) of the Hessian at any coefficients, held ones included."""
        space = self.space
        gradient, mixed, band = np.empty(space.size), np.empty(space.size), np.empty((space.size, space.degree + 1))
        energy, _ = _assemble(self.mesh, np.ascontiguousarray(c), *on_path(self.path, lam), gradient, mixed, band)
        return energy, gradient, band

    def nearest_curvature(self, state: State, vector: FloatArray, iterations: int) -> tuple[float, float]:
        """Eigenvalue of H v = μ G v (G: ∫v'²) nearest to zero, by inverse iteration from ``vector`` (n,); its noise.

        ``vector`` becomes the eigenvector. The value is the Rayleigh quotient formed by quadrature of the second
        variation: unlike a tiny pivot, it is not drowned by the round-off of entries that grow like h⁻³. The noise is
        what round-off leaves in it.
        """
        factors = self.held.restrict(self.assemble(state.c, state.lam)[2])
        banded.factorise(factors)
        mesh = self.mesh
        newton.inverse_iteration(mesh.gram, mesh.held, mesh.follows, factors, iterations, vector)
        wait_for("variation")
        above, size, below = _variation(mesh, state.c, *on_path(self.path, state.lam), vector)
        return float(above / below), float(EIGENVALUE_NOISE * size / below)

    def at(self, c: FloatArray, lam: float) -> tuple[Outcome, State | None, int]:
        """Newton from ``c`` at fixed λ."""
        return self.correct(c, lam, np.zeros_like(c), 1.0, lam)

    def step(self, state: State, length: float) -> State | None:
        """One pseudo-arclength step from ``state`` along its tangent; None if Newton's method fails."""
        c, lam = state.c + length * state.tangent, state.lam + length * state.tangent_lam
        return self.step_to(state, length, c, lam, self.tolerance)[1]

    def step_to(
        self, state: State, length: float, c: FloatArray, lam: float, tolerance: float
    ) -> tuple[Outcome, State | None, float, FloatArray]:
        """One pseudo-arclength step from ``state`` along its tangent, to where ``(c, λ)`` is expected.

        Newton's method ends with the first step below ``tolerance``. Returns what came of it, the new state, how far
        that lies from where it was expected, and the factors of the last Hessian.
        """
        increment = c - state.c
        # Newton's method leaves alone what breaks the symmetry or an end condition: round-off in it would grow
        # from prediction to prediction
        newton.symmetrise(increment, self.parity)
        spread(increment, self.mesh.held, self.mesh.follows)
        c = state.c + increment
        target = float(state.row @ state.c) + state.row_lam * state.lam + length
        outcome, new, _, factors = self._correct(c, lam, state.row, state.row_lam, target, None, tolerance)
        return outcome, new, np.inf if new is None else self.distance(new.c - c, new.lam - lam), factors

    def may_branch(self, before: State, after: State, vector: FloatArray | None = None) -> bool:
        """Whether other states may branch off between two states of a branch: the equations must allow it.

        A reflection leaves the states as they are, and what branches off, along the null ``vector`` (n,) if that is
        known, breaks it. Or there is a first integral, whose values at two clamped ends are −½u″²: states have
        u″(0) = u″(1), or u″(0) = −u″(1), and those of one kind meet those of the other where both vanish (u′ is the
        null vector there).
        """
        if not before.c.any():
            return True
        parity = self.parity or (before.symmetry if before.space.symmetric else 0)
        kept = self.parity != 0 or (parity, True) in self.reflections
        if parity != 0 and kept and (vector is None or breaks(vector, parity)):
            return True
        if branches_between(before, after, self.cells, vector):
            return True
        if not self.first_integral:
            return False
        bends = [state.space.evaluate(state.c, np.array([0.0, 1.0]), 3)[2] for state in (before, after)]
        return bool(np.all(bends[0] * bends[1] <= 0.0))

    def meets_mirror_image(self, state: State, tolerance: float) -> bool:
        """Whether a branch that turns back in λ at a state meets its own mirror image there.

        A reflection leaves the state as it is, to within ``tolerance``, and turns the branch round: the tangent has
        the other symmetry. Where a branch of symmetric states folds, it has theirs.
        """
        if MIRROR in self.reflections and np.max(np.abs(state.c)) < tolerance * self.scale_c:
            return True
        parity = state.symmetry_within(tolerance) if self.parity == 0 and state.space.symmetric else 0
        if parity == 0 or (parity, True) not in self.reflections:
            return False
        kept = _part(state.tangent, parity)
        return self.distance(state.tangent - kept, 0.0) > self.distance(kept, state.tangent_lam)

    def distance(self, c: FloatArray, lam: float) -> float:
        """Length of a difference of states in the metric."""
        weight_c, weight_lam = self._metric
        square = weight_c * float(c @ banded.multiply(self.space.slope_gram, c)) + weight_lam * lam**2
        return float(np.sqrt(max(square, 0.0)))
