"""Special points of a branch, of one kind."""

from __future__ import annotations

from rodwell import Branch


def special(branch: Branch, kind: str) -> list[float]:
    return [point.force for point in branch.special_points if point.kind == kind]
