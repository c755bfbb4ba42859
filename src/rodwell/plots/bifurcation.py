"""Bifurcation diagram: end curvature against end compression, stable and unstable parts, special points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rodwell.analysis.branches import Branch
from rodwell.analysis.critical import CriticalLoads
from rodwell.analysis.measures import Measured
from rodwell.plots.style import GREY, INK, MODES, WARN, new_axes
from rodwell.plots.units import axis
from rodwell.practice.scales import Scales

MARKERS = {
    "critical": ("D", "critical load"),
    "lift_off": ("o", "lift-off"),
    "branch_point": ("^", "secondary bifurcation"),
    "fold": ("s", "fold"),
}


def plot_bifurcation(
    branches: Sequence[Branch], critical: CriticalLoads, scales: Scales | None = None, ax: Any = None
) -> Any:
    """Draw ω₂(1) against the end compression −F at s = 1 for a set of branches; return the axes.

    Stable parts (under dead loads, for a rod kept on the wall) are thick, unstable ones thin and dashed. Both arms
    of each pitchfork are drawn (with end twist, the one followed); beyond lift-off the lines are pale, since the wall
    would have to pull.
    """
    ax = new_axes() if ax is None else ax
    top = max(float(np.max(np.abs(b.numbers(Measured.OMEGA2_1)))) for b in branches)
    farthest = max(float(np.max(np.abs(b.force))) for b in branches)
    fx, ux = axis("force", scales, farthest)
    fy, uy = axis("omega2_at_1", scales, top)
    _straight(ax, branches, critical, fx)
    seen: set[str] = set()
    for branch in branches:
        _branch(ax, branch, fx, fy)
        seen |= _special(ax, branch, fx, fy)
    for kind, (marker, text) in MARKERS.items():
        if kind in seen:
            ax.plot([], [], marker, color=_face(kind), mec=INK, ms=6, label=text)
    ax.plot([], [], color=INK, lw=2.2, label="stable")
    ax.plot([], [], color=INK, lw=1.0, ls=(0, (5, 2)), label="unstable")
    ax.plot([], [], color=INK, lw=1.4, alpha=0.35, label="beyond lift-off")
    _labels(ax, branches, fx, fy, 2.0 * top * fy)
    ax.set_xlabel(f"end compression −F at s = 1  [{ux}]")
    ax.set_ylabel(f"end curvature ω₂(1)  [{uy}]")
    ax.legend(loc="upper left", ncols=2)
    return ax


def _straight(ax: Any, branches: Sequence[Branch], critical: CriticalLoads, fx: float) -> None:
    first = critical[0].force
    end = min(float(b.force.min()) for b in branches)
    start = first + 0.25 * (first - end)
    ax.plot([-start * fx, -first * fx], [0, 0], color=INK, lw=2.2)
    ax.plot([-first * fx, -end * fx], [0, 0], color=GREY, lw=1.0, ls=(0, (5, 2)))


def _branch(ax: Any, branch: Branch, fx: float, fy: float) -> None:
    """Draw both arms in pieces of one style: stable or not, before or beyond lift-off."""
    color = _color(branch)
    x, y, stable, beyond = _with_special_points(branch)
    style = stable[1:].astype(int) + 2 * beyond[1:].astype(int)
    starts = np.flatnonzero(np.diff(style, prepend=-1))
    for start, stop in zip(starts, [*starts[1:], len(style)], strict=True):
        part = slice(start, stop + 1)
        solid = stable[start + 1]
        for sign in _arms(branch):
            ax.plot(
                x[part] * fx, sign * y[part] * fy, color=color, lw=2.2 if solid else 1.0,
                alpha=0.35 if beyond[start + 1] else 1.0, ls="-" if solid else (0, (5, 2)), solid_capstyle="butt",
            )  # fmt: skip


def _with_special_points(branch: Branch) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Points and special points in order of travel: −F, ω₂(1), stable on the way there, beyond lift-off; all (n,)."""
    rows = [
        (-f, y, int(index))
        for f, y, index in zip(branch.force, branch.numbers(Measured.OMEGA2_1), branch.stability_index, strict=True)
    ]
    for point in branch.special_points:
        if point.kind in ("lift_off", "branch_point", "fold"):
            y = point.solution.number(Measured.OMEGA2_1)[0]
            here = _insertion(rows, -point.force)
            rows.insert(here, (-point.force, y, point.index_before))
    table = np.array(rows)
    x, curvature, index = table[:, 0], table[:, 1], table[:, 2]
    lift = branch.lift_off
    beyond = x > -lift.force if lift is not None else np.zeros(len(x), dtype=bool)
    return x, curvature, index == 0, beyond


def _insertion(rows: list[tuple[float, float, int]], x: float) -> int:
    """Where a point belongs: between the first two rows that it lies between."""
    for i in range(1, len(rows)):
        if (rows[i - 1][0] - x) * (rows[i][0] - x) <= 0.0:
            return i
    return len(rows)


def _labels(ax: Any, branches: Sequence[Branch], fx: float, fy: float, height: float) -> None:
    """Number the branches at their ends, pushed apart where they would overlap."""
    ends = sorted((abs(float(b.numbers(Measured.OMEGA2_1)[-1])) * fy, -float(b.force[-1]) * fx, b) for b in branches)
    last = -np.inf
    for y, x, branch in ends:
        assert branch.mode is not None
        place = max(y, last + 0.055 * height)
        ax.annotate(
            f"mode {branch.mode.number}", (x, y), xytext=(x, place), textcoords="data", color=_color(branch),
            va="center", fontweight="bold", fontsize=8.5, annotation_clip=False,
        ).set_position((x * 1.012, place))  # fmt: skip
        last = place


def _arms(branch: Branch) -> tuple[float, ...]:
    """Signs of the arms that are known: without twist, the other arm is the mirror image."""
    return (1.0, -1.0) if branch.problem.twist == 0.0 else (1.0,)


def _color(branch: Branch) -> str:
    assert branch.mode is not None
    return MODES[(branch.mode.number - 1) % len(MODES)]


def _special(ax: Any, branch: Branch, fx: float, fy: float) -> set[str]:
    seen = set()
    color = _color(branch)
    for point in branch.special_points:
        if point.kind not in MARKERS:
            continue
        seen.add(point.kind)
        y = point.solution.number(Measured.OMEGA2_1)[0] * fy
        for sign in _arms(branch) if y != 0.0 else (1.0,):
            ax.plot(
                -point.force * fx,
                sign * y,
                MARKERS[point.kind][0],
                color=_face(point.kind),
                mec=color,
                ms=6,
                zorder=5,
            )
    return seen


def _face(kind: str) -> str:
    return WARN if kind == "lift_off" else "white"
