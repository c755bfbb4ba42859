"""How kernels are compiled, and the functions through which numerics and physics meet.

``numerics`` knows no rod and ``physics`` knows no solver: compiled numerics calls the functions below on a
*model*, a named tuple whose type selects the implementation at compile time, with one entry for each field. A model
comes with ``@numba.extending.overload(density)`` and, where contact is looked at, ``@overload(contact)``.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numba
from numba.extending import register_jitable


def kernel(function: Callable[..., Any] | None = None, **options: Any) -> Any:
    """Compile ``function`` with Numba and keep the machine code on disk for the next start.

    ``options`` are those of ``numba.njit``. The density at one place asks for ``forceinline=True``: the reference
    counts of its arrays, which inlining spares, took longer than its arithmetic.

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
    """Mark a plain formula: Python and NumPy call it as it stands, compiled code compiles it into what calls it.

    ``options`` are those of ``numba.njit``. A part of a kernel that depends on the *model* must be a formula too: a
    kernel of its own would put machine code for every model on disk, and could not be read where that model is unknown.
    """
    if function is None:
        return partial(formula, **options)
    return register_jitable(error_model="numpy", forceinline=True, **options)(function)


def density(model, s, u, parameters, rates, gradient, hessian, mixed):  # type: ignore[no-untyped-def]
    """Energy density of ``model`` and its derivatives at one place ``s``; returns energy and rate per length.

    ``u`` (3 nf,) holds field f, derivative d at index ``3 f + d``, and may be changed. Written: ``gradient`` (3 nf,),
    ``hessian`` (3 nf, 3 nf) and ``mixed`` (3 nf,), the derivative of the gradient along ``rates``, a direction in the
    space of the ``parameters``. The rate is that derivative of the energy.
    """
    raise NotImplementedError("density is implemented per model, by numba.extending.overload")


def contact(model, s, u, parameters):  # type: ignore[no-untyped-def]
    """Contact pressure of ``model`` at one place from ``u``, the fields and three derivatives."""
    raise NotImplementedError("contact is implemented per model, by numba.extending.overload")
