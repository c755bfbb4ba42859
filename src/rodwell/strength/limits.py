"""Loads at which something gives on the way from the straight rod to lift-off: yield, stability, capacities."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.special import CRITICAL, LIFT_OFF, SpecialPoint
from rodwell.analysis.loads.lying_rod import LyingRod
from rodwell.analysis.state.fields import ZOOMS
from rodwell.case.case import Case
from rodwell.errors import NotConvergedError
from rodwell.numerics.continuation.location import bracketed_root
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Peak, Value
from rodwell.strength.cylinder import von_mises
from rodwell.strength.loaded import LoadedRod, OnMesh, on_mesh
from rodwell.strength.section import rod_section
from rodwell.strength.supports import most_used

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

LOOKS = 17
"""Forces at which the straight rod is looked at for one that it bears."""

STRAIGHT_LOAD_NOISE = 1e-12
"""Relative error of a load found for the straight rod."""


@dataclass(frozen=True)
class Limit:
    """A load at which something gives.

    Attributes
    ----------
    kind
        Key of ``NAMES``.
    load
        End force F at s = 1 in B/L², tension positive, with its error estimate; None where it is reached at any load.
        Also as ``force`` (or None) and ``error``.
    s
        Where along the rod, None where it is no place.
    buckled
        Whether the rod is buckled there; else it is straight.
    """

    kind: str
    load: Value | None
    s: float | None = None
    buckled: bool = True

    @property
    def force(self) -> float | None:
        """End force F at s = 1 in B/L², tension positive; None where it is reached at any load."""
        return None if self.load is None else self.load.value

    @property
    def error(self) -> float:
        """Error estimate of the force."""
        return 0.0 if self.load is None else self.load.error

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
    size: Callable[[OnMesh, int], tuple[float, float | None]]

    def of(self, state: LoadedRod, zooms: int = ZOOMS) -> tuple[float, float | None]:
        """Largest part used and its place, on the fine mesh."""
        return self.size(state.along[-1], zooms)


def uses(case: Case) -> tuple[Use, ...]:
    """The strengths that a case tells of; not the cylinder's in a curved hole: its moments are not known there."""
    out, rod, scales = [], rod_section(case), case.scales
    if rod is not None and rod.strength is not None:
        out.append(Use(YIELDS, lambda mesh, n: mesh.largest(rod.used, n)))
    if case.cylinder is not None and scales is not None and case.problem.hole is None:
        cylinder = case.cylinder
        bears = cylinder.yield_strength
        out.append(Use(CYLINDER, lambda mesh, n: mesh.largest(lambda f: von_mises(cylinder, f, scales) / bears, n)))
    if case.supports is not None and scales is not None:
        supports = case.supports
        out.append(Use(SUPPORT, lambda mesh, _n: (most_used(mesh, supports, scales), None)))
    return tuple(out)


def limits(case: Case, branch: Branch, buckling: Value, left: Peak | None = None) -> tuple[Limit, ...]:
    """Every limit of a rod on the way to lift-off of its first mode, the least compressive first.

    The way ends at lift-off, or where the shape loses its stability: what lies beyond is not reached. ``buckling`` is
    the load at which the straight rod buckles; where nothing presses it to the wall, it leaves the wall there.
    ``left``: it leaves the wall of a curved hole there, before it buckles.
    """
    if left is not None:
        gives = [_before_buckling(use, branch.problem, buckling.value) for use in uses(case)]
        last = Limit(LIFTS_OFF, buckling, left.s, buckled=False)
        return tuple(sorted([last, *(one for one in gives if one is not None)], key=_force_of, reverse=True))
    end = branch.end_of_the_way
    found = (
        _before_buckling(use, branch.problem, buckling.value) or _on_branch(use, branch, end) for use in uses(case)
    )
    out = [limit for limit in found if limit is not None]
    if end is not None:
        buckled = end.kind != CRITICAL
        kind = LIFTS_OFF if end.kind == LIFT_OFF or branch.lift_off_at_buckling else UNSTABLE
        load = buckling if branch.lift_off_at_buckling else end.load
        out.append(Limit(kind, load, end.s[0] if end.s else None, buckled))
    return tuple(sorted(out, key=_force_of, reverse=True))


def limits_as_it_lies(case: Case, lying: LyingRod) -> tuple[Limit, ...]:
    """Every limit of a rod in a hole that leaves the vertical plane, the least compressive first.

    The way ends where the rod, as it lies, leaves the wall or loses its stability; where it buckles there, as that of
    :func:`limits`.
    """
    end, out = lying.end, list[Limit]()
    last = None if lying.buckled is None else lying.buckled.end_of_the_way
    for use in uses(case):
        found = _as_it_lies(use, lying)
        if found is None and lying.buckled is not None:
            found = _on_branch(use, lying.buckled, last)
        out += [] if found is None else [found]
    for point in (last,) if lying.buckled is not None else (end,):
        if point is not None:
            kind, buckled = (
                LIFTS_OFF if point.kind == LIFT_OFF else UNSTABLE,
                lying.buckled is not None and point.after > 0,
            )
            out.append(Limit(kind, point.load, point.s[0] if point.s else None, buckled))
    return tuple(sorted(out, key=_force_of, reverse=True))


def _as_it_lies(use: Use, lying: LyingRod) -> Limit | None:
    """Where a strength is used up by the rod as it lies; None if it is not before the end of its way.

    Where it is used up at rest already, tension may relieve it; if not, it is at any load followed.
    """
    part, place = use.of(LoadedRod("", lying.problem, lying.rest.force, solution=lying.rest))
    if part < 1.0:
        found = _on_branch(use, lying.pressed, lying.end)
    else:
        relieved = (
            i for i, state in enumerate(lying.pulled)
            if use.of(LoadedRod("", lying.problem, state.force, solution=state))[0] < 1.0
        )  # fmt: skip
        first = next(relieved, None)
        found = Limit(use.kind, None, s=place) if first is None else _located(use, lying.pulled, first - 1)
    return None if found is None else replace(found, buckled=False)


def _force_of(limit: Limit) -> float:
    return np.inf if limit.force is None else limit.force


def _on_branch(use: Use, branch: Branch, end: SpecialPoint | None) -> Limit | None:
    """Where a strength is used up on the branch up to its end; None if it is not."""
    problem = branch.problem
    if end is not None and end.kind == CRITICAL:
        return None
    last = len(branch) - 1 if end is None else end.after
    for i in range(1, last + 1):
        state = LoadedRod("", problem, branch[i].force, solution=branch[i])
        if use.of(state, 1)[0] >= NEAR and use.of(state)[0] >= 1.0:
            return _located(use, branch, i - 1)
    if end is not None and use.of(LoadedRod("", problem, end.force, solution=end.solution))[0] >= 1.0:
        return _located(use, branch, last)
    return None


def _before_buckling(use: Use, problem: Problem, critical: float) -> Limit | None:
    """Where a strength is used up by the straight rod; None if it is not by its critical load."""
    at_buckling, place = use.of(LoadedRod("", problem, critical))
    if at_buckling < 1.0:
        return None
    return _of_straight(use, problem, critical, at_buckling - 1.0) or Limit(use.kind, None, s=place, buckled=False)


def _of_straight(use: Use, problem: Problem, critical: float, excess: float) -> Limit | None:
    """Where the straight rod uses a strength up before it buckles; None if it does so at any load."""

    def over(share: float) -> float:
        return use.of(LoadedRod("", problem, least + share * (critical - least)))[0] - 1.0

    # what is used is convex in the force, and least where neither end is far from zero force
    forces = [force for force in np.linspace(0.0, problem.hung_weight, LOOKS) if force > critical]
    parts = [use.of(LoadedRod("", problem, float(force)))[0] for force in forces]
    if not parts or min(parts) >= 1.0:
        return None
    least, at_least = float(forces[int(np.argmin(parts))]), min(parts) - 1.0
    force = least + bracketed_root(over, 0.0, 1.0, at_least, excess) * (critical - least)
    load = Value(force, STRAIGHT_LOAD_NOISE * (abs(least) + abs(critical)))
    return Limit(use.kind, load, use.of(LoadedRod("", problem, force))[1], buckled=False)


def _located(use: Use, branch: Branch, i: int) -> Limit:
    """The limit between points i and i+1, located on both meshes.

    If that fails, the last point before it, with the step as its error: the answer then counts as not converged.
    """

    def excess(family: Family, state: State) -> float:
        return use.size(on_mesh(branch.problem, family, state), ZOOMS)[0] - 1.0

    try:
        solution, error = branch.zero_between(i, excess)
    except NotConvergedError:
        solution, error = branch[i], abs(branch[i + 1].force - branch[i].force)
    state = LoadedRod("", branch.problem, solution.force, solution=solution)
    return Limit(use.kind, Value(solution.force, error), use.of(state)[1])
