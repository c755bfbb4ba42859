"""How deep a string can be pushed: where no push at surface moves it any more, and where the push that is there ends.

Going down, friction takes a part of every force. In a helix it grows with the square of the compression, so that with
the bit at some depth the compression needed at surface is infinite: there the string *locks up*, and of a force added
at surface nothing arrives. Long before, the push of string, block and injector may not suffice.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.quantities.value import Value
from rodwell.studies.drag.laws import Contact
from rodwell.studies.drag.pieces import Cutter
from rodwell.studies.drag.run import Run, run
from rodwell.studies.drag.well_case import Operation

SCANNED, MOST_STEPS = 24, 60
CLOSE = 1e-10
"""Depths looked at on the way to the end; steps to close in on one; its relative error."""


@dataclass(frozen=True)
class Reach:
    """How deep an operation can go.

    Attributes
    ----------
    lock_up
        Least measured depth of the bit in m from which on no push at surface suffices, with error; None if there is
        none above ``searched_to``.
    push_ends
        Least measured depth in m from which on the push of string, block and injector does not suffice; None likewise.
    searched_from, searched_to
        Measured depths of the bit in m between which was searched.
    """

    lock_up: Value | None
    push_ends: Value | None
    searched_from: float
    searched_to: float


def reach(cutter: Cutter, operation: Operation, contact: Contact, rule: str, end: float) -> Reach:
    """Search both depths for an operation that goes down.

    From the depth of the bit on it is searched downwards to ``end``, or upwards where the operation is not possible
    there already; where it is possible at neither end, the search has no bracket and None is returned.
    """
    push = cutter.well.push

    def at(depth: float) -> Run:
        return run(cutter, operation, contact, rule, depth=depth, coarse=True, record=False)

    def locks(one: Run) -> bool:
        return not one.arrived

    def stops(one: Run) -> bool:
        return not one.arrived or one.force < -push

    first = at(operation.bit_depth)
    found: dict[str, Value | None] = {}
    low, high = operation.bit_depth, end
    for name, fails in (("lock_up", locks), ("push_ends", stops)):
        if fails(first):
            low = 0.0
            depths = np.linspace(operation.bit_depth, 0.0, SCANNED + 1)[1:-1]
            good = next((float(d) for d in depths if not fails(at(float(d)))), None)
            bad = operation.bit_depth if good is None else good + operation.bit_depth / SCANNED
        else:
            depths = (
                np.linspace(operation.bit_depth, end, SCANNED + 1)[1:] if end > operation.bit_depth else np.array([])
            )
            worse = next((float(d) for d in depths if fails(at(float(d)))), None)
            bad = np.inf if worse is None else worse
            good = operation.bit_depth if worse is None else worse - (end - operation.bit_depth) / SCANNED
        if good is None or bad == np.inf:
            found[name] = None
        else:
            found[name] = _closed_in(at, fails, push, good, min(bad, max(end, operation.bit_depth)), name == "lock_up")
    return Reach(found["lock_up"], found["push_ends"], low, high)


def _closed_in(at, fails, push: float, good: float, bad: float, locking: bool) -> Value:  # type: ignore[no-untyped-def]
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
        if fails(one) and not (locking and (one.locked_at or 0.0) < 0.0):  # the compression is infinite above the well
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
