"""What the second process of a first run compiles: see :mod:`rodwell.compiling.second_process`.

``python -m rodwell.analysis.ahead`` compiles the kernels below in the order in which a branch needs them.
"""

from __future__ import annotations

from typing import Any

import numba
from numba import types

from rodwell.analysis.accuracy import DEGREE, POINTS_OF_BRANCH
from rodwell.compiling import second_process
from rodwell.compiling.cache import on_disk
from rodwell.numerics.corrector import correct
from rodwell.numerics.extrema import contact_maxima
from rodwell.numerics.watch import softest
from rodwell.physics.model import RodOnCylinder

_VECTOR = types.Array(types.float64, 1, "C")
_MATRIX = types.Array(types.float64, 2, "C")
_TABLE = types.Array(types.float64, 3, "C")
_MODEL: Any = numba.typeof(RodOnCylinder())  # type: ignore[no-untyped-call]
_TAGS: Any = types.Tuple(  # type: ignore[no-untyped-call]
    [types.UniTuple(types.int64, DEGREE + 1), types.UniTuple(types.int64, POINTS_OF_BRANCH)]  # type: ignore[no-untyped-call]
)
_FREE = (types.int64, types.int64, types.boolean, types.boolean)  # first, last, tied_first, tied_last

KERNELS: tuple[tuple[Any, tuple[Any, ...]], ...] = (
    (contact_maxima, (_MODEL, _TAGS[0], _VECTOR, _VECTOR, _TABLE, _VECTOR, _VECTOR, types.float64)),
    (
        correct,
        (
            *(_MODEL, _TAGS, _TABLE, _VECTOR, _VECTOR, _MATRIX, *_FREE, types.int64),  # ... weights, gram, free, parity
            *(_VECTOR, _VECTOR, _VECTOR, types.float64, _MATRIX, _VECTOR, types.float64, types.float64),  # ... target
            *[types.float64] * 4,  # scales, tolerance
            *(types.int64, types.int64, _VECTOR, _VECTOR),  # ... tangent, its covector
        ),
    ),
    (softest, (_MATRIX, *_FREE, _MATRIX, types.boolean, types.int64, _MATRIX)),
)
"""Kernels and the types of their arguments: the only ones with which they are called."""


def done() -> bool:
    """Whether an earlier run has compiled; the largest kernel tells."""
    return on_disk(*KERNELS[1])


def begin() -> None:
    """Start the second process, on the first run."""
    if correct.stats.cache_path is not None and not done():
        second_process.begin(__name__)


def main() -> None:
    """Compile, and print the name of each kernel that is done; end where none reaches the disk."""
    for kernel, arguments in KERNELS:
        kernel.compile(arguments)
        if not on_disk(kernel, arguments):  # a full disk: nobody should wait for more
            return
        print(kernel.py_func.__name__, flush=True)  # read by the first process


if __name__ == "__main__":
    main()
