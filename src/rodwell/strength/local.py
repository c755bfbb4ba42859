"""The local limits of a string: what an endless rod in a hole of the same inclination would bear, place by place.

The finite rod's exact loads decide. The local limits say where along a long string buckling starts: where its effective
compression exceeds that at which the lower end of a rod without end, in a straight hole of this inclination, buckles or
lifts off. They say nothing of a string that is hardly longer than the waves it buckles into.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rodwell.analysis.loads.long_rod import (
    LocalLoad,
    PipeString,
    critical_compression,
    length_effect,
    lift_off_compression,
)
from rodwell.case.case import Case
from rodwell.strength.loaded import LoadedRod

FEWEST_HALF_WAVES = 4.0
"""Strings shorter than this are all ends: no local limit is given for them."""


@dataclass(frozen=True)
class LocalLimits:
    """Compression in N, positive, at which an endless rod buckles and lifts off at its lower end.

    Attributes
    ----------
    critical, lift_off
        With error estimates, and None where there is none.
    length_effect
        Relative gap, estimated, between the length of the local rod that was computed and an endless one.
    half_waves
        Length of the string in half waves π (B Δ/(w sin α))^¼ of the long rod.
    """

    critical: LocalLoad
    lift_off: LocalLoad
    length_effect: float
    half_waves: float

    @property
    def applies(self) -> bool:
        """Whether the string is long enough for local limits to say something."""
        return self.critical.compression is not None


@dataclass(frozen=True)
class Exceeded:
    """Where the effective compression of a string exceeds a local limit: from s = 0 up to ``to``, s/L (0: nowhere)."""

    limit: float
    to: float


def string_of(case: Case) -> PipeString | None:
    """The local rod of a case, with its end conditions; None without dimensions or weight, of a string, in a bend.

    None of a rod whose compression is largest at s = 1 either: local limits are told from the end s = 0.
    """
    problem, scales = case.problem, case.scales
    bent_or_stepped = problem.sections or problem.hole is not None or problem.hung_weight < 0.0
    if bent_or_stepped or scales is None or not problem.weight > 0.0:
        return None
    weight = problem.weight * scales.factor("force_per_length")
    return PipeString(scales.stiffness, weight, problem.clearance * scales.length, problem.ends)


def half_waves(case: Case) -> float:
    """Length of the string in half waves of the long rod; in a vertical hole, in lengths (B/w)^⅓."""
    problem = case.problem
    if problem.lateral_weight > 0.0:
        return float((problem.lateral_weight / problem.clearance) ** 0.25 / math.pi)
    return float(problem.weight ** (1.0 / 3.0))


def local_limits(case: Case) -> LocalLimits | None:
    """Local limits of a case; None where there are none at all (no dimensions, or no weight).

    A string that is too short gets none either: ``applies`` is False then, and nothing was computed.
    """
    string, count = string_of(case), half_waves(case)
    if string is None:
        return None
    if count < FEWEST_HALF_WAVES:
        none = LocalLoad(None, reason=f"the string is {count:.2g} half waves long: its ends decide")
        return LocalLimits(none, none, math.nan, count)
    alpha = case.problem.alpha
    critical = critical_compression(string, alpha)
    return LocalLimits(critical, lift_off_compression(string, alpha), length_effect(string, alpha, critical), count)


def exceeded(state: LoadedRod, limit: float, unit: float) -> Exceeded:
    """Where −N(s) = −F − γ cos α (s − 1) exceeds ``limit`` in N; ``unit`` is B/L² in N.

    Compression falls from the lower end s = 0 upwards, so the place is the lower part of the string; in a horizontal
    hole all of it or none.
    """
    bottom, weight = -state.at_bottom * unit, state.problem.hung_weight * unit
    if bottom <= limit:
        return Exceeded(limit, 0.0)
    return Exceeded(limit, 1.0 if weight == 0.0 else min((bottom - limit) / weight, 1.0))
