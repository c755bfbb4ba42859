"""A single state at a given end force, found by minimising the energy: coiled rods, or buckled ones."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.discrete import first_run
from rodwell.analysis.discrete.choices import MOST_ELEMENTS_OF_BRANCH
from rodwell.analysis.discrete.family import family as equilibria
from rodwell.analysis.discrete.family import path, spline_ends
from rodwell.analysis.discrete.measures import measured_meshes
from rodwell.analysis.discrete.meshes import first_space
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.minimise import minimise
from rodwell.numerics.equilibria.outcome import Outcome
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines.spaces import Prolongation
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL, checked_force, checked_rtol

LOPSIDED = 0.3
"""How far, in radians around the cylinder, the search for an unsymmetric coil starts from the symmetric one."""


STEEP = 0.45
"""Slope of the even winding from which one with level ends, twice as steep at its middle, would turn across."""


MOST_HALVINGS = 4
"""Meshes tried for a minimum at most, each with its elements half as long as those of the one before."""

STEEPEST_START = 0.9
"""Largest slope, at its middle, of the winding y = 2πnΔ (s − sin 2πs/2π) that is started from; else one less steep."""


def equilibrium(problem: Problem, force: float, *, rtol: float = RTOL) -> Solution:
    """Stable state of a coiled rod, or of one in a curved hole, at an end force, by minimising its energy.

    Coiled (``problem.turns`` ≠ 0): the search starts from the even winding y = 2πnΔ (s − sin 2πs/2π) and goes downhill:
    the state found is a minimum under dead loads among states on the wall. Without turns, in a straight hole, that is
    the straight rod. In a curved hole the search starts from θ = 0, and finds how the rod lies where that is no
    straight generator: in holes that leave the vertical plane.

    Parameters
    ----------
    problem
        The rod; ``turns`` sets how often its end is carried around the cylinder, ``build``, ``walk`` or ``axis`` how
        the hole is curved.
    force
        End force F at s = 1 in B/L², tension positive.
    rtol
        Relative tolerance.

    Raises
    ------
    InputError
        If ``force`` is not finite, or a straight rod is asked for.
    NotConvergedError
        If no minimum was found, with the reason.
    """
    first_run.begin(problem)
    rtol = checked_rtol(rtol)
    force = checked_force("force", force)
    if problem.hole is not None:
        return _in_curved_hole(problem, force, rtol)
    if problem.turns == 0:
        raise InputError("turns", 0, "must not be 0: without turns the straight rod is an equilibrium at any force")
    family, outcome, coarse = _odd_or_any(problem, force)
    if coarse is None:
        for approached in (_from_lighter, _from_no_load):
            found = approached(problem, force, rtol)
            if found is not None:
                return found
        raise NotConvergedError(f"no coiled state found at F = {force:g} B/L²: {family.advice(outcome)}")
    outcome, solution = _refined(problem, family, coarse, force, rtol)
    if solution is None:
        raise NotConvergedError(
            f"the coiled state at F = {force:g} B/L² could not be refined: {family.advice(outcome)}"
        )
    return solution


def _refined(
    problem: Problem, family: Family, coarse: State, force: float, rtol: float
) -> tuple[Outcome, Solution | None]:
    """A state completed to a solution within the tolerance."""
    outcome, meshes, point = measured_meshes(family, rtol, MOST_ELEMENTS_OF_BRANCH).resolve(coarse)
    return outcome, None if point is None else Solution(problem, meshes.at(point, force) or point, meshes)


def _in_curved_hole(problem: Problem, force: float, rtol: float) -> Solution:
    """The minimum downhill from the rod at θ = 0, or that rod itself where it is one."""
    space = first_space(problem, min(force, 0.0), max(force, 0.0))
    scale = max(abs(force), 4.0 * np.pi**2)
    family = equilibria(problem, space, parity=0, wavenumber=2.0 * np.pi, scale=scale)
    outcome, c = minimise(family, np.zeros(space.size), force)
    coarse = None
    if outcome is Outcome.CONVERGED:
        outcome, coarse, _ = family.at(c, force)
    if coarse is not None:
        outcome, solution = _refined(problem, family, coarse, force, rtol)
        if solution is not None:
            return solution
    raise NotConvergedError(f"no stable state found at F = {force:g} B/L²: {family.advice(outcome)}")


def _from_lighter(problem: Problem, force: float, rtol: float) -> Solution | None:
    """The minimum of a lighter rod, followed in its weight: of a heavy one the winding is far from even."""
    for part in LIGHTER:
        lighter = problem.but(weight=part * problem.weight)
        family, _, coarse = _odd_or_any(lighter, force)
        start = None if coarse is None else _refined(lighter, family, coarse, force, rtol)[1]
        if start is None or not start.point.at(force):
            continue
        branch = follow(lighter, start=start, parameter="weight", until=problem.weight, rtol=rtol)
        found = _downhill(branch[-1], force) if branch.reached_end else None
        if found is not None:
            return found
    return None


def _from_no_load(problem: Problem, force: float, rtol: float) -> Solution | None:
    """The minimum at F = 0, followed in the end force: downhill from the even winding another basin may come first."""
    family, _, coarse = _odd_or_any(problem, 0.0)
    start = None if coarse is None or force == 0.0 else _refined(problem, family, coarse, 0.0, rtol)[1]
    if start is None:
        return None
    branch = follow(problem, start=start, until=force, rtol=rtol)
    return _downhill(branch[-1], force) if branch.reached_end else None


def _downhill(solution: Solution, force: float) -> Solution | None:
    """A minimum, from a state that need not be one: where symmetric coils are unstable, beside the symmetric one."""
    problem, meshes = solution.problem, solution.meshes
    unstable, c = solution.stability_index > 0, solution.point.coarse.c
    line = meshes.on_path(path(problem, "force"), spline_ends(problem), 0 if unstable else meshes.coarse.parity)
    if unstable:
        space = line.coarse.space
        bump = problem.clearance * np.sin(np.pi * space.points) ** 2
        c = c + ASIDE * space.project(bump, line.coarse.ends)
    outcome, c = minimise(line.coarse, c, force)
    if outcome is not Outcome.CONVERGED:
        return None
    _, coarse, _ = line.coarse.at(c, force)
    if coarse is None:
        return None
    _, finer, point = line.resolve(coarse)
    if point is None or point.fine.index > 0:
        return None
    return Solution(problem, finer.at(point, force) or point, finer)


LIGHTER = (0.25, 0.0625, 0.015625)
"""Parts of the weight from which a heavy coil is approached."""

ASIDE = 0.05
"""How far, in radians around the cylinder, the search for a minimum starts from a state that is none."""


def _odd_or_any(problem: Problem, force: float) -> tuple[Family, Outcome, State | None]:
    """A minimum of the energy: odd about mid-length if the problem allows that and it is stable, else of any shape."""
    space = first_space(problem, min(force, 0.0), max(force, 0.0))
    wavenumber = 2.0 * np.pi * abs(problem.turns)
    for parity in (-1, 0) if problem.symmetric else (0,):
        scale = max(abs(force), wavenumber**2)
        family = equilibria(problem, space, parity=parity, wavenumber=wavenumber, scale=scale)
        start = _winding(problem, family)
        if parity < 0:  # steps are kept odd: what is even in the start, if only by round-off, would stay
            start = 0.5 * (start - start[::-1])
        if parity == 0 and problem.symmetric:  # the odd one is no minimum: leave its symmetry
            bump = problem.clearance * np.sin(np.pi * space.points) ** 2
            start = start + LOPSIDED * space.project(bump, family.ends)
        family, outcome, state = _minimum(family, start, force)
        if state is not None:
            break
    return family, outcome, state


def _minimum(family: Family, c: FloatArray, force: float) -> tuple[Family, Outcome, State | None]:
    """A minimum downhill from ``c`` (n,) on the first mesh on which it is one that the halved mesh has too.

    What a coil has of waves moves along the rod nearly for nothing, and a coarse mesh holds it where it stands.
    """
    for _ in range(MOST_HALVINGS):
        outcome, c = minimise(family, c, force)
        state = family.at(c, force)[1] if outcome is Outcome.CONVERGED else None
        if state is None:
            return family, outcome, None
        finer = family.on(family.space.refined())
        c = Prolongation(family.space, finer.space)(state.c)
        better = finer.at(c, force)[1]
        if better is not None and better.index == 0:
            return family, outcome, state
        if better is not None and family.parity != 0:  # what it is unstable to breaks the symmetry that is kept
            return family, Outcome.NOT_CONVERGED, None
        family = finer
    return family, Outcome.NOT_CONVERGED, None


def _winding(problem: Problem, family: Family) -> FloatArray:
    """Coefficients of a winding that is level at both ends, less the even one, y = 2πnΔ s.

    What the ends hold stands in the outermost coefficients: a linear function has the value of the ramp at the
    Greville abscissae, so a level end is one whose first two values are those of the end less the ramp there.
    """
    space, held = family.space, family.ends
    end = problem.rise
    if problem.ends == ("pinned", "pinned") and abs(end) >= STEEP:
        return np.zeros(space.size)  # the even winding itself
    level = np.concatenate([np.zeros(held.held[0]), np.full(space.size - held.held[0], end)])
    kept = level - end * space.greville
    if 2.0 * abs(end) < STEEPEST_START:
        gap = -end * np.sin(2.0 * np.pi * space.points) / (2.0 * np.pi)
    else:  # y' = a (1 − |2s − 1|^k) with the mean `end`, as steep as half way from there to across
        steepest = 0.5 * (1.0 + abs(end))
        power = abs(end) / (steepest - abs(end))
        x = 2.0 * space.points - 1.0
        gap = (
            0.5 * np.sign(end) * steepest * (x + 1.0 - (np.sign(x) * np.abs(x) ** (power + 1.0) + 1.0) / (power + 1.0))
        )
        gap -= end * space.points
    return kept + space.project(gap - space.at_points(kept)[0], held)
