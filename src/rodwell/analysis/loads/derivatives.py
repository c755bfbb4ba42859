"""Derivatives of one load by what its problem is made of, and what one percent of a physical input does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rodwell.problem.problem import Problem
from rodwell.problem.varying import CURVATURES
from rodwell.quantities.value import Value

PARAMETERS = ("weight", "alpha", "clearance")
"""The numbers of a dimensionless problem that a load depends on: γ, α in degrees, Δ/L; in a curved hole those of
:func:`rodwell.analysis.straight.lying_slopes.inputs_of`."""

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
        "build", ∂f/∂(k₁L), and out of the vertical plane "walk", ∂f/∂(−k₂L); in one along points those by γ and Δ/L
        alone, the points in L staying where they are.
    note
        What to know about them, or nothing.
    sections
        Of a string, for each section from s = 0: ∂f by its ratios "stiffness" and "weight", and, of critical loads, by
        the place "upper_end" of the step above it (all but the last), with error estimates. Where a section tapers
        they are by "stiffness_factor" and "weight_factor", on all its values, at 1, and those by the places of its ends
        are left out; of strings that bridge steps of the clearance also by "clearance". T₁ is a dead load.
    converged
        Whether the load, and the state that the derivatives are taken at, meet the tolerance asked for.
    elsewhere
        The load of a problem nearby whose hole is another, to first order in what differs: where the hole is given by
        points, which an input may move. None in holes that are told by numbers.
    """

    name: str
    problem: Problem
    force: float
    derivatives: Derivatives
    note: str = ""
    sections: tuple[Derivatives, ...] = ()
    converged: bool = True
    elsewhere: Callable[[Problem], float] | None = field(default=None, repr=False, compare=False)

    def elasticities(self) -> Derivatives:
        """Change of the load F in percent for one percent more of each physical input, with error estimates.

        ``weight_per_length`` mg, ``clearance`` Δ, ``stiffness`` B, ``length`` L, each with the others constant; and
        ``alpha``, in percent for one degree more. From F = (B/L²) f(mg L³/B, α, Δ/L): e_B = 1 − e_mg,
        e_L = 3 e_mg − e_Δ − 2; under an end torque T, T₁ = T L/B, 1 − e_mg − e_T and 3 e_mg − e_Δ + e_T − 2. In a hole
        of constant curvature also ``build``, that of its curvature, and e_L has e_build more, with the inclination at
        mid-length constant; out of the vertical plane so does ``walk``. In one along points ``length`` and ``alpha``,
        with which these move, are left out.
        """
        weight = self._relative("weight", self.problem.weight)
        clearance = self._relative("clearance", self.problem.clearance)
        # T₁ = T L/B grows with the length and falls with the stiffness
        twist, *bends = (
            self._relative(name, getattr(self.problem, name)) if name in self.derivatives else Value(0.0)
            for name in ("twist", *CURVATURES)
        )
        bend = Value(sum(one.value for one in bends), sum(one.error for one in bends))
        length = 3.0 * weight.value - clearance.value - 2.0 + twist.value + bend.value
        changes = {
            "weight_per_length": weight,
            "clearance": clearance,
            "stiffness": Value(1.0 - weight.value - twist.value, weight.error + twist.error),
            "length": Value(length, 3.0 * weight.error + clearance.error + twist.error + bend.error),
        }
        if "alpha" in self.derivatives:
            changes["alpha"] = self._relative("alpha", 100.0)
        if self.problem.axis:
            del changes["length"]
        return changes | {name: one for name, one in zip(CURVATURES, bends, strict=True) if name in self.derivatives}

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
