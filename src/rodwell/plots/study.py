"""Curves of a parameter study."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rodwell.answers.result.assessment import BUCKLED
from rodwell.plots.style import DASHDOT, INK, LIMIT, MODES, RC, WARN
from rodwell.quantities.value import Value
from rodwell.studies.sweep.load_columns import fails, most_loads
from rodwell.studies.sweep.loads import LoadResult
from rodwell.studies.sweep.points import StudyPoint
from rodwell.studies.sweep.study import Study
from rodwell.studies.sweep.tables import scales
from rodwell.studies.varied import Varied

DASHES, DOTS = DASHDOT, LIMIT

BUCKLED_MARK: dict[str, Any] = {"marker": "D", "ms": 5, "mfc": "white", "mec": INK, "mew": 1.2}
FAILS_MARK: dict[str, Any] = {"marker": "X", "ms": 7, "mfc": WARN, "mec": "white", "mew": 0.6}
"""How the states at the loads that act are marked."""

MOST_CURVES = 8
"""Curves in one panel; with more values of the second input, some are left out of the figure, and it says so."""


def plot_study(study: Study) -> Figure:
    """Draw compression at buckling and at lift-off, and the largest contact force, over an input.

    With two varied inputs the one with more values goes across, the other has a colour for each value. Compression
    is positive, at s = 1; bars are errors where they can be seen. Worst cases are ringed. Loads that act are dotted,
    with a panel of the safety factor under the most compressive one. The contact force is that at lift-off, or at
    the load where that varies. Returns the figure.
    """
    scale, force, per, per_length = scales(study)
    across, other = axes_of(study.varied)
    families = _families(study, across, other)
    loads = {name: _scaled(study, name) for name in ("critical", "lift_off", "contact")}
    with mpl.rc_context(RC):
        safety = _safety(study)
        ratios = (1.7, 1, 1) if safety else (1.7, 1)
        figure = Figure(figsize=(7.4, 6.4 if not safety else 8.2), layout="constrained")
        FigureCanvasAgg(figure)
        upper, lower, *last = figure.subplots(len(ratios), 1, sharex=True, height_ratios=ratios)
        for colour, (_label, points) in zip(MODES, families, strict=False):
            _curve(upper, study, across, points, loads["critical"], scale, colour, "-")
            _curve(upper, study, across, points, loads["lift_off"], scale, colour, DASHES)
            _switches(upper, study, across, points, loads["critical"], scale)
            _loads(upper, study, across, points, scale, colour)
        _ring_worst(upper, study, across, loads, scale, {p.number for _, points in families for p in points})
        upper.set_ylabel(f"end compression −F at s = 1  [{force}]")
        if upper.get_ylim()[0] < 0.0:
            upper.axhline(0.0, color=INK, lw=0.8)
        for colour, (_label, points) in zip(MODES, families, strict=False):
            _curve(lower, study, across, points, loads["contact"], per, colour, "-")
        where = "at the load" if study.load_varies else "at lift-off"
        lower.set_ylabel(f"largest contact force\n{where}  [{per_length}]")
        lower.set_ylim(bottom=0.0)
        for colour, (_label, points) in zip(MODES, families, strict=False):
            for ax in last:
                _curve(ax, study, across, points, safety, 1.0, colour, "-")
        for ax in last:
            ax.axhline(1.0, color=WARN, lw=1.0)
            ax.set_ylabel("safety factor\nat the load")
            ax.set_ylim(bottom=0.0)
        label_across(last[0] if last else lower, study.varied[across])
        figure.legend(handles=_key(study, families), loc="outside lower center", ncols=3, handlelength=3.0)
        left_out = 0 if other is None else len(study.varied[other].values) - len(families)
        note = f"\n{left_out} values of {study.varied[other or 0].called} are in the table only" if left_out else ""
        figure.suptitle(study.title + note, x=0.01, ha="left", fontsize=10)
        return figure


def axes_of(varied: Sequence[Varied]) -> tuple[int, int | None]:
    """Which input goes across, and which makes the family of curves."""
    if len(varied) == 1:
        return 0, None
    sizes = [len(v.values) if v.numbers is not None else 0 for v in varied]
    across = 0 if sizes[0] >= sizes[1] else 1
    return across, 1 - across


def _families(study: Study, across: int, other: int | None) -> list[tuple[str, list[StudyPoint]]]:
    """Points of each curve, in the order of the input across, with the label of the curve."""
    key = position(study.varied[across])
    if other is None:
        return [("", sorted(study.points, key=lambda point: key[point.at[0]]))]
    count = len(study.varied[other].values)
    shown = sorted({int(i) for i in np.linspace(0, count - 1, min(count, MOST_CURVES)).round()})
    return [
        (
            f"{study.varied[other].called} {study.varied[other].text(i)}",
            sorted((p for p in study.points if p.at[other] == i), key=lambda point: key[point.at[across]]),
        )
        for i in shown
    ]


def position(varied: Varied) -> tuple[float, ...]:
    """Where the values lie across: themselves, or one after the other if they are no numbers."""
    return varied.numbers or tuple(float(i) for i in range(len(varied.values)))


def _scaled(study: Study, name: str) -> dict[int, Value]:
    """Values by number of the point, in N or N/m (or B = L = 1); those that there are."""
    out = {}
    for point in study.points:
        if name == "contact":
            most = _most(point)
            contact = point.contact if not study.load_varies else None if most is None else most.contact
            value = None if contact is None else contact.times(point.factor("force_per_length"))
        else:
            value = point.compression(name)
        if value is not None:
            out[point.number] = value
    return out


def _curve(
    ax: Any, study: Study, across: int, points: list[StudyPoint], values: dict[int, Value],
    scale: float, colour: str, dashes: Any,
) -> None:  # fmt: skip
    """One curve with its points; it is interrupted where a point has no value."""
    place = position(study.varied[across])
    x = [place[p.at[across]] for p in points]
    shown = [values.get(p.number, Value(math.nan)) for p in points]
    y, errors = np.array([v.value for v in shown]) / scale, np.array([v.error for v in shown]) / scale
    joined = dashes if study.varied[across].numbers is not None else "none"
    ax.errorbar(x, y, yerr=errors, color=colour, ls=joined, lw=1.7, marker="o", ms=3.5, elinewidth=1.0)


SWITCH: dict[str, Any] = {"marker": "|", "ms": 13, "mec": INK, "mew": 1.6}


def _switches(
    ax: Any, study: Study, across: int, points: list[StudyPoint], values: dict[int, Value], scale: float
) -> None:
    """Mark between which points another mode comes first: its number of half waves changes."""
    for before, after in _switched(study, across, points):
        x, y = (
            0.5 * (one + two)
            for one, two in (
                (position(study.varied[across])[before.at[across]], position(study.varied[across])[after.at[across]]),
                (values[before.number].value / scale, values[after.number].value / scale),
            )
        )
        ax.plot(x, y, ls="none", zorder=5, **SWITCH)


def _switched(study: Study, across: int, points: list[StudyPoint]) -> list[tuple[StudyPoint, StudyPoint]]:
    """Neighbours of one curve whose first modes have other numbers of half waves."""
    if study.varied[across].numbers is None:
        return []
    known = [point for point in points if point.half_waves is not None]
    return [(one, two) for one, two in pairwise(known) if round(one.half_waves or 0.0) != round(two.half_waves or 0.0)]


def _most(point: StudyPoint) -> LoadResult | None:
    """The most compressive load that acts at a point."""
    return min(point.loads, key=lambda state: state.load.force, default=None)


def _safety(study: Study) -> dict[int, Value]:
    """Safety factor under the most compressive load that acts, by number of the point."""
    out = {}
    for point in study.points:
        most = _most(point)
        if most is not None and most.safety is not None:
            out[point.number] = most.safety
    return out


def _loads(ax: Any, study: Study, across: int, points: list[StudyPoint], scale: float, colour: str) -> None:
    """The loads that act as compression at s = 1: dotted, with marks where the rod is buckled or worse."""
    place = position(study.varied[across])
    joined = DOTS if study.varied[across].numbers is not None else "none"
    for k in range(most_loads(study)):
        pairs = [(place[p.at[across]], p, p.loads[k]) for p in points if k < len(p.loads)]
        x = [pair[0] for pair in pairs]
        y = [-state.load.force * p.factor("force") / scale for _, p, state in pairs]
        ax.plot(x, y, color=colour, ls=joined, lw=1.5, marker="." if joined == "none" else "")
        for style, mark in ((BUCKLED_MARK, BUCKLED), (FAILS_MARK, None)):
            at = [i for i, (_, _, state) in enumerate(pairs) if (fails(state) if mark is None else state.what == mark)]
            ax.plot([x[i] for i in at], [y[i] for i in at], ls="none", zorder=5, **style)


def _key(study: Study, families: list[tuple[str, list[StudyPoint]]]) -> list[Line2D]:
    """What lines, colours and rings mean."""
    plain = MODES[0] if len(families) == 1 else INK
    out = [
        Line2D([], [], color=plain, lw=1.7, label="buckles"),
        Line2D([], [], color=plain, lw=1.7, ls=DASHES, label="leaves the wall"),
    ]
    across = axes_of(study.varied)[0]
    if any(_switched(study, across, points) for _, points in families):
        out.append(Line2D([], [], ls="none", label="another mode comes first", **SWITCH))
    if not study.load_varies:
        out.append(Line2D([], [], ls="none", marker="o", ms=11, mfc="none", mec=WARN, mew=2.0, label="worst case"))
    if most_loads(study):
        out += [
            Line2D([], [], color=plain, lw=1.5, ls=DOTS, label="load that acts"),
            Line2D([], [], ls="none", label="… buckled, on the wall", **BUCKLED_MARK),
            Line2D([], [], ls="none", label="… off the wall, or too much", **FAILS_MARK),
        ]
    return out + [Line2D([], [], color=c, lw=4.0, label=f[0]) for c, f in zip(MODES, families, strict=False) if f[0]]


def _ring_worst(
    ax: Any, study: Study, across: int, loads: dict[str, dict[int, Value]], scale: float, shown: set[int]
) -> None:
    """Ring the worst cases, as far as their curves are drawn."""
    place = position(study.varied[across])
    for name in () if study.load_varies else ("critical", "lift_off"):
        worst = study.worst(name)
        if worst is not None and worst.number in shown:
            x, y = place[worst.at[across]], loads[name][worst.number].value / scale
            ax.plot(x, y, "o", ms=13, mfc="none", mec=WARN, mew=2.0, zorder=6, clip_on=False)


def label_across(ax: Any, varied: Varied) -> None:
    """Label the axis of the input that goes across."""
    ax.set_xlabel(varied.label)
    if varied.numbers is None:
        ax.set_xticks(range(len(varied.values)), [str(value) for value in varied.values], rotation=15)
