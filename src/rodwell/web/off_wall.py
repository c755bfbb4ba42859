"""The rod off the wall for the page: its load path as two more branches, and states on it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.curved.own_places import bends_along
from rodwell.analysis.off_wall.measured import position
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path.events import LOADING, SNAP, UNLOADING, Leg, PathPoint
from rodwell.analysis.path.load_path import LoadPath
from rodwell.answers.result import beyond
from rodwell.answers.result.computed import Computed
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Peak, Value

LEGS = {LOADING: "load path", UNLOADING: "load path, unloading"}
"""Legs as branches of the page."""


AT_SNAP = 1e-3
"""Within this part of the load of a snap a run of states that ends there was followed to it."""


def leg_of(name: str) -> str:
    """The leg that a branch of the page is."""
    return next(leg for leg, known in LEGS.items() if known == name)


def followed(computed: Computed, tell: Callable[[str, float], None]) -> tuple[LoadPath | None, str]:
    """The load path as ``rodwell run`` follows it, but without an end to patience; or None and why there is none.

    ``tell`` is called with what is being done; what it raises ends the computation.
    """

    def progress(leg: str, force: float) -> None:
        tell(f"beyond lift-off: {leg}", 0.0)

    return beyond.followed(computed, progress)


def states_at(path: LoadPath, name: str, force: float) -> tuple[ContactState, ...]:
    """The state of a leg at an end force F in B/L²; none if the leg does not pass it."""
    legs = [leg for leg in path.legs if LEGS[leg.name] == name]
    if not any(leg.near(force, path.way) or _straight(leg, force) for leg in legs):
        return ()
    return tuple(one.state for one in path.at(force) if LEGS[one.leg] == name)


def _straight(leg: Leg, force: float) -> bool:
    return any(min(ends) <= force <= max(ends) for ends in leg.straight)


def events_of(path: LoadPath, name: str) -> list[PathPoint]:
    """The events of a leg that have a state of their own."""
    return [event for event in path.events if LEGS[event.leg] == name and event.state is not None]


def before_snap(path: LoadPath, event: PathPoint) -> PatternedState | None:
    """The state from which the rod snaps: the last of the run that ends there; None if it was straight."""
    runs = [run for leg in path.legs if leg.name == event.leg for run in leg.runs if run]
    last = min((run[-1] for run in runs), key=lambda state: abs(state.load - event.force.value), default=None)
    if last is None or abs(last.load - event.force.value) > AT_SNAP * abs(event.force.value):
        return None
    return last


def snaps_at(path: LoadPath) -> PathPoint | None:
    """The first snap as the load grows."""
    return path.first(SNAP, LOADING)


def ordinates(state: PatternedState) -> dict[Measured, float]:
    """What the diagram draws upwards, as far as a rod off the wall has it: the torque T₂(0) is left out."""
    square = state.problem.clearance**2
    ends = position(state, np.array([0.0, 0.5, 1.0]))
    out = state.solved.out
    bends = bends_along(state, np.array([0.0, 0.5, 1.0]))
    first, last = (_sideways(ends[0][:, i], ends[1][:, i], bends[:, i]) for i in (0, 2))
    return {
        Measured.OMEGA2_0: first, Measured.OMEGA2_1: last, Measured.ENERGY: out.energy * square,
        Measured.SHORTENING: out.energy_by_load * square,
        Measured.ANGLE_MID: float(np.arctan2(ends[1][0, 1], -ends[0][0, 1])),
        Measured.P_MAX: 0.0 if not state.pattern.full else float(_pressure(state).max()),
    }  # fmt: skip


def _sideways(x: FloatArray, y: FloatArray, k: FloatArray) -> float:
    """Curvature across the direction to the axis, ω₂ of (20), of a rod on the wall there: position with derivatives.

    ``k``: that of the hole there, k₁ and k₂, which bends the rod, too.
    """
    angle, narrowed = np.arctan2(y[0], -x[0]), 1.0 - k[0] * x[0] - k[1] * y[0]
    return float(-(x[2] + k[0] / narrowed) * np.sin(angle) - (y[2] + k[1] / narrowed) * np.cos(angle))


def _pressure(state: PatternedState) -> FloatArray:
    return position(state, np.linspace(0.0, 1.0, 401))[2]


Number = tuple[str, str, Value | Peak, float | None]
"""Label, name in the nomenclature, value, place s/L."""


def numbers(state: ContactState) -> dict[str, Number]:
    """Numbers of a state."""
    gap = max(state.gaps, key=lambda one: one.largest.value, default=None)
    point = max(state.point_forces, key=lambda one: one.force.value, default=None)
    size, pressure = state.problem.clearance, state.largest_pressure
    out: dict[str, Number] = {
        "largest_push": ("largest push on the wall per length", "contact_pressure", pressure, pressure.s),
        "contact_total": ("contact force, all directions added", "force", state.contact_total, None),
        "end_shortening": ("approach of the ends", "end_shortening", state.shortening, None),
        "energy": ("energy", "energy", state.energy, None),
    }
    if point is not None:
        out["largest_point_force"] = ("largest concentrated push on the wall", "force", point.force, point.s.value)
    if gap is not None:
        far = Value(size * gap.largest.value, size * gap.largest.error)
        out["largest_gap"] = ("largest gap between rod and wall", "z", far, gap.at)
    return out
