"""What came of a solve."""

from __future__ import annotations

from enum import Enum


class Outcome(Enum):
    """What came of a solve; the value says what to do about it."""

    CONVERGED = "converged"
    NOT_CONVERGED = "Newton's method did not settle: start nearer, or take a smaller step"
    DIVERGED = "Newton's method diverged: start nearer, or take a smaller step"
    OUT_OF_RANGE = "the state left the range of the model"


OUTCOMES = (Outcome.CONVERGED, Outcome.NOT_CONVERGED, Outcome.DIVERGED, Outcome.OUT_OF_RANGE)
"""In the order of the numbers by which compiled loops (:mod:`rodwell.numerics.equilibria.newton`) know them."""
