"""What a density of a rod off the wall changes by along s, by its model and by differences."""

from __future__ import annotations

from typing import Any

import numpy as np


def drift_and_differences(model: Any, fields: int, given: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The derivative of a gradient by s on the wall (1 field) or off it (2), with slope and twist: both ways."""
    density = model.rim if fields == 1 else model.interior
    s, u = np.array([[0.41, 0.6]]), 0.3 * np.random.default_rng(1).standard_normal((fields, 3, 1, 2))
    h, mixed = 1e-5, density(s, u, -50.0, given)[3]
    known = (density(s + h, u, -50.0, given)[2] - density(s - h, u, -50.0, given)[2]) / (2.0 * h)
    return model.drift(s, u, -50.0, mixed, given), known
