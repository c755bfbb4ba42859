"""What two nested meshes tell of a number: its value, and how far it is known."""

from __future__ import annotations

from rodwell.numerics.equilibria.error import estimated_error
from rodwell.quantities.value import Peak, Value


def compared(coarse: float, fine: float) -> Value:
    """The number of the fine mesh, with the error that its difference from the coarse one tells."""
    return Value(fine, float(estimated_error(fine, coarse)))


def compared_peaks(coarse: tuple[float, float], fine: tuple[float, float]) -> Peak:
    """The same for a largest value and its place on each mesh."""
    value, error = compared(coarse[0], fine[0])
    return Peak(value, error, fine[1])
