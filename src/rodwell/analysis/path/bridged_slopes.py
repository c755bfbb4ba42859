"""How the load at which a bridging string buckles out of its plane changes with what the string and its hole are.

The planar state at the load F is solved for once more with one of the data moved, with the same pattern of contact, and
with it a function f that vanishes where its second variation is singular along the disturbance that begins to grow
(:func:`rodwell.numerics.stretches.newton.stiffness_along`). Where f vanishes is the load, whatever else moves with the
data (state, ends of contact, mesh), so that

    dF/dq = −(∂f/∂q) / (∂f/∂F).

Both are central differences, with a step and half of it, from which the error of second order is taken out; the error
is what that took out, and the difference between elements of two degrees.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from rodwell.analysis.loads.derivatives import Derivatives, Sensitivity
from rodwell.analysis.loads.sensitivity import sensitivities as of_loads
from rodwell.analysis.off_wall.arrange import solved
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.off_wall.state import ContactState
from rodwell.analysis.path.events import CRITICAL
from rodwell.analysis.path.follow import load_path, not_held_at_steps
from rodwell.analysis.straight.lying_slopes import inputs_of
from rodwell.errors import InputError, NotConvergedError
from rodwell.numerics.stretches.carry import sampler
from rodwell.numerics.stretches.newton import softest, stiffness_along
from rodwell.problem.problem import Problem
from rodwell.problem.sections import COLUMNS, Section
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL
from rodwell.quantities.value import Value

STEP = 2e-4
"""Largest step, as a part of what is moved."""

NOT_HELD = "load at which it buckles sideways, not held at its steps"

NOT_FOUND = "Of the string that nothing holds at its steps, off the wall beside them, it was not found"

Moved = Callable[[float], tuple[Problem, float]]
"""The problem and the end force with a datum moved by a part of its size."""


def sensitivities(problem: Problem, mode: int = 1, *, rtol: float = RTOL) -> tuple[Sensitivity, ...]:
    """Derivatives of the critical load of a mode and, where the rod is pressed to the wall, of its lift-off load.

    Where the clearance has steps, of the load at which the string that bridges them buckles sideways:
    :func:`bridged_slopes`. Where a curved hole bends a string with steps of its stiffness, of that of the string that
    nothing holds there too, after those of one that lies on the wall all along; what was not found is said in its note.

    Parameters
    ----------
    problem
        The rod, straight (``turns`` 0) or along a curved hole in a vertical plane.
    mode
        Number of the mode, 1 for the first met.
    rtol
        Relative tolerance of the loads.

    Raises
    ------
    InputError
        If an argument is out of range, the hole leaves the vertical plane: there is no critical load, or the clearance
        varies, or has steps and another mode than the first is asked for.
    NotConvergedError
        If a load cannot be computed.
    """
    if not problem.bridges:
        loads = of_loads(problem, mode, rtol=rtol)
        return loads if mode != 1 else _and_not_held(loads, problem, rtol)
    if mode != 1:
        raise InputError("mode", mode, "must be 1 where the clearance has steps: the string is followed to its first")
    path = load_path(problem, rtol=rtol)
    found = path.first(CRITICAL)
    if found is None or found.state is None:
        raise NotConvergedError(f"no load was found at which the string buckles sideways: {path.ended_because}")
    name, (derivatives, sections) = "load at which it buckles sideways", bridged_slopes(found.state)
    return (Sensitivity(name, problem, found.force.value, derivatives, "", sections, not path.missed),)


def _and_not_held(loads: tuple[Sensitivity, ...], problem: Problem, rtol: float) -> tuple[Sensitivity, ...]:
    """These loads, and the one of a string that nothing holds at steps of its stiffness in a bend."""
    found = not_held_at_steps(problem, rtol)
    if found is None:
        return loads
    try:
        if isinstance(found, str):
            raise NotConvergedError(found)
        assert found.state is not None
        derivatives, sections = bridged_slopes(found.state)
    except NotConvergedError as error:
        first = replace(loads[0], note=f"{loads[0].note} {NOT_FOUND}: {error}.".strip())
        return (first, *loads[1:])
    return (*loads, Sensitivity(NOT_HELD, problem, found.force.value, derivatives, "", sections, found.met))


def bridged_slopes(state: ContactState) -> tuple[Derivatives, tuple[Derivatives, ...]]:
    """Derivatives of the load of a state at which a string buckles sideways: by γ, α, Δ, κ, and its sections' data.

    Those of a section are by its "stiffness" and "weight" ratios ("stiffness_factor", "weight_factor" where they
    taper); by its "clearance" ratio where those of its neighbours are others; and by its "upper_end" in L, where it
    and the next do not taper: it becomes longer as the next becomes shorter.

    Raises
    ------
    NotConvergedError
        If a state with one of the data moved was not found.
    """
    problem, force = state.problem, state.force
    scale = max(abs(force), 1.0)
    starts = [(one, softest(one.solved)) for one in (state.fine, state.coarse)]
    by_force = [_rate(*start, lambda x: (problem, force + x * scale)) for start in starts]

    def slope(moved: Moved, size: float) -> Value:
        fine, coarse = (
            (-rate.value / own.value * scale / size, abs(rate.error / own.value) * scale / size)
            for rate, own in ((_rate(*start, moved), own) for start, own in zip(starts, by_force, strict=True))
        )
        doubt = abs(by_force[0].error / by_force[0].value * fine[0])
        return Value(fine[0], fine[1] + doubt + abs(fine[0] - coarse[0]))

    whole = {}
    data = {"weight": problem.weight, "alpha": 90.0, "clearance": problem.clearance, "build": problem.build}
    for name in inputs_of(problem) if problem.hole is not None else ("weight", "alpha", "clearance"):
        size = data[name]

        def more(x: float, name: str = name, size: float = size) -> tuple[Problem, float]:
            return problem.but(**{name: getattr(problem, name) + x * size}), force

        whole[name] = slope(more, size)
    return whole, tuple(_of_section(problem, force, i, slope) for i in range(len(problem.sections)))


def _of_section(problem: Problem, force: float, i: int, slope: Callable[[Moved, float], Value]) -> Derivatives:
    """Derivatives by the data of a section."""
    sections, out = problem.sections, {}
    own = sections[i]

    def column(k: int) -> Moved:
        return lambda x: (problem.but(sections=(*sections[:i], _times(own, k, 1.0 + x), *sections[i + 1 :])), force)

    for k in (1, 2, 3):
        ratio, name = own[k], COLUMNS[k]
        alike = k == 3 and any(sections[j][3] == ratio for j in (i - 1, i + 1) if 0 <= j < len(sections))
        if isinstance(ratio, tuple):
            out[f"{name}_factor"] = slope(column(k), 1.0)
        elif ratio != 0.0 and not alike:
            out[name] = slope(column(k), ratio)
    if i + 1 < len(sections) and not any(isinstance(one, tuple) for one in (*own, *sections[i + 1])):
        after = sections[i + 1]
        length = min(own[0], after[0])

        def longer(x: float) -> tuple[Problem, float]:
            two = (own[0] + x * length, *own[1:]), (after[0] - x * length, *after[1:])
            return problem.but(sections=(*sections[:i], *two, *sections[i + 2 :])), force

        out["upper_end"] = slope(longer, length)
    return out


def _times(section: Section, k: int, factor: float) -> Section:
    """A section with a ratio, or all its values, so many times as large."""
    length, *ratios = section
    one = ratios[k - 1]
    ratios[k - 1] = tuple(factor * value for value in one) if isinstance(one, tuple) else factor * one
    b, q, d, c = ratios
    return (length, b, q, d, c)


def _rate(state: PatternedState, direction: FloatArray, moved: Moved) -> Value:
    """The derivative of f by the part by which a datum is moved."""

    def central(x: float) -> float:
        above, below = (_singular(state, direction, *moved(sign * x)) for sign in (1.0, -1.0))
        return (above - below) / (2.0 * x)

    half, whole = central(0.5 * STEP), central(STEP)
    return Value((4.0 * half - whole) / 3.0, abs(half - whole))


def _singular(state: PatternedState, direction: FloatArray, problem: Problem, force: float) -> float:
    """F of a state of this pattern, of a problem close to its own at an end force close to its own."""
    places = dict(zip(map(float, state.problem.rod.breaks), map(float, problem.rod.breaks), strict=True))
    pattern = replace(state.pattern, edges=tuple(places.get(edge, edge) for edge in state.pattern.edges))
    shape = state.solved.shape
    found = solved(
        rod_in_hole(problem), pattern, shape.breaks, force, sampler(shape), degree=shape.chain.degree,
        elements=state.elements,
    )  # fmt: skip
    if found is None:
        raise NotConvergedError(
            f"how the load at F = {state.load:.8g} B/L² changes was not found: no state next to it with its contacts"
        )
    return stiffness_along(found.solved, direction)
