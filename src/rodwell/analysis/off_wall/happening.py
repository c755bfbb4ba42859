"""What happens along a path: events, and which conditions vanish at them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from rodwell.analysis.off_wall.conditions import Condition, PatternedState, conditions, watched
from rodwell.numerics.stretches.newton import Solved
from rodwell.numerics.stretches.walk import Motion, tangent

FOLD, BRANCH_POINT, END, LOAD_PEAK = "fold", "branch_point", "end", "load_peak"

TOGETHER = 1e-5
"""Conditions vanish together whose values at the place are this much smaller than at the end of the step."""


@dataclass(frozen=True, eq=False, repr=False)
class PathEvent:
    """What happens at a place of a path: its kind, the state there, and where along the rod.

    ``value`` is the function whose zero the place is, in states of the same pattern (None for an end), ``along`` the
    direction of the path, ``between`` the states on either side, ``together`` the conditions that vanish.
    """

    kind: str
    state: PatternedState
    s: tuple[float, ...] = ()
    value: Callable[[Solved], float] | None = None
    together: list[Condition] = field(default_factory=list)
    along: Motion | None = None
    between: tuple[PatternedState, PatternedState] | None = None


@dataclass(eq=False)
class Followed:
    """States and events of a path in order, why it ended, and the direction there."""

    states: list[PatternedState] = field(default_factory=list)
    events: list[PathEvent] = field(default_factory=list)
    ended: str = ""
    along: Motion | None = None

    @property
    def last(self) -> PatternedState:
        """The last state."""
        return self.states[-1]


def unresolved(event: PathEvent) -> str:
    """Why a path ends where the pattern that follows was not found."""
    return (
        f"contact changes at s = {event.s[0]:.4g}, F = {event.state.load:.8g} B/L², in a way that was not resolved: "
        "no state of the pattern that follows was found"
    )


def watch(condition: Condition, state: PatternedState) -> Callable[[Solved], float]:
    """The value of a condition in states of one pattern, as a function of the state."""
    return lambda one: watched(condition, PatternedState(state.pattern, state.elements, one))


def load_rate(along: Motion) -> Callable[[Solved], float]:
    """How fast the load changes along the path: zero at a fold."""
    return lambda one: tangent(one, along).load


def together(state: PatternedState, broken: list[Condition], first: int, *, strict: bool = True) -> list[Condition]:
    """Conditions that vanish at a state together: the first of the broken ones, and its images in symmetric states.

    With ``strict`` only those among the broken ones.
    """
    now, lead = conditions(state), broken[first]

    def here(one: Condition) -> Condition | None:
        same = [other for other in now if (other.kind, other.number) == (one.kind, one.number)]
        return min(same, key=lambda other: abs(other.s - one.s), default=None)

    # a function of a whole stretch was located: what vanishes there is the lowest of its minima
    of_lead = [one for one in now if (one.kind, one.number) == (lead.kind, lead.number)]
    at = min(of_lead, key=lambda one: one.value, default=lead)
    others = broken if strict else [one for one in now if one.kind == lead.kind]
    found = [at._replace(value=0.0)]
    for one in others:
        other, size = here(one), abs(one.value) if strict else 1e-2
        if other is not None and other not in (at, *found) and abs(other.value) <= TOGETHER * size:
            found.append(other)
    return found
