"""A load path that moves: load against shortening, and the rod in its hole, from the side and along the axis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from rodwell.analysis.off_wall.measured import position
from rodwell.analysis.path.frames import Frame, frames
from rodwell.analysis.path.load_path import LoadPath
from rodwell.answers.words.wording import forces_in
from rodwell.case.case import Case
from rodwell.plots.paths.axes import Units, across_of, units_of, words
from rodwell.plots.paths.path import plot_path
from rodwell.plots.style import GREY, INK, MODES, WARN
from rodwell.quantities.arrays import FloatArray
from rodwell.quantities.forces import Forces

PLACES, DOTS = 201, 100
"""Places along the rod, and dots in an inch."""

STEP, PAUSE = 120, 900
"""Milliseconds that a picture is seen; the first behind a snap, and the very last one."""

TOUCHES = 1e-9
"""Part of the clearance within which the rod is at a wall that does not give way."""


@dataclass(frozen=True)
class _Shown:
    """What a picture shows: side and height of the rod in clearances, (k,), where it touches, load, and words."""

    y: FloatArray
    x: FloatArray
    touching: FloatArray
    at: tuple[float, float]
    run: int
    says: str


def pictures(result: LoadPath, case: Case | None = None) -> Iterator[tuple[Image.Image, int, float]]:
    """The states of a load path in order of happening: picture, its milliseconds, and what part of all that was.

    Numbers stand in the units of a case; None: B = L = 1.
    """
    units, said = units_of(result, case), forces_in(result, case)
    shown = [_of(frame, result, units, said) for frame in frames(result)]
    figure = Figure(figsize=(9.6, 4.6), dpi=DOTS, layout="constrained")
    canvas: Any = FigureCanvasAgg(figure)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1.0), height_ratios=(1.0, 1.3))
    curve, sides, end = (figure.add_subplot(spot) for spot in (grid[:, 0], grid[0, 1], grid[1, 1]))
    plot_path(result, curve, case)
    s = np.linspace(0.0, 1.0, PLACES)
    wall = result.problem.rod.clearance(s)
    for sign in (-1.0, 1.0):
        sides.plot(s, sign * wall, color=GREY, lw=1.0)
    _around(sides, end, float(np.max(wall)))
    (dot,) = curve.plot([], [], "o", color=WARN, ms=9, mec="white", mew=1.2, zorder=9)
    height, side = (sides.plot(s, s, color=MODES[k], lw=1.8, ls=ls, label=name)[0] for k, ls, name in _SIDES)
    (rod,) = end.plot([], [], color=MODES[0], lw=1.8)
    along, across = (ax.plot([], [], ".", color=INK, ms=3.5, label="on the wall")[0] for ax in (sides, end))
    sides.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, frameon=False)
    title = figure.suptitle(max((one.says for one in shown), key=len), fontsize=9.5)
    moving: list[tuple[Any, Any]] = [
        (curve, dot),
        (sides, height),
        (sides, side),
        (end, rod),
        (sides, along),
        (end, across),
        (figure, title),
    ]
    for _, part in moving:
        part.set_animated(True)
    canvas.draw()  # what stays, once
    still = canvas.copy_from_bbox(figure.bbox)
    for number, one in enumerate(shown):
        canvas.restore_region(still)
        dot.set_data([one.at[0]], [one.at[1]])
        height.set_ydata(one.x)
        side.set_ydata(one.y)
        rod.set_data(one.y, one.x)
        along.set_data(s[one.touching], one.x[one.touching])
        across.set_data(one.y[one.touching], one.x[one.touching])
        title.set_text(one.says)
        for on, part in moving:
            on.draw_artist(part)
        held = number + 1 == len(shown) or (number > 0 and one.run != shown[number - 1].run)
        picture = Image.fromarray(np.array(canvas.buffer_rgba())).convert("RGB")
        yield picture, PAUSE if held else STEP, (number + 1) / len(shown)


_SIDES = (0, "-", "height"), (1, "--", "to the side")


def _around(sides: Any, end: Any, widest: float) -> None:
    """What stays: the walls, and what is drawn along which axis."""
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    end.plot(np.sin(turn), np.cos(turn), color=GREY, lw=1.0)
    end.set_aspect("equal")
    for ax in (sides, end):
        ax.set_ylim(-1.08 * widest, 1.08 * widest)
        ax.set_yticks([-1.0, 0.0, 1.0])
    end.set_xlim(-1.08 * widest, 1.08 * widest)
    end.set_xticks([-1.0, 0.0, 1.0])
    sides.set_xlim(0.0, 1.0)
    sides.set_xlabel("s / L")
    sides.set_ylabel("in clearances Δ")
    end.set_xlabel("to the side / Δ, seen along the hole")
    end.set_ylabel("height / Δ")


def _of(frame: Frame, result: LoadPath, units: Units, said: Forces) -> _Shown:
    """What is drawn of a state."""
    s, state, clearance = np.linspace(0.0, 1.0, PLACES), frame.state, result.problem.clearance
    x, y, pressure = position(state, s)
    shortening = state.solved.out.energy_by_load * clearance**2
    room = result.problem.rod.clearance(s) - np.hypot(x[0], y[0]) / clearance
    touching = (pressure != 0.0) | (room <= TOUCHES)
    at = units.shortening * float(across_of(result, shortening, state.load)), float(units.load(state.load))
    return _Shown(y[0] / clearance, x[0] / clearance, touching, at, frame.run, words(frame, said))
