"""States that are made of equal cells: a symmetry that the rod as a whole does not show.

Where the density does not depend on s, and each end is a place about which a reflection u(p + x) → ± u(p − x) makes
solutions of solutions, as the end conditions demand it of the state, every state goes on beyond its ends as a periodic
one. It may be symmetric about a place inside as well: the rod is then a row of cells, each the mirror image of the
next. What branches off may break that, so the equations allow branch points that no reflection of the whole rod
explains. See J. D. Crawford, M. Golubitsky, M. G. M. Gomes, E. Knobloch, I. Stewart, in *Singularity Theory and its
Applications* II, Springer LNM 1463 (1991) 63–79.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rodwell.numerics.equilibria.state import EQUAL_COEFFICIENTS, SYMMETRIC, State
from rodwell.quantities.arrays import FloatArray

CELLS = (2, 3, 4, 5, 7, 8, 9, 11, 13, 16, 17, 19, 23, 25, 27, 29, 31)
"""Numbers of cells that are looked for, powers of primes: what leaves a row of twelve may keep six, but then it has no
four; or it may keep four, but then it has no three."""

BROKEN = 0.5
"""Part of a null vector by which it may differ from its image and count as symmetric: that of a symmetric state is
wholly one or the other."""

PLACES = 12
"""Places in a cell at which a state is compared with its image."""


def branches_between(before: State, after: State, signs: Sequence[int], vector: FloatArray | None) -> bool:
    """Whether two states are rows of equally many cells by one of the ``signs``, and ``vector`` (n,) is not.

    Without a vector the states alone decide. A vector of nearly as many waves as the state is nearly its own image
    about the end of the first cell: what tells it is the end of another.
    """
    return any(
        _is_reflected(before, before.c, count, 1, sign, SYMMETRIC)
        and _is_reflected(after, after.c, count, 1, sign, SYMMETRIC)
        and (vector is None or _is_broken(before, vector, count, signs))
        for count in (CELLS if signs else ())
        for sign in signs
    )


def _is_broken(state: State, vector: FloatArray, count: int, signs: Sequence[int]) -> bool:
    """Whether a vector is not its image about the ends of all ``count`` cells, by the signs of the state there."""
    return any(
        _is_reflected(state, state.c, count, cell, sign, SYMMETRIC)
        and not _is_reflected(state, vector, count, cell, sign, BROKEN)
        for cell in range(1, count)
        for sign in signs
    )


def breaks(vector: FloatArray, parity: int) -> bool:
    """Whether a vector (n,) has the other parity about the middle."""
    lost = 0.5 * (vector - parity * vector[::-1])
    return bool(np.max(np.abs(lost)) > BROKEN * np.max(np.abs(vector)))


def _is_reflected(state: State, c: FloatArray, count: int, cell: int, sign: int, tolerance: float) -> bool:
    """Whether a function with coefficients ``c`` (n,) is ± its image about the end of one of ``count`` cells."""
    x, end = np.linspace(0.0, 1.0 / count, PLACES), cell / count
    after, before = (state.space.evaluate(c, np.clip(end + way * x, 0.0, 1.0), 1)[0] for way in (1.0, -1.0))
    size = tolerance * float(np.max(np.abs(c))) + EQUAL_COEFFICIENTS
    return bool(np.max(np.abs(after - sign * before)) <= size)
