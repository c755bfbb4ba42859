"""Twisting a rod that is about to lift off (paper, section 4.2): which sense settles it, and how far."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.loads.pressure import pressure_rates
from rodwell.analysis.straight.critical import Mode
from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.problem.words import ends_text
from rodwell.quantities.text import plain, with_error
from rodwell.quantities.tolerance import RTOL, checked_rtol
from rodwell.quantities.value import Value

LARGEST_TWIST = 200.0
"""Twist in B/L up to which a second lift-off is sought."""

STEP = 1e-4
"""Step of T₁, in B/L, for the rates of the contact pressure."""

NO_RATE = 1e-6
"""A rate below this part of the largest distributed force times the clearance counts as none."""


def _places(places: Sequence[float]) -> str:
    return " and ".join(f"s = {plain(s)}" for s in places)


@dataclass(frozen=True)
class Torsion:
    """What twist does to a rod at its lift-off load.

    Attributes
    ----------
    problem
        The problem, without twist.
    prepared
        The lift-off point: its force stays applied.
    rates, rate_errors
        dp/dT₁ at each place that lifts off, in 1/L²: a place is pressed to the wall by twist of the opposite sign; and
        the estimates of their errors.
    sense
        Sign of the twist that presses all of these places to the wall; 0 if there is none.
    branch
        The states with growing twist of that sense, None if there is none.
    again
        Where the rod lifts off again, None if it does not within the range looked at.
    """

    problem: Problem
    prepared: SpecialPoint
    rates: tuple[float, ...]
    rate_errors: tuple[float, ...]
    sense: int
    branch: Branch | None
    again: SpecialPoint | None

    def __repr__(self) -> str:
        return f"<Torsion at F = {self.prepared.force:.6g} B/L²: {self.meaning}>"

    @property
    def meaning(self) -> str:
        """The outcome in words."""
        places = _places(self.prepared.s)
        if self.sense == 0 and len(self.rates) > 1:
            return (
                f"Twist of either sign makes the rod lift off at once: it is about to at {places}, and what presses "
                "one place to the wall lifts the other (turning the rod round swaps them, and T₁ changes sign)."
            )
        if self.sense == 0:
            return (
                f"To first order twist neither presses nor lifts the rod at {places}: turning the rod round leaves the "
                "place and changes the sign of T₁. What twist of either sign does is of second order."
            )
        sign = ">" if self.sense > 0 else "<"
        text = f"Twist T₁ {sign} 0 presses the rod to the wall at {places}; the other sense lifts it off at once."
        if self.again is None:
            assert self.branch is not None
            return text + f" No second lift-off was found up to T₁ = {plain(float(self.branch.values[-1]))} B/L."
        moment = with_error(Value(self.again.value, self.again.error), 8)
        return text + f" It lifts off again at T₁ = {moment} B/L, at {_places(self.again.s)}."

    def as_dict(self) -> dict[str, Any]:
        """Return the outcome as plain data, for JSON."""
        again = self.again
        return {
            "convention": "end force F and twisting moment T1 at s = 1, dead loads in B/L^2 and B/L, tension positive; "
            + ends_text(self.problem),
            "force": self.prepared.force,
            "error": self.prepared.error,
            "s": list(self.prepared.s),
            "pressure_rates": list(self.rates),
            "pressure_rate_errors": list(self.rate_errors),
            "sense": self.sense,
            "again": None if again is None else {"twist": again.value, "error": again.error, "s": list(again.s)},
            "converged": self.prepared.solution.converged and (self.branch is None or self.branch.converged),
            "meaning": self.meaning,
        }


def torsion(
    problem: Problem,
    mode: int | Mode = 1,
    *,
    mirror: bool = False,
    until: float = LARGEST_TWIST,
    rtol: float = RTOL,
) -> Torsion:
    """Prepare a rod at the lift-off load of a mode, then twist it either way.

    Critical loads do not depend on twist: the term of T₁ in the energy is of third order in y.

    Parameters
    ----------
    problem
        The rod, with ``twist`` 0.
    mode, mirror
        Mode and arm, as for :func:`rodwell.follow`: ω₂(1) < 0, or ω₂(1) > 0 with ``mirror``.
    until
        Largest twist looked at, in B/L, either way.
    rtol
        Relative tolerance.

    Raises
    ------
    InputError
        If the problem has twist, an end that takes none, or no lateral weight.
    NotConvergedError
        If the mode has no lift-off within reach.
    """
    problem.refuse_curved("twist at the lift-off load is studied")
    rtol = checked_rtol(rtol)
    if problem.twist != 0.0:
        raise InputError("twist", problem.twist, "must be 0: the rod is prepared without twist")
    if not problem.pressed:
        raise InputError("weight", problem.weight, "the rod must be pressed to the wall by its lateral weight")
    problem.but(twist=1.0)  # ends that take no twist are refused
    lift = follow(problem, mode, mirror=mirror, rtol=rtol).lift_off
    if lift is None:
        raise NotConvergedError("the rod has no lift-off within reach, at which it could be prepared")
    rates, errors = pressure_rates(lift.solution, lift.s, "twist")
    size = NO_RATE * problem.lateral_weight * max(1.0, 1.0 / problem.clearance)
    senses = {0 if abs(rate) < size else int(-np.sign(rate)) for rate in rates}
    sense = senses.pop() if len(senses) == 1 else 0
    if sense == 0:
        return Torsion(problem, lift, rates, errors, 0, None, None)
    branch = follow(problem, start=lift.solution, parameter="twist", until=sense * until, rtol=rtol)
    return Torsion(problem, lift, rates, errors, sense, branch, branch.lift_off)
