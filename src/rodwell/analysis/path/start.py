"""How a load path begins: straight rod, buckling, and the rod that has buckled on the wall."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rodwell.analysis.beyond.carry import carried, sampled
from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.off_wall.arrange import arranged
from rodwell.analysis.off_wall.changes import changed, growing_direction, unheld
from rodwell.analysis.off_wall.conditions import PatternedState, conditions
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.analysis.off_wall.pattern import Pattern
from rodwell.analysis.off_wall.state import ContactState, contact_state
from rodwell.analysis.straight.critical import Mode
from rodwell.numerics.stretches.bordered import Row
from rodwell.numerics.stretches.carry import angle_of, rim_fields
from rodwell.numerics.stretches.chain import ANGLE, RADIUS
from rodwell.numerics.stretches.newton import solve
from rodwell.problem.ends import OFF_WALL_ENDS
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

ENOUGH, BENT, MOST = 0.02, 0.04, 0.6
"""Largest angle around the hole, in radians, from which on a buckled state is a start for a chain; and from which on,
and up to which, a rod that leaves the wall as soon as it buckles is sought beside it."""

HELD_INSTEAD = {"ball": "pinned", "loose": "free"}
"""Ends that are not radially held, each with the one that is and holds the same besides."""

ARCH = 0.02
"""Height, in clearances, of the first state of a rod that arches away from the wall."""

EVENLY = 1001
"""Places at which a mode is looked at."""

ONE_SIDED = 1e-6
"""Part of its height by which a mode may reach to the other side by round-off."""


@dataclass(frozen=True, eq=False)
class OnWall:
    """The part of the path on the wall: the branch that was followed there, and the state from which chains go on.

    ``snap`` is the state to which the straight rod snaps where it buckles, None where the branch leaves it without one.
    """

    branch: Branch
    states: tuple[int, ...]
    start: PatternedState
    snap: ContactState | None


def on_wall(
    problem: Problem,
    mode: int,
    mirror: bool,
    rtol: float,
    before: Callable[[PatternedState], bool],
    tell: Callable[[float], object] | None = None,
) -> OnWall | None:
    """Buckle the rod on the wall and follow it while it is stable and loads grow; None if it is never.

    An arm that is unstable at first, as twist makes one of the two, goes back in load, folds, and is stable on its way
    forth: where the straight rod buckles it snaps to there. The state from which chains go on is the last one
    ``before`` the end of the path. ``tell`` is called with the end force of each state.
    """
    model = rod_in_hole(problem)

    def told(force: float) -> None:
        if tell is not None:
            tell(force)

    branch = follow(problem, mode, until=None, mirror=mirror, rtol=rtol, progress=told)
    kept: list[int] = []
    force = branch.force
    stable = (branch.stability_index == 0) & (force < force[0])
    first = int(np.argmax(stable))  # 0 if none is
    for i in range(max(first, 1), len(branch)):
        past = branch.lift_off is not None and force[i] <= branch.lift_off.force
        if past or branch.stability_index[i] != 0 or force[i] >= force[i - 1]:
            break
        kept.append(i)
    amplitudes = [(i, _amplitude(branch[i])) for i in kept[::-1]]
    for i, amplitude in amplitudes:
        if amplitude >= ENOUGH:
            start = carried(model, branch[i])
            if start is not None and start.solved.index == 0 and before(start) and not unheld(start):
                snap = _stable_at(model, branch, float(force[0])) if first > 1 else None
                if first > 1 and snap is None:
                    return None
                return OnWall(branch, tuple(k for k in kept if k <= i), start, snap)
    return None


def _stable_at(model: RodInHole, branch: Branch, force: float) -> ContactState | None:
    """The buckled stable state of a branch at the load where the straight rod buckles."""
    buckled = [one for one in branch.states_at(force) if one.stability_index == 0 and _amplitude(one) >= ENOUGH]
    found = carried(model, buckled[0]) if buckled else None
    return None if found is None else contact_state(found)


def leaving_places(problem: Problem) -> tuple[float, ...]:
    """Places at which a pressed rod leaves the wall as soon as it buckles: ball joints, loose ends, stiffness steps."""
    if problem.untouched:
        return ()
    ends = [s for end, s in zip(problem.ends, (0.0, 1.0), strict=True) if end in OFF_WALL_ENDS]
    return tuple(sorted([*ends, *map(float, problem.rod.stiffness_steps)]))


def released(problem: Problem, mirror: bool, rtol: float) -> PatternedState | None:
    """The first state of a rod that leaves the wall as soon as it buckles: see :func:`leaving_places`.

    From the rod that is radially held there instead, buckled a little. None where no such state was found that is
    stable and from which on the load grows: what follows then is for the descent to find.
    """
    first, second = (HELD_INSTEAD.get(end, end) for end in problem.ends)
    model = rod_in_hole(problem)
    branch = follow(replace(problem, ends=(first, second)), 1, until=None, mirror=mirror, rtol=rtol)
    for i in range(1, len(branch)):
        amplitude = _amplitude(branch[i])
        if amplitude > MOST:
            return None
        kept = carried(model, branch[i]) if amplitude >= BENT else None
        if kept is None:
            continue
        after = changed(kept, unheld(kept))
        if after is None or after.state.solved.index:
            continue
        if all(one.value > 0.0 for one in conditions(after.state)):
            return after.state if growing_direction(after, -1.0).load < 0.0 else None
    return None


def arched(model: RodInHole, mode: Mode) -> PatternedState | None:
    """The first state of a rod that nothing presses to the wall and that arches away from it; None if it cannot.

    Where its ends hold all lateral directions alike one plane of buckling is as good as another until the rod touches
    the wall. In the plane through the hole's axis it does so last, and to that plane contact turns it. None where
    the mode lies on both sides of the straight rod: there the wall is in its way at once.
    """
    if not (model.problem.untouched and model.problem.isotropic_ends):
        return None
    sense = 1.0 if np.sum(mode.shape(_EVENLY)) > 0.0 else -1.0
    if np.min(sense * mode.shape(_EVENLY)) < -ONE_SIDED:
        return None
    height = sense * ARCH / np.max(np.abs(mode.space.evaluate(mode.coefficients, _EVENLY, 1)[0]))

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        fields = np.zeros((2, 3, s.size))
        fields[0] = height * np.array(mode.space.evaluate(mode.coefficients, s, 3))
        fields[0, 0] -= 1.0
        return fields, angle_of(fields)

    pattern = Pattern((False,), planar=True)
    shape, elements = arranged(model, pattern, np.zeros(0), mode.force, sample)
    weights = np.zeros_like(shape.nodes)
    weights[1:-1, RADIUS] = 1.0  # X there
    height_held = Row(weights, np.zeros(0), 0.0, float(np.sum(weights * shape.nodes)))
    found = solve(model, shape, height_held)[1]
    return None if found is None else PatternedState(pattern, elements, found)


def beside_lying(model: RodInHole, mode: Mode, mirror: bool) -> PatternedState | None:
    """The first buckled state of a rod on a wall whose clearance varies, found without a branch on the wall.

    Its amplitude is held at first. None where no such state is stable and bears more than the straight rod: what
    follows then is for the descent to find.
    """
    places = np.linspace(0.0, 1.0, EVENLY)
    largest = float(np.max(np.abs(mode.space.evaluate(mode.coefficients, places, 1)[0] / model.unit(places))))
    height = (-1.0 if mirror else 1.0) * BENT / largest
    profile = model.problem.rod.clearance

    def sample(s: FloatArray) -> tuple[FloatArray, FloatArray]:
        v, v1, v2 = mode.space.evaluate(mode.coefficients, s, 3)
        r, r1, r2 = profile(s), profile.derivative(s), profile.derivative.derivative(s)
        angle, rate = v / r, (v1 - v * r1 / r) / r
        angles = height * np.stack([angle, rate, (v2 - 2.0 * rate * r1 - angle * r2) / r])
        return rim_fields(angles), angles

    pattern = Pattern((True,))
    shape, elements = arranged(model, pattern, np.zeros(0), mode.force, sample)
    weights = np.zeros_like(shape.nodes)
    weights[:, ANGLE] = shape.nodes[:, ANGLE]
    held = Row(weights, np.zeros(0), 0.0, float(np.sum(weights * shape.nodes)))
    solved = solve(model, shape, held)[1]
    found = None if solved is None else PatternedState(pattern, elements, solved)
    if found is None or found.solved.index or found.load >= mode.force:
        return None
    return found if all(one.value > 0.0 for one in conditions(found)) else None


_EVENLY = np.linspace(0.0, 1.0, EVENLY)


def _amplitude(solution: Solution) -> float:
    return float(np.max(np.abs(sampled(solution)(np.linspace(0.0, 1.0, 101))[1][0])))
