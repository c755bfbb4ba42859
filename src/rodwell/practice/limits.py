"""Loads at which something gives on the way from the straight rod to lift-off: yield, stability, capacities."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rodwell.analysis.branches import Branch
from rodwell.analysis.fields import ZOOMS, largest_of
from rodwell.analysis.special import CRITICAL, LIFT_OFF
from rodwell.numerics.location import bracketed_root
from rodwell.practice.case import Case
from rodwell.practice.loaded import Along, LoadedRod, on_mesh
from rodwell.practice.strength import rod_section
from rodwell.practice.supports import most_used

LIFTS_OFF, UNSTABLE, YIELDS, CYLINDER, SUPPORT = "lift-off", "stability", "yield", "cylinder", "support"
NAMES = {
    "buckling": "buckling",
    LIFTS_OFF: "lift-off",
    UNSTABLE: "loss of stability (secondary bifurcation or fold)",
    YIELDS: "first yield of the rod",
    CYLINDER: "first yield of the cylinder",
    SUPPORT: "capacity of a support",
}

NEAR = 0.9
"""From this part of a strength on, its largest value along the rod is looked for closely."""

ROUND_OFF = 1e-12
"""Relative error of a load found for the straight rod."""


@dataclass(frozen=True)
class Limit:
    """A load at which something gives.

    Attributes
    ----------
    kind
        Key of ``NAMES``.
    force, error
        End force F at s = 1 in B/L², tension positive, and its error estimate; None where it is reached at any load.
    s
        Where along the rod, None where it is no place.
    buckled
        Whether the rod is buckled there; else it is straight.
    """

    kind: str
    force: float | None
    error: float = 0.0
    s: float | None = None
    buckled: bool = True

    @property
    def name(self) -> str:
        """What gives."""
        return NAMES[self.kind]


@dataclass(frozen=True)
class Use:
    """How much of a strength a state uses: 1 is all of it.

    ``size`` takes the fields of a state on one mesh, as a function of places, and how often to look closer for the
    largest value; it gives the largest part used, and its place s/L (None where it is no place along the rod).
    """

    kind: str
    size: Callable[[Along, int], tuple[float, float | None]]

    def of(self, state: LoadedRod, zooms: int = ZOOMS) -> tuple[float, float | None]:
        """Largest part used and its place, on the fine mesh."""
        return self.size(state.along[-1], zooms)


def uses(case: Case) -> tuple[Use, ...]:
    """The strengths that a case tells of."""
    out, rod, scales = [], rod_section(case), case.scales
    if rod is not None and rod.strength is not None:
        strength = rod.strength
        out.append(Use(YIELDS, lambda at, n: largest_of(lambda s: rod.von_mises(at(s)) / strength, n)))
    if case.cylinder is not None and scales is not None:
        cylinder = case.cylinder
        bears = cylinder.yield_strength
        out.append(Use(CYLINDER, lambda at, n: largest_of(lambda s: cylinder.von_mises(at(s), scales) / bears, n)))
    if case.supports is not None and scales is not None:
        supports = case.supports
        out.append(Use(SUPPORT, lambda at, _n: (most_used(at, supports, scales), None)))
    return tuple(out)


def limits(case: Case, branch: Branch, critical: float) -> tuple[Limit, ...]:
    """Every limit of a rod on the way to lift-off of its first mode, the least compressive first.

    What lies beyond lift-off (or the end of the branch) is not looked for: the rod has left the wall there.

    Raises
    ------
    NotConvergedError
        If one that was passed could not be located.
    """
    found = [limit for use in uses(case) if (limit := _limit(use, branch, critical)) is not None]
    lift = branch.lift_off
    if lift is not None:
        s = lift.s[0] if lift.s else None
        found.append(Limit(LIFTS_OFF, lift.force, lift.error, s, buckled=not branch.lift_off_at_buckling))
    found += _instability(branch)
    return tuple(sorted(found, key=lambda limit: -np.inf if limit.force is None else -limit.force))


def _instability(branch: Branch) -> list[Limit]:
    """The first loss of stability before lift-off, in the order of travel."""
    for point in branch.special_points:
        if point.kind == LIFT_OFF:
            return []
        if point.index_after > 0:
            return [Limit(UNSTABLE, point.force, point.error, buckled=point.kind != CRITICAL)]
    return []


def _limit(use: Use, branch: Branch, critical: float) -> Limit | None:
    """Where a strength is used up: on the straight rod, or on the branch up to lift-off; None if it is not."""
    problem = branch.problem

    def straight(force: float) -> LoadedRod:
        return LoadedRod("straight", problem, force)

    if use.of(straight(critical))[0] >= 1.0:
        least = 0.5 * problem.axial_weight  # as much tension at the top as compression at the bottom
        if least <= critical or use.of(straight(least))[0] >= 1.0:
            return Limit(use.kind, None, s=use.of(straight(critical))[1], buckled=False)
        share = bracketed_root(
            lambda t: use.of(straight(least + t * (critical - least)))[0] - 1.0,
            0.0, 1.0, use.of(straight(least))[0] - 1.0, use.of(straight(critical))[0] - 1.0,
        )  # fmt: skip
        force = least + share * (critical - least)
        error = ROUND_OFF * (abs(least) + abs(critical))
        return Limit(use.kind, force, error, use.of(straight(force))[1], buckled=False)
    lift = branch.lift_off
    if branch.lift_off_at_buckling:
        return None
    last = len(branch) - 1 if lift is None else lift.after
    for i in range(1, last + 1):
        state = LoadedRod("", problem, branch[i].force, solution=branch[i])
        if use.of(state, 1)[0] >= NEAR and use.of(state)[0] >= 1.0:
            return _located(use, branch, i - 1)
    if lift is not None and use.of(LoadedRod("", problem, lift.force, solution=lift.solution))[0] >= 1.0:
        return _located(use, branch, last)
    return None


def _located(use: Use, branch: Branch, i: int) -> Limit:
    """The limit between points i and i+1, located on both meshes."""
    solution, error = branch.zero_between(
        i, lambda family, state: use.size(on_mesh(branch.problem, family, state), ZOOMS)[0] - 1.0
    )
    return Limit(
        use.kind, solution.force, error, use.of(LoadedRod("", branch.problem, solution.force, 0.0, solution))[1]
    )
