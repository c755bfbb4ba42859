"""Which buckling mode of a horizontal rod comes first, and at which weights modes switch: (77), (78), Table 1."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from typing import Any

from rodwell.errors import InputError, checked_number, checked_whole
from rodwell.physics.exact.horizontal import Switching, pair_loads, switching, switchings
from rodwell.problem.checks import LIMITS
from rodwell.problem.problem import Problem

MOST_PAIRS = 50
MOST_WAVES = 200


@dataclass(frozen=True)
class ModePair:
    """Modes 2i − 1 and 2i of a horizontal rod with both ends clamped, rod at the bottom.

    Attributes
    ----------
    pair
        i, 1 for the first two modes.
    parities
        Symmetry about mid-length, 1 even or −1 odd, of the mode met first and of the other.
    forces
        Their critical end forces at s = 1 in B/L², tension positive; falling.
    error
        Bound for round-off of both, in B/L².
    before, after
        Switchings of this pair at the next smaller and the next larger weight; ``before`` is None for weights below
        the first.
    """

    pair: int
    parities: tuple[int, int]
    forces: tuple[float, float]
    error: float
    before: Switching | None
    after: Switching

    @property
    def switched(self) -> int:
        """How often the pair has switched between no weight and this one."""
        return 0 if self.before is None else self.before.n

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "modes": [2 * self.pair - 1, 2 * self.pair],
            "symmetry": [_word(parity) for parity in self.parities],
            "forces": list(self.forces),
            "error": self.error,
            "switched": self.switched,
            "before": None if self.before is None else self.before._asdict(),
            "after": self.after._asdict(),
        }


def _word(parity: int) -> str:
    return "even" if parity == 1 else "odd"


def mode_pairs(weight: float, clearance: float = 0.01, *, pairs: int = 1) -> list[ModePair]:
    """The first pairs of modes of a horizontal rod with both ends clamped: which comes first, and when they switch.

    Closed forms, see :mod:`rodwell.physics.exact.horizontal`: the pair i switches where √(i² + √(γ/Δ)/π²) is a whole
    number; up to the first such weight its even mode comes first, then its odd mode, and so on in turn.

    Parameters
    ----------
    weight
        γ = mg L³/B ≥ 0.
    clearance
        Δ/L.
    pairs
        How many pairs, 1 to 50.

    Raises
    ------
    InputError
        For values out of range.
    """
    problem = Problem(weight, clearance=clearance)
    pairs = checked_whole("pairs", pairs, 1, MOST_PAIRS)
    return [_pair(problem, i) for i in range(1, pairs + 1)]


def _pair(problem: Problem, pair: int) -> ModePair:
    c = math.sqrt(problem.weight / problem.clearance)
    place = math.floor(math.sqrt(pair**2 + c / math.pi**2))
    while place > pair and switching(place - pair, place + pair, problem.clearance).weight > problem.weight:
        place -= 1  # as the floor of a rounded root may be one off
    while switching(place + 1 - pair, place + 1 + pair, problem.clearance).weight <= problem.weight:
        place += 1
    even, odd = pair_loads(pair, c)
    first = 1 if (place - pair) % 2 == 0 else -1
    error = 16.0 * sys.float_info.epsilon * max(-even, -odd)
    before = switching(place - pair, place + pair, problem.clearance) if place > pair else None
    after = switching(place + 1 - pair, place + 1 + pair, problem.clearance)
    forces = (even, odd) if first == 1 else (odd, even)
    return ModePair(pair, (first, -first), (max(forces), min(forces)), error, before, after)


def switching_table(largest: int = 10, clearance: float = 0.01) -> list[Switching]:
    """Table 1 of the paper, up to any m: all mode switchings (78) with m ≤ ``largest``, in the order of m.

    Parameters
    ----------
    largest
        Largest m, 3 to 200.
    clearance
        Δ/L.

    Raises
    ------
    InputError
        For values out of range.
    """
    largest = checked_whole("largest", largest, 3, MOST_WAVES)
    low, high, allowed = LIMITS["clearance"]
    clearance = checked_number("clearance", clearance, low, high, allowed)
    if clearance == 0.0:
        raise InputError("clearance", clearance, f"must be {allowed}")
    return switchings(largest, clearance)
