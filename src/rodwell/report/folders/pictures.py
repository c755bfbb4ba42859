"""The pictures of a case, as files and for the report."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG

from rodwell.analysis.branch.diagram import Diagram
from rodwell.analysis.curves.curve import Curve
from rodwell.answers.data.along import along, shown
from rodwell.answers.result.answer import Answer
from rodwell.answers.result.assessment import Assessment
from rodwell.case.about import About
from rodwell.errors import InputError
from rodwell.plots.along import plot_along, upright
from rodwell.plots.bifurcation import plot_bifurcation
from rodwell.plots.curves import plot_curves
from rodwell.plots.cylinder import plot_cylinder_moments
from rodwell.plots.methods import plot
from rodwell.plots.profiles import plot_modes, plot_wall_loads
from rodwell.plots.rod3d import plot_rod
from rodwell.plots.sections import name_sections, plot_string
from rodwell.plots.sketch import plot_sketch
from rodwell.plots.style import RC, new_axes, with_dark_style, with_separators
from rodwell.plots.units import axis
from rodwell.report.reports.front import LOGO
from rodwell.store.folder import whole_folder

DPI = 140
PNG: Any = {"pil_kwargs": {"compress_level": 2}}
"""Options of PNG files: the highest compression took longer than the drawing, for files a little smaller."""


def draw(answer: Answer, folder: Path) -> dict[str, tuple[str, bytes]]:
    """Write each picture to ``folder`` as PNG and SVG, the 3-D picture as PNG; return those that a report takes."""
    scales = answer.case.scales
    with mpl.rc_context(RC):
        axes: dict[str, Any] = {
            "sketch": plot_sketch(answer.case),
            "bifurcation": plot_bifurcation(answer.branches, answer.critical, scales),
            "modes": plot_modes(answer.critical, scales),
            "wall-loads": plot_wall_loads(answer.first, scales),
            "rod-3d": plot_rod(answer.shown, scales),
            "along-rod": _along(answer.assessment),
        }
        if answer.case.problem.hole is None:
            axes["cylinder"] = plot_cylinder_moments(answer.shown, scales)
        if answer.case.string is not None:
            axes["string"] = plot_string(answer.case)
        out = {}
        for name, ax in axes.items():
            if name == "rod-3d":
                out[name] = ("png", _as_png(ax.figure, folder / name))
            else:
                save_figure(getattr(ax, "figure", ax), folder / name)
                out[name] = ("svg", (folder / f"{name}.svg").read_bytes())
    return out if answer.case.about.logo is None else out | {LOGO: answer.case.about.logo}


def _along(a: Assessment) -> Any:
    """Force and stress along the rod."""
    states = along(a)
    axes = plot_along(states, shown(states), a.case.scales, a.local, a.case.yield_strength)
    if a.case.string is not None and a.case.scales is not None:
        down = upright(a.case.problem, a.case.scales)
        name_sections(axes, a.case, axis("z", a.case.scales, 1.0)[0], down=down)
    return axes


def draw_diagram(diagram: Diagram, folder: Path) -> None:
    """Draw a bifurcation diagram as PNG and SVG: end curvature, or energy for a coil, against compression."""
    with mpl.rc_context(RC):
        shown = [branch for branch in diagram.branches if branch.parameter == "force"]
        save_figure(plot_bifurcation(shown, diagram.critical).figure, folder / "diagram")


def draw_curves(curves: Sequence[Curve], folder: Path) -> None:
    """Draw curves as PNG and SVG."""
    with mpl.rc_context(RC):
        save_figure(plot_curves(curves).figure, folder / "curves")


def write_picture(result: object, file: Path, field: str = "path") -> None:
    """Write what a result's ``plot`` draws to a file, as :func:`write_drawing` does."""
    write_drawing(lambda axes: plot(result, axes), file, field)


def check_format(file: Path, field: str) -> str:
    """Return the suffix of a picture's file, in small letters.

    Raises
    ------
    InputError
        If it is none of .png, .svg, .pdf; ``field`` is the name of the file's input.
    """
    suffix = file.suffix.lower()
    if suffix not in (".png", ".svg", ".pdf"):
        raise InputError(field, str(file), "must end in .png, .svg or .pdf")
    return suffix


def write_drawing(drawing: Callable[[Any], Any], file: Path, field: str) -> None:
    """Write what ``drawing`` draws on axes to a file, whole or not at all; its suffix is the format.

    Raises
    ------
    InputError
        For a suffix that is none of .png, .svg, .pdf, or if the file cannot be written; ``field`` is the name of the
        file's input.
    """
    suffix = check_format(file, field)
    with whole_folder(file.parent, field) as folder, mpl.rc_context(RC):
        undated: Any = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(suffix)
        axes = new_axes()
        drawing(axes)
        axes.figure.savefig(folder / file.name, dpi=DPI, metadata=undated)


def save_figure(figure: Any, path: Path) -> None:
    """Write a figure as PNG and SVG, ``path`` without suffix; the layout found for the first serves both."""
    _as_png(figure, path)
    svg: Any = FigureCanvasSVG(figure)
    text = io.StringIO()
    svg.print_svg(text, metadata={"Date": None})
    path.with_suffix(".svg").write_text(with_dark_style(text.getvalue()), encoding="utf-8")


def kept(folder: Path, names: Sequence[str], about: About) -> dict[str, tuple[str, bytes]]:
    """The pictures of these names that were written to ``folder``, and the logo, as a report takes them."""
    files = {name: folder / f"{name}.svg" for name in names}
    out = {name: ("svg", file.read_bytes()) for name, file in files.items() if file.exists()}
    return out if about.logo is None else out | {LOGO: about.logo}


def _as_png(figure: Any, path: Path) -> bytes:
    """Write a figure as PNG, ``path`` without suffix, and return the file.

    Layout is done once and the canvases draw once each: ``savefig`` draws every figure once more for nothing.
    """
    with_separators(figure)
    figure.set_dpi(DPI)
    canvas: Any = FigureCanvasAgg(figure)
    if figure.get_layout_engine() is not None:
        figure.get_layout_engine().execute(figure)
        figure.set_layout_engine("none")
    file = path.with_suffix(".png")
    canvas.print_png(file, **PNG)
    return file.read_bytes()
