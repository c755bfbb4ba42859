"""What the folders of cases hold whose results are one picture and one table."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl

from rodwell.case.case import Case
from rodwell.plots.style import RC
from rodwell.quantities.table import Table
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import kept
from rodwell.report.pages.pdf import report_folder, write_report
from rodwell.report.reports.content import Report
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json


def write_single(
    case: Case,
    out: str | Path,
    report: Report,
    *,
    picture: tuple[str, Callable[[], Any]],
    table: tuple[str, Table],
    data: tuple[str, dict[str, Any]],
    with_pdf: bool,
) -> tuple[str, ...]:
    """Write report (HTML), figure (PNG, SVG), table (CSV, XLSX), data (JSON) and the case to ``out``: all, or none.

    ``picture``, ``table`` and ``data`` have the names of their files before them; the first is drawn when it is called.
    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    with report_folder(out, with_pdf=with_pdf) as folder:
        with mpl.rc_context(RC):
            save_figure(picture[1](), folder / picture[0])
        write_report(report, kept(folder, (picture[0],), case.about), folder, with_pdf=with_pdf)
        write_csv(table[1], folder / f"{table[0]}.csv")
        write_xlsx([table[1]], folder / f"{table[0]}.xlsx")
        write_json(data[1], folder / f"{data[0]}.json")
        (folder / "case.toml").write_text(case.text, encoding="utf-8")
        return tuple(sorted(file.name for file in folder.iterdir()))
