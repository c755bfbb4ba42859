"""How a rod lies along a hole that leaves the vertical plane, and up to which loads: there are no critical ones.

Weight and bend press the rod to different sides, and the end force decides how much each counts: the rod lies at an
angle that varies along it and moves with every change of the load. So no straight-lying state loses its stability. The
states are followed from one at rest, both ways in the end force, each way until the rod leaves the wall or loses its
stability, whichever comes first. Where a symmetry of hole and ends is left alone by the load, as in a level turn, that
may be a bifurcation: the rod then buckles, and the branch that leaves there is followed too.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.exploring import LYING
from rodwell.analysis.branch.follow import FIRST_STEP_ON, LARGEST_STEP, branch_off
from rodwell.analysis.branch.making import made
from rodwell.analysis.branch.rest import at_rest, reach_in_space
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import BRANCH_POINT, END, LIFT_OFF, Origin, SpecialPoint
from rodwell.analysis.branch.starts import at_state
from rodwell.analysis.branch.tracing import traced
from rodwell.analysis.branch.watching import Following
from rodwell.analysis.discrete import first_run
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.continuation.events import INDEX
from rodwell.problem.problem import Problem
from rodwell.quantities.tolerance import LARGEST_FORCE, RTOL, checked_force, checked_rtol
from rodwell.quantities.value import Value

Progress = Callable[[float], None]

PASSED = 1.0
"""How far in B/L² states are followed beyond a load that is to be reached."""


@dataclass(frozen=True)
class LyingRod:
    """The rod along a hole that leaves the vertical plane.

    Attributes
    ----------
    problem
        The problem.
    rest
        The state from which the others are followed, on the wall and stable.
    pressed, pulled
        Its states under less and under more end force (tension positive), each branch up to where the rod leaves the
        wall or loses its stability, or to where it was to end.
    buckled
        The branch that leaves ``pressed`` where its stability is lost in a bifurcation; None where it is not.
    """

    problem: Problem
    rest: Solution
    pressed: Branch
    pulled: Branch
    buckled: Branch | None = None

    @property
    def end(self) -> SpecialPoint | None:
        """Where the rod leaves the wall or loses its stability as the end force falls; None: not as far as followed."""
        return self.pressed.end_of_the_way

    @property
    def end_in_tension(self) -> SpecialPoint | None:
        """The same as the end force rises."""
        return self.pulled.end_of_the_way

    @property
    def lowest(self) -> Value:
        """The lowest end force in B/L² down to which it lies on the wall, stable, as far as followed."""
        return Value(self.pressed.reach[0]) if self.end is None else self.end.load

    @property
    def highest(self) -> Value:
        """The highest end force in B/L² up to which it lies on the wall, stable, as far as followed."""
        return Value(self.pulled.reach[1]) if self.end_in_tension is None else self.end_in_tension.load

    @property
    def last(self) -> Solution:
        """The state at the lowest of these forces."""
        return self.pressed[-1] if self.end is None else self.end.solution

    @property
    def until(self) -> float:
        """The lowest end force on all of its branches."""
        return min(branch.reach[0] for branch in self.branches)

    @property
    def branches(self) -> tuple[Branch, ...]:
        """The branch that buckles, where there is one, then ``pressed`` and ``pulled``."""
        return (*(() if self.buckled is None else (self.buckled,)), self.pressed, self.pulled)

    def as_dict(self) -> dict[str, Any]:
        """Return how far it lies, both ways, and what ends that, as plain data, for JSON."""
        ends = {
            "lowest_force": (self.lowest, self.end, self.pressed),
            "highest_force": (self.highest, self.end_in_tension, self.pulled),
        }
        return {
            "side": None,
            "rest_force": self.rest.force,
            **{
                name: {
                    "value": load.value, "error": load.error, "s": None if end is None or not end.s else end.s[0],
                    "ends_by": None if end is None else end.kind, "followed_because": branch.ending,
                }
                for name, (load, end, branch) in ends.items()
            },
            "buckles": self.buckled is not None,
        }  # fmt: skip

    def settles(self, force: float) -> bool:
        """Whether it is known what becomes of the rod at an end force: it lies there, or its way ends before."""
        below = force < self.lowest.value and self.end is None and self.pressed.reached_end
        above = force > self.highest.value and self.end_in_tension is None and self.pulled.reached_end
        return not (below or above)

    def at(self, force: float) -> Solution:
        """The lying rod at an end force from ``lowest`` to ``highest``.

        Raises
        ------
        InputError
            If it does not lie there, or was not followed so far.
        NotConvergedError
            If the state could not be computed.
        """
        force = checked_force("force", force)
        low, high = self.lowest.value, self.highest.value
        if not low <= force <= high:
            allowed = f"must be from {low:.8g} to {high:.8g} B/L²: there the rod lies on the wall, stable"
            raise InputError("force", force, allowed)
        for end in (self.end, self.end_in_tension):
            if end is not None and force == end.force:
                return end.solution
        return (self.pressed if force <= self.rest.force else self.pulled).at(force)


def lying_rod(
    problem: Problem, loads: Sequence[float] = (), *, rtol: float = RTOL, progress: Progress | None = None
) -> LyingRod:
    """Follow how a rod lies along a hole that leaves the vertical plane, both ways in the end force.

    Parameters
    ----------
    problem
        The rod; its hole has ``walk``, or an ``axis`` that leaves the vertical plane.
    loads
        End forces F at s = 1 in B/L², tension positive, that are to be reached if the rod lies there. Without them
        states are followed to twice what a straight, a bent and a heavy rod bear together, 4π² + 4κ/Δ + 2√(γ/Δ), on
        either side of the state at rest.
    rtol
        Relative tolerance of every measured number and special point.
    progress
        Called with the end force of each new point.

    Raises
    ------
    InputError
        If the hole is straight or lies in a vertical plane, where :func:`rodwell.critical_loads` are known; if a load
        is out of range; if the rod lies on this side of the hole at no end force that was tried.
    NotConvergedError
        If no state at rest is found.
    """
    hole = problem.hole
    if hole is None or hole.planar:
        raise InputError(
            "walk",
            problem.walk,
            "must not be 0: in a hole that does not leave the vertical plane the rod lies on a straight generator; ask "
            "for rodwell.critical_loads and follow their modes",
        )
    loads, how = [checked_force("loads", load) for load in loads], Following(checked_rtol(rtol), LARGEST_STEP, progress)
    first_run.begin(problem)
    rest, far = at_rest(problem, how), reach_in_space(problem)
    low = min([rest.force - far, *(load - PASSED for load in loads)])
    high = max([rest.force + far, *(load + PASSED for load in loads)])
    pressed = _followed(problem, rest, max(low, -LARGEST_FORCE), how, LYING)
    pulled = _followed(problem, rest, min(high, LARGEST_FORCE), how, f"{LYING}, pulled")
    return LyingRod(problem, rest, pressed, pulled, _buckled(pressed, low, how))


def _followed(problem: Problem, start: Solution, until: float, how: Following, name: str) -> Branch:
    """The branch from a state to an end force, or to where the rod leaves the wall or loses its stability before."""
    begin, stepping = at_state(problem, start, "force", start.force, until, how.rtol), how.stepping(FIRST_STEP_ON)
    trace = traced(problem, begin, until, stepping, ends_at=(LIFT_OFF, INDEX), progress=how.progress)
    return made(problem, Origin(name), trace, trace.end in (END, LIFT_OFF, INDEX), trace.end)


def _buckled(pressed: Branch, until: float, how: Following) -> Branch | None:
    """The branch that leaves a bifurcation, to ``until``; None where there is none, or it could not be started."""
    end = pressed.end_of_the_way
    if end is None or end.kind != BRANCH_POINT or end.force <= until:
        return None
    origin = Origin("buckled", switched=True, parent=pressed.name)
    try:
        return branch_off(end, until=until, rtol=how.rtol, progress=how.progress, origin=origin)
    except NotConvergedError:
        return None
