"""End conditions: which there are, and how they are read."""

from __future__ import annotations

from rodwell.errors import InputError

ENDS = ("clamped", "pinned", "guided", "free")
"""End conditions of a rod on the wall: y and y' held, y held, y' held, none held. All hold the end at its distance from
the axis of the cylinder, and parallel to the wall as seen from the side: fittings like a hinge with a radial pin, or a
collar (radially held)."""

OFF_WALL_ENDS = ("ball", "loose")
"""Ends that can turn, or move, in both directions: a ball joint holds x and y, a loose end nothing. A buckled rod
leaves the wall there at once, so beyond critical loads they make no sense for a rod that is kept on it."""

KNOWN = ENDS + OFF_WALL_ENDS

HOLD_ANGLE = ("clamped", "pinned", "ball")
"""End conditions that hold y."""

HOLDS_SLOPE = ("clamped", "guided")
"""End conditions that hold the slope y', and so bend the rod: at others ω₂ vanishes."""

WITH_Y_HELD = {"guided": "clamped", "free": "pinned", "loose": "ball"}
"""The others, each with the one that holds y besides: what picks one of the equal states of a rod that can be turned
around the cylinder as a whole."""


def checked_ends(ends: object) -> tuple[str, str]:
    """Return the end conditions at s = 0 and s = 1 from a pair or a text like "clamped-pinned", or raise."""
    parts = tuple(ends.split("-")) if isinstance(ends, str) else ends
    if isinstance(parts, list | tuple) and len(parts) == 2 and parts[0] in KNOWN and parts[1] in KNOWN:
        return str(parts[0]), str(parts[1])
    raise InputError(
        "ends",
        ends,
        f"must be two of {', '.join(ENDS)} (or, for critical loads and load paths, {', '.join(OFF_WALL_ENDS)}), "
        "that at s = 0 first: for example clamped-pinned",
    )


def refuse_off_wall(ends: tuple[str, str], what: str) -> None:
    """Raise if an end of a rod that is to stay on the wall cannot: ``what`` needs such a rod."""
    loose = [end for end in ends if end in OFF_WALL_ENDS]
    if loose:
        raise InputError(
            "ends",
            "-".join(ends),
            f"the buckled rod leaves the wall at a {loose[0]} end, and {what} are those of a rod kept on it: "
            "ask for critical loads, or for pinned (ball) and free (loose) ends",
        )
