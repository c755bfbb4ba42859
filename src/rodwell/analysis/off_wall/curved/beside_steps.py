"""The gaps beside steps of the stiffness of a string in a bend, where they are short: beams of small slopes.

At a step from b₁ to b₂ the hole, of curvature κ, bends the string by κ on both sides, and no wall bears the difference
[b]κ of the moments. Between two places where contact ends, a before the step and c behind it, the string is off the
wall by a height y. From either end b y⁗ = −P, pressed by P₁ and P₂, with y = y′ = y″ = 0 there and the concentrated
forces L and R: b y = L x³/6 − P x⁴/24. At the step y, y′, by‴ and b(κ + y″) go on. That is one equation in c/a, and a
is as the root of [b]κ/P. The force along the string does not count over so short a gap.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import Polynomial

from rodwell.analysis.off_wall.curved.model import K1, RodOffCurvedWall
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.numerics.stretches.carry import Sampler
from rodwell.quantities.arrays import FloatArray

REAL = 1e-9
"""Imaginary part, relative, of a root that is real but for round-off."""


@dataclass(frozen=True)
class ShortGap:
    """A gap at a step of the stiffness: the ``step``, the ends, and b, P and the force at the end on either side."""

    step: float
    ends: tuple[float, float]
    stiffness: tuple[float, float]
    pressed: tuple[float, float]
    forces: tuple[float, float]

    def heights(self, s: FloatArray) -> FloatArray:
        """Height above the wall in L, slope and second derivative (3, k) at places (k,); zero outside the gap."""
        out = np.zeros((3, s.size))
        for k, (end, b, p, force) in enumerate(zip(self.ends, self.stiffness, self.pressed, self.forces, strict=True)):
            sign = 1.0 - 2.0 * k
            here = (s > self.ends[0]) & (s < self.ends[1]) & ((s < self.step) == (k == 0))
            x = sign * (s[here] - end)
            out[0, here] = (force * x**3 / 6.0 - p * x**4 / 24.0) / b
            out[1, here] = sign * (force * x**2 / 2.0 - p * x**3 / 6.0) / b
            out[2, here] = (force * x - p * x**2 / 2.0) / b
        return out


def short_gap(
    step: float, stiffness: tuple[float, float], pressed: tuple[float, float], bend: float
) -> ShortGap | None:
    """The gap at a step of the stiffness in a hole of curvature ``bend`` in 1/L; None where none is like that."""
    (b1, b2), (p1, p2) = stiffness, pressed
    if p1 <= 0.0 or p2 <= 0.0:
        return None
    r, whole = Polynomial([0.0, 1.0]), Polynomial([p1, p2])  # with a = 1, c = r: L + R is the whole push
    by_slope = Polynomial([0.5 / b1]) - 0.5 / b2 * r**2  # these times L are the others
    by_height = Polynomial([1.0 / (6.0 * b1)]) + r**3 / (6.0 * b2)
    slope = Polynomial([p1 / (6.0 * b1)]) - (0.5 * whole * r**2 - p2 / 6.0 * r**3) / b2
    height = Polynomial([p1 / (24.0 * b1)]) + (whole * r**3 / 6.0 - p2 / 24.0 * r**4) / b2
    for root in (slope * by_height - height * by_slope).roots():
        c = float(root.real)
        if c <= 0.0 or abs(root.imag) > REAL * c:
            continue
        left = float(height(c) / by_height(c))
        right = p1 + p2 * c - left
        jump = left - 0.5 * p1 - (right * c - 0.5 * p2 * c**2)
        if left > 0.0 and right > 0.0 and (b2 - b1) * bend * jump > 0.0:
            a = float(np.sqrt((b2 - b1) * bend / jump))
            return ShortGap(step, (step - a, step + c * a), stiffness, pressed, (left * a, right * a))
    return None


def short_gaps(model: RodOffCurvedWall, load: float) -> list[ShortGap]:
    """The gaps at all steps of the stiffness alone, at an end force; as if they were short against their sections."""
    rod, out = model.problem.rod, []
    for step in map(float, rod.steps_of_stiffness_alone):
        sides = np.array([np.nextafter(step, 0.0), np.nextafter(step, 1.0)])
        bend, b, pressed = model.beside(sides)[K1], rod.stiffness(sides), model.pressed(sides, load)
        gap = short_gap(step, (float(b[0]), float(b[1])), (float(pressed[0]), float(pressed[1])), float(bend[0]))
        if gap is not None:
            out.append(gap)
    return out


def with_short_gaps(
    model: RodOffCurvedWall, pattern: Pattern, breaks: FloatArray, sample: Sampler, gaps: list[ShortGap]
) -> tuple[Pattern, FloatArray, Sampler]:
    """A pattern found with a beam, with these gaps where it has others between the same neighbours, or none.

    With it the ends of its stretches, and a sampler that has the string on the lower side of the hole there.
    """
    touching, bounds, taken = list(pattern.touching), [0.0, *map(float, breaks), 1.0], []
    corners = model.problem.rod.breaks
    for gap in gaps:
        k = min(int(np.searchsorted(bounds, gap.step, side="right")) - 1, len(touching) - 1)
        alone = np.count_nonzero((corners >= bounds[k]) & (corners <= bounds[k + 1])) == 1
        if touching[k] and bounds[k] < gap.ends[0] and gap.ends[1] < bounds[k + 1]:
            touching[k : k + 1], bounds[k + 1 : k + 1] = [True, False, True], gap.ends
            taken.append((*gap.ends, gap))
        elif not touching[k] and alone and all(touching[k - 1 : k + 2 : 2]) and 0 < k < len(touching) - 1:
            first, last = bounds[k : k + 2]
            if bounds[k - 1] < gap.ends[0] and gap.ends[1] < bounds[k + 2]:
                bounds[k : k + 2] = gap.ends
                taken.append((min(first, gap.ends[0]), max(last, gap.ends[1]), gap))

    def lying(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, angle = sample(s)
        for first, last, gap in taken:
            here = (s >= first) & (s <= last)
            fields[0][:, here] = gap.heights(s[here]) / model.problem.clearance
            fields[0, 0, here] -= model.problem.rod.clearance(s[here])
            angle[:, here] = 0.0
        return fields, angle

    return replace(pattern, touching=tuple(touching)), np.array(bounds[1:-1]), lying
