"""What the results folders of all parameter studies hold."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rodwell.case.about import About
from rodwell.quantities.table import Table
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import kept
from rodwell.report.pages.pdf import PDF, report_folder, write_report
from rodwell.report.reports.content import Report
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json


@dataclass(frozen=True)
class Points:
    """A parameter study in the forms that it is written in.

    Attributes
    ----------
    draw
        Draws its curves; called when the folder is known to be writable.
    table
        Its points.
    data
        The same as plain data.
    file, text
        Name and content of the file that was computed.
    about
        What its report says of those who ordered and wrote it.
    report
        Makes the report from the names of the files beside it.
    """

    draw: Callable[[], Any]
    table: Table
    data: dict[str, Any]
    file: str
    text: str
    about: About
    report: Callable[[list[str]], Report]


def write_points(points: Points, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report (HTML), curves (PNG, SVG), table (CSV, XLSX), data (JSON) and the file to ``out``: all, or none.

    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    with report_folder(out, with_pdf=with_pdf) as folder:
        save_figure(points.draw(), folder / "curves")
        write_csv(points.table, folder / "points.csv")
        write_xlsx([points.table], folder / "points.xlsx")
        write_json(points.data, folder / "study.json")
        (folder / points.file).write_text(points.text, encoding="utf-8")
        names = [*(file.name for file in folder.iterdir()), *([PDF] if with_pdf else [])]
        pictures = kept(folder, ("curves",), points.about)
        write_report(points.report(names), pictures, folder, with_pdf=with_pdf)
        return tuple(sorted(file.name for file in folder.iterdir()))
