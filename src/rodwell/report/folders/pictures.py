"""The pictures of a case, as files and for the report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl

from rodwell.analysis.branch.solution import Solution
from rodwell.answers.data.along import along, shown
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.assessment import Assessment
from rodwell.case.about import About
from rodwell.case.case import Case
from rodwell.plots.along import plot_along, upright
from rodwell.plots.bifurcation import plot_bifurcation
from rodwell.plots.cylinder import plot_cylinder_moments
from rodwell.plots.profiles import plot_modes, plot_wall_loads
from rodwell.plots.rod3d import plot_rod
from rodwell.plots.sections import name_sections, plot_string
from rodwell.plots.sketch import plot_sketch
from rodwell.plots.style import RC
from rodwell.plots.units import axis
from rodwell.report.folders.figures import as_png, png_and_svg
from rodwell.report.reports.front import LOGO

if TYPE_CHECKING:
    from rodwell.answers.result.beyond import Beyond

Drawn = dict[str, dict[str, bytes]]
"""What each picture is in each format, by name and suffix."""


def draw_branches(answer: Answer, states: Sequence[Solution] | None = None) -> Drawn:
    """Draw what happens as the load changes: half of the work.

    ``states`` are those of the first branch on the way to lift-off, where these are known already.
    """
    scales = answer.case.scales
    with mpl.rc_context(RC):
        return _files({
            "bifurcation": plot_bifurcation(answer.branches, answer.critical, scales),
            "wall-loads": plot_wall_loads(answer.first, scales, states),
        })  # fmt: skip


def draw_rod(answer: Answer) -> Drawn:
    """Draw the case, and the rod in one state: the other half."""
    scales = answer.case.scales
    with mpl.rc_context(RC):
        axes: dict[str, Any] = {
            "sketch": plot_sketch(answer.case),
            "rod-3d": plot_rod(answer.shown, scales),
            "along-rod": _along(answer.assessment),
        }
        if answer.critical:
            axes["modes"] = plot_modes(answer.critical, scales)
        if answer.case.problem.hole is None:
            axes["cylinder"] = plot_cylinder_moments(answer.shown, scales)
        if answer.case.string is not None:
            axes["string"] = plot_string(answer.case)
        return _files(axes)


def draw_beyond(case: Case, found: Beyond) -> Drawn:
    """Draw what happens beyond lift-off, where it could be followed."""
    # what follows rods off the wall is imported for those only that are
    from rodwell.plots.paths.beyond import plot_beyond  # noqa: PLC0415
    from rodwell.report.reports.beyond import PICTURE  # noqa: PLC0415

    with mpl.rc_context(RC):
        return {PICTURE: png_and_svg(plot_beyond(case, found))}


def _files(axes: dict[str, Any]) -> Drawn:
    """PNG and SVG of all, the 3-D picture as PNG."""
    figures = {name: getattr(ax, "figure", ax) for name, ax in axes.items()}
    return {
        name: {"png": as_png(figure)} if name == "rod-3d" else png_and_svg(figure) for name, figure in figures.items()
    }


def _along(a: Assessment) -> Any:
    """Force and stress along the rod."""
    states = along(a)
    axes = plot_along(states, shown(states), a.case.scales, a.local, a.case.yield_strength)
    if a.case.string is not None and a.case.scales is not None:
        down = upright(a.case.problem, a.case.scales)
        name_sections(axes, a.case, axis("z", a.case.scales, 1.0)[0], down=down)
    return axes


def kept(folder: Path, names: Sequence[str], about: About) -> dict[str, tuple[str, bytes]]:
    """The pictures of these names that were written to ``folder``, and the logo, as a report takes them."""
    files = {name: folder / f"{name}.svg" for name in names}
    out = {name: ("svg", file.read_bytes()) for name, file in files.items() if file.exists()}
    return out if about.logo is None else out | {LOGO: about.logo}
