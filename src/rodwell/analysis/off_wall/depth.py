"""How far a rod is pressed into a soft wall, and which pieces of it are in contact: read off its shape."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rodwell.numerics.stretches.carry import fields_at
from rodwell.numerics.stretches.chain import Shape
from rodwell.quantities.arrays import FloatArray

PER_ELEMENT = 12
"""Places in an element at which the depth is looked at first."""


CLOSE = 1e-14
"""How closely ends of pieces are located, in L."""

SHALLOW = 1e-9
"""Distance from the wall in Δ, in the middle of a piece, that counts as none: events are located no better."""


class Piece(NamedTuple):
    """A piece of the rod, in contact or not, from where to where."""

    on: bool
    left: float
    right: float

    def overlaps(self, other: Piece) -> bool:
        """Whether they have a place in common."""
        return self.left < other.right and other.left < self.right


def depth(shape: Shape, s: FloatArray) -> FloatArray:
    """How far beyond the wall the rod is at places (k,), in Δ; negative: a gap."""
    x, y = fields_at(shape, s)[0][:, 0]
    return np.asarray(np.hypot(x, y) - 1.0)


def _shallow(shape: Shape, left: float, right: float) -> bool:
    """Whether the rod is as good as at the wall between two places at which it is just there."""
    return right - left <= CLOSE or abs(float(depth(shape, np.array([0.5 * (left + right)]))[0])) <= SHALLOW


def contact_pieces(shape: Shape) -> list[Piece]:
    """Contact and gaps in turn, from s = 0."""
    from scipy.optimize import brentq  # noqa: PLC0415 - slow to import

    s = np.concatenate([np.linspace(a, b, PER_ELEMENT, endpoint=False) for a, b in pairwise(shape.places)] + [[1.0]])
    on = depth(shape, s[1:-1]) > 0.0  # ends are held right at the wall
    inner = s[1:-1]
    bounds = [0.0]
    for i in np.flatnonzero(on[1:] != on[:-1]):
        end = float(brentq(lambda t: float(depth(shape, np.array([t]))[0]), inner[i], inner[i + 1], xtol=CLOSE))
        if len(bounds) > 1 and _shallow(shape, bounds[-1], end):
            bounds.pop()  # right where a piece appears it is none
        else:
            bounds.append(end)
    bounds.append(1.0)
    return [Piece(bool(on[0]) ^ bool(i % 2), *ends) for i, ends in enumerate(pairwise(bounds))]
