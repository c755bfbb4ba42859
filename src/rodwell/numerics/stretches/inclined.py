"""Cuts on a rim whose radius varies along s: there the radial moment depends on φ″ too, and so on the bubbles.

Fields are in units of the local radius, so that contact is r = 1, r′ = 0 as elsewhere. The moment that reacts at the
end of a stretch on the rim is the equation of its place; the derivative by φ″, second derivative of an element at one
of its ends, brings the element's nodes and bubbles into its row, these by what they are condensed to.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rodwell.numerics.stretches.basis import ENDS, reference_element
from rodwell.numerics.stretches.chain import Shape
from rodwell.quantities.arrays import FloatArray, IntArray


class ByBend(NamedTuple):
    """What φ″ at cuts adds to the rows of the moments.

    By ``nodes`` (m, n, 4), ``breaks`` (m, m) and ``load`` (m,); ``residual`` (m,): what moments lack as long as the
    bubbles are not in equilibrium.
    """

    nodes: FloatArray
    breaks: FloatArray
    load: FloatArray
    residual: FloatArray


def jet_at_cuts(shape: Shape) -> FloatArray:
    """φ with three derivatives at the cuts (k,), on the side of the rim: (4, k)."""
    cuts = shape.chain.cuts
    return np.asarray(shape.along(cuts.element, cuts.ahead[:, None].astype(float))[0, :, :, 0])


def by_bend(shape: Shape, rim: Any, bend: FloatArray, factors: FloatArray) -> ByBend:
    """The rows of the moments by φ″ at the cuts (k,), with ``factors`` (k,): derivatives of the moments by it.

    ``rim``: the elements on the rim, condensed; ``bend`` (k,): φ″.
    """
    chain, cuts = shape.chain, shape.chain.cuts
    m, n, at = chain.moving.size, chain.elements + 1, cuts.element
    h, (rate0, rate1) = shape.lengths[at], (shape.nodes[at + k, 3] for k in (0, 1))
    c = _plain(reference_element(chain.degree).end_bends[cuts.ahead])
    back = rim.back[np.searchsorted(rim.group, at)]  # (k, b, ends, residual, length, start, load)
    bubbles = -(c[:, None, ENDS:] @ back)[:, 0]
    ends = c[:, :ENDS] * np.stack([np.ones_like(h), h, np.ones_like(h), h], axis=1) + bubbles[:, :ENDS]
    scale = factors / h**2
    lengthen = c[:, 1] * rate0 + c[:, 3] * rate1 - 2.0 * h * bend + bubbles[:, ENDS + 1]
    out = ByBend(np.zeros((m, n, 4)), np.zeros((m, m)), np.zeros(m), np.zeros(m))
    for node, columns in ((at, ends[:, :2]), (at + 1, ends[:, 2:])):
        np.add.at(out.nodes, (cuts.number[:, None], node[:, None], _RIM), scale[:, None] * columns)
    moved = lengthen[:, None] * chain.longer[at] + bubbles[:, ENDS + 2, None] * chain.shares[at]
    np.add.at(out.breaks, cuts.number, scale[:, None] * moved)
    np.add.at(out.load, cuts.number, scale * bubbles[:, ENDS + 3])
    np.add.at(out.residual, cuts.number, scale * bubbles[:, ENDS])
    return out


_RIM: IntArray = np.array([1, 3])
"""Where angle and rate stand among the coordinates of a node."""


def _plain(bends: FloatArray) -> FloatArray:
    """Second derivatives (k, p+1) by the coefficients themselves, from those by what ``basis.bent`` makes of them."""
    out = bends.copy()
    out[:, 0] -= bends[:, 2]
    out[:, 1] -= bends[:, 2] + bends[:, 3]
    return out
