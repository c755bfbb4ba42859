"""The way from one problem and end force to others: all numbers move in a straight line."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from rodwell.analysis.off_wall.curved.model import rod_in_hole
from rodwell.analysis.off_wall.model import RodInHole
from rodwell.errors import InputError
from rodwell.problem.problem import Problem


def check_alike(old: Problem, new: Problem) -> None:
    """Raise where a state of one problem cannot become one of the other by moving numbers."""
    for one in fields(Problem):
        before, after = getattr(old, one.name), getattr(new, one.name)
        if not _numbers_only(before, after):
            raise InputError(one.name, after, f"must be like that of the state, {before}, but for its numbers")
    if (old.lateral_weight == 0.0) != (new.lateral_weight == 0.0):
        what = "must press the rod to the wall as that of the state does, or not at all as there"
        raise InputError("weight", new.weight, what)


def _numbers_only(before: Any, after: Any) -> bool:
    if isinstance(before, tuple) and isinstance(after, tuple):
        return len(before) == len(after) and all(map(_numbers_only, before, after))
    return before == after or (isinstance(before, float) and isinstance(after, float))


def _mixed(before: Any, after: Any, part: float) -> Any:
    """What lies between two values; the values themselves at the ends."""
    if before == after or part in (0.0, 1.0):
        return before if part == 0.0 else after
    if isinstance(before, tuple):
        return tuple(_mixed(one, other, part) for one, other in zip(before, after, strict=True))
    return before + part * (after - before)


@dataclass(frozen=True)
class Way:
    """The way from one problem and load to others, and the stiffness of the wall."""

    old: Problem
    new: Problem
    first: float
    last: float
    wall: float

    def problem(self, part: float) -> Problem:
        """The problem at a part of the way."""
        if part in (0.0, 1.0):
            return self.new if part else self.old
        names = [one.name for one in fields(Problem)]
        return Problem(**{name: _mixed(getattr(self.old, name), getattr(self.new, name), part) for name in names})

    def model(self, part: float) -> RodInHole:
        """The rod in its hole there."""
        return rod_in_hole(self.problem(part), self.wall)

    def load(self, part: float) -> float:
        """The end force there."""
        return float(_mixed(self.first, self.last, part))

    @property
    def far(self) -> float:
        """The largest part by which a number moves."""
        pairs = [(getattr(self.old, one.name), getattr(self.new, one.name)) for one in fields(Problem)]
        return max([0.0, *(_far(*pair) for pair in [*pairs, (self.first, self.last)])])


def _far(before: Any, after: Any) -> float:
    if isinstance(before, tuple):
        return max([0.0, *map(_far, before, after)])
    return 0.0 if before == after else abs(after - before) / max(abs(after), abs(before))
