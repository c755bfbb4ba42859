"""Figures as files."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG

from rodwell.errors import InputError
from rodwell.plots.style import RC, new_axes, with_dark_style, with_separators
from rodwell.store.folder import whole_folder

DPI = 140
PNG: Any = {"pil_kwargs": {"compress_level": 2}}
"""Options of PNG files: the highest compression took longer than the drawing, for files a little smaller."""


def save_figure(figure: Any, path: Path) -> None:
    """Write a figure as PNG and SVG, ``path`` without suffix."""
    for suffix, content in png_and_svg(figure).items():
        path.with_suffix(f".{suffix}").write_bytes(content)


def png_and_svg(figure: Any) -> dict[str, bytes]:
    """A figure in both formats, by suffix; the layout found for the first serves both."""
    png = as_png(figure)
    svg: Any = FigureCanvasSVG(figure)
    text = io.StringIO()
    svg.print_svg(text, metadata={"Date": None})
    return {"png": png, "svg": with_dark_style(text.getvalue()).encode()}


def as_png(figure: Any) -> bytes:
    """A figure as PNG.

    Layout is done once and the canvases draw once each: ``savefig`` draws every figure once more for nothing.
    """
    with_separators(figure)
    figure.set_dpi(DPI)
    canvas: Any = FigureCanvasAgg(figure)
    if figure.get_layout_engine() is not None:
        figure.get_layout_engine().execute(figure)
        figure.set_layout_engine("none")
    out = io.BytesIO()
    canvas.print_png(out, **PNG)
    return out.getvalue()


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
