"""Fig. 5, 6, 11, 12 and 13: loads and twist against weight."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from rodwell.analysis.curves.curve import Curve
from rodwell.plots.paper.bifurcations import bifurcation
from rodwell.plots.paper.frame import (
    ALONG,
    COMPRESSION,
    PLACES,
    WEIGHT,
    circumferential,
    context,
    letter,
    new_figure,
    style,
)
from rodwell.plots.paper.space import shape_in_space
from rodwell.plots.style import GREY, INK, MODES, WARN
from rodwell.studies.paper.diagrams import Panel
from rodwell.studies.paper.stability import Fig5, Fit, Stability, StabilityRow
from rodwell.studies.paper.work import CLEARANCE

SECOND_SWITCH = 64.0 * np.pi**4 * CLEARANCE
"""Weight at which the first two modes switch for the second time, (78)."""

DOTS = {"color": GREY, "lw": 1.0, "ls": (0, (1, 1.6))}
DASHES: Any = {"color": WARN, "lw": 1.4, "ls": (0, (5, 2))}
FIRST: Any = {"color": INK, "lw": 2.0}


def draw_fig5(data: Fig5) -> Figure:
    """Draw Fig. 5: the stability diagram, and below it y, p and the shape at lift-off for four weights."""
    with context():
        figure = new_figure(7.4, 11.0)
        halves: Any = figure.subfigures(2, 1, height_ratios=(1.0, 1.5))
        upper, lower = halves
        lower.set_facecolor("none")
        ax = upper.subplots()
        stability(ax, data.diagram)
        for curve in data.diagram.critical:
            ax.plot(0.0, -curve.values[0], "^", ms=6, color=INK, clip_on=False, zorder=6)
        for row in data.rows:
            ax.plot(row.weight, -row.lift.force, "D", ms=6, color=WARN, mec=INK, zorder=6)
        ax.set_ylim(0.0, 540.0)
        _words(ax, data.diagram)
        left, right = lower.subfigures(1, 2, width_ratios=(1.9, 1.0))
        axes = left.subplots(len(data.rows), 2, sharex=True)
        for part, line, row in zip(right.subfigures(len(data.rows), 1), axes, data.rows, strict=True):
            _row(line, row)
            part.set_facecolor("none")
            shape_in_space(part, row.lift.solution, f"lift-off, $-F$ = {-row.lift.force:.5g}")
        for ax in axes[-1]:
            ax.set_xlabel(ALONG)
        for part in (left, right):
            part.set_facecolor("none")
        return figure


def _words(ax: Any, diagram: Stability) -> None:
    """Labels on the curves themselves, as in the paper."""
    x = diagram.weights
    where = int(np.argmin(np.abs(x - 250.0)))
    ax.annotate(
        "$F_{c,1}$", (x[where], -diagram.first[where]), xytext=(8, -16), textcoords="offset points", fontsize=11
    )
    piece_x, piece = diagram.lift_off[-1]
    load = float(np.interp(235.0, piece_x, -piece))
    ax.annotate("$F_{lift}$", (235.0, load), xytext=(-30, 10), textcoords="offset points", fontsize=11, color=WARN)


def _row(axes: Any, row: StabilityRow) -> None:
    """Draw y and p of one weight under growing compression, the state at lift-off thick."""
    ax_y, ax_p = axes
    s = np.linspace(0.0, 1.0, PLACES)
    greys = np.linspace(0.72, 0.3, len(row.states))
    for number, state in enumerate(row.states):
        at_lift = number == row.at_lift
        look: dict[str, Any] = (
            {"color": WARN, "lw": 2.0, "zorder": 5} if at_lift else {"color": str(greys[number]), "lw": 1.0}
        )
        ax_y.plot(s, circumferential(state, s), **look)
        ax_p.plot(s, state.fields(s)["contact_pressure"], label=f"{-state.force:.4g}", **look)
    for ax, name in ((ax_y, "$y$  [$L$]"), (ax_p, "$p$  [$B/L^3$]")):
        ax.axhline(0.0, color=INK, lw=0.6)
        ax.set_xlim(0.0, 1.0)
        ax.set_ylabel(name)
    letter(ax_y, f"$mg$ = {row.weight:g}")
    ax_p.legend(title="$-F$  [$B/L^2$]", title_fontsize=7, fontsize=6.5, loc="center left", bbox_to_anchor=(1.0, 0.5))


def stability(ax: Any, panel: Stability) -> None:
    """Draw critical curves dotted, the first one solid on top, lift-off dashed."""
    x = panel.weights
    for number in range(len(panel.critical)):
        ax.plot(x, -panel.load(number), **DOTS)
    ax.plot(x, -panel.first, **FIRST)
    for weights, loads in panel.lift_off:
        ax.plot(weights, -loads, **DASHES)
    ax.set_xlim(0.0, panel.until)
    ax.axhline(0.0, color=INK, lw=0.6, zorder=0)
    ax.set_xlabel(WEIGHT)
    ax.set_ylabel(COMPRESSION)


def draw_fig6(panels: Sequence[Stability]) -> Figure:
    """Draw Fig. 6(a) to (f)."""
    with context():
        figure = new_figure(7.4, 8.0)
        for ax, panel in zip(figure.subplots(3, 2).ravel(), panels, strict=True):
            stability(ax, panel)
            top = max(float(np.max(-panel.load(1))), max((float(np.max(-f)) for _, f in panel.lift_off), default=0.0))
            ax.set_ylim(min(0.0, 1.15 * float(np.min(-panel.first))), 1.06 * top)
            alpha = {90.0: "π/2", 60.0: "π/3", 30.0: "π/6", 10.0: "π/18", 5.0: "π/36", 2.0: "π/90", 0.0: "0"}
            letter(ax, f"{panel.label}  α = {alpha[panel.problem.alpha]}")
            if not panel.lift_off:
                ax.text(0.04, 0.06, "lift-off coincides with buckling", transform=ax.transAxes, fontsize=7.5)
        _key(figure)
        return figure


def _key(figure: Figure) -> None:
    from matplotlib.lines import Line2D  # noqa: PLC0415

    looks = ((FIRST, "buckling, first critical load"), (DASHES, "lift-off"), (DOTS, "further critical loads"))
    figure.legend(
        handles=[Line2D([], [], **look, label=text) for look, text in looks], loc="outside lower center", ncols=3
    )


def draw_fig11(curves: Sequence[Curve]) -> Figure:
    """Draw Fig. 11: twist at which the rod, prepared at lift-off, lifts off again."""
    first, beyond = curves
    with context():
        figure = new_figure(5.0, 3.6)
        ax = figure.subplots()
        ax.plot(first.x, first.values, **FIRST)
        ax.plot(beyond.x, beyond.values, color=INK, lw=1.2, ls=(0, (5, 2)))
        ax.axvspan(SECOND_SWITCH, 130.0, color="#eef1f4", zorder=0, lw=0)
        ax.text(64.5, 33.0, "the other mode\nbuckles first", fontsize=8, color=GREY, va="top")
        ax.text(30.0, 10.0, "pressed to the wall", ha="center", fontsize=8)
        ax.text(42.0, 24.0, "lifted off again", ha="center", fontsize=8)
        for mark in first.marks:
            ax.plot(mark.x, mark.value, "o", ms=5, color="white", mec=INK, zorder=5)
        ax.set_xlim(0.0, 90.0)
        ax.set_ylim(0.0, 38.0)
        ax.set_xlabel(WEIGHT)
        letter(ax, r"first mode at $F = F_{lift}$, arm $\omega_2(1) > 0$")
        ax.set_ylabel("end twist $T_1$ at lift-off  [$B/L$]")
        return figure


def draw_fig12(data: tuple[Panel, Stability]) -> Figure:
    """Draw Fig. 12: bifurcation diagram and critical loads of the rod on top."""
    panel, loads = data
    with context():
        figure = new_figure(7.4, 3.6)
        left, right = figure.subplots(1, 2)
        bifurcation(left, panel)
        x = loads.weights
        for number in range(len(loads.critical)):
            right.plot(x, -loads.load(number), lw=1.4, **style(number + 1), label=f"mode {number + 1}")
        right.axhline(0.0, color=INK, lw=0.6)
        right.set_xlim(0.0, loads.until)
        right.set_ylim(-480.0, 260.0)
        right.set_xlabel(WEIGHT)
        right.set_ylabel(COMPRESSION)
        right.legend(loc="lower right")
        letter(right, loads.label)
        return figure


def draw_fig13(fits: Sequence[Fit]) -> Figure:
    """Draw Fig. 13: first critical load, and Dellinger's fit (89) dashed."""
    with context():
        figure = new_figure(7.4, 3.2)
        for ax, item in zip(figure.subplots(1, 2, sharey=True), fits, strict=True):
            ax.plot(item.weights, -item.exact, color=MODES[0], lw=1.8, label="exact")
            ax.plot(item.weights, item.fit, color=MODES[1], lw=1.5, ls=(0, (5, 2)), label="(89), Dellinger et al.")
            ax.set_xlim(0.0, float(item.weights[-1]))
            ax.set_ylim(0.0, None)
            ax.set_xlabel(WEIGHT)
            letter(ax, f"{item.label}  α = {'π/2' if item.alpha == 90.0 else 'π/3'}")
            ax.legend(loc="lower right")
            ax.yaxis.set_tick_params(labelleft=True)
            ax.set_ylabel("first critical load $-F_{c,1}$  [$B/L^2$]")
        return figure
