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
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from rodwell.analysis.branch.follow import follow
from rodwell.analysis.branch.special import SpecialPoint
from rodwell.analysis.loads.pressure import SECTION_RATIOS, pressure_rates, section_pressure_rates
from rodwell.analysis.straight.critical import Mode, critical_loads
from rodwell.analysis.straight.lying import least_contact
from rodwell.analysis.straight.lying_slopes import beside, inputs_of, lying_slope, step_in
from rodwell.analysis.straight.scale import load_scale, twisted_load_scale
from rodwell.analysis.straight.slopes import load_slope, section_slopes, weight_rates
from rodwell.analysis.straight.without_wall import SpatialMode
from rodwell.errors import InputError, checked_whole
from rodwell.numerics.equilibria.error import NUMBER_NOISE
from rodwell.numerics.splines.spaces import SplineSpace
from rodwell.problem.problem import Problem
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.tolerance import RTOL, checked_rtol
from rodwell.quantities.value import Value

PARAMETERS = ("weight", "alpha", "clearance")
"""The numbers of a dimensionless problem that a load depends on: γ, α in degrees, Δ/L; in a curved hole those of
:func:`rodwell.analysis.straight.lying_slopes.inputs_of`."""

LEFT_BEFORE = (
    "the wall would have to pull the rod before this load is reached: it has left the wall of the curved hole by then"
)

OF_THE_BRANCH = "of the load along the branch, which takes the hole where the undeformed rod is"

Derivatives = dict[str, Value]


@dataclass(frozen=True)
class Sensitivity:
    """Derivatives of one load, f = F L²/B as a function of γ = mg L³/B, α and Δ/L.

    Attributes
    ----------
    name
        "critical load of mode 1", "lift-off load".
    problem
        Where they are taken.
    force
        The load: end force at s = 1 in B/L², tension positive.
    derivatives
        By name of the parameter (:data:`PARAMETERS`): ∂f/∂γ, ∂f/∂α per degree, ∂f/∂(Δ/L), each with its error estimate;
        for the lift-off load of a twisted rod, and the load at which one buckles that nothing presses to the wall, also
        ∂f/∂T₁. Critical loads of a rod kept on the wall do not depend on T₁. In a hole of constant curvature also
        "build", ∂f/∂(k₁L); in one along points those by γ and Δ/L alone, the points in L staying where they are.
    note
        What to know about them, or nothing.
    sections
        Of a string, for each section from s = 0: ∂f by its ratios "stiffness" and "weight", and, of critical loads, by
        the place "upper_end" of the step above it (all but the last), with error estimates. Where a section tapers
        they are by "stiffness_factor" and "weight_factor", on all its values, at 1, and those by the places of its ends
        are left out; of strings that bridge steps of the clearance also by "clearance". T₁ is a dead load.
    converged
        Whether the load, and the state that the derivatives are taken at, meet the tolerance asked for.
    """

    name: str
    problem: Problem
    force: float
    derivatives: Derivatives
    note: str = ""
    sections: tuple[Derivatives, ...] = ()
    converged: bool = True

    def elasticities(self) -> Derivatives:
        """Change of the load F in percent for one percent more of each physical input, with error estimates.

        ``weight_per_length`` mg, ``clearance`` Δ, ``stiffness`` B, ``length`` L, each with the others constant; and
        ``alpha``, in percent for one degree more. From F = (B/L²) f(mg L³/B, α, Δ/L): e_B = 1 − e_mg,
        e_L = 3 e_mg − e_Δ − 2; under an end torque T, T₁ = T L/B, 1 − e_mg − e_T and 3 e_mg − e_Δ + e_T − 2. In a hole
        of constant curvature also ``build``, that of its curvature, and e_L has e_build more, with the inclination at
        mid-length constant; in one along points ``length`` and ``alpha``, with which these move, are left out.
        """
        weight = self._relative("weight", self.problem.weight)
        clearance = self._relative("clearance", self.problem.clearance)
        # T₁ = T L/B grows with the length and falls with the stiffness
        twist, build = (
            self._relative(name, getattr(self.problem, name)) if name in self.derivatives else Value(0.0)
            for name in ("twist", "build")
        )
        length = 3.0 * weight.value - clearance.value - 2.0 + twist.value + build.value
        changes = {
            "weight_per_length": weight,
            "clearance": clearance,
            "stiffness": Value(1.0 - weight.value - twist.value, weight.error + twist.error),
            "length": Value(length, 3.0 * weight.error + clearance.error + twist.error + build.error),
        }
        if "alpha" in self.derivatives:
            changes["alpha"] = self._relative("alpha", 100.0)
        else:
            del changes["length"]
        return changes | ({"build": build} if "build" in self.derivatives else {})

    def _relative(self, name: str, scale: float) -> Value:
        value, error = self.derivatives[name]
        return Value(value * scale / self.force, abs(error * scale / self.force))

    def as_dict(self) -> dict[str, Any]:
        """Everything about it, for JSON."""

        def pairs(values: Derivatives) -> dict[str, dict[str, float]]:
            return {name: {"value": value, "error": error} for name, (value, error) in values.items()}

        return {
            "name": self.name,
            "force": self.force,
            "derivatives": pairs(self.derivatives),
            "elasticities": pairs(self.elasticities()) if self.force != 0.0 else None,
            "note": self.note,
            "converged": self.converged,
            **({"sections": [pairs(one) for one in self.sections]} if self.sections else {}),
        }


def sensitivities(problem: Problem, mode: int = 1, *, rtol: float = RTOL) -> tuple[Sensitivity, ...]:
    """Derivatives of the critical load of a mode and, where the rod is pressed to the wall, of its lift-off load.

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
        If an argument is out of range, or the hole leaves the vertical plane: there is no critical load.
    NotConvergedError
        If a load cannot be computed.
    """
    rtol = checked_rtol(rtol)
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
    if pressed:
        branch = follow(problem, buckling, rtol=rtol)
        if (lift := branch.lift_off) is not None:
            out.append(replace(of_lift_off(lift), converged=branch.meets_tolerance(lift)))
    return tuple(out)


def of_critical_load(mode: Mode) -> Sensitivity:
    """Derivatives of a critical load, from its mode on both meshes."""
    problem = mode.problem
    problem.refuse_bridges("derivatives of critical loads")
    names, by_mode = (PARAMETERS, _by_mode) if problem.hole is None else (inputs_of(problem), _in_curved_hole)
    fine, coarse = (by_mode(mode, *on) for on in ((mode.space, mode.coefficients), mode.coarse))
    scales = {"weight": problem.weight or 1.0, "alpha": 90.0, "clearance": problem.clearance, "build": 1.0}
    derivatives = {}
    for name in names:
        (value, step), (other, _) = fine[name], coarse[name]
        round_off = NUMBER_NOISE * (abs(value) + abs(mode.force) / scales[name])
        derivatives[name] = Value(value, abs(value - other) + step + round_off)
    name = f"critical load of mode {mode.number}"
    return Sensitivity(name, problem, mode.force, derivatives, sections=_by_sections(mode))


def _by_sections(mode: Mode) -> tuple[Derivatives, ...]:
    """Derivatives of a critical load by the data of each section; none in a curved hole."""
    problem = mode.problem
    if not problem.sections or problem.hole is not None:
        return ()
    rod = problem.rod
    fine, coarse = (section_slopes(problem, *on) for on in ((mode.space, mode.coefficients), mode.coarse))
    size = abs(mode.force) + load_scale(problem)
    out: list[Derivatives] = []
    for i in range(len(problem.sections)):
        values = {_named(problem, i, name): (row[i], coarse[name][i]) for name, row in fine.items() if i < row.size}
        if np.any(rod.tapers("stiffness")[i : i + 2] | rod.tapers("weight")[i : i + 2]):
            values.pop("upper_end", None)
        out.append(
            {k: Value(float(a), float(abs(a - b)) + NUMBER_NOISE * (abs(a) + size)) for k, (a, b) in values.items()}
        )
    return tuple(out)


def _named(problem: Problem, number: int, ratio: str) -> str:
    """The name of what a derivative by the data of a section is by: of a ratio that tapers, a factor on all of it."""
    tapers = ratio in SECTION_RATIOS and problem.rod.tapers(ratio)[number]
    return f"{ratio}_factor" if tapers else ratio


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


def _in_curved_hole(mode: Mode, space: SplineSpace, coefficients: FloatArray) -> Slopes:
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


def of_lift_off(lift: SpecialPoint) -> Sensitivity:
    """Derivatives of a lift-off load; from the side of smaller α where the rod lifts off at two places at once."""
    if lift.kind != "lift_off":
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
    for i in range(len(solution.problem.sections) if solution.problem.hole is None else 0):
        each = {}
        for name in SECTION_RATIOS:
            rates, errors = (np.array(part) for part in section_pressure_rates(solution, lift.s, i, name))
            slopes = -rates / by_force
            spread = np.abs(errors / by_force) + np.abs(slopes * force_error / by_force)
            which = int(np.argmax(spread))
            each[_named(solution.problem, i, name)] = Value(float(slopes[which]), float(spread[which]))
        by_section.append(each)
    return Sensitivity("lift-off load", solution.problem, solution.force, out, note, tuple(by_section))
