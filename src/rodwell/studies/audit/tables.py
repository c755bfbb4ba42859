"""An audit as plain data, for JSON and CSV."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rodwell.studies.audit.audit import Audit


HEAD = ("key", "name", "kind", "value_B/L2", "load", "place", "meant_place", "exact_B/L2", "exact_error", "percent",
        "percent_error", "safe", "valid", "outside_because", "verdict")  # fmt: skip


def csv_rows(audit: Audit) -> list[tuple[object, ...]]:
    """Return head and lines of a table: one line for each formula, exact load and place."""
    string = bool(audit.problem.sections)
    lines: list[tuple[object, ...]] = [(*HEAD, *(("section",) if string else ()))]
    for row in audit.rows:
        f, why = row.formula, "; ".join(row.reasons)
        for c in row.comparisons:
            lines.append(
                (f.key, f.name, f.kind, row.value, c.load, c.place, f.place, c.exact, c.error, c.percent,
                 c.percent_error, c.safe, row.valid, why, row.verdict, *((row.section,) if string else ()))
            )  # fmt: skip
    return lines
