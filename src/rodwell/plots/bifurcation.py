"""Bifurcation diagram: end curvature against end compression, stable and unstable parts, special points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rodwell.analysis.branch.branch import Branch
from rodwell.analysis.branch.special import END
from rodwell.analysis.branch.symmetry import ODD, Reflection
from rodwell.analysis.discrete.measures import Measured
from rodwell.analysis.straight.critical import CriticalLoads
from rodwell.plots.ordinates import ORDINATES, lies, telling
from rodwell.plots.paths.off_wall import all_forces, draw_off_wall, named_at
from rodwell.plots.smooth import BETWEEN, smooth
from rodwell.plots.style import (
    GREY,
    INK,
    LIFTS_OFF,
    OFF_WALL,
    RC,
    SECONDARY,
    SIZE,
    SOLID,
    UNSTABLE,
    WIDE,
    in_lines,
    marked,
    new_axes,
    parameters,
)
from rodwell.plots.units import axis
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.forces import Forces
from rodwell.quantities.scales import Scales

MARKERS = {
    "critical": ("D", "critical load"),
    "lift_off": ("o", "lift-off"),
    "branch_point": ("^", "secondary bifurcation"),
    "fold": ("s", "fold"),
    "touch_down": ("o", "contact complete again"),
    "equal_energy": ("P", "energy of the straight rod"),
}


def plot_bifurcation(
    branches: Sequence[Branch],
    critical: CriticalLoads,
    scales: Scales | None = None,
    ax: Any = None,
    ordinate: Measured | None = None,
) -> Any:
    """Draw ω₂(1), or another number, against the end compression −F at s = 1 for a set of branches; return the axes.

    Without ``ordinate`` it is the one that :func:`telling` names. With ``scales`` the compression is that at the end at
    which the case gives its loads. Without ``ax`` a panel beside the whole enlarges the way of mode 1 from buckling to
    lift-off.

    States off the wall with which branches go on (``off_wall``) are dotted, if they have that number.

    Stable parts (under dead loads, for a rod kept on the wall) are thick, unstable ones thin and dashed. Images of the
    branches by the reflections that the problem has are drawn too. Where the contact pressure is positive somewhere
    lines are pale, since there the wall would have to pull.
    """
    ordinate = telling(branches, scales) if ordinate is None else ordinate
    window = None if ax is not None else _window_of(branches)
    beside = None
    if ax is None:
        ax, beside = _axes(window is not None)
    look = _Look(branches, critical, scales, ordinate)
    _panel(ax, look, named=True)
    _legend(ax, look)
    shown = parameters(branches[0].problem, scales)
    ax.set_title(shown if beside is None else in_lines(shown, LONGEST_LINE), loc="left", fontsize=8.5)
    if beside is not None and window is not None:
        _enlarged(ax, beside, look, window)
    return ax


PALE = 0.35

LONGEST_LINE = 80
"""Characters that stand above the whole diagram without reaching over the panel beside it."""


class _Look:
    """What a panel shows: branches and their ordinate, the factors and labels of its axes."""

    def __init__(
        self, branches: Sequence[Branch], critical: CriticalLoads, scales: Scales | None, ordinate: Measured
    ) -> None:
        self.branches, self.critical, self.ordinate = branches, critical, ordinate
        self.forces = Forces(scales, branches[0].problem.hung_weight)
        self.top = max(float(np.max(np.abs(b.numbers(ordinate)))) for b in branches)
        farthest = max(float(np.max(np.abs(all_forces(b)))) for b in branches)
        name, label = ORDINATES[ordinate]
        self.fx, ux = axis("force", scales, farthest)
        self.fy, uy = axis(name, scales, self.top)
        self.across, self.up = f"{self.forces.axis}  [{ux}]", f"{label}  [{uy}]"
        self.kinds: set[str] = set()

    def x(self, force: FloatArray | float) -> Any:
        """Where an end force F lies across."""
        return self.forces.drawn(force) * self.fx


def _axes(two: bool) -> tuple[Any, Any]:
    """Axes of a new figure: the whole diagram and, beside it, those of its enlarged part."""
    if not two:
        return new_axes(), None
    with mpl.rc_context(RC):
        figure = Figure(figsize=(WIDE, SIZE[1]), layout="constrained")
        FigureCanvasAgg(figure)
        whole, part = figure.subplots(1, 2, width_ratios=(1.65, 1.0))
    return whole, part


def _panel(ax: Any, look: _Look, *, named: bool) -> None:
    """Draw all branches with their images and special points; ``named``: with their names, and labels of the axes."""
    if look.critical:
        _straight(ax, look)
    for number, branch in enumerate(look.branches):
        style = _style(branch, number)
        for image in branch.images:
            line = _Line(branch, image, look.ordinate)
            _draw(ax, line, style, look)
            look.kinds |= _special(ax, line, style["color"], look)
            _go_on(ax, branch, image, style, look)
    if named:
        _labels(ax, look)
        ax.set_ylabel(look.up)
    ax.set_xlabel(look.across)


def _legend(ax: Any, look: _Look) -> None:
    for kind, (marker, text) in MARKERS.items():
        if kind in look.kinds:
            label = text.replace("secondary ", "") if any(lies(branch) for branch in look.branches) else text
            ax.plot([], [], marker, color=_face(kind), mec=INK, ms=6, label=label)
    ax.plot([], [], color=INK, lw=2.2, label="stable")
    ax.plot([], [], color=INK, lw=1.0, ls=UNSTABLE, label="unstable")
    if any(branch.beyond is not None for branch in look.branches):
        ax.plot([], [], color=INK, lw=2.4, ls=OFF_WALL, label="off the wall (thin: unstable)")
        ax.plot([], [], ".", color=INK, ms=5, label="contact changes")
    else:
        ax.plot([], [], color=INK, lw=1.4, alpha=PALE, label="off the wall somewhere")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3)


def _window_of(branches: Sequence[Branch]) -> tuple[float, float] | None:
    """End forces at which mode 1 buckles and lifts off; None where these coincide, or one is not there."""
    first = branches[0]
    if first.mode is None or first.lift_off is None or first.lift_off_at_buckling:
        return None
    return float(first.mode.force), float(first.lift_off.force)


def _enlarged(ax: Any, part: Any, look: _Look, window: tuple[float, float]) -> None:
    """The way of mode 1 from buckling to lift-off in a panel of its own, and where it lies in the whole."""
    _panel(part, look, named=False)
    start, end = sorted(float(look.x(force)) for force in window)
    margin = 0.18 * (end - start)
    low, high = start - margin, end + margin
    first = look.branches[0]
    inside = (look.x(first.force) >= low) & (look.x(first.force) <= high)
    y = [image.numbers({m: first.numbers(m) for m in Measured})[look.ordinate][inside] for image in first.images]
    span = np.concatenate(y) * look.fy
    edge = 0.12 * max(float(np.ptp(span)), 1e-300)
    box = (low, float(span.min()) - edge, high - low, float(np.ptp(span)) + 2.0 * edge)
    part.set_xlim(low, high)
    part.set_ylim(box[1], box[1] + box[3])
    part.locator_params(axis="x", nbins=5)
    part.set_title("from buckling to lift-off, enlarged", loc="left", fontsize=8.5)
    ax.add_patch(Rectangle(box[:2], *box[2:], fill=False, ec=GREY, lw=0.9))


def _straight(ax: Any, look: _Look) -> None:
    first = look.critical[0].force
    end = min(float(np.min(all_forces(b))) for b in look.branches)
    start = first + 0.25 * (first - end)
    ax.plot([look.x(start), look.x(first)], [0, 0], color=INK, lw=2.2)
    ax.plot([look.x(first), look.x(end)], [0, 0], color=GREY, lw=1.0, ls=UNSTABLE)


class _Line:
    """A branch, or an image of it, as it is drawn: points and special points in order of travel.

    ``force`` is F, ``y`` the ordinate; ``stable`` and ``off`` tell of the way that leads to each point, (n,) each.
    """

    def __init__(self, branch: Branch, image: Reflection, ordinate: Measured) -> None:
        numbers = image.numbers({m: branch.numbers(m) for m in Measured})
        rows = [
            [(f, y, index == 0, p > 0.0)]
            for f, y, index, p in zip(
                branch.force, numbers[ordinate], branch.stability_index, numbers[Measured.P_MAX], strict=True
            )
        ]
        self.special: list[tuple[str, float, float]] = []
        for point in branch.special_points:
            values = {m: np.array([point.solution.number(m).value]) for m in Measured}
            y = float(image.numbers(values)[ordinate][0])
            self.special.append((point.kind, point.force, y))
            if point.kind not in ("critical", "end"):
                off = bool(values[Measured.P_MAX][0] > 0.0)
                off = {"lift_off": False, "touch_down": True}.get(point.kind, off)
                rows[point.after].append((point.force, y, point.index_before == 0, off))
        table = np.array([row for group in rows for row in group], dtype=float)
        self.force, self.y = table[:, 0], table[:, 1]
        self.stable, self.off = table[:, 2] > 0.0, table[:, 3] > 0.0


def _draw(ax: Any, line: _Line, look_of_line: dict[str, Any], look: _Look) -> None:
    """Draw a line in pieces of one style: stable or not, on the wall or off it."""
    style = line.stable[1:].astype(int) + 2 * line.off[1:].astype(int)
    starts = np.flatnonzero(np.diff(style, prepend=-1))
    force, y = smooth(line.force, line.y)
    for start, stop in zip(starts, [*starts[1:], len(style)], strict=True):
        part = slice(BETWEEN * start, BETWEEN * stop + 1)
        solid, off = line.stable[start + 1], line.off[start + 1]
        ax.plot(
            look.x(force[part]), y[part] * look.fy, lw=2.2 if solid else 1.0, alpha=PALE if off else 1.0,
            ls=SOLID if solid else UNSTABLE, solid_capstyle="butt", **look_of_line,
        )  # fmt: skip


def _special(ax: Any, line: _Line, color: str, look: _Look) -> set[str]:
    for kind, force, y in line.special:
        if kind in MARKERS:
            ax.plot(look.x(force), y * look.fy, MARKERS[kind][0], color=_face(kind), mec=color, ms=6, zorder=5)
    return {kind for kind, _, _ in line.special}


def _go_on(ax: Any, branch: Branch, image: Reflection, style: dict[str, Any], look: _Look) -> None:
    """Draw what follows off the wall, with what happens there: changes of contact as small dots."""
    if branch.beyond is None:
        return
    color = {"color": style["color"]}
    for kind, force, y in draw_off_wall(ax, branch.beyond, image, look.ordinate, (look.x, look.fy), **color):
        marker, face, size = (MARKERS[kind][0], _face(kind), 6) if kind in MARKERS else (".", style["color"], 5)
        if kind != END:
            ax.plot(look.x(force), y * look.fy, marker, color=face, mec=style["color"], ms=size, zorder=5)
        look.kinds.add(kind)


MOST_NAMES = 10
"""Branches that are named: those first that leave the straight rod."""


def _labels(ax: Any, look: _Look) -> None:
    """Name the branches at their ends, pushed apart where they would overlap, each with a line to its end."""
    named = [(i, b) for i, b in enumerate(look.branches) if "mirror" not in b.name and not _pulled(b)]
    named = sorted(named, key=lambda item: item[1].origin.parent is not None)[:MOST_NAMES]
    places = [(*named_at(b, look.ordinate), i, b) for i, b in named]
    ends = sorted(
        ((_upper(y * look.fy, look.ordinate), float(look.x(force)), i, b) for force, y, i, b in places),
        key=lambda item: -item[0],
    )
    low, high = ax.get_ylim()
    right, last = max(x for _, x, _, _ in ends), np.inf
    for y, x, number, branch in ends:
        place, color = min(y, last - 0.055 * (high - low)), _style(branch, number)["color"]
        ax.annotate(
            branch.name, (x, y), xytext=(right, place), textcoords="data", color=INK, fontsize=8.5,
            va="center", annotation_clip=False, bbox={"fc": "none", "ec": "none", "pad": 1.0},
            arrowprops={
                "arrowstyle": "-", "color": color, "lw": 0.9, "shrinkA": 1.0, "shrinkB": 1.0, "relpos": (0.0, 0.5),
            },
        ).set_x(right + 0.03 * (right - ax.get_xlim()[0]))  # fmt: skip
        last = place


def _pulled(branch: Branch) -> bool:
    """Whether a branch goes on from the beginning of another one towards tension: it has no name of its own."""
    return branch.mode is None and not branch.origin.switched and bool(branch.force[-1] > branch.force[0])


def _upper(y: float, ordinate: Measured) -> float:
    """The ordinate of a branch or of its image, whichever is higher."""
    return abs(y) if ordinate in ODD else y


def _style(branch: Branch, number: int) -> dict[str, Any]:
    """Colour, and mark where colours repeat: of a mode, or of what branches off."""
    if branch.mode is not None:
        return marked(branch.mode.number - 1)
    if lies(branch):
        return marked(0)
    return {"color": SECONDARY, "marker": ("x", "+", "1", "2")[number % 4], "markevery": 0.13, "ms": 5.0}


def _face(kind: str) -> str:
    return LIFTS_OFF if kind == "lift_off" else "white"
