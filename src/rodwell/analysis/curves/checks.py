"""What two or three points of a curve tell: whether it leapt, became straight, or turned back between them."""

from __future__ import annotations

import math

import numpy as np

from rodwell.analysis.curves.points import NearbyStates, SolvedPoint
from rodwell.numerics.splines.spaces import Prolongation
from rodwell.quantities.arrays import FloatArray

BECOMES_STRAIGHT = "the buckled rod becomes straight"
STRAIGHT = 1e-3
"""Amplitude, in radians around the cylinder, below which a curve of buckled states ends."""

CLEAR, TINY = 0.3, 1e-4
"""Cosine between tangents, and share of the load in them, from which their senses can be compared."""


def on_meshes(guess: NearbyStates, a: SolvedPoint, b: SolvedPoint) -> NearbyStates:
    """Coefficients on the meshes of one point as those on the meshes of another, the same or finer ones."""
    return NearbyStates(carried(guess.coarse, a, b, 0), carried(guess.fine, a, b, 1))


def carried(c: FloatArray, a: SolvedPoint, b: SolvedPoint, mesh: int) -> FloatArray:
    """Coefficients of a point on the meshes of another, the same or finer ones."""
    old, new = a.solution.levels[mesh][0].space, b.solution.levels[mesh][0].space
    return c if old.size == new.size else Prolongation(old, new)(c)


def vertex(three: list[tuple[float, float]]) -> float | None:
    """Place of the vertex of the parabola through three points; None for a straight line."""
    (a, fa), (b, fb), (c, fc) = three
    left, right = (b - a) * (fb - fc), (b - c) * (fb - fa)
    return None if left == right else b - 0.5 * ((b - a) * left - (b - c) * right) / (left - right)


def bracket(points: list[tuple[float, SolvedPoint]]) -> list[tuple[float, SolvedPoint]]:
    """Of points in order of place, the one with the extreme x and its neighbours."""
    points = sorted(points, key=lambda item: item[0])
    x = np.array([point.spot.x for _, point in points])
    sense = 1.0 if x[1:-1].max() >= max(x[0], x[-1]) else -1.0
    i = 1 + int(np.argmax(sense * x[1:-1]))
    return points[i - 1 : i + 2]


def leapt(a: SolvedPoint, b: SolvedPoint) -> bool:
    """Whether a step leapt to another curve, where two modes exchange their roles and curves come close.

    At a fixed parameter the equilibria turn back in the load where one eigenvalue of the Hessian changes its sign, and
    nowhere else (but where a symmetry is lost, which is no matter here): the two must agree.
    """
    family = b.solution.meshes.fine
    if family.parity != 0:
        return False
    one, other = a.solution.point.fine, b.solution.point.fine
    turned = float(other.row @ carried(one.tangent, a, b, 1)) + other.row_lam * one.tangent_lam
    shares = [abs(state.tangent_lam) / family.lam_scale for state in (one, other)]
    if abs(turned) < CLEAR or min(shares) < TINY:
        return False
    return (-1.0) ** (other.index - one.index) * one.tangent_lam * other.tangent_lam * turned < 0.0


def straightens(a: SolvedPoint, b: SolvedPoint) -> bool:
    """Whether the rod becomes straight on the way: nearly so, or buckled to the other side."""
    before, after = (np.max(np.abs(point.guess.fine)) / point.solution.problem.clearance for point in (a, b))
    turned = a.guess.fine.size == b.guess.fine.size and a.guess.fine @ b.guess.fine < 0.0
    return bool(after < min(before, STRAIGHT) or turned)


def error_at_turn(
    around: list[tuple[float, SolvedPoint]], close: list[tuple[float, SolvedPoint]], x_error: float
) -> float:
    """How far the load of the middle one of three ``close`` points may be from that where x is extremal.

    x is as extremal as it is known to be within √(2 x_error/|x″|) of that place, where the load may change: by the
    slope that it has there, and by its curvature, which ``around`` tells, three points farther apart. Where the load
    turns back too, at a cusp, it has no slope.
    """
    (x_bend, _), (bend, _) = (_parabola([(t, of(point)) for t, point in around]) for of in (_x_of, _load_of))
    before, here, after = (_load_of(point) for _, point in around)
    cusp = (before - here) * (after - here) > 0.0
    slope = 0.0 if cusp else _parabola([(t, _load_of(point)) for t, point in close])[1]
    far = max(abs(around[0][0] - around[1][0]), abs(around[2][0] - around[1][0]))
    within = min(math.sqrt(2.0 * x_error / abs(x_bend)), far) if x_bend != 0.0 else far
    return abs(slope) * within + 0.5 * abs(bend) * within**2


def _x_of(point: SolvedPoint) -> float:
    return point.spot.x


def _load_of(point: SolvedPoint) -> float:
    return point.spot.value


def _parabola(three: list[tuple[float, float]]) -> tuple[float, float]:
    """Second derivative, and slope at the middle, of the parabola through three points."""
    (a, fa), (b, fb), (c, fc) = three
    left, right = (fb - fa) / (b - a), (fc - fb) / (c - b)
    bend = 2.0 * (right - left) / (c - a)
    return bend, left + 0.5 * bend * (b - a)
