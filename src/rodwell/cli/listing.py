"""Tables and sentences that fit the terminal: a label that finds no room beside its numbers stands above them."""

from __future__ import annotations

import shutil
import textwrap
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from rich.console import Console

GAP, INDENT = 2, 4
NARROWEST_NOTE = 30
"""Columns that a remark gets at least, before labels go above the numbers."""


def wrapped(text: str, indent: str = "") -> None:
    """Print a sentence, broken between words; further lines are indented like the first."""
    click.echo(textwrap.fill(text, shutil.get_terminal_size().columns, initial_indent=indent, subsequent_indent=indent,
                             break_long_words=False, break_on_hyphens=False))  # fmt: skip


def print_listing(
    console: Console, head: Sequence[str], rows: Iterable[Sequence[str] | str], *, notes: bool = False
) -> None:
    """Print a table of a label, cells that are never broken and, with ``notes``, a remark as the last column.

    Parameters
    ----------
    console
        Where to.
    head
        Titles of the columns; those with ">" in front are right-justified.
    rows
        Cells of each row, with markup; a single text is a title among the rows.
    notes
        Whether the last column is a remark, which may be broken between words.
    """
    from rich.cells import cell_len  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415
    from rich.text import Text  # noqa: PLC0415

    rows = list(rows)
    titles = [title.removeprefix(">") for title in head]
    right = [title.startswith(">") for title in head]
    whole = [[Text.from_markup(cell) for cell in row] for row in rows if not isinstance(row, str)]
    widths = [max(cell_len(t), *(row[i].cell_len for row in whole), 0) for i, t in enumerate(titles)]
    middle = range(1, len(head) - notes)
    room = console.width - sum(widths[i] + GAP for i in middle)
    remark = (min(widths[-1], NARROWEST_NOTE) + GAP) if notes else 0
    beside = room - remark >= widths[0] or not notes
    label = min(widths[0], max(room - remark, INDENT)) if beside else INDENT
    needed = label + GAP + sum(widths[i] + GAP for i in middle) + remark
    narrow, console.width = console.width, max(console.width, needed)  # terminals break lines; no number is cut

    def line(cells: Sequence[str | Text], style: str = "") -> None:
        grid = Table.grid(padding=(0, GAP, 0, 0))
        grid.add_column(width=label)
        for i in middle:
            grid.add_column(width=widths[i], justify="right" if right[i] else "left", no_wrap=True)
        if notes:
            grid.add_column(overflow="fold")
        grid.add_row(*cells, style=style)
        console.print(grid)

    above = cell_len(titles[0]) > label
    line(["" if above else titles[0], *titles[1:]], "bold")
    cells = iter(whole)
    for row in rows:
        if isinstance(row, str):
            console.print(row)
            continue
        name, *rest = next(cells)
        if name.cell_len > label:
            console.print(name)
            name = Text("")
        line([name, *rest])
    console.width = narrow
