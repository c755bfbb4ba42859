"""How much critical and lift-off loads move when an input moves: exact derivatives, and elasticities.

A critical load is an eigenvalue, so its derivative is the second variation's derivative, evaluated on the mode
(Hellmann and Feynman): with a₀ = wₗ/Δ and a₁ = N(s) of (64),

    dF/dq = − (∫ ∂a₀/∂q v² ds + ∫ ∂N/∂q v′² ds) / ∫ v′² ds .

A lift-off load is where the contact pressure p at the touching place vanishes along equilibria:
dF/dq = −(dp/dq)/(dp/dF), both from the tangents of the bordered system.

In a curved hole the curvature is an input, too (:mod:`rodwell.analysis.straight.lying_slopes`), and the lift-off load
is that of the branch, which takes the hole where the undeformed rod is.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from rodwell.analysis.branch.follow import follow
from rodwell.analysis.loads.derivatives import PARAMETERS, Derivatives, Sensitivity
from rodwell.analysis.loads.ends import named, of_end, of_leaving, of_lift_off
from rodwell.analysis.loads.lying_rod import LyingRod, lying_rod
from rodwell.analysis.straight.critical import Mode, critical_loads
from rodwell.analysis.straight.lying import least_contact, lies_between, refuse_spatial
from rodwell.analysis.straight.lying_slopes import (
    beside,
    inputs_of,
    lying_change,
    lying_section_slopes,
    lying_slope,
    step_in,
)
from rodwell.analysis.straight.scale import load_scale, twisted_load_scale
from rodwell.analysis.straight.slopes import load_slope, section_slopes, weight_rates
from rodwell.analysis.straight.without_wall import SpatialMode
from rodwell.errors import checked_whole
from rodwell.numerics.equilibria.error import NUMBER_NOISE
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.clearances import refuse_bridging
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL, checked_rtol
from rodwell.quantities.value import Value

LEFT_BEFORE = (
    "the wall would have to pull the rod before this load is reached: it has left the wall of the curved hole by then"
)


def sensitivities(problem: Problem, mode: int = 1, *, rtol: float = RTOL) -> tuple[Sensitivity, ...]:
    """Derivatives of the critical load of a mode and, where the rod is pressed to the wall, of its lift-off load.

    Parameters
    ----------
    problem
        The rod (``turns`` 0), in a straight hole or along a curved one. Along a hole that leaves the vertical plane
        there is no critical load: the loads are those at which the rod, as it lies, leaves the wall, buckles or loses
        its stability, and ``mode`` is 1. In a drop the load at which it leaves the wall stands beside the critical one
        where it is met before.
    mode
        Number of the mode, 1 for the first met.
    rtol
        Relative tolerance of the loads.

    Raises
    ------
    InputError
        If an argument is out of range; if the rod lies in a hole that leaves the vertical plane at no end force.
    NotConvergedError
        If a load cannot be computed.
    """
    rtol = checked_rtol(rtol)
    if problem.in_space:
        if mode != 1:
            refuse_spatial(problem)
        return of_lying_rod(lying_rod(problem, rtol=rtol))
    buckling = critical_loads(problem, checked_whole("mode", mode, 1, 200), rtol=rtol)[-1]
    out = [of_critical_load(buckling)]
    if mode == 1 and problem.twist != 0.0 and problem.lateral_weight == 0.0:
        met = critical_loads(problem, 1, rtol=rtol).first_met
        assert isinstance(met, SpatialMode)
        known = met.error <= rtol * (abs(met.force) + twisted_load_scale(problem))
        out.append(replace(of_first_met(met), converged=known))
    pressed = problem.pressed if problem.hole is None else least_contact(problem, buckling.force).value > 0.0
    if problem.hole is not None and not pressed:
        out[0] = replace(out[0], note=LEFT_BEFORE)
        left = lies_between(problem)[0]
        if mode == 1 and left is not None:
            out.append(of_leaving(problem, left))
    if pressed:
        branch = follow(problem, buckling, rtol=rtol)
        if (lift := branch.lift_off) is not None:
            out.append(replace(of_lift_off(lift), converged=branch.meets_tolerance(lift)))
    return tuple(out)


def of_lying_rod(rod: LyingRod) -> tuple[Sensitivity, ...]:
    """Derivatives of the loads at which the rod, as it lies in space, ceases to in compression; of its buckled state.

    None where it was followed as far as it was asked for, and nothing happened.
    """
    ends = [rod.end, None if rod.buckled is None else rod.buckled.lift_off]
    branches = (rod.pressed, rod.buckled)
    found = []
    for end, branch in zip(ends, branches, strict=True):
        one = None if end is None else of_end(end)
        if one is not None and end is not None and branch is not None:
            found.append(replace(one, converged=branch.meets_tolerance(end)))
    return tuple(found)


def of_critical_load(mode: Mode) -> Sensitivity:
    """Derivatives of a critical load, from its mode on both meshes."""
    problem = mode.problem
    refuse_bridging(problem, "derivatives of critical loads")
    plain = problem.hole is None and not problem.ramps
    names, by_mode = (PARAMETERS, _by_mode) if plain else (inputs_of(problem), _on_other_wall)
    fine, coarse = (by_mode(mode, *on) for on in ((mode.space, mode.coefficients), mode.coarse))
    scales = {"weight": problem.weight or 1.0, "alpha": 90.0, "clearance": problem.clearance, "build": 1.0}
    derivatives = {}
    for name in names:
        (value, step), (other, _) = fine[name], coarse[name]
        round_off = NUMBER_NOISE * (abs(value) + abs(mode.force) / scales[name])
        derivatives[name] = Value(value, abs(value - other) + step + round_off)
    name = f"critical load of mode {mode.number}"
    moved = partial(_critical_elsewhere, mode) if problem.axis else None
    return Sensitivity(name, problem, mode.force, derivatives, sections=_by_sections(mode), elsewhere=moved)


def _critical_elsewhere(mode: Mode, problem: Problem) -> float:
    """The critical load of a mode in another hole nearby, to first order in what differs."""
    return mode.force + lying_change(mode.problem, mode.space, mode.coefficients, mode.force, problem)


def _by_sections(mode: Mode) -> tuple[Derivatives, ...]:
    """Derivatives of a critical load by the data of each section; none where the clearance varies."""
    problem = mode.problem
    if not problem.sections or problem.ramps:
        return ()
    rod, slopes = problem.rod, section_slopes
    if problem.hole is not None:
        slopes = partial(lying_section_slopes, force=mode.force)
    fine, coarse = (slopes(problem, *on) for on in ((mode.space, mode.coefficients), mode.coarse))
    size = abs(mode.force) + load_scale(problem)
    out: list[Derivatives] = []
    for i in range(len(problem.sections)):
        values = {named(problem, i, name): (row[i], coarse[name][i]) for name, row in fine.items() if i < row.size}
        if np.any(rod.tapers("stiffness")[i : i + 2] | rod.tapers("weight")[i : i + 2]):
            values.pop("upper_end", None)
        out.append(
            {k: Value(float(a), float(abs(a - b)) + NUMBER_NOISE * (abs(a) + size)) for k, (a, b) in values.items()}
        )
    return tuple(out)


def of_first_met(mode: SpatialMode) -> Sensitivity:
    """Derivatives of the load at which a twisted rod that nothing presses to the wall buckles.

    The error of a mode is of the order of the root of that of its load, relative to the size of the load's terms.
    """
    problem = mode.problem
    size = abs(mode.force) + twisted_load_scale(problem)
    part, derivatives = 2.0 * math.sqrt(mode.error / size), {}
    for name in (*PARAMETERS, "twist"):
        value = mode.derivative(name)
        derivatives[name] = Value(value, part * abs(value) + NUMBER_NOISE * size)
    note = "nothing presses the rod to the wall, so twist counts"
    return Sensitivity("load at which it buckles", problem, mode.force, derivatives, note)


Slopes = dict[str, tuple[float, float]]
"""Derivatives by name, each with the error of the differences in them."""


def _by_mode(mode: Mode, space: SplineSpace, coefficients: FloatArray) -> Slopes:
    problem = mode.problem
    return {name: (load_slope(problem, space, coefficients, *weight_rates(problem, name)), 0.0) for name in PARAMETERS}


def _on_other_wall(mode: Mode, space: SplineSpace, coefficients: FloatArray) -> Slopes:
    problem, out = mode.problem, {}
    for name in inputs_of(problem):
        step, at_limit = step_in(problem, name), getattr(problem, name) == 0.0 and name == "weight"
        slope, wide = (
            lying_slope(
                problem, space, coefficients, mode.force, partial(beside, problem, name), part * step,
                to_one_side=at_limit,
            )
            for part in (1.0, 2.0)
        )  # fmt: skip
        out[name] = slope, abs(wide - slope)
    return out
