"""Loads at which buckled states lift off or branch, against another parameter."""

from __future__ import annotations

from collections.abc import Sequence

from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.special import BRANCH_POINT, LIFT_OFF, SpecialPoint
from rodwell.analysis.curves.checks import BECOMES_STRAIGHT
from rodwell.analysis.curves.curve import SWITCH, TURN, Curve, CurvePoint, Mark, Progress, checked_range
from rodwell.analysis.curves.points import CurveStart
from rodwell.analysis.curves.tracing import trace_curve
from rodwell.analysis.curves.zeros import Branching, Touching, TwistAtLiftOff
from rodwell.analysis.loads.torsion import torsion
from rodwell.analysis.straight.critical import critical_loads
from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Along, Parameter, varied
from rodwell.quantities.tolerance import RTOL, checked_rtol

__all__ = ["lift_off_curve", "secondary_curve", "twist_curve"]

NEARLY_WEIGHTLESS = 1e-3
"""Part of a range, next to an end without lateral weight, that the curve leaps over."""


def lift_off_curve(
    problem: Problem,
    over: Parameter | Along,
    limits: Sequence[float],
    *,
    mode: int = 1,
    mirror: bool = False,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> Curve:
    """Lift-off load of a mode's branch as a function of weight, alpha, clearance, twist or curvature.

    Parameters
    ----------
    problem
        The rod; its value of ``over`` does not matter. In a curved hole the loads are those of branches, which take the
        hole where the undeformed rod is.
    over
        "weight", "alpha", "clearance", "twist", or the hole's curvature "build" or "walk" (of a branch that begins
        in a hole in the vertical plane), or a path of one's own, on which several vary: a
        :class:`rodwell.ParameterPath`, or its ``numbers`` alone for a t from 0 to 1.
    limits
        Start and end of the range. Where nothing presses the rod to the wall at the start, lift-off coincides with
        buckling there.
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
    over, start, end = checked_range(problem, over, limits)
    at_start = varied(problem, over, start)
    before: tuple[CurvePoint, ...] = ()
    if at_start.untouched:
        first = critical_loads(at_start, mode, rtol=rtol)[-1]
        before = (CurvePoint(start, first.force, first.error),)
        start += NEARLY_WEIGHTLESS * (end - start)
        at_start = varied(problem, over, start)
    branch = follow(at_start, mode, mirror=mirror, rtol=rtol)
    lift = branch.lift_off
    if lift is None or lift.kind != LIFT_OFF:
        raise NotConvergedError(f"no lift-off at {over} = {start:g}, where the curve starts: {branch.ended_because}")
    zero = Touching(at_start, over)
    at_end = varied(problem, over, end)
    vanishes = at_end.untouched
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
    over: Parameter | Along = "weight",
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
        Range, and the parameter: "weight", "clearance" or "twist", or a path of one's own in these.
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
    over, start, end = checked_range(problem, over, limits, ("weight", "clearance", "twist"))
    at_start = varied(problem, over, start)
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
    zero = Branching(at_start, over, point.solution)
    points, marks, why = trace_curve(zero, CurveStart(start, point.solution), end, progress)
    return Curve("secondary", f"mode {mode}", at_start, over, points, marks, why)


def twist_curve(
    problem: Problem,
    limits: Sequence[float],
    *,
    over: Parameter | Along = "weight",
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
        Range, and the parameter: "weight", "alpha" or "clearance", or a path of one's own in these.
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
    over, start, end = checked_range(problem, over, limits, ("weight", "alpha", "clearance"))
    at_start = varied(problem, over, start).but(twist=0.0)
    prepared = torsion(at_start, mode, mirror=mirror, rtol=rtol)
    if prepared.again is None:
        raise NotConvergedError(f"at {over} = {start:g}: {prepared.meaning} Start the range elsewhere.")
    corners = _switches(at_start, prepared.prepared, over, start, end)
    zero = TwistAtLiftOff(at_start, over, start, prepared.prepared.solution)
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


def _switches(problem: Problem, prepared: SpecialPoint, over: Parameter, start: float, end: float) -> tuple[Mark, ...]:
    """Where the place that lifts off without twist changes: the prepared load, and so the twist, has a corner there."""
    _, marks, _ = trace_curve(Touching(problem, over), CurveStart(start, prepared.solution), end, None)
    turns = [mark.x for mark in marks if mark.kind == TURN]
    ahead = [
        mark for mark in marks if mark.kind == SWITCH and (not turns or abs(mark.x - start) < abs(turns[0] - start))
    ]
    return tuple(sorted(ahead, key=lambda mark: abs(mark.x - start)))
