"""The straight rod of a load path, and how a path comes to it: by getting flatter and flatter, or over a fold."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.off_wall.arrange import solved
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.control import Control
from rodwell.analysis.off_wall.following import followed
from rodwell.analysis.off_wall.happening import Followed
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern, chain
from rodwell.analysis.off_wall.steps import closes_with_slope
from rodwell.analysis.straight.critical import Mode
from rodwell.analysis.straight.lying import lies_between
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.stretches.carry import rim_fields
from rodwell.numerics.stretches.newton import Solved
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Value

FLAT = 0.05
"""Largest angle around the hole, in radians, below which a state that loses stability is about to be straight."""

AT_BUCKLING = 1e-6
"""Loads that differ from the buckling load by no more than this part of it are that load."""

STILL = 1e-4
"""The same, below which it is straight."""

SETTLED = 0.03
"""The same for a rod with gaps that close with its slope, at ball joints and at steps of the stiffness: they become too
short to be followed before it is straight."""

SHORT_STEP = 5e-3
"""Largest step where a longer one has jumped over a fold."""


@dataclass(frozen=True)
class How:
    """How a path is followed: what is controlled, tolerance, seeds of disturbances, buckling mode, who is told.

    There is no buckling mode where the hole leaves the vertical plane, in which no rod is straight.
    """

    control: Control
    rtol: float
    seeds: int
    mode: Mode | None
    progress: Callable[[float], str | None] | None = None

    @property
    def buckling(self) -> Value:
        """The load at which the straight rod buckles; where the hole leaves the vertical plane there is none."""
        assert self.mode is not None
        return Value(self.mode.force, self.mode.error)

    def tell(self, state: PatternedState) -> None:
        """Say that the path is still at a state: who is told may end it by what it raises."""
        if self.progress is not None:
            self.progress(state.load)


def straight_state(model: RodInHole, load: float) -> PatternedState:
    """The straight rod at a load, as a chain in contact everywhere."""

    def flat(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        angle = np.zeros((3, s.size))
        return rim_fields(angle), angle

    found = solved(model, Pattern((True,)), np.zeros(0), load, flat)
    if found is None:
        raise NotConvergedError(f"the straight rod at F = {load:.8g} B/L² is singular")
    return found


def lying_state(model: RodInHole, load: float) -> PatternedState:
    """The same of a rod in a curved hole, whose states stay in the vertical plane."""
    straight = straight_state(model, load)
    pattern, shape = replace(straight.pattern, planar=True), straight.solved.shape
    links, _ = chain(model.problem, model.given, pattern, straight.elements, shape.chain.degree)
    planar = Solved(model, replace(shape, chain=links))
    return PatternedState(pattern, straight.elements, planar)


def leaves_lying(problem: Problem, buckling: float) -> bool:
    """Whether a rod leaves the wall of a curved hole where it lies, before it buckles at an end force.

    Raises
    ------
    InputError
        If it does not lie there without an end force, or twist keeps it from leaving in its plane.
    """
    lowest = None if problem.hole is None else lies_between(problem)[0]
    if lowest is None or lowest.value < buckling:
        return False
    if lowest.value >= 0.0:
        raise InputError(
            "build", problem.build, f"bends the hole so that the rod lies at its bottom only under a tension of "
            f"{lowest.value:.6g} B/L² or more, and a load path begins without an end force: give more weight, or less "
            "curvature",
        )  # fmt: skip
    if problem.twist != 0.0:
        raise InputError(
            "twist", problem.twist, f"must be 0: the rod leaves the wall at F = {lowest.value:.6g} B/L², before it "
            "buckles, and with twist it does not do so in its plane",
        )  # fmt: skip
    return True


def first_still(path: Followed) -> int | None:
    """The number of the first state of a path that is straight, if it began bent."""
    if path.states[0].problem.in_space:
        return None
    bent = [not (flat(state, STILL) or settles(state)) for state in path.states]
    return bent.index(False) if bent[0] and not all(bent) else None


def without_jump(path: Followed, target: float, sense: float, how: How) -> Followed:
    """A path that does not jump over a fold.

    A bent rod that is past the buckling load cannot become straight there, and one that is bent much may fold beyond
    it: the last part is followed again in short steps.
    """
    load_sense = sense if how.control.by_force else -sense
    first = first_still(path)
    if first is None:
        return path
    past = (path.states[first - 1].load - how.buckling.value) * load_sense > 0.0
    before = path.states[first - 1]
    if not past and (flat(before) or (before.pattern.planar and not any(before.touching))):  # an arch
        return path
    begin = max(first - 3, 0)
    kept = path.states[:begin]
    again = followed(path.states[begin], target, control=how.control, progress=how.progress, largest=SHORT_STEP)
    events = [event for event in path.events if event.state in kept] + again.events
    return Followed(kept + again.states, events, again.ended, again.along)


def flat(state: PatternedState, angle: float = FLAT) -> bool:
    """Whether the rod lies within an angle around the hole in contact, or no farther from its ends' place, in Δ."""
    shape, pattern = state.solved.shape, state.pattern
    if state.problem.in_space:
        return False  # no rod is straight there
    if state.model.soft and state.problem.lateral_weight > 0.0:
        return False  # it has sunk into the wall: states of its own, which are followed
    if pattern.planar and state.problem.hole is not None:
        return False  # it has left the wall in its plane, or may: these states are followed, too
    if not pattern.full:
        return float(np.max(np.abs(shape.cartesian[:, :2] - [-1.0, 0.0]))) < angle
    angles = shape.nodes[:, 1]
    if state.problem.hole is not None:  # its low side and its high side are not alike
        return not pattern.turns and float(np.max(np.abs(angles))) < angle
    return not pattern.turns and float(np.ptp(angles)) < angle


def settles(state: PatternedState) -> bool:
    """Whether a rod that leaves the wall as soon as it buckles is about to be straight."""
    touching, angles = state.pattern.touching, state.solved.shape.nodes[state.solved.shape.chain.polar, 1]
    if state.pattern.full or state.pattern.turns or float(np.ptp(angles)) >= SETTLED:
        return False
    return all(on or closes_with_slope(state, i) for i, on in enumerate(touching))


def straightens(state: PatternedState, how: How) -> bool:
    """Whether a path that ends here meets the straight rod, at its buckling load; a fold nearby is another one's."""
    if not flat(state):
        return False
    buckling = how.buckling.value
    return abs(state.load - buckling) <= AT_BUCKLING * abs(buckling)
