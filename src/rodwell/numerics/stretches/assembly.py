"""Energy of a chain and its derivatives, bubbles condensed, by arrays over all elements of a kind.

A model offers, in units where the disc has radius 1,

* ``rim(s, u, load, given)`` and ``interior(s, u, load, given)``: energy density, its derivative by the load, gradient
  (f, 3), mixed derivative (f, 3) and Hessian (f, 3, f, 3) at places ``s`` (e, q), from ``u`` (f, 3, e, q), the fields
  and two derivatives, and from what is ``given`` in each element, (g, e, 1);
* ``drift(s, u, mixed, given)``: the derivative of that gradient by s at the same u and load, (f, 3, e, q); that of the
  density's derivative by the load vanishes;
* ``rim_reaction(s, u, given)``: what a free rod of the rim's shape would exert radially at a cut, see :func:`_react`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from rodwell.numerics.stretches.basis import ENDS, bent, reference_element
from rodwell.numerics.stretches.chain import RADIAL_SLOPE, Shape, cartesian_curvature
from rodwell.quantities.arrays import FloatArray, IntArray

RIM_SLOTS = np.array([1, 3, 5, 7])
"""Where angle and rate at the two ends of an element stand among the eight coordinates of its nodes."""

FREE_SLOTS = np.array([0, 2, 4, 6, 1, 3, 5, 7])
"""Where X, X′ at the two ends, then Y, Y′, stand among them."""


@dataclass(repr=False)
class Condensed:
    """Elements of one kind: what remains for their ends, and what gives the bubbles back.

    ``block`` (k, 8, 8), ``residual``, ``by_length``, ``by_start``, ``by_load`` (k, 8) in the coordinates of the two
    nodes; ``back`` (k, f·b, f·4 + 4): columns of ends, residual, length, start, load. ``work`` (k, 4): what the
    derivative of the energy by the load changes by with those four.
    """

    group: IntArray
    fields: int
    slots: IntArray
    back: FloatArray
    raw: FloatArray
    block: FloatArray
    vectors: FloatArray
    work: FloatArray
    negative: int


@dataclass(repr=False)
class Assembled:
    """A chain at a shape, in the nodes' coordinates.

    ``diagonal`` (n, 4, 4) and ``below`` (e, 4, 4), blocks of the Hessian; ``residual`` and ``by_load`` (n, 4);
    ``by_break`` (n, 4, m); ``plain`` (n, 4): the gradient before bubbles are condensed, whose held entries are
    reactions. ``work_by_break`` (m,), ``work_by_load`` and ``work_residual``: derivatives of ``energy_by_load`` besides
    ``by_load``, which is that by the nodes, and what it lacks as long as the bubbles are not in equilibrium.
    ``moments``, ``moment_rates`` and ``forces`` (m,): radial reactions at the moving nodes, see :func:`_react`.
    """

    shape: Shape
    energy: float
    energy_by_load: float
    diagonal: FloatArray
    below: FloatArray
    residual: FloatArray
    by_load: FloatArray
    by_break: FloatArray
    plain: FloatArray
    work_by_break: FloatArray
    groups: tuple[Condensed, ...]
    largest_bubble_residual: float
    moments: FloatArray
    moment_rates: FloatArray
    forces: FloatArray

    @property
    def work_by_load(self) -> float:
        """Derivative of ``energy_by_load`` by the load at fixed nodes and breaks."""
        return float(sum(np.sum(one.work[:, 3]) for one in self.groups))

    @property
    def work_residual(self) -> float:
        """By how much ``energy_by_load`` changes as the bubbles come into equilibrium."""
        return float(sum(np.sum(one.work[:, 0]) for one in self.groups))

    @property
    def negative_bubbles(self) -> int:
        """Negative eigenvalues of the bubbles' blocks."""
        return sum(g.negative for g in self.groups)


def assemble(model: Any, shape: Shape) -> Assembled:
    """Energy, gradient and Hessian of a chain."""
    chain = shape.chain
    n, m = chain.elements + 1, chain.moving.size
    groups, energy, by_load, bubble = [], 0.0, 0.0, 0.0
    for group, density in ((chain.on_rim, model.rim), (chain.free, model.interior)):
        if group.size:
            one, e, e_load, worst = _condensed(model, density, shape, group)
            groups.append(one)
            energy, by_load, bubble = energy + e, by_load + e_load, max(bubble, worst)
    out = Assembled(
        shape, energy, by_load, np.zeros((n, 4, 4)), np.zeros((n - 1, 4, 4)), np.zeros((n, 4)), np.zeros((n, 4)),
        np.zeros((n, 4, m)), np.zeros((n, 4)), np.zeros(m), tuple(groups), bubble, *np.zeros((3, m)),
    )  # fmt: skip
    covector = np.zeros((n, 4))
    for one in groups:
        _add(out, one, covector)
    if chain.free.size:
        out.diagonal += cartesian_curvature(shape.nodes, chain.polar, covector)
    if m:
        _react(model, out)
    return out


def _condensed(model: Any, density: Any, shape: Shape, group: IntArray) -> tuple[Condensed, float, float, float]:
    element = reference_element(shape.chain.degree)
    table, places = element.table, shape.places
    h, start = np.diff(places)[group], places[group]
    a, rate = shape.local(group)
    k, fields, size = a.shape
    q, order = element.points.size, np.arange(3.0)
    flat = table.reshape(3 * q, size)
    inverse = h[:, None] ** -order  # (k, 3): h^-d
    u = (bent(a) @ element.bending.reshape(3 * q, size).T).reshape(k, fields, 3, q).transpose(1, 2, 0, 3) * inverse.T[
        None, :, :, None
    ]
    s = start[:, None] + h[:, None] * element.points
    given = shape.chain.given[group].T[:, :, None]
    e, e_load, g, mixed, hessian = density(s, u, shape.load, given)
    drift = model.drift(s, u, mixed, given)
    weight = h[:, None] * element.weights  # (k, q)
    scaled = inverse[:, None, :, None] * weight[:, None, None, :]  # w h h^-d: (k, 1, 3, q)
    # at fixed coefficients the derivatives u_d go like h^-d, the place of a point like ξ h
    fall = -order[None, :, None, None] * u / h[:, None]
    lengthen = np.einsum("fdlekq,lekq->fdkq", hessian, fall) + (1.0 - order)[None, :, None, None] * g / h[:, None]
    lengthen = lengthen + drift * element.points
    rows = np.stack([g, lengthen, drift, mixed]).transpose(0, 3, 1, 2, 4) * scaled  # (4, k, f, d, q)
    columns = (rows.reshape(4, k, fields, 3 * q) @ flat).reshape(4, k, fields * size)
    gradient, by_length, by_start, by_load = columns
    # the Hessian: one table contracted place by place, then the other over all places
    inner = hessian * scaled[:, 0].transpose(1, 0, 2)[None, :, None, None] * inverse.T[None, None, None, :, :, None]
    inner = inner.transpose(4, 5, 0, 1, 2, 3).reshape(k, q, fields * 3 * fields, 3)
    half = (inner @ table.transpose(1, 0, 2)).reshape(k, q, fields, 3, fields * size)
    half = half.transpose(0, 2, 3, 1, 4).reshape(k, fields, 3 * q, fields * size)
    matrix = (flat.T @ half).reshape(k, fields * size, fields * size)
    by_length = by_length + (matrix @ rate.reshape(k, -1, 1))[..., 0]
    work = np.sum(element.weights * e_load + weight * np.einsum("fdkq,fdkq->kq", mixed, fall), axis=1)
    work = work + np.sum(by_load * rate.reshape(k, -1), axis=1)

    ends, bubbles = _parts(fields, size)
    kbb = matrix[:, bubbles[:, None], bubbles]
    columns = np.stack([gradient, by_length, by_start, by_load], axis=2)
    right = np.concatenate([matrix[:, bubbles[:, None], ends], columns[:, bubbles]], axis=2)
    back = np.linalg.solve(kbb, right)
    works = -np.einsum("kb,kbv->kv", columns[:, bubbles, 3], back[:, :, ends.size :])
    works[:, 1] += work
    whole = np.concatenate([matrix[:, ends[:, None], ends], columns[:, ends]], axis=2)
    whole = whole - matrix[:, ends[:, None], bubbles] @ back
    slope = np.ones((k, ends.size))
    slope[:, 1::2] = h[:, None]
    whole[:, :, : ends.size] *= slope[:, None, :]
    whole *= slope[:, :, None]
    back[:, :, : ends.size] *= slope[:, None, :]
    whole[:, 1::2, ends.size + 1] += gradient[:, ends[1::2]]  # the slopes' own factor h
    condensed = Condensed(
        group, fields, RIM_SLOTS if fields == 1 else FREE_SLOTS, back, gradient[:, ends] * slope,
        whole[:, :, : ends.size], whole[:, :, ends.size :], works, _negative(kbb),
    )  # fmt: skip
    worst = float(np.max(np.abs(gradient[:, bubbles]), initial=0.0))
    return condensed, float(np.sum(weight * e)), float(np.sum(weight * e_load)), worst


@lru_cache(maxsize=32)
def _parts(fields: int, size: int) -> tuple[IntArray, IntArray]:
    """Where the functions of the ends, and the bubbles, stand among those of all fields."""
    ends = (np.arange(ENDS)[None, :] + size * np.arange(fields)[:, None]).ravel()
    return ends, np.setdiff1d(np.arange(fields * size), ends)


def _negative(blocks: FloatArray) -> int:
    """Negative eigenvalues of all blocks (k, b, b): none, as a rule."""
    try:
        np.linalg.cholesky(blocks)
    except np.linalg.LinAlgError:
        return int(np.sum(np.linalg.eigvalsh(blocks) < 0.0))
    return 0


def _add(out: Assembled, one: Condensed, covector: FloatArray) -> None:
    """Add elements of a kind to the chain's blocks, in the coordinates of its nodes."""
    group, chain = one.group, out.shape.chain
    k = group.size
    block: FloatArray = np.zeros((k, 8, 8))
    block[:, one.slots[:, None], one.slots] = one.block
    vectors: FloatArray = np.zeros((k, 8, 5))
    vectors[:, one.slots, :4] = one.vectors
    vectors[:, one.slots, 4] = one.raw
    block, vectors = np.asarray(block.reshape(k, 2, 4, 2, 4)), np.asarray(vectors.reshape(k, 2, 4, 5))
    if one.fields == 2:
        for end in range(2):
            np.add.at(covector, group + end, vectors[:, end, :, 4])
        to_polar = out.shape.to_cartesian
        turn = np.stack([to_polar[group], to_polar[group + 1]], axis=1)  # (k, end, cartesian, coordinate)
        block = np.einsum("kaic,kaibj->kacbj", turn, block)
        block = np.einsum("kacbj,kbjd->kacbd", block, turn)
        vectors = np.einsum("kaic,kaiv->kacv", turn, vectors)
    for end in range(2):
        np.add.at(out.diagonal, group + end, block[:, end, :, end])
        np.add.at(out.residual, group + end, vectors[:, end, :, 0])
        np.add.at(out.by_load, group + end, vectors[:, end, :, 3])
        np.add.at(out.plain, group + end, vectors[:, end, :, 4])
        longer = (chain.shares[group + 1] - chain.shares[group])[:, None, :]
        change = vectors[:, end, :, 1, None] * longer + vectors[:, end, :, 2, None] * chain.shares[group][:, None, :]
        np.add.at(out.by_break, group + end, change)
    longer = chain.shares[group + 1] - chain.shares[group]
    out.work_by_break += one.work[:, 1] @ longer + one.work[:, 2] @ chain.shares[group]
    out.below[group] = block[:, 1, :, 0]


def bubbles_of(out: Assembled, nodes: FloatArray, breaks: FloatArray, load: float, residual: float) -> FloatArray:
    """Increments of the bubbles (e, 2, p−3) that belong to those of the rest.

    ``residual`` is 1 in Newton's method, 0 for a tangent.
    """
    chain = out.shape.chain
    cart = (out.shape.to_cartesian @ nodes[..., None])[..., 0]
    result = np.zeros((chain.elements, 2, chain.bubbles))
    shift = chain.shares @ breaks
    for one in out.groups:
        group = one.group
        values = cart if one.fields == 2 else nodes
        ends = np.concatenate([values[group], values[group + 1]], axis=1)[:, one.slots]
        extra = np.stack(
            [np.full(group.size, residual), shift[group + 1] - shift[group], shift[group], np.full(group.size, load)],
            axis=1,
        )
        step = -np.einsum("kij,kj->ki", one.back, np.concatenate([ends, extra], axis=1))
        result[group, : one.fields] = step.reshape(group.size, one.fields, -1)
    return result


def _react(model: Any, out: Assembled) -> None:
    """Radial reactions at the moving nodes, that must vanish or be positive.

    The moments, derivative of the energy by the radial slope, zero in equilibrium; their derivative by the angle's rate
    from stretches on the rim; and the outward forces with which the rod presses on the rim. The energy of a stretch on
    the rim does not know r and r′: its part comes from the cut, ``rim_reaction``.
    """
    chain, moving = out.shape.chain, out.shape.chain.moving
    out.moments += out.residual[moving, RADIAL_SLOPE]
    out.forces -= out.plain[moving, 0]
    before, after = np.flatnonzero(chain.touching[moving - 1]), np.flatnonzero(chain.touching[moving])
    cut, ahead = np.concatenate([before, after]), np.repeat([1, 0], [before.size, after.size])
    if cut.size:  # at the end of the element before the node, or at the start of that after it
        u = out.shape.along(moving[cut] - ahead, ahead[:, None].astype(float))[0, ..., 0]
        turn, by_rate, shear = model.rim_reaction(out.shape.places[moving[cut]], u, chain.given[moving[cut] - ahead].T)
        sign = 2.0 * ahead - 1.0
        for total, part in ((out.moments, turn), (out.moment_rates, by_rate), (out.forces, -shear)):
            np.add.at(total, cut, sign * part)
