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

The count is a whole number that is right, or :class:`Undecided` is raised. Q falls as F falls, so critical loads
between two forces are exactly as many as the counts differ by: with counts n and n + 1 at the ends of an interval it
contains one critical load, the (n + 1)-th, and no other.
"""

from __future__ import annotations

from math import ceil, sqrt
from typing import Any, NamedTuple

from rodwell.errors import NotConvergedError

Ball = Any
"""A real number with a bound of its error: flint.arb."""

FREE = {"clamped": (), "pinned": (1,), "guided": (0,), "free": (0, 1)}
"""Of value (0) and slope (1) at an end, which are free."""

MOST_ELEMENTS = 3000
WAVES_PER_ELEMENT = 3.0
"""Element length times the largest wavenumber: below 2π, so that interiors are positive."""


class Undecided(Exception):
    """A sign could not be decided at this precision."""


class Inertia(NamedTuple):
    """Number of negative directions, and the determinant of the nodal form up to a positive factor."""

    negative: int
    determinant: Ball


def inertia(force: Ball, axial: Ball, foundation: Ball, ends: tuple[str, str]) -> Inertia:
    """Negative directions of Q at an end force: the critical loads above it, each as often as it is multiple.

    Parameters
    ----------
    force, axial, foundation
        F, wₐ and β = wₗ/Δ (negative for a rod on top), balls.
    ends
        End conditions at s = 0 and s = 1, of which "clamped", "pinned", "guided" and "free" are known.

    Raises
    ------
    Undecided
        If a sign cannot be decided: raise the precision, or move away from a critical load.
    NotConvergedError
        If the problem takes more than 3000 elements.
    """
    count = _elements(force, axial, foundation)
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


def _elements(force: Ball, axial: Ball, foundation: Ball) -> int:
    """Number of elements, such that Q is proved positive inside each."""
    low = (force - axial).min(force)
    size = max(float(abs(force)), float(abs(force - axial)), sqrt(float(abs(foundation))), 1.0)
    count = ceil(sqrt(size) * (1.0 + 1e-9) / WAVES_PER_ELEMENT)
    if count > MOST_ELEMENTS:
        raise NotConvergedError(
            f"certified counts: {count} elements would be needed, and {MOST_ELEMENTS} are allowed: "
            "the rod is too long or too heavy for this method"
        )
    slack = 4 * force.pi() ** 2 * count**2 + low  # interiors: 4π²/h² + N
    if not (slack > 0 and slack * force.pi() ** 2 * count**2 + foundation > 0):
        raise Undecided("interiors of elements")
    return count


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


def _solution(which: int, n: Ball, w: Ball, b: Ball) -> tuple[list[Ball], list[Ball]]:
    """Value and three derivatives in ξ at ξ = −1 and 1 of the solution of (64) in one element that starts as ξ^which.

    With s = s_m + ξh/2 equation (64) is y⁗ = n y'' + w (ξy')' − b y, so y = Σ eₖξᵏ with

        (k+4)(k+3)(k+2)(k+1) eₖ₊₄ = n (k+2)(k+1) eₖ₊₂ + w (k+1)² eₖ₊₁ − b eₖ.

    Tail. Let q = (|n| + |w|)/((k+4)(k+3)) + |b|/((k+4)(k+3)(k+2)(k+1)), which falls with k, and m the largest of
    |eₖ| … |eₖ₊₃|. While q ≤ 1/4, each later coefficient is at most q times the largest of the four before it and so,
    by induction, the j-th block of four after these is at most qʲm. For k ≥ 15 and i in that block,
    i³ ≤ (k+3)³ exp(12j/(k+3)) ≤ (k+3)³ 2ʲ; so Σ i³|eᵢ| over all blocks is at most 4 m (k+3)³ · 2q/(1 − 2q), which also
    bounds what is cut off from y and its first two derivatives.
    """
    from flint import arb, arb_poly, ctx  # noqa: PLC0415

    coefficients = [arb(int(k == which)) for k in range(4)]
    small = arb(2) ** (-ctx.prec)
    reach, stiff = n.abs_upper() + w.abs_upper(), b.abs_upper()
    k = 0
    while True:
        if k >= 16 and k % 4 == 0:
            q = reach / ((k + 4) * (k + 3)) + stiff / ((k + 4) * (k + 3) * (k + 2) * (k + 1))
            largest = max((abs(e).upper() for e in coefficients[-4:]), key=float)
            tail = 8 * sum((abs(e).upper() for e in coefficients[-4:]), arb(0)) * (k + 3) ** 3 * q / (1 - 2 * q)
            if q < 0.25 and tail < small:
                break
            del largest
        new = (n * ((k + 2) * (k + 1)) * coefficients[k + 2] + w * (k + 1) ** 2 * coefficients[k + 1]
               - b * coefficients[k])  # fmt: skip
        coefficients.append(new / ((k + 4) * (k + 3) * (k + 2) * (k + 1)))
        k += 1
    rest = arb(0, tail.upper())
    polynomial = arb_poly(coefficients)
    ends: tuple[list[Ball], list[Ball]] = ([], [])
    for _ in range(4):
        for side, out in zip((-1, 1), ends, strict=True):
            out.append(polynomial(arb(side)) + rest)
        polynomial = polynomial.derivative()
    return ends


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
    raise Undecided("a pivot")
