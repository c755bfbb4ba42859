"""Newton's method on a chain: banded in the nodes, with a border of one row for each break and one for the load.

A break between a stretch on the rim and a free one is no stationary point in the ordinary sense: the energy, minimised
over all else, depends on its place like a cube, since its derivative is −½(r″)² and r″ vanishes there. So the equation
of a break is r″ = 0 itself, in the weak form of a vanishing radial moment ∂E/∂r′, a reaction that the assembly holds
anyway. The same equation places points of contact. The Hessian for stability is that of fixed breaks; at a point of
contact the radial slope is free in it, and rolling adds P(δr′)²/|r″|.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Any

import numpy as np

from rodwell.numerics.splines import banded
from rodwell.numerics.stretches.assembly import Assembled, assemble, bubbles_of
from rodwell.numerics.stretches.bordered import Row, bordered, factorised, lower_band, residuals, solved_with
from rodwell.numerics.stretches.chain import RADIAL_SLOPE, Shape
from rodwell.quantities.arrays import FloatArray

TOLERANCE = 1e-10
"""Increment of the nodes' coordinates, relative, at which Newton's method has converged."""

SURE = 0.01
"""Part of the tolerance below which the next increment, foretold from two that shrink quadratically, is not waited for.
"""

ROUND_OFF, RESIDUAL = 1e-4, 1e-13
"""Increments below the first that no longer shrink are round-off, if the residual is below the second, relative to the
Hessian: next to a singular one increments are that large, along its null vector."""

MOST_SHRUNK, MOST_MOVED = 0.6, 0.5
"""Of a step no more is taken than shortens an element by this part, or moves a node by this much."""

MOST_STEPS = 14


class Outcome(Enum):
    """What came of a solve."""

    CONVERGED = "converged"
    NOT_CONVERGED = "Newton's method did not converge"
    OUT_OF_RANGE = "the rod turned across the hole (|t·k| → 0), or a stretch vanished"


@dataclass(frozen=True, eq=False, repr=False)
class Solved:
    """An equilibrium of a chain: its assembly, moments at the breaks and forces there.

    ``found`` is that assembly, or the shape, which is assembled when first asked for: a gap or a contact pressure is
    read off the shape.
    """

    model: Any
    found: Assembled | Shape

    @property
    def shape(self) -> Shape:
        """The state itself."""
        return self.found if isinstance(self.found, Shape) else self.found.shape

    @cached_property
    def out(self) -> Assembled:
        """The assembly there."""
        return assemble(self.model, self.found) if isinstance(self.found, Shape) else self.found

    @property
    def forces(self) -> FloatArray:
        """Outward point forces at the moving nodes (m,)."""
        return self.out.forces

    @cached_property
    def openings(self) -> FloatArray:
        """Second derivative −r″ of the gap at the moving nodes, averaged over the free sides, (m,)."""
        chain = self.shape.chain
        found = np.zeros(chain.moving.size)
        for i, node in enumerate(chain.moving):
            sides = [
                gap_curvature(self.shape, e, xi) for e, xi in ((node - 1, 1.0), (node, 0.0)) if not chain.touching[e]
            ]
            found[i] = float(np.mean(sides))
        return found

    @cached_property
    def band(self) -> FloatArray:
        """The stability Hessian: breaks fixed, rolling at points of contact, (4n, 8)."""
        chain = self.shape.chain
        diagonal, held = self.out.diagonal.copy(), chain.held.copy()
        for i in np.flatnonzero(chain.points):
            node, opening = chain.moving[i], self.openings[i]
            if opening > 0.0 and self.forces[i] >= 0.0:
                held[node, RADIAL_SLOPE] = False
                diagonal[node, RADIAL_SLOPE, RADIAL_SLOPE] += self.forces[i] / opening
        return lower_band(diagonal, self.out.below, held)

    @cached_property
    def index(self) -> int:
        """Negative eigenvalues of the second variation that keeps contacts closed."""
        return int(banded.factorise(self.band.copy())) + self.out.negative_bubbles

    def tangent(self, row: Row) -> tuple[FloatArray, FloatArray, float, FloatArray]:
        """Derivatives of nodes, breaks, load and bubbles along the path, for which ``row`` gives 1."""
        none = np.zeros_like(self.shape.nodes), np.zeros_like(self.shape.breaks)
        nodes, breaks, load = bordered(self.out, row).increments(*none, 1.0)
        return nodes, breaks, load, bubbles_of(self.out, nodes, breaks, load, 0.0)

    def work_rate(self, nodes: FloatArray, breaks: FloatArray, load: float) -> float:
        """How fast the derivative of the energy by the load changes along the path."""
        out = self.out
        return float(np.sum(out.by_load * nodes) + out.work_by_break @ breaks + out.work_by_load * load)


def gap_curvature(shape: Shape, element: int, xi: float) -> float:
    """−r″ of a free element at a place on the rim."""
    u = shape.at(element, np.array([xi]), 3)[:, :, 0]
    r = float(np.hypot(*u[:, 0]))
    radial = float(u[:, 0] @ u[:, 1]) / r
    return -(float(u[:, 0] @ u[:, 2] + u[:, 1] @ u[:, 1]) / r - radial**2 / r)


def solve(
    model: Any, shape: Shape, row: Row, tolerance: float = TOLERANCE, most: int = MOST_STEPS
) -> tuple[Outcome, Solved | None, int]:
    """Newton's method from ``shape`` to the equilibrium that meets ``row``: what came of it, and how many steps."""
    scale = np.maximum(1.0, np.max(np.abs(shape.nodes), axis=0))
    before = np.inf
    for step in range(1, most + 1):
        try:
            with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
                out = assemble(model, shape)
        except np.linalg.LinAlgError:  # no numbers within an element
            return Outcome.OUT_OF_RANGE, None, step
        if not np.isfinite(out.energy):
            return Outcome.OUT_OF_RANGE, None, step
        try:
            nodes, breaks, load = bordered(out, row).increments(*residuals(out, row))
        except np.linalg.LinAlgError:
            return Outcome.NOT_CONVERGED, None, step
        size = max(float(np.max(np.abs(nodes) / scale)), float(np.max(np.abs(breaks), initial=0.0)))
        if not np.isfinite(size) or size > 1e3:
            return Outcome.NOT_CONVERGED, None, step
        size = max(size, abs(load) / (1.0 + abs(shape.load)))
        part = _safe_part(shape, nodes, breaks)
        bubbles = bubbles_of(out, nodes, breaks, load, 1.0)
        shape = shape.moved(part * nodes, part * bubbles, part * breaks, part * load)
        sure = part == 1.0 and before < np.inf and size * (size / before) ** 2 < SURE * tolerance
        if size < tolerance or sure or (size < ROUND_OFF and size > 0.3 * before and _balanced(out)):
            return Outcome.CONVERGED, Solved(model, shape), step
        before = size
    return Outcome.NOT_CONVERGED, None, most


def _balanced(out: Assembled) -> bool:
    """Whether the nodes' equations are met to round-off."""
    left = float(np.max(np.abs(out.residual[~out.shape.chain.unmoved]), initial=0.0))
    return left <= RESIDUAL * float(np.max(np.abs(out.diagonal)))


def _safe_part(shape: Shape, nodes: FloatArray, breaks: FloatArray) -> float:
    """How much of a step is taken: no element loses more than most of its length, no node moves across the disc."""
    lengths, change = np.diff(shape.places), np.diff(shape.chain.shares @ breaks)
    shrink = float(np.max(-change / lengths, initial=0.0))
    across = float(np.max(np.abs(nodes[:, :2])))
    return min(1.0, MOST_SHRUNK / shrink if shrink > MOST_SHRUNK else 1.0, MOST_MOVED / max(across, MOST_MOVED))


def softest(state: Solved, rounds: int = 4) -> FloatArray:
    """Direction (4n,) in which the stability Hessian is nearest to singular, by inverse iteration."""
    factors = factorised(state.band)
    rng = np.random.default_rng(0)
    vector = rng.standard_normal(state.band.shape[0]) * np.where(state.shape.chain.held, 0.0, 1.0).ravel()
    for _ in range(rounds):
        vector = solved_with(factors, vector)
        vector /= np.linalg.norm(vector)
    return np.asarray(vector)


def stiffness_along(state: Solved, direction: FloatArray) -> float:
    """1/(dᵀA⁻¹d) of the stability Hessian A: a smooth function that vanishes where A is singular along about d."""
    return 1.0 / float(direction @ solved_with(factorised(state.band), direction))
