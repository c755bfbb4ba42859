"""A pattern of contact being rewritten: where stretches are parted and joined, and what the first state of it holds."""

from __future__ import annotations

from dataclasses import dataclass, field

from rodwell.analysis.off_wall.bumps import Bump
from rodwell.analysis.off_wall.conditions import PatternedState


@dataclass(repr=False)
class Plan:
    """A pattern being rewritten: stretches, ends between them, gaps that open, and the length to hold.

    ``half`` is half the first length of a gap, ``contact`` the first length of a stretch in contact; ``edges`` are
    those of narrower parts of the hole that the rod touches.
    """

    state: PatternedState
    half: float
    contact: float
    touching: list[bool]
    breaks: list[float]
    edges: list[float]
    bumps: list[Bump] = field(default_factory=list)
    pair: tuple[float, float] | None = None

    @property
    def fixed(self) -> tuple[int, int] | None:
        """The numbers of the ends whose distance is held."""
        if self.pair is None:
            return None
        places = [0.0, *self.breaks, 1.0]
        first, last = (places.index(place) - 1 for place in self.pair)
        return first, last
