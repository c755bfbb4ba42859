"""Tables in a workbook (XLSX): rows are read one after the other, so that no sheet however wide fills the memory.

With openpyxl, which is made for reading piece by piece; formulas give the values that were stored with them.
"""

from __future__ import annotations

import io
import math
import warnings
import zipfile
from collections.abc import Iterator
from typing import Any

from rodwell.errors import InputError
from rodwell.survey.reading.stations import MOST_STATIONS
from rodwell.survey.reading.tables import MOST_COLUMNS, Cell, RawTable, Row

LARGEST_UNPACKED = 150_000_000
MOST_ROWS = 5 * MOST_STATIONS
MOST_SHEETS = 200

MOST_EMPTY = 10_000
"""Empty rows after which a sheet ends, whatever stands below."""


def workbook_tables(name: str, data: bytes) -> list[RawTable]:
    """The sheets of a workbook that hold anything.

    Raises
    ------
    InputError
        If it is no workbook, damaged, or unpacks to too much.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            size = sum(part.file_size for part in archive.infolist())
        if size > LARGEST_UNPACKED:
            raise InputError("survey", name, f"unpacks to more than {LARGEST_UNPACKED // 1_000_000} MB")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about styles, printing areas and the like
            tables = _sheets(name, data)
    except InputError:
        raise
    except Exception as error:  # damaged archives raise many kinds
        what = f"is not a workbook (XLSX) that can be read: {type(error).__name__}; save it anew, or as CSV"
        raise InputError("survey", name, what) from None
    if not tables:
        raise InputError("survey", name, "is empty: its first row names the columns, for example MD [m], Inc [deg]")
    return tables


def _sheets(name: str, data: bytes) -> list[RawTable]:
    import openpyxl  # noqa: PLC0415 - loaded when used

    book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
    sheets = [sheet for sheet in book.worksheets[:MOST_SHEETS] if sheet.sheet_state == "visible"]
    named = [(name if len(sheets) == 1 else f"{name}, sheet {sheet.title}", sheet) for sheet in sheets]
    tables = [RawTable(called, list(_rows(name, sheet)), "row") for called, sheet in named]
    return [table for table in tables if table.rows]


def _rows(name: str, sheet: Any) -> Iterator[Row]:
    """Rows that hold anything, numbered as in the sheet."""
    sheet.reset_dimensions()  # what some programs write there is wrong
    empty = 0
    for number, values in enumerate(sheet.iter_rows(values_only=True, max_col=MOST_COLUMNS), start=1):
        empty = empty + 1 if values.count(None) == len(values) else 0
        if empty > MOST_EMPTY:
            return
        if empty:
            continue
        if number > MOST_ROWS:
            raise InputError("survey", name, f"has a sheet of more than {MOST_ROWS} rows; a survey has not")
        cells = [_cell(value) for value in values]
        while cells and cells[-1] == "":
            cells.pop()
        if cells and not str(cells[0]).lstrip().startswith("#"):
            yield number, cells


def _cell(value: object) -> Cell:
    if value is None or isinstance(value, bool):
        return "" if value is None else str(value)
    if isinstance(value, (int, float)):
        try:
            return float(value)
        except OverflowError:
            return math.inf
    return str(value)
