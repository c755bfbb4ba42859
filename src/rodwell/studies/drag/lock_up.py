"""How deep a string can be pushed: where no push at surface moves it any more, and where the push that is there ends.

Going down, friction takes a part of every force. In a helix it grows with the square of the compression, so that with
the bit at some depth the compression needed at surface is infinite: there the string *locks up*, and of a force added
at surface nothing arrives. Long before, the push of string, block and injector may not suffice. A hole that turns down
again may let the string go on below a depth that it cannot get past: so the whole way down is looked at, with the bit
free, before what the operation bears at its own depth, and below it, is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value
from rodwell.studies.drag.laws import Contact
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.run import Run, run
from rodwell.studies.drag.well_case import Operation
from rodwell.survey.survey import Survey

ON_THE_WAY, BELOW, MOST_STEPS = 64, 24, 60
CLOSE = 1e-10
"""Depths looked at on the way down and below the bit; steps to close in on one; its relative error."""

NARROWED = 12
"""Times that a dip of the force at surface between depths looked at is halved."""

At = Callable[[float], Run]
Thresholds = tuple[Value | None, Value | None]


@dataclass(frozen=True)
class Reach:
    """How deep an operation can go.

    Attributes
    ----------
    lock_up
        Least measured depth of the bit in m that cannot be passed, as no push at surface suffices, with error; None if
        none was found among the depths looked at.
    push_ends
        Least measured depth in m that cannot be passed with the push of string, block and injector; None likewise.
    searched_from, searched_to
        Measured depths of the bit in m between which was searched.
    looked_at
        At how many depths.
    on_the_way
        Whether the string stops on the way down to the depth of the operation, its bit free: the depths are then those.
    """

    lock_up: Value | None
    push_ends: Value | None
    searched_from: float
    searched_to: float
    looked_at: int
    on_the_way: bool


def reach(cutter: Cutter, operation: Operation, contact: Contact, rule: str, end: float) -> Reach:
    """Search both depths for an operation that goes down.

    First on the way to its depth, with the bit free: what stops the string there is told. Then with the force at the
    bit from its depth down to ``end``; where the operation is not possible at its depth, above: told is where it ceases
    to be possible, and None where it is possible at no depth looked at.
    """
    survey, push, bit = cutter.well.survey, cutter.well.push, operation.bit_depth
    free = replace(operation, bit_force=0.0)

    def going(one: Operation) -> At:
        return lambda depth: run(cutter, one, contact, rule, depth=depth, coarse=True, record=False)

    way = depths_between(survey, 0.0, bit, ON_THE_WAY)
    stopped = _thresholds(going(free), 0.0, 0.0, way, push)
    if any(depth is not None for depth in stopped):
        return Reach(*stopped, 0.0, bit, len(way), True)
    loaded, force = going(operation), operation.bit_force
    here = _force(loaded(bit))
    if here < -push:
        return Reach(*_thresholds(loaded, 0.0, force, way, push), 0.0, bit, 2 * len(way), False)
    below = depths_between(survey, bit, end, BELOW) if end > bit else np.array([])
    return Reach(*_thresholds(loaded, bit, here, below, push), 0.0, max(bit, end), len(way) + len(below), False)


def depths_between(survey: Survey, low: float, high: float, count: int) -> FloatArray:
    """Measured depths in m beyond ``low`` to ``high``, (count,): half of them by length, half by how the hole turns."""
    md = np.unique(np.concatenate([[low, high], survey.md[(survey.md > low) & (survey.md < high)]]))
    turned = np.interp(md, survey.md, np.concatenate([[0.0], np.cumsum(survey.dogleg)]))
    length, turn = (md - low) / (high - low), turned - turned[0]
    measure = 0.5 * (length + turn / turn[-1]) if turn[-1] > 0.0 else length
    return np.asarray(np.interp(np.arange(1, count + 1) / count, measure, md))


def _force(one: Run) -> float:
    """Force at surface in N; minus infinite where no push suffices."""
    return one.force if one.arrived else -np.inf


def _thresholds(at: At, start: float, force: float, depths: FloatArray, push: float) -> Thresholds:
    """The least depths at which the string ceases to move for any push, and for the push there is; None likewise.

    ``start`` and ``force`` are the depth above all others, and the force at surface there.
    """
    places, forces = [start], [force]
    for depth in depths:
        places.append(float(depth))
        forces.append(_force(at(float(depth))))
        if forces[-1] == -np.inf < forces[-2]:
            break
    places, forces = _with_dips(at, places, forces, push)
    out: list[Value | None] = []
    for least in (-np.finfo(float).max, -push):
        i = next((i for i in range(1, len(places)) if forces[i] < least <= forces[i - 1]), None)
        out.append(None if i is None else _closed_in(at, push, places[i - 1], places[i], not out))
    return out[0], out[1]


def _with_dips(at: At, places: list[float], forces: list[float], push: float) -> tuple[list[float], list[float]]:
    """Depths and forces, with those at which the force dips below the push between two depths looked at.

    Tried is where one is less than both beside it, and by twice the change to them it would be below the push.
    """
    found: list[tuple[float, float]] = list(zip(places, forces, strict=True))
    for i in range(1, len(places) - 1):
        above, here, below = forces[i - 1 : i + 2]
        if not (-push <= here <= min(above, below) and 3.0 * here - 2.0 * max(above, below) < -push):
            continue
        low, middle, high = ((places[j], forces[j]) for j in (i - 1, i, i + 1))
        for _ in range(NARROWED):
            trials = [(d, _force(at(d))) for d in (0.5 * (low[0] + middle[0]), 0.5 * (middle[0] + high[0]))]
            row = [low, trials[0], middle, trials[1], high]
            k = min(range(1, 4), key=lambda j: row[j][1])
            low, middle, high = row[k - 1 : k + 2]
            if middle[1] < -push:
                found.append(middle)
                break
    found.sort()
    return [place for place, _ in found], [force for _, force in found]


def _closed_in(at: At, push: float, good: float, bad: float, locking: bool) -> Value:
    """The least depth at which it fails, between one at which it does not and one at which it does.

    Where the string locks below the surface, that depth tells how far to go back; where the push ends, the force does.
    """
    low, high = good, bad
    known: list[tuple[float, float]] = []
    for step in range(MOST_STEPS):
        if high - low <= CLOSE * high:
            break
        guess = _next(known, low, high) if step % 3 != 2 else None
        middle = 0.5 * (low + high) if guess is None else guess
        one = at(middle)
        fails = _force(one) < (-np.finfo(float).max if locking else -push)
        if fails and not (locking and (one.locked_at or 0.0) < 0.0):  # the compression is infinite above the well
            high = middle
        else:
            low = middle
        measure = one.locked_at if locking else (one.force + push if one.arrived else None)
        if measure is not None:
            known = [*known, (middle, measure)][-2:]
            if locking and abs(measure) <= CLOSE * high:
                return Value(middle, CLOSE * high + abs(measure))
    return Value(high, max(high - low, CLOSE * high))


def _next(known: list[tuple[float, float]], low: float, high: float) -> float | None:
    """Where the line through the last two measures meets zero, a hair beyond so that it fails; None if outside."""
    if len(known) == 1 and known[0][1] > 0.0:
        guess = known[0][0] - known[0][1]
    elif len(known) == 2 and known[0][1] != known[1][1]:
        (a, x), (b, y) = known
        guess = b - y * (b - a) / (y - x)
    else:
        return None
    guess += 0.3 * CLOSE * high
    return guess if low < guess < high else None


def transfer(cutter: Cutter, operation: Operation, contact: Contact, rule: str) -> float | None:
    """dF_bit/dF_hook: which part of a force added at surface arrives at the bit; None where the string locks up."""
    size = 1e-4 * float(np.sqrt(np.max(cutter.weights) * np.max(cutter.stiffness))) + 1e-6 * abs(operation.bit_force)
    more = run(cutter, operation, contact, rule, bit_force=operation.bit_force - size, coarse=True, record=False)
    less = run(cutter, operation, contact, rule, bit_force=operation.bit_force, coarse=True, record=False)
    if not (more.arrived and less.arrived):
        return None
    return float(size / (less.force - more.force))


__all__ = ["Reach", "reach", "transfer"]
