"""Tables of results, for CSV and XLSX."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

Cell = str | float | int | None
"""A cell; None where there is no value, never NaN."""


@dataclass(frozen=True)
class Table:
    """A table with a header.

    Attributes
    ----------
    name
        Name of the sheet.
    columns
        Header of each column, with its unit in brackets.
    rows
        Cells, as many in each row as there are columns.
    marked
        Numbers of the rows that are to stand out.
    notes
        What a reader must know: signs, places, errors.
    """

    name: str
    columns: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    marked: frozenset[int] = frozenset()
    notes: tuple[str, ...] = ()


class Variable(NamedTuple):
    """A labelled array: dimensions, values, metadata."""

    dims: tuple[str, ...]
    values: np.ndarray
    attrs: dict[str, Any]
