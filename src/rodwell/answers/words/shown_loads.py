"""How loads change with the inputs, at the end at which a page shows its forces."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from rodwell.analysis.loads.derivatives import Sensitivity
from rodwell.analysis.straight.lying_slopes import beside, inputs_of, step_in
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.spread import Spread, spread_of_load
from rodwell.numerics.equilibria.differences import central_slope
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Value


def shown_sensitivities(computed: Computed) -> list[tuple[Sensitivity, Spread | None]]:
    """How the loads change with the inputs, and their uncertainty, each at the end at which loads are shown."""
    scales = computed.case.scales
    if scales is None or not scales.bottom:
        return list(zip(computed.sensitivities, computed.spreads, strict=True))
    loads = [at_bottom(load) for load in computed.sensitivities]
    return [(load, spread_of_load(load, scales, computed.case.uncertain)) for load in loads]


def at_bottom(load: Sensitivity) -> Sensitivity:
    """The load as force at the lower end, N(0) = F − γ cos α, and its derivatives."""
    problem, alpha = load.problem, math.radians(load.problem.alpha)
    if problem.hole is not None:
        slopes = {name: _hung_slope(problem, name) for name in inputs_of(problem)}
        there = load.elsewhere
        moved = None if there is None else partial(_at_bottom_elsewhere, there)
        return replace(_less(load, slopes), elsewhere=moved)
    whole = problem.rod.whole_weight if problem.sections else 1.0
    whole *= -1.0 if problem.floats else 1.0
    slopes = {"weight": -whole * math.cos(alpha), "alpha": whole * problem.weight * math.sin(alpha) * math.radians(1.0)}
    return _less(load, slopes)


def _at_bottom_elsewhere(at_top: Callable[[Problem], float], problem: Problem) -> float:
    return at_top(problem) - problem.hung_weight


def _less(load: Sensitivity, slopes: dict[str, float]) -> Sensitivity:
    """The load less the axial weight of the whole rod, with the derivatives of that, but for its sign, by name."""
    derivatives = {name: Value(v.value + slopes.get(name, 0.0), v.error) for name, v in load.derivatives.items()}
    return replace(load, force=load.force - load.problem.hung_weight, derivatives=derivatives)


def _hung_slope(problem: Problem, name: str) -> float:
    """Derivative of −γ times the rise of the rod in a curved hole."""
    return -float(central_slope(lambda step: beside(problem, name, step).hung_weight, step_in(problem, name)))
