"""The smooth axis of a hole: from the stations of a survey, or the points of a centre line; any piece of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.errors import InputError
from rodwell.problem.axis import Axis
from rodwell.problem.hole import Hole
from rodwell.problem.points import MOST_POINTS, Rows, checked_points, through_points
from rodwell.problem.stations import along_stations, checked_stations, piece_of
from rodwell.quantities.arrays import FloatArray
from rodwell.survey.survey import Survey

IN_A_COURSE = 32
"""Points of a piece of a centre line between neighbouring points of that."""

FEWEST = 64
"""Points of a piece, at least."""

SHARPEST_COURSE = math.radians(60.0)
"""Largest angle between the directions at neighbouring stations that says anything of the hole between them."""

LARGEST_TORTUOSITY = math.radians(5.0)


@dataclass(frozen=True)
class Tortuosity:
    """Deviations of the hole's direction between stations, where nobody measured.

    Attributes
    ----------
    size
        Standard deviation of the direction across the hole, in each of two directions, in rad.
    step
        Distance of places along the hole at which the deviation is drawn, in m; smooth between them, 0 at stations.
    seed
        Of the generator of normal numbers (PCG64).
    """

    size: float
    step: float
    seed: int = 1


@dataclass(frozen=True, eq=False)
class HolePath:
    """The axis of a hole, from the top down: x to the east, y to the north, z upwards, in m.

    Attributes
    ----------
    axis
        As a table by the distance from ``top``.
    top
        Measured depth, or distance along a centre line, at which it begins, in m.
    known
        What it was made from, from 0 on in m: stations (n, 10) of :mod:`rodwell.problem.stations`, or the distances
        (n,) of the points of a centre line.
    survey
        The survey; None for a centre line.
    source
        File name.
    """

    axis: Axis
    top: float
    known: FloatArray
    survey: Survey | None
    source: str

    @property
    def bottom(self) -> float:
        """Measured depth at which it ends, in m."""
        return self.top + self.axis.length

    def points(self, depths: FloatArray) -> FloatArray:
        """Points (n, 3) at measured depths (n,)."""
        return self.axis.at(np.asarray(depths) - self.top)[2]

    def directions(self, depths: FloatArray) -> FloatArray:
        """Unit tangents, downwards along the hole, (n, 3), at measured depths (n,)."""
        return self.axis.at(np.asarray(depths) - self.top)[1][:, 2]

    def piece(self, upper: float, lower: float) -> Piece:
        """The piece between two measured depths, as the hole of a rod.

        Raises
        ------
        InputError
            If it is not within what was measured.
        """
        slack = 1e-9 * self.bottom
        if not self.top - slack <= upper < lower <= self.bottom + slack:
            what = f"{upper:.6g} to {lower:.6g} m"
            reason = (
                f"is not within what {self.source} has, {self.top:.6g} to {self.bottom:.6g} m: the hole must be known "
                "all along the rod; give a shorter rod, another `from` or `to`, or a longer survey"
            )
            raise InputError("hole", what, reason)
        return Piece(self, upper, lower)


@dataclass(frozen=True, eq=False)
class Piece:
    """A piece of a hole between two measured depths in m: s = 1 of the rod in it is at the smaller one."""

    path: HolePath
    upper: float
    lower: float

    @property
    def length(self) -> float:
        """In m."""
        return self.lower - self.upper

    @cached_property
    def axis(self) -> Rows:
        """The axis in units of the length, from s = 0 (below) to s = 1, as :class:`Hole` takes it.

        Of a survey its stations, and so the same curve; of a centre line points of it, close enough together.
        """
        if self.path.survey is not None:
            rows = piece_of(self.path.known, self.upper - self.path.top, self.lower - self.path.top)[::-1]
            rows[:, 0] = (rows[0, 0] - rows[:, 0]) / self.length
            rows[:, 1:] *= np.repeat([-1.0, self.length, -(self.length**2)], 3)  # the other way round
            return checked_stations(rows)
        knots = self.path.known + self.path.top
        inside = knots[(knots > self.upper) & (knots < self.lower)]
        ends = np.concatenate([[self.upper], inside, [self.lower]])
        ends = ends[np.concatenate([[True], np.diff(ends) > 1e-6 * self.length])]
        parts = max(1, -(-FEWEST // (len(ends) - 1)), IN_A_COURSE)
        parts = max(1, min(parts, (MOST_POINTS - 1) // (len(ends) - 1)))
        depths = np.interp(np.arange(parts * (len(ends) - 1) + 1) / parts, np.arange(len(ends)), ends)
        points = self.path.points(depths[::-1])
        return checked_points((points - points[0]) / self.length)

    @cached_property
    def hole(self) -> Hole:
        """The hole of the rod."""
        return Hole.through(self.axis)

    @cached_property
    def turned(self) -> float:
        """Largest angle in rad between the hole's axis and the measured directions, at stations of the piece."""
        if self.path.survey is None:
            return 0.0
        stations = self.path.survey.md
        stations = stations[(stations >= self.upper) & (stations <= self.lower)]
        if not stations.size:
            return 0.0
        there = self.hole.frame((self.lower - stations) / self.length)[:, 2]
        across = np.linalg.norm(np.cross(there, self.path.directions(stations)), axis=1)
        return float(np.max(np.arcsin(np.clip(across, 0.0, 1.0))))

    @cached_property
    def astray(self) -> float:
        """Largest distance in m from the curve of minimum curvature that begins at the upper end with this axis."""
        survey = self.path.survey
        if survey is None:
            return 0.0
        depths = np.union1d(survey.md, 0.5 * (survey.md[1:] + survey.md[:-1]))
        depths = np.union1d(depths[(depths > self.upper) & (depths < self.lower)], [self.upper, self.lower])
        apart = self.path.points(depths) - minimum_curvature(survey, depths)
        return float(np.max(np.linalg.norm(apart - apart[0], axis=1)))


def path_of_survey(survey: Survey, tortuosity: Tortuosity | None = None) -> HolePath:
    """The axis through the stations of a survey, its curvature continuous.

    Stations are depths and directions: these are met, and places follow. Between stations the direction is a
    polynomial of degree five in the measured depth, made a unit vector again, with two continuous derivatives; its
    integral is the axis, with three. Circles are met, what is straight stays straight, and a bend beside a straight
    course begins within its own course. Minimum curvature makes a circle of every course, whose curvature jumps at
    stations.

    Parameters
    ----------
    survey
        Stations; without azimuths in a vertical plane.
    tortuosity
        If asked for: independent normal deviations between stations.

    Raises
    ------
    InputError
        Where neighbouring stations differ by 60 degrees or more, and for a tortuosity out of range.
    """
    widest = int(np.argmax(survey.dogleg))
    if survey.dogleg[widest] >= SHARPEST_COURSE:
        a, b = survey.md[widest], survey.md[widest + 1]
        what = f"turns by {math.degrees(survey.dogleg[widest]):.3g} degrees between {a:g} and {b:g} m"
        raise InputError("survey", survey.source, f"{what}, which leaves open where it goes: add stations between")
    depths, directions = survey.md, station_directions(survey)
    if tortuosity is not None:
        depths, directions = _tortuous(depths, directions, tortuosity)
    start = np.array([survey.east[0], survey.north[0], -survey.tvd[0]])
    stations = _stations(depths - depths[0], directions)
    return HolePath(along_stations(stations, start), float(depths[0]), stations, survey, survey.source)


def path_of_points(points: FloatArray, source: str = "centre line") -> HolePath:
    """The axis through points (n, 3) in m, as :meth:`Hole.through` joins them, from the first on; errors as there."""
    given = np.array(checked_points(points))
    axis = through_points(given)
    chords = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(given, axis=0), axis=1))])
    return HolePath(axis, 0.0, axis.length * chords / chords[-1], None, source)


def station_directions(survey: Survey) -> FloatArray:
    """Unit tangents downwards along the hole at the stations, (n, 3): east, north, up."""
    angle = np.radians(survey.inclination)
    to = np.zeros(len(survey)) if survey.azimuth is None else np.radians(survey.azimuth)
    return np.stack([np.sin(angle) * np.sin(to), np.sin(angle) * np.cos(to), -np.cos(angle)], axis=1)


def minimum_curvature(survey: Survey, depths: FloatArray) -> FloatArray:
    """Points (n, 3) in m, east, north, up, at measured depths (n,) of the survey: every course is a circle."""
    i = np.clip(np.searchsorted(survey.md, depths, side="right") - 1, 0, len(survey) - 2)
    directions, low = station_directions(survey), survey.md[i]
    width, dogleg = np.diff(survey.md)[i], survey.dogleg[i][:, None]
    part = ((depths - low) / width)[:, None]
    ratio = np.sinc(0.5 * dogleg * part / np.pi) ** 2 / (np.sinc(dogleg / np.pi))
    other = 0.5 * part**2 * ratio  # ∫ sin(θp)/sin θ dp
    sums = part * np.sinc(dogleg * part / np.pi) - np.cos(dogleg) * other  # ∫ sin(θ(1 − p))/sin θ dp
    stations = np.stack([survey.east, survey.north, -survey.tvd], axis=1)
    return np.asarray(stations[i] + width[:, None] * (sums * directions[i] + other * directions[i + 1]))


def _tortuous(depths: FloatArray, directions: FloatArray, tortuosity: Tortuosity) -> tuple[FloatArray, FloatArray]:
    """Depths and directions with places between stations, at which directions deviate at random."""
    if not 0.0 < tortuosity.size <= LARGEST_TORTUOSITY:
        allowed = f"must be above 0 and at most {math.degrees(LARGEST_TORTUOSITY):g} deg, a standard deviation"
        raise InputError("tortuosity", f"{math.degrees(tortuosity.size):g} deg", allowed)
    smooth = along_stations(_stations(depths - depths[0], directions), np.zeros(3))
    parts = np.maximum(1, np.rint(np.diff(depths) / tortuosity.step)).astype(int)
    if int(np.sum(parts)) + 1 > MOST_POINTS:
        what = f"makes {int(np.sum(parts)) + 1} places along the hole; at most {MOST_POINTS} are taken"
        raise InputError("tortuosity_step", f"{tortuosity.step:g} m", what)
    finer = [low + width * np.arange(n) / n for low, width, n in zip(depths, np.diff(depths), parts, strict=False)]
    places = np.concatenate([*finer, depths[-1:]])
    _, frames, _ = smooth.at(places - depths[0])
    moved = np.random.default_rng(tortuosity.seed).normal(0.0, tortuosity.size, (places.size, 2))
    moved[np.isin(places, depths)] = 0.0
    out = frames[:, 2] + np.einsum("ni,nic->nc", moved, frames[:, :2])
    return places, out / np.linalg.norm(out, axis=1, keepdims=True)


def _stations(places: FloatArray, directions: FloatArray) -> FloatArray:
    """Stations (n, 10) of :mod:`rodwell.problem.stations` with these directions (n, 3).

    At each place they have a rate and a second derivative from the circles on both sides, limited (after van Albada)
    so that nothing overshoots: what is straight on one side begins straight, circles are met.
    """
    steps = np.diff(places)[:, None]
    after, before = _bends(directions, steps)
    rates = np.concatenate([after[:1], _limited(before[:-1], after[1:], steps[1:], steps[:-1]), before[-1:]])
    ahead = _across((6.0 * after - 4.0 * rates[:-1] - 2.0 * rates[1:]) / steps, directions[:-1])
    behind = _across((-6.0 * before + 2.0 * rates[:-1] + 4.0 * rates[1:]) / steps, directions[1:])
    second = np.zeros_like(rates)
    second[1:-1] = _agreed(behind[:-1], ahead[1:])
    second -= np.sum(rates**2, axis=1, keepdims=True) * directions
    return np.concatenate([places[:, None], directions, rates, second], axis=1)


def _bends(directions: FloatArray, steps: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Curvature vectors of the circles between neighbouring unit vectors, at the beginning and the end of each."""
    low, high = directions[:-1], directions[1:]
    cosine = np.sum(low * high, axis=1, keepdims=True)
    sine = np.linalg.norm(np.cross(low, high), axis=1, keepdims=True)
    angle = np.arctan2(sine, cosine)
    rate = np.where(sine > 0.0, angle / np.where(sine > 0.0, sine, 1.0), 1.0) / steps
    return rate * (high - cosine * low), rate * (cosine * high - low)


def _limited(a: FloatArray, b: FloatArray, weight_a: FloatArray, weight_b: FloatArray) -> FloatArray:
    """Mean of vectors (n, 3) that is zero where one of them is, and theirs where they are equal."""
    of_a, of_b = (w * np.sum(other**2, axis=1, keepdims=True) for w, other in ((weight_a, b), (weight_b, a)))
    whole = of_a + of_b
    return np.asarray((of_a * a + of_b * b) / np.where(whole > 0.0, whole, 1.0))


def _agreed(a: FloatArray, b: FloatArray) -> FloatArray:
    """Mean of vectors (n, 3) as far as they point the same way; zero where they do not."""
    same = np.maximum(0.0, np.sum(a * b, axis=1, keepdims=True))
    whole = np.sum(a**2 + b**2, axis=1, keepdims=True)
    return np.asarray(same * (a + b) / np.where(whole > 0.0, whole, 1.0))


def _across(vectors: FloatArray, directions: FloatArray) -> FloatArray:
    """Parts of vectors (n, 3) perpendicular to unit vectors (n, 3)."""
    return np.asarray(vectors - np.sum(vectors * directions, axis=1, keepdims=True) * directions)
