"""Certified counts: how many critical loads lie above a given end force, proved in ball arithmetic.

The second variation of the energy at the straight rod is, with N(s) = F + wₐ(s − 1) and β = wₗ/Δ (negative on top),

    Q[y] = ∫₀¹ y''² + N y'² + β y² ds,    whose Euler equation is (64).

Cut the rod into elements so short that Q is positive on functions that vanish with their slope at both ends of an
element. Then the number of negative directions of Q is that of a quadratic form in the values and slopes at the nodes
alone: the Schur complement of the positive interiors, whose element matrices come from exact solutions of (64)
(W. H. Wittrick and F. W. Williams, *Quart. J. Mech. Appl. Math.* 24 (1971) 263–284, with no interior loads to count).
Every step is done in balls that contain the true number (Arb):

- *interiors*: ∫y''² ≥ (4π²/h²)∫y'² and ∫y'² ≥ (π²/h²)∫y² on an element of length h with clamped ends, so
  4π²/h² + N > 0, times π²/h² greater than −β, proves Q > 0 there;
- *solutions*: power series about mid-element, with a bound of the tail that is proved in :func:`_solution`;
- *nodes*: block elimination, whose pivots' signs must be decided (Haynsworth's inertia additivity).

The count is a whole number that is right, or :class:`UndecidedError` is raised. Q falls as F falls, so critical loads
between two forces are exactly as many as the counts differ by: with counts n and n + 1 at the ends of an interval it
contains one critical load, the (n + 1)-th, and no other.
"""

from __future__ import annotations

from functools import lru_cache
from math import ceil, sqrt
from typing import Any, NamedTuple

from rodwell.errors import NotConvergedError

Ball = Any
"""A real number with a bound of its error: flint.arb."""

FREE = {"clamped": (), "pinned": (1,), "guided": (0,), "free": (0, 1)}
"""Of value (0) and slope (1) at an end, which are free."""

MOST_ELEMENTS, MOST_DIFFERENT = 3000, 300
"""Elements allowed: if all are alike, as in a horizontal cylinder; and otherwise. Some ten seconds a count."""

WAVES_PER_ELEMENT = 3.0
"""Element length times the largest wavenumber: below 2π, so that interiors are positive."""

TENSION_COUNTS = 16.0
"""Tension asks for elements longer by the root of this: interiors are positive anyway, and the series converge."""


class UndecidedError(Exception):
    """A sign could not be decided at this precision."""


class Inertia(NamedTuple):
    """Number of negative directions, and the determinant of the nodal form up to a positive factor."""

    negative: int
    determinant: Ball


class EnclosedRod(NamedTuple):
    """A straight rod under load, in balls.

    Attributes
    ----------
    force, axial, foundation
        F, wₐ and β = wₗ/Δ (negative for a rod on top).
    ends
        End conditions at s = 0 and s = 1, of which "clamped", "pinned", "guided" and "free" are known.
    """

    force: Ball
    axial: Ball
    foundation: Ball
    ends: tuple[str, str]


def inertia(rod: EnclosedRod, least: int = 0) -> Inertia:
    """Negative directions of Q: the critical loads above the rod's end force, each as often as it is multiple.

    Parameters
    ----------
    rod
        The rod under its load.
    least
        On at least so many elements. Determinants compare between loads only on as many elements.

    Raises
    ------
    UndecidedError
        If a sign cannot be decided: raise the precision, or move away from a critical load.
    NotConvergedError
        If the problem takes more than 3000 elements, 300 with axial weight.
    """
    force, axial, foundation, ends = rod
    count = max(elements(rod), least)
    _check_interiors(rod, count)
    whole = [(i, j, _part(i, j)) for i in range(4) for j in range(i, 4)]
    matrix = None
    above: list[list[Ball]] = []  # what the elements so far leave at the last node
    free: tuple[int, ...] = FREE[ends[0]]
    negative, determinant = 0, 1 + 0 * force
    for element in range(count):
        if matrix is None or not axial.is_zero():
            matrix = _element(force, axial, foundation, element, count)
        near, cross, far = ({}, {}, {})  # type: ignore[var-annotated]
        for i, j, part in whole:
            (near, cross, far)[part][i % 2, j % 2] = matrix[i, j]
        cross[1, 0] = matrix[1, 2]
        block = [[near[min(a, b), max(a, b)] + (above[a][b] if above else 0) for b in (0, 1)] for a in (0, 1)]
        found, factor, above = _eliminate(block, cross, far, free)
        negative, determinant = negative + found, determinant * factor
        free = (0, 1)
    last = FREE[ends[1]]
    found, factor = _signs([[above[a][b] for b in last] for a in last])
    return Inertia(negative + found, determinant * factor)


def _part(i: int, j: int) -> int:
    """Whether an entry of an element matrix belongs to its first node, to both, or to its last."""
    return i // 2 + j // 2


def elements(rod: EnclosedRod) -> int:
    """Number of elements that resolve the rod, and inside which Q should be positive."""
    top, bottom = float(rod.force), float(rod.force - rod.axial)
    tension = max(top, bottom) / TENSION_COUNTS
    size = max(-top, -bottom, tension, sqrt(float(abs(rod.foundation))), 1.0)
    count = ceil(sqrt(size) / WAVES_PER_ELEMENT)
    most = MOST_ELEMENTS if rod.axial.is_zero() else MOST_DIFFERENT
    if count > most:
        raise NotConvergedError(
            f"certified counts: {count} elements would be needed, and {most} are allowed: "
            "the rod is too long or too heavy for this method"
        )
    return count


def _check_interiors(rod: EnclosedRod, count: int) -> None:
    """Prove that Q is positive inside each of ``count`` elements."""
    wave = (rod.force.pi() * count) ** 2  # π²/h²
    slack = 4 * wave + rod.force.min(rod.force - rod.axial)
    if not (slack > 0 and slack * wave + rod.foundation > 0):
        raise UndecidedError("whether elements are short enough")


def _element(force: Ball, axial: Ball, foundation: Ball, index: int, count: int) -> Ball:
    """Symmetric matrix (4, 4) of Q on solutions of (64) in an element: value and slope at its first and last end."""
    from flint import arb, arb_mat  # noqa: PLC0415

    half = arb(1) / (2 * count)
    mean = force + axial * (arb(2 * index + 1) / (2 * count) - 1)
    values, forces = [], []
    for which in range(4):
        left, right = _solution(which, mean * half**2, axial * half**3, foundation * half**4)
        row: list[Ball] = []
        pull: list[Ball] = []
        for side, (y, y1, y2, y3) in ((-1, left), (1, right)):
            resultant = mean + side * axial * half
            shear = y3 / half**3 - resultant * y1 / half  # y''' − N y'
            row += [y, y1 / half]
            pull += [-side * shear, side * y2 / half**2]
        values.append(row)
        forces.append(pull)
    return arb_mat(values).solve(arb_mat(forces))


def _solution(which: int, n: Ball, w: Ball, b: Ball, cut: float | None = None) -> tuple[list[Ball], list[Ball]]:
    """Value and three derivatives in ξ at ξ = −1 and 1 of the solution of (64) in one element that starts as ξ^i/i!.

    With s = s_m + ξh/2 equation (64) is y⁗ = n y'' + w (ξy')' − b y; i is ``which``. So y = Σ uₖξᵏ/k!,
    cut where the bound of the rest falls below ``cut`` (2^(−precision) if not given), with

        uₖ₊₄ = n uₖ₊₂ + (k+1) w uₖ₊₁ − b uₖ.

    Tail. For eₖ = uₖ/k!, let q = (|n| + |w|)/((k+4)(k+3)) + |b|/((k+4)(k+3)(k+2)(k+1)), which falls with k, and m the
    largest of |eₖ| … |eₖ₊₃|. While q ≤ 1/4, each later coefficient is at most q times the largest of the four before it
    and so, by induction, the j-th block of four after these is at most qʲm. For k ≥ 15 and i in that block,
    i³ ≤ (k+3)³ exp(12j/(k+3)) ≤ (k+3)³ 2ʲ; so Σ i³|eᵢ| over all blocks is at most 4 m (k+3)³ · 2q/(1 − 2q), which also
    bounds what is cut off from y and its first two derivatives. (Instead of m the sum of the four is used.)
    """
    from flint import arb, arb_mat, ctx  # noqa: PLC0415

    zero = arb(0)
    u = [arb(1) if k == which else zero for k in range(4)]
    small = arb(2) ** (-ctx.prec) if cut is None else arb(cut)
    reach, stiff = n.abs_upper() + w.abs_upper(), b.abs_upper()
    k = 0
    while True:
        if k >= 16 and k % 8 == 0:
            q = reach / ((k + 4) * (k + 3)) + stiff / ((k + 4) * (k + 3) * (k + 2) * (k + 1))
            last = sum((abs(u[i]).upper() / arb.fac_ui(i) for i in range(k, k + 4)), zero)
            tail = (8 * last * (k + 3) ** 3 * q / (1 - 2 * q)).upper()
            if q < 0.25 and tail < small:
                break
        u.append(n * u[k + 2] + (k + 1) * w * u[k + 1] - b * u[k])
        k += 1
    table = arb_mat([u, [*u[1:], zero], [*u[2:], zero, zero], [*u[3:], zero, zero, zero]])
    sums = table * _factorials(len(u), ctx.prec)
    rest = arb(0, tail)
    return [sums[j, 0] + rest for j in range(4)], [sums[j, 1] + rest for j in range(4)]


@lru_cache(maxsize=64)
def _factorials(count: int, precision: int) -> Ball:
    """Columns (−1)ᵏ/k! and 1/k!, (count, 2), at the ``precision`` in bits that is set."""
    from flint import arb, arb_mat  # noqa: PLC0415

    del precision  # part of the key only
    inverse = [1 / arb.fac_ui(k) for k in range(count)]
    return arb_mat([[-x if k % 2 else x, x] for k, x in enumerate(inverse)])


def _eliminate(
    block: list[list[Ball]], cross: dict[tuple[int, int], Ball], far: dict[tuple[int, int], Ball], free: tuple[int, ...]
) -> tuple[int, Ball, list[list[Ball]]]:
    """Eliminate the free unknowns of a node: negative pivots, their product, and what is left at the next node."""
    after = [[far[min(a, b), max(a, b)] for b in (0, 1)] for a in (0, 1)]
    kept = [[block[a][b] for b in free] for a in free]
    negative, determinant = _signs(kept)
    if not free:
        return negative, determinant, after
    rows = [[cross[a, b] for b in (0, 1)] for a in free]
    solved = _solve(kept, determinant, rows)
    for a in (0, 1):
        for b in (0, 1):
            for row, entry in zip(rows, solved, strict=True):
                after[a][b] = after[a][b] - row[a] * entry[b]
    return negative, determinant, after


def _solve(matrix: list[list[Ball]], determinant: Ball, rows: list[list[Ball]]) -> list[list[Ball]]:
    """Inverse of a (1, 1) or (2, 2) matrix times rows."""
    if len(matrix) == 1:
        return [[entry / determinant for entry in rows[0]]]
    (a, b), (_, d) = matrix
    first, second = rows
    return [
        [(d * x - b * y) / determinant for x, y in zip(first, second, strict=True)],
        [(a * y - b * x) / determinant for x, y in zip(first, second, strict=True)],
    ]


def _signs(matrix: list[list[Ball]]) -> tuple[int, Ball]:
    """Number of negative eigenvalues of a symmetric matrix of size 0, 1 or 2, and its determinant."""
    if not matrix:
        return 0, 1
    if len(matrix) == 1:
        return int(_negative(matrix[0][0])), matrix[0][0]
    (a, b), (_, d) = matrix
    determinant = a * d - b * b
    if _negative(determinant):
        return 1, determinant
    return 2 * int(_negative(a)), determinant


def _negative(ball: Ball) -> bool:
    """Whether a number is negative, for certain."""
    if ball < 0:
        return True
    if ball > 0:
        return False
    raise UndecidedError("a pivot")
