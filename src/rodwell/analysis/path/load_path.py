"""The load path of a rod in a hole: what happens as the load grows quasi-statically, and comes back."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.discrete import first_run
from rodwell.analysis.off_wall.conditions import conditions
from rodwell.analysis.off_wall.control import FORCE, Control, shortening
from rodwell.analysis.off_wall.happening import END
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.state import ContactState, contact_state, plain
from rodwell.analysis.path.barrier import Barrier, barrier
from rodwell.analysis.path.bridged import bridging, farthest
from rodwell.analysis.path.checks import (
    checked_bridging,
    checked_control,
    checked_problem,
    checked_range,
    checked_wall,
)
from rodwell.analysis.path.events import LIFT_OFF, LOADING, SNAP, UNLOADING, Leg, PathPoint, PathState
from rodwell.analysis.path.legs import walked
from rodwell.analysis.path.loading import loaded
from rodwell.analysis.path.plain import found_or_why
from rodwell.analysis.path.straightening import How, straight_state
from rodwell.analysis.path.words import sentences
from rodwell.analysis.state.fields import GRID
from rodwell.analysis.straight.critical import critical_loads
from rodwell.errors import InputError, NotConvergedError, checked_whole
from rodwell.faces import Shown, drawn, face
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL, checked_force, checked_rtol
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    import xarray as xr

    from rodwell.faces import Axes

SEEDS = 3
"""Random disturbances with which a rod that gives way is sent downhill, either way along its softest direction."""

HARD = "hard wall"
ASSUMPTIONS = f"quasi-static, frictionless and without inertia; {HARD}"

Progress = Callable[[str, float], str | None]


@dataclass(frozen=True, eq=False)
class LoadPath(Shown):
    """What happens to a rod as the end force grows quasi-statically and, if asked for, comes back.

    Attributes
    ----------
    problem
        The rod in its hole.
    until, unload_to
        End forces at s = 1 in B/L², tension positive, or shortenings in L, to which it is loaded, and unloaded (None:
        not).
    events
        In order of happening: :class:`PathPoint`.
    legs
        The states that were found along the way, in order.
    reached
        Whether the path was followed all the way.
    ended_because
        Why it ended.
    rtol
        The tolerance asked for.
    mirror
        Whether it took the other arm of the buckling mode.
    control
        What is controlled: "force" or "shortening".
    compliance
        Of what gives way in series with the shape, 1/EA + 1/k in L³/B; 0: rigid.
    wall_stiffness
        Stiffness of the wall in B/L⁴, push per length and depth; infinite: hard.
    """

    problem: Problem
    until: float
    unload_to: float | None
    events: tuple[PathPoint, ...]
    legs: tuple[Leg, ...]
    reached: bool
    ended_because: str
    rtol: float
    mirror: bool = False
    control: str = "force"
    compliance: float = 0.0
    wall_stiffness: float = math.inf

    @property
    def way(self) -> Control:
        """What is controlled."""
        return FORCE if self.control == "force" else shortening(self.problem, self.compliance)

    def __repr__(self) -> str:
        unit = "B/L²" if self.control == "force" else "L of shortening"
        return f"<LoadPath to {self.until:g} {unit}: " + ", ".join(
            f"{one.kind} {one.force.value:.6g}" for one in self.events
        ) + ">"  # fmt: skip

    def first(self, kind: str, leg: str | None = None) -> PathPoint | None:
        """The first event of a kind (on a leg), or None."""
        return next((one for one in self.events if one.kind == kind and leg in (None, one.leg)), None)

    @property
    def lift_off(self) -> PathPoint | None:
        """Where the rod lifts off first, on loading."""
        return self.first(LIFT_OFF, LOADING)

    @property
    def snaps(self) -> tuple[PathPoint, ...]:
        """All snaps, in order."""
        return tuple(one for one in self.events if one.kind == SNAP)

    @property
    def missed(self) -> tuple[str, ...]:
        """Events whose load misses the tolerance, in words."""
        return tuple(
            f"{one.kind} at {one.force.value:.8g} ± {one.force.error:.0e}" for one in self.events if not one.met
        )

    def at(self, value: float) -> tuple[PathState, ...]:
        """States at a value of what is controlled (the end force, or the shortening), one for each leg that passes it.

        Raises
        ------
        InputError
            If no leg passes it.
        NotConvergedError
            If the state could not be solved for.
        """
        value = checked_force(self.control, value)
        control = self.way
        found = [
            PathState(leg.name, self._on(leg, value, control), control)
            for leg in self.legs if _passes(leg, value, control)
        ]  # fmt: skip
        if not found:
            raise InputError(
                self.control, value, f"the path does not pass it: {self.ended_because or 'see its events'}"
            )
        return tuple(found)

    def barrier(self, value: float, leg: str = LOADING) -> Barrier:
        """How large a disturbance makes the rod snap before it must: the saddle at a value of what is controlled.

        Parameters
        ----------
        value
            The end force at s = 1 in B/L², tension positive, or the shortening in L; the rod snaps later on the leg.
        leg
            "loading" or "unloading".

        Raises
        ------
        InputError
            If the leg does not pass that value, or the rod does not snap after it.
        NotConvergedError
            If the saddle was not found, or descent from it did not confirm what it lies between.
        """
        value = checked_force(self.control, value)
        taken = next((one for one in self.legs if one.name == leg), None)
        if taken is None or not taken.near(value, self.way):
            raise InputError(self.control, value, f"the {leg} path has no bent state there")
        state = self._on(taken, value, self.way)
        return barrier(taken, self.events, state, self.way, value)

    @property
    def assumptions(self) -> str:
        """What is assumed, in words."""
        if math.isinf(self.wall_stiffness):
            return ASSUMPTIONS
        return ASSUMPTIONS.replace(HARD, f"wall of stiffness {self.wall_stiffness:g} B/L⁴")

    @property
    def meaning(self) -> tuple[str, ...]:
        """What happens, in sentences: loads as compression at s = 1 in B/L²."""
        return sentences(self.problem, self.events)

    def _on(self, leg: Leg, value: float, control: Control) -> ContactState:
        model = RodInHole(self.problem, self.wall_stiffness)
        if _straight(leg, value, control):
            return contact_state(straight_state(model, control.straight_load(value) or 0.0))
        for near in leg.near(value, control):
            state = control.at(near, value)
            if state is not None and all(one.value > -1e-9 for one in conditions(state)):
                return contact_state(state)
        raise NotConvergedError(f"no state of the {leg.name} path was found at {control.name} = {value:.8g}")

    @cached_property
    def curve(self) -> dict[str, FloatArray]:
        """Load, shortening and energy of all states in order: ``force``, ``shortening``, ``energy``, ``run`` (k,) each.

        ``run`` counts unbroken pieces: a snap leads from one to the next.
        """
        rows = []
        run, square = 0, self.problem.clearance**2
        for leg in self.legs:
            for a, b in leg.straight[:1] if leg.name == LOADING else []:
                rows += [(a, 0.0, 0.0, run), (b, 0.0, 0.0, run)]
            for states in leg.runs:
                rows += [
                    (s.load, s.solved.out.energy_by_load * square, s.solved.out.energy * square, run) for s in states
                ]
                run += 1
            for a, b in leg.straight if leg.name == UNLOADING else []:
                rows += [(a, 0.0, 0.0, run), (b, 0.0, 0.0, run)]
        columns = np.array(rows, dtype=float).reshape(-1, 4).T
        return dict(zip(("force", "shortening", "energy", "run"), columns, strict=True))

    def as_dict(self, at: Sequence[float] = (), barriers: Sequence[float] = ()) -> dict[str, Any]:
        """Plain data, for JSON, with the states at the end forces ``at``, and the barriers at others."""
        out = {
            "events": [{**one.as_dict(), **self._driven(one)} for one in self.events],
            "states": found_or_why(at, lambda value: [one.as_dict() for one in self.at(value)]),
            "reached": self.reached,
            "ended_because": self.ended_because,
            "control": self.control,
            "compliance": self.compliance,
            "assumptions": self.assumptions,
            "wall_stiffness": self.wall_stiffness if math.isfinite(self.wall_stiffness) else None,
        }
        if barriers:
            out["barriers"] = found_or_why(barriers, lambda value: [self.barrier(value).as_dict()])
        return out

    def _driven(self, event: PathPoint) -> dict[str, Any]:
        """The controlled shortening at an event, for JSON."""
        found = self.driven(event)
        return {} if found is None else {"driven": plain(found)}

    def driven(self, event: PathPoint) -> Value | None:
        """The shortening of the driven end at an event, in L, with its error; None where the force is controlled."""
        if self.way.by_force:
            return None
        force, own = event.force, Value(0.0, 0.0) if event.state is None else event.state.shortening
        if event.to is not None:
            force = event.to.force
        return Value(own.value - self.compliance * force.value, own.error + self.compliance * force.error)

    def dataset(self, places: int = GRID) -> xr.Dataset:
        """States, what touches in them, and events as an xarray Dataset: see :mod:`rodwell.store.path_arrays`."""
        data: xr.Dataset = face("dataset")(self, places)
        return data

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw load against shortening, with events and snaps."""
        return drawn(self, ax)


def _straight(leg: Leg, value: float, control: Control) -> bool:
    """Whether the rod is straight on a leg at a value of what is controlled."""
    load = control.straight_load(value)
    return load is not None and any(min(a, b) <= load <= max(a, b) for a, b in leg.straight)


def _passes(leg: Leg, value: float, control: Control) -> bool:
    return _straight(leg, value, control) or bool(leg.near(value, control))


def load_path(
    problem: Problem,
    *,
    until: float | None = None,
    unload_to: float | None = None,
    control: str = "force",
    axial_stiffness: float | None = None,
    spring: float | None = None,
    wall_stiffness: float = math.inf,
    mirror: bool = False,
    seeds: int = SEEDS,
    rtol: float = RTOL,
    progress: Progress | None = None,
) -> LoadPath:
    """Load a rod in a hole quasi-statically, let it buckle, lift off, and snap where it must, and unload it.

    Parameters
    ----------
    problem
        The rod; it may leave the wall.
    until
        End force at s = 1 in B/L², tension positive, to which the compression grows. It may be left out where the
        clearance has steps: the path ends there where the string buckles.
    unload_to
        End force to which it is taken back; None: not at all.
    control
        "force": the end force is a dead load; or "shortening": the approach of the ends is prescribed, as by a stiff
        machine. Then ``until`` and ``unload_to`` are shortenings in L, the load may pass extrema, and the stability
        index is that of the rod so held.
    axial_stiffness, spring
        EA of the rod in B/L², and stiffness k in B/L³ of a spring through which it is driven, where the shortening is
        controlled; None: rigid. Then ``until`` and ``unload_to`` are those of the driven end, u − F/EA − F/k with the
        shortening u of the shape, counted from the straight rod without end force. What the strain F/EA changes in the
        shape is left out.
    wall_stiffness
        Stiffness k L⁴/B of a wall that gives way: it pushes by k times the depth, per length, where the rod's axis is
        farther from the hole's than Δ. Infinite: a hard wall.
    mirror
        The other of the two arms of the buckling mode: with twist they differ.
    seeds
        How many random disturbances, each either way along the softest direction, are tried where the rod gives way.
    rtol
        Relative tolerance of every load reported.
    progress
        Called with the leg and the end force of each new state. A text that it returns ends the path there, as the
        reason, with all that was found.

    Notes
    -----
    Where the clearance has steps (``problem.sections``) the string bridges them, off the wall. It is followed in the
    vertical plane, from where it is stretched everywhere: its ``critical`` event is the first load at which a
    disturbance out of the plane grows. States beyond are not computed, nor are twist and unloading taken. A step is
    taken at its place along the rod: that the rod is pushed along the hole by its shortening is left out.

    Raises
    ------
    InputError
        For a rod outside the cylinder or on top of it, for loads out of range or order.
    NotConvergedError
        If the straight rod's critical load, or the path's first state, could not be computed.
    """
    checked_problem(problem)
    model = RodInHole(problem, checked_wall(problem, wall_stiffness))
    rtol, way = checked_rtol(rtol), checked_control(problem, control, axial_stiffness, spring)
    if problem.bridges:
        checked_bridging(problem, control, unload_to, mirror)
    if until is None:
        if not problem.bridges:
            raise InputError("until", None, "is missing: give the end force to which the rod is loaded")
        until = farthest(problem)
    until, unload_to = checked_range(way, until, unload_to)
    seeds = checked_whole("seeds", seeds, 1, 100)

    def told(leg: str) -> Callable[[float], str | None] | None:
        return None if progress is None else lambda force: progress(leg, force)

    if problem.bridges:
        walks = [bridging(model, until, rtol, told(LOADING))]
    else:
        first_run.begin(problem)
        mode = critical_loads(problem, 1, rtol=rtol)[0]
        walks = [loaded(model, until, mirror, How(way, rtol, seeds, mode, told(LOADING)))]
        if walks[0].ended == END and unload_to is not None:
            how = How(way, rtol, seeds, mode, told(UNLOADING))
            walks.append(walked(walks[0].last, model, until, unload_to, Leg(UNLOADING), how))
    ended = next((walk.ended for walk in walks if walk.ended != END), "")
    events = tuple(event for walk in walks for event in walk.events)
    legs = tuple(walk.leg for walk in walks)
    return LoadPath(
        problem, until, unload_to, events, legs, not ended, ended, rtol, mirror, way.name, way.compliance,
        model.stiffness,
    )  # fmt: skip
