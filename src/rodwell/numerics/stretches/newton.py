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
from functools import cache, cached_property
from typing import Any

import numpy as np

from rodwell.numerics.splines import banded
from rodwell.numerics.stretches.assembly import Assembled, assemble, bubbles_of
from rodwell.numerics.stretches.chain import ANGLE_RATE, RADIAL_SLOPE, Chain, Shape
from rodwell.quantities.arrays import BoolArray, FloatArray

WIDTH = 8
"""Coordinates of two neighbouring nodes: the Hessian's band."""

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


@cache
def _lapack() -> Any:
    """LAPACK, when a state off the wall is solved for: results on the wall do not wait for it."""
    from scipy.linalg import lapack  # noqa: PLC0415 - slow to import

    return lapack


class Outcome(Enum):
    """What came of a solve."""

    CONVERGED = "converged"
    NOT_CONVERGED = "Newton's method did not converge"
    OUT_OF_RANGE = "the rod turned across the hole (|t·k| → 0), or a stretch vanished"


@dataclass(frozen=True, eq=False, repr=False)
class Row:
    """A condition nodes·N + breaks·B + load·λ + work·∂E/∂λ = target, with weights of the same shapes as the unknowns.

    It is linear but for the derivative of the energy by the load, what the load does its work on.
    """

    nodes: FloatArray
    breaks: FloatArray
    load: float
    target: float
    work: float = 0.0

    def of(self, nodes: FloatArray, breaks: FloatArray, load: float) -> float:
        """Its left side without the work."""
        return float(np.sum(self.nodes * nodes) + self.breaks @ breaks + self.load * load)


def fixed_load(chain: Chain, load: float) -> Row:
    """The row that prescribes the load."""
    return Row(np.zeros((chain.elements + 1, 4)), np.zeros(chain.moving.size), 1.0, load)


def fixed_work(chain: Chain, work: float, load: float = 0.0) -> Row:
    """The row that prescribes ∂E/∂λ + ``load`` · λ."""
    return Row(np.zeros((chain.elements + 1, 4)), np.zeros(chain.moving.size), load, work, 1.0)


@dataclass(frozen=True, eq=False, repr=False)
class Solved:
    """An equilibrium of a chain: the last assembly, moments at the breaks and forces there."""

    model: Any
    out: Assembled

    @property
    def shape(self) -> Shape:
        """The state itself."""
        return self.out.shape

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


def lower_band(diagonal: FloatArray, below: FloatArray, held: BoolArray) -> FloatArray:
    """Blocks as the lower triangle of a band, rows and columns that are held replaced by those of the identity."""
    n = diagonal.shape[0]
    free = ~held
    diagonal = diagonal * (free[:, :, None] & free[:, None, :])
    diagonal[:, np.arange(4), np.arange(4)] += held
    below = below * (free[1:, :, None] & free[:-1, None, :])
    band = np.zeros((n, 4, WIDTH))
    for j in range(4):
        for i in range(j, 4):
            band[:, j, i - j] = diagonal[:, i, j]
        for i in range(4):
            band[:-1, j, 4 + i - j] = below[:, i, j]
    return band.reshape(4 * n, WIDTH)


def _general(band: FloatArray) -> tuple[FloatArray, Any]:
    """Factors with pivoting of a symmetric band (size, 8)."""
    size, reach = band.shape[0], WIDTH - 1
    general = np.zeros((3 * reach + 1, size))
    for k in range(WIDTH):
        general[2 * reach + k, : size - k] = band[: size - k, k]
        general[2 * reach - k, k:] = band[: size - k, k]
    lu, pivots, _ = _lapack().dgbtrf(general, reach, reach, overwrite_ab=True)
    return lu, pivots


@dataclass(frozen=True, eq=False, repr=False)
class Bordered:
    """The bordered matrix of an assembly and a row, factorised.

    ``lines`` (m, n, 4) are the rows of the breaks' equations in the nodes, ``answers`` (n, 4, m+1) what the banded part
    makes of its columns for breaks and load, ``small`` (m+1, m+1) what remains of the border. ``row`` has the weights
    of its work, if any, added to those of the unknowns.
    """

    chain: Chain
    row: Row
    factors: tuple[FloatArray, Any]
    lines: FloatArray
    answers: FloatArray
    small: FloatArray

    def increments(
        self, residual: FloatArray, moments: FloatArray, target: float
    ) -> tuple[FloatArray, FloatArray, float]:
        """Increments of nodes, breaks and load that cancel residuals (n, 4) and (m,), and for which the row is met."""
        m, free = moments.size, ~self.chain.unmoved
        first = _banded_answer(self.factors, residual * free)
        known = np.append(np.tensordot(self.lines, first, 2) - moments, target + np.sum(self.row.nodes * free * first))
        extra = np.linalg.solve(self.small, known)
        nodes = -(first + self.answers @ extra)
        return np.asarray(nodes * free), np.asarray(extra[:m], dtype=float), float(extra[m])


def _banded_answer(factors: tuple[FloatArray, Any], columns: FloatArray) -> FloatArray:
    """Solve with the factors of the band: columns (n, 4, …) at once."""
    flat = columns.reshape(4 * columns.shape[0], -1)
    return np.asarray(_lapack().dgbtrs(factors[0], WIDTH - 1, WIDTH - 1, flat, factors[1])[0].reshape(columns.shape))


def bordered(out: Assembled, row: Row) -> Bordered:
    """Factorise the matrix of Newton's method: banded in the nodes, a border of one row for each break and the load."""
    chain = out.shape.chain
    if row.work:
        row = Row(
            row.nodes + row.work * out.by_load, row.breaks + row.work * out.work_by_break,
            row.load + row.work * out.work_by_load, row.target,
        )  # fmt: skip
    n, m, free = chain.elements + 1, chain.moving.size, ~chain.unmoved
    columns = np.concatenate([out.by_break, out.by_load[..., None]], axis=2)
    factors = _general(lower_band(out.diagonal, out.below, chain.unmoved))
    answers = _banded_answer(factors, columns * free[..., None])
    moving, breaks = chain.moving, np.arange(m)
    lines = np.zeros((m, n, 4))
    lines[breaks, moving] = out.diagonal[moving, RADIAL_SLOPE]
    lines[breaks, moving - 1] = out.below[moving - 1, RADIAL_SLOPE]
    lines[breaks, moving + 1] = out.below[moving, :, RADIAL_SLOPE]
    lines[breaks, moving, ANGLE_RATE] += out.moment_rates
    lines *= free
    small = np.vstack([columns[moving, RADIAL_SLOPE], np.append(row.breaks, row.load)])
    small[:m] -= np.tensordot(lines, answers, 2)
    small[m] -= np.tensordot(row.nodes * free, answers, 2)
    return Bordered(chain, row, factors, lines, answers, small)


def residuals(out: Assembled, row: Row) -> tuple[FloatArray, FloatArray, float]:
    """What is left of the equations of nodes and breaks, and what the row lacks."""
    shape = out.shape
    lacks = row.target - row.of(shape.nodes, shape.breaks, shape.load)
    return out.residual, out.moments, lacks - row.work * (out.energy_by_load + out.work_residual)


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
            return Outcome.CONVERGED, Solved(model, assemble(model, shape)), step
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
    lu, pivots = _general(state.band)
    rng = np.random.default_rng(0)
    vector = rng.standard_normal(state.band.shape[0]) * np.where(state.shape.chain.held, 0.0, 1.0).ravel()
    for _ in range(rounds):
        vector, _ = _lapack().dgbtrs(lu, WIDTH - 1, WIDTH - 1, vector, pivots)
        vector /= np.linalg.norm(vector)
    return np.asarray(vector)


def stiffness_along(state: Solved, direction: FloatArray) -> float:
    """1/(dᵀA⁻¹d) of the stability Hessian A: a smooth function that vanishes where A is singular along about d."""
    lu, pivots = _general(state.band)
    solved, _ = _lapack().dgbtrs(lu, WIDTH - 1, WIDTH - 1, direction, pivots)
    return 1.0 / float(direction @ solved)
