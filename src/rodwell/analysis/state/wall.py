"""What the wall and the supports of the cylinder must bear in one state: largest values, places, sides, torque."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.state.compared import compared
from rodwell.analysis.state.equilibrium import Equilibrium
from rodwell.analysis.state.fields import fields_at, steps_of
from rodwell.analysis.state.on_ramps import on_even_wall
from rodwell.analysis.straight.lying import lying_steps
from rodwell.errors import InputError
from rodwell.problem.problem import Problem
from rodwell.quantities.value import Peak, Value

ROUND_OFF = 1e-13
"""Error of what a closed form tells, as a part of it."""

SELF_BALANCED = 1e-6
"""A support torque below this part of the largest twisting moment counts as none."""

MOMENTS = {
    "T2": "twisting moment T₂ in the cylinder",
    "mu": "bending moment μ in the cylinder about d₁ (towards the rod)",
    "cylinder_M3": "bending moment λ cos η in the cylinder about u₂ (around the wall)",
}
"""The moments in the cylinder, (59), and what they are."""


@dataclass(frozen=True)
class WallLoads:
    """Loads on cylinder and supports in one state, units B = L = 1.

    Attributes
    ----------
    contact
        Largest contact force per length, the size of p.
    total
        Integral of the size of p over s, contact forces of all directions added, and its error estimate.
    angle
        ξ₂ where the contact is largest, in rad from the low side: which part of the wall bears it. Positive towards
        the left, looking towards s = 0; of a rod that floats from the high side, towards the right. In states of equal
        contact at several places, at the first.
    cylinder
        What the cylinder itself carries; None in a curved hole and where the clearance varies: equations of a straight
        tube do not tell.
    """

    contact: Peak
    total: Value
    angle: Value
    cylinder: CylinderLoads | None

    @property
    def carried(self) -> CylinderLoads:
        """What the cylinder carries.

        Raises
        ------
        InputError
            In a curved hole.
        """
        if self.cylinder is None:
            reason = "moments in the cylinder are computed in straight holes only: contact, total and angle are known"
            raise InputError("wall", None, reason)
        return self.cylinder

    @property
    def twisting(self) -> Peak:
        """Of :attr:`carried`, as the following ones."""
        return self.carried.twisting

    @property
    def bending_mu(self) -> Peak:
        """Largest size of μ."""
        return self.carried.bending_mu

    @property
    def bending_lambda(self) -> Peak:
        """Largest size of λ cos η."""
        return self.carried.bending_lambda

    @property
    def torque(self) -> Value:
        """T₂(0)."""
        return self.carried.torque

    @property
    def needs_torque(self) -> bool:
        """Whether the support must provide a torque."""
        return self.carried.needs_torque

    @property
    def meaning(self) -> str:
        """What the torque on the cylinder means for its supports, in words; nothing in a curved hole."""
        return "" if self.cylinder is None else self.cylinder.meaning


@dataclass(frozen=True)
class CylinderLoads:
    """What a straight cylinder carries in one state, units B = L = 1.

    Attributes
    ----------
    twisting, bending_mu, bending_lambda
        Largest sizes of T₂, μ and λ cos η, (59).
    torque
        T₂(0): the cylinder's support at s = 0 exerts −T₂(0) on it, about k; with its error estimate. At s = 1 the
        cylinder is free of load, (B9).
    """

    twisting: Peak
    bending_mu: Peak
    bending_lambda: Peak
    torque: Value

    @property
    def needs_torque(self) -> bool:
        """Whether the support must provide a torque; it need not where T₂ is symmetric about mid-length (4.1.2)."""
        return abs(self.torque.value) > SELF_BALANCED * self.twisting.value

    @property
    def meaning(self) -> str:
        """What the torque means for the supports, in words."""
        if self.twisting.value == 0.0:
            return "no lateral weight: nothing twists the cylinder"
        if self.needs_torque:
            return "the end supports must provide a torque: the twisting moment does not balance itself"
        return "the end supports need not provide a torque: the twisting moment balances itself"


@dataclass(frozen=True)
class StepLoad:
    """What the wall exerts on the rod where its bending stiffness has a step, or a kink, to keep it on the wall.

    Attributes
    ----------
    s
        Place of the step, in L.
    couple
        Moment about u₁ (normal to the rod, along the wall) in B/L: two opposite radial forces close together, one of
        which pulls. A wall only pushes: where it is not zero the true rod, unless something there holds its slope
        across the wall, leaves the wall over a short stretch beside the step.
    force
        Force towards the axis in B/L²; zero without twist, if the stiffness does not begin or cease to taper there.
    """

    s: float
    couple: Value
    force: Value

    @property
    def lifts(self) -> bool:
        """Whether the rod, held by nothing else there, leaves the wall beside the step: the wall would have to pull."""
        return abs(self.couple.value) > self.couple.error or self.force.value < -self.force.error


def step_loads(solution: Equilibrium) -> tuple[StepLoad, ...]:
    """Return what the wall exerts at steps of the bending stiffness, from s = 0; nothing of a uniform rod."""
    problem = solution.problem
    if not problem.sections:
        return ()
    coarse, fine = (steps_of(problem, family, state) for family, state in solution.levels)
    bent = problem.rod.stiffness_breaks
    return tuple(
        StepLoad(float(s), *(compared(float(old[k]), float(new[k])) for old, new in zip(coarse, fine, strict=True)))
        for k, s in enumerate(problem.rod.breaks[1:-1])
        if bent[k]
    )


def lying_step_loads(problem: Problem) -> tuple[StepLoad, ...]:
    """What the wall exerts at steps of a string that lies along a curved hole, under any end force.

    The hole bends every section alike, by moments that differ: couples −[b]κᵣ, and at kinks of the stiffness forces
    [b′]κᵣ, whatever the end force is.
    """
    couple, radial = lying_steps(problem, 0.0)
    return tuple(
        StepLoad(float(s), *(Value(float(one[k]), ROUND_OFF * abs(float(one[k]))) for one in (couple, radial)))
        for k, s in enumerate(problem.rod.breaks[1:-1])
        if problem.rod.stiffness_breaks[k]
    )


def wall_loads(solution: Equilibrium) -> WallLoads:
    """Return the loads on cylinder and supports in a state."""
    contact = solution.largest("contact_pressure")
    there = np.array([contact.s])
    angles = (float(fields_at(solution.problem, f, state, there)["xi2"][0]) for f, state in solution.levels)
    straight = on_even_wall(solution.problem)
    return WallLoads(contact, solution.total_wall_force, compared(*angles), _carried(solution) if straight else None)


def _carried(solution: Equilibrium) -> CylinderLoads:
    twisting, mu, bending = (solution.largest(name) for name in MOMENTS)
    return CylinderLoads(twisting, mu, bending, solution.number(Measured.TORQUE_0))
