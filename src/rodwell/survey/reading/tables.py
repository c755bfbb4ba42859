"""A table as it came: rows of cells with the numbers of their lines, before anybody knows what they mean."""

from __future__ import annotations

from dataclasses import dataclass, field

Cell = str | float
"""Text, or a number where the file itself says that it is one (a spreadsheet)."""

Row = tuple[int, list[Cell]]
"""Number of the line (from 1), and its cells."""

LONGEST_NAME = 200
"""Characters of a cell that may still name a column."""

MOST_COLUMNS = 500


@dataclass(frozen=True)
class Declared:
    """What the file says of itself beside its table: lines above it, comments, a header section."""

    well: str = ""
    depth_unit: str = ""
    angle_unit: str = ""
    null: float | None = None


@dataclass(frozen=True)
class RawTable:
    """Rows of one table.

    Attributes
    ----------
    name
        How messages call it: file name, and sheet where there are several.
    rows
        From the first that may be a header on; comments and empty ones left out.
    line
        What rows are called: "line", or "row" in a spreadsheet.
    fixed
        Whether the first row is the header for certain (LAS).
    also
        Descriptions of the columns beside their names, by column.
    separator
        What stood between cells; "" in a spreadsheet.
    """

    name: str
    rows: list[Row]
    line: str = "line"
    fixed: bool = False
    also: dict[int, str] = field(default_factory=dict)
    separator: str = ""
    declared: Declared = Declared()

    def at(self, number: int) -> str:
        """A line as messages call it."""
        return f"{self.name}, {self.line} {number}"


def shown(cell: Cell) -> str:
    """A cell as messages quote it: one line, no control characters, cut where it is long."""
    text = f"{cell:g}" if isinstance(cell, float) else " ".join(cell.split())
    text = "".join(c if c.isprintable() else "�" for c in text)
    return text if len(text) <= 40 else text[:39] + "…"


def listed(cells: list[Cell], most: int = 20) -> str:
    """Cells as messages list them."""
    names = [f'"{shown(cell)}"' for cell in cells if not isinstance(cell, str) or cell.strip()]
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more
