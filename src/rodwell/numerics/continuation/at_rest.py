"""Branches that come back to the state at rest, u = 0, which is an equilibrium whatever λ is, and pass through it.

There they cross the branch of these states: λ is one at which that loses its stability, and need not turn back. What is
exact there is the linear problem at rest. Beyond, the branch is the other arm of what leaves at this λ.
"""

from __future__ import annotations

import numpy as np

from rodwell.numerics.continuation.location import LocatedZero, bracketed_root
from rodwell.numerics.equilibria.family import Family
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes

OPPOSITE = -0.99
"""Cosine, in the metric, of states on either side of rest: all that is left of them is the mode."""

BALANCED = 1e-9
"""Largest force at rest, as a part of what deflects the rod by one unit of ``scale_c``, that is round-off."""


def passes_rest(meshes: TwoMeshes, before: MeshedState, after: MeshedState) -> LocatedZero | None:
    """Where the branch passes the state at rest between two points, on both meshes, if it does."""
    fine = meshes.fine
    if float(before.fine.c @ after.fine.c) >= 0.0 or not _rests_between(fine, before.fine, after.fine):
        return None
    places = [
        _singular(family.with_exact_tangent(), a, b)
        for family, a, b in ((meshes.coarse, before.coarse, after.coarse), (fine, before.fine, after.fine))
    ]
    if places[0] is None or places[1] is None:
        return None
    t = before.fine.along(places[1]) / before.fine.along(after.fine)
    return LocatedZero(t, places[0], places[1]) if 0.0 < t < 1.0 else None


def _rests_between(family: Family, before: State, after: State) -> bool:
    """Whether two states lie on opposite sides of rest, and it is an equilibrium."""
    lengths = [family.distance(c, 0.0) for c in (before.c, after.c, before.c + after.c)]
    if min(lengths[:2]) == 0.0:  # a rod that is turned as a whole, and not deflected
        return False
    cosine = (lengths[2] ** 2 - lengths[0] ** 2 - lengths[1] ** 2) / (2.0 * lengths[0] * lengths[1])
    if cosine > OPPOSITE:
        return False
    _, force, band = family.assemble(np.zeros_like(before.c), before.lam)
    return bool(np.max(np.abs(force[family.held.free])) <= BALANCED * family.scale_c * np.max(np.abs(band)))


def _singular(family: Family, before: State, after: State) -> State | None:
    """The state at rest at the λ between two states at which its Hessian is singular along what parts them."""
    vector = after.c - before.c
    rest = np.zeros_like(vector)

    def at(lam: float) -> State:
        return family.state(rest, lam, after.c - before.c, after.lam - before.lam, before.index)

    def eigenvalue(lam: float) -> float:
        return family.nearest_curvature(at(lam), vector, 3)[0]

    ends = before.lam, after.lam
    values = eigenvalue(ends[0]), eigenvalue(ends[1])
    if values[0] * values[1] >= 0.0:
        return None
    noise = family.nearest_curvature(at(ends[0]), vector, 1)[1]
    return at(bracketed_root(eigenvalue, *ends, *values, noise=noise))
