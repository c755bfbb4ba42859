"""Patterns of contact: which stretches touch the wall, and chains of elements for them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rodwell.numerics.stretches.chain import ANGLE, ANGLE_RATE, RADIAL_SLOPE, RADIUS, Chain
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import BoolArray, FloatArray

DEGREE = 9
"""Degree of the elements of the coarse chain; the fine one has two more."""

FINER = 2

WAVES = 0.55
"""Length of an element, times the wavenumber √|F| of a beam column, in units of half-waves."""


@dataclass(frozen=True)
class Pattern:
    """Stretches from s = 0: True in contact. Between two free ones lies a point of contact.

    ``turns`` is the angle at s = 1 over 2π where the end holds it. ``planar``: the rod lies in the plane through its
    ends and the hole's axis, and nothing but a disturbance takes it out. ``fixed``: where stretches end that lie
    behind a soft wall, all of them free: places of its contact, given and not solved for.
    """

    touching: tuple[bool, ...]
    turns: float = 0
    planar: bool = False
    fixed: tuple[float, ...] = ()

    @property
    def breaks(self) -> int:
        """How many ends of stretches lie within the rod."""
        return 0 if self.fixed else len(self.touching) - 1

    @property
    def full(self) -> bool:
        """Whether the rod is in contact everywhere."""
        return self.touching == (True,)

    def is_point(self, i: int) -> bool:
        """Whether break ``i`` is a point of contact."""
        return not (self.touching[i] or self.touching[i + 1])

    def text(self) -> str:
        """The pattern in a few signs: = contact, - free, · point of contact."""
        out = ""
        for i, on in enumerate(self.touching):
            out += ("·" if i and self.is_point(i - 1) else "") + ("=" if on else "-")
        return out


def end_held(problem: Problem, last: bool, turns: float) -> tuple[BoolArray, FloatArray]:
    """What an end holds of (r, φ, r′, φ′), and at which values (NaN where it does not): (4,) each.

    Clamped, pinned, guided and free ends are radially held; a ball joint holds the place only.
    """
    end = problem.ends[1 if last else 0]
    values = np.array([1.0, 2.0 * math.pi * turns if last else 0.0, 0.0, 0.0])
    held = np.zeros(4, dtype=bool)
    held[RADIUS] = end != "loose"
    held[ANGLE] = end in ("clamped", "pinned", "ball")
    held[RADIAL_SLOPE] = end in ("clamped", "pinned", "guided", "free")
    held[ANGLE_RATE] = end in ("clamped", "guided")
    if not last and problem.lateral_weight == 0.0 and not problem.holds_angle:
        held[ANGLE] = True
    return held, np.where(held, values, np.nan)


def counts(pattern: Pattern, breaks: FloatArray, wavenumber: float) -> tuple[int, ...]:
    """How many elements each stretch gets."""
    lengths = np.diff(np.concatenate([[0.0], pattern.fixed or breaks, [1.0]]))
    return tuple(max(1, math.ceil(length * wavenumber / (WAVES * math.pi))) for length in lengths)


def chain(problem: Problem, pattern: Pattern, elements: tuple[int, ...], degree: int) -> tuple[Chain, FloatArray]:
    """Elements for a pattern, and the values of what is held (e+1, 4), NaN elsewhere."""
    total, m = sum(elements), pattern.breaks
    touching = np.repeat(pattern.touching, elements)
    first = np.concatenate([[0], np.cumsum(elements)])  # nodes at ends of stretches
    base, shares = np.zeros(total + 1), np.zeros((total + 1, m))
    for i, count in enumerate(elements):
        part = np.arange(count + 1) / count
        here = slice(first[i], first[i + 1] + 1)
        base[here], shares[here] = 0.0, 0.0
        if pattern.fixed:
            left, right = (0.0, *pattern.fixed, 1.0)[i : i + 2]
            base[here] = left + (right - left) * part
            continue
        for end, weight in ((i - 1, 1.0 - part), (i, part)):
            if 0 <= end < m:
                shares[here, end] += weight
            elif end == m:
                base[here] += weight
    polar = np.zeros(total + 1, dtype=bool)
    moving = first[1:-1] if m else first[:0]
    polar[moving] = True
    polar[:-1] |= touching
    polar[1:] |= touching
    held, values = np.zeros((total + 1, 4), dtype=bool), np.full((total + 1, 4), np.nan)
    held[polar, RADIUS] = held[polar, RADIAL_SLOPE] = True
    values[polar, RADIUS], values[polar, RADIAL_SLOPE] = 1.0, 0.0
    for node, last in ((0, False), (total, True)):
        free_end = problem.ends[1 if last else 0] == "loose" and not touching[-1 if last else 0]
        polar[node] = not free_end
        held[node], values[node] = end_held(problem, last, pattern.turns)
        if touching[-1 if last else 0]:
            held[node, [RADIUS, RADIAL_SLOPE]] = True
            values[node, [RADIUS, RADIAL_SLOPE]] = 1.0, 0.0
    if (
        pattern.planar and pattern.touching == (False,) and problem.lateral_weight == 0.0
    ):  # it may turn about the line between its ends at no cost
        held[total // 2, ANGLE] = True  # the second coordinate, Y: a plane is as good as another
    links = Chain(degree, touching, polar, held, moving.astype(np.int64), base, shares, pattern.planar)
    return links, values
