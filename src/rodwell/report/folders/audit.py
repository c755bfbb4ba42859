"""The results folder of an audit."""

from __future__ import annotations

import csv
from pathlib import Path

from rodwell.case.about import NOBODY, About
from rodwell.plots.audit import plot_error_map
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import kept
from rodwell.report.pages.pdf import write_report
from rodwell.report.reports.audit import audit_report
from rodwell.store.folder import whole_folder
from rodwell.store.tables import as_text
from rodwell.store.text import write_json
from rodwell.studies.audit.audit import Audit
from rodwell.studies.audit.error_map import ErrorMap
from rodwell.studies.audit.tables import csv_rows


def write_audit(
    audit: Audit, chart: ErrorMap | None, out: Path, about: About = NOBODY, source: str = "case"
) -> tuple[str, ...]:
    """Write report, tables (JSON, CSV) and the chart (PNG, SVG, CSV of its loads) to ``out``: all files, or none.

    ``about`` stands at the head of the report, ``source`` at its foot. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        write_json(audit.as_dict(), folder / "audit.json")
        _write_csv(folder / "audit.csv", csv_rows(audit))
        if chart is not None:
            _write_csv(folder / "audit-chart.csv", _chart_rows(chart))
            save_figure(plot_error_map(chart), folder / "audit-chart")
        pictures = kept(folder, ("audit-chart",), about)
        names = [file.name for file in folder.iterdir()]
        write_report(audit_report(audit, names, about=about, source=source), pictures, folder)
        return tuple(sorted(file.name for file in folder.iterdir()))


def _chart_rows(chart: ErrorMap) -> list[tuple[object, ...]]:
    lines: list[tuple[object, ...]] = [("weight", "alpha_degrees", "critical_force_s1_tension_positive", "error")]
    for i, alpha in enumerate(chart.alphas):
        for j, weight in enumerate(chart.weights):
            lines.append((float(weight), float(alpha), float(chart.force[i, j]), float(chart.error[i, j])))
    return lines


def _write_csv(path: Path, rows: list[tuple[object, ...]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([as_text(cell) for cell in row] for row in rows)
