"""What a packer allows, and the force that it takes to hold the tubing where it would move further."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from scipy.optimize import brentq

from rodwell.analysis.endless.shortening import LOADING
from rodwell.errors import InputError, NotConvergedError
from rodwell.quantities.value import Value
from rodwell.studies.packer.lengths import (
    KINDS,
    Conditions,
    Tubing,
    effective_compression,
    elongations,
    end_compression,
    total,
    weights,
)

LOCATED, ROUND_OFF = 1e-13, 1e-12


@dataclass(frozen=True)
class Stops:
    """How far the end of the tubing may move from where it was landed: up and down, 0 or more, infinite if free."""

    up: float = math.inf
    down: float = math.inf


@dataclass(frozen=True)
class Moved:
    """What becomes of tubing that goes from one state to another. Lengths are positive downwards, where it is longer.

    Attributes
    ----------
    changes
        Changes of length by kind, of a tubing that is free to move, without the force with which it was landed.
    landed
        By how much the upper end was lowered (positive) or raised to land it with its force on the packer.
    free
        How far the end would move in all if nothing held it: the changes and ``landed``.
    movement
        How far it moves.
    packer
        Force of the packer on the end, **tension positive**: it holds the tubing down; compression: it carries it.
    landed_with
        The same before, when the tubing was landed.
    real, effective
        Real and effective axial force just above the packer, after, tension positive.
    neutral
        Height along the hole, above the packer, up to which the effective force is compression; at most the length.
    stopped
        ``""``, or what keeps the end from moving as it would: ``"up"``, ``"down"``.
    """

    changes: dict[str, Value]
    landed: Value
    free: Value
    movement: Value
    packer: Value
    landed_with: float
    real: Value
    effective: Value
    neutral: Value
    stopped: str


def moved(
    tubing: Tubing, before: Conditions, after: Conditions, stops: Stops, landed_with: float = 0.0, rule: str = LOADING
) -> Moved:
    """Changes of length, movement and force of a tubing from one state to another.

    Parameters
    ----------
    tubing, before, after
        The string, and the two states; it was landed in the first.
    stops
        What the packer allows.
    landed_with
        Force of the packer on the end when it was landed, tension positive: −(weight slacked off).
    rule
        What buckled places between the lift-offs are, see :mod:`rodwell.analysis.endless.shortening`; it matters in
        inclined holes only.

    Raises
    ------
    InputError
        If the tubing was landed with a force that a stop cannot give, or is compressed beyond what a helix bears.
    NotConvergedError
        If no force of the packer holds the tubing.
    """
    if (landed_with < 0.0 and stops.down > 0.0) or (landed_with > 0.0 and stops.up > 0.0):
        side = "down" if landed_with < 0.0 else "up"
        raise InputError("landed_with", landed_with, f"needs a packer that stops the tubing from moving {side} at once")

    def length(state: Conditions, push: float) -> Value:
        return total(elongations(tubing, state, push, rule))

    first, last = (elongations(tubing, state, 0.0, rule) for state in (before, after))
    changes = {kind: _difference(last[kind], first[kind]) for kind in KINDS}
    landed = _difference(total(first), length(before, -landed_with))
    free = _sum(total(changes), landed)
    stopped = "up" if -free.value > stops.up else "down" if free.value > stops.down else ""
    movement, push = free, Value(0.0)
    if stopped:
        movement = Value(stops.down if stopped == "down" else -stops.up)
        start = length(before, -landed_with)

        def beyond(force: float) -> float:
            return length(after, force).value - start.value - movement.value

        push = Value(_root(beyond, tubing, free.value - movement.value))
        stiffness = tubing.modulus * tubing.area / tubing.length
        push = Value(push.value, free.error * stiffness + ROUND_OFF * abs(push.value))
    compression = effective_compression(tubing, after, push.value)
    axial, _ = weights(tubing, after)
    height = tubing.length if axial == 0.0 else min(compression / axial, tubing.length)
    neutral = Value(max(height, 0.0) if compression > 0.0 else 0.0, push.error / (axial or math.inf))
    packer = push.times(-1.0) if stopped else push
    real, effective = (Value(-each, push.error) for each in (end_compression(tubing, after, push.value), compression))
    return Moved(changes, landed, free, movement, packer, landed_with, real, effective, neutral, stopped)


def _root(function: Callable[[float], float], tubing: Tubing, excess: float) -> float:
    """The push at which nothing is left beyond the stop: lengths fall as the push grows."""
    step = excess * tubing.modulus * tubing.area / tubing.length  # what it takes without buckling, at most
    far = step
    for _ in range(60):
        try:
            if function(far) * excess <= 0.0:
                return float(brentq(function, *sorted((0.0, far)), xtol=abs(step) * LOCATED, rtol=LOCATED))
        except InputError as error:
            raise NotConvergedError(f"no force of the packer holds the tubing: {error.reason}") from None
        far *= 1.5
    raise NotConvergedError("no force of the packer holds the tubing at its stop")


def _difference(last: Value, first: Value) -> Value:
    return Value(last.value - first.value, last.error + first.error)


def _sum(one: Value, other: Value) -> Value:
    return Value(one.value + other.value, one.error + other.error)
