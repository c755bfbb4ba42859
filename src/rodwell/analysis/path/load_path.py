"""The load path of a rod in a hole: what happens as the load grows quasi-statically, and comes back."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rodwell.analysis.beyond.between import state_at
from rodwell.analysis.off_wall.control import FORCE, Control, shortening
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.path.barrier import Barrier, barrier
from rodwell.analysis.path.checks import checked_value
from rodwell.analysis.path.events import LIFT_OFF, LOADING, SNAP, UNLOADING, Leg, PathPoint, PathState
from rodwell.analysis.path.straightening import straight_state
from rodwell.analysis.path.words import sentences
from rodwell.analysis.state.fields import GRID
from rodwell.errors import InputError, NotConvergedError, RodwellError
from rodwell.faces import Shown, drawn, face
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.text import plain
from rodwell.quantities.value import Value

if TYPE_CHECKING:
    from pathlib import Path

    import xarray as xr

    from rodwell.faces import Axes

HARD = "hard wall"
ASSUMPTIONS = f"quasi-static, frictionless and without inertia; {HARD}"


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
        control = self.way
        value = checked_value(control, self.control, value)
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
        value = checked_value(self.way, self.control, value)
        known = self._barriers
        if (value, leg) not in known:
            taken = next((one for one in self.legs if one.name == leg), None)
            if taken is None or not taken.near(value, self.way):
                raise InputError(self.control, value, f"the {leg} path has no bent state there")
            try:
                state = self._on(taken, value, self.way)
                known[value, leg] = barrier(taken, self.events, state, self.way, value)
            except NotConvergedError as error:
                known[value, leg] = error
        found = known[value, leg]
        if isinstance(found, NotConvergedError):
            raise found
        return found

    @cached_property
    def _barriers(self) -> dict[tuple[float, str], Barrier | NotConvergedError]:
        """Those asked for, or why there is none, which take long: files and text tell the same."""
        return {}

    @property
    def assumptions(self) -> str:
        """What is assumed, in words."""
        if math.isinf(self.wall_stiffness):
            return ASSUMPTIONS + self._left_out()
        return ASSUMPTIONS.replace(HARD, f"wall of stiffness {self.wall_stiffness:g} B/L⁴")

    def _left_out(self) -> str:
        """What the wall's push along the hole may change of loads beyond buckling where the clearance varies."""
        states = [event.state for event in self.events if event.state is not None]
        if not self.problem.ramps or not states:
            return ""
        most = max(state.left_out["axial_force"] for state in states)
        return f"; once it has buckled the wall's push along the hole is left out, {plain(most, 2)} B/L² at most"

    @property
    def meaning(self) -> tuple[str, ...]:
        """What happens, in sentences: loads as compression at s = 1 in B/L²."""
        return sentences(self.problem, self.events)

    def _on(self, leg: Leg, value: float, control: Control) -> ContactState:
        model = rod_in_hole(self.problem, self.wall_stiffness)
        if _straight(leg, value, control):
            return contact_state(straight_state(model, control.straight_load(value) or 0.0))
        return state_at(leg.near(value, control), value, control, f"{leg.name} path")

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
            "states": _found_or_why(at, lambda value: [one.as_dict() for one in self.at(value)]),
            "reached": self.reached,
            "ended_because": self.ended_because,
            "control": self.control,
            "compliance": self.compliance,
            "assumptions": self.assumptions,
            "wall_stiffness": self.wall_stiffness if math.isfinite(self.wall_stiffness) else None,
        }
        if barriers:
            out["barriers"] = _found_or_why(barriers, lambda value: [self.barrier(value).as_dict()])
        return out

    def _driven(self, event: PathPoint) -> dict[str, Any]:
        """The controlled shortening at an event, for JSON."""
        found = self.driven(event)
        return {} if found is None else {"driven": found.as_dict()}

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

    def animate(self, file: str | Path) -> Path:
        """Write the states in order as an animation: load against shortening, the rod along the hole and from its end.

        Returns the file, a GIF or WebP by its suffix.

        Raises
        ------
        InputError
            If the suffix is another one, or the file cannot be written.
        """
        written: Path = face("animation")(self, file)
        return written


def _straight(leg: Leg, value: float, control: Control) -> bool:
    """Whether the rod is straight on a leg at a value of what is controlled."""
    load = control.straight_load(value)
    return load is not None and any(min(a, b) <= load <= max(a, b) for a, b in leg.straight)


def _passes(leg: Leg, value: float, control: Control) -> bool:
    return _straight(leg, value, control) or bool(leg.near(value, control))


def _found_or_why(values: Sequence[float], found: Callable[[float], list[dict[str, Any]]]) -> list[dict[str, Any]]:
    """What is found at values of what is controlled, in order, or why nothing is."""
    out = []
    for value in values:
        try:
            out += found(value)
        except RodwellError as error:
            out.append({"force": value, "reached": False, "why": str(error)})
    return out
