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

from rodwell.compiling.cache import keep

OPTIONS: dict[str, Any] = {"error_model": "numpy", "no_cfunc_wrapper": True}
"""Options of all. There is no entry for C: nobody calls from there, and it is a tenth of what would be compiled."""


def kernel(function: Callable[..., Any] | None = None, **options: Any) -> Any:
    """Compile ``function`` with Numba and keep the machine code on disk for the next start.

    ``options`` are those of ``numba.njit``.

    Where it cannot be kept (a full disk, a read-only installation without a home folder), the function is compiled
    anew in each process instead: see :mod:`rodwell.compiling.cache`.
    """
    if function is None:
        return partial(kernel, **options)
    return keep(numba.njit(**OPTIONS, **options)(function))


def formula(function: Callable[..., Any] | None = None, **options: Any) -> Any:
    """Mark a part of kernels that is compiled into what calls it; Python can call it as it stands.

    ``options`` are those of ``numba.njit``. What depends on the *model* must be marked so: a kernel of its own
    would put machine code for every model on disk, and could not be read where that model is unknown.
    """
    if function is None:
        return partial(formula, **options)
    return register_jitable(**OPTIONS, forceinline=True, **options)(function)


def inlined(function: Callable[..., Any]) -> Any:
    """Mark a part of one kernel that is written into it, as if it stood there; Python can call it as it stands.

    What a kernel calls is compiled, optimised and made machine code by itself, and then once more as a part of the
    kernel, and a record of arrays takes a hundred instructions to hand over. So what is called at one place only, and
    stands apart so that people can read it, is marked so.
    """
    return numba.njit(**OPTIONS, inline="always")(function)


def direct(kernel: Any) -> Callable[..., Any]:
    """Return a call of a kernel on a mesh that leaves out Numba's look-up of types: it takes as long as a short kernel.

    The first argument is a record with a ``model`` and two tuples, ``local`` and ``per_element``: for each type of it
    the types of the other arguments are the same at every call, and arrays contiguous: nobody looks at them again.
    """
    if not hasattr(kernel, "overloads"):  # NUMBA_DISABLE_JIT: a plain function
        return kernel  # type: ignore[no-any-return]
    entries: dict[tuple[type, int, int], Callable[..., Any]] = {}

    def call(mesh: Any, *arguments: Any) -> Any:
        key = type(mesh.model), len(mesh.local), len(mesh.per_element)
        entry = entries.get(key)
        if entry is not None:
            return entry(mesh, *arguments)
        result = kernel(mesh, *arguments)  # compiled, or read from the disk
        signature = tuple(kernel.typeof_pyval(argument) for argument in (mesh, *arguments))
        entries[key] = kernel.overloads[signature].entry_point
        return result

    return call
