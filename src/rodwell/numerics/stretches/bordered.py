"""The matrix of Newton's method on a chain: banded in the nodes, a border of one row for each break and the load."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any, NamedTuple

import numpy as np

from rodwell.numerics.stretches.assembly import Assembled
from rodwell.numerics.stretches.chain import ANGLE, ANGLE_RATE, RADIAL_SLOPE, Chain
from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray

WIDTH = 8
"""Coordinates of two neighbouring nodes: the Hessian's band."""

REACH = WIDTH - 1
ROWS = 3 * REACH + 1
"""Diagonals on either side, and rows of LAPACK's storage of such a band, with room for pivoting."""

Factors = tuple[FloatArray, Any]
"""Of a band: the two triangles, and the pivots (4n,)."""


@cache
def _lapack() -> Any:
    """LAPACK, when a state off the wall is solved for: results on the wall do not wait for it."""
    from scipy.linalg import lapack  # noqa: PLC0415 - slow to import

    return lapack


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


class _Entries(NamedTuple):
    """Where entries of blocks, and of a lower band (4n, 8), stand in flat storage.

    ``diagonal`` picks entries of blocks (n, 4, 4), ``at_diagonal`` are their places in the band, and ``at_below`` those
    of blocks (n−1, 4, 4) below; ``band`` picks those of the band that stand within the matrix, ``lower`` and ``upper``
    are their places, and those of their mirror images, in LAPACK's storage of a general band, column by column.
    """

    diagonal: IntArray
    at_diagonal: IntArray
    at_below: IntArray
    band: IntArray
    lower: IntArray
    upper: IntArray


@lru_cache(maxsize=64)
def _entries(nodes: int) -> _Entries:
    node, i, j = np.unravel_index(np.arange(16 * nodes), (nodes, 4, 4))
    low = np.flatnonzero(i >= j)
    at_diagonal = ((4 * node + j) * WIDTH + i - j)[low]
    at_below = ((4 * node + j) * WIDTH + 4 + i - j)[:-16]
    column, offset = np.divmod(np.arange(4 * nodes * WIDTH), WIDTH)
    within = np.flatnonzero(column + offset < 4 * nodes)
    column, row = column[within], (column + offset)[within]
    lower = column * ROWS + 2 * REACH + row - column
    upper = row * ROWS + 2 * REACH + column - row
    return _Entries(low, at_diagonal, at_below, within, lower, upper)


def lower_band(diagonal: FloatArray, below: FloatArray, held: BoolArray) -> FloatArray:
    """Blocks as the lower triangle of a band, rows and columns that are held replaced by those of the identity."""
    n, free = diagonal.shape[0], (~held).astype(float)
    at = _entries(n)
    diagonal = diagonal * free[:, :, None] * free[:, None, :]
    diagonal.reshape(n, 16)[:, ::5] += held
    band = np.zeros(4 * n * WIDTH)
    band[at.at_diagonal] = diagonal.ravel()[at.diagonal]
    band[at.at_below] = (below * free[1:, :, None] * free[:-1, None, :]).ravel()
    return band.reshape(4 * n, WIDTH)


def factorised(band: FloatArray) -> Factors:
    """Factors with pivoting of a symmetric band (4n, 8)."""
    at, size = _entries(band.shape[0] // 4), band.shape[0]
    general, entries = np.zeros(size * ROWS), band.ravel()[at.band]
    general[at.upper] = entries
    general[at.lower] = entries
    lu, pivots, _ = _lapack().dgbtrf(general.reshape(size, ROWS).T, REACH, REACH, overwrite_ab=True)
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
    factors: Factors
    lines: FloatArray
    answers: FloatArray
    small: FloatArray

    def increments(
        self, residual: FloatArray, moments: FloatArray, target: float
    ) -> tuple[FloatArray, FloatArray, float]:
        """Increments of nodes, breaks and load that cancel residuals (n, 4) and (m,), and for which the row is met."""
        m, free = moments.size, ~self.chain.unmoved
        first = solved_with(self.factors, residual * free)
        known = np.empty(m + 1)
        known[:m] = self.lines.reshape(m, first.size) @ first.ravel() - moments
        known[m] = target + np.sum(self.row.nodes * free * first)
        extra = np.linalg.solve(self.small, known)
        nodes = -(first + self.answers @ extra)
        return np.asarray(nodes * free), np.asarray(extra[:m], dtype=float), float(extra[m])


def solved_with(factors: Factors, columns: FloatArray) -> FloatArray:
    """Solve with the factors of a band: columns (4n, …) at once, or (n, 4, …)."""
    flat = columns.reshape(factors[1].size, -1)
    return np.asarray(_lapack().dgbtrs(factors[0], REACH, REACH, flat, factors[1])[0].reshape(columns.shape))


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
    factors = factorised(lower_band(out.diagonal, out.below, chain.unmoved))
    answers = solved_with(factors, columns * free[..., None])
    moving, breaks = chain.moving, np.arange(m)
    lines = np.zeros((m, n, 4))
    lines[breaks, moving] = out.diagonal[moving, RADIAL_SLOPE]
    lines[breaks, moving - 1] = out.below[moving - 1, RADIAL_SLOPE]
    lines[breaks, moving + 1] = out.below[moving, :, RADIAL_SLOPE]
    lines[breaks, moving, ANGLE] += out.moment_turns
    lines[breaks, moving, ANGLE_RATE] += out.moment_rates
    if out.by_bend is not None:
        lines += out.by_bend.nodes
    lines *= free
    small = np.empty((m + 1, m + 1))
    small[:m], small[m, :m], small[m, m] = columns[moving, RADIAL_SLOPE], row.breaks, row.load
    small[breaks, breaks] += out.moment_shifts
    if out.by_bend is not None:
        small[:m, :m] += out.by_bend.breaks
        small[:m, m] += out.by_bend.load
    flat = answers.reshape(4 * n, m + 1)
    small[:m] -= lines.reshape(m, 4 * n) @ flat
    small[m] -= (row.nodes * free).ravel() @ flat
    return Bordered(chain, row, factors, lines, answers, small)


def residuals(out: Assembled, row: Row) -> tuple[FloatArray, FloatArray, float]:
    """What is left of the equations of nodes and breaks, and what the row lacks."""
    shape = out.shape
    lacks = row.target - row.of(shape.nodes, shape.breaks, shape.load)
    moments = out.moments if out.by_bend is None else out.moments + out.by_bend.residual
    return out.residual, moments, lacks - row.work * (out.energy_by_load + out.work_residual)
