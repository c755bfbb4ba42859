"""Bifurcation diagram: end curvature against end compression, stable and unstable parts, special points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.symmetry import ODD, Reflection
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.plots.style import GREY, INK, MODES, WARN, new_axes
from rodwell.plots.units import axis
from rodwell.quantities.scales import Scales

MARKERS = {
    "critical": ("D", "critical load"),
    "lift_off": ("o", "lift-off"),
    "branch_point": ("^", "secondary bifurcation"),
    "fold": ("s", "fold"),
    "touch_down": ("o", "contact complete again"),
    "equal_energy": ("P", "energy of the straight rod"),
}


ORDINATES = {
    Measured.OMEGA2_1: ("omega2_at_1", "end curvature ω₂(1)"),
    Measured.OMEGA2_0: ("omega2_at_0", "end curvature ω₂(0)"),
    Measured.ENERGY: ("energy", "energy E, relative to the straight rod"),
    Measured.SHORTENING: ("end_shortening", "approach of the ends 1 − z(1)"),
    Measured.ANGLE_MID: ("angle_at_middle", "angle at mid-length ξ₂(½)"),
    Measured.TORQUE_0: ("support_torque", "support torque T₂(0)"),
    Measured.P_MAX: ("largest_pressure", "largest contact pressure max p"),
}
"""What can be drawn against the end compression: name in the nomenclature and label."""

HOLDS_SLOPE = ("clamped", "guided")
"""Ends that hold the slope y', and so bend the rod: at others ω₂ vanishes."""


STRAIGHT_END = 1e-6
"""Part of the curvature at the other end below which an end counts as straight."""


def telling(branches: Sequence[Branch]) -> Measured:
    """Ordinate that tells branches apart: ω₂ at an end that bends the rod, s = 1 if it can be; energy for a coil.

    A long string under its weight buckles at its lower end only: ω₂(1) is then zero to all digits.
    """
    problem = branches[0].problem
    if problem.turns:
        return Measured.ENERGY
    last, first = (max(abs(b.numbers(at)).max() for b in branches) for at in (Measured.OMEGA2_1, Measured.OMEGA2_0))
    if problem.ends[1] in HOLDS_SLOPE and last >= STRAIGHT_END * first:
        return Measured.OMEGA2_1
    return Measured.OMEGA2_0 if problem.ends[0] in HOLDS_SLOPE else Measured.SHORTENING


def plot_bifurcation(
    branches: Sequence[Branch],
    critical: CriticalLoads,
    scales: Scales | None = None,
    ax: Any = None,
    ordinate: Measured | None = None,
) -> Any:
    """Draw ω₂(1), or another number, against the end compression −F at s = 1 for a set of branches; return the axes.

    Without ``ordinate`` it is the one that :func:`telling` names.

    Stable parts (under dead loads, for a rod kept on the wall) are thick, unstable ones thin and dashed. Images of the
    branches by the reflections that the problem has are drawn too. Where the contact pressure is positive somewhere
    lines are pale, since there the wall would have to pull.
    """
    ax = new_axes() if ax is None else ax
    ordinate = telling(branches) if ordinate is None else ordinate
    top = max(float(np.max(np.abs(b.numbers(ordinate)))) for b in branches)
    farthest = max(float(np.max(np.abs(b.force))) for b in branches)
    name, label = ORDINATES[ordinate]
    fx, ux = axis("force", scales, farthest)
    fy, uy = axis(name, scales, top)
    if critical:
        _straight(ax, branches, critical, fx)
    seen: set[str] = set()
    for number, branch in enumerate(branches):
        color = _color(branch, number)
        for image in branch.images:
            line = _Line(branch, image, ordinate)
            _draw(ax, line, color, fx, fy)
            seen |= _special(ax, line, color, fx, fy)
    for kind, (marker, text) in MARKERS.items():
        if kind in seen:
            ax.plot([], [], marker, color=_face(kind), mec=INK, ms=6, label=text)
    ax.plot([], [], color=INK, lw=2.2, label="stable")
    ax.plot([], [], color=INK, lw=1.0, ls=(0, (5, 2)), label="unstable")
    ax.plot([], [], color=INK, lw=1.4, alpha=PALE, label="off the wall somewhere")
    _labels(ax, branches, ordinate, fx, fy, 2.0 * top * fy)
    ax.set_xlabel(f"end compression −F at s = 1  [{ux}]")
    ax.set_ylabel(f"{label}  [{uy}]")
    ax.legend(loc="best", ncols=2)
    return ax


PALE = 0.35


def _straight(ax: Any, branches: Sequence[Branch], critical: CriticalLoads, fx: float) -> None:
    first = critical[0].force
    end = min(float(b.force.min()) for b in branches)
    start = first + 0.25 * (first - end)
    ax.plot([-start * fx, -first * fx], [0, 0], color=INK, lw=2.2)
    ax.plot([-first * fx, -end * fx], [0, 0], color=GREY, lw=1.0, ls=(0, (5, 2)))


class _Line:
    """A branch, or an image of it, as it is drawn: points and special points in order of travel.

    ``x`` is −F, ``y`` the ordinate; ``stable`` and ``off`` tell of the way that leads to each point, (n,) each.
    """

    def __init__(self, branch: Branch, image: Reflection, ordinate: Measured) -> None:
        numbers = image.numbers({m: branch.numbers(m) for m in Measured})
        rows = [
            [(-f, y, index == 0, p > 0.0)]
            for f, y, index, p in zip(
                branch.force, numbers[ordinate], branch.stability_index, numbers[Measured.P_MAX], strict=True
            )
        ]
        self.special: list[tuple[str, float, float]] = []
        for point in branch.special_points:
            values = {m: np.array([point.solution.number(m).value]) for m in Measured}
            y = float(image.numbers(values)[ordinate][0])
            self.special.append((point.kind, -point.force, y))
            if point.kind not in ("critical", "end"):
                off = bool(values[Measured.P_MAX][0] > 0.0)
                off = {"lift_off": False, "touch_down": True}.get(point.kind, off)
                rows[point.after].append((-point.force, y, point.index_before == 0, off))
        table = np.array([row for group in rows for row in group], dtype=float)
        self.x, self.y = table[:, 0], table[:, 1]
        self.stable, self.off = table[:, 2] > 0.0, table[:, 3] > 0.0


def _draw(ax: Any, line: _Line, color: str, fx: float, fy: float) -> None:
    """Draw a line in pieces of one style: stable or not, on the wall or off it."""
    style = line.stable[1:].astype(int) + 2 * line.off[1:].astype(int)
    starts = np.flatnonzero(np.diff(style, prepend=-1))
    for start, stop in zip(starts, [*starts[1:], len(style)], strict=True):
        part = slice(start, stop + 1)
        solid, off = line.stable[start + 1], line.off[start + 1]
        ax.plot(
            line.x[part] * fx, line.y[part] * fy, color=color, lw=2.2 if solid else 1.0,
            alpha=PALE if off else 1.0, ls="-" if solid else (0, (5, 2)), solid_capstyle="butt",
        )  # fmt: skip


def _special(ax: Any, line: _Line, color: str, fx: float, fy: float) -> set[str]:
    for kind, x, y in line.special:
        if kind in MARKERS:
            ax.plot(x * fx, y * fy, MARKERS[kind][0], color=_face(kind), mec=color, ms=6, zorder=5)
    return {kind for kind, _, _ in line.special}


def _labels(ax: Any, branches: Sequence[Branch], ordinate: Measured, fx: float, fy: float, height: float) -> None:
    """Name the primary branches at their ends, pushed apart where they would overlap."""
    ends = sorted(
        (
            (float(b.numbers(ordinate)[-1]) * fy, -float(b.force[-1]) * fx, i, b)
            for i, b in enumerate(branches)
            if b.origin.parent is None and "mirror" not in b.name
        ),
        key=lambda item: -_upper(item[0], ordinate),
    )
    last = np.inf
    for y, x, number, branch in ends:
        place = min(_upper(y, ordinate), last - 0.055 * height)
        ax.annotate(
            branch.name, (x, place), xytext=(5.0, 0.0), textcoords="offset points", color=_color(branch, number),
            va="center", fontweight="bold", fontsize=8.5, annotation_clip=False,
        )  # fmt: skip
        last = place


def _upper(y: float, ordinate: Measured) -> float:
    """The ordinate of a branch or of its image, whichever is higher."""
    return abs(y) if ordinate in ODD else y


SECONDARY = ("#e08214", "#12a4b8", "#c51b8a", "#7f9a1a")


def _color(branch: Branch, number: int) -> str:
    if branch.mode is not None:
        return MODES[(branch.mode.number - 1) % len(MODES)]
    return SECONDARY[number % len(SECONDARY)]


def _face(kind: str) -> str:
    return WARN if kind == "lift_off" else "white"
