"""The certificate of a state off the wall: balance along the rod, signs of contact, reactions by two routes.

The solver makes an energy stationary. Here the internal force is rebuilt from the shape by moment balance
(:mod:`rodwell.physics.off_wall.forces`), and put into force balance, which the solver does not use:

* along a free stretch n(b) − n(a) = ∫ wₗ i + wₐ k ds,
* along a stretch in contact the same with p d₁, p from the formula of the rod kept on the wall,
* at each point force n jumps by −P d₁: P by the jump against P by virtual work, and nothing in any other direction.

In a curved hole the balance is that of vectors in space, with the hole's frame where the rod is: of the state beside
this one that has every cross-section at its own place (:mod:`rodwell.analysis.off_wall.curved.own_places`).

Complementarity: no penetration, no contact that pulls.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rodwell.analysis.off_wall.conditions import OPENS, UNHELD, PatternedState, at_steps, conditions
from rodwell.analysis.off_wall.curved.model import RodOffCurvedWall
from rodwell.analysis.off_wall.curved.own_places import in_fixed_axes, weight_axes, with_own_places
from rodwell.analysis.off_wall.measured import position
from rodwell.quantities.arrays import BoolArray, FloatArray

LIMIT = 1e-7
"""Largest residual of balance, relative to the end force, that counts as zero."""

PENETRATION = 1e-8
"""Largest penetration, in Δ, that counts as none."""

PANELS, ORDER = 6, 8
INSET = 1e-12

_RULE = np.polynomial.legendre.leggauss(ORDER)

ON_AXIS = 1e-300
"""Distance from the hole's axis, in L, below which nothing is in contact: the direction outwards is none there."""


@dataclass(frozen=True)
class ContactCertificate:
    """What is left of each condition.

    Attributes
    ----------
    residuals
        Relative to the end force (or the weight, if that is larger): "balance of free stretches", "balance of
        stretches in contact", "point forces by two routes" and "jumps across the wall's normal".
    penetration
        Largest penetration of a hard wall, in Δ; 0 for none, and behind a soft wall, which gives way.
    least_force
        Least concentrated contact force in B/L² (infinite without one), and
    least_pressure
        least contact force per length in B/L³ (infinite without a stretch in contact): positive where contact pushes.
    """

    residuals: dict[str, float]
    penetration: float
    least_force: float
    least_pressure: float

    @property
    def worst(self) -> float:
        """The largest residual."""
        return max(self.residuals.values())

    @property
    def passed(self) -> bool:
        """Whether the state is an equilibrium with contact that pushes, to within the limits."""
        pushes = self.least_force >= -LIMIT and self.least_pressure >= -LIMIT
        return self.worst <= LIMIT and self.penetration <= PENETRATION and pushes

    def as_dict(self) -> dict[str, Any]:
        """Plain data, for JSON; what does not apply is null."""

        def finite(number: float) -> float | None:
            return number if np.isfinite(number) else None

        return {
            "worst": self.worst, "passed": self.passed, "residuals": self.residuals, "penetration": self.penetration,
            "least_force": finite(self.least_force), "least_pressure": finite(self.least_pressure),
        }  # fmt: skip


def contact_certificate(state: PatternedState) -> ContactCertificate:
    """Evaluate the certificate of a state."""
    return ContactCertificate(_residuals(_balanced(state)), _penetration(state), *_least(state))


def _balanced(state: PatternedState) -> PatternedState:
    """The state whose balance is looked at; where that with its own places was not found, the state misses it."""
    if not isinstance(state.model, RodOffCurvedWall):
        return state
    return with_own_places(state, near=True) or state


def _residuals(state: PatternedState) -> dict[str, float]:
    """What is left of the balance, by its name."""
    problem, points = state.model.problem, state.point_forces
    scale = max(abs(state.load), problem.weight, 1.0)
    left, right, on = _parts(state)
    inset = INSET * (right - left)
    places = np.linspace(left + inset, right - inset, PANELS + 1, axis=1)
    n = _force(state, places.ravel()).reshape(3, *places.shape)
    # along the rod's own axis and around the wall in contact too; the normal one by the pressure
    missed = np.max(np.abs(np.diff(n, axis=2) - _loads(state, places)), axis=(0, 2))
    free, touching = (float(np.max(missed[kind], initial=0.0)) for kind in (~on, on))
    routes, across = 0.0, 0.0
    ends = [(part[:, 0], part[:, -1]) for part in n.transpose(1, 0, 2)]
    ends = _with_loads(state, ends)
    for i, (place, outward, _) in enumerate(points):
        jump = ends[i + 1][0] - ends[i][1]
        at = np.array([place])
        x, y, _ = position(state, at)
        radial = np.stack([x[0], y[0], 0.0 * at]) / np.hypot(x[0], y[0])
        inward = -in_fixed_axes(state, at, radial)[:, 0]
        force = problem.clearance * outward
        routes = max(routes, abs(float(-jump @ inward) - force))
        across = max(across, float(np.max(np.abs(jump - (jump @ inward) * inward))))
    return {
        "balance of free stretches": free / scale,
        "balance of stretches in contact": touching / scale,
        "point forces by two routes": routes / scale,
        "jumps across the wall's normal": across / scale,
    }


def _with_loads(
    state: PatternedState, ends: list[tuple[FloatArray, FloatArray]]
) -> list[tuple[FloatArray, FloatArray]]:
    """Internal forces at the ends of parts, with those beyond loose ends that touch the wall: N k, the load alone."""
    tips = [place in state.pattern.edges for place in (0.0, 1.0)]
    loads = state.load + state.problem.axial_weight * state.problem.rod.lever(np.array([0.0, 1.0]))
    first, last = ([(np.array([0.0, 0.0, n]),) * 2] * tip for n, tip in zip(loads, tips, strict=True))
    return [*first, *ends, *last]


def _parts(state: PatternedState) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Stretches, parted at edges and kinks: from where to where, and whether in contact, (k,) each."""
    bounds = np.union1d(state.bounds, [*state.pattern.edges, *(s for s, _ in state.kink_forces)])
    owner = np.searchsorted(state.bounds, bounds[:-1], side="right") - 1
    return bounds[:-1], bounds[1:], np.asarray(state.touching)[owner]


def _force(state: PatternedState, s: FloatArray) -> FloatArray:
    """The internal force at places (m,) by moment balance, (3, m)."""
    x, y, _ = position(state, s)
    return in_fixed_axes(state, s, state.model.in_space(s, x, y, state.load).n)


def _loads(state: PatternedState, places: FloatArray) -> FloatArray:
    """∫ wₗ i + wₐ k + p d₁ ds between the places of each part (k, m), in order, (3, k, m−1)."""
    problem = state.model.problem
    points, weights = _RULE
    inner = np.concatenate([state.solved.shape.places, state.bounds])
    grid = np.union1d(places, inner[(inner > places[0, 0]) & (inner < places[-1, -1])])
    grid = np.union1d(grid, 0.5 * (grid[1:] + grid[:-1]))  # two panels of the rule between kinks
    half, middle = 0.5 * np.diff(grid), 0.5 * (grid[1:] + grid[:-1])
    s = (middle[:, None] + half[:, None] * points).ravel()
    x, y, pressure = position(state, s)
    inward = -pressure / np.maximum(np.hypot(x[0], y[0]), ON_AXIS) * np.stack([x[0], y[0], 0.0 * s])
    density = in_fixed_axes(state, s, inward) + weight_axes(state)[:, None] * problem.rod.weight(s)
    panels = density.reshape(3, -1, ORDER) @ weights * half
    # between the last place of a part and the first of the next there is nothing but their insets
    sums = np.add.reduceat(panels, np.searchsorted(middle, places.ravel()[:-1]), axis=1)
    return np.asarray(np.append(sums, np.zeros((3, 1)), axis=1).reshape(3, *places.shape)[:, :, :-1])


def _penetration(state: PatternedState) -> float:
    """How deep free stretches reach into a hard wall; a soft one gives way."""
    deepest = 0.0
    if state.model.soft:
        return deepest
    for i, on in enumerate(state.pattern.touching):
        if not on:
            s = np.linspace(float(state.bounds[i]), float(state.bounds[i + 1]), 400)
            x, y, _ = position(state, s)
            r = np.hypot(x[0], y[0]) / state.problem.clearance
            deepest = max(deepest, float(np.max(r - state.problem.rod.clearance(s))))
    return max(deepest, 0.0)


def _least(state: PatternedState) -> tuple[float, float]:
    """Least concentrated force, and least contact force per length."""
    asked = [] if state.model.soft else at_steps(state)
    unseen = {one.s for one in asked if one.kind == UNHELD and one.value >= 0.0}  # of gaps that do not count
    forces = state.problem.clearance * np.array([force for s, force, _ in state.point_forces if s not in unseen])
    pressing = [one.value for one in conditions(state) if one.kind == OPENS]
    return float(np.min(forces, initial=np.inf)), float(min(pressing, default=np.inf))
