"""One operation of a stiff string: axial force and bending found together.

The axial force says how the string lies (:mod:`rodwell.studies.drag.stiff`), and where it then presses the wall says
how the axial force grows. Both are found in turn. What bending adds is the contact force of the stiff string less that
of the soft one under the same force; it is added where the string is not buckled. Where it is, the local state counts,
and for the bending of what lies beside it the compression is taken as that just below buckling.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rodwell.quantities.arrays import FloatArray, IntArray
from rodwell.quantities.value import Value
from rodwell.studies.drag.contact import BUCKLES, RATIO, STRAIGHT, WEIGHT
from rodwell.studies.drag.laws import Contact
from rodwell.studies.drag.pieces import Cutter, Interval
from rodwell.studies.drag.run import Run, run, total_size
from rodwell.studies.drag.stiff import Loads, frame, lay, loads_at
from rodwell.studies.drag.well_case import Operation

ELEMENT, SHORTEST = 1.0, 0.3
"""Longest element in m, and the shortest one as a part of it."""

MOST_TURNS, SETTLED = 25, 1e-9
"""Turns of the iteration; change of hook load and torque, as a part of all weights, at which it ends."""

CLAIMED = 3.0
"""Times the difference of two meshes that is told as the error: with the first order it would be once."""

BELOW = 0.9
"""Part of the buckling load up to which compression bends the string."""


@dataclass(frozen=True)
class StiffRun:
    """One operation of a stiff string.

    Attributes
    ----------
    run
        Forces along the string, on the finer mesh.
    hook_load, torque
        At surface in N, tension positive, and in N m; errors from the two meshes and the last turn.
    settled
        Whether axial force and bending have settled together.
    curvature
        Largest curvature of the string in 1/m at the rows of the run, (m,), without that of local states.
    """

    run: Run
    hook_load: Value
    torque: Value
    settled: bool
    curvature: FloatArray


def stiff_run(
    cutter: Cutter, operation: Operation, contact: Contact, rule: str, remembered: Sequence[Interval] = ()
) -> StiffRun:
    """Compute an operation of a stiff string, on two meshes; the error is ``CLAIMED`` times their difference.

    Contact forces at nodes make an error of first order in the length of the elements. What locks up as a soft string
    is told to lock up: bending is added to forces that are known, and there are none.
    """
    fine, left, settled, curvature = _on_mesh(cutter, operation, contact, rule, remembered, ELEMENT)
    rough, _, _, _ = _on_mesh(cutter, operation, contact, rule, remembered, 2.0 * ELEMENT)
    force = CLAIMED * abs(fine.force - rough.force) + left if fine.arrived and rough.arrived else np.inf
    torque = CLAIMED * abs(fine.torque - rough.torque) if fine.arrived and rough.arrived else np.inf
    return StiffRun(fine, Value(fine.force, float(force)), Value(fine.torque, float(torque)), settled,
                    curvature)  # fmt: skip


def _on_mesh(
    cutter: Cutter, operation: Operation, contact: Contact, rule: str, remembered: Sequence[Interval], longest: float
) -> tuple[Run, float, bool, FloatArray]:
    """The run on one mesh, the last change of its ends, whether all has settled, and curvature at its rows, (m,)."""
    survey = cutter.well.survey
    normals, tangents = frame(survey)
    one = run(cutter, operation, contact, rule, remembered=remembered, longest_piece=longest)
    depth = _nodes(one, SHORTEST * longest)
    middle = 0.5 * (depth[:-1] + depth[1:])
    curvature, down = loads_at(survey, middle, normals, tangents)
    piece = np.searchsorted(-one.pieces.top, -middle)  # pieces run from the bit up
    table = one.pieces.table[piece]
    element = np.clip(np.searchsorted(depth, 0.5 * (one.pieces.top + one.pieces.bottom)) - 1, 0, len(middle) - 1)
    stiffness = cutter.stiffness[one.pieces.section[piece]]
    if not one.arrived:  # compression beyond bounds: nothing lies anywhere, so what is known is the curve of the hole
        return one, np.inf, True, _at_rows(one, element, np.linalg.norm(curvature, axis=1))
    start: FloatArray | None = None
    change, settled = np.inf, False
    for _ in range(MOST_TURNS):
        force = np.interp(middle, one.measured_depth[::-1], one.forces[::-1])
        lateral = table[:, WEIGHT, None] * down
        q = np.linalg.norm(force[:, None] * curvature + lateral, axis=1)
        bending = np.maximum(force, -BELOW * BUCKLES * np.sqrt(table[:, RATIO] * q))
        load = bending[:, None] * curvature + lateral
        acts = Loads(stiffness, bending, curvature, lateral, stiffness / table[:, RATIO])
        found = lay(depth, acts, _against_wall(load, acts.clearance) if start is None else start)
        start = found.displacement
        more = _shared(found.force) / np.diff(depth) - np.linalg.norm(load, axis=1)
        straight = np.interp(middle, one.measured_depth[::-1], one.states[::-1].astype(float)) == STRAIGHT
        new = run(cutter, operation, contact, rule, remembered=remembered, bent=np.where(straight, more, 0.0)[element],
                  longest_piece=longest)  # fmt: skip
        if not new.arrived:
            return new, np.inf, found.settled, _at_rows(new, element, found.curvature)
        change = abs(new.force - one.force) + abs(new.torque - one.torque)
        one, settled = new, found.settled
        if change <= SETTLED * total_size(new):
            break
    settled = settled and change <= SETTLED * total_size(one)
    return one, float(change), settled, _at_rows(one, element, found.curvature)


def _at_rows(one: Run, element: IntArray, values: FloatArray) -> FloatArray:
    """Values of elements (n,) at the rows of a run, (m,)."""
    return np.asarray(values[element[one.piece]])


def _shared(force: FloatArray) -> FloatArray:
    """Forces of the nodes (n + 1,) shared by the elements beside them, (n,); the ends have one."""
    out = 0.5 * (force[:-1] + force[1:])
    out[0] += 0.5 * force[0]
    out[-1] += 0.5 * force[-1]
    return np.asarray(out)


def _nodes(one: Run, shortest: float) -> FloatArray:
    """Measured depths of the nodes from the top down, (n + 1,): ends of pieces, none closer than ``shortest`` in m."""
    ends = np.append(one.pieces.top[::-1], one.pieces.bottom[0])
    kept = [float(ends[0])]
    for place in ends[1:-1]:
        if place - kept[-1] >= shortest and ends[-1] - place >= shortest:
            kept.append(float(place))
    return np.array([*kept, float(ends[-1])])


def _against_wall(load: FloatArray, clearance: FloatArray) -> FloatArray:
    """Nodes (n + 1, 2) on the side to which the load of the elements (n, 2) presses; in the middle where none does."""
    size = np.linalg.norm(load, axis=1)
    side = np.where(size[:, None] > 0.0, load / np.where(size > 0.0, size, 1.0)[:, None], 0.0) * clearance[:, None]
    return np.concatenate([side[:1], 0.5 * (side[:-1] + side[1:]), side[-1:]])
