"""Colours and small helpers that all figures share."""

from __future__ import annotations

from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter

from rodwell.problem.problem import Problem
from rodwell.problem.varying import CURVATURES
from rodwell.problem.words import ends_text
from rodwell.quantities.scales import Scales
from rodwell.quantities.text import plain, separated

INK = "#1f2933"
GREY = "#8a94a0"
GRID = "#e3e7eb"

TELLING = ("#0b5fa5", "#eb7500", "#00ad90", "#4c0f2e", "#6a95eb")
"""Colours that eyes without red or green cones tell apart too: CIEDE2000 of any two, and WARN, is above 20."""

WARN = "#b3261e"
ROD, BORE = "#c9d3dd", "#e7eef5"
"""The rod's section and its bore in a sketch."""

DARK_TELLING, DARK_WARN = ("#4caeff", "#fcdb1b", "#4b8c84", "#fcdfe8", "#2f5fcc"), "#cc372c"
"""The same for dark pages: colours that stand out from a dark ground, told apart by the same rule."""

DARK = {
    **dict(zip(TELLING, DARK_TELLING, strict=True)), WARN: DARK_WARN, INK: "#e4e9ee", GRID: "#2b3640",
    "#ffffff": "#12181e", "#000000": "#e4e9ee", ROD: "#4a5866", BORE: "#22303c",
}  # fmt: skip
"""What stands for each colour where a page is dark."""

MODES = tuple(TELLING[i % len(TELLING)] for i in range(12))
"""One colour a mode; from the sixth on they come again with a mark on the line, see :data:`MARKS`."""

MARKS = tuple(("", "o", "s")[i // len(TELLING)] for i in range(12))
"""The second cue of a mode, beside its colour."""

BUCKLES, LIFTS_OFF, ACTS = TELLING[0], WARN, TELLING[1]
"""What colours mean in figures that are not of modes: buckling, lift-off (and what must not be), the load that acts."""

SECONDARY = "#5a6b7b"
"""What branches off a mode: told apart by the marks on the lines."""

SOLID = "-"
OFF_WALL = (0, (1, 0.7))
"""States that have left the wall, dotted finely: thick where they are stable, thin where not."""

UNSTABLE, LIMIT, DASHDOT, FORMULA = (0, (5, 2)), (0, (1, 1.3)), (0, (6, 1.5, 1, 1.5)), (0, (3, 1.2, 1, 1.2, 1, 1.2))
"""What dashes mean in every figure: unstable; a limit that something is held against; lift-off where colours have
another meaning; a formula of practice."""

SIZE, WIDE = (7.2, 4.4), 9.6

RC: Any = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.5,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.titley": 1.0,  # where it stands anyway: to find that, every draw would measure all labels of the axes again
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "svg.fonttype": "path",
    "svg.hashsalt": "rodwell",
}


def with_dark_style(svg: str) -> str:
    """Return a figure that follows its reader: dark where page or system is, light on paper.

    Matplotlib writes colours into ``style`` attributes; rules of a style sheet of its own stand above them.
    """
    rules = [
        f'[style*="{what}: {light}"]{{{what}:{dark} !important}}'
        for light, dark in DARK.items()
        for what in ("fill", "stroke")
    ]
    sheet = f"<style>@media screen and (prefers-color-scheme: dark) {{{''.join(rules)}}}</style>"
    end = svg.index(">", svg.index("<svg")) + 1
    return f"{svg[:end]}{sheet}{svg[end:]}"


class _Separated(ScalarFormatter):
    """Numbers on axes with their thousands set apart."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        return separated(super().__call__(x, pos))


def with_separators(figure: Figure) -> None:
    """Set apart the thousands of all numbers on the axes of a figure."""
    for ax in [one for axes in figure.axes for one in (axes, *axes.child_axes)]:
        for one in (ax.xaxis, ax.yaxis):
            if type(one.get_major_formatter()) is ScalarFormatter:
                one.set_major_formatter(_Separated())


def marked(number: int) -> dict[str, Any]:
    """Options of a line for mode or curve ``number`` (from 0): its colour, and a mark on it where colours repeat."""
    mark = MARKS[number % len(MARKS)]
    extra = {"marker": mark, "markevery": 0.11, "ms": 4.5, "mfc": "white"} if mark else {}
    return {"color": MODES[number % len(MODES)], **extra}


def bends(problem: Problem) -> dict[str, str]:
    """The curvatures of a hole that has any, by name, in words."""
    return {name: f"{name} {plain(value)}/L" for name in CURVATURES if (value := getattr(problem, name)) != 0.0}


def parameters(problem: Problem, scales: Scales | None = None) -> str:
    """What a figure is of, for the figure itself: γ, α, Δ/L and the ends, twist and curvature if there are any."""
    parts = [f"γ = {plain(problem.weight)}", f"α = {plain(problem.alpha)}°", f"Δ/L = {plain(problem.clearance)}"]
    if problem.twist != 0.0:
        parts.append(f"T₁ = {plain(problem.twist)} B/L")
    parts += bends(problem).values()
    if scales is not None:
        parts.insert(0, f"L = {scales.text(1.0, 'length')}")
    return ",  ".join([*parts, ends_text(problem)])


def in_lines(text: str, longest: int) -> str:
    """Break what :func:`parameters` says into lines of at most so many characters, between two of its parts."""
    lines = [""]
    for part in text.split(",  "):
        joined = f"{lines[-1]},  {part}" if lines[-1] else part
        lines[-1:] = [joined] if len(joined) <= longest or not lines[-1] else [f"{lines[-1]},", part]
    return "\n".join(lines)


def new_axes(size: tuple[float, float] = SIZE, nrows: int = 1, index: int = 1) -> Any:
    """Return axes of a new figure (no pyplot, no global state): number ``index`` of ``nrows`` below each other."""
    import matplotlib as mpl  # noqa: PLC0415

    with mpl.rc_context(RC):
        figure = Figure(figsize=size, layout="constrained")
        FigureCanvasAgg(figure)
        return figure.add_subplot(nrows, 1, index)
