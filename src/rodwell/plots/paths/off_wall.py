"""The part of a branch off the wall, in a bifurcation diagram."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from rodwell.analysis.beyond.off_wall_branch import KNOWN_BEYOND, OffWallBranch, number_off_wall
from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.symmetry import Reflection
from rodwell.analysis.discrete.measures import Measured
from rodwell.plots.smooth import BETWEEN, smooth
from rodwell.plots.style import OFF_WALL
from rodwell.quantities.arrays import FloatArray

STABLE, UNSTABLE = 2.4, 1.2
"""Widths of lines."""

Drawn = tuple[Callable[[Any], Any], float]
"""Where an end force lies across, and the factor of the ordinate."""


def all_forces(branch: Branch) -> FloatArray:
    """End forces of all points of a branch, those off the wall included, (n,)."""
    return branch.force if branch.beyond is None else np.concatenate([branch.force, branch.beyond.force])


def named_at(branch: Branch, which: Measured) -> tuple[float, float]:
    """End force and number at the point beside which the name of a branch stands: its last, or the farthest off."""
    if branch.beyond is None or which not in KNOWN_BEYOND:
        return float(branch.force[-1]), float(branch.numbers(which)[-1])
    farthest = int(np.argmin(branch.beyond.force))
    return float(branch.beyond.force[farthest]), number_off_wall(branch.beyond.states[farthest], which)


def ordinate_of(beyond: OffWallBranch, image: Reflection, which: Measured) -> FloatArray:
    """A number of all states of an image of the branch, (n,); NaN where it is known on the wall only."""
    nothing = np.full(len(beyond), np.nan)
    numbers = {m: beyond.numbers(m) if m in KNOWN_BEYOND else nothing for m in Measured}
    return image.numbers(numbers)[which]


def draw_off_wall(
    ax: Any, beyond: OffWallBranch, image: Reflection, which: Measured, drawn: Drawn, **look: Any
) -> list[tuple[str, float, float]]:
    """Draw the states off the wall of an image of a branch; return kind, load and ordinate of its special points."""
    across, up = drawn
    y = ordinate_of(beyond, image, which)
    if np.isnan(y).any():
        return []
    stable = beyond.stability_index == 0
    way = stable[1:] & stable[:-1]
    starts = np.flatnonzero(np.diff(way.astype(int), prepend=-1))
    force, line = smooth(beyond.force, y)
    for start, stop in zip(starts, [*starts[1:], way.size], strict=True):
        part = slice(BETWEEN * start, BETWEEN * stop + 1)
        ax.plot(across(force[part]), line[part] * up, lw=STABLE if way[start] else UNSTABLE, ls=OFF_WALL, **look)
    own = Measured.OMEGA2_0 if image.turned and which == Measured.OMEGA2_1 else which
    own = Measured.OMEGA2_1 if image.turned and which == Measured.OMEGA2_0 else own
    sign = float(np.sign(image.numbers({m: np.ones(1) for m in Measured})[which][0]))
    return [(point.kind, point.force, sign * number_off_wall(point.state.fine, own)) for point in beyond.special_points]
