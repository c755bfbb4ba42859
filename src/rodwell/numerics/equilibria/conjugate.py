"""What a parameter works on, and how it changes along a branch."""

from __future__ import annotations

import numpy as np

from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.splines import assembly


def conjugate_rate(family: Family, state: State) -> float:
    """Rate of ∂E/∂λ along the tangent of a state, for an energy E that is linear in λ: ∂²E/∂c∂λ · dc/ds."""
    space = family.space
    gradient, mixed, band = np.empty(space.size), np.empty(space.size), np.empty((space.size, space.degree + 1))
    at = family.parameters(state.lam), family.rates(state.lam)
    assembly.assemble(family.mesh, state.c, *at, gradient, mixed, band)
    return float(mixed @ state.tangent)
