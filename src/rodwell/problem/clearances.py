"""What a clearance that varies along the rod must be: in steps, which the string bridges, or once smooth, in ramps."""

from __future__ import annotations

from typing import Any

import numpy as np

from rodwell.errors import InputError
from rodwell.problem.profile import Profile
from rodwell.problem.rod import Rod
from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray

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


def _derivatives(profile: Profile, orders: int, places: FloatArray, piece: IntArray) -> list[FloatArray]:
    """A profile and its derivatives in pieces (m,), ``orders`` of them, (m,) each."""
    out = []
    for _ in range(orders):
        out.append(profile.in_pieces(places, piece))
        profile = profile.derivative
    return out


def check_lies(problem: Any) -> None:
    """Refuse what is not computed where the clearance varies, and a wall that would have to pull at a single place.

    Raises
    ------
    InputError
        Naming the place.
    """
    if problem.twist != 0.0:
        what = "must be 0 where the clearance varies: a torque pushes a rod sideways that the wall bends, by T₁Δ‴ per "
        raise InputError("twist", problem.twist, what + "length, so that it lies on no straight generator")
    for order, (sides, what) in enumerate(
        zip(_moments(problem.rod), ("a couple", "a force at one place"), strict=True)
    ):
        found = np.abs(sides[1] - sides[0]) > SMOOTH * _beside(problem.rod, 2 + order)
        if np.any(found):
            name, place = ("BΔ″", "(BΔ″)′")[order], float(problem.rod.breaks[1:-1][found][0])
            raise InputError(
                "sections, clearance", f"{name} jumps at s/L = {place:.6g}",
                f"makes the wall exert {what} there, which is not computed: the wall would have to pull the rod there "
                f"or beside it, and the string bridges it. Let {name} go on smoothly. {ALL_SMOOTH}, with a stiffness "
                "that goes on smoothly too",
            )  # fmt: skip
    _check_ends(problem)


def _moments(rod: Rod) -> tuple[FloatArray, FloatArray]:
    """BΔ″ and its derivative on both sides of ends of sections, over the problem's B and Δ, (2, n − 1) each."""
    steps, piece = rod.breaks[1:-1], np.arange(rod.breaks.size - 2)
    out = []
    for side in (piece, piece + 1):
        b, b1 = _derivatives(rod.stiffness, 2, steps, side)
        _, _, d2, d3 = _derivatives(rod.clearance, 4, steps, side)
        out.append((b * d2, b1 * d2 + b * d3))
    return np.array([one[0] for one in out]), np.array([one[1] for one in out])


def _beside(rod: Rod, order: int) -> FloatArray:
    """The size that BΔ and derivatives of this order have beside ends of sections, (n − 1,)."""
    least, most = rod.ranges["clearance"]
    size = rod.ranges["stiffness"][1] * (most - least + LEAST * most) / np.diff(rod.breaks) ** order
    return np.asarray(np.maximum(size[:-1], size[1:]))


def _check_ends(problem: Any) -> None:
    """Refuse ends that would have to hold more of the rod than they do where the wall is inclined or curved."""
    rod, ends, pieces = problem.rod, np.array([0.0, 1.0]), np.array([0, problem.rod.breaks.size - 2])
    derivatives = np.abs(_derivatives(rod.clearance, 4, ends, pieces)[1:])  # (3, 2)
    least, most = rod.ranges["clearance"][:, pieces]
    size = most - least + LEAST * most
    lengths = np.diff(rod.breaks)[pieces]
    vanish = derivatives <= SMOOTH * size / lengths ** np.array([1.0, 2.0, 3.0])[:, None]
    for which, end in enumerate(problem.ends):
        asked = {"free": vanish[:, which], "guided": vanish[:, which], "loose": vanish[:, which],
                 "ball": vanish[1:2, which]}.get(end, np.array([True]))  # fmt: skip
        if not np.all(asked):
            what = f"{end} at s = {which} where the clearance varies is not computed: let it be constant there, or "
            raise InputError("ends", "-".join(problem.ends), what + "hold the end (clamped, pinned)")


def refuse_clearances(problem: Any, what: str) -> None:
    """Raise where the clearance has steps or varies: ``what`` are computed of rods on a wall of one clearance."""
    if problem.ramps:
        raise InputError(
            "sections", "clearance that varies along them", f"must have one clearance: {what} are computed in holes of "
            "one. Where it goes over smoothly there are critical loads (`rodwell critical`, rodwell.critical_loads), "
            "branches of buckled states and their lift-off (`rodwell liftoff`, `diagram`, rodwell.follow), and load "
            "paths (`rodwell path`, rodwell.load_path)",
        )  # fmt: skip
    refuse_bridging(problem, what)


def refuse_ramps(problem: Any, what: str) -> None:
    """Raise where the clearance varies along sections: ``what`` are computed where it does not."""
    if problem.ramps:
        refuse_clearances(problem, what)


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
