"""Maps: a number over two parameters with its jumps, over one, or of samples; safe and unsafe under a load."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from rodwell.errors import InputError, checked_number
from rodwell.plots.style import GREY, INK, MODES, WARN, new_axes
from rodwell.quantities.tolerance import LARGEST_FORCE
from rodwell.studies.maps import jumps
from rodwell.studies.maps.axes import Axis
from rodwell.studies.maps.cells import ANOTHER_SHAPE, FAILED, IMPOSSIBLE, NOT_COMPUTED, OFF_THE_WALL, WITH_VALUE
from rodwell.studies.maps.result import Map

LABELS = {
    "weight": "weight γ = mg L³/B", "alpha": "α from the vertical  [degrees]", "clearance": "clearance Δ/L",
    "twist": "end twisting moment T₁  [B/L]", "poisson": "Poisson's ratio ν", "torsion": "torsional stiffness C/B",
    "load": "end force F at s = 1  [B/L²], tension positive",
}  # fmt: skip
"""Labels of the parameters of a problem; those of a case have its key and unit."""

SHOWN = ("value", "place", "half-waves", "error")
"""What can be drawn."""

MARKS: dict[int, tuple[str, dict[str, Any]]] = {
    jumps.MODE: ("the mode changes", {"marker": "o", "ms": 3.4, "mfc": INK, "mec": "white", "mew": 0.4}),
    jumps.PLACE: ("the place jumps", {"marker": "D", "ms": 3.4, "mfc": "white", "mec": INK, "mew": 0.8}),
    jumps.OUTCOME: ("another outcome", {"marker": "s", "ms": 3.0, "mfc": WARN, "mec": "white", "mew": 0.4}),
}
"""How jumps are marked."""

NO_VALUE = {
    OFF_THE_WALL: ("has left the wall", "#f2d5cf"), ANOTHER_SHAPE: ("another shape", "#eadcf0"),
    FAILED: ("failed", WARN), IMPOSSIBLE: ("no such problem", "#e3e7eb"), NOT_COMPUTED: ("not computed yet", "white"),
}  # fmt: skip
"""What stands where there is no value, and its colour; other outcomes are grey."""

LEVELS = 9


def plot_map(
    found: Map, ax: Any = None, *, show: str = "value", at: dict[str, int] | None = None, load: float | None = None
) -> Any:
    """Draw a map; return the axes.

    Over two parameters: coloured, with lines of equal value, and marks where mode, place or outcome jump. Over one: a
    curve. Of samples alone: the share of samples below a value. Forces are drawn as compression −F at s = 1.

    Parameters
    ----------
    found
        The map.
    ax
        Axes; new if not given.
    show
        "value", "place" (s/L), "half-waves" (of the mode) or "error".
    at
        For maps over more parameters: the number of the value at which a parameter is held, 0 if not given.
    load
        An end force at s = 1 in the unit of the map, tension positive: of a map of loads, what buckles or lifts off
        under it is hatched, unsafe.

    Raises
    ------
    InputError
        If ``show`` or ``at`` cannot be used, or ``load`` is given for a map of something else.
    """
    if show not in SHOWN:
        raise InputError("show", show, f"must be one of {', '.join(SHOWN)}")
    if load is not None:
        checked_number("load", load, -LARGEST_FORCE * 1e12, LARGEST_FORCE * 1e12, "a finite end force")
        if not is_load(found):
            raise InputError("load", load, f"goes with maps of loads, not of {found.question.rods.quantity}")
    ax = new_axes() if ax is None else ax
    axes, index = _free(found, at or {})
    number = shown_numbers(found, show)[index]
    if found.question.distributions and not axes:
        _shares(ax, number.ravel(), found, show)
    elif len(axes) == 1:
        _curve(ax, found, axes[0], number, show, load)
    else:
        _plane(ax, found, (axes[0], axes[1]), number, index, show, load)
    _title(ax, found, at or {})
    return ax


def is_load(found: Map) -> bool:
    """Whether the numbers are loads at which something happens: they are drawn as compression."""
    return found.question.rods.number.dimension == "force" and not found.question.rods.number.at_load


def _free(found: Map, at: dict[str, int]) -> tuple[list[Axis], tuple[Any, ...]]:
    """The parameters that are drawn, at most two, and the index that holds the others."""
    question = found.question
    for name, i in at.items():
        if name not in question.dims or not 0 <= i < question.shape[question.dims.index(name)]:
            raise InputError(
                "at", {name: i}, f"must hold a parameter of {', '.join(question.dims)} at one of its values"
            )
    free: list[Axis] = []
    index: list[Any] = []
    for axis in question.axes:
        drawn = axis.name not in at and axis.numbers is not None and len(free) < 2
        free += [axis] if drawn else []
        index.append(slice(None) if drawn else at.get(axis.name, 0))
    if question.distributions:
        index.append(at.get("sample", slice(None) if not free else 0))
    return free, tuple(index)


def shown_numbers(found: Map, show: str) -> np.ndarray:
    """What is drawn, in the shape of the grid; NaN where there is none."""
    known = np.isin(found.cells["outcome"], WITH_VALUE)
    if show == "half-waves":
        column = np.round(found.cells["wavenumber"] / math.pi)
    else:
        column = found.cells[show] * (-1.0 if show == "value" and is_load(found) else 1.0)
    return np.where(known, column, np.nan)


def value_label(found: Map, show: str) -> str:
    """What is drawn, with its unit."""
    unit = found.unit.replace("^2", "²").replace("^3", "³").replace("^4", "⁴")
    unit = f"  [{unit}]" if unit != "1" else ""
    number = found.question.rods.number
    if show == "place":
        return "place s/L"
    if show == "half-waves":
        return "half waves of the mode"
    if show == "error":
        return f"error estimate{unit}"
    if is_load(found):
        name = number.label.partition(",")[0].replace("load at which", "compression at which")
        return f"{name.replace('load', 'compression')},\n−F at s = 1{unit}"
    return f"{number.label}{unit}"


def _plane(ax: Any, found: Map, axes: tuple[Axis, Axis], number: np.ndarray, index: Any, show: str, load: Any) -> None:
    first, second = axes
    x, y = np.array(first.numbers), np.array(second.numbers)
    z = number.T
    ax.grid(visible=False)
    _outcomes(ax, x, y, found.cells["outcome"][index].T)
    if np.isfinite(z).any():
        colours = ListedColormap(MODES[:8]) if show == "half-waves" and np.nanmax(z) - np.nanmin(z) < 8 else "viridis"
        limits = {"vmin": np.nanmin(z) - 0.5, "vmax": np.nanmin(z) + 7.5} if isinstance(colours, ListedColormap) else {}
        shown = ax.pcolormesh(x, y, z, shading="nearest", cmap=colours, alpha=0.85, rasterized=True, **limits)
        bar = ax.figure.colorbar(shown, ax=ax, pad=0.015, aspect=28)
        bar.set_label(value_label(found, show))
        if limits:
            bar.ax.set_ylim(np.nanmin(z) - 0.5, np.nanmax(z) + 0.5)
            bar.set_ticks(np.arange(np.nanmin(z), np.nanmax(z) + 1.0))
        elif min(z.shape) > 1 and np.nanmax(z) > np.nanmin(z):
            lines = ax.contour(x, y, z, LEVELS, colors=INK, linewidths=0.7, alpha=0.75)
            ax.clabel(lines, fontsize=7.5, fmt="%g")
    handles = _jumps(ax, found, axes, index)
    if load is not None:
        handles += _unsafe(ax, x, y, z, -load)
    _scale(ax, first, second)
    ax.set(xlim=(x.min(), x.max()), ylim=(y.min(), y.max()))
    handles += _no_values(found.cells["outcome"][index])
    if handles:
        ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=8.5)


def _outcomes(ax: Any, x: np.ndarray, y: np.ndarray, outcome: np.ndarray) -> None:
    """Colour cells without value by what came of them."""
    for kind in np.unique(outcome):
        if kind not in WITH_VALUE:
            colour = NO_VALUE.get(int(kind), ("", GREY))[1]
            part = np.where(outcome == kind, 1.0, np.nan)
            ax.pcolormesh(x, y, part, shading="nearest", cmap=ListedColormap([colour]), rasterized=True)


def _no_values(outcome: np.ndarray) -> list[Any]:
    kinds = [int(kind) for kind in np.unique(outcome) if kind not in WITH_VALUE]
    named = [NO_VALUE.get(kind, ("out of reach, or not defined", GREY)) for kind in kinds]
    return [Patch(facecolor=colour, edgecolor=INK, lw=0.5, label=text) for text, colour in dict.fromkeys(named)]


def _jumps(ax: Any, found: Map, axes: tuple[Axis, ...], index: Any) -> list[Any]:
    """Mark jumps that lie in the plane that is drawn; return what the marks mean."""
    where = found.jumps
    if not where or not len(where["outcome"]):
        return []
    held = np.ones(len(where["outcome"]), dtype=bool)
    for axis, i in zip(found.question.axes, index, strict=False):
        if not isinstance(i, slice) and axis.numbers is not None:
            held &= where[f"at_{axis.name}"] == axis.numbers[i]
    handles = []
    for kind, (text, style) in MARKS.items():
        chosen = held & (where["outcome"] == kind)
        if chosen.any():
            ax.plot(*(where[f"at_{axis.name}"][chosen] for axis in axes), ls="none", zorder=4, **style)
            handles.append(Line2D([], [], ls="none", label=text, **style))
    return handles


def _unsafe(ax: Any, x: np.ndarray, y: np.ndarray, z: np.ndarray, compression: float) -> list[Any]:
    """Hatch where a compression reaches the load of the map."""
    if min(z.shape) > 1:
        hatched = ax.contourf(x, y, z, [-1e300, compression], colors="none", hatches=["///"])
        hatched.set_edgecolor((0.12, 0.16, 0.2, 0.55))
        hatched.set_linewidth(0.0)
        ax.contour(x, y, z, [compression], colors=WARN, linewidths=2.0)
    return [Patch(facecolor="none", edgecolor=INK, hatch="///", label=f"unsafe under −F = {compression:g}")]


def _scale(ax: Any, first: Axis, second: Axis) -> None:
    for axis, set_label, set_scale in ((first, ax.set_xlabel, ax.set_xscale), (second, ax.set_ylabel, ax.set_yscale)):
        set_label(axis_label(axis))
        if axis.logarithmic:
            set_scale("log")


def axis_label(axis: Axis) -> str:
    """A parameter with its unit."""
    return LABELS.get(axis.name, f"{axis.name}  [{axis.unit}]" if axis.unit else axis.name)


def _curve(ax: Any, found: Map, axis: Axis, number: np.ndarray, show: str, load: float | None) -> None:
    x = np.array(axis.numbers)
    ax.plot(x, number.reshape(len(x), -1), color=MODES[0], lw=1.7, marker="o", ms=3.0)
    for kind, (text, _style) in MARKS.items():
        where = found.jumps.get("outcome", np.empty(0)) == kind
        colour = WARN if kind == jumps.OUTCOME else INK
        for i, place in enumerate(found.jumps[f"at_{axis.name}"][where] if where.any() else ()):
            dashes = ":" if kind == jumps.PLACE else (0, (4, 2))
            ax.axvline(place, color=colour, lw=1.0, ls=dashes, label=text if i == 0 else None)
    if load is not None:
        ax.axhline(-load, color=WARN, lw=1.4, label=f"−F = {-load:g}: unsafe where it lies above the curve")
    ax.set_xlabel(axis_label(axis))
    ax.set_ylabel(value_label(found, show))
    if axis.logarithmic:
        ax.set_xscale("log")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(fontsize=8.5)


def _shares(ax: Any, number: np.ndarray, found: Map, show: str) -> None:
    """The share of samples below a value."""
    known = np.sort(number[np.isfinite(number)])
    ax.step(known, np.arange(1, len(known) + 1) / max(len(number), 1), where="post", color=MODES[0], lw=1.7)
    ax.set_xlabel(value_label(found, show))
    ax.set_ylabel(f"share of {len(number)} samples at or below")
    ax.set_ylim(0.0, 1.0)


def _title(ax: Any, found: Map, at: dict[str, int]) -> None:
    question = found.question
    given = question.rods.given
    said = [question.title] if question.title else []
    if question.rods.folder is None:
        said += [f"Δ/L = {given['clearance']:g}"] if "clearance" not in question.rods.names else []
        said += [f"ends {given['ends']}"] if "ends" not in question.rods.names else []
    said += [f"{name} number {i}" for name, i in at.items()]
    ax.set_title(", ".join(said), loc="left", fontsize=9.5)
