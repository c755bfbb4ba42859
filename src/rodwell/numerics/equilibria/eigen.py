"""Lowest eigenvalues of a banded symmetric pencil, none skipped.

``K v = λ G v`` with banded K and positive definite G. Spectrum slicing (the negative pivots of K − σG count the
eigenvalues below σ) gives brackets that cannot miss a root, also among near-degenerate pairs; inverse
iteration on a block of vectors with Rayleigh–Ritz gives the digits; a last count confirms that the block
holds the lowest. See B. N. Parlett, *The Symmetric Eigenvalue Problem* (1998), chapters 3, 4 and 11.

The Rayleigh quotients are formed by quadrature of squares, not from the matrices: the entries of K grow like
h⁻³ and cancel, squares do not. That keeps the digits at λ far below the largest eigenvalues.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.numerics.splines.banded import factorise, multiply, solve
from rodwell.quantities.arrays import FloatArray

Gram = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""From vectors (k, n) to their Gram matrices (k, k) under K and G."""

BLOCK_SPARE = 4
FIRST_ITERATIONS, STEPS = 3, 2
"""Steps of inverse iteration before the first Rayleigh–Ritz step, which costs ten times as much, and before each."""

MOST_ITERATIONS = 200
RESHIFT, SLOW = 6, 0.1
"""After so many iterations, if the last one gained less than this, the shift moves to just below the first value that
still changes: where a few lie far below the others, no shift below all makes the others converge fast."""

BELOW = 0.05
"""How far below the first eigenvalue a shift lies, as part of the distance to the last one of the block."""

GAP = 1e-2
"""Part of the block's spread from which a distance between neighbours counts as a gap."""

SMALL, EQUAL_VALUES = 1e-13, 1e-11
"""Relative changes of the eigenvalues from one iteration to the next that count as none."""


class EigenError(RuntimeError):
    """The eigenvalues could not be confirmed."""


def _independent(block: FloatArray) -> FloatArray:
    """Orthonormal vectors of the same span: those near the shift would drown the others."""
    return np.ascontiguousarray(np.linalg.qr(block.T)[0].T)


def block_size(count: int) -> int:
    """How many vectors are iterated for ``count`` eigenvalues."""
    return count + max(BLOCK_SPARE, count // 2)


def count_below(stiffness: FloatArray, gram: FloatArray, sigma: float) -> int:
    """Number of eigenvalues of K v = λ G v below ``sigma``."""
    return int(factorise(stiffness - sigma * gram))


def _inverse_step(factors: FloatArray, gram: FloatArray, block: FloatArray) -> FloatArray:
    """(K − σG)⁻¹ G applied to each vector of a block, or K in place of G."""
    out = np.array([multiply(gram, vector) for vector in block])
    for vector in out:
        solve(factors, vector)
    return out


def lowest(
    stiffness: FloatArray,
    gram: FloatArray,
    quadrature: Gram,
    count: int,
    below: float,
    start: tuple[FloatArray, FloatArray] | None,
    near: tuple[float, float] | None = None,
    *,
    right: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """The ``count`` lowest eigenvalues, rising, and their vectors.

    Parameters
    ----------
    stiffness, gram
        Bands of K and G, (n, width).
    quadrature
        Gram matrices of vectors under K and G, formed by quadrature.
    count
        How many.
    below
        A number below all eigenvalues.
    start
        Values (k,) and vectors (k, n) of a coarser mesh to start from, or None.
    near
        About where the first eigenvalue and number :func:`block_size` are, to spare counts; need not be right.
    right
        Band of what iterates are multiplied with, G if None. K gives the same vectors: (K − σG)⁻¹K v is v and a part of
        (K − σG)⁻¹G v. It is better where the eigenvalues pile up at zero, and where G is the one whose entries cancel.

    Returns
    -------
    values (k,), vectors (k, n) with v G v = 1; k ≥ ``count``, of which the first ``count`` have converged.

    Raises
    ------
    EigenError
        If fewer than ``count`` exist or the count of eigenvalues below does not agree.
    """
    n = stiffness.shape[0]
    size = min(n, block_size(count))
    if count > n:
        raise EigenError(f"only {n} modes on this mesh, {count} were asked for")
    shift = (
        _shift(stiffness, gram, below, size, near) if start is None else _shift_near(stiffness, gram, below, start[0])
    )
    factors = _factors(stiffness, gram, shift)
    block = np.random.default_rng(0).standard_normal((size, n))
    if start is not None:
        block[: min(size, len(start[1]))] = start[1][:size]
    previous, history, kept = np.full(count, np.inf), [np.inf], 0
    for iteration in range(1, MOST_ITERATIONS + 1):
        moved = block[kept:]
        for _ in range(STEPS if kept == 0 else 1):  # once some are kept the others would turn into them
            moved = _independent(_inverse_step(factors, gram if right is None else right, moved))
        values, block = _rayleigh_ritz(np.concatenate([block[:kept], moved]), quadrature)
        if len(values) < count:
            raise EigenError("the vectors that are iterated became dependent")
        changes = np.abs(values[:count] - previous) / (np.abs(values[:count]) + 1.0)
        previous = values[:count].copy()
        history.append(float(np.max(changes)))
        if _settled(history) and _confirmed(stiffness, gram, values, count):
            return values, block
        if iteration % RESHIFT == 0 and history[-1] > max(EQUAL_VALUES, SLOW * history[-2]):
            kept = _before_gap(values, int(np.argmax(changes > SMALL)))
            shift = _shift_above(stiffness, gram, values, kept) if kept > 0 else shift
            factors = _factors(stiffness, gram, shift)
            history.append(np.inf)
    raise EigenError("inverse iteration did not settle, or the count of eigenvalues does not agree")


def _before_gap(values: FloatArray, kept: int) -> int:
    """The largest number up to ``kept`` of first values that a gap parts from the rest: no pair is cut in two."""
    spread = values[-1] - values[0]
    while kept > 0 and values[kept] - values[kept - 1] < GAP * spread:
        kept -= 1
    return kept


def _factors(stiffness: FloatArray, gram: FloatArray, shift: float) -> FloatArray:
    factors = stiffness - shift * gram
    factorise(factors)
    return factors


def _settled(history: list[float]) -> bool:
    """Whether the values no longer change: to the last digits, or to round-off, which does not fall any more."""
    change, before = history[-1], history[-2]
    return change < SMALL or (change < EQUAL_VALUES and before < np.inf and change > 0.5 * before)


def _shift_above(stiffness: FloatArray, gram: FloatArray, values: FloatArray, kept: int) -> float:
    """A shift above the first ``kept`` eigenvalues and a little below the next one, which counting brackets.

    Not nearer than a fiftieth of the block's spread, if there is room: next to an eigenvalue every vector would turn
    into that of its mode, and the block would lose its rank.
    """
    known, high = float(values[kept - 1]), float(values[kept])
    low = known + 1e-6 * (high - known)
    width = 0.02 * float(values[-1] - values[kept])
    while high - low > width and low < 0.5 * (low + high) < high:
        low, high = _halve(stiffness, gram, low, high, kept + 1)
    return max(low - width, 0.5 * (known + low))


def _shift(
    stiffness: FloatArray, gram: FloatArray, below: float, size: int, near: tuple[float, float] | None = None
) -> float:
    """A shift below the first eigenvalue, nearer to it than a tenth of its distance to number ``size``.

    ``near``: about where these two are, if that is known. Counts confirm it.
    """
    low, high = below, below + max(1.0, abs(below))
    if near is not None:
        first, last = near
        low, high = first - (last - first), last
        if low <= below or count_below(stiffness, gram, low) > 0:
            low = below
        below = low
    while count_below(stiffness, gram, high) < size:
        low, high = high, high + 2.0 * (high - below)
    bottom, top = (below, high), (low, high)
    while True:
        bottom = _halve(stiffness, gram, *bottom, 1)
        top = _halve(stiffness, gram, *top, size)
        spread = top[0] - bottom[1]
        width = max(bottom[1] - bottom[0], top[1] - top[0])
        if width < 0.1 * spread or width < 1e-12 * (abs(bottom[1]) + abs(below)):
            return bottom[0] - BELOW * (top[1] - bottom[0])


def _shift_near(stiffness: FloatArray, gram: FloatArray, below: float, values: FloatArray) -> float:
    """The shift that belongs to values from a coarser mesh, if counting finds none below it."""
    shift = float(values[0] - BELOW * (values[-1] - values[0]))
    return shift if count_below(stiffness, gram, shift) == 0 else _shift(stiffness, gram, below, len(values))


def _halve(stiffness: FloatArray, gram: FloatArray, low: float, high: float, which: int) -> tuple[float, float]:
    """Halve a bracket of eigenvalue number ``which`` (from 1)."""
    middle = 0.5 * (low + high)
    return (low, middle) if count_below(stiffness, gram, middle) >= which else (middle, high)


def _rayleigh_ritz(block: FloatArray, quadrature: Gram) -> tuple[FloatArray, FloatArray]:
    """Ritz values, rising, and vectors of a block; orthonormal under G."""
    block = block / np.linalg.norm(block, axis=1)[:, None]
    k, g = quadrature(block)
    size, vectors = np.linalg.eigh(g)
    keep = size > 1e-14 * size[-1]
    basis = vectors[:, keep] / np.sqrt(size[keep])
    values, turn = np.linalg.eigh(basis.T @ k @ basis)
    return values, (basis @ turn).T @ block


def _confirmed(stiffness: FloatArray, gram: FloatArray, values: FloatArray, count: int) -> bool:
    """Whether exactly the first ``count`` (or a few more, if they cannot be told apart) lie below a gap."""
    spread = values[-1] - values[0]
    for last in range(count, len(values)):
        if values[last] - values[last - 1] > 1e-7 * spread:
            return bool(count_below(stiffness, gram, 0.5 * (values[last - 1] + values[last])) == last)
    return False
