"""Patterns of contact: which stretches touch the wall, and chains of elements for them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate, pairwise

import numpy as np

from rodwell.analysis.discrete.curved import stations_along
from rodwell.numerics.stretches.chain import ANGLE, ANGLE_RATE, RADIAL_SLOPE, RADIUS, Chain
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray

DEGREE = 9
"""Degree of the elements of the coarse chain; the fine one has two more."""

FINER = 2

WAVES = 0.55
"""Length of an element, times the wavenumber √|F| of a beam column, in units of half-waves."""

BEFORE = 1e-9
"""Part of an element that ends at a station, before which the hole is that of its side."""

APART = 0.01
"""Stations of the hole nearer to each other, to a step or to an end of the rod, in L, are left to the elements."""

Elements = tuple[tuple[int, ...], ...]
"""Numbers of elements of each stretch, in each of the pieces into which steps between sections part it."""


@dataclass(frozen=True)
class Pattern:
    """Stretches from s = 0: True in contact. Between two free ones lies a point of contact.

    ``turns`` is the angle at s = 1 over 2π where the end holds it. ``planar``: the rod lies in the plane through its
    ends and the hole's axis, and nothing but a disturbance takes it out. ``fixed``: where elements end too, of a rod
    behind a soft wall, which is one free stretch: there its contact ends. ``edges``: steps of the clearance, within
    free stretches, at which the rod touches the edge of the narrower part, and loose ends of it that touch the wall:
    points of contact whose place is known. ``stopped``: a planar rod without lateral weight touches a soft wall, which
    keeps it from turning about the line between its ends.
    """

    touching: tuple[bool, ...]
    turns: float = 0
    planar: bool = False
    fixed: tuple[float, ...] = ()
    edges: tuple[float, ...] = ()
    stopped: bool = False

    @property
    def breaks(self) -> int:
        """How many ends of stretches lie within the rod."""
        return len(self.touching) - 1

    @property
    def full(self) -> bool:
        """Whether the rod is in contact everywhere."""
        return self.touching == (True,)

    def is_point(self, i: int) -> bool:
        """Whether break ``i`` is a point of contact."""
        return not (self.touching[i] or self.touching[i + 1])

    def between_points(self, i: int) -> bool:
        """Whether stretch ``i`` is a gap between two points of contact."""
        return 0 < i < self.breaks and self.is_point(i - 1) and self.is_point(i)

    def text(self) -> str:
        """The pattern in a few signs: = contact, - free, · point of contact."""
        out = ""
        for i, on in enumerate(self.touching):
            out += ("·" if i and self.is_point(i - 1) else "") + ("=" if on else "-")
        return out


def end_held(problem: Problem, last: bool, turns: float, radius: float) -> tuple[BoolArray, FloatArray]:
    """What an end holds of (r, φ, r′, φ′), and at which values (NaN where it does not): (4,) each.

    Clamped, pinned, guided and free ends are radially held; a ball joint holds the place only. ``radius``: of the disc
    there.
    """
    end = problem.ends[1 if last else 0]
    values = np.array([radius, 2.0 * math.pi * turns if last else 0.0, 0.0, 0.0])
    held = np.zeros(4, dtype=bool)
    held[RADIUS] = end != "loose"
    held[ANGLE] = end in ("clamped", "pinned", "ball")
    held[RADIAL_SLOPE] = end in ("clamped", "pinned", "guided", "free")
    held[ANGLE_RATE] = end in ("clamped", "guided")
    if not last and problem.untouched and not problem.holds_angle:
        held[ANGLE] = True
    return held, np.where(held, values, np.nan)


def pieces_of(problem: Problem, fixed: tuple[float, ...] = ()) -> tuple[FloatArray, IntArray]:
    """Places (n,) at which elements end wherever stretches do, and in which section each piece between them lies.

    At steps of a string, and at stations of the hole, where the second derivative of its curvature jumps.
    """
    steps = problem.rod.breaks[1:-1]
    corners = np.union1d(np.union1d(steps, _stations(problem)), fixed)
    return corners, np.concatenate([[0], np.cumsum(np.isin(corners, steps))]).astype(np.int64)


@lru_cache(maxsize=64)
def _stations(problem: Problem) -> tuple[float, ...]:
    """Places of stations of the hole along the undeformed rod; of those that are close together one, none by a step.

    None of strings, of which those away from ends of stretches are fixed: see :mod:`rodwell.analysis.off_wall.arrange`.
    """
    kept: list[float] = []
    if problem.hole is not None and not problem.sections:
        steps = problem.rod.breaks
        for s in map(float, stations_along(problem)):
            if s - (kept[-1] if kept else 0.0) >= APART and float(np.min(np.abs(steps - s))) >= APART:
                kept.append(s)
    return tuple(kept)


def last_place(problem: Problem, left: FloatArray, right: FloatArray) -> FloatArray | float:
    """Up to where elements have the hole of their side: at stations, where some end, the contact jumps; or no limit."""
    return right - BEFORE * (right - left) if problem.hole is not None and _stations(problem) else np.inf


def corners_within(corners: FloatArray, elements: Elements, bounds: FloatArray | None) -> list[range]:
    """Which of the corners each stretch holds: as its elements do; or by place, with the ends of all stretches.

    The latter of strings in bends, where elements end at fixed places besides.
    """
    if bounds is not None:
        return [range(*np.searchsorted(corners, ends)) for ends in pairwise(bounds)]
    first = [0, *accumulate(len(pieces) - 1 for pieces in elements)]
    return [range(a, b) for a, b in pairwise(first)]


def counts(
    breaks: FloatArray, steps: FloatArray, wavenumbers: FloatArray, waves: float = WAVES, fewest: int = 1
) -> Elements:
    """How many elements each piece of each stretch gets: ``waves`` of them in a half-wave, and so many of the whole.

    Steps (n − 1,) part a stretch into pieces, ``wavenumbers`` (n,) are those between the steps.
    """
    bounds, out = np.concatenate([[0.0], breaks, [1.0]]), []
    for left, right in pairwise(bounds):
        first, last = np.searchsorted(steps, left, side="right"), np.searchsorted(steps, right, side="left")
        lengths = np.diff(np.concatenate([[left], steps[first:last], [right]]))
        numbers = lengths * wavenumbers[first : last + 1] / (waves * math.pi)
        out.append(tuple(max(1, *map(math.ceil, pair)) for pair in zip(numbers, fewest * lengths, strict=True)))
    return tuple(out)


def chain(
    problem: Problem,
    given: FloatArray,
    pattern: Pattern,
    elements: Elements,
    degree: int,
    corners: FloatArray | None = None,
) -> tuple[Chain, FloatArray]:
    """Elements for a pattern, and the values of what is held (e+1, 4), NaN elsewhere.

    ``given`` (n, g) is what the model knows of each section; ``corners``: in place of those of :func:`pieces_of`.
    """
    sizes = tuple(map(sum, elements))
    total = sum(sizes)
    touching = np.repeat(pattern.touching, sizes)
    first = np.concatenate([[0], np.cumsum(sizes)])  # nodes at ends of stretches
    pieces = np.array([count for stretch in elements for count in stretch])
    owner = np.repeat(np.arange(pieces.size), pieces)
    part = ((np.arange(total) - (np.cumsum(pieces) - pieces)[owner]) / pieces[owner])[:, None]
    ends, section_after = pieces_of(problem, pattern.fixed)
    bounds = _corners(ends if corners is None else corners, elements)
    places = np.concatenate([bounds[owner] * (1.0 - part) + bounds[owner + 1] * part, bounds[-1:]])
    # one piece more at each corner that is fixed, not a break
    section = section_after[owner - np.repeat(np.arange(len(elements)), sizes)]
    radii = problem.rod.clearance.coefficients[section, 0]
    if problem.ramps:  # fields are in units of the clearance where they are
        radii = np.ones_like(radii)
    around = np.minimum(np.append(radii[:1], radii), np.append(radii, radii[-1:]))  # at nodes, of the narrower part
    edges = np.flatnonzero(np.isin(places[:, 0], pattern.edges) & ~places[:, 1:].any(axis=1))
    polar = np.zeros(total + 1, dtype=bool)
    polar[first[1:-1]] = polar[edges] = True
    polar[:-1] |= touching
    polar[1:] |= touching
    held, values = np.zeros((total + 1, 4), dtype=bool), np.full((total + 1, 4), np.nan)
    held[polar, RADIUS] = held[polar, RADIAL_SLOPE] = True
    values[polar, RADIUS], values[polar, RADIAL_SLOPE] = around[polar], 0.0
    held[edges, RADIAL_SLOPE], values[edges, RADIAL_SLOPE] = False, np.nan
    for node, last in ((0, False), (total, True)):
        free_end = problem.ends[1 if last else 0] == "loose" and not touching[-1 if last else 0]
        polar[node] = not free_end or node in edges
        held[node], values[node] = end_held(problem, last, pattern.turns, float(around[node]))
        if node in edges:
            held[node, RADIUS], values[node, RADIUS] = True, around[node]
        if touching[-1 if last else 0]:
            held[node, [RADIUS, RADIAL_SLOPE]] = True
            values[node, [RADIUS, RADIAL_SLOPE]] = around[node], 0.0
    if pattern.planar and not pattern.stopped and pattern.touching == (False,) and problem.untouched:
        # it may turn about the line between its ends at no cost
        held[total // 2, ANGLE] = True  # the second coordinate, Y: a plane is as good as another
    moving = first[1:-1].astype(np.int64)
    base, shares = places[:, 0], places[:, 1:]
    links = Chain(degree, touching, polar, held, moving, base, shares, given[section], radii, edges, pattern.planar)
    return links, values


def _corners(steps: FloatArray, elements: Elements) -> FloatArray:
    """Where pieces begin and end, as a fixed place and shares in the breaks, (pieces + 1, 1 + breaks)."""
    m = len(elements) - 1
    corners, step = [np.zeros(1 + m)], 0
    for i, stretch in enumerate(elements):
        for last in [False] * (len(stretch) - 1) + [True]:
            corner = np.zeros(1 + m)
            if not last:
                corner[0], step = steps[step], step + 1
            elif i < m:
                corner[1 + i] = 1.0
            else:
                corner[0] = 1.0
            corners.append(corner)
    return np.stack(corners)
