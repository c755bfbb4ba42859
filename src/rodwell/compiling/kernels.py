"""How kernels are compiled.

``numerics`` knows no rod and ``physics`` knows no solver: compiled numerics works on a *model*, a named tuple whose
class gives the formulas (:mod:`rodwell.numerics.splines.assembly`) and selects them at compile time.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numba
from numba.extending import register_jitable


def kernel(function: Callable[..., Any] | None = None, **options: Any) -> Any:
    """Compile ``function`` with Numba and keep the machine code on disk for the next start.

    ``options`` are those of ``numba.njit``.

    Where no folder for the cache can be written (a read-only installation without a home folder), the
    function is compiled anew in each process instead.
    """
    if function is None:
        return partial(kernel, **options)
    try:
        return numba.njit(cache=True, error_model="numpy", **options)(function)
    except RuntimeError:  # Numba: "no locator available"
        return numba.njit(error_model="numpy", **options)(function)


def formula(function: Callable[..., Any] | None = None, **options: Any) -> Any:
    """Mark a part of kernels that is compiled into what calls it; Python can call it as it stands.

    ``options`` are those of ``numba.njit``. What depends on the *model* must be marked so: a kernel of its own
    would put machine code for every model on disk, and could not be read where that model is unknown.
    """
    if function is None:
        return partial(formula, **options)
    return register_jitable(error_model="numpy", forceinline=True, **options)(function)
