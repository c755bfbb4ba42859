"""States and events to a tolerance: elements of a higher degree until the numbers agree, and the error that remains."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.off_wall.arrange import refined
from rodwell.analysis.off_wall.certificate import contact_certificate
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.happening import BRANCH_POINT, FOLD, LOAD_PEAK, PathEvent
from rodwell.analysis.off_wall.pattern import FINER
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.stretches.walk import AS_GOOD_AS_ZERO, locate, search, step, tangent
from rodwell.quantities.value import Value

MOST_DEGREES = 8
"""How much the degree may grow."""

PART = 0.02
"""Part of the tolerance at which elements are fine enough."""

UNKNOWN = 1e-5
"""Relative error that an event is given which could not be located again on finer elements: it counts as not met."""

SEARCH, FARTHEST = 1e-6, 0.1
"""First and longest step along the path in which an event is sought again on finer elements."""

BESIDE, SAMPLES = 1e-5, (-1.0, -0.5, 0.5, 1.0)
"""Arclength to either side of an event, and parts of it, at which load and watched number are taken beside it."""


@dataclass(frozen=True, eq=False, repr=False)
class ResolvedEvent:
    """An event on finer elements, and its load with the estimate of the error; ``met``: within the tolerance."""

    event: PathEvent
    load: Value
    met: bool


def resolved_event(event: PathEvent, rtol: float) -> ResolvedEvent:
    """Locate an event again on elements of higher degree, until its load changes by no more than the tolerance.

    And until the state there passes its certificate, if that can be had.
    """
    if event.value is None or event.along is None:
        if event.kind == FOLD and event.state.model.inclined:  # a first state behind a fold, which was not located
            return ResolvedEvent(event, Value(event.state.load, UNKNOWN * abs(event.state.load)), False)
        return ResolvedEvent(event, Value(event.state.load, 0.0), True)
    load, error = event.state.load, UNKNOWN * abs(event.state.load)
    best, noise = event, 0.0
    for more in range(FINER, MOST_DEGREES + 1, FINER):
        finer = _again(event, more)
        if finer is None:
            break
        now, noise = _load_of(finer)
        error = float(estimated_error(now, load)) + noise
        best, load = finer, now
        if error <= PART * rtol * abs(load) and contact_certificate(best.state).passed:
            break
    if best.kind == BRANCH_POINT and best.between is not None and not best.state.pattern.planar:
        # the equations are all but singular there: Newton's method is not kept off the disturbance that grows
        first, second = best.between
        error = max(error, AS_GOOD_AS_ZERO * abs(second.load - first.load))
    return ResolvedEvent(best, Value(load, error), error <= rtol * abs(load))


def _load_of(event: PathEvent) -> tuple[float, float]:
    """The load of an event, and what round-off leaves open in it.

    The number whose zero the event is can be known much worse than the load of a state, as that of a gap that is about
    to open: load and number are taken at some states beside the event, and the load where the number vanishes on the
    line that runs through them best, where the load turns back on the parabola. What loads are off it is the error.
    At branch points the number is the sign of a count, or known well.
    """
    there, branches, kinked = event.state.solved, event.kind == BRANCH_POINT, event.state.model.soft
    if event.value is None or event.along is None or branches or kinked:  # a wall that gives way pushes back from there
        return event.state.load, 0.0
    along = tangent(there, event.along)
    states = [there]
    for part in SAMPLES:
        beside = step(event.state.model, there, along, part * BESIDE)[1]
        if beside is not None:
            states.append(beside)
    numbers, loads = np.array([event.value(one) for one in states]), np.array([one.shape.load for one in states])
    size = float(np.max(np.abs(numbers)))
    if len(states) <= len(SAMPLES) or not np.isfinite(size) or not numbers[1] * numbers[-1] < 0.0:
        return event.state.load, 0.0
    powers = np.vander(numbers / size, 3 if event.kind in (FOLD, LOAD_PEAK) else 2, increasing=True)
    of_zero, *_ = np.linalg.lstsq(powers, loads - event.state.load, rcond=None)
    off = loads - event.state.load - powers @ of_zero
    return event.state.load + float(of_zero[0]), float(np.max(np.abs(off)))


def _again(event: PathEvent, more: int) -> PathEvent | None:
    if event.value is None or event.along is None:
        return None
    if event.kind == BRANCH_POINT and event.between is not None:  # at the point itself the equations are singular
        first, second = (refined(one, more, event.along) for one in event.between)
        if first is None or second is None:
            return None
        raised, found = first, locate(first.model, first.solved, second.solved, event.value)
    else:
        at = refined(event.state, more, event.along)
        if at is None:
            return None
        along = tangent(at.solved, event.along)
        raised, found = at, search(at.model, at.solved, along, event.value, SEARCH, FARTHEST)
    return None if found is None else replace(event, state=PatternedState(raised.pattern, raised.elements, found))
