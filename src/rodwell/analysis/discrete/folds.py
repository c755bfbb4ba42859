"""How far round-off moves the load of a fold."""

from __future__ import annotations

import numpy as np

from rodwell.analysis.discrete.pressures import COEFFICIENT_NOISE, STIFFNESS
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.physics.on_wall.parameters import CLEARANCE, RAMP
from rodwell.physics.on_wall.ramps import RodOnRamps, wall_at
from rodwell.physics.on_wall.tapered import RodOfTapers, here

SIDE = 1e-4
"""Part of the load over which the gradient, which is linear in it or nearly so, is differenced."""


def load_noise(family: Family, fold: State) -> float:
    """Round-off in the parameter at a fold, from that in bending moments at the quadrature points.

    With the null vector v of the Hessian, which is the tangent, and m = ∂g/∂λ: what is added to the gradient g moves
    the fold by v·δg / v·m. The sum of the terms of y″ has errors of a few units in the last place of the largest, as
    if at random, at each point.
    """
    space, c, v = fold.space, fold.c, fold.tangent
    _, slope, _ = space.at_points(c)
    bend = space.at_points(v)[2]
    functions = np.repeat(space.starts, space.per_element)[:, None] + np.arange(space.degree + 1)
    terms = np.abs(space.table[:, 2] * c[functions]).sum(axis=1)
    stiffness = 1.0 / (1.0 - (slope + family.parameters(fold.lam)[RAMP]) ** 2)
    if isinstance(family.model, RodOnRamps):  # y is Δ₀θ
        wall = wall_at(space.points, family.mesh.given.T)
        stiffness = stiffness * wall.stiffness[0] * (wall.clearance[0] / family.parameters(fold.lam)[CLEARANCE]) ** 2
    elif isinstance(family.model, RodOfTapers):
        stiffness = stiffness * here(space.points, family.mesh.given.T)[0]
    elif family.mesh.given.shape[1]:
        stiffness = stiffness * family.mesh.given[:, STIFFNESS]
    work = 4.0 * COEFFICIENT_NOISE * float(np.linalg.norm(space.weights * bend * stiffness * terms))
    step, free = SIDE * max(abs(fold.lam), family.lam_scale), family.held
    above, below = (free.gather(family.assemble(c, fold.lam + sign * step)[1]) for sign in (1.0, -1.0))
    lever = abs(float(free.gather(v) @ (above - below))) / (2.0 * step)
    return work / lever if lever > 0.0 else 0.0
