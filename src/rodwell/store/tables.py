"""Tables as CSV and XLSX.

XLSX is written with XlsxWriter: it only writes, which is all that is needed, and needs no other package.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rodwell.quantities.table import Cell, Table

WIDEST, NARROWEST = 40, 9
"""Widths of columns in characters."""


BEGINS_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠")
"""First characters of what spreadsheets take for a formula, in the widths of East Asian writing too."""


def write_csv(table: Table, path: Path) -> None:
    """Write a table as CSV: one header line with units, numbers with all their digits, empty where there is none.

    Texts are written so that no spreadsheet takes them for formulas, see :func:`as_text`.
    """
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(as_text(title) for title in table.columns)
        writer.writerows([["" if cell is None else as_text(_checked(cell)) for cell in row] for row in table.rows])


def as_text(cell: Any) -> Any:
    """Return a cell of a CSV file as it is, or with an apostrophe before a text that a spreadsheet would compute.

    A pipe of a user's catalogue may be called =HYPERLINK("…"). Numbers, which may begin with a minus, are no texts.
    """
    return f"'{cell}" if isinstance(cell, str) and cell.startswith(BEGINS_FORMULA) else cell


def write_xlsx(tables: Sequence[Table], path: Path) -> None:
    """Write tables as the sheets of one workbook: header kept in view, filters, marked rows coloured, notes below."""
    import xlsxwriter  # noqa: PLC0415 - loaded when used

    options = {"strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False}
    with xlsxwriter.Workbook(str(path), options) as book:
        styles = {
            "head": book.add_format({"bold": True, "text_wrap": True, "valign": "top", "bottom": 1}),
            "plain": book.add_format({}),
            "marked": book.add_format({"bold": True, "bg_color": "#FBE3D6"}),
            "note": book.add_format({"italic": True, "font_color": "#52606D"}),
        }
        for table in tables:
            _write_sheet(book.add_worksheet(table.name), table, styles)


def _write_sheet(sheet: Any, table: Table, styles: dict[str, Any]) -> None:
    for j, title in enumerate(table.columns):
        sheet.write_string(0, j, title, styles["head"])
        words = max((len(word) for word in title.split()), default=0)
        texts = max((len(str(row[j])) for row in table.rows if isinstance(row[j], str)), default=0)
        sheet.set_column(j, j, min(max(words + 2, texts, NARROWEST), WIDEST))
    for i, row in enumerate(table.rows):
        style = styles["marked" if i in table.marked else "plain"]
        for j, cell in enumerate(row):
            if cell is None:
                sheet.write_blank(i + 1, j, None, style)
            elif isinstance(cell, str):
                sheet.write_string(i + 1, j, cell, style)
            else:
                sheet.write_number(i + 1, j, _checked(cell), style)
    sheet.freeze_panes(1, 1)
    if table.rows and table.columns:
        sheet.autofilter(0, 0, len(table.rows), len(table.columns) - 1)
    for i, note in enumerate(table.notes):
        sheet.write_string(len(table.rows) + 2 + i, 0, note, styles["note"])


def _checked(cell: Cell) -> Any:
    """The cell, unless it is NaN or infinite: a table has no silent gaps."""
    if isinstance(cell, float) and not math.isfinite(cell):
        raise ValueError("a table cell is not finite: use None where there is no value")
    return cell
