"""States and events to a tolerance: elements of a higher degree until the numbers agree, and the error that remains."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rodwell.analysis.off_wall.arrange import refined
from rodwell.analysis.off_wall.certificate import contact_certificate
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.happening import BRANCH_POINT, FOLD, PathEvent
from rodwell.analysis.off_wall.pattern import FINER
from rodwell.numerics.equilibria.error import estimated_error
from rodwell.numerics.stretches.walk import AS_GOOD_AS_ZERO, locate, search, tangent
from rodwell.quantities.value import Value

MOST_DEGREES = 8
"""How much the degree may grow."""

PART = 0.02
"""Part of the tolerance at which elements are fine enough."""

UNKNOWN = 1e-5
"""Relative error that an event is given which could not be located again on finer elements: it counts as not met."""

SEARCH, FARTHEST = 1e-6, 0.1
"""First and longest step along the path in which an event is sought again on finer elements."""


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
    best = event
    for more in range(FINER, MOST_DEGREES + 1, FINER):
        finer = _again(event, more)
        if finer is None:
            break
        error = float(estimated_error(finer.state.load, load))
        best, load = finer, finer.state.load
        if error <= PART * rtol * abs(load) and contact_certificate(best.state).passed:
            break
    if best.kind == BRANCH_POINT and best.between is not None and not best.state.pattern.planar:
        # the equations are all but singular there: Newton's method is not kept off the disturbance that grows
        first, second = best.between
        error = max(error, AS_GOOD_AS_ZERO * abs(second.load - first.load))
    return ResolvedEvent(best, Value(load, error), error <= rtol * abs(load))


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
