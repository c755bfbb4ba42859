"""What makes a problem, checked when it is made: numbers within their limits, and values that go together."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

from rodwell.errors import InputError, InputWarning, checked_number
from rodwell.problem.clearances import check_ramps
from rodwell.problem.ends import HOLD_ANGLE, checked_ends, refuse_off_wall
from rodwell.problem.hole import CURVATURE_ALLOWED, MOST_CURVATURE, Hole, checked_axis
from rodwell.problem.profile import extremes
from rodwell.problem.sections import Section, checked_sections

LARGEST_WEIGHT = 1e9
LARGEST_TWIST = 1e4
LARGEST_TURNS = 1000
TURNS_ALLOWED = f"from -{LARGEST_TURNS} to {LARGEST_TURNS} turns of the end s = 1, whole or not"
SMALLEST_CLEARANCE = 1e-7
SMALLEST_TORSION, LARGEST_TORSION = 1e-6, 1e6


LIMITS = {
    "weight": (0.0, LARGEST_WEIGHT, f"from 0 to {LARGEST_WEIGHT:g}, γ = mg L³/B"),
    "alpha": (0.0, 180.0, "from 0 (vertical) over 90 (horizontal) to 180 (s = 1 below), in degrees"),
    "clearance": (0.0, 1.0, "above 0 and below 1: Δ/L, a part of the length"),
    "poisson": (-1.0, 0.5, "above -1 and at most 0.5"),
    "torsion": (SMALLEST_TORSION, LARGEST_TORSION, f"from {SMALLEST_TORSION:g} to {LARGEST_TORSION:g}, C/B"),
    "twist": (-LARGEST_TWIST, LARGEST_TWIST, f"from -{LARGEST_TWIST:g} to {LARGEST_TWIST:g}, in B/L"),
    **dict.fromkeys(("build", "walk"), (-MOST_CURVATURE, MOST_CURVATURE, CURVATURE_ALLOWED)),
}
"""Lowest and highest value of each number, and what is allowed in words."""


RADIANS = tuple(math.radians(degrees) for degrees in (15, 30, 45, 60, 75, 80, 85, 89, 90))
"""Inclinations that are asked back, since they are round in degrees if they are meant in radians."""

STEEP = 1.01 * max(RADIANS)
"""No angle above is one of them: curves make thousands of problems."""


def check(problem: Any) -> None:
    """Take what was given for a problem that is being made, or raise, naming the value and what is allowed.

    Numbers become floats, ends a pair, sections whole; the inclination of a hole through points is taken from them.

    Raises
    ------
    InputError
        If a value is not allowed, or two do not go together.
    """
    if isinstance(problem.weight, int | float) and problem.weight < 0.0:
        reason = f"must be {LIMITS['weight'][2]}: for a rod that floats give {-problem.weight:g} and floats=True"
        raise InputError("weight", problem.weight, reason)
    _take_numbers(problem)
    object.__setattr__(problem, "ends", checked_ends(problem.ends))
    if type(problem.sections) is not tuple or problem.sections:
        object.__setattr__(problem, "sections", checked_sections(problem.sections))
        if problem.sections:
            _take_clearance(problem)
    if not SMALLEST_CLEARANCE <= problem.clearance < 1.0:
        allowed = f"must be above 0 and below 1: Δ/L, a part of the length (at least {SMALLEST_CLEARANCE:g})"
        raise InputError("clearance", problem.clearance, allowed)
    if problem.poisson == -1.0:
        raise InputError("poisson", problem.poisson, "must be above -1 and at most 0.5")
    if abs(problem.rise) >= 1.0:
        raise InputError(
            "turns",
            problem.turns,
            f"a rod of this length cannot wind around so often at clearance {problem.clearance:g}",
        )
    _check_ends(problem)
    if not isinstance(problem.axis, tuple) and len(problem.axis) == 0:
        object.__setattr__(problem, "axis", ())
    if problem.build != 0.0 or problem.walk != 0.0 or len(problem.axis) > 0:
        _check_hole(problem)
    if problem.ramps:
        check_ramps(problem)
    _ask_for_degrees(problem.alpha)


def _take_numbers(problem: Any) -> None:
    """Take numbers, turns and flags."""
    for name, (low, high, allowed) in LIMITS.items():
        value = getattr(problem, name)
        if (type(value) is float and low <= value <= high) or (name == "torsion" and value is None):
            continue  # mostly: curves make thousands of problems
        object.__setattr__(problem, name, checked_number(name, value, low, high, allowed))
    if type(problem.turns) is not int or abs(problem.turns) > LARGEST_TURNS:
        turns = checked_number("turns", problem.turns, -LARGEST_TURNS, LARGEST_TURNS, TURNS_ALLOWED)
        object.__setattr__(problem, "turns", int(turns) if turns.is_integer() else turns)
    for flag in ("on_top", "outside", "floats"):
        if not isinstance(getattr(problem, flag), bool):
            raise InputError(flag, getattr(problem, flag), "must be True or False")


def _take_clearance(problem: Any) -> None:
    """Take a clearance ratio that all sections share into the clearance, and check those of the others."""
    _refuse_all_floating(problem.sections)
    ratios = [section[3] for section in problem.sections]
    if not any(isinstance(ratio, tuple) for ratio in ratios) and min(ratios) == max(ratios) != 1.0:
        object.__setattr__(problem, "clearance", problem.clearance * ratios[0])
        same = [(*section[:3], 1.0, section[4]) for section in problem.sections]
        object.__setattr__(problem, "sections", checked_sections(same))
        return
    for number, one in enumerate(ratios, 1):
        for ratio in extremes(one)[::2]:
            if not SMALLEST_CLEARANCE <= ratio * problem.clearance < 1.0:
                what = f"makes its clearance {ratio * problem.clearance:g} L: must be above 0 and below 1, a part of "
                what += f"the rod's length (at least {SMALLEST_CLEARANCE:g})"
                raise InputError(f"section {number}, clearance", ratio, what)


def _refuse_all_floating(sections: tuple[Section, ...]) -> None:
    """Raise where every section floats, or hangs in balance: that is said of the whole rod."""
    weights = [value for section in sections for value in np.atleast_1d(section[2])]
    if min(weights) < 0.0 >= max(weights):
        what = "are all negative: for a rod that floats as a whole give floats=True and positive ratios"
        raise InputError("sections", f"weight ratios {' + '.join(f'{one:g}' for one in weights[:6])}", what)


def _check_ends(problem: Any) -> None:
    """Refuse what the ends cannot hold."""
    ends = "-".join(problem.ends)
    untwisted = [end for end in problem.ends if end in ("free", "loose")]
    if problem.twist != 0.0 and untwisted:
        reason = f"a {untwisted[0]} end takes no torque: twist must be 0 with ends {ends}"
        raise InputError("twist", problem.twist, reason)
    if problem.turns != 0 and not (problem.ends[0] in HOLD_ANGLE and problem.ends[1] in HOLD_ANGLE):
        raise InputError("turns", problem.turns, f"ends {ends} let the rod unwind: clamp or pin both")
    if problem.on_top and problem.lateral_weight > 0.0 and not problem.holds_angle:
        raise InputError("ends", ends, "nothing keeps the rod on top: clamp or pin at least one end")


def _check_hole(problem: Any) -> None:
    """Take the axis of a curved hole, and refuse what goes with a straight one only."""
    if len(problem.axis) > 0:
        if problem.build != 0.0 or problem.walk != 0.0:
            name = "build" if problem.build != 0.0 else "walk"
            raise InputError(name, getattr(problem, name), "must be left out where axis gives the hole")
        object.__setattr__(problem, "axis", checked_axis(problem.axis))
        hole = Hole.through(problem.axis)
        if problem.alpha not in (90.0, hole.alpha):
            reason = f"must be left out: axis has the inclination {hole.alpha:.10g} degrees at mid-length"
            raise InputError("alpha", problem.alpha, reason)
        object.__setattr__(problem, "alpha", hole.alpha)
    else:
        hole = Hole.arc(problem.alpha, problem.build, problem.walk)
        object.__setattr__(problem, "build", hole.build)
        object.__setattr__(problem, "walk", hole.walk)
    hole.check(problem.clearance)
    if hole.straight:
        return
    refuse_off_wall(problem.ends, "the states of a rod in a curved hole")
    if problem.turns != 0:
        raise InputError("turns", problem.turns, "must be 0 in a curved hole: coils are computed in straight ones")
    if problem.bridges and not hole.planar:
        kind = "one clearance" if problem.rod.clearance_steps.size else "one sign of weight"
        what = (
            f"must have {kind} in a hole that leaves the vertical plane: strings that bridge are computed in straight "
        )
        what += f"holes and in those that stay in a vertical plane; give {kind} for all sections"
        raise InputError("sections", f"{len(problem.sections)} of them", what)


def _ask_for_degrees(alpha: float) -> None:
    """Warn where an inclination looks like radians."""
    if alpha < STEEP and any(math.isclose(alpha, angle, rel_tol=1e-9) for angle in RADIANS):
        degrees = math.degrees(alpha)
        warnings.warn(
            f"alpha = {alpha:.6g} is taken in degrees, nearly vertical; for {alpha:.6g} rad give {degrees:.6g}",
            InputWarning,
            stacklevel=5,
        )
