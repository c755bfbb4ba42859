"""The number of turns of least energy at a load, by trying one after the other."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from rodwell.analysis.branch.minimum import equilibrium
from rodwell.analysis.branch.solution import Solution
from rodwell.errors import InputError, NotConvergedError, checked_whole
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL, checked_force
from rodwell.quantities.value import Value

RISING = 3
"""Numbers of turns in a row whose energy rises, after which no more are tried."""


@dataclass(frozen=True)
class TurnsAtLoad:
    """Coils of several numbers of turns at one end force.

    Attributes
    ----------
    force
        End force F at s = 1 in B/L², tension positive.
    coils
        The minima that were found, by number of turns. Each is one minimum; there may be others with as many turns.
    missing
        Why there is none, for the numbers of turns without.
    """

    force: float
    coils: dict[int, Solution]
    missing: dict[int, str]

    def __repr__(self) -> str:
        tried = ", ".join(map(str, self.energies))
        return f"<TurnsAtLoad F = {self.force:.10g} B/L², least energy with {self.turns} of {tried} turns>"

    @property
    def energies(self) -> dict[int, Value]:
        """Energy relative to the straight rod in B/L, by number of turns; that of the straight rod itself is 0."""
        return {0: Value(0.0)} | {turns: coil.number("energy") for turns, coil in self.coils.items()}

    @property
    def turns(self) -> int:
        """The number of turns of least energy, of those tried; 0 is the straight rod, which may be unstable."""
        return min(self.energies, key=lambda turns: self.energies[turns].value)

    @property
    def solution(self) -> Solution | None:
        """The coil of least energy; None if that is the straight rod."""
        return self.coils.get(self.turns)


def turns_of_least_energy(
    problem: Problem,
    force: float,
    *,
    most: int = 100,
    rtol: float = RTOL,
    progress: Callable[[int], None] | None = None,
) -> TurnsAtLoad:
    """Find the number of turns with which a rod kept on the wall has least energy at an end force.

    Numbers are tried from 1 on, until the energy has risen three times in a row beyond that of a long rod's best
    winding. Turns in the other sense have the same energy without twist.

    Parameters
    ----------
    problem
        The rod; its own ``turns`` do not matter.
    force
        End force F at s = 1 in B/L², tension positive.
    most
        Largest number of turns tried.
    rtol
        Relative tolerance.
    progress
        Called with each number of turns before it is tried.

    Raises
    ------
    InputError
        If an argument is out of range.
    """
    problem.refuse_curved("coils are computed")
    force, most = checked_force("force", force), checked_whole("most", most, 1, 1000)
    problem.but(turns=1 if problem.rise == 0.0 else problem.turns)  # ends must hold a coil
    best = math.sqrt(max(-force, 0.0) / 2.0) / (2.0 * math.pi)  # of a weightless long rod: −F = 2 (2πn)²
    coils: dict[int, Solution] = {}
    missing: dict[int, str] = {}
    rising = 0
    for turns in range(1, most + 1):
        try:
            coiled = problem.but(turns=turns)
        except InputError as error:
            missing[turns] = error.reason
            break
        if progress is not None:
            progress(turns)
        try:
            coils[turns] = equilibrium(coiled, force, rtol=rtol)
        except NotConvergedError as error:
            missing[turns] = str(error)
            rising += turns > best
        else:
            before = coils.get(turns - 1)
            energy = coils[turns].number("energy").value
            rising = rising + 1 if before is None or energy > before.number("energy").value else 0
        if rising >= RISING and turns > best:
            break
    return TurnsAtLoad(force, coils, missing)
