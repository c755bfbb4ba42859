"""Loads at which buckled states lift off or branch, against another parameter."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import BRANCH_POINT, LIFT_OFF, SpecialPoint
from rodwell.analysis.branch.starts import kept_parity
from rodwell.analysis.curves.checks import BECOMES_STRAIGHT
from rodwell.analysis.curves.curve import SWITCH, TURN, Curve, CurvePoint, Mark, Progress, checked_range
from rodwell.analysis.curves.points import CurveStart, PlanePoint, Zero
from rodwell.analysis.curves.tracing import trace_curve
from rodwell.analysis.discrete.family import path, spline_ends
from rodwell.analysis.loads.torsion import torsion
from rodwell.analysis.straight.critical import critical_loads
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import RTOL, checked_rtol

__all__ = ["lift_off_curve", "secondary_curve", "twist_curve"]

NEARLY_WEIGHTLESS = 1e-3
"""Part of a range, next to an end without lateral weight, that the curve leaps over."""


def lift_off_curve(
    problem: Problem,
    over: str,
    limits: Sequence[float],
    *,
    mode: int = 1,
    mirror: bool = False,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> Curve:
    """Lift-off load of a mode's branch as a function of weight, alpha, clearance or twist.

    Parameters
    ----------
    problem
        The rod; its value of ``over`` does not matter.
    over
        "weight", "alpha", "clearance" or "twist".
    limits
        Start and end of the range. Where lateral weight vanishes at the start, lift-off coincides with buckling there.
    mode, mirror
        Number of the mode, at the start of the range, and its arm. The curve stays on the branches of that mode, also
        where another one buckles first.
    rtol, progress
        Tolerance as for :func:`rodwell.follow`; called with the part done.

    Returns
    -------
    Curve
        End forces at s = 1, with the places that lift off; where the place jumps, a mark "switch".
    """
    rtol = checked_rtol(rtol)
    start, end = checked_range(problem, over, limits)
    at_start = problem.but(**{over: start})
    before: tuple[CurvePoint, ...] = ()
    if at_start.lateral_weight == 0.0:
        first = critical_loads(at_start, mode, rtol=rtol)[-1]
        before = (CurvePoint(start, first.force, first.error),)
        start += NEARLY_WEIGHTLESS * (end - start)
        at_start = problem.but(**{over: start})
    branch = follow(at_start, mode, mirror=mirror, rtol=rtol)
    lift = branch.lift_off
    if lift is None or lift.kind != LIFT_OFF:
        raise NotConvergedError(f"no lift-off at {over} = {start:g}, where the curve starts: {branch.ended_because}")
    zero = _Touching(problem, over)
    at_end = problem.but(**{over: end})
    vanishes = at_end.lateral_weight == 0.0
    traced = end - NEARLY_WEIGHTLESS * (end - start) if vanishes else end
    points, marks, why = trace_curve(zero, CurveStart(start, lift.solution), traced, progress)
    if vanishes and why in ("end", BECOMES_STRAIGHT):
        last = min(critical_loads(at_end, mode + 3, rtol=rtol), key=lambda m: abs(m.force - points[-1].value))
        points, why = (*points, CurvePoint(end, last.force, last.error)), "end"
    name = f"mode {mode}" + (", mirror arm" if mirror else "")
    return Curve("lift-off", name, at_start, over, before + points, marks, why)


def secondary_curve(
    problem: Problem,
    limits: Sequence[float],
    *,
    over: str = "weight",
    mode: int = 1,
    number: int = 1,
    until: float | None = None,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> Curve:
    """Load at which a symmetric branch loses its symmetry, as a function of weight, clearance or twist.

    Parameters
    ----------
    problem
        The rod, the same seen from both ends (horizontal, equal ends).
    limits, over
        Range, and the parameter: "weight", "clearance" or "twist".
    mode
        Number of the mode on whose branch the secondary bifurcation lies, at the start of the range.
    number
        Which branch point on it, in the direction of travel.
    until
        End force to which the branch is searched for it, by default 8 times the scale of load of the mode beyond it.
    rtol, progress
        As for :func:`lift_off_curve`.

    Returns
    -------
    Curve
        End forces at s = 1 of the secondary bifurcation.
    """
    rtol = checked_rtol(rtol)
    start, end = checked_range(problem, over, limits, ("weight", "clearance", "twist"))
    at_start = problem.but(**{over: start})
    if not at_start.symmetric:
        raise InputError("alpha", problem.alpha, "must be 90, with equal ends: else no branch has a symmetry to lose")
    first = critical_loads(at_start, mode, rtol=rtol)[-1]
    reach = first.force - 8.0 * first.wavenumber**2 if until is None else until
    branch = follow(at_start, first, until=reach, rtol=rtol)
    bifurcations = [p for p in branch.special_points if p.kind == BRANCH_POINT]
    if len(bifurcations) < number:
        raise NotConvergedError(
            f"mode {mode} has {len(bifurcations)} secondary bifurcations down to F = {branch.force.min():.6g} B/L² at "
            f"{over} = {start:g}: start elsewhere, or give until"
        )
    point = bifurcations[number - 1]
    zero = _Branching(problem, over, point.solution)
    points, marks, why = trace_curve(zero, CurveStart(start, point.solution), end, progress)
    return Curve("secondary", f"mode {mode}", at_start, over, points, marks, why)


def twist_curve(
    problem: Problem,
    limits: Sequence[float],
    *,
    over: str = "weight",
    mode: int = 1,
    mirror: bool = False,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> Curve:
    """Twist at which a rod prepared at its lift-off load, and twisted so that it settles, lifts off again.

    Paper, section 4.2 and Fig. 11. At each value of the parameter the end force is the lift-off load without twist.

    Parameters
    ----------
    problem
        The rod, ``twist`` 0.
    limits, over
        Range, and the parameter: "weight", "alpha" or "clearance".
    mode, mirror
        Mode at the start of the range, and its arm.
    rtol, progress
        As for :func:`lift_off_curve`.

    Raises
    ------
    NotConvergedError
        Also if either sense of twist makes the rod lift off at once (modes that touch at two places).

    Notes
    -----
    Where the place that lifts off without twist changes, the prepared load has a corner, and with it this curve: also
    a mark "switch".
    """
    rtol = checked_rtol(rtol)
    start, end = checked_range(problem, over, limits, ("weight", "alpha", "clearance"))
    at_start = problem.but(**{over: start, "twist": 0.0})
    prepared = torsion(at_start, mode, mirror=mirror, rtol=rtol)
    if prepared.again is None:
        raise NotConvergedError(f"at {over} = {start:g}: {prepared.meaning} Start the range elsewhere.")
    corners = _switches(at_start, prepared.prepared, over, end)
    zero = _TwistAtLiftOff(at_start, over, prepared.prepared.solution)
    points: list[CurvePoint] = []
    marks: list[Mark] = []
    why, seed = "end", CurveStart(start, prepared.again.solution)
    for corner in (*corners, None):
        piece, more, why = trace_curve(zero, seed, end if corner is None else corner.x, progress)
        points += piece[1:] if points else piece
        marks += more
        last = points[-1]
        if why != "end" or corner is None or last.solution is None:
            break
        note = f"without twist, {corner.note}"
        marks.append(Mark(SWITCH, corner.x, corner.x_error, last.value, last.error, note))
        seed = CurveStart(corner.x, last.solution)
    name = f"mode {mode}" + (", mirror arm" if mirror else "")
    return Curve("twist", name, at_start, over, tuple(points), tuple(marks), why)


def _switches(problem: Problem, prepared: SpecialPoint, over: str, end: float) -> tuple[Mark, ...]:
    """Where the place that lifts off without twist changes: the prepared load, and so the twist, has a corner there."""
    start = float(getattr(problem, over))
    _, marks, _ = trace_curve(_Touching(problem, over), CurveStart(start, prepared.solution), end, None)
    turns = [mark.x for mark in marks if mark.kind == TURN]
    ahead = [
        mark for mark in marks if mark.kind == SWITCH and (not turns or abs(mark.x - start) < abs(turns[0] - start))
    ]
    return tuple(sorted(ahead, key=lambda mark: abs(mark.x - start)))


class _Touching(Zero):
    """Lift-off: the contact pressure at its maximum vanishes."""

    touch = True

    def __init__(self, problem: Problem, over: str, load: str = "force") -> None:
        super().__init__(over, load)
        self.problem = problem

    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        return _along_force(self.problem, self.over, meshes, spot)

    def solution(self, meshes: TwoMeshes, point: MeshedState, spot: PlanePoint) -> Solution:
        return Solution(self.problem.but(**{self.over: spot.x}), point, meshes)

    def function(self, family: Family, state: State) -> float:
        return self.touching.at(family, state)


class _TwistAtLiftOff(_Touching):
    """Second lift-off in twist, at the end force of the first, which is solved for at each value of the parameter."""

    def __init__(self, problem: Problem, over: str, lifting: Solution) -> None:
        super().__init__(problem, over, load="twist")
        self.first, self.lifting = _Touching(problem, over), lifting

    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        if spot.x != getattr(self.lifting.problem, self.over):
            near = CurveStart(spot.x, self.lifting)
            self.lifting = self.first.solve(near.meshes, near.guess, PlanePoint(spot.x, self.lifting.force)).solution
        problem = self.problem.but(**{self.over: spot.x})
        parity = kept_parity(problem, meshes.coarse.parity, "twist")
        return meshes.on_path(path(problem, "twist", self.lifting.force), spline_ends(problem), parity)

    def solution(self, meshes: TwoMeshes, point: MeshedState, spot: PlanePoint) -> Solution:
        return Solution(self.problem.but(**{self.over: spot.x, "twist": spot.value}), point, meshes)


class _Branching(Zero):
    """Loss of symmetry: an eigenvalue of the Hessian vanishes."""

    touch = False

    def __init__(self, problem: Problem, over: str, branching: Solution) -> None:
        super().__init__(over, "force")
        self.problem, self.softest = problem, _Softest(branching)

    def meshes(self, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
        return _along_force(self.problem, self.over, meshes, spot)

    def solution(self, meshes: TwoMeshes, point: MeshedState, spot: PlanePoint) -> Solution:
        return Solution(self.problem.but(**{self.over: spot.x}), point, meshes)

    def function(self, family: Family, state: State) -> float:
        return self.softest(family, state)


def _along_force(problem: Problem, over: str, meshes: TwoMeshes, spot: PlanePoint) -> TwoMeshes:
    """The same meshes with the equilibria along the end force at ``spot``."""
    problem = problem.but(**{over: spot.x})
    parity = kept_parity(problem, meshes.coarse.parity, over)
    return meshes.on_path(path(problem, "force", spot.value), spline_ends(problem), parity)


class _Softest:
    """The eigenvalue that vanishes at a branch point, followed by its vector."""

    def __init__(self, branching: Solution) -> None:
        self.vectors: dict[int, np.ndarray] = {}
        self.parity = -branching.point.fine.symmetry

    def __call__(self, family: Family, state: State) -> float:
        size = state.c.size
        if size not in self.vectors:
            vector = np.random.default_rng(0).standard_normal(size)
            self.vectors[size] = vector + self.parity * vector[::-1]
            family.nearest_curvature(state, self.vectors[size], 8)
        return family.nearest_curvature(state, self.vectors[size], 3)[0]
