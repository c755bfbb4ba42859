"""One operation with the bit at one depth: forces and torques from the bit up, errors, and the balance of work."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rodwell.quantities.arrays import BoolArray, FloatArray, IntArray
from rodwell.quantities.value import Value
from rodwell.studies.drag.contact import HELICAL, SINUSOIDAL, STIFF, STRAIGHT
from rodwell.studies.drag.laws import Contact
from rodwell.studies.drag.march import ARRIVED, LOCKED, march, summed_contact
from rodwell.studies.drag.pieces import Cutter, Interval, Pieces
from rodwell.studies.drag.well_case import Operation
from rodwell.survey.survey import Survey

FINE, COARSE, CRUDE = 1e-11, 1e-8, 1e-5
"""Relative errors of the contact force summed, per length: of what is reported, and of what tells its error."""

LONGEST, LONGEST_COARSE = 10.0, 30.0
"""Longest steps in m."""

BEYOND = 1e5
"""A string is locked where its compression is so many times √(B w/r), the largest along it."""

ROUND_OFF = 1e-13
"""Errors are at least this part of the sum of all weights and frictions."""


@dataclass(frozen=True)
class Run:
    """One operation, integrated from the bit to the surface.

    Attributes
    ----------
    operation, depth
        What is done; measured depth of the bit in m.
    outcome
        ARRIVED or LOCKED (or STALLED: a force is no number).
    force, torque
        Effective tension in N, **tension positive**, and torque in N m at the surface; infinite where it locks.
    locked_at
        Measured depth in m at which the compression becomes infinite, or None.
    pieces, rows
        The pieces, and (m, 7) what was recorded along them (``march.ROW``), from the bit up.
    contact
        The law that was used.
    """

    operation: Operation
    depth: float
    outcome: int
    force: float
    torque: float
    locked_at: float | None
    pieces: Pieces
    rows: FloatArray
    contact: Contact

    @property
    def arrived(self) -> bool:
        """Whether the force at the bit can be had at all."""
        return self.outcome == ARRIVED

    @cached_property
    def measured_depth(self) -> FloatArray:
        """Where the rows are, in m, (m,), from the bit up."""
        return np.maximum(self.depth - self.rows[:, 0], 0.0)

    @property
    def forces(self) -> FloatArray:
        """Effective tension in N, (m,), tension positive."""
        return self.rows[:, 1]

    @property
    def torques(self) -> FloatArray:
        """Torque in N m, (m,)."""
        return self.rows[:, 2]

    @property
    def contacts(self) -> FloatArray:
        """Contact force per length in N/m, (m,), mean of the local state.

        What stiffness adds is one number on each piece, the soft string's contact varies along it: where a stiff string
        is off the wall, the sum is 0 in the mean of the piece, and none of it is told as a pull.
        """
        return np.maximum(self.rows[:, 3], 0.0)

    @property
    def pressing(self) -> FloatArray:
        """Load q in N/m that presses the straight-lying string to the wall, (m,)."""
        return self.rows[:, 4]

    @property
    def states(self) -> IntArray:
        """Local states, (m,): 0 straight, 1 sinusoidal, 2 helical."""
        return self.rows[:, 5].astype(np.int64)

    @property
    def piece(self) -> IntArray:
        """Number of the piece, (m,)."""
        return self.rows[:, 6].astype(np.int64)

    def column(self, number: int) -> FloatArray:
        """A column of the pieces at the rows, (m,)."""
        return np.asarray(self.pieces.table[self.piece, number])

    def intervals(self, *states: int) -> list[Interval]:
        """Where the string is in one of the states: distances above the bit in m, from the bit up."""
        up, inside = self.rows[:, 0], np.isin(self.states, states)
        return _joined(up, inside)

    @property
    def buckled(self) -> list[tuple[float, float, int]]:
        """Buckled intervals from the bit up: measured depths of the lower and the upper end, and the state."""
        out = []
        for state in (SINUSOIDAL, HELICAL):
            out += [(self.depth - low, self.depth - high, state) for low, high in self.intervals(state)]
        return sorted(out, reverse=True)

    @cached_property
    def neutral_points(self) -> tuple[float, ...]:
        """Measured depths in m at which the effective force changes its sign, from the bit up."""
        md, f = self.measured_depth, self.forces
        cross = np.flatnonzero((f[:-1] * f[1:] < 0.0) & (md[:-1] > md[1:]))
        return tuple(float(self._neutral(int(j))) for j in cross)

    def _neutral(self, j: int) -> float:
        """The zero of the cubic through F and dF/du of a step."""
        up, f = self.rows[j : j + 2, 0], self.rows[j : j + 2, 1]
        h, piece = up[1] - up[0], self.pieces.table[int(self.rows[j, 6])]
        start = up[0] - (self.depth - self.pieces.bottom[int(self.rows[j, 6])])
        low, high = 0.0, 1.0
        slopes = [h * _slope(piece, start + t * h, self.rows[j + t, 3]) for t in (0, 1)]
        rise = f[1] - f[0]
        for _ in range(60):
            t = 0.5 * (low + high)
            value = f[0] + t * (rise + (1.0 - t) * ((1.0 - t) * (slopes[0] - rise) - t * (slopes[1] - rise)))
            low, high = (t, high) if value * f[0] > 0.0 else (low, t)
        return float(self.depth - up[0] - 0.5 * (low + high) * h)


def _slope(piece: FloatArray, up: float, contact: float) -> float:
    """dF/du at a height above the lower end of a piece."""
    angle = piece[1] - piece[2] * up
    cosine = piece[3] * math.cos(angle) + piece[4] * math.sin(angle)
    return float(piece[6] * cosine + piece[8] * contact)


def _joined(up: FloatArray, inside: BoolArray) -> list[Interval]:
    out: list[Interval] = []
    steps = np.flatnonzero(inside[:-1] & inside[1:] & (np.diff(up) > 0.0))
    for j in steps:
        low, high = float(up[j]), float(up[j + 1])
        if out and low <= out[-1][1] + 1e-9:
            out[-1] = (out[-1][0], high)
        else:
            out.append((low, high))
    return out


def run(
    cutter: Cutter,
    operation: Operation,
    contact: Contact,
    rule: str = "equal-energy",
    *,
    depth: float | None = None,
    bit_force: float | None = None,
    remembered: Sequence[Interval] = (),
    coarse: bool = False,
    crude: bool = False,
    record: bool = True,
    bent: FloatArray | None = None,
    longest_piece: float = math.inf,
) -> Run:
    """Integrate one operation from the bit up.

    Parameters
    ----------
    cutter, operation, contact, rule
        String in its hole; what is done; the law of contact, and which of several states holds.
    depth, bit_force
        In place of the operation's, in m and in N (tension positive).
    remembered
        Where the string has been helical before, distances above the bit in m: it stays so until the helix ceases.
    coarse, crude
        Whether forces are wanted to 1e-8, to 1e-5: what tells the error of a finer one.
    record
        Whether forces along the string are wanted.
    bent, longest_piece
        What bending adds to the contact force of each piece in N/m, (k,), and the longest piece in m.
    """
    place = operation.bit_depth if depth is None else depth
    pieces = cutter.pieces(operation, place, contact.helix_from(rule), contact.early, remembered, longest_piece)
    if bent is not None:
        pieces.table[:, STIFF] = bent
    start = operation.bit_force if bit_force is None else bit_force
    tolerance, longest = (COARSE, LONGEST_COARSE) if coarse else (FINE, LONGEST)
    tolerance = CRUDE if crude else tolerance
    most = BEYOND * math.sqrt(float(np.max(pieces.table[:, 7] * pieces.table[:, 6])) + 1e-300) + 10.0 * abs(start)
    rows = np.zeros((3 * len(pieces.table) + int(place / longest) + 2000 if record else 0, 7))
    while True:
        outcome, reached, force, torque, count, _ = march(
            pieces.table, contact.law, start, operation.bit_torque, tolerance, longest, most, rows
        )
        if count <= len(rows) or not record:
            break
        rows = np.zeros((count, 7))
    if outcome == LOCKED:
        force, torque = -math.inf, math.inf if operation.rotating else torque
    locked_at = place - reached if outcome == LOCKED else None
    return Run(operation, place, outcome, force, torque, locked_at, pieces, rows[: min(count, len(rows))], contact)


def error_of(fine: Run, coarse: Run) -> tuple[float, float]:
    """Errors of force in N and torque in N m at the surface, from a run a thousand times coarser: at least as large."""
    if not (fine.arrived and coarse.arrived):
        return math.inf, math.inf
    size = total_size(fine)
    model = fine.contact.error * contact_sum(fine)
    return (
        abs(fine.force - coarse.force) + ROUND_OFF * size + model,
        abs(fine.torque - coarse.torque) + ROUND_OFF * abs(fine.torque) + fine.contact.error * abs(fine.torque),
    )


def errors_along(fine: Run, coarse: Run) -> FloatArray:
    """Errors of the forces in N at the rows of ``fine``, (m,): the largest difference seen from the bit up to there.

    Compared is where both have rows, at the ends of pieces.
    """
    places, there = np.round(fine.rows[:, 0], 6), np.round(coarse.rows[:, 0], 6)
    order = np.argsort(there, kind="stable")
    last = np.searchsorted(there[order], places, side="right") - 1  # of those at the same place
    common = np.flatnonzero(last >= 0)
    row = order[last[common]]
    same = there[row] == places[common]
    differences = np.zeros(len(places))
    differences[common[same]] = np.abs(fine.rows[common[same], 1] - coarse.rows[row[same], 1])
    floor = ROUND_OFF * total_size(fine) if fine.arrived else 0.0
    return np.asarray(np.maximum.accumulate(differences) + floor)


def contact_sum(one: Run) -> float:
    """∫ μ n̄ over the buckled parts, along the hole: what an error of the law is a part of."""
    if not len(one.rows):
        return 0.0
    buckled = one.states != STRAIGHT
    along = np.abs(one.column(8)) * one.contacts * buckled
    return float(np.trapezoid(along, one.rows[:, 0]))


def total_size(one: Run) -> float:
    """Sum of all weights and of the forces at the ends in N: what round-off is a part of."""
    weights = float(np.sum(one.pieces.table[:, 0] * one.pieces.table[:, 6]))
    return weights + abs(one.force) + abs(one.operation.bit_force)


def balance(one: Run, survey: Survey) -> Value:
    """How far the work of the ends differs from that of gravity and friction, as a part of all of it.

    The end forces are those of the integration. Gravity's part comes from vertical depths of the survey by minimum
    curvature, friction's from contact forces along the string summed once more by another rule. Torque likewise.
    """
    table = one.pieces.table
    summed = summed_contact(table, one.contact.law, one.rows)
    drop = tvd_at(survey, one.pieces.bottom) - tvd_at(survey, one.pieces.top)
    weights, frictions = table[:, 6] * drop, table[:, 8] * summed
    start = float(one.rows[0, 1])
    left = one.force - start - float(np.sum(weights)) - float(np.sum(frictions))
    size = abs(one.force) + abs(start) + float(np.sum(np.abs(weights)) + np.sum(np.abs(frictions)))
    turning = float(np.sum(table[:, 9] * summed))
    torque = one.torque - one.operation.bit_torque - turning
    twisting = abs(one.torque) + abs(one.operation.bit_torque) + abs(turning)
    parts = [abs(left) / size if size else 0.0, abs(torque) / twisting if twisting else 0.0]
    return Value(max(parts), 0.0)


def tvd_at(survey: Survey, md: FloatArray) -> FloatArray:
    """True vertical depth below the first station at measured depths in m, by minimum curvature."""
    i = np.clip(np.searchsorted(survey.md, md, side="right") - 1, 0, len(survey) - 2)
    along = md - survey.md[i]
    angle, dogleg = np.radians(survey.inclination), survey.dogleg[i]
    part = along / np.diff(survey.md)[i]
    bent = dogleg > 1e-12
    sine = np.where(bent, np.sin(np.where(bent, dogleg, 1.0)), 1.0)
    first = np.where(bent, np.sin((1.0 - part) * dogleg) / sine, 1.0 - part)
    second = np.where(bent, np.sin(part * dogleg) / sine, part)
    here = first * np.cos(angle[i]) + second * np.cos(angle[i + 1])
    half = 0.5 * part * dogleg
    ratio = np.where(half > 1e-4, np.tan(half) / np.where(half > 1e-4, half, 1.0), 1.0 + half**2 / 3.0)
    return np.asarray(survey.tvd[i] + 0.5 * along * ratio * (np.cos(angle[i]) + here))


__all__ = ["STRAIGHT", "Run", "balance", "error_of", "errors_along", "run", "tvd_at"]
