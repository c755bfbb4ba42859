"""What a clearance that varies along the rod must be: in steps, which the string bridges, or once smooth, in ramps."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.errors import InputError
from rodwell.problem.profile import Profile
from rodwell.problem.rod import Rod
from rodwell.quantities.arrays import BoolArray

SMOOTH = 1e-6
"""Jumps of a derivative are round-off below this part of what the clearance varies by in a section beside, over its
length to the power of the order."""

LEAST = 1e-7
"""What a clearance varies by at least, as a part of it, where jumps are judged: fifteen digits tell no less."""

ALL_SMOOTH = (
    "rodwell.ramp, a~b in --sections and diameter_at_top of [[hole.section]] make four sections that go over smoothly"
)


def _jumps(profile: Profile, order: int) -> BoolArray:
    """At which ends of sections, (n − 1,), a derivative of this order has a jump that is more than round-off."""
    places, lengths, pieces = np.linspace(0.0, 1.0, 9), np.diff(profile.breaks), np.arange(profile.breaks.size - 1)
    values = np.array([profile.in_pieces(profile.breaks[:-1] + x * lengths, pieces) for x in places])
    size = (np.ptp(values, axis=0) + LEAST * np.max(np.abs(values), axis=0)) / lengths**order
    for _ in range(order):
        profile = profile.derivative
    before, after = profile.sides
    return np.asarray(np.abs(after - before) > SMOOTH * np.maximum(size[:-1], size[1:]))


def check_ramps(problem: Any) -> None:
    """Refuse a clearance that varies along sections and has steps or kinks, and what goes with a constant one only.

    Raises
    ------
    InputError
        With the place.
    """
    rod: Rod = problem.rod
    for order, what in enumerate(("a step", "a kink")):
        found = _jumps(rod.clearance, order)
        if np.any(found):
            place = float(rod.breaks[1:-1][found][0])
            raise InputError(
                "sections, clearance", f"{what} at s/L = {place:.6g}", "must go over without steps and kinks where it "
                f"varies along sections: the string bridges them. {ALL_SMOOTH}; steps alone, between sections of one "
                "clearance each, have load paths",
            )  # fmt: skip
    problem.refuse_curved("clearances that vary along sections are computed")
    if problem.turns != 0:
        what = "must be 0 where the clearance varies along sections: coils are computed in holes of one clearance"
        raise InputError("turns", problem.turns, what)


def refuse_clearances(problem: Any, what: str) -> None:
    """Raise where the clearance has steps or varies: ``what`` are computed of rods on a wall of one clearance."""
    if problem.ramps:
        raise InputError(
            "sections", "clearance that varies along them", f"must have one clearance: {what} are computed in holes of "
            "one. Where it goes over smoothly there are critical loads and load paths: `rodwell critical`, "
            "`rodwell path`, rodwell.critical_loads, rodwell.load_path",
        )  # fmt: skip
    refuse_bridging(problem, what)


def refuse_bridging(problem: Any, what: str) -> None:
    """Raise where a string leaves the wall by itself: ``what`` are computed of rods that stay on the wall."""
    if not problem.bridges:
        return
    floats = not problem.rod.clearance_steps.size
    ratios = " + ".join(f"{section[2]}" if floats else f"{section[3]:g}" for section in problem.sections[:6])
    value = f"{'weight' if floats else 'clearance'} ratios {ratios}" + (" + …" if len(problem.sections) > 6 else "")
    if floats:
        allowed = "must all sink or all float"
        why = "where a string begins to float it leaves one side of the hole for the other"
    else:
        allowed = "must have one clearance"
        why = "a string bridges steps of the clearance, off the wall"
    raise InputError(
        "sections", value,
        f"{allowed}: {what} are those of a rod that stays on the wall, and {why}. How it lies there, and when it "
        "buckles: `rodwell run` of a case; `rodwell path`, `rodwell critical`, rodwell.load_path",
    )  # fmt: skip
