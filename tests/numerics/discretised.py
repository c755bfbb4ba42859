"""A model on a space, with nothing held: what compiled loops take."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.numerics.splines.records import Discretisation
from rodwell.numerics.splines.spaces import SplineSpace


def discretised(model: Any, space: SplineSpace) -> Discretisation:
    n = space.size * len(model)
    quadrature = space.table, space.points, space.weights, space.slope_gram
    nothing = np.zeros(n, dtype=np.bool_), np.arange(n, dtype=np.int64)
    return Discretisation(model, *space.tags, *quadrature, *nothing, space.starts, np.empty((space.points.size, 0)), 0)
