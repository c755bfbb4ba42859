"""The hole in which the rod lies: its axis in space, with curvatures k1, k2 in a rotation-minimising frame."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from rodwell.errors import InputError, checked_number
from rodwell.problem.axis import Axis, circle
from rodwell.problem.points import FORM, Rows, checked_points, through_points
from rodwell.problem.stations import COLUMNS, along_stations, checked_stations
from rodwell.quantities.arrays import FloatArray

MOST_CURVATURE = 1e4
CURVATURE_ALLOWED = f"from -{MOST_CURVATURE:g} to {MOST_CURVATURE:g}, a curvature in 1/L"

LENGTHS = (0.98, 1.02)
"""Between which the length of an axis given by points may lie, in L."""

IN_LINE = 1e-11
"""Points that stray less, in L, from a line or a vertical plane lie on it: what remains is round-off."""

UPRIGHT = 1e-9
"""Sines of inclinations below: the hole is vertical there, and has no high side."""

CANNOT_FOLD = 2.0 * math.acos(2.0 / math.pi)
"""Rad. Points s apart on a curve that turns by less, θ, are at least s cos(θ/2) apart in space: where s > πΔ, 2Δ."""


@dataclass(frozen=True)
class Hole:
    """The axis of a hole, in units of the rod's length L.

    Arclength S runs from 0, at the larger measured depth, to 1, where the end force acts; T = dX/dS. The frame
    (N1, N2, T) is right-handed and rotation-minimising: T' = k1 N1 + k2 N2, N1' = −k1 T, N2' = −k2 T. At S = ½ N1 is
    the high side. So k1 > 0 is concave upward (a build section), and −k2 the walk to the right, looking towards S = 0.

    Make it by :meth:`arc` or :meth:`through`. Holes are equal where their attributes are.

    Attributes
    ----------
    alpha
        Angle between T and the vertical at S = ½ in degrees, 0 (T upwards) to 180.
    build, walk
        k1 and −k2 of an arc in 1/L; 0 where ``axis`` is given.
    axis
        Points that the axis goes through, or stations with its direction; empty for an arc.
    """

    alpha: float
    build: float = 0.0
    walk: float = 0.0
    axis: Rows = ()

    @classmethod
    def arc(cls, alpha: float, build: float = 0.0, walk: float = 0.0) -> Hole:
        """Make a hole of constant curvatures: a circle in space, in closed form; a straight one without any.

        Parameters
        ----------
        alpha
            Inclination at mid-length in degrees, 0 to 180.
        build
            k1 in 1/L, positive where the hole is concave upward.
        walk
            −k2 in 1/L, positive to the right looking towards S = 0; not dφ/dS of an azimuth φ, which times sin α it is.

        Raises
        ------
        InputError
            For values out of range, and for a walk at mid-length in a vertical hole, which has no high side there.
        """
        alpha = checked_number("alpha", alpha, 0.0, 180.0, "from 0 to 180 degrees")
        build = checked_number("build", build, -MOST_CURVATURE, MOST_CURVATURE, CURVATURE_ALLOWED)
        walk = checked_number("walk", walk, -MOST_CURVATURE, MOST_CURVATURE, CURVATURE_ALLOWED)
        if walk != 0.0 and alpha in (0.0, 180.0):
            what = f"must be 0 at alpha = {alpha:g}: a vertical hole has no high side to walk from; give build"
            raise InputError("walk", walk, what)
        return cls(alpha, build, walk)

    @classmethod
    def through(cls, points: Sequence[Sequence[float]] | FloatArray) -> Hole:
        """Make a hole whose axis goes through points, or through stations with its direction, its curvature continuous.

        Between points the axis is a spline of degree five in the sum of the chords, with four continuous
        derivatives (of four or five points, one polynomial). Arclength, frame and curvatures are tabulated of it to
        round-off: :attr:`error`, and 1e-15/h² of the curvatures at points h apart. Of a smooth curve it is off by
        O(h⁶). Along stations it is that of :mod:`rodwell.problem.stations`. Beyond its ends the axis goes on with the
        curvatures that it has there.

        Parameters
        ----------
        points
            x, y, z in L, z vertically up, (n, 3), from S = 0 on; or stations (n, 10): arclength S from 0 on, direction
            towards S = 1, its first and its second derivative by S. The length must be 1 within 2 %.

        Raises
        ------
        InputError
            For too few points, points that are not in order along the hole, and another length.
        """
        axis = checked_axis(points)
        table = _table(axis)
        if not LENGTHS[0] <= table.length <= LENGTHS[1]:
            raise InputError(
                "axis",
                f"a curve of length {table.length:.6g}",
                f"must be 1 long, in units of the rod's length, within {LENGTHS[0]:g} to {LENGTHS[1]:g}: "
                "give the piece of the hole from s = 0 to s = 1, divided by the rod's length",
            )
        tangent = table.at(np.array([0.5]))[1][0, 2]
        alpha = math.degrees(math.atan2(math.hypot(tangent[0], tangent[1]), tangent[2]))
        return cls(0.0 if alpha < IN_LINE else alpha, axis=axis)

    @cached_property
    def _axis(self) -> Axis:
        return _table(self.axis)

    @cached_property
    def _middle(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Curvatures (2,), frame (3, 3) and point (3,) of an arc at S = ½, where S = 0 is at the origin."""
        s, c = math.sin(math.radians(min(self.alpha, 180.0 - self.alpha))), math.cos(math.radians(self.alpha))
        c = 0.0 if self.alpha == 90.0 else c
        frame = np.array([[-c, 0.0, s], [0.0, -1.0, 0.0], [s, 0.0, c]])
        curvatures = np.array([self.build, -self.walk])
        first = circle(curvatures, frame, np.zeros(3), np.array([-0.5]))[1][0]
        return curvatures, frame, -first

    def at(self, places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Curvatures (n, 2), frames (n, 3, 3) and points (n, 3) of the axis at arclengths S (n,), see below."""
        places = np.atleast_1d(np.asarray(places, dtype=float))
        if self.axis:
            return self._axis.at(places)
        curvatures, frame, point = self._middle
        return np.tile(curvatures, (places.size, 1)), *circle(curvatures, frame, point, places - 0.5)

    def curvatures(self, places: FloatArray) -> FloatArray:
        """Curvatures k1, k2 in 1/L at arclengths S (n,): (n, 2)."""
        return self.at(places)[0]

    def curvature_rates(self, places: FloatArray) -> FloatArray:
        """Derivatives of k1, k2 by S in 1/L² at arclengths S (n,): (n, 2)."""
        places = np.asarray(places, dtype=float)
        return self._axis.rates(places) if self.axis else np.zeros((places.size, 2))

    def frame(self, places: FloatArray) -> FloatArray:
        """Unit vectors N1, N2, T, the rows of (n, 3, 3), at arclengths S (n,)."""
        return self.at(places)[1]

    def points(self, places: FloatArray) -> FloatArray:
        """Points x, y, z of the axis in L, (n, 3), at arclengths S (n,); an arc begins at the origin."""
        return self.at(places)[2]

    @cached_property
    def upside_down(self) -> Hole:
        """The same hole turned by half a turn about a level axis: a build becomes a drop, the high side the low one.

        S stays where it is, a walk to the right becomes one to the left; of rows x, y, z → x, −y, −z.
        """
        if not self.axis:
            return Hole(180.0 - self.alpha, -self.build, -self.walk)
        half_turn = [1.0, -1.0, -1.0]
        signs = half_turn if len(self.axis[0]) != COLUMNS else [1.0, *half_turn, *half_turn, *half_turn]
        rows = (np.array(self.axis) * signs).tolist()
        return Hole(180.0 - self.alpha, axis=tuple(map(tuple, rows)))

    @property
    def error(self) -> float:
        """How far tabulated frames and points may be from the curve through the points, in 1 and L."""
        return self._axis.error if self.axis else 0.0

    @property
    def breaks(self) -> FloatArray:
        """Arclengths S, rising, between which the axis is smooth; of an arc none, it is smooth throughout."""
        return self._axis.breaks if self.axis else np.empty(0)

    @cached_property
    def stations(self) -> FloatArray:
        """Arclengths S, rising, at which the second derivative of the curvature jumps: stations between the ends."""
        if not self.axis or len(self.axis[0]) != COLUMNS:
            return np.empty(0)
        return np.array([row[0] for row in self.axis[1:-1]])

    @property
    def length(self) -> float:
        """Length of the axis that was given, in L."""
        return self._axis.length if self.axis else 1.0

    @cached_property
    def straight(self) -> bool:
        """Whether the hole is straight."""
        return self.sharpest == 0.0

    @cached_property
    def planar(self) -> bool:
        """Whether the axis lies in the vertical plane through the high side: k2 = 0."""
        return not np.any(self._sampled[1][:, 1])

    @cached_property
    def sharpest(self) -> float:
        """Largest curvature √(k1² + k2²) in 1/L."""
        return float(np.max(np.hypot(*self._sampled[1].T)))

    @cached_property
    def turning(self) -> float:
        """∫ √(k1² + k2²) dS in rad, by the trapezoidal rule."""
        places, curvatures = self._sampled
        return float(np.trapezoid(np.hypot(*curvatures.T), places))

    @property
    def _sampled(self) -> tuple[FloatArray, FloatArray]:
        if self.axis:
            return self._axis.samples
        places = np.array([0.0, 1.0])
        return places, self.curvatures(places)

    def check(self, clearance: float) -> None:
        """Raise where a rod cannot lie in this hole at the distance ``clearance`` (Δ/L) from its axis.

        Raises
        ------
        InputError
            Where the axis is curved with a radius of Δ or less, or comes closer to itself than 2Δ.
        """
        name = "axis" if self.axis else "build" if abs(self.build) >= abs(self.walk) else "walk"
        shown = None if self.axis else getattr(self, name)
        if self.sharpest * clearance >= 1.0:
            raise InputError(
                name,
                shown,
                f"bends the hole with a radius of {1.0 / self.sharpest:.4g} L, which must be above the clearance "
                f"Δ = {clearance:g} L: a wall cannot be bent more sharply than that",
            )
        meeting = _meeting(self, clearance)
        if meeting is not None:
            low, high, distance = meeting
            raise InputError(
                name,
                shown,
                f"makes the hole run into itself: its axis at s = {low:.3g} and at s = {high:.3g} is {distance:.3g} L "
                f"apart, and must be more than 2Δ = {2.0 * clearance:.3g} L",
            )


def checked_axis(axis: object) -> Rows:
    """Return what an axis is given by, points (n, 3) or stations (n, 10), as rows, or raise."""
    try:
        given = np.array(axis, dtype=float)
    except (TypeError, ValueError):
        raise InputError("axis", None, FORM) from None
    if given.ndim == 2 and given.shape[1] == COLUMNS:
        return checked_stations(given)
    return checked_points(given)


@lru_cache(maxsize=32)
def _table(axis: Rows) -> Axis:
    """Table of the axis that is given, N1 the high side in the middle; curves make thousands of problems of one."""
    rows = np.array(axis)
    table = along_stations(rows, np.zeros(3)) if rows.shape[1] == COLUMNS else through_points(rows)
    curvatures, frames, middle = (part[0] for part in table.at(np.array([0.5])))
    high = np.array([0.0, 0.0, 1.0]) - frames[2, 2] * frames[2]
    if np.linalg.norm(high) < UPRIGHT:  # no high side: the side to which it bends, or any
        high = curvatures @ frames[:2] if np.any(curvatures) else frames[0]
    table = table.turned(math.atan2(high @ frames[1], high @ frames[0]))
    normals, points = table.at(np.array([0.5]))[1][0, :2], table.at(table.samples[0])[2]
    in_plane = np.max(np.abs((points - middle) @ normals.T), axis=0) <= IN_LINE
    return table.without(tuple(np.flatnonzero(in_plane).tolist()))


@lru_cache(maxsize=32)
def _meeting(hole: Hole, clearance: float) -> tuple[float, float, float] | None:
    """Two arclengths more than πΔ apart where the axis comes closer than 2Δ to itself, and how close; or None."""
    if hole.turning <= CANNOT_FOLD:
        return None
    from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to import

    places = np.linspace(0.0, 1.0, int(min(20_000, max(400, 4.0 / clearance))))
    _, frames, points = hole.at(places)
    step = places[1]
    pairs = cKDTree(points).query_pairs(2.0 * clearance + step, output_type="ndarray")
    pairs = pairs[pairs[:, 1] - pairs[:, 0] > max(math.pi * clearance / step, 4.0)]
    if not len(pairs):
        return None
    tangents = frames[:, 2]
    low, high = pairs.T
    gap = points[high] - points[low]
    for end, sign in ((low, 1.0), (high, -1.0)):  # the nearest points between the samples, to first order
        shift = np.clip(sign * np.sum(gap * tangents[end], axis=1), -0.5 * step, 0.5 * step)
        shift = np.clip(places[end] + shift, 0.0, 1.0) - places[end]
        gap -= sign * shift[:, None] * tangents[end]
    distance = np.linalg.norm(gap, axis=1)
    nearest = int(np.argmin(distance))
    if distance[nearest] >= 2.0 * clearance:
        return None
    return float(places[low[nearest]]), float(places[high[nearest]]), float(distance[nearest])
