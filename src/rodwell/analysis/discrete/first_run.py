"""What the second process of a first run compiles: see :mod:`rodwell.compiling.second_process`.

``python -m rodwell.analysis.discrete.first_run`` compiles the kernels below in the order in which a branch needs them:
what takes longest, with all that it calls.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numba
import numpy as np
from numba import types

from rodwell.analysis.discrete.choices import DEGREE, POINTS_OF_BRANCH
from rodwell.analysis.discrete.measures import state_numbers
from rodwell.compiling import second_process
from rodwell.compiling.cache import on_disk
from rodwell.numerics.continuation.prediction import expected
from rodwell.numerics.continuation.softest import softest
from rodwell.numerics.equilibria.newton import Tolerances, inverse_iteration, newton
from rodwell.numerics.splines.assembly import variation
from rodwell.numerics.splines.records import Discretisation
from rodwell.physics.on_wall.model import RodOnCylinder
from rodwell.problem.problem import Problem

_VECTOR = types.Array(types.float64, 1, "C")
_POSITIONS = types.Array(types.int64, 1, "C")
_MATRIX = types.Array(types.float64, 2, "C")
_TABLE = types.Array(types.float64, 3, "C")
_TABLES = types.Tuple((_VECTOR, _POSITIONS, _VECTOR, _TABLE, _TABLE))  # type: ignore[no-untyped-call]


def _typical() -> tuple[Discretisation, Tolerances]:
    """Records like those of every branch, of a rod without elements: their types count only."""
    none = np.empty(0)
    tags = (0,) * (DEGREE + 1), (0,) * POINTS_OF_BRANCH
    positions = np.empty(0, dtype=np.int64)
    mesh = Discretisation(
        RodOnCylinder(), *tags, np.empty((0, 3, DEGREE + 1)), none, none, np.empty((0, DEGREE + 1)),
        positions, positions, positions, np.empty((0, 0)), 0,
    )  # fmt: skip
    return mesh, Tolerances(0.0, 0, 0, 1.0, 1.0, 1.0)


_MESH, _TOLERANCES = (numba.typeof(record) for record in _typical())  # type: ignore[no-untyped-call]

KERNELS: tuple[tuple[Any, tuple[Any, ...]], ...] = (
    (
        state_numbers,
        (
            *(_MESH, _VECTOR, _TABLE, _POSITIONS, _TABLES, types.int64),  # landmarks, marks, tables
            *(_VECTOR, _VECTOR, types.float64, _VECTOR, _VECTOR, types.float64),  # c … energy, places, sizes, lowest
        ),
    ),
    (
        newton,
        (
            *(_MESH, _TOLERANCES, _MATRIX, _VECTOR, types.float64, types.float64),  # path, row, row_lam, target
            *(_VECTOR, _VECTOR, _VECTOR, types.float64, _VECTOR, _VECTOR),  # frozen, covector, c, lam, tangent, new_row
        ),
    ),
    (variation, (_MESH, _VECTOR, _VECTOR, _VECTOR, _VECTOR)),  # c, parameters, rates, v
)
"""Kernels that the second process compiles, and types of their arguments: the only ones with which they are called."""

MEANWHILE: tuple[tuple[Any, tuple[Any, ...]], ...] = (
    (softest, (_MATRIX, _POSITIONS, _POSITIONS, _MATRIX, types.boolean, types.int64, _MATRIX)),
    (inverse_iteration, (_MATRIX, _POSITIONS, _POSITIONS, _MATRIX, types.int64, _VECTOR)),
    (expected, (_VECTOR, _VECTOR, _MATRIX, _VECTOR, types.float64, types.float64)),
)
"""The same of those that every branch needs soon after them: the first process compiles these while it waits."""


def done() -> bool:
    """Whether an earlier run has compiled; the largest kernel tells."""
    return on_disk(*KERNELS[1])


def begin(problem: Problem | None = None) -> None:
    """Start the second process, on the first run; where the largest kernel is at hand already, nothing is asked.

    Kernels of a string of sections, and of a curved hole, are compiled as they are needed: most rods are uniform.
    """
    if problem is not None and (problem.sections or problem.hole is not None):
        return
    if not hasattr(newton, "overloads"):  # NUMBA_DISABLE_JIT: a plain function
        return
    if not newton.overloads and newton.stats.cache_path is not None and not done():
        second_process.begin(__name__, [partial(kernel.compile, arguments) for kernel, arguments in MEANWHILE])


def main() -> None:
    """Compile, and print the name of each kernel that is done; end where none reaches the disk."""
    for kernel, arguments in KERNELS:
        kernel.compile(arguments)
        if not on_disk(kernel, arguments):  # a full disk: nobody should wait for more
            return
        print(kernel.py_func.__name__, flush=True)  # read by the first process


if __name__ == "__main__":
    main()
