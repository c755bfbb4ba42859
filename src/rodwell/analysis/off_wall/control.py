"""What is controlled along a path: the end force, or the shortening, alone or with what gives way in series.

A rod of axial stiffness EA, pushed through a spring of stiffness k, gives way by its shape, u, and by the strain of
both: with the end force F, tension positive, the driven end moves by

    δ = u − cF,    c = 1/EA + 1/k  (L = 1),

counted from the straight rod without end force. The shape itself is that of an inextensible rod: what the strain
changes in it is of the order of F/EA.
"""

from __future__ import annotations

from dataclasses import dataclass

from rodwell.analysis.off_wall.arrange import at_load
from rodwell.analysis.off_wall.conditions import PatternedState
from rodwell.numerics.stretches.bordered import Row, fixed_load, fixed_work
from rodwell.numerics.stretches.chain import Chain
from rodwell.numerics.stretches.newton import Solved, solve
from rodwell.numerics.stretches.walk import Motion, search, tangent_in_load
from rodwell.problem.problem import Problem

NAMES = ("force", "shortening")
"""What can be controlled: the end force (in B/L²), or the shortening (in L)."""


@dataclass(frozen=True)
class Control:
    """The controlled quantity, by name.

    ``unit`` is the unit of shortening of chains, Δ², in L; ``compliance`` is c, in L³/B.
    """

    name: str
    unit: float = 1.0
    compliance: float = 0.0

    @property
    def by_force(self) -> bool:
        """Whether the end force is controlled."""
        return self.name == "force"

    @property
    def held(self) -> str:
        """What is held, in words."""
        return "driven displacement" if self.compliance else self.name

    def value(self, one: Solved) -> float:
        """The controlled quantity in a state."""
        load = one.shape.load
        return load if self.by_force else one.out.energy_by_load * self.unit - self.compliance * load

    def of_straight(self, load: float) -> float:
        """The controlled quantity of the straight rod at an end force."""
        return load if self.by_force else -self.compliance * load

    def straight_load(self, value: float) -> float | None:
        """The end force of the straight rod where the controlled quantity has a value; None: any, it is rigid."""
        if self.by_force:
            return value
        return -value / self.compliance if self.compliance else None

    def scale(self, value: float, load: float) -> float:
        """What a change of the controlled quantity is compared with."""
        return max(abs(value), 1.0) if self.by_force else max(abs(value), self.unit * abs(load))

    def rate(self, one: Solved, along: Motion) -> float:
        """How fast it changes along a path."""
        if self.by_force:
            return along.load
        work = one.work_rate(along.nodes, along.breaks, along.load)
        return work * self.unit - self.compliance * along.load

    def index(self, one: Solved, along: Motion, sense: float) -> int:
        """The stability index where it is controlled, on a path along which it changes in this sense.

        With a spring the second variation is H + ggᵀ/c, g = ∂u/∂x, H that under a dead load. It has one negative
        eigenvalue less than H if c + gᵀH⁻¹g < 0, and gᵀH⁻¹g is −du/dF along the path: if dδ/dF = du/dF − c > 0. For
        c = 0 the same holds on the constraint u = const.
        """
        return one.index if self.by_force else one.index - int(along.load * sense > 0.0)

    def index_at(self, one: Solved) -> int:
        """The same in a single state."""
        if self.by_force:
            return one.index
        along = tangent_in_load(one, -1.0)
        return one.index - int(self.rate(one, along) * along.load > 0.0)

    def potential(self, one: Solved) -> float:
        """The energy that is least where it is controlled, in the chain's unit: with the spring's, not the load's."""
        if self.by_force:
            return one.out.energy
        load = one.shape.load
        return one.out.energy - load * one.out.energy_by_load + 0.5 * self.compliance * load**2 / self.unit

    def row(self, chain: Chain, value: float) -> Row:
        """The row that prescribes it."""
        if self.by_force:
            return fixed_load(chain, value)
        return fixed_work(chain, value / self.unit, -self.compliance / self.unit)

    def at(self, state: PatternedState, value: float, attempts: int = 1) -> PatternedState | None:
        """The state of the same pattern where the controlled quantity has a value; None if it is not found.

        ``attempts`` as of :func:`~rodwell.analysis.off_wall.arrange.at_load`.
        """
        if self.by_force:
            return at_load(state, value, attempts)
        model, along = state.model, tangent_in_load(state.solved, -1.0)
        found = solve(model, state.solved.shape, self.row(state.solved.shape.chain, value))[1]
        if found is None:
            found = search(model, state.solved, along, lambda one: self.value(one) - value, 1e-4, 1.0)
        return None if found is None else PatternedState(state.pattern, state.elements, found)


FORCE = Control("force")


def shortening(problem: Problem, compliance: float = 0.0) -> Control:
    """The shortening of a rod's span under control, with a compliance in series."""
    return Control("shortening", problem.clearance**2, compliance)
