"""A model on a space, with nothing held, as compiled loops take it; models of the tests are kept off the disk."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numba.core.caching import NullCache

from rodwell.numerics.equilibria.maxima import maxima
from rodwell.numerics.equilibria.newton import newton
from rodwell.numerics.splines.assembly import assemble, variation
from rodwell.numerics.splines.records import Discretisation
from rodwell.numerics.splines.spaces import SplineSpace


def discretised(model: Any, space: SplineSpace) -> Discretisation:
    quadrature = space.table, space.points, space.weights, space.slope_gram
    nothing = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    return Discretisation(model, *space.tags, *quadrature, *nothing, space.starts, np.empty((space.points.size, 0)), 0)


OF_MODELS = (assemble, variation, newton, maxima)
"""The kernels that are compiled for each model."""


@contextmanager
def nothing_on_disk() -> Iterator[None]:
    """Keep machine code for models of a test off the disk: an index that names them can be read by that test alone."""
    kernels = [kernel for kernel in OF_MODELS if hasattr(kernel, "_cache")]  # NUMBA_DISABLE_JIT: plain functions
    caches = [kernel._cache for kernel in kernels]
    for kernel in kernels:
        kernel._cache = NullCache()
    yield
    for kernel, cache in zip(kernels, caches, strict=True):
        kernel._cache = cache
