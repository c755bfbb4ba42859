"""How loads change with the inputs, at the end at which a page shows its forces."""

from __future__ import annotations

import math
from dataclasses import replace

from rodwell.analysis.loads.sensitivity import Sensitivity
from rodwell.answers.result.computed import Computed
from rodwell.answers.result.spread import Spread, spread_of_load
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
    whole = problem.rod.whole_weight if problem.sections else 1.0
    whole *= -1.0 if problem.floats else 1.0
    slopes = {"weight": -whole * math.cos(alpha), "alpha": whole * problem.weight * math.sin(alpha) * math.radians(1.0)}
    derivatives = {name: Value(v.value + slopes.get(name, 0.0), v.error) for name, v in load.derivatives.items()}
    return replace(load, force=load.force - problem.hung_weight, derivatives=derivatives)
