"""End conditions: which there are, and how they are read."""

from __future__ import annotations

from rodwell.errors import InputError

ENDS = ("clamped", "pinned", "guided", "free")
"""End conditions: y and y' held, y held, y' held, none held."""


HOLD_ANGLE = ("clamped", "pinned")
"""End conditions that hold y."""


def checked_ends(ends: object) -> tuple[str, str]:
    """Return the end conditions at s = 0 and s = 1 from a pair or a text like "clamped-pinned", or raise."""
    parts = tuple(ends.split("-")) if isinstance(ends, str) else ends
    if isinstance(parts, list | tuple) and len(parts) == 2 and all(part in ENDS for part in parts):
        return str(parts[0]), str(parts[1])
    raise InputError("ends", ends, f"must be two of {', '.join(ENDS)}, that at s = 0 first: for example clamped-pinned")
