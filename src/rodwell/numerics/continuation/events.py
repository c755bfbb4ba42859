"""What can happen along a branch, and what is said of it where it was located."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rodwell.numerics.continuation.location import LocatedZero
from rodwell.numerics.equilibria.error import CLAIMED_GAIN
from rodwell.numerics.equilibria.state import State
from rodwell.numerics.equilibria.two_meshes import MeshedState, TwoMeshes
from rodwell.quantities.arrays import FloatArray

INDEX, TURN = "index", "turn"
"""Names under which changes of the stability index, and turning points without one, are reported."""


@dataclass(frozen=True)
class Event:
    """A function of λ and the measured numbers whose zeros are to be found; of λ alone, if ``level`` is given."""

    name: str
    function: Callable[[float, FloatArray], float]
    level: float | None = None

    @classmethod
    def at(cls, name: str, level: float) -> Event:
        """Where λ is ``level``."""
        return cls(name, lambda lam, _: lam - level, level)


@dataclass(frozen=True)
class LocatedEvent:
    """Something located: name, point and its meshes, error of its λ, stability index on either side.

    ``rising`` is the sense of an event's function along the branch. ``fold`` says that λ turns back where the index
    changes. ``certain`` is False for a change of the index that only one mesh shows: the eigenvalue
    vanishes to round-off. ``after`` is the number of the point of the branch that it follows.
    """

    name: str
    point: MeshedState
    meshes: TwoMeshes
    lam_error: float
    index_before: int
    index_after: int
    rising: bool = False
    fold: bool = False
    certain: bool = True
    after: int = 0


@dataclass(frozen=True)
class Leaving:
    """That a branch leaves another where it starts, and the stability index that it has from there on.

    ``falling`` is the index if λ falls, ``rising`` if it grows. Where one eigenvalue vanishes, two branches that cross
    exchange their stability: this one has on one side of λ the index that the other has on the other side. See M. G.
    Crandall, P. H. Rabinowitz, *Arch. Ration. Mech. Anal.* 52 (1973) 161–180. None where nothing is known.
    """

    falling: int | None = None
    rising: int | None = None

    def index(self, state: State) -> int:
        """The index that the branch has where it is at ``state``, right behind its start."""
        expected = self.falling if state.tangent_lam < 0.0 else self.rising
        return state.index if expected is None else expected


Placed = tuple[float, LocatedEvent]
"""What was located, after its place between two points, from 0 to 1."""


def found_at(
    name: str,
    meshes: TwoMeshes,
    place: LocatedZero,
    before: int,
    after: int,
    *,
    rising: bool = False,
    fold: bool = False,
    doubt: float = 0.0,
) -> LocatedEvent:
    """Describe what was located on ``meshes``; ``doubt`` is counted to the error of λ.

    ``before`` and ``after`` are the stability index on either side.
    """
    point = meshes.point(place.coarse, place.fine)
    error = place.gap / CLAIMED_GAIN + doubt
    return LocatedEvent(name, point, meshes, error, before, after, rising=rising, fold=fold)


def unknown_at(event: Event, point: MeshedState) -> float:
    """Error of an event's function at a point."""
    value = event.function(point.lam, point.values)
    return max(abs(event.function(point.lam, point.values + sign * point.error) - value) for sign in (1.0, -1.0))


def index_at(t: float, index: int, changes: Sequence[Placed]) -> int:
    """Stability index at a place, from that at the start and the changes."""
    for place, change in sorted(changes, key=lambda item: item[0]):
        if place < t:
            index = change.index_after
    return index
