"""The chain of stretches: elements, the nodes between them, and where these lie.

Two fields (X, Y) in a disc of radius 1, or one with steps of the radius between elements, alternately on its rim (then
one field, the angle φ) and free. Every node has four coordinates: (r, φ, r′, φ′) where it is *polar*, at both ends of
every stretch on the rim, at points of contact and at ends held there; (X, Y, X′, Y′) within free stretches. With the
bottom of the disc at φ = 0

    X = −r cos φ,  Y = r sin φ.

So contact is r at the rim, r′ = 0, two coordinates held, and the rim's curvature sits in the map from polar to
Cartesian coordinates. Where a stretch on the rim begins or ends, its place is unknown; the nodes within a stretch
divide it in fixed parts: places are ``base + shares @ breaks``. A node at a step of the radius may touch the edge of
the narrower part: r held, r′ free.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from rodwell.numerics.stretches.basis import ENDS, bent, sampled
from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray

RADIUS, ANGLE, RADIAL_SLOPE, ANGLE_RATE = range(4)
"""Coordinates of a polar node."""


class Cuts(NamedTuple):
    """Ends of stretches on the rim that may move, (k,).

    Their ``number`` among the moving nodes, the ``element`` on the rim, and which of its ends it is: ``ahead`` is 0 at
    its start, 1 at its end.
    """

    number: IntArray
    element: IntArray
    ahead: IntArray


@dataclass(frozen=True, eq=False, repr=False)
class Chain:
    """Elements in a row.

    Attributes
    ----------
    degree
        Degree of the elements.
    touching
        Which elements lie on the rim, (e,).
    polar
        Which nodes have polar coordinates, (e+1,).
    held
        Which coordinates are held, (e+1, 4).
    moving
        The nodes whose place is unknown, (m,), from s = 0.
    base, shares
        Places of the nodes: (e+1,) and (e+1, m).
    given
        What the model knows of each element, constant in it: (e, g).
    radii
        Radius of the disc around each element, (e,).
    edges
        The nodes that touch the edge of a narrower part of the disc, (k,): held in r, free to turn.
    planar
        Whether shapes stay in the plane Y = 0, as their symmetry has it; disturbances may leave it.
    """

    degree: int
    touching: BoolArray
    polar: BoolArray
    held: BoolArray
    moving: IntArray
    base: FloatArray
    shares: FloatArray
    given: FloatArray
    radii: FloatArray
    edges: IntArray
    planar: bool = False

    @property
    def elements(self) -> int:
        """How many elements."""
        return int(self.touching.size)

    @property
    def bubbles(self) -> int:
        """How many bubbles an element has in one field."""
        return self.degree + 1 - ENDS

    @cached_property
    def unmoved(self) -> BoolArray:
        """Which coordinates Newton's method leaves as they are, (e+1, 4): those held, in a plane Y and angle too."""
        return np.asarray(self.held | (self.planar & np.array([False, True, False, True])))

    @cached_property
    def on_rim(self) -> IntArray:
        """Numbers of the elements on the rim."""
        return np.flatnonzero(self.touching)

    @cached_property
    def free(self) -> IntArray:
        """Numbers of the free elements."""
        return np.flatnonzero(~self.touching)

    @cached_property
    def points(self) -> BoolArray:
        """Which of the moving nodes are points of contact: free on both sides."""
        return ~(self.touching[self.moving - 1] | self.touching[self.moving])

    @cached_property
    def cuts(self) -> Cuts:
        """Ends of stretches on the rim at moving nodes: first those where one ends, then those where one begins."""
        before, after = (np.flatnonzero(self.touching[self.moving - ahead]) for ahead in (1, 0))
        number, ahead = np.concatenate([before, after]), np.repeat([1, 0], [before.size, after.size])
        return Cuts(number, self.moving[number] - ahead, ahead)

    @cached_property
    def alike(self) -> list[float] | None:
        """What is given, as numbers, where it is the same in all elements; else None."""
        return self.given[0].tolist() if np.all(self.given == self.given[0]) else None

    def given_to(self, elements: IntArray) -> Any:
        """What is given in some elements (k,), each as an array (k, 1); where all are alike as numbers: far cheaper."""
        return self.given[elements].T[:, :, None] if self.alike is None else self.alike

    @cached_property
    def longer(self) -> FloatArray:
        """How much longer each element becomes as a break moves, (e, m)."""
        return np.diff(self.shares, axis=0)

    def places(self, breaks: FloatArray) -> FloatArray:
        """Where the nodes are, (e+1,)."""
        return np.asarray(self.base + self.shares @ breaks)


@dataclass(frozen=True, eq=False, repr=False)
class Shape:
    """Unknowns: ``nodes`` (e+1, 4), ``bubbles`` (e, 2, p−3), ``breaks`` (m,), and the load.

    On the rim the second row of bubbles is not used.
    """

    chain: Chain
    nodes: FloatArray
    bubbles: FloatArray
    breaks: FloatArray
    load: float

    @cached_property
    def places(self) -> FloatArray:
        """Where the nodes are."""
        return self.chain.places(self.breaks)

    @cached_property
    def lengths(self) -> FloatArray:
        """How long the elements are, (e,)."""
        return self.places[1:] - self.places[:-1]

    @property
    def in_order(self) -> bool:
        """Whether every element has a length: no end of a stretch has passed another, a cut or an end of the rod."""
        return bool(np.all(self.lengths > 0.0))

    @cached_property
    def cartesian(self) -> FloatArray:
        """(X, Y, X′, Y′) at the nodes, (e+1, 4)."""
        return cartesian(self.nodes, self.chain.polar)

    @cached_property
    def to_cartesian(self) -> FloatArray:
        """Derivatives of ``cartesian`` by the nodes' coordinates, (e+1, 4, 4)."""
        return cartesian_derivatives(self.nodes, self.chain.polar)

    def moved(self, nodes: FloatArray, bubbles: FloatArray, breaks: FloatArray, load: float) -> Shape:
        """The shape after an increment."""
        return Shape(self.chain, self.nodes + nodes, self.bubbles + bubbles, self.breaks + breaks, self.load + load)

    def local(self, group: IntArray) -> FloatArray:
        """Coefficients of elements of one kind, (k, fields, p+1): slopes are multiplied by the length."""
        if self.chain.touching[group[:1]].any():
            fields, ends = 1, [self.nodes[group, 1::2], self.nodes[group + 1, 1::2]]
        else:  # order, field to field, order
            fields, ends = 2, [self._lateral[group], self._lateral[group + 1]]
        a = np.concatenate([*(end.reshape(-1, fields, 2) for end in ends), self.bubbles[group, :fields]], axis=2)
        a[..., 1:ENDS:2] *= self.lengths[group, None, None]
        return a

    @cached_property
    def _lateral(self) -> FloatArray:
        """(X, X′), (Y, Y′) at the nodes, (e+1, 2, 2)."""
        return self.cartesian.reshape(-1, 2, 2).transpose(0, 2, 1)

    def along(self, elements: IntArray, xi: FloatArray, orders: int = 4) -> FloatArray:
        """Fields and derivatives by s at parts ``xi`` (k, n) of elements of one kind (k,): (fields, orders, k, n)."""
        a, h = bent(self.local(elements)), self.lengths[elements]
        return np.asarray(sampled(a, xi, orders) * (h ** -np.arange(orders)[:, None])[..., None])

    def at(self, element: int, xi: FloatArray, orders: int = 4) -> FloatArray:
        """Fields of one element and derivatives by s at parts ``xi`` (k,) of it: (fields, orders, k)."""
        return self.along(np.array([element]), np.asarray(xi)[None], orders)[:, :, 0]


def cartesian(nodes: FloatArray, polar: BoolArray) -> FloatArray:
    """(X, Y, X′, Y′) of nodes (k, 4)."""
    out = nodes.copy()
    r, phi, r1, phi1 = nodes[polar].T
    sin, cos = np.sin(phi), np.cos(phi)
    out[polar] = np.stack([-r * cos, r * sin, -r1 * cos + r * sin * phi1, r1 * sin + r * cos * phi1], axis=1)
    return out


def cartesian_derivatives(nodes: FloatArray, polar: BoolArray) -> FloatArray:
    """Derivatives of (X, Y, X′, Y′) by the nodes' coordinates, (k, 4, 4)."""
    out = np.zeros((nodes.shape[0], 4, 4))
    out[:, np.arange(4), np.arange(4)] = 1.0
    r, phi, r1, phi1 = nodes[polar].T
    sin, cos = np.sin(phi), np.cos(phi)
    block = np.zeros((r.size, 4, 4))
    block[:, 0, 0] = block[:, 2, 2] = -cos
    block[:, 1, 0] = block[:, 3, 2] = sin
    block[:, 0, 1] = block[:, 2, 3] = r * sin
    block[:, 1, 1] = block[:, 3, 3] = r * cos
    block[:, 2, 0], block[:, 3, 0] = sin * phi1, cos * phi1
    block[:, 2, 1], block[:, 3, 1] = r1 * sin + r * cos * phi1, r1 * cos - r * sin * phi1
    out[polar] = block
    return out


def cartesian_curvature(nodes: FloatArray, polar: BoolArray, covector: FloatArray) -> FloatArray:
    """Second derivatives of (X, Y, X′, Y′) by the nodes' coordinates, times a covector (k, 4): (k, 4, 4)."""
    out = np.zeros((nodes.shape[0], 4, 4))
    r, phi, r1, phi1 = nodes[polar].T
    gx, gy, gu, gv = covector[polar].T
    sin, cos = np.sin(phi), np.cos(phi)
    block = np.zeros((r.size, 4, 4))
    block[:, 0, 1] = gx * sin + gy * cos + (gu * cos - gv * sin) * phi1
    block[:, 0, 3] = gu * sin + gv * cos
    block[:, 1, 2] = gu * sin + gv * cos
    block[:, 1, 3] = r * (gu * cos - gv * sin)
    block += block.transpose(0, 2, 1)
    block[:, 1, 1] = r * (gx * cos - gy * sin) + gu * (r1 * cos - r * sin * phi1) - gv * (r1 * sin + r * cos * phi1)
    out[polar] = block
    return out
