"""A string in a hole, cut into pieces along which everything is constant, from the bit up.

Between two stations the hole is an arc of a circle (minimum curvature). Pieces end at stations, where sections of the
string or of the hole end, and where the memory of the local state does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rodwell.quantities.arrays import FloatArray, IntArray
from rodwell.studies.drag.contact import PIECE
from rodwell.studies.drag.well_case import Operation, Well
from rodwell.survey.survey import Survey

SHORTEST_PIECE = 1e-7
"""Ends of pieces that are closer, in m, are one."""

STRAIGHT_COURSE = 1e-12
"""Doglegs in rad below are none."""

Interval = tuple[float, float]


@dataclass(frozen=True)
class Courses:
    """The arcs between stations, from the top down, (n − 1,) each.

    Attributes
    ----------
    top, bottom
        Measured depths in m.
    curvature
        κ in 1/m.
    cosine, slope
        Cos α and g·N at the upper end; along a straight course N lies in the vertical plane.
    across
        g·b, 0 where the course lies in a vertical plane.
    """

    top: FloatArray
    bottom: FloatArray
    curvature: FloatArray
    cosine: FloatArray
    slope: FloatArray
    across: FloatArray


def courses_of(survey: Survey) -> Courses:
    """Return the arcs of a survey."""
    angle = np.radians(survey.inclination)
    a, b = angle[:-1], angle[1:]
    turn = np.zeros(len(a)) if survey.azimuth is None else np.radians(np.diff(survey.azimuth))
    dogleg = survey.dogleg
    bent = dogleg > STRAIGHT_COURSE
    sine = np.where(bent, np.sin(np.where(bent, dogleg, 1.0)), 1.0)
    # g·N at the upper end: (cos b − cos a cos θ)/sin θ, written so that nothing cancels where θ is small
    rise = 2.0 * (np.cos(a) * np.sin(0.5 * dogleg) ** 2 - np.sin(0.5 * (a + b)) * np.sin(0.5 * (b - a)))
    slope = np.where(bent, rise / sine, -np.sin(a))
    across = np.where(bent, np.sin(a) * np.sin(b) * np.sin(turn) / sine, 0.0)
    length = np.diff(survey.md)
    return Courses(survey.md[:-1], survey.md[1:], np.where(bent, dogleg / length, 0.0), np.cos(a), slope, across)


@dataclass(frozen=True)
class Pieces:
    """The pieces of a string with its bit at some depth.

    Attributes
    ----------
    table
        (k, 12): what kernels take, from the bit up.
    bottom, top
        Measured depths in m of the two ends, (k,).
    section, part
        Numbers of the string's section and of the hole's section, (k,).
    """

    table: FloatArray
    bottom: FloatArray
    top: FloatArray
    section: IntArray
    part: IntArray


class Cutter:
    """Cuts the string of a well into pieces for any depth of the bit; what does not depend on it is kept."""

    def __init__(self, well: Well, friction: Sequence[float] | None = None) -> None:
        self.well = well
        self.courses = courses_of(well.survey)
        self.friction = np.array([part.friction for part in well.hole] if friction is None else friction)
        self.hole_starts = np.array([part.start for part in well.hole])
        self.diameters = np.array([part.diameter for part in well.hole])
        rods = [section.rod for section in well.string]
        self.string_ends = np.cumsum([rod.length for rod in rods])
        self.weights = np.array([section.weight for section in well.string])
        self.stiffness = np.array([rod.stiffness for rod in rods])
        self.radii = np.array([0.5 * (rod.outer_diameter or 0.0) for rod in rods])

    def pieces(
        self,
        operation: Operation,
        depth: float,
        helix_from: float,
        helix_until: float = np.inf,
        remembered: Sequence[Interval] = (),
        longest: float = np.inf,
    ) -> Pieces:
        """Cut the string with its bit at ``depth`` in m.

        Parameters
        ----------
        operation
            Says how friction acts.
        helix_from
            β from which the string is helical.
        helix_until, remembered
            β down to which it stays helical where it was: between these distances above the bit, in m.
        longest
            Longest piece in m.
        """
        courses = self.courses
        edges = [depth - x for pair in remembered for x in pair]
        cuts = np.concatenate([courses.top, self.hole_starts, depth - self.string_ends, edges, [0.0, depth]])
        cuts = np.unique(cuts[(cuts >= 0.0) & (cuts <= depth)])
        keep = np.concatenate([np.diff(cuts) > SHORTEST_PIECE, [True]])
        keep[0] = True
        cuts = cuts[keep]
        if longest < np.inf:
            parts = np.ceil(np.diff(cuts) / longest).astype(int)
            inner = [a + (b - a) * np.arange(n) / n for a, b, n in zip(cuts[:-1], cuts[1:], parts, strict=True)]
            cuts = np.append(np.concatenate(inner), cuts[-1])
        top, bottom = cuts[-2::-1], cuts[:0:-1]
        middle = 0.5 * (top + bottom)
        course = np.clip(np.searchsorted(courses.top, middle, side="right") - 1, 0, len(courses.top) - 1)
        part = np.searchsorted(self.hole_starts, middle, side="right") - 1
        section = np.minimum(np.searchsorted(self.string_ends, depth - middle), len(self.weights) - 1)
        slips = np.array([operation.slip(radius) for radius in self.radii])[section]
        radius, mu = self.radii[section], self.friction[part]
        columns = {
            "length": bottom - top,
            "angle": courses.curvature[course] * (bottom - courses.top[course]),
            "curvature": courses.curvature[course],
            "cosine": courses.cosine[course],
            "slope": courses.slope[course],
            "across": courses.across[course],
            "weight": self.weights[section],
            "ratio": self.stiffness[section] / (0.5 * self.diameters[part] - radius),
            "axial": operation.direction * mu * slips[:, 0],
            "turning": mu * radius * slips[:, 1],
            "stiff": np.zeros(len(middle)),
            "helix_from": np.where(_within(depth - middle, remembered), helix_until, helix_from),
        }
        return Pieces(np.stack([columns[name] for name in PIECE], axis=1), bottom, top, section, part)


def _within(places: FloatArray, intervals: Sequence[Interval]) -> FloatArray:
    inside = np.zeros(len(places), dtype=bool)
    for low, high in intervals:
        inside |= (places > low) & (places < high)
    return inside
