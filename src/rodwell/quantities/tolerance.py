"""Tolerances and forces that may be asked for."""

from __future__ import annotations

from rodwell.errors import checked_number

RTOL = 1e-8
"""Default relative tolerance of every reported number."""


LOWEST_RTOL, HIGHEST_RTOL = 1e-11, 1e-2


LARGEST_FORCE = 1e9
"""Largest end force, in B/L², that may be asked for."""


def checked_rtol(rtol: float) -> float:
    """Return a tolerance that double precision can meet, or raise."""
    allowed = f"from {LOWEST_RTOL:g} (what double precision allows) to {HIGHEST_RTOL:g}"
    return checked_number("rtol", rtol, LOWEST_RTOL, HIGHEST_RTOL, allowed)


def checked_force(field: str, value: object) -> float:
    """Return an end force that can be asked for, or raise."""
    allowed = f"a finite end force in B/L², tension positive, of at most {LARGEST_FORCE:g} either way"
    return checked_number(field, value, -LARGEST_FORCE, LARGEST_FORCE, allowed)
