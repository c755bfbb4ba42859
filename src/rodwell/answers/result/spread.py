"""Uncertainty of loads from that of the inputs.

To first order, with inputs independent of each other: each input is moved by its uncertainty either way, what becomes
of γ, α, Δ/L and B/L² follows from the case, and the load from these by its exact derivatives
(:mod:`rodwell.analysis.loads.sensitivity`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rodwell.analysis.loads.derivatives import Sensitivity
from rodwell.case.uncertain import Moved, UncertainInput
from rodwell.quantities.scales import Scales


@dataclass(frozen=True)
class Spread:
    """Uncertainty of a load: one standard uncertainty if the inputs' are, and what each input contributes.

    ``total`` and ``parts`` (by key of the case file) are in B/L², or in N for a case with dimensions.
    """

    total: float
    parts: dict[str, float]

    @property
    def largest(self) -> str:
        """Key of the input that contributes most."""
        return max(self.parts, key=lambda key: abs(self.parts[key]))


def spread_of_load(load: Sensitivity, scales: Scales | None, inputs: tuple[UncertainInput, ...]) -> Spread | None:
    """Uncertainty of a load from those of the inputs; None if no input is uncertain."""
    if not inputs:
        return None
    parts = {}
    for given in inputs:
        here = _linear(load, scales, (load.problem, scales))
        values = [here if moved is None else _linear(load, scales, moved) for moved in (given.down, given.up)]
        sides = 2.0 if given.down is not None and given.up is not None else 1.0
        parts[given.key] = (values[1] - values[0]) / sides
    return Spread(math.sqrt(math.fsum(part**2 for part in parts.values())), parts)


def _linear(load: Sensitivity, scales: Scales | None, moved: Moved) -> float:
    """The load at moved inputs, to first order in γ, α, Δ/L, T₁ and the hole; in N with ``scales``."""
    problem, new = moved
    force = load.force
    if load.elsewhere is not None and problem.axis != load.problem.axis:
        force = load.elsewhere(problem)
    else:
        for name, (slope, _) in load.derivatives.items():
            force += slope * (getattr(problem, name) - getattr(load.problem, name))
    if scales is None or new is None:
        return force
    unit = scales.factor("force")
    return load.force * new.factor("force") + (force - load.force) * unit
