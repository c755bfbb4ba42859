"""The part of a branch off the wall: its states in order, and where something happens among them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.beyond.between import around, nearest_first, state_at
from rodwell.analysis.discrete.measures import MEASURES, Measured, measured
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.control import FORCE
from rodwell.analysis.off_wall.curved.own_places import bends_along
from rodwell.analysis.off_wall.measured import measured as numbers_of
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.state.fields import GRID
from rodwell.errors import InputError, checked_number
from rodwell.faces import face
from rodwell.numerics.stretches.carry import sampler
from rodwell.problem.ends import HOLDS_SLOPE
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray, IntArray
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    import xarray as xr

END = "end"

KNOWN_BEYOND = (Measured.ENERGY, Measured.SHORTENING, Measured.OMEGA2_0, Measured.OMEGA2_1)
"""Measured numbers that a state off the wall has too."""


@dataclass(frozen=True, eq=False)
class OffWallPoint:
    """A place of a branch, off the wall, where something happens.

    Attributes
    ----------
    kind
        "gap_opens", "gap_closes", "contact_point", "contact_line", "contact_splits", "contacts_merge", "contact_lost",
        "touches", "touch_down" (contact is complete again), "fold", "branch_point", or "end".
    reached
        End force at s = 1 in B/L², tension positive, with the estimate of its error.
    s
        Where along the rod, in L; empty where it concerns the whole of it.
    index_before, index_after
        Stability index on either side, in the direction of travel.
    state
        The state there.
    met
        Whether the load meets the tolerance.
    """

    kind: str
    reached: Value
    s: tuple[float, ...]
    index_before: int
    index_after: int
    state: ContactState
    met: bool = True

    def __repr__(self) -> str:
        where = f", s = {', '.join(f'{s:.4g}' for s in self.s)}" if self.s else ""
        index = f"index {self.index_before} → {self.index_after}"
        return f"<OffWallPoint {self.kind} at force = {self.force:.10g}{where}, {index}>"

    @property
    def force(self) -> float:
        """End force at s = 1 in B/L², tension positive."""
        return self.reached.value

    def as_dict(self) -> dict[str, Any]:
        """The point without its state as plain data, for JSON."""
        return {
            "kind": self.kind, "force": self.force, "error": self.reached.error, "index_before": self.index_before,
            "index_after": self.index_after, "s": list(self.s), "converged": self.met,
        }  # fmt: skip


@dataclass(frozen=True, eq=False)
class OffWallBranch:
    """States with which a branch goes on beyond lift-off, off the wall, in the order of travel.

    Attributes
    ----------
    problem
        The problem.
    states
        The states, the first at lift-off: each on one set of elements (:meth:`state` has it with errors).
    special_points
        In order of travel: see :class:`OffWallPoint`. The last is the end.
    reached_end
        Whether it was followed to where it was asked to end.
    ended_because
        Why it ended: "end", or in words.
    until
        The end force at which it was asked to end, in B/L², tension positive.
    rtol
        Relative tolerance of the loads of its special points.
    """

    problem: Problem
    states: tuple[PatternedState, ...]
    special_points: tuple[OffWallPoint, ...]
    reached_end: bool
    ended_because: str
    until: float
    rtol: float

    def __len__(self) -> int:
        return len(self.states)

    def __repr__(self) -> str:
        return f"<OffWallBranch: {len(self)} states, force = {self.force[0]:.6g} … {self.force[-1]:.6g}>"

    @cached_property
    def force(self) -> FloatArray:
        """End force F at s = 1 of each state in B/L², tension positive, (n,)."""
        return np.array([state.load for state in self.states])

    @cached_property
    def stability_index(self) -> IntArray:
        """Stability index of each state, (n,): under dead loads, with contacts that push kept closed."""
        return np.array([state.solved.index for state in self.states])

    @cached_property
    def largest_gap(self) -> FloatArray:
        """The largest gap of each state in Δ, (n,)."""
        return np.array([float(np.max(numbers_of(state).gaps, initial=0.0)) for state in self.states])

    def numbers(self, which: Measured | str) -> FloatArray:
        """A measured number of all states, (n,): energy, end_shortening, omega2_at_0 or omega2_at_1.

        ω₂ at an end is the curvature around the hole, as on the wall.

        Raises
        ------
        InputError
            If a state off the wall does not have it.
        """
        return np.array([number_off_wall(state, measured(which)) for state in self.states])

    def state(self, i: int) -> ContactState:
        """State number ``i`` with errors and certificate.

        Raises
        ------
        NotConvergedError
            If it was not found on finer elements.
        """
        known = {id(point.state.coarse): point.state for point in self.special_points}
        here = self.states[i]
        return known.get(id(here)) or contact_state(here)

    def states_at(self, force: float) -> tuple[ContactState, ...]:
        """All states at an end force in B/L², tension positive, in the order of travel; none where it passes none.

        Raises
        ------
        NotConvergedError
            If one could not be computed.
        """
        force = checked_number("force", force, -1e12, 1e12, "a finite number")
        pairs = around(self.states, force, FORCE)
        exact = [  # a state that stands there belongs to two pairs
            k for k, (first, _) in enumerate(pairs) if k and first.load == force
        ]  # fmt: skip
        return tuple(
            state_at(nearest_first(pair, force, FORCE), force, FORCE, "branch off the wall")
            for k, pair in enumerate(pairs) if k not in exact
        )  # fmt: skip

    def passes(self, force: float) -> bool:
        """Whether it has a state at an end force in B/L², tension positive."""
        return bool(self.force.min() <= force <= self.force.max())

    def at(self, force: float) -> ContactState:
        """The first state at an end force in B/L², tension positive.

        Raises
        ------
        InputError
            If it does not pass that force.
        NotConvergedError
            If the state could not be computed.
        """
        force = checked_number("force", force, -1e12, 1e12, "a finite number")
        pairs = around(self.states, force, FORCE)
        if not pairs:
            low, high = float(np.min(self.force)), float(np.max(self.force))
            raise InputError("force", force, f"off the wall this branch covers {low:.6g} to {high:.6g} B/L²; it ended "
                             f"there: {self.ended_because}")  # fmt: skip
        return state_at(nearest_first(pairs[0], force, FORCE), force, FORCE, "branch off the wall")

    @property
    def converged(self) -> bool:
        """Whether the loads of all special points meet the tolerance."""
        return all(point.met for point in self.special_points)

    def dataset(self, places: int = GRID) -> xr.Dataset:
        """States, what touches in them, and special points as a Dataset: see :mod:`rodwell.store.path_arrays`."""
        data: xr.Dataset = face("dataset")(self, places)
        return data

    def as_dict(self) -> dict[str, Any]:
        """Plain data, for JSON."""
        return {
            "points": len(self), "reached_end": self.reached_end, "ended_because": self.ended_because,
            "converged": self.converged, "special_points": [point.as_dict() for point in self.special_points],
        }  # fmt: skip


def number_off_wall(state: PatternedState, which: Measured) -> float:
    """A measured number of a state off the wall: see :meth:`OffWallBranch.numbers`."""
    square = state.problem.clearance**2
    if which == Measured.ENERGY:
        return float(state.solved.out.energy * square)
    if which == Measured.SHORTENING:
        return float(state.solved.out.energy_by_load * square)
    if which not in KNOWN_BEYOND:
        names = ", ".join(MEASURES[one] for one in KNOWN_BEYOND)
        raise InputError("number", MEASURES[which], f"is known on the wall only: off it take one of {names}")
    end = 1 if which == Measured.OMEGA2_1 else 0
    if state.problem.ends[end] not in HOLDS_SLOPE:
        return 0.0
    fields, angle = sampler(state.solved.shape)(np.array([float(end)]))
    around_hole = np.array([np.sin(angle[0, 0]), np.cos(angle[0, 0])])
    k = bends_along(state, np.array([float(end)]))[:, 0]
    turned = k / (1.0 - state.problem.clearance * k @ fields[:, 0, 0])  # with the hole
    return float(-around_hole @ (state.problem.clearance * fields[:, 2, 0] + turned))
