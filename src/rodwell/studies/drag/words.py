"""What torque and drag of a well mean, in sentences: the verdict first, which is the worst of all that is said."""

from __future__ import annotations

import math

import numpy as np

from rodwell.quantities.text import amount, plain
from rodwell.quantities.value import Value
from rodwell.studies.drag.calibration import Calibration
from rodwell.studies.drag.contact import NAMES
from rodwell.studies.drag.drag import BALANCED, Drag, OperationResult
from rodwell.studies.drag.well_case import DOWNWARD, Well

FAILS, BUCKLES, PASSES = "fails", "buckles", "passes"
LEVELS = (FAILS, BUCKLES, PASSES)
"""Verdicts, the worst first: not possible, or beyond the yield strength; the string buckles; neither."""

STEEP = 0.3
"""Slope of a helix beyond which small slopes no longer describe it: the contact force is then off by some percent."""

SMALL_TRANSFER = 0.01
"""Below this part of a force at surface that arrives at the bit, practice speaks of lock-up."""


def scatter(well: Well, found: Calibration) -> str:
    """How far measured loads lie from those computed with the factors found."""
    said = f"Hook loads scatter by {force(well, Value(found.spread[0]))}"
    if not any(math.isfinite(one.hook_load) for one in found.measured):
        return f"Torques scatter by {torque(well, Value(found.spread[1]))}"
    if any(math.isfinite(one.torque) for one in found.measured):
        said += f", torques by {torque(well, Value(found.spread[1]))}"
    return said


def level_of_one(one: OperationResult) -> str:
    """Verdict on one operation."""
    if not one.possible or yields(one):
        return FAILS
    return BUCKLES if one.run.buckled else PASSES


def level_of(found: Drag) -> str:
    """Verdict on a well: the worst of its operations."""
    return min((level_of_one(one) for one in found.operations), key=LEVELS.index)


def yields(one: OperationResult) -> bool:
    """Whether the stress reaches the yield strength anywhere, where that is known."""
    used = one.strength.used
    return bool(np.any(used[np.isfinite(used)] >= 1.0))


def force(well: Well, value: Value) -> str:
    """A force in the well's units, with the digits that its error allows."""
    return _in(well, value, "force")


def torque(well: Well, value: Value) -> str:
    """A torque likewise."""
    return _in(well, value, "torque")


def depth(well: Well, value: float, error: float = 0.0) -> str:
    """A measured depth in metres or feet."""
    unit, text = units(well)["depth"]
    return f"{amount(Value(value / unit, error / unit), 6)} {text}"


def stress(well: Well, value: float) -> str:
    """A stress in the well's units."""
    scale, text = units(well)["stress"]
    return f"{plain(value / scale, 3)} {text}"


def not_judged(found: Drag) -> tuple[str, ...]:
    """Sections of the string of which no yield strength is given, from the bit up."""
    return tuple(dict.fromkeys(name for one in found.operations for name in one.strength.not_judged))


def units(well: Well) -> dict[str, tuple[float, str]]:
    """SI value and text of the units of sentences and tables: depth, force, force per length, torque and stress."""
    system = well.system
    if system.name == "field":
        names = {"depth": "length", "force": "force", "per_length": "force_per_length", "torque": "moment",
                 "stress": "stress"}  # fmt: skip
        return {key: system.unit(name) for key, name in names.items()}
    return {"depth": (1.0, "m"), "force": (1e3, "kN"), "per_length": (1.0, "N/m"), "torque": (1e3, "kN·m"),
            "stress": (1e6, "MPa")}  # fmt: skip


def _in(well: Well, value: Value, kind: str) -> str:
    scale, text = units(well)[kind]
    return f"{amount(value.times(1.0 / scale), 5)} {text}"


def sentences(found: Drag) -> list[str]:
    """What was found, the verdict first."""
    worst = min(found.operations, key=lambda one: LEVELS.index(level_of_one(one)))
    out = [_verdict(found, worst)]
    for one in found.operations:
        if level_of_one(one) == FAILS and one is not worst:
            out.append(f"{_capital(one.operation.name)} {failure(found.well, one)}.")
        out += sentences_of(found.well, one)
    return out


def _verdict(found: Drag, worst: OperationResult) -> str:
    well, name = found.well, worst.operation.name
    level = level_of(found)
    if level == FAILS:
        failing = sum(level_of_one(one) == FAILS for one in found.operations)
        several = f" {failing} of {len(found.operations)} operations fail." if failing > 1 else ""
        return f"{_capital(name)} {failure(well, worst)}.{several}"
    open_ = not_judged(found)
    unknown = f"; stresses are not judged in {', '.join(open_)} (no yield strength)" if open_ else ""
    possible = f"Every operation is possible{AT_DEPTH if way_left_out(found) else ''}"
    if level == BUCKLES:
        names = ", ".join(one.operation.name for one in found.operations if one.run.buckled)
        return f"{possible}; the string buckles: {names}{unknown}."
    return f"{possible}, and the string stays straight on the wall of its hole in all of them{unknown}."


AT_DEPTH = " with the bit at its depth (stiff string: the way down is not looked at)"


def way_left_out(found: Drag) -> bool:
    """Whether something goes down whose way was not looked at: that is done for the soft string only."""
    return any(one.operation.kind in DOWNWARD and not one.reach for one in found.operations)


def failure(well: Well, one: OperationResult) -> str:
    """Why an operation fails: what follows its name in a sentence."""
    if one.locked:
        at = (
            ""
            if one.run.locked_at is None
            else f", its compression grows beyond bounds at {depth(well, one.run.locked_at)}"
        )
        return f"is not possible: the string locks up{at}; no push at surface moves it"
    if not one.possible_at_depth and one.margin is not None:
        lacking = force(well, one.margin.times(-1.0))
        return f"is not possible: {lacking} more push is needed at surface than there is"
    if one.stopped:
        free = " with its bit free" if one.operation.bit_force else ""
        stops = " or ".join(f"{what} with the bit at {text}" for what, text in _stops(well, one))
        return f"cannot get to {depth(well, one.operation.bit_depth)}: on the way down{free} the string {stops}"
    used = 100.0 * float(np.nanmax(one.strength.used))
    return f"exceeds the yield strength: the largest von Mises stress is {plain(used, 3)} % of it"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def sentences_of(well: Well, one: OperationResult) -> list[str]:
    """Sentences on one operation: ends, bounds, buckled intervals, how deep it can go, what is marked."""
    name = _capital(one.operation.name)
    out = []
    ends = one.ends
    if ends.hook_load is not None and ends.torque is not None:
        said = f"{name}, bit at {depth(well, one.operation.bit_depth)}: hook load {force(well, ends.hook_load)}"
        said += f", torque at surface {torque(well, ends.torque)}" if one.operation.rotating else ""
        out.append(said + ".")
    soft = one.compared.get("soft")
    if soft is not None and soft.hook_load is not None and soft.torque is not None:
        more = f", torque {torque(well, soft.torque)}" if one.operation.rotating else ""
        out.append(f"{name}, by a soft string: hook load {force(well, soft.hook_load)}{more}.")
    out += _bounds(well, one, name)
    buckled = [f"{NAMES[s]} from {depth(well, high)} to {depth(well, low)}" for low, high, s in one.run.buckled]
    if buckled:
        shown = buckled[:4] + ([f"and {len(buckled) - 4} more intervals"] if len(buckled) > 4 else [])
        out.append(f"{name}: {', '.join(shown)}.")
    out += _reach(well, one, name)
    out += _marked(well, one, name)
    return out


def _bounds(well: Well, one: OperationResult, name: str) -> list[str]:
    early, late = one.bounds["early"].hook_load, one.bounds["late"].hook_load
    if early is None or late is None:
        return (
            []
            if early is late
            else [f"{name}: whether it locks up depends on which local state holds; the worse counts."]
        )
    if abs(early.value - late.value) <= early.error + late.error:
        return []
    low, high = sorted((early, late), key=lambda load: load.value)
    return [f"{name}: where two local states are stable, the hook load lies between {force(well, low)} and "
            f"{force(well, high)}; the verdict takes the worse."]  # fmt: skip


def _reach(well: Well, one: OperationResult, name: str) -> list[str]:
    if not one.reach:
        return []
    searched = next(iter(one.reach.values()))
    free = ", its bit free," if one.stopped and one.operation.bit_force else ""
    out = [f"{name}{free} {what} with the bit at {text}." for what, text in _stops(well, one)]
    if not out and one.possible:
        way = ", on the way to its depth with the bit free" if one.operation.bit_force else ""
        out.append(f"{name}: no lock-up, and push enough, down to {depth(well, searched.searched_to)}, at every one of "
                   f"{searched.looked_at} depths looked at{way}.")  # fmt: skip
    elif not out:
        out.append(f"{name}: not possible at any depth looked at.")
    if one.transfer is not None and one.run.buckled:
        part = f"{plain(100.0 * one.transfer, 3)} %"
        low = ": practice calls that locked up" if one.transfer < SMALL_TRANSFER else ""
        out.append(f"{name}: {part} of a force added at surface arrives at the bit{low}.")
    return out


def _stops(well: Well, one: OperationResult) -> list[tuple[str, str]]:
    """What ends the way down, and with the bit at which depth, by both bounds where they differ."""
    out = []
    for key, what in (("push_ends", "needs more push than there is"), ("lock_up", "locks up")):
        depths = sorted((d.value, d.error) for r in one.reach.values() if (d := getattr(r, key)) is not None)
        if depths:
            text = depth(well, *depths[0])
            if len(depths) > 1 and depths[-1][0] > depths[0][0] * (1.0 + 1e-6):
                text += f" to {depth(well, *depths[-1])}, by the local state"
            out.append((what, text))
    return out


def _marked(well: Well, one: OperationResult, name: str) -> list[str]:
    """Where assumptions end."""
    out = []
    if yields(one) and not one.run.arrived:
        first = int(np.argmax(np.nan_to_num(one.strength.used) >= 1.0))
        where = depth(well, float(one.run.measured_depth[first]))
        return [f"{name}: before it locks up the string yields, above {where}: forces beyond that are no real ones."]
    if yields(one):
        used = float(np.nanmax(one.strength.used))
        out.append(f"{name}: the von Mises stress reaches {plain(100.0 * used, 3)} % of the yield strength: beyond it "
                   "nothing here holds.")  # fmt: skip
    if one.strength.not_judged:
        part = "" if not np.any(np.isfinite(one.strength.used)) else " there"
        known = one.strength.von_mises[np.isfinite(one.strength.von_mises) & ~np.isfinite(one.strength.used)]
        largest = f" (up to {stress(well, float(np.max(known)))})" if len(known) and one.run.arrived else ""
        out.append(f"{name}: no yield strength is given for {', '.join(one.strength.not_judged)}, so stresses{part}"
                   f"{largest} are not judged.")  # fmt: skip
    steepest = one.strength.helix_slope
    if steepest > STEEP:
        angle = plain(math.degrees(math.atan(steepest)), 3)
        out.append(f"{name}: the helix is as steep as {angle}°; its contact force is that of small slopes.")
    return out


SOFT_STRING = "Soft string: it follows the hole and bends without resistance."
STIFF_STRING = (
    "Stiff string: where it is straight it lies in the hole's clearance with its bending stiffness, hinged in the "
    "middle at surface, free at the bit; where it is buckled the local state counts. What it remembers of its loads is "
    "that of the soft string; how deep it can go, and whether it gets to its depth, is not searched: take the soft "
    "string for that."
)


def unbalanced(found: Drag) -> list[str]:
    """Operations whose work does not balance, or whose forces have not settled, in words."""
    loose = [f"{one.operation.name}: force and bending have not settled" for one in found.operations if not one.settled]
    return loose + [
        f"{one.operation.name}: work of {plain(one.balance.value, 2)} of all is missing"
        for one in found.operations
        if one.balance is not None and not one.balance.value <= BALANCED
    ]


def assumptions(found: Drag) -> list[str]:
    """What the numbers are, and what is not in them."""
    well = found.well
    laws = {
        "exact": "Buckled intervals press the wall as the exact states of the endless rod do, small slopes.",
        "correlation": "Helical from β = 2√2 on, with n = q + rP²/4B there, as a correlation.",
        "straight": "A buckled string is taken to press the wall like a straight one: not on the safe side where it "
        "buckles.",
    }
    rules = {
        "history": "Where two local states are stable, the string keeps the one it had while it was run in with the "
        "bit free, and while the force at the bit was built up.",
        "equal-energy": "The string is helical where the helix has the lower energy.",
        "late": "The string stays sinusoidal until that state leaves the wall.",
        "early": "The string is helical wherever a helix is on the wall.",
    }
    out = [*well.survey.notes, laws[well.settings.contact]]
    if well.settings.contact == "exact":
        out.append(rules[well.settings.state_rule])
    out += [
        "Forces effective, tension positive; the hook load is the force at surface without the weight of the block.",
        "The hole is an arc between two stations; torque acts at half the outer diameter of the string.",
        STIFF_STRING if well.settings.string == "stiff" else SOFT_STRING,
        "Not included: tool joints, temperature, friction of sheaves, forces of flow.",
    ]
    return out
