"""Hook load, push left and depth of lock-up over what varies in a study of torque and drag."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rodwell.plots.study import FAILS_MARK, axes_of, label_across, position
from rodwell.plots.style import GREY, INK, MODES, RC, WARN
from rodwell.plots.wells.drag import DASHES
from rodwell.quantities.value import Value
from rodwell.studies.drag.sweep.points import OperationAt
from rodwell.studies.drag.sweep.study import DragStudy
from rodwell.studies.drag.words import FAILS, units

Number = Callable[[OperationAt], Value | None]


def plot_drag_study(study: DragStudy) -> Figure:
    """Draw hook load, push left and lock-up depth of every operation over an input.

    With two varied inputs the one with more values goes across, the other has a dash for each value. An operation that
    fails has a cross; where it locks up it has no hook load, and its cross stands at the foot. Returns the figure.
    """
    by = units(study.well)
    (m, depth), (n, force) = by["depth"], by["force"]
    panels: list[tuple[str, Number, float]] = [(f"hook load, tension positive  [{force}]", lambda o: o.hook_load, n)]
    if study.pushed and _any(study, lambda o: o.margin):
        panels.append((f"push left at\nsurface  [{force}]", lambda o: o.margin, n))
    if _any(study, lambda o: o.lock_up):
        panels.append((f"locks up with the\nbit at  [{depth}]", lambda o: o.lock_up, m))
    across, other = axes_of(study.varied)
    with mpl.rc_context(RC):
        ratios = [1.7, *[1.0] * (len(panels) - 1)]
        figure = Figure(figsize=(7.4, 3.0 + 1.7 * len(panels)), layout="constrained")
        FigureCanvasAgg(figure)
        axes = np.atleast_1d(figure.subplots(len(panels), 1, sharex=True, height_ratios=ratios))
        for ax, (title, value, unit) in zip(axes, panels, strict=True):
            _panel(ax, study, across, other, value, unit)
            ax.set_ylabel(title)
        if min(axes[0].get_ylim()) < 0.0:
            axes[0].axhline(0.0, color=GREY, lw=0.8)
        if len(panels) > 1 and panels[1][2] == n:
            axes[1].axhline(0.0, color=WARN, lw=1.0)
        _crosses(axes[0], study, across, n)
        label_across(axes[-1], study.varied[across])
        figure.legend(handles=_key(study, other), loc="outside lower center", ncols=3, handlelength=3.0)
        left_out = 0 if other is None else len(study.varied[other].values) - len(_shown(study, other))
        note = f"\n{left_out} values of {study.varied[other or 0].called} are in the table only" if left_out else ""
        figure.suptitle(study.well.title + note, x=0.01, ha="left", fontsize=10)
        return figure


def _any(study: DragStudy, value: Number) -> bool:
    return any(value(one) is not None for point in study.points for one in point.operations)


def _shown(study: DragStudy, other: int | None) -> list[int]:
    """Values of the second input that are drawn: as many as there are dashes."""
    if other is None:
        return [0]
    count = len(study.varied[other].values)
    return sorted({int(i) for i in np.linspace(0, count - 1, min(count, len(DASHES))).round()})


def _panel(ax: Any, study: DragStudy, across: int, other: int | None, value: Number, unit: float) -> None:
    """One number of every operation: a colour for each, a dash for each value of the second input."""
    place, joined = position(study.varied[across]), study.varied[across].numbers is not None
    for number in range(len(study.names)):
        for dash, i in zip(DASHES, _shown(study, other), strict=False):
            points = sorted((p for p in study.points if other is None or p.at[other] == i),
                            key=lambda p: place[p.at[across]])  # fmt: skip
            found = [value(p.operations[number]) if p.operations else None for p in points]
            y = [math.nan if one is None else one.value / unit for one in found]
            errors = [0.0 if one is None or not math.isfinite(one.error) else one.error / unit for one in found]
            ax.errorbar([place[p.at[across]] for p in points], y, yerr=errors, color=MODES[number % len(MODES)],
                        ls=dash if joined else "none", lw=1.6, marker="o", ms=3.0, elinewidth=1.0)  # fmt: skip


def _crosses(ax: Any, study: DragStudy, across: int, unit: float) -> None:
    """Crosses where an operation fails; at the foot where there is no hook load."""
    place, foot = position(study.varied[across]), ax.get_ylim()[0]
    ax.set_ylim(bottom=foot)
    for point in study.points:
        for number, one in enumerate(point.operations):
            if one.level == FAILS:
                y = foot if one.hook_load is None else one.hook_load.value / unit
                style = FAILS_MARK | {"mfc": MODES[number % len(MODES)]}
                ax.plot(place[point.at[across]], y, ls="none", zorder=5, clip_on=False, **style)


def _key(study: DragStudy, other: int | None) -> list[Line2D]:
    """What colours, dashes and crosses mean."""
    out = [Line2D([], [], color=MODES[i % len(MODES)], lw=4.0, label=name) for i, name in enumerate(study.names)]
    if other is not None:
        varied = study.varied[other]
        out += [Line2D([], [], color=INK, lw=1.6, ls=dash, label=f"{varied.called} {varied.text(i)}")
                for dash, i in zip(DASHES, _shown(study, other), strict=False)]  # fmt: skip
    if any(one.level == FAILS for point in study.points for one in point.operations):
        out.append(Line2D([], [], ls="none", label="fails; at the foot: locks up", **(FAILS_MARK | {"mfc": INK})))
    return out
