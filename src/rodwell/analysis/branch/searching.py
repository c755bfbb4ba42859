"""Branches that hang together with none that is known: sought by unfolding a symmetric problem, and by deflation.

Neither proves that there are no more. What was searched is said in words.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.exploring import Exploration, Progress, same_state
from rodwell.analysis.branch.follow import from_state
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import END, STRAIGHT, Origin
from rodwell.analysis.branch.watching import Following
from rodwell.analysis.discrete.choices import MOST_ELEMENTS_OF_BRANCH
from rodwell.analysis.discrete.family import family
from rodwell.analysis.discrete.measures import measured_meshes
from rodwell.analysis.discrete.meshes import first_space
from rodwell.analysis.straight.critical import critical_loads
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.equilibria.deflation import deflated
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import TwoMeshes
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray

WAYS = ("unfolding", "deflation")
"""Ways to search: states of a symmetric problem carried over to this one; further states at some loads."""

LOADS = 4
"""Loads at which further states are sought by deflation."""

MODES_TRIED = 6
"""Modes of the straight rod from which, besides known states, further states are sought."""

AMPLITUDES = (0.5, 1.5)
"""Of these modes, in radians around the cylinder."""

FLAT = 1e-6
"""Amplitude, in radians, of a rod that counts as straight."""


def search(work: Exploration, ways: tuple[str, ...], tell: Progress) -> tuple[str, ...]:
    """Add branches found in these ways to a diagram, with what leaves them; return what was searched, in words."""
    trunk = "the straight rod" if len(work.critical) > 0 else "the rod as it lies"
    said = [f"connected to {trunk if work.problem.turns == 0 else 'the coil'}"]
    if "unfolding" in ways:
        said += _unfold(work, tell)
    if "deflation" in ways:
        said += _deflate(work, tell)
    return tuple(said)


def symmetric_relatives(problem: Problem) -> tuple[tuple[Problem, str, float], ...]:
    """Problems of more symmetry, with the parameter that leads from each to ``problem`` and its value there."""
    out = []
    if problem.twist != 0.0:
        out.append((problem.but(twist=0.0), "twist", problem.twist))
    if 0.0 < problem.alpha < 90.0 and problem.weight > 0.0:
        out.append((problem.but(alpha=90.0), "alpha", problem.alpha))
    return tuple(out)


def _unfold(work: Exploration, tell: Progress) -> list[str]:
    """Carry states of every branch of more symmetric problems over to this one, and follow what is new."""
    said = []
    for relative, parameter, value in symmetric_relatives(work.problem):
        start = relative.but(**{parameter: value})
        assert start == work.problem
        there = Exploration(
            relative, critical_loads(relative, len(work.critical), rtol=work.how.rtol), work.until, work.how
        )
        there.follow_primary(tell)
        there.follow_secondary(tell)
        for branch in there.branches:
            tell(f"unfolding {branch.name}", 0.9)
            for state in _typical(branch):
                for image in (state, _turned(state)) if relative.symmetric and not work.problem.symmetric else (state,):
                    carried = _carried(image, parameter, value, work.how)
                    if carried is not None:
                        _add(work, carried)
        work.follow_secondary(tell)
        said.append(f"unfolded from {parameter} = {getattr(relative, parameter):g}, {len(there.branches)} branches")
    return said


def _typical(branch: Branch) -> list[Solution]:
    """A state of each stretch between special points, where the stability index may differ."""
    places = sorted({0, len(branch) - 1, *(min(p.after, len(branch) - 1) for p in branch.special_points)})
    return [branch[(a + b + 1) // 2] for a, b in pairwise(places)]


def _turned(state: Solution) -> Solution:
    """The state seen from the other end of the rod."""
    meshes = state.meshes
    parts = [
        replace(s, c=s.c[::-1].copy(), tangent=s.tangent[::-1].copy(), row=s.row[::-1].copy())
        for s in (state.point.coarse, state.point.fine)
    ]
    return Solution(state.problem, meshes.point(*parts), meshes)


def _carried(state: Solution, parameter: str, value: float, how: Following) -> Solution | None:
    """The state that becomes of one as a parameter goes to a value, at the same end force."""
    try:
        branch = from_state(state.problem, state, parameter, value, how)
    except (InputError, NotConvergedError):
        return None
    return branch[-1] if branch.ended_because == END else None


def _deflate(work: Exploration, tell: Progress) -> list[str]:
    """Seek further states at some loads, and follow what is new."""
    top = work.critical[0].force if len(work.critical) else 0.0
    loads = [top + (work.until - top) * (k + 1) / (LOADS + 1) for k in range(LOADS)]
    for load in loads:
        tell(f"deflation at F = {load:.4g}", 0.95)
        _deflate_at(work, load)
    work.follow_secondary(tell)
    return ["by deflation at F = " + ", ".join(f"{load:.6g}" for load in loads) + " B/L²"]


def _deflate_at(work: Exploration, load: float) -> None:
    """Seek states at one end force, from known ones and from modes, until no start leads to a new one."""
    problem = work.problem
    mode = critical_loads(problem, MODES_TRIED, rtol=1e-6)
    space = first_space(problem, min(load, mode[-1].force), mode[0].force)
    unknown = family(problem, space, parity=0, wavenumber=mode[0].wavenumber, scale=abs(load))
    found = [state for branch in work.branches for state in _states_at(branch, load)]
    shapes = [_projected(unknown, partial(_shape, state)) for state in found]
    known = [np.zeros(space.size), *(image for c in shapes for image in _images(unknown, c))]
    starts = [share * c for c in shapes for share in (0.7, 1.3)]
    for one in mode:
        shape = _projected(unknown, one.shape)
        starts += [a * problem.clearance * shape / np.max(np.abs(shape)) for a in AMPLITUDES]
    meshes = measured_meshes(unknown, work.how.rtol, MOST_ELEMENTS_OF_BRANCH)
    for start in starts:
        state = deflated(unknown, known, start, load)
        if state is not None:
            known += _images(unknown, state.c)
            _add(work, _solution(problem, meshes, state, load))


def _states_at(branch: Branch, load: float) -> tuple[Solution, ...]:
    return branch.states_at(load) if branch.parameter == "force" else ()


def _shape(state: Solution, s: FloatArray) -> FloatArray:
    fine = state.point.fine
    return np.asarray(fine.space.evaluate(fine.c, s, 1)[0])


def _projected(onto: Family, shape: Callable[[FloatArray], FloatArray]) -> FloatArray:
    return onto.space.project(shape(onto.space.points), onto.ends)


def _images(of: Family, c: FloatArray) -> list[FloatArray]:
    """A state and its images by the reflections of the problem."""
    return [c, *(sign * (c[::-1] if turned else c) for sign, turned in of.reflections)]


def _solution(problem: Problem, meshes: TwoMeshes, state: State, load: float) -> Solution | None:
    """A state within the tolerance at just this load."""
    _, on, point = meshes.resolve(state)
    if point is None:
        return None
    exact = on.at(point, load) or point
    return Solution(problem, exact, on)


def _add(work: Exploration, state: Solution | None) -> None:
    """Follow the branch of a state both ways, unless the state is on one that is known."""
    if state is None or np.max(np.abs(state.point.fine.c)) < FLAT * state.meshes.fine.scale_c:
        return
    for branch in work.branches:
        if any(same_state(state, known) for known in _states_at(branch, state.force)):
            return
    arms = []
    for until in (_other_way(work, state), work.until):
        try:
            arms.append(from_state(work.problem, state, "force", until, work.how))
        except (InputError, NotConvergedError) as error:
            work.unexplored.append(f"a state at F = {state.force:.8g}: {error}")
        if arms and arms[-1].closed:
            arms = arms[-1:]
            break
    name = _name(work, arms)
    for branch, suffix in zip(arms, ("", ", further on"), strict=False):
        work.branches.append(branch.renamed(Origin(name + suffix)))


def _name(work: Exploration, arms: list[Branch]) -> str:
    """Name of a branch that was found by a state of it: by where it meets the straight rod, if it does."""
    for branch in arms:
        if branch.ended_because == STRAIGHT:
            return f"from the straight rod at {branch.force[-1]:.6g}"
    count = len({b.name.split(",")[0] for b in work.branches if b.name.startswith("isolated")})
    return f"isolated {count + 1}"


def _other_way(work: Exploration, state: Solution) -> float:
    """An end force well above all critical loads."""
    top = work.critical[0].force if len(work.critical) else state.force
    return float(max(top, state.force) + abs(top - work.until))
