"""Axes in the reader's units: a factor and a label for each quantity."""

from __future__ import annotations

import numpy as np

from rodwell.quantities.names import QUANTITIES, UNITS
from rodwell.quantities.scales import Scales

_PRETTY = {"B/L^2": "B/L²", "B/L^3": "B/L³", "1/L": "1/L", "B/L": "B/L", "L": "L", "rad": "rad", "1": ""}


def axis(name: str, scales: Scales | None, largest: float) -> tuple[float, str]:
    """Return the factor from units B = L = 1 and the unit's text for an axis on which ``largest`` is the largest."""
    if scales is None:
        return 1.0, _PRETTY[UNITS[QUANTITIES[name].dimension]]
    dimension = QUANTITIES[name].dimension
    factor = scales.factor(dimension)
    unit, text = scales.system.unit(dimension, float(np.abs(largest)) * factor)
    return factor / unit, text
