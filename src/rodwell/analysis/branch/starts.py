"""Where branches start: meshes and first point, from a critical load, a known state, or a branch point."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rodwell.analysis.branch.solution import Solution
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.branch.symmetry import kept_parity
from rodwell.analysis.discrete.choices import MOST_ELEMENTS_OF_BRANCH
from rodwell.analysis.discrete.family import family
from rodwell.analysis.discrete.measures import measured_meshes
from rodwell.analysis.discrete.meshes import first_space
from rodwell.analysis.straight.critical import Mode
from rodwell.errors import InputError, NotConvergedError, checked_number
from rodwell.numerics.continuation.events import INDEX, Leaving, LocatedEvent
from rodwell.numerics.continuation.location import LocationError
from rodwell.numerics.continuation.stretch import NEARLY, events_between
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.newton import symmetrise
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.problem import Problem
from rodwell.problem.varying import Parameter, ParameterPath, limits_of
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import checked_force

Start = tuple[TwoMeshes, MeshedState]

INVERSE_ITERATIONS = 8


def at_critical(problem: Problem, mode: Mode, until: float | None, mirror: bool, rtol: float) -> Start:
    """The straight rod at the critical load, with the mode as tangent."""
    reach = until if until is not None else mode.force - mode.wavenumber**2
    space = first_space(problem, min(reach, mode.force), max(reach, mode.force))
    equilibria = family(
        problem,
        space,
        parity=kept_parity(problem, mode.parity),
        wavenumber=mode.wavenumber,
        scale=max(abs(reach - mode.force), 0.1 * mode.wavenumber**2),
    )
    meshes = measured_meshes(equilibria, rtol, MOST_ELEMENTS_OF_BRANCH)

    def straight(on: SplineSpace) -> FloatArray:
        shape = mode.space.evaluate(mode.coefficients, on.points, 1)[0]
        projected = on.project(-shape if mirror else shape, equilibria.ends)
        symmetrise(projected, equilibria.parity)  # what round-off leaves of the other parity would stay
        return projected

    states = []
    for f in (meshes.coarse, meshes.fine):
        zero = np.zeros(f.space.size)
        # the index just above the critical load: as many modes as have been met before this one
        trivial = f.state(zero, mode.force, zero, 1.0, mode.number - 1)
        shape = straight(f.space)
        rise = 0.0 if problem.twist == 0.0 else _share_of_tangent(f, trivial, shape) * trivial.tangent_lam
        states.append(f.state(zero, mode.force, shape, rise, mode.number - 1))
    return meshes, meshes.point(*states)


def _wavenumber(problem: Problem, state: State) -> float:
    """√(∫y''²/∫y'²) of a state; of a helix, that of its turns."""
    return max(state.space.wavenumber(state.c + problem.rise * state.space.greville), 2.0 * np.pi * abs(problem.turns))


def checked_end(problem: Problem, parameter: Parameter, until: float) -> float:
    """Return the end of a branch in a parameter, if the problem allows that value, or raise."""
    if parameter == "force":
        return checked_force("until", until)
    names = parameter.names if isinstance(parameter, ParameterPath) else (parameter,)
    if "clearance" in names and problem.turns != 0:
        raise InputError("parameter", "clearance", "a coiled rod cannot be followed in it: its end would have to move")
    if not isinstance(parameter, ParameterPath):
        return float(getattr(problem.but(**{parameter: until}), parameter))
    low, high = limits_of(parameter)
    return checked_number("until", until, low, high, f"within the limits of the path, {low:g} and {high:g}")


def place_of(start: Solution | SpecialPoint, parameter: Parameter) -> tuple[float, Solution]:
    """Value of a parameter at a state, and the state: of a path, its beginning if the state does not know better."""
    if isinstance(start, SpecialPoint):
        if start.parameter is parameter:
            return start.value, start.solution
        start = start.solution
    return parameter.limits[0] if isinstance(parameter, ParameterPath) else start.value_of(parameter), start


def at_state(
    problem: Problem,
    start: Solution,
    parameter: Parameter,
    here: float,
    until: float,
    rtol: float,
    *,
    fold: bool = False,
) -> Start:
    """A known state, heading from its value ``here`` of a parameter for ``until``.

    A ``fold`` is no regular state at a given value: it is solved for where it lies in the direction of its tangent, and
    left in that sense, since both ways lead to the same side.

    A rod that lies at rest in a curved hole asks for few elements, and on these the branch of what it becomes under
    load may seem to end: there the mesh is at least that of the range of forces.
    """
    old = start.point
    space = old.coarse.space
    if problem.hole is not None and parameter == "force":
        space = max(space, first_space(problem, min(here, until), max(here, until)), key=lambda one: one.elements)
    equilibria = family(
        problem,
        space,
        parity=kept_parity(problem, old.fine.symmetry, parameter),
        wavenumber=_wavenumber(problem, old.fine),
        scale=abs(until - here),
        parameter=parameter,
        force=start.force,
    )
    meshes = measured_meshes(equilibria, rtol, MOST_ELEMENTS_OF_BRANCH)
    states = []
    for level, known in ((meshes.coarse, old.coarse), (meshes.fine, old.fine)):
        exact = level.with_exact_tangent()
        c, tangent = known.c, known.tangent
        if space is not old.coarse.space:
            c, tangent = (_carried(level, known.space, spline) for spline in (c, tangent))
        outcome, state, _ = exact.at(c, here)
        if state is None:
            row, _, _, _ = exact.covector(tangent, 0.0)
            outcome, state, _ = exact.correct(c, here, row, 0.0, float(row @ c))
        if state is None:
            raise NotConvergedError(f"the state to start from could not be solved again: {level.advice(outcome)}")
        states.append(state if fold or (until - here) * state.tangent_lam > 0.0 else state.reversed())
    return meshes, meshes.point(*states)


def beside(solution: Solution) -> tuple[float, ...]:
    """By how much the parameter differs on either side of a state along its branch, where states are found there."""
    equilibria, state = solution.levels[1]
    sides = (equilibria.step(state, sign * BESIDE) for sign in (1.0, -1.0))
    return tuple(side.lam - state.lam for side in sides if side is not None)


def check_side(fold: SpecialPoint, until: float) -> None:
    """Raise where a branch is to be followed from a fold to where there are no states beside it."""
    ways = beside(fold.solution)
    if not ways or any(way * (until - fold.value) > 0.0 for way in ways):
        return
    side = "above" if ways[0] > 0.0 else "below"
    reason = (
        f"lies where the branch has no states beside its fold at {fold.parameter} = {fold.value:.10g}: both ways from "
        f"there lead to values {side} it; give one of these, or start from another state"
    )
    raise InputError("until", until, reason)


BESIDE = 1e-2
"""How far from a fold its branch is looked at, in the metric of the family."""


def _carried(equilibria: Family, space: SplineSpace, spline: FloatArray) -> FloatArray:
    """Coefficients on the mesh of a family of a spline (n,) on another one."""
    on = equilibria.space
    return on.project(space.evaluate(spline, on.points, 1)[0], equilibria.ends)


def at_branch_point(point: SpecialPoint, mirror: bool, rtol: float) -> Start:
    """A branch point, with the direction that leads off the branch as tangent.

    That is the null vector of the Hessian, normal to the branch: on a symmetric branch it breaks the symmetry.
    """
    solution = point.solution
    old, parent = solution.meshes, solution.point
    equilibria = replace(old.coarse, parity=0)
    meshes = measured_meshes(equilibria, rtol, old.most_elements)
    coarse = _null_vector(meshes.coarse, parent.coarse, np.random.default_rng(0).standard_normal(parent.coarse.c.size))
    fine = _null_vector(meshes.fine, parent.fine, meshes.up(coarse))
    if mirror:
        coarse, fine = -coarse, -fine
    states = []
    for f, state, vector in ((meshes.coarse, parent.coarse, coarse), (meshes.fine, parent.fine, fine)):
        turn = 0.0 if state.symmetry != 0 else _share_of_tangent(f, state, vector)
        tangent, tangent_lam = vector + turn * state.tangent, turn * state.tangent_lam
        states.append(
            replace(f.state(state.c, state.lam, tangent, tangent_lam, point.index_before), energy=state.energy)
        )
    return meshes, meshes.point(*states)


def onward(fold: SpecialPoint) -> Leaving:
    """What is known of the index of a branch that is followed from its own fold: it is that behind it."""
    return Leaving(falling=fold.index_after, rising=fold.index_after)


def crossing(point: SpecialPoint) -> Leaving:
    """What is known of the index of a branch that crosses another at a branch point."""
    before, after = point.index_before, point.index_after
    if abs(after - before) != 1:
        return Leaving()
    along = point.solution.point.fine.tangent_lam < 0.0
    return Leaving(falling=before, rising=after) if along else Leaving(falling=after, rising=before)


def _share_of_tangent(equilibria: Family, state: State, vector: FloatArray) -> float:
    """How much of the branch's tangent t belongs to the direction v + τ t of the branch that crosses it.

    The algebraic branching equation: with ψ = v and second derivatives of the gradient g along directions of the
    plane of t and v, ψ·g[t, t] = 0, so τ = −ψ·g[v, v] / (2 ψ·g[t, v]), 0 at a pitchfork.
    """
    free = equilibria.held.free
    size = STENCIL * equilibria.scale_c
    v = vector / np.max(np.abs(vector)) * size
    scale = STENCIL  # a state's tangent has length one: about 1 rad, or the scale of λ
    t, t_lam = scale * state.tangent, scale * state.tangent_lam

    def along(a: float, b: float) -> float:
        gradient = equilibria.assemble(state.c + a * v + b * t, state.lam + b * t_lam)[1]
        return float(v[free] @ gradient[free])

    vv = along(1.0, 0.0) - 2.0 * along(0.0, 0.0) + along(-1.0, 0.0)
    tv = 0.25 * (along(1.0, 1.0) - along(1.0, -1.0) - along(-1.0, 1.0) + along(-1.0, -1.0))
    return 0.0 if tv == 0.0 else -vv / (2.0 * tv) * scale * np.max(np.abs(vector)) / size


STENCIL = 1e-2
"""Step of second differences, in radians around the cylinder."""


def _null_vector(equilibria: Family, state: State, vector: FloatArray) -> FloatArray:
    """Null vector of the Hessian of a branch point, free of the branch's own direction."""
    equilibria.nearest_curvature(state, vector, INVERSE_ITERATIONS)
    lost = 0.5 * (vector - state.symmetry * vector[::-1])
    if state.symmetry != 0 and np.max(np.abs(lost)) > 0.5 * np.max(np.abs(vector)):
        vector = lost  # what leaves the branch breaks its symmetry, or else one that shows in the periodic rod only
    else:
        vector = vector - float(state.row @ vector) * state.tangent
    if vector[np.argmax(np.abs(vector))] < 0.0:
        vector = -vector
    return vector


AROUND = (1e-4, 1e-3, 1e-2)
"""How far along the symmetric branch its branch point is sought, either way from the turning point."""


def rejoined(problem: Problem, parameter: Parameter, turn: LocatedEvent) -> LocatedEvent | None:
    """The branch point of a symmetric branch at which a branch without that symmetry turns back, if there is one.

    The turning point itself is hard to locate: the Hessian is singular there. On the symmetric branch, with its
    symmetry kept, the same point is a plain change of the stability index.
    """
    old, state = turn.meshes, turn.point.fine
    if old.coarse.parity != 0 or not state.space.symmetric:
        return None
    parity = kept_parity(problem, state.symmetry_within(NEARLY), parameter)
    if parity == 0:
        return None
    meshes = measured_meshes(replace(old.coarse, parity=parity), old.rtol, old.most_elements)
    pairs = ((meshes.coarse, turn.point.coarse), (meshes.fine, turn.point.fine))
    middle = [_symmetric_state(f.with_exact_tangent(), x, parity) for f, x in pairs]
    for part in AROUND if middle[0] is not None and middle[1] is not None else ():
        points = []
        for backwards in (True, False):
            ends = [
                f.with_exact_tangent().step(x.reversed() if backwards else x, part)  # type: ignore[union-attr, arg-type]
                for f, x in zip((meshes.coarse, meshes.fine), middle, strict=True)
            ]
            if ends[0] is not None and ends[1] is not None:
                turned = [x.reversed() if backwards else x for x in ends if x is not None]
                points.append(meshes.point(turned[0], turned[1]))
        if len(points) < 2 or points[0].fine.index == points[1].fine.index:
            continue
        try:
            events = events_between(meshes, points[0], points[1], (), opening=False)
        except LocationError:
            continue
        changes = [f for f in events if f.name == INDEX and not f.fold and f.certain]
        if len(changes) == 1:
            return changes[0]
    return None


def _symmetric_state(equilibria: Family, state: State, parity: int) -> State | None:
    """The symmetric equilibrium of the same size as ``state``, which is nearly symmetric itself."""
    c = state.symmetrised(parity)
    row, row_lam, _, _ = equilibria.covector(c - c[0], 0.0)
    return equilibria.correct(c, state.lam, row, row_lam, float(row @ c))[1]
