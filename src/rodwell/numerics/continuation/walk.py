"""Pseudo-arclength continuation with events.

The loop knows no event by name: an event is a function of λ and of the measured numbers whose zeros matter.
Changes of the stability index are located too, each resolved into the crossings that make it up, and so are
places where λ turns back. A step that cannot be explained in this way is repeated with half the length.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rodwell.numerics.continuation.closing import CLOSED, closes
from rodwell.numerics.continuation.events import Event, Leaving, LocatedEvent
from rodwell.numerics.continuation.location import LeftTheBranchError, LocationError
from rodwell.numerics.continuation.prediction import Predictor
from rodwell.numerics.continuation.softest import SoftestEigenvalues, hidden_change
from rodwell.numerics.continuation.stretch import events_between
from rodwell.numerics.equilibria.outcome import Outcome
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.quantities.arrays import FloatArray

DOUBTED_STEP = 0.02
"""A step, as a part of the first, past a place where branches come closer to each other than can be told apart."""

SURE = 0.1
"""A step, as a part of the first, in which a change of the stability index that cannot be placed is let pass."""

FEWEST_OF_A_LOOP = 6
"""Points after which a branch may have come back to its start."""

LARGEST_PREDICTION_ERROR = 0.2
"""A step whose end lies farther from where it was predicted, as a part of its length, may have left the branch."""


@dataclass(frozen=True)
class Stepping:
    """Step lengths of continuation, in the metric of the family, and when to give up."""

    first: float
    largest: float
    smallest: float = 1e-7
    most_points: int = 2000
    most_work: float = np.inf  # elements times solves
    sharpest_turn: float = 0.35  # radians between successive tangents


@dataclass
class Trace:
    """What continuation found: points in order, the meshes each stands on, located events, why it ended."""

    points: list[MeshedState] = field(default_factory=list)
    meshes: list[TwoMeshes] = field(default_factory=list)
    found: list[LocatedEvent] = field(default_factory=list)
    end: str = ""

    def step_back(self, count: int) -> float:
        """Take the last points back; returns how far apart the next and the one after it were."""
        gap = self.points[-count - 1].coarse.space is self.points[-count].coarse.space
        apart = self.points[-count - 1].coarse.along(self.points[-count].coarse) if gap else np.inf
        del self.points[-count:], self.meshes[-count:]
        self.found = [item for item in self.found if item.after < len(self.points) - 1]
        return float(abs(apart))


Progress = Callable[[MeshedState], None]
Halt = Callable[[Trace], str]
"""Why the branch ends at the last point of a trace, or "" if it goes on."""

Stop = Callable[[LocatedEvent], str]
"""Why the branch ends at something located, or "" if it goes on; a LocationError if that is not to be trusted."""


def trace(
    meshes: TwoMeshes,
    start: MeshedState,
    stepping: Stepping,
    events: Sequence[Event],
    *,
    stop: Stop,
    leaves: Leaving | None = None,
    progress: Progress | None = None,
    halt: Halt | None = None,
) -> Trace:
    """Follow the branch from ``start`` along its tangent until something found stops it, or a limit is met.

    A step is repeated with half the length if the corrector fails, if the branch turns by more than allowed, if the
    end strays from where it was predicted, or if an event in it cannot be located (down to a tenth of the first step
    if it is where the stability index changes, which is then uncertain); the last two steps are, if
    the stability index changed and changed back within them. If the step falls below
    ``stepping.smallest``, the branch ends and ``Trace.end`` says why. ``leaves`` says that ``start`` is a
    branch point, whose stability index is that of the branch left. ``halt`` looks at the trace at its start and after
    each step, and may end it.
    """
    walk = _Walk(stepping, events, stop, leaves, Trace([start], [meshes]), Predictor(start.coarse), halt)
    walk.to_the_end(progress)
    return walk.trace


@dataclass
class _Walk:
    """What happens step by step, see :func:`trace`.

    After a step that had to be repeated, steps are ``careful`` until they are as long as the first: next to a sharp
    turn the Hessian is nearly singular, and tangent and index that belong to the iterate before the last will not do.
    """

    stepping: Stepping
    events: Sequence[Event]
    stop: Stop
    leaves: Leaving | None
    trace: Trace
    predictor: Predictor
    halt: Halt | None = None
    softest: SoftestEigenvalues = field(default_factory=SoftestEigenvalues)
    careful: bool = False
    left: bool = False
    doubted: bool = False
    work: float = 0.0

    def to_the_end(self, progress: Progress | None) -> None:
        """Make steps until something ends the branch."""
        trace, stepping = self.trace, self.stepping
        length = stepping.first
        trace.end = self.halt(trace) if self.halt else ""
        while not trace.end:
            self.work += 4.0 * trace.meshes[-1].fine.space.elements  # about that many solves a step
            trace.end = self._limit()
            turn = trace.end or self._advance(length)
            if trace.end:
                return
            if isinstance(turn, str):
                length, self.careful = 0.5 * length, True
                self.predictor.restart(trace.points[-1].coarse)
                if length < stepping.smallest and self.left and not self.doubted:
                    self.doubted, length = True, DOUBTED_STEP * stepping.first  # branches closer than can be told apart
                trace.end = turn if length < stepping.smallest else ""
                continue
            self.doubted = False
            self.left = self.left and length < DOUBTED_STEP * stepping.first
            dips = self.softest.dips() if length > stepping.smallest else []
            if dips and hidden_change(trace.meshes, trace.points, dips):
                length = 0.25 * min(length, trace.step_back(2))
                self.predictor.restart(trace.points[-1].coarse)
                self.softest.forget(2)
                continue
            if progress is not None:
                progress(trace.points[-1])
            if self.halt is not None:
                trace.end = self.halt(trace)
            self.careful = self.careful and length < stepping.first
            length = min(stepping.largest, length * min(2.0, 0.5 * stepping.sharpest_turn / max(turn, 1e-3)))

    def _limit(self) -> str:
        """Why the branch must end here, or ""."""
        if self.work > self.stepping.most_work:
            return "the work allowed for one branch is used up: ask for less far, or for a larger rtol"
        if len(self.trace.points) >= self.stepping.most_points:
            return f"the limit of {self.stepping.most_points} points was reached"
        return ""

    def _advance(self, length: float) -> float | str:
        """Make one step and add it to the trace with its events; return the turn of the tangent, or what went wrong."""
        trace = self.trace
        last, meshes = trace.points[-1], trace.meshes[-1]
        why, new_meshes, point, turn, factors = self._step(meshes, last.coarse, length)
        if point is None:
            return why
        base = last
        if new_meshes is not meshes:
            outcome, adopted = new_meshes.adopt(meshes, last)
            if adopted is None:
                return new_meshes.coarse.advice(outcome)
            base, factors = adopted, None
        home = self._home(new_meshes, base, point)
        point = home or point
        try:
            opening = len(trace.points) == 1
            leaves = self.leaves if opening else None
            found = events_between(
                new_meshes, base, point, self.events, opening=opening, leaves=leaves, doubted=self.doubted
            )
            if not (self.doubted or length < SURE * self.stepping.first or all(item.certain for item in found)):
                return "the place at which the stability index changes is not found in so long a step"
            end = next((i for i, item in enumerate(found) if self.stop(item)), None)
        except LocationError as error:
            self.left = self.left or isinstance(error, LeftTheBranchError)
            return str(error)
        trace.points[-1], trace.meshes[-1] = base, new_meshes
        if end is not None:
            found = found[: end + 1]
            trace.end, point, new_meshes = self.stop(found[end]), found[end].point, found[end].meshes
        elif home is not None:
            trace.end = CLOSED
        trace.found += [replace(item, after=len(trace.points) - 1) for item in found]
        trace.points.append(point)
        trace.meshes.append(new_meshes)
        if not trace.end:
            if new_meshes is not meshes:
                self.predictor.restart(base.coarse)
            self.predictor.add(point.coarse)
            self.softest.add(new_meshes, point, length, factors)
        return turn

    def _home(self, meshes: TwoMeshes, before: MeshedState, after: MeshedState) -> MeshedState | None:
        """The start of the branch, if it has come back there in a step."""
        trace = self.trace
        if len(trace.points) < FEWEST_OF_A_LOOP:
            return None
        return closes(meshes, before, after, trace.meshes[0], trace.points[0])

    def _step(
        self, meshes: TwoMeshes, state: State, length: float
    ) -> tuple[str, TwoMeshes, MeshedState | None, float, FloatArray | None]:
        """Try one step: what went wrong (or ""), meshes, point or None, turn of the tangent, coarse factors."""
        expected = self.predictor.ahead(length)
        family, tolerance = meshes.coarse, meshes.coarse_tolerance
        if self.careful:
            family, tolerance = family.with_exact_tangent(), family.tolerance
        outcome, coarse, prediction_error, factors = family.step_to(state, length, *expected, tolerance)
        if coarse is None:
            return meshes.coarse.advice(outcome), meshes, None, 0.0, None
        cosine = float(state.row @ coarse.tangent) + state.row_lam * coarse.tangent_lam
        turn = math.acos(min(1.0, cosine))
        if turn > self.stepping.sharpest_turn:
            return "the branch turns too sharply to be followed", meshes, None, turn, None
        if prediction_error > LARGEST_PREDICTION_ERROR * length:
            return "the steps stray from the branch", meshes, None, turn, None
        outcome, meshes, point = meshes.resolve(coarse, exact=self.careful)
        return (meshes.coarse.advice(outcome) if outcome is not Outcome.CONVERGED else ""), meshes, point, turn, factors
