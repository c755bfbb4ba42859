"""How a rod comes back from a disturbance, or does not: turned about the hole's axis, and let go.

What follows is the gradient flow behind a soft wall, as after a loss of stability (:mod:`rodwell.analysis.path.snap`):
a rod in something viscous. The wall is as stiff as it must be for the state to be one behind it too: near a limit point
that is much stiffer than what finds a minimum far away.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.path.snap import NEAR, Flow, distance, flowed
from rodwell.errors import NotConvergedError
from rodwell.numerics.stretches.carry import Sampler, angle_of, sampler
from rodwell.numerics.stretches.newton import Solved
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

STIFFNESSES = (1e7, 1e8, 1e9, 1e10)
"""Of the soft wall, in B/L⁴, one after the other until the state is held."""

ELEMENTS = 7.0
"""Elements in a half-wave."""

CLOSER = 0.1
"""How wrong steps of the flow may be when a threshold is found again: a third of what is usual."""

STIFFER = 10.0
"""How many times as stiff the wall is when it is found a third time."""

INSIDE = 1e-3
"""By how much of its distance from the axis a rod that is turned is lifted off the wall, so that nothing is pressed in.
"""

BRACKET, ASIDE = 0.02, 0.1
"""Angle in rad to which the threshold is found, and steps in which it is sought near another one."""


@dataclass(frozen=True)
class Held:
    """A state behind a soft wall that holds it, and the flow there; ``value`` is that of what is controlled."""

    control: Control
    value: float
    flow: Flow
    low: Solved

    def near(self, other: Solved) -> bool:
        """Whether a minimum is this state."""
        return distance(other, self.low) < NEAR


def held_by(state: PatternedState, control: Control, value: float) -> Held:
    """The flow behind the softest wall that holds a state.

    Raises
    ------
    NotConvergedError
        If none does: the state is too near to where it ceases to be stable.
    """
    for stiffness in STIFFNESSES:
        flow = Flow(stiffness, ELEMENTS)
        low = flowed(state, sampler(state.solved.shape), control, value, flow)
        if low is not None and distance(low, state.solved) < NEAR:
            return Held(control, value, flow, low)
    raise NotConvergedError(
        f"the state at {control.name} = {value:.8g} is so near to where it gives way that no soft wall holds it: what "
        "disturbances do to it cannot be told by descent"
    )


def turned_over(state: PatternedState, held: Held) -> Value | None:
    """The least turn of mid-length about the hole's axis after which a state does not come back, in rad; either way.

    None if it comes back from half a turn. The error is what a closer look at the flow changes, and a stiffer wall, and
    no bound.

    Raises
    ------
    NotConvergedError
        If a disturbed rod did not come to rest.
    """

    def turning(sense: float, flow: Flow) -> Callable[[float], bool]:
        return lambda angle: comes_back(state, replace(held, flow=flow), sense * angle)

    one, other = (turning(sense, held.flow) for sense in (1.0, -1.0))
    sense, first = 1.0, math.pi if one(math.pi) else _threshold(one, 0.0, math.pi)
    if not other(first - BRACKET):  # the other way less is enough
        sense, first = -1.0, _threshold(other, 0.0, first - BRACKET)
    if first == math.pi:
        return None
    looks = replace(held.flow, wanted=CLOSER), replace(held.flow, stiffness=STIFFER * held.flow.stiffness)
    closer, stiffer = (_threshold_near(turning(sense, flow), first) for flow in looks)
    return Value(closer, abs(closer - first) + abs(stiffer - first) + BRACKET)


def comes_back(state: PatternedState, held: Held, angle: float) -> bool:
    """Whether a rod that was turned by so much at mid-length, in rad, and let go goes back to its state."""
    low = flowed(state, _turned(state, angle), held.control, held.value, held.flow)
    if low is None:
        raise NotConvergedError(f"the rod that was turned by {angle:.3g} rad at mid-length did not come to rest")
    return held.near(low)


def _surely(comes_back: Callable[[float], bool], angle: float) -> bool:
    """Whether a rod comes back. One that lingers beside the saddle does not surely: so rather a lesser turn is told."""
    try:
        return comes_back(angle)
    except NotConvergedError:
        return False


def _threshold(comes_back: Callable[[float], bool], low: float, high: float) -> float:
    """The angle from which on a rod does not come back, between one from which it does and one from which not."""
    while high - low > BRACKET:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _surely(comes_back, middle) else (low, middle)
    return 0.5 * (low + high)


def _threshold_near(comes_back: Callable[[float], bool], guess: float) -> float:
    """The same near a guess; 0 and half a turn stand for themselves."""
    back = _surely(comes_back, guess)
    step = ASIDE if back else -ASIDE
    while 0.0 < guess + step < math.pi and _surely(comes_back, guess + step) == back:
        guess += step
    return _threshold(comes_back, *sorted((guess, guess + step)))


def _turned(state: PatternedState, angle: float) -> Sampler:
    """A sampler of a state turned about the hole's axis by ψ sin²(πs): its ends, and their slopes, stay."""
    base = sampler(state.solved.shape)

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, _ = base(s)
        z = fields[0] + 1j * fields[1]  # −r exp(−iφ)
        most = np.stack(
            [np.sin(np.pi * s) ** 2, np.pi * np.sin(2.0 * np.pi * s), 2.0 * np.pi**2 * np.cos(2.0 * np.pi * s)]
        )
        turn, inwards = -1j * angle * most, -INSIDE * most
        inwards[0] += 1.0
        by = _product(inwards, np.stack([np.ones_like(s), turn[1], turn[2] + turn[1] ** 2]) * np.exp(turn[0]))
        z = _product(z, by)
        fields = np.stack([z.real, z.imag])
        return fields, angle_of(fields)

    return sample


def _product(one: FloatArray, other: FloatArray) -> FloatArray:
    """A product with two derivatives, from those of its factors, (3, k) each."""
    return np.stack([
        one[0] * other[0], one[1] * other[0] + one[0] * other[1],
        one[2] * other[0] + 2.0 * one[1] * other[1] + one[0] * other[2],
    ])  # fmt: skip
