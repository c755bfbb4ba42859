"""Error estimates from two nested meshes."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.compiling.kernels import formula

CLAIMED_GAIN = 8.0
"""By how much halving the elements is taken to reduce an error. The slowest number reported, the contact
pressure at degree 9, gains 2⁷; where the gain is not seen (round-off), the point counts as not converged."""


NUMBER_NOISE = 5e-13
"""Error that round-off leaves in a number even where both meshes agree, relative to its scale."""


@formula
def larger(a: Any, b: Any) -> Any:
    """The larger of two numbers; none if one of them is none."""
    return b if b > a or np.isnan(b) else a


@formula
def estimated_error(fine: Any, coarse: Any) -> Any:
    """Error estimate of numbers known on both meshes, arrays or single ones."""
    return np.abs(fine - coarse) / CLAIMED_GAIN + NUMBER_NOISE * np.abs(fine)
