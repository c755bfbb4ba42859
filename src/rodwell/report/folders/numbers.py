"""Numbers that a command prints, as files: data, a table, a picture."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl

from rodwell.plots.style import RC, new_axes
from rodwell.quantities.table import Table
from rodwell.report.folders.figures import save_figure, write_drawing
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv
from rodwell.store.text import write_json

Draw = Callable[[Any], Any]
"""Draws on axes."""


class Numbers(NamedTuple):
    """What a command has computed, in the forms that it is kept in.

    Attributes
    ----------
    name
        Of the files, without suffix.
    data
        Plain data, as ``--json`` prints it.
    table
        The same as rows, or None.
    draw
        Draws them on axes, or None where there is nothing to see.
    """

    name: str
    data: dict[str, Any]
    table: Table | None = None
    draw: Draw | None = None


def write_numbers(numbers: Numbers, out: Path) -> None:
    """Write data (JSON), table (CSV) and picture (PNG, SVG) to the folder ``out``: all files, or none.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        write_json(numbers.data, folder / f"{numbers.name}.json")
        if numbers.table is not None:
            write_csv(numbers.table, folder / f"{numbers.name}.csv")
        if numbers.draw is not None:
            with mpl.rc_context(RC):
                axes = new_axes()
                numbers.draw(axes)
                save_figure(axes.figure, folder / numbers.name)


def write_figure(numbers: Numbers, file: Path) -> None:
    """Write the picture to a file, whole or not at all; its suffix, .png, .svg, .pdf, is the format.

    Raises
    ------
    InputError
        For another suffix, or if the file cannot be written.
    """
    assert numbers.draw is not None
    write_drawing(numbers.draw, file, "--figure")
