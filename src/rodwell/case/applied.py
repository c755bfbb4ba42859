"""The loads that act, as a case file gives them: where they are measured, and what they are."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class AppliedLoad:
    """A load of ``load.applied``.

    Attributes
    ----------
    force
        Effective end force at s = 1 in B/L², tension positive.
    given
        The number that was given, in N (or in B/L² for a case without dimensions).
    bottom
        Whether it is measured at the lower end, s = 0.
    real
        Whether it is the real force in the wall of the pipe, not the effective one.
    """

    force: float
    given: float
    bottom: bool = False
    real: bool = False
