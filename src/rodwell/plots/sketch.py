"""A sketch of a case: the string in its hole with inclination, ends and loads, and the cross-section to scale."""

from __future__ import annotations

import math
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon

from rodwell.answers.words.wording import bend_text
from rodwell.case.case import Case
from rodwell.case.string.sections import PhysicalString
from rodwell.plots.style import ACTS, BORE, BUCKLES, GREY, INK, RC, ROD
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.text import plain

LONG, WIDE = 10.0, 1.5
"""Length and width of the hole as it is drawn, where both cannot be to scale."""

LETTER = (0.22, 0.4)
"""Width and height that a letter of a section's name takes up."""

UNKNOWN_RADIUS = 0.3
"""Radius of the rod against the clearance where none is known."""


def plot_sketch(case: Case) -> Figure:
    """Draw what is given: the hole at its inclination, the rod on its side of it, ends, loads; beside it the section.

    The cross-section is to scale. Length and width are to scale with each other where the rod is short enough; else
    the picture says how many widths of the hole it is long. Returns the figure.
    """
    with mpl.rc_context(RC):
        figure = Figure(figsize=(7.2, 3.5))
        FigureCanvasAgg(figure)
        side, across = figure.add_axes((0.01, 0.02, 0.64, 0.96)), figure.add_axes((0.68, 0.12, 0.31, 0.84))
        for ax in (side, across):
            ax.set_aspect("equal")
            ax.set_axis_off()
        _side(side, case)
        _across(across, case)
        return figure


def _radii(case: Case) -> tuple[float, float]:
    """Radius of the hole and of the rod in units of the clearance."""
    scales, clearance = case.scales, case.problem.clearance
    known = scales is not None and scales.radius is not None
    rod = (
        scales.radius / scales.length / clearance if known and scales is not None and scales.radius else UNKNOWN_RADIUS
    )
    return 1.0 + rod, rod


class _View:
    """Where a place along the hole and across it stands in the picture: across is positive on the high side."""

    def __init__(self, case: Case) -> None:
        angle = np.radians(case.problem.alpha)
        level = case.problem.alpha == 90.0  # s = 0 stands at the left, as in figures along the rod
        self.along = np.array([1.0, 0.0]) if level else np.array([-np.sin(angle), np.cos(angle)])
        self.high = np.array([np.cos(angle), np.sin(angle)])
        hole, rod = _radii(case)
        true_width = LONG * 2.0 * hole * case.problem.clearance
        self.true = true_width >= 0.4
        self.hole = 0.5 * (true_width if self.true else WIDE)
        self.rod = self.hole * rod / hole
        self.side = 1.0 if case.problem.floats else -1.0
        self.middle = self.side * (self.hole - self.rod)
        self.axis = case.problem.given_hole

    def __call__(self, along: float, across: float) -> FloatArray:
        at, high = self._place(along)
        return np.asarray(at + across * high)

    def high_at(self, along: float) -> FloatArray:
        """Direction of the high side at a place along the hole."""
        return self._place(along)[1]

    def line(self, start: float, stop: float, across: float) -> FloatArray:
        """Points (n, 2) of a line along the hole."""
        places = np.linspace(start, stop, 2 if self.axis is None else 61)
        return np.array([self(float(place), across) for place in places])

    def _place(self, along: float) -> tuple[FloatArray, FloatArray]:
        """A point of the axis and the high side there; a bent hole is seen across the vertical plane in its middle."""
        if self.axis is None:
            return along * self.along, self.high
        middle, place = np.array([0.5]), np.array([along / LONG])
        turn, plane = self.axis.frame(middle)[0][[2, 0]], np.stack([self.along, self.high])
        at = LONG * (turn @ (self.axis.points(place) - self.axis.points(middle))[0]) + np.array([0.5 * LONG, 0.0])
        return at @ plane, (turn @ self.axis.frame(place)[0, 0]) @ plane


def _side(ax: Any, case: Case) -> None:
    view = _View(case)
    beyond = 0.6
    edges = [view.line(-beyond, LONG + beyond, edge) for edge in (-view.hole, view.hole)]
    ax.add_patch(Polygon(np.concatenate([edges[0], edges[1][::-1]]), closed=True, fc=BUCKLES, alpha=0.09, ec="none"))
    for edge in edges:
        ax.plot(*edge.T, color=GREY, lw=1.6)
    low = -view.hole
    body = [view.line(0.0, LONG, view.middle + edge) for edge in (-view.rod, view.rod)]
    rod = np.concatenate([body[0], body[1][::-1]])
    ax.add_patch(Polygon(rod, closed=True, fc=ROD, ec=INK, lw=1.0))
    if case.string is not None:
        _sections(ax, view, case.string)
    for end, place in enumerate((0.0, LONG)):
        _end(ax, view, place, case.problem.ends[end])
        names, alpha = ("bottom, ", "top, "), case.problem.alpha
        where = "" if alpha == 90.0 else names[end if alpha < 90.0 else 1 - end]
        _say(ax, view, place, f"{where}s = {end}\n{case.problem.ends[end]}", low - 0.25, "low")
    _length(ax, view, case)
    if view.axis is None:
        _inclination(ax, view, case)
    _loads(ax, view, case)
    _weight(ax, view, case)
    reach = [view(place, across) for place in (-2.3, LONG + 2.3) for across in (-view.hole - 1.1, view.hole + 0.6)]
    reach += [view(0.5 * LONG, across) for across in (-view.hole - 1.1, view.hole + 1.6)]
    reach += [*_weight_arrow(view, case)] if case.problem.weight > 0.0 else []  # arrows from outside are not drawn
    if case.problem.alpha > 90.0:
        reach.append(view(LONG + 4.0, view.hole))  # words on the load stand to the left of the lower end
    for low_edge, high_edge, limit in ((*_range(reach, 0), ax.set_xlim), (*_range(reach, 1), ax.set_ylim)):
        limit(low_edge - 0.6, high_edge + 0.6)


def _sections(ax: Any, view: _View, string: PhysicalString) -> None:
    """Sections of a string: lengths and, against the outer diameter, bores to scale; names where there is room."""
    for member, (start, end) in zip(string.members, string.ends, strict=True):
        first, last = start * LONG, end * LONG
        outer = [member.rods[i].outer_diameter or math.inf for i in (0, -1)]
        for within in member.within:
            for across in view.rod * np.outer((-1.0, 1.0), within / outer) if np.any(within) else ():
                edge = [view(first, view.middle + across[0]), view(last, view.middle + across[1])]
                ax.plot(*np.array(edge).T, color=INK, lw=0.7, ls=(0, (4, 2)))
        if start > 0.0:
            joint = np.array([view(first, view.middle - view.rod), view(first, view.middle + view.rod)])
            ax.plot(*joint.T, color=INK, lw=1.0)
        if 2.0 * view.rod >= LETTER[1] and last - first >= LETTER[0] * len(member.name):
            place = 0.5 * (first + last)
            across, up = view(place + 0.01, view.middle) - view(place - 0.01, view.middle)
            turned = (math.degrees(math.atan2(up, across)) + 89.0) % 180.0 - 89.0  # to be read from below or the right
            ax.text(*view(place, view.middle), member.name, rotation=turned, rotation_mode="anchor", ha="center",
                    va="center", fontsize=7.5, bbox={"fc": ROD, "ec": "none", "pad": 0.6})  # fmt: skip


def _range(points: list[FloatArray], axis: int) -> tuple[float, float]:
    values = [float(point[axis]) for point in points]
    return min(values), max(values)


def _weight(ax: Any, view: _View, case: Case) -> None:
    """The weight per length, with an arrow that points down; what lifts a rod that floats, with one that points up."""
    if case.problem.weight == 0.0:
        return
    buoyed = " (buoyed)" if case.fluids.inside or case.fluids.outside else ""
    text = f"γ = {plain(case.problem.weight)}"
    if case.scales is not None:
        text = f"{case.scales.text(case.problem.weight, 'force_per_length')}{buoyed}"
    tail, head = _weight_arrow(view, case)
    ax.annotate("", head, tail, arrowprops={"arrowstyle": "-|>", "color": GREY, "lw": 1.4})
    name = "lift" if case.problem.floats else "weight"
    text = f"{name if case.string is None else f'mean {name}'}\n{text}"
    ax.text(tail[0] - 0.25, 0.5 * (tail[1] + head[1]), text, ha="right", va="center", fontsize=8.5)


def _weight_arrow(view: _View, case: Case) -> tuple[FloatArray, FloatArray]:
    """Ends of the arrow of the weight, or of the lift where the rod floats: below the hole."""
    upper = view(0.55 * LONG, -view.hole - (1.15 if case.problem.alpha == 90.0 else 0.9))
    lower = upper - np.array([0.0, 0.9])
    return (lower, upper) if case.problem.floats else (upper, lower)


def _end(ax: Any, view: _View, place: float, held: str) -> None:
    """The sign of an end condition: a plate that holds both, a dot that lets turn, a plate on rollers that slides."""
    out = 0.22 if place > 0.0 else -0.22
    if held in ("clamped", "guided"):
        plate = [
            view(place, -view.hole),
            view(place, view.hole),
            view(place + out, view.hole),
            view(place + out, -view.hole),
        ]
        ax.add_patch(Polygon(plate, closed=True, fc="none", ec=INK, lw=1.2, hatch="////" if held == "clamped" else ""))
    if held == "pinned":
        ax.plot(*view(place, view.middle), "o", ms=7, mfc="white", mec=INK, mew=1.4, zorder=5)


def _say(ax: Any, view: _View, along: float, text: str, across: float, side: str) -> None:
    """Words beside the hole, on its low or high side, so that they do not lie on it."""
    direction = (1.0 if side == "high" else -1.0) * view.high_at(along)
    aslant = 0.3 if view.axis is None else 0.55
    ha = "left" if direction[0] > aslant else "right" if direction[0] < -aslant else "center"
    va = "bottom" if direction[1] > 0.7 else "top" if direction[1] < -0.7 else "center"
    ax.text(*view(along, across), text, ha=ha, va=va, fontsize=8.5, linespacing=1.25)


def _length(ax: Any, view: _View, case: Case) -> None:
    at = view.hole + 0.45
    if view.axis is not None:
        ax.plot(*view.line(0.0, LONG, at).T, color=INK, lw=0.9)
    for start, stop in ((0.5 * LONG, 0.0), (0.5 * LONG, LONG)):
        tail = start if view.axis is None else 0.95 * stop + 0.05 * start
        ax.annotate("", view(stop, at), view(tail, at), arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 0.9})
    text = "L" if case.scales is None else f"L = {case.scales.text(1.0, 'length')}"
    if view.axis is None:
        alpha = case.problem.alpha
        climbing = f", α = {plain(alpha)}°" if alpha > 90.0 else ""
        text += {0.0: ", vertical", 90.0: ", horizontal"}.get(alpha, climbing)
    else:
        text += f", α = {plain(case.problem.alpha, 4)}° at mid-length\n{bend_text(case)}"
    if not view.true:
        ratio = 1.0 / (2.0 * _radii(case)[0] * case.problem.clearance)
        text += f"\n({plain(ratio, 2)} widths of the hole:\nnot to scale)"
    _say(ax, view, 0.5 * LONG, text, at + (0.4 if view.axis is None else 0.8), "high")


def _inclination(ax: Any, view: _View, case: Case) -> None:
    """The angle from the vertical, at the upper end, and where gravity points."""
    alpha, top = case.problem.alpha, view(LONG, 0.0)
    if 0.0 < alpha < 90.0:
        reach = 3.2
        ax.plot([top[0], top[0]], [top[1], top[1] - reach], color=GREY, lw=0.9, ls=(0, (4, 3)))
        ax.plot(*zip(top, top - reach * view.along, strict=True), color=GREY, lw=0.9, ls=(0, (4, 3)))
        ax.add_patch(
            Arc(
                (float(top[0]), float(top[1])),
                2.0 * reach,
                2.0 * reach,
                theta1=-90.0,
                theta2=-90.0 + alpha,
                color=INK,
                lw=1.0,
            )
        )
        half = np.radians(-90.0 + 0.5 * alpha)
        at = top + (reach + 0.25) * np.array([np.cos(half), np.sin(half)])
        inside = reach * np.sin(0.5 * np.radians(alpha)) > 1.5 * view.hole
        if not inside:
            at = np.array([top[0] - 0.2, top[1] - reach])
        ax.text(*at, f"α = {plain(alpha)}°", fontsize=8.5, ha="left" if inside else "right", va="top")


def _loads(ax: Any, view: _View, case: Case) -> None:
    """The loads that act, as arrows on the end at which they were given; none given: where the force would act."""
    bottom = bool(case.applied and case.applied[0].bottom)
    most = min(case.applied, key=lambda load: load.force, default=None)
    end = 0.0 if bottom else LONG
    out = -1.0 if bottom else 1.0
    push = most is None or most.given < 0.0
    tail, head = end + out * 2.1, end + out * 0.35
    if not push:
        tail, head = head, tail
    ax.annotate("", view(head, view.middle), view(tail, view.middle),
                arrowprops={"arrowstyle": "-|>,head_width=.35,head_length=.7", "color": ACTS, "lw": 2.6})  # fmt: skip
    if most is None:
        text = "end force F"
    elif case.scales is None:
        text = f"{plain(abs(most.given), 6)} B/L²\n{'compression' if push else 'tension'}"
    else:
        text = f"{case.scales.system.text(abs(most.given), 'force', 6)}\n{'compression' if push else 'tension'}"
    if len(case.applied) > 1:
        text += f"\n(the most of {len(case.applied)})"
    _say(ax, view, end + out * 1.6, text, view.hole + 0.1, "high")


def _across(ax: Any, case: Case) -> None:
    """The cross-section at its true proportions: hole, rod with its bore on its side, clearance of the axes."""
    (hole, rod), side = _radii(case), 1.0 if case.problem.floats else -1.0
    ax.add_patch(Circle((0.0, 0.0), hole, fc=BUCKLES, alpha=0.09, ec="none"))
    ax.add_patch(Circle((0.0, 0.0), hole, fc="none", ec=GREY, lw=1.6))
    ax.add_patch(Circle((0.0, side), rod, fc=ROD, ec=INK, lw=1.0))
    scales = case.scales
    if case.rod is not None and case.rod.inner_diameter and case.rod.outer_diameter:
        bore = rod * case.rod.inner_diameter / case.rod.outer_diameter
        ax.add_patch(Circle((0.0, side), bore, fc=BORE, ec=INK, lw=0.8))
    for y in (0.0, side):
        ax.plot([-0.12 * hole, 0.12 * hole], [y, y], color=INK, lw=0.8)
    ax.annotate("", (0.0, side), (0.0, 0.0), arrowprops={"arrowstyle": "<|-|>", "color": ACTS, "lw": 1.4})
    clearance = "Δ" if scales is None else f"Δ = {scales.text(case.problem.clearance, 'length')}"
    ax.text(0.08 * hole, 0.5 * side, clearance, fontsize=8.5, va="center",
            bbox={"fc": "#ffffff", "ec": "none", "alpha": 0.75, "pad": 0.8})  # fmt: skip
    known = scales is not None and scales.radius is not None
    name = f"Δ/L = {plain(case.problem.clearance)}"
    if known and scales is not None and scales.radius is not None:
        inch = 2.0 * scales.radius
        wide = 2.0 * hole * case.problem.clearance * scales.length
        rod_name = "rod" if case.string is None else case.string.longest.name
        name = f"hole {scales.system.text(wide, 'length')}, {rod_name} {scales.system.text(inch, 'length')}"
    ax.set_title(
        f"{name}\n{'cross-section, to scale' if known else 'cross-section; radii not given'}", fontsize=8.5, y=-0.13
    )
    ax.set_xlim(-1.08 * hole, 1.08 * hole)
    ax.set_ylim(-1.08 * hole, 1.08 * hole)
