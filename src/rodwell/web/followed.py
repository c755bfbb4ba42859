"""The state shown, followed in the inputs that are moved: it is there before anything else is known of the new ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from itertools import count
from typing import Any

import numpy as np

from rodwell.analysis.branch.follow import LARGEST_STEP, follow
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import STRAIGHT as ENDED_STRAIGHT
from rodwell.analysis.branch.tracing import FLAT
from rodwell.analysis.discrete.choices import MOST_ELEMENTS_OF_BRANCH
from rodwell.analysis.discrete.family import family
from rodwell.analysis.discrete.measures import measured_meshes
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path.elsewhere import follow_contact
from rodwell.case.case import Case
from rodwell.errors import NotConvergedError
from rodwell.problem.problem import Problem
from rodwell.problem.varying import FORCE, NUMBERS
from rodwell.web.explored import STRAIGHT, Explored, uncomputed
from rodwell.web.state import Shown

MOST_STEPS = 30
"""A state that takes more is left to the branches, which take hundreds and are computed next."""

NEAR = 0.05
"""Part by which numbers move in one step, about: what moves less is followed in one."""


@dataclass(frozen=True)
class Followed:
    """A state, its branch by name, and what is known of its inputs: of a state that was followed, nothing else."""

    explored: Explored
    solution: Shown
    branch: str


class _LeftOffError(Exception):
    """It takes longer than the branches would."""


def followed(
    start: Followed, data: Mapping[str, Any], case: Case, load: float, check: Callable[[], None]
) -> Followed | None:
    """Follow a state to other inputs under the same load as shown.

    Parameters
    ----------
    start
        The state from which to follow.
    data, case
        The other inputs, as content of a case file and as a case.
    load
        The load in the unit of the page.
    check
        Called at each step; what it raises ends the computation.

    Returns
    -------
    Followed or None
        None where something else than a number of the problem differs, or the state ends on the way there.

    Raises
    ------
    InputError
        For inputs in which a state cannot be followed.
    NotConvergedError
        If the state could not be solved again.
    """
    assert isinstance(start.solution, Solution)
    there = uncomputed(data, case, start.explored.kept_unit)
    old, new, force = start.solution.problem, case.problem, there.force(load)
    along = _along(old, new, start.solution.force, force)
    if along is None:
        return None
    if start.branch == STRAIGHT:
        return Followed(there, _straight(new, force, start.solution, case.rtol), STRAIGHT)
    if not along:
        return Followed(there, start.solution, start.branch)
    steps = count(1)

    def passed(_: float) -> None:
        check()
        if next(steps) > MOST_STEPS:
            raise _LeftOffError

    try:
        branch = follow(
            old, start=start.solution, parameter=along, rtol=case.rtol, progress=passed, largest_step=_step(along)
        )
    except _LeftOffError:
        return None
    last = branch[-1]
    if branch.ended_because == ENDED_STRAIGHT or np.max(np.abs(last.point.fine.c)) <= FLAT * new.clearance:
        return Followed(there, _straight(new, force, start.solution, case.rtol), STRAIGHT)
    return Followed(there, last, start.branch) if branch.reached_end else None


def followed_off_wall(
    start: Followed, data: Mapping[str, Any], case: Case, load: float, check: Callable[[], None]
) -> Followed:
    """Follow a state of a load path, of a rod that may have left the wall; arguments as of :func:`followed`.

    Raises
    ------
    InputError
        Where something else than a number of the problem differs, or the state is not stable.
    NotConvergedError
        If the rod gives way on the way there, or contact changes in a way that was not resolved.
    """
    assert isinstance(start.solution, ContactState)
    there = uncomputed(data, case, start.explored.kept_unit)
    found = follow_contact(start.solution, case.problem, there.force(load), progress=lambda _: check())
    return Followed(there, found, start.branch)


def _along(old: Problem, new: Problem, before: float, after: float) -> dict[str, tuple[float, float]] | None:
    """What differs of numbers, from and to; None where something else does."""
    differ = [field.name for field in fields(Problem) if getattr(old, field.name) != getattr(new, field.name)]
    pairs = {name: (getattr(old, name), getattr(new, name)) for name in differ}
    if any(name not in NUMBERS or None in pair for name, pair in pairs.items()):
        return None
    return pairs | ({} if before == after else {FORCE: (before, after)})


def _step(along: Mapping[str, tuple[float, float]]) -> float:
    """The longest step, as a part of the whole way: the farther the numbers move, the more steps."""
    far = max(abs(b - a) / max(abs(a), abs(b)) for a, b in along.values())
    return float(min(max(NEAR / far, LARGEST_STEP), 1.0))


def _straight(problem: Problem, force: float, near: Solution, rtol: float) -> Solution:
    """The rod without deflection, on the meshes of a state of another problem."""
    known = near.meshes.coarse
    equilibria = family(
        problem, known.space, parity=0, wavenumber=known.slope_scale / known.scale_c, scale=known.lam_scale
    )
    meshes = measured_meshes(equilibria, rtol, MOST_ELEMENTS_OF_BRANCH)
    states = [level.at(np.zeros(level.space.size), force)[1] for level in (meshes.coarse, meshes.fine)]
    if states[0] is None or states[1] is None:
        raise NotConvergedError(f"the straight rod could not be computed at F = {force:g} B/L²")
    return Solution(problem, meshes.point(states[0], states[1]), meshes)
