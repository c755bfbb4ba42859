"""Energy of a chain and its derivatives, bubbles condensed, by arrays over all elements of a kind.

A model offers, in units where the disc has radius 1,

* ``rim(s, u, load, given)`` and ``interior(s, u, load, given)``: energy density, its derivative by the load, gradient
  (f, 3), mixed derivative (f, 3) and Hessian (f, 3, f, 3) at places ``s`` (e, q), from ``u`` (f, 3, e, q), the fields
  and two derivatives, and from what is ``given`` in each element, (g, e, 1), or g numbers where all are alike;
* ``drift(s, u, mixed, given)``: the derivative of that gradient by s at the same u and load, (f, 3, e, q); that of the
  density's derivative by the load vanishes;
* ``rim_reaction(s, angle, rate, bend, given)``: what a free rod of the rim's shape would exert radially at a cut, from
  φ, φ′ and φ″ there: moment, its derivatives by φ, φ′ and the place, outward force; see :func:`_react`;
* where the rim is ``inclined`` instead ``inclined_reaction(s, jet, load, given)``, from φ with three derivatives, with
  the derivative of the moment by φ″ at last, and ``work_drift(s, u, mixed, given)``, of what else vanishes.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from rodwell.numerics.stretches.basis import ENDS, bent, reference_element
from rodwell.numerics.stretches.chain import ANGLE, ANGLE_RATE, RADIAL_SLOPE, Shape, cartesian_curvature
from rodwell.numerics.stretches.inclined import ByBend, by_bend, jet_at_cuts
from rodwell.quantities.arrays import FloatArray, IntArray

RIM_SLOTS = np.array([1, 3, 5, 7])
"""Where angle and rate at the two ends of an element stand among the eight coordinates of its nodes."""

_ORDERS = np.arange(3.0)

_SLOPES = {1: np.array([1, 3]), 2: np.array([2, 3, 6, 7])}
"""Which of the coordinates of an element's ends are slopes, by how many fields it has."""


@dataclass(repr=False)
class Condensed:
    """Elements of one kind: what remains for their ends, and what gives the bubbles back.

    Their ends have c coordinates: of those of both nodes angle and rate on the rim, all if free. ``block`` (k, c, c);
    ``vectors`` (k, c, 5): residual, derivatives by length, start and load, and the gradient before bubbles are
    condensed. ``back`` (k, f·b, c + 4): columns of ends, residual, length, start, load; ``bubbles`` (k, f·b, f·b): the
    Hessian of what was condensed. ``work`` (k, 4): what the derivative of the energy by the load changes by with those
    four. In a chain in which no node moves the columns of length and start are left out.
    """

    group: IntArray
    fields: int
    back: FloatArray
    bubbles: FloatArray
    block: FloatArray
    vectors: FloatArray
    work: FloatArray


@dataclass(repr=False)
class Assembled:
    """A chain at a shape, in the nodes' coordinates.

    ``diagonal`` (n, 4, 4) and ``below`` (e, 4, 4), blocks of the Hessian; ``residual`` and ``by_load`` (n, 4);
    ``by_break`` (n, 4, m); ``plain`` (n, 4): the gradient before bubbles are condensed, whose held entries are
    reactions. ``work_by_break`` (m,), ``work_by_load`` and ``work_residual``: derivatives of ``energy_by_load`` besides
    ``by_load``, which is that by the nodes, and what it lacks as long as the bubbles are not in equilibrium.
    ``moments``, ``moment_turns``, ``moment_rates``, ``moment_shifts`` and ``forces`` (m,): radial reactions at the
    moving nodes, see :func:`_react`. ``by_bend``: what they depend on besides on an inclined rim.
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
    work_by_load: float
    work_residual: float
    groups: tuple[Condensed, ...]
    moments: FloatArray
    moment_turns: FloatArray
    moment_rates: FloatArray
    moment_shifts: FloatArray
    forces: FloatArray
    by_bend: ByBend | None = None

    @cached_property
    def negative_bubbles(self) -> int:
        """Negative eigenvalues of the bubbles' blocks."""
        return sum(_negative(one.bubbles) for one in self.groups)


def assemble(model: Any, shape: Shape) -> Assembled:
    """Energy, gradient and Hessian of a chain."""
    chain = shape.chain
    groups, energy, by_load, moves = [], 0.0, 0.0, chain.moving.size > 0
    work, work_by_break = np.zeros(4 if moves else 2), np.zeros(chain.moving.size)
    entered = np.zeros((chain.elements, 8, 8 + work.size + 1))
    for group, density in ((chain.on_rim, model.rim), (chain.free, model.interior)):
        if group.size:
            one, e, e_load = _condensed(model, density, shape, group)
            groups.append(one)
            energy, by_load = energy + e, by_load + e_load
            work += one.work.sum(axis=0)
            if moves:
                work_by_break += one.work[:, 1] @ chain.longer[group] + one.work[:, 2] @ chain.shares[group]
            _enter(shape, one, entered)
    halves = entered.reshape(-1, 2, 4, entered.shape[2])
    nodal, shift = _at_nodes(halves[..., 8:]), np.zeros((chain.elements + 1, 4, chain.moving.size))
    if moves:
        longer, shares = chain.longer[:, None, None], chain.shares[:-1, None, None]
        shift = _at_nodes(halves[..., 9, None] * longer + halves[..., 10, None] * shares)
    diagonal = np.zeros((chain.elements + 1, 4, 4))
    diagonal[:-1] = halves[:, 0, :, :4]
    diagonal[1:] += halves[:, 1, :, 4:8]
    out = Assembled(
        shape, energy, by_load, diagonal, halves[:, 1, :, :4], nodal[..., 0], nodal[..., -2], shift, nodal[..., -1],
        work_by_break, float(work[-1]), float(work[0]), tuple(groups), *np.zeros((5, chain.moving.size)),
    )  # fmt: skip
    if chain.free.size:
        out.diagonal += _curvature(shape, groups[-1])
    if moves:
        _react(model, out)
    return out


def _condensed(model: Any, density: Any, shape: Shape, group: IntArray) -> tuple[Condensed, float, float]:
    element, h, a = reference_element(shape.chain.degree), shape.lengths[group], shape.local(group)
    k, fields, size = a.shape
    q, parts, moves = element.points.size, _parts(fields, size), shape.chain.moving.size > 0
    inverse = h ** -_ORDERS[:, None]  # h^-d: (3, k)
    u = bent(a).transpose(1, 0, 2)[:, None] @ element.bending.transpose(0, 2, 1)  # (fields, 3, k, q)
    u *= inverse[:, :, None]
    s = shape.places[group, None] + h[:, None] * element.points
    given = shape.chain.given_to(group)
    e, e_load, g, mixed, hessian = density(s, u, shape.load, given)
    weight = h[:, None] * element.weights  # (k, q)
    scaled = inverse.T[:, :, None] * weight[:, None]  # w h h^-d: (k, 3, q)
    sides = [g, mixed]
    if moves:
        drift = model.drift(s, u, shape.load, mixed, given)
        # at fixed coefficients the derivatives u_d go like h^-d, the place of a point like ξ h
        fall = u * (-_ORDERS[:, None] / h)[:, :, None]
        lengthen = (hessian * fall).sum(axis=(2, 3)) + g * ((1.0 - _ORDERS[:, None]) / h)[:, :, None]
        lengthen += drift * element.points
        sides[1:1] = [lengthen, drift]
    more = len(sides)
    rows = np.empty((more, k, fields, 3, q))
    for row, part in zip(rows, sides, strict=True):
        np.multiply(part.transpose(2, 0, 1, 3), scaled[:, None], out=row)
    columns = (rows.reshape(-1, 3 * q) @ element.table.reshape(3 * q, size)).reshape(more, k, fields * size)
    # the Hessian: all products of derivatives of two functions at all places
    inner = np.empty((k, fields, fields, 3, 3, q))
    both = scaled[:, :, None] * inverse.T[:, None, :, None]
    np.multiply(hessian.transpose(4, 0, 2, 1, 3, 5), both[:, None, None], out=inner)
    whole = np.empty((k, fields * size, fields * size + more))
    whole[:, :, :-more] = (inner.reshape(-1, 9 * q) @ element.products).reshape(k, -1).take(parts.pairs, axis=1)
    whole[:, :, -more:] = columns.take(parts.order, axis=2).transpose(1, 2, 0)
    work = np.zeros(k)
    if moves:  # the slopes' coefficients are slopes times h
        rate = (a[..., 1:ENDS:2] / h[:, None, None]).transpose(0, 2, 1).reshape(k, -1)
        whole[:, :, -3] += (whole[:, :, parts.slopes] @ rate[..., None])[..., 0]
        work = (element.weights * e_load + weight * (mixed * fall).sum(axis=(0, 1))).sum(axis=1)
        work += (whole[:, parts.slopes, -1] * rate).sum(axis=1)
        if model.inclined:
            farther = weight * model.work_drift(s, u, mixed, given)
            work = np.stack([work + (farther * element.points).sum(axis=1), farther.sum(axis=1)])
    return _without_bubbles(group, fields, whole, h, work), float((weight * e).sum()), float((weight * e_load).sum())


def _without_bubbles(group: IntArray, fields: int, whole: FloatArray, h: FloatArray, work: FloatArray) -> Condensed:
    """Condense the bubbles, which stand first in the matrices with their columns (k, n, n + 2 or 4) of elements."""
    ends = ENDS * fields
    bubbles, more = whole.shape[1] - ends, whole.shape[2] - whole.shape[1]
    slopes = _SLOPES[fields]
    back = np.asarray(np.linalg.solve(whole[:, :bubbles, :bubbles], whole[:, :bubbles, bubbles:]), dtype=np.float64)
    works = -(whole[:, None, :bubbles, -1] @ back[:, :, ends:])[:, 0]
    left = np.empty((h.size, ends, ends + more + 1))
    left[:, :, :-1] = whole[:, bubbles:, bubbles:] - whole[:, bubbles:, :bubbles] @ back
    left[:, :, -1] = whole[:, bubbles:, -more]
    scale = np.ones((h.size, ends + more + 1))
    scale[:, slopes] = h[:, None]
    left *= scale[:, None]
    left *= scale[:, :ends, None]
    back *= scale[:, None, :-1]
    if more > 2:
        works[:, 1 : 1 + len(np.atleast_2d(work))] += np.atleast_2d(work).T
        left[:, slopes, ends + 1] += whole[:, bubbles + slopes, -more]
    return Condensed(group, fields, back, whole[:, :bubbles, :bubbles], left[:, :, :ends], left[:, :, ends:], works)


class _Parts(NamedTuple):
    """Of the functions of all fields, bubbles first, then those of the ends as nodes have them.

    ``order``: where each is among them field by field; ``pairs``: where each pair is among those of functions, by pairs
    of fields; ``slopes``: the numbers of the slopes.
    """

    order: IntArray
    pairs: IntArray
    slopes: IntArray


@lru_cache(maxsize=32)
def _parts(fields: int, size: int) -> _Parts:
    numbers = np.arange(fields * size).reshape(fields, size)
    order = np.concatenate([numbers[:, ENDS:].ravel(), numbers[:, :ENDS].T.ravel()])
    field, function = np.divmod(order, size)
    pair = field[:, None] * fields + field
    pairs = (pair * size + function[:, None]) * size + function
    return _Parts(order, pairs, np.flatnonzero((function == 1) | (function == 3)))


def _negative(blocks: FloatArray) -> int:
    """Negative eigenvalues of all blocks (k, b, b): none, as a rule."""
    try:
        np.linalg.cholesky(blocks)
    except np.linalg.LinAlgError:
        return int(np.sum(np.linalg.eigvalsh(blocks) < 0.0))
    return 0


def _enter(shape: Shape, one: Condensed, entered: FloatArray) -> None:
    """Enter elements of a kind in the coordinates of their nodes: blocks and vectors side by side (e, 8, 8 + …)."""
    group = one.group
    if one.fields == 1:
        entered[group[:, None, None], RIM_SLOTS[:, None], RIM_SLOTS] = one.block
        entered[group[:, None], RIM_SLOTS, 8:] = one.vectors
        return
    turn = np.zeros((group.size, 8, 8))
    turn[:, :4, :4], turn[:, 4:, 4:] = shape.to_cartesian[group], shape.to_cartesian[group + 1]
    back = turn.transpose(0, 2, 1)
    entered[group, :, :8], entered[group, :, 8:] = back @ one.block @ turn, back @ one.vectors


def _at_nodes(ends: FloatArray) -> FloatArray:
    """The sums at the nodes (e+1, …) of what elements give to their ends, (e, 2, …)."""
    out = np.zeros((ends.shape[0] + 1, *ends.shape[2:]))
    out[:-1] = ends[:, 0]
    out[1:] += ends[:, 1]
    return out


def _curvature(shape: Shape, free: Condensed) -> FloatArray:
    """What the curvature of polar coordinates adds to the Hessian of free elements, (n, 4, 4)."""
    covector = np.zeros_like(shape.nodes)
    covector[free.group] = free.vectors[:, :4, -1]
    covector[free.group + 1] += free.vectors[:, 4:, -1]
    return cartesian_curvature(shape.nodes, shape.chain.polar, covector)


def bubbles_of(out: Assembled, nodes: FloatArray, breaks: FloatArray, load: float, residual: float) -> FloatArray:
    """Increments of the bubbles (e, 2, p−3) that belong to those of the rest.

    ``residual`` is 1 in Newton's method, 0 for a tangent.
    """
    chain = out.shape.chain
    result = np.zeros((chain.elements, 2, chain.bubbles))
    moves = chain.moving.size > 0
    columns = np.empty((chain.elements, 4 if moves else 2))
    columns[:, 0], columns[:, -1] = residual, load
    if moves:
        columns[:, 1], columns[:, 2] = chain.longer @ breaks, chain.shares[:-1] @ breaks
    for one in out.groups:
        group = one.group
        values = nodes if one.fields == 1 else (out.shape.to_cartesian @ nodes[..., None])[..., 0]
        ends = [values[group], values[group + 1]] if one.fields == 2 else [values[group, 1::2], values[group + 1, 1::2]]
        known = np.concatenate([*ends, columns[group]], axis=1)
        result[group, : one.fields] = -(one.back @ known[..., None]).reshape(group.size, one.fields, -1)
    return result


def _react(model: Any, out: Assembled) -> None:
    """Radial reactions at the moving nodes, that must vanish or be positive.

    The moments, derivative of the energy by the radial slope, zero in equilibrium; their derivatives by the angle, its
    rate and the place of the cut, from stretches on the rim; and the outward forces with which the rod presses on
    the rim. The energy of a stretch on the rim does not know r and r′: its part comes from the cut, ``rim_reaction``.
    """
    shape, chain, cuts = out.shape, out.shape.chain, out.shape.chain.cuts
    out.moments += out.residual[chain.moving, RADIAL_SLOPE]
    out.forces -= out.plain[chain.moving, 0]
    if cuts.number.size:
        node, at, sign = chain.moving[cuts.number], cuts.element, 2.0 * cuts.ahead - 1.0
        given = chain.given[at].T
        if model.inclined:
            jet = jet_at_cuts(shape)
            *reaction, by_phi2 = model.inclined_reaction(shape.places[node], jet, shape.load, given)
            out.by_bend = by_bend(shape, out.groups[0], jet[2], sign * by_phi2)
        else:
            ends = reference_element(chain.degree).end_bends[cuts.ahead]
            bend = np.sum(bent(shape.local(at)[:, 0]) * ends, axis=1) / shape.lengths[at] ** 2
            angle, rate = shape.nodes[node][:, [ANGLE, ANGLE_RATE]].T
            reaction = model.rim_reaction(shape.places[node], angle, rate, bend, given)
        totals = out.moments, out.moment_turns, out.moment_rates, out.moment_shifts, out.forces
        for total, part in zip(totals, reaction, strict=True):
            np.add.at(total, cuts.number, sign * part)
