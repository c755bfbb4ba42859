"""Special points of branches followed in a second parameter: folds, lift-off, loss of symmetry, events of one's own."""

from __future__ import annotations

from dataclasses import replace

from rodwell.analysis.branch.functionals import Number
from rodwell.analysis.branch.special import BRANCH_POINT, EQUAL_ENERGY, FOLD, LIFT_OFF, TOUCH_DOWN, SpecialPoint
from rodwell.analysis.branch.starts import beside
from rodwell.analysis.branch.symmetry import kept_parity
from rodwell.analysis.curves.curve import OVER, TURN, Curve, CurvePoint, Mark, Progress, checked_range
from rodwell.analysis.curves.points import CurveStart, Zero
from rodwell.analysis.curves.secant import CurveLostError
from rodwell.analysis.curves.tracing import trace_curve
from rodwell.analysis.curves.zeros import Branching, Folding, Touching, Vanishing
from rodwell.errors import InputError, NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Along, Parameter, ParameterPath, checked_parameter, words_for

CUSP, ISOLA_CENTRE, RECONNECTION = "cusp", "isola_centre", "reconnection"
"""What it means that a curve of folds turns back: where the load turns back too, both folds become one and are gone (a
cusp); else a closed loop shrinks to a point, or two branches meet there and are connected otherwise beyond."""

KINDS = {LIFT_OFF: "lift-off", TOUCH_DOWN: "touch-down", FOLD: "fold", BRANCH_POINT: "secondary"}
"""Kinds of curves of special points; those of one's own have their own names."""


def special_curve(
    point: SpecialPoint,
    over: Parameter | Along,
    until: float,
    *,
    function: Number | None = None,
    progress: Progress | None = None,
) -> Curve:
    """Follow a special point of a branch in a second parameter: a fold, lift-off, a branch point, an event.

    Parameters
    ----------
    point
        A special point of a branch in the end force, as in ``Branch.special_points``, of kind "fold", "lift_off",
        "touch_down", "equal_energy" or "branch_point" (one at which a symmetric branch loses its symmetry), or one of
        your own.
    over, until
        The second parameter, "weight", "alpha" (degrees), "clearance", "twist", "poisson" or "torsion", and the value
        at which to end. It starts at that of the point, and may turn back on the way. Or a path of one's own that
        begins at the point: a :class:`rodwell.ParameterPath`, or its ``numbers`` alone for a t from 0 to 1.
    function
        For a point of your own: the number that vanishes there, as it was given to :func:`rodwell.follow`.
    progress
        Called with the part of the range that is done.

    Returns
    -------
    Curve
        End forces at s = 1, tension positive. Where a curve of folds turns back, its mark says what that is: "cusp"
        (two folds become one), "isola_centre" (a closed loop of states is born there, or vanishes) or "reconnection"
        (two branches meet and part, connected otherwise).

    Raises
    ------
    InputError
        If the point is of another kind, or an argument is out of range.
    NotConvergedError
        If the curve cannot be started.
    """
    if point.parameter != "force":
        raise InputError("point", point, "must be one of a branch in the end force")
    problem = point.solution.problem
    over, start = _start(problem, over)
    over, start, end = checked_range(problem, over, (start, until))
    if isinstance(over, ParameterPath) and (differ := over.misses(problem, point.force, start)):
        raise InputError("point", point, f"does not lie on the path ({differ}): the path must begin at it")
    zero = _zero(problem, over, point, function)
    try:
        points, marks, why = trace_curve(zero, CurveStart(start, point.solution, along=True), end, progress)
    except CurveLostError as error:
        raise NotConvergedError(f"the curve cannot be started at {over} = {start:g}: {error}") from None
    if point.kind == FOLD:
        marks = tuple(_named(mark, points) if mark.kind == TURN else mark for mark in marks)
    name = f"from F = {point.force:.6g}"
    return Curve(KINDS.get(point.kind, point.kind.replace("_", " ")), name, problem, over, points, marks, why)


def _start(problem: Problem, over: Parameter | Along) -> tuple[Parameter, float]:
    """The second parameter, and its value at a problem; of a path, that at its beginning."""
    parameter = over if isinstance(over, str) else checked_parameter(over, OVER)
    if isinstance(parameter, ParameterPath):
        return parameter, parameter.limits[0]
    value = getattr(problem, parameter) if parameter in OVER else 0.0
    if value is None:
        raise InputError("over", parameter, "must be a number of the problem: it has poisson instead")
    return parameter, float(value)


def _zero(problem: Problem, over: Parameter, point: SpecialPoint, function: Number | None) -> Zero:
    """What vanishes at a special point."""
    if function is not None:
        return Vanishing(problem, over, function)
    if point.kind in (LIFT_OFF, TOUCH_DOWN):
        return Touching(problem, over)
    if point.kind == FOLD:
        return Folding(problem, over)
    if point.kind == EQUAL_ENERGY:
        return Vanishing(problem, over, "energy")
    if point.kind == BRANCH_POINT:
        symmetry = point.solution.point.fine.symmetry
        if symmetry == 0 or kept_parity(problem, symmetry, over) == 0:
            reason = "leaves no symmetry that could be lost: beyond, the branch point becomes folds; follow one of them"
            raise InputError("over", words_for(over), reason)
        return Branching(problem, over, point.solution)
    kinds = ", ".join((*KINDS, EQUAL_ENERGY))
    raise InputError("point", point.kind, f"must be of kind {kinds}; a point of your own needs function")


def _named(mark: Mark, points: tuple[CurvePoint, ...]) -> Mark:
    """What the place is at which a curve of folds turns back."""
    i = next(i for i, point in enumerate(points) if point.x == mark.x)
    before, after = points[i - 1], points[min(i + 1, len(points) - 1)]
    if (before.value - mark.value) * (after.value - mark.value) > 0.0:
        return replace(mark, kind=CUSP, note="two folds become one state, and vanish")
    upper = max(before, after, key=lambda point: point.value)
    if _is_highest(upper):
        return replace(mark, kind=ISOLA_CENTRE, note="a closed loop of states shrinks to a point")
    return replace(mark, kind=RECONNECTION, note="two branches meet and part, connected otherwise")


def _is_highest(fold: CurvePoint) -> bool:
    """Whether the states next to a fold have lower end forces than it has."""
    assert fold.solution is not None
    ways = beside(fold.solution)
    return len(ways) == 2 and max(ways) < 0.0
