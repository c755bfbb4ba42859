"""What is controlled along a path: the end force, or the shortening of the span."""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.analysis.off_wall.arrange import at_load
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.numerics.stretches.newton import Solved
from rodwell.numerics.stretches.walk import Motion, search, step, tangent_in_load

PROBE = 1e-4
"""Arclength over which the rate of the shortening along a path is taken by a difference."""


@dataclass(frozen=True)
class Control:
    """The controlled quantity, by name: "force" (in B/L²) or "shortening" (in L)."""

    name: str

    @property
    def by_force(self) -> bool:
        """Whether the end force is controlled."""
        return self.name == "force"

    def value(self, one: Solved) -> float:
        """The controlled quantity in a state."""
        if self.by_force:
            return one.shape.load
        clearance: float = one.model.problem.clearance
        return one.out.energy_by_load * clearance**2

    def rate(self, one: Solved, along: Motion) -> float:
        """How fast it changes along a path; NaN where the path cannot be probed."""
        if self.by_force:
            return along.load
        ahead, behind = (step(one.model, one, along, size)[1] for size in (PROBE, -PROBE))
        if ahead is None or behind is None:
            return float("nan")
        return (self.value(ahead) - self.value(behind)) / (2.0 * PROBE)

    def index(self, one: Solved, along: Motion, sense: float) -> int:
        """The stability index where it is controlled, on a path along which it changes in this sense.

        A controlled shortening is one constraint g = const, g = ∂E/∂F. On it the second variation H has one negative
        eigenvalue less if gᵀH⁻¹g < 0, and that is −dg/dF along the path.
        """
        return one.index if self.by_force else one.index - int(along.load * sense > 0.0)

    def index_at(self, one: Solved) -> int:
        """The same in a single state."""
        if self.by_force:
            return one.index
        along = tangent_in_load(one, -1.0)
        return one.index - int(self.rate(one, along) * along.load > 0.0)

    def at(self, state: PatternedState, value: float) -> PatternedState | None:
        """The state of the same pattern where the controlled quantity has a value; None if it is not found."""
        if self.by_force:
            return at_load(state, value)
        model, along = state.model, tangent_in_load(state.solved, -1.0)
        found = search(model, state.solved, along, lambda one: self.value(one) - value, 1e-4, 1.0)
        return None if found is None else PatternedState(state.pattern, state.elements, found)


FORCE, SHORTENING = Control("force"), Control("shortening")

CONTROLS = {control.name: control for control in (FORCE, SHORTENING)}
