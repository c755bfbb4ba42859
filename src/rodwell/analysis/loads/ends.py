"""Derivatives of the loads at which the way of a rod ends.

A lift-off load is where the contact pressure p at the touching place vanishes along equilibria:
dF/dq = −(dp/dq)/(dp/dF), both from the tangents of the bordered system. At a fold, where the gradient g of the energy
has the null vector φ of the Hessian H as the direction in which equilibria turn back, dF/dq = −(φ·∂g/∂q)/(φ·∂g/∂F). A
branch point is where φ·Hφ vanishes along states with a symmetry that φ breaks; its rates are differences of formulas
along tangents, as are those of p. A rod that lies on the generator of a bend leaves the wall where its own contact
P = a + bF vanishes: no state is solved for.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from rodwell.analysis.branch.special import BRANCH_POINT, FOLD, LIFT_OFF, SpecialPoint
from rodwell.analysis.discrete.curved import HoleAlong
from rodwell.analysis.discrete.family import in_other_hole
from rodwell.analysis.discrete.moved_sections import moved_section
from rodwell.analysis.loads.derivatives import PARAMETERS, Derivatives, Sensitivity
from rodwell.analysis.loads.pressure import (
    SECTION_RATIOS,
    pressure_elsewhere,
    pressure_rates,
    ratio_size,
    section_pressure_rates,
)
from rodwell.analysis.straight.lying import lying_contact
from rodwell.analysis.straight.lying_slopes import beside, inputs_of, step_in
from rodwell.errors import InputError
from rodwell.numerics.equilibria.differences import central_slope
from rodwell.numerics.equilibria.error import NUMBER_NOISE
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines import banded
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.value import Peak, Value

OF_THE_BRANCH = "of the load along the branch, which takes the hole where the undeformed rod is"

BREAKS_SYMMETRY = (
    "what makes hole or rod differ from one end to the other (tilting, one section alone) takes that load away, and "
    "has no derivative"
)

LEAVING = "load at which it leaves the wall"

SECTION_STEP = 0.02
"""Step in a ratio of a section, relative, of differences along tangents."""


def named(problem: Problem, number: int, ratio: str) -> str:
    """The name of what a derivative by the data of a section is by: of a ratio that tapers, a factor on all of it."""
    tapers = ratio in SECTION_RATIOS and problem.rod.tapers(ratio)[number]
    return f"{ratio}_factor" if tapers else ratio


def of_lift_off(lift: SpecialPoint) -> Sensitivity:
    """Derivatives of a lift-off load; from the side of smaller α where the rod lifts off at two places at once."""
    if lift.kind != LIFT_OFF:
        raise InputError("point", lift.kind, "must be a lift-off")
    solution = lift.solution
    by_force, force_error = (np.array(part) for part in pressure_rates(solution, lift.s, "force"))
    out, note = {}, "" if solution.problem.hole is None else OF_THE_BRANCH
    names = PARAMETERS if solution.problem.hole is None else inputs_of(solution.problem)
    for name in names if solution.problem.twist == 0.0 else (*names, "twist"):
        rates, errors = (np.array(part) for part in pressure_rates(solution, lift.s, name))
        each = -rates / by_force
        spread = np.abs(errors / by_force) + np.abs(each * force_error / by_force)
        # compression grows: the place that touches at the larger F lifts off first, so α falling takes the smallest
        which = int(np.argmin(each)) if name == "alpha" else int(np.argmax(spread))
        out[name] = Value(float(each[which]), float(spread[which]))
        if np.ptp(each) > 10.0 * np.max(spread):
            several = "lifts off at several places at once: the derivative by α is that towards smaller α"
            note = f"{several}; {OF_THE_BRANCH}" if solution.problem.hole is not None else several
    by_section = []
    for i in range(0 if solution.problem.ramps else len(solution.problem.sections)):
        each = {}
        for name in SECTION_RATIOS:
            rates, errors = (np.array(part) for part in section_pressure_rates(solution, lift.s, i, name))
            slopes = -rates / by_force
            spread = np.abs(errors / by_force) + np.abs(slopes * force_error / by_force)
            which = int(np.argmax(spread))
            each[named(solution.problem, i, name)] = Value(float(slopes[which]), float(spread[which]))
        by_section.append(each)
    moved = None
    if solution.problem.axis:
        rate, force = float(by_force[0]), solution.force
        moved = partial(_lift_off_elsewhere, lift, rate, force)
    return Sensitivity("lift-off load", solution.problem, solution.force, out, note, tuple(by_section), elsewhere=moved)


def _lift_off_elsewhere(lift: SpecialPoint, rate: float, force: float, problem: Problem) -> float:
    """The load in another hole nearby at which the place that touches first does, to first order."""
    return force - float(pressure_elsewhere(lift.solution, lift.s[:1], problem)[0]) / rate


Along = Callable[[Family, float], Family]
"""Equations with an input changed by a step."""

Differ = Callable[[Callable[[float], FloatArray | float]], FloatArray]
"""A derivative of a function of a step, at 0; or a difference of its values."""

ENDINGS = {
    LIFT_OFF: "lift-off load",
    FOLD: "load at which it loses its stability",
    BRANCH_POINT: "load at which it buckles",
}
"""Names of loads at which the way of a rod ends, by kind."""

FORCE_STEP = 1e-3
"""Step in the end force, relative to 1 + abs(F), of the differences of the Hessian."""

ITERATIONS = 8


def of_end(end: SpecialPoint) -> Sensitivity | None:
    """Derivatives of the load at which the way of a rod ends: lift-off, fold or branch point; None of other ends."""
    if end.kind not in ENDINGS:
        return None
    if end.kind == LIFT_OFF:
        return of_lift_off(end)
    problem, fold = end.solution.problem, end.kind == FOLD
    coarse, fine = (_Turning(*level, fold) for level in end.solution.levels)
    names = inputs_of(problem) if problem.twist == 0.0 else (*inputs_of(problem), "twist")
    kept = [name for name in names if fold or name != "alpha"]
    out, size = {}, abs(end.force) + abs(problem.hung_weight)
    for name in kept:
        step = _step(problem, name)
        along = partial(_changed, problem, name)
        value, other, wide = (
            on.slope(along, partial(central_slope, h=h)) for on, h in ((fine, step), (coarse, step), (fine, 2.0 * step))
        )
        scale = abs(getattr(problem, name)) or 1.0
        out[name] = Value(value, abs(value - other) + abs(value - wide) + NUMBER_NOISE * (abs(value) + size / scale))
    numbers = range(len(problem.sections)) if fold else ()
    sections = tuple(_by_sections(problem, fine, coarse, i) for i in numbers)
    moved = partial(_end_elsewhere, end.force, fine) if problem.axis else None
    note = OF_THE_BRANCH if fold else f"{OF_THE_BRANCH}; {BREAKS_SYMMETRY}"
    return Sensitivity(ENDINGS[end.kind], problem, end.force, out, note, sections, elsewhere=moved)


def _step(problem: Problem, name: str) -> float:
    return 1e-4 if name == "twist" else step_in(problem, name)


def _changed(problem: Problem, name: str, family: Family, step: float) -> Family:
    if name == "twist":
        return in_other_hole(family, problem.but(twist=problem.twist + step), 0.0)
    return in_other_hole(family, beside(problem, name, step), 0.0)


def _end_elsewhere(force: float, on: _Turning, problem: Problem) -> float:
    def along(family: Family, step: float) -> Family:
        return in_other_hole(family, problem, 0.0) if step > 0.0 else family

    return force + on.slope(along, lambda f: np.asarray(f(1.0)) - np.asarray(f(0.0)))


def _by_sections(problem: Problem, fine: _Turning, coarse: _Turning, number: int) -> Derivatives:
    """By stiffness and weight of a section, in which the equations are linear."""
    out = {}
    for name in SECTION_RATIOS:
        step, moved = SECTION_STEP * ratio_size(problem, number, name), moved_section(problem, number, name)

        def along(family: Family, x: float, moved: Callable[[float], HoleAlong] = moved) -> Family:
            return replace(family, given=moved(x))

        value, other = (on.slope(along, partial(central_slope, h=step)) for on in (fine, coarse))
        out[named(problem, number, name)] = Value(value, abs(value - other) + NUMBER_NOISE * abs(value))
    return out


@dataclass(frozen=True)
class _Turning:
    """A fold or a branch point on one mesh."""

    family: Family
    state: State
    fold: bool

    @cached_property
    def null(self) -> FloatArray:
        """The direction (n,) in which the Hessian vanishes."""
        vector = np.ascontiguousarray(self.state.tangent)
        if not self.fold:
            vector = np.random.default_rng(0).standard_normal(vector.size)
        vector = vector.copy()
        self.family.nearest_curvature(self.state, vector, ITERATIONS)
        return self.family.held.spread(vector[self.family.held.free])

    @cached_property
    def by_force(self) -> float:
        """Rate of what vanishes, by the end force."""
        step = FORCE_STEP * (1.0 + abs(self.state.lam))
        return self._rate(_pushed, partial(central_slope, h=step))

    def slope(self, along: Along, differ: Differ) -> float:
        """dF/dq, or the change of F."""
        return -self._rate(along, differ) / self.by_force

    def _rate(self, along: Along, differ: Differ) -> float:
        """Rate of what vanishes: φ·g at a fold; φ·Hφ along equilibria at a branch point."""
        family, state, held = self.family, self.state, self.family.held
        gradient = held.gather(differ(lambda x: along(family, x).assemble(state.c, state.lam)[1]))
        null = self.null[held.free]
        if self.fold:
            return float(null @ gradient)
        size = float(null @ null)
        factors, moved = held.free_part(family.assemble(state.c, state.lam)[2]), -gradient
        moved += (null @ gradient) / size * null
        banded.factorise(factors)
        banded.solve(factors, moved)
        direction = held.spread(moved - (null @ moved) / size * null)

        def curvature(x: float) -> float:
            there = replace(state, c=state.c + x * direction)
            return along(family, x).nearest_curvature(there, self.null.copy(), 0)[0]

        return float(differ(curvature))


def _pushed(family: Family, step: float) -> Family:
    """Equations whose end force is more by a step."""
    path = family.path.copy()
    path[0] += step * path[1]
    return replace(family, path=path)


def of_leaving(problem: Problem, peak: Peak) -> Sensitivity:
    """Derivatives of the load at which the rod that lies along a hole in a vertical plane leaves its wall by itself.

    ``peak`` has that load, tension positive, with the place.
    """
    at, force = np.array([peak.s]), peak.value

    def contact(other: Problem, along: HoleAlong | None = None, load: float = force) -> float:
        return float(lying_contact(other, load, at, along)[0])

    size = 1.0 + abs(force)
    by_force = (contact(problem, load=force + size) - contact(problem, load=force - size)) / (2.0 * size)
    out = {}
    for name in inputs_of(problem):

        def moved(x: float, name: str = name) -> float:
            return contact(beside(problem, name, x))

        steps = step_in(problem, name), 2.0 * step_in(problem, name)
        slope, wide = (-float(central_slope(moved, h)) / by_force for h in steps)
        scale = abs(getattr(problem, name)) or 1.0
        out[name] = Value(slope, abs(wide - slope) + NUMBER_NOISE * (abs(slope) + abs(force) / scale))
    sections = []
    for i in range(len(problem.sections)):
        each = {}
        for name in SECTION_RATIOS:
            step = 0.5 * ratio_size(problem, i, name)
            values = [contact(problem, moved_section(problem, i, name)(sign * step)) for sign in (1.0, -1.0)]
            slope = -(values[0] - values[1]) / (2.0 * step * by_force)
            each[named(problem, i, name)] = Value(slope, NUMBER_NOISE * (abs(slope) + abs(force) / step))
        sections.append(each)
    there = partial(_leaving_elsewhere, force, by_force, at) if problem.axis else None
    return Sensitivity(LEAVING, problem, force, out, "", tuple(sections), elsewhere=there)


def _leaving_elsewhere(force: float, by_force: float, at: FloatArray, problem: Problem) -> float:
    return force - float(lying_contact(problem, force, at)[0]) / by_force
