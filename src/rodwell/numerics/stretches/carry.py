"""Carrying a shape over to another chain: other elements, another degree, other stretches."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.numerics.stretches.basis import bubble_projection, tabulate
from rodwell.numerics.stretches.chain import Chain, Shape
from rodwell.quantities.arrays import FloatArray, IntArray

Sampler = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Places (k,), in order, to X, Y with two derivatives, (2, 3, k), and angle with two derivatives, (3, k)."""

GRID = 600
"""Places at which the angle is made continuous."""


def rim_fields(angle: FloatArray) -> FloatArray:
    """X, Y and two derivatives (2, 3, k) of a curve on a rim of radius 1, from the angle and its derivatives (3, k)."""
    phi, phi1, phi2 = angle[:3]
    sin, cos = np.sin(phi), np.cos(phi)
    x = np.stack([-cos, sin * phi1, cos * phi1**2 + sin * phi2])
    y = np.stack([sin, cos * phi1, -sin * phi1**2 + cos * phi2])
    return np.stack([x, y])


def angle_of(fields: FloatArray) -> FloatArray:
    """Angle and two derivatives (3, k) of fields (2, 3, k); the angle between −π and π."""
    (x, x1, x2), (y, y1, y2) = fields[:, :3]
    square = np.maximum(x * x + y * y, 1e-12)
    rate = (x1 * y - x * y1) / square
    second = (x2 * y - x * y2) / square - 2.0 * rate * (x * x1 + y * y1) / square
    return np.stack([np.arctan2(y, -x), rate, second])


def elements_at(shape: Shape, s: FloatArray) -> IntArray:
    """Which element each place lies in."""
    return np.clip(np.searchsorted(shape.places, s, side="right") - 1, 0, shape.chain.elements - 1)


def fields_at(shape: Shape, s: FloatArray, orders: int = 3) -> tuple[FloatArray, FloatArray]:
    """X, Y with derivatives, (2, orders, k), and, on the rim, the angle with derivatives, (orders, k), else NaN."""
    elements, orders = elements_at(shape, s), max(orders, 3)
    fields, angle = np.zeros((2, orders, s.size)), np.full((orders, s.size), np.nan)
    left = shape.places[elements]
    xi = ((s - left) / (shape.places[elements + 1] - left))[:, None]
    on = shape.chain.touching[elements]
    if on.any():
        angle[:, on] = shape.along(elements[on], xi[on], orders)[0, ..., 0]
        fields[:, :3, on] = shape.chain.radii[elements[on]] * rim_fields(angle[:3, on])
    if not on.all():
        fields[..., ~on] = shape.along(elements[~on], xi[~on], orders)[..., 0]
    return fields, angle


def sampler(shape: Shape) -> Sampler:
    """Sample a shape, with the angle continuous from s = 0 on."""

    def raw(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, angle = fields_at(shape, s)
        free = np.isnan(angle[0])
        angle[:, free] = angle_of(fields[:, :3][..., free])
        return fields, angle

    grid = np.unique(np.concatenate([np.linspace(0.0, 1.0, GRID), shape.places]))
    known = np.unwrap(raw(grid)[1][0])

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields, angle = raw(s)
        turns = np.round((np.interp(s, grid, known) - angle[0]) / (2.0 * np.pi))
        angle[0] += 2.0 * np.pi * turns
        return fields, angle

    return sample


def fit(chain: Chain, breaks: FloatArray, load: float, sample: Sampler, held: FloatArray) -> Shape:
    """A shape on a chain that follows a sampler: values and slopes at the nodes, second derivatives in between.

    What is held takes its value from ``held`` (e+1, 4), where that is a number.
    """
    places = chain.places(breaks)
    fields, angle = sample(places)
    nodes = fields[:, :2].transpose(2, 1, 0).reshape(-1, 4).copy()
    x, y = fields
    r = np.hypot(x[0], y[0])
    slope = (x[0] * x[1] + y[0] * y[1]) / np.maximum(r, 1e-12)
    polar = np.stack([r, angle[0], slope, angle[1]], axis=1)
    nodes[chain.polar] = polar[chain.polar]
    given = np.isfinite(held) & chain.held
    nodes[given] = held[given]
    shape = Shape(chain, nodes, np.zeros((chain.elements, 2, chain.bubbles)), breaks, load)
    points, project = bubble_projection(chain.degree)
    table = tabulate(chain.degree, points, 3)[2]
    h = np.diff(places)
    s = places[:-1, None] + h[:, None] * points
    fields, angle = sample(s.ravel())
    bubbles = np.zeros((chain.elements, 2, chain.bubbles))
    for group, source in ((chain.on_rim, angle[None]), (chain.free, fields)):
        if group.size:
            a = shape.local(group)
            bend = source[:, 2].reshape(source.shape[0], *s.shape)[:, group] * h[group, None] ** 2
            rest = bend.transpose(1, 0, 2) - np.einsum("qi,kfi->kfq", table[:, :4], a[..., :4])
            bubbles[group, : source.shape[0]] = rest @ project.T
    return Shape(chain, nodes, bubbles, breaks, load)
