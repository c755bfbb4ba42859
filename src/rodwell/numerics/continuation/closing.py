"""Closed loops: whether a branch has come back to where it began."""

from __future__ import annotations

from rodwell.numerics.continuation.location import LocationError, Segment, bracketed_root
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes

CLOSED = "closed"
"""Why a branch ends that has come back to where it began."""

SAME_STATE = 1e-5
"""Distance between two states, in the metric of the family, that are one."""


def closes(
    meshes: TwoMeshes, before: MeshedState, after: MeshedState, start_meshes: TwoMeshes, start: MeshedState
) -> MeshedState | None:
    """Return the start of a branch on these meshes if it lies between two points of the branch, None otherwise.

    The branch has to pass the hyperplane through the start that is normal to the tangent there, in the same sense, and
    at the start itself. ``start_meshes`` are those of the start; ``meshes`` the same, or finer ones nested in them.
    """
    family, length = meshes.coarse, before.coarse.along(after.coarse)
    if abs(start.lam - after.lam) > 2.0 * length * family.lam_scale:
        return None
    here = start if meshes is start_meshes else meshes.adopt(start_meshes, start)[1]
    if here is None:
        return None
    first, ends = here.coarse, (before.coarse, after.coarse)
    if min(_distance(meshes, first, end) for end in ends) > length:
        return None
    if not first.along(ends[0]) < 0.0 <= first.along(ends[1]):
        return None
    segment = Segment(family, *ends)
    try:
        t = bracketed_root(lambda t: first.along(segment(t)), 0.0, 1.0, *(first.along(end) for end in ends))
        passing = segment(t)
    except LocationError:
        return None
    return here if _distance(meshes, first, passing) <= SAME_STATE else None


def _distance(meshes: TwoMeshes, a: State, b: State) -> float:
    return meshes.coarse.distance(b.c - a.c, b.lam - a.lam)
