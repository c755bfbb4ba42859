"""The results folder of a parameter study."""

from __future__ import annotations

from pathlib import Path

from rodwell.case.about import NOBODY
from rodwell.plots.study import plot_study
from rodwell.report.folders.pictures import kept, save_figure
from rodwell.report.pages.pdf import PDF, check_pdf, write_report
from rodwell.report.reports.study import study_report
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json
from rodwell.studies.sweep.study import Study
from rodwell.studies.sweep.tables import study_table


def write_study(study: Study, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report (HTML), curves (PNG, SVG), table (CSV, XLSX), data (JSON) and the file to ``out``: all, or none.

    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    if with_pdf:
        check_pdf()
    with whole_folder(Path(out)) as folder:
        save_figure(plot_study(study), folder / "curves")
        table = study_table(study)
        write_csv(table, folder / "points.csv")
        write_xlsx([table], folder / "points.xlsx")
        write_json(study.as_dict(), folder / "study.json", finite=True)
        (folder / "case.toml").write_text(study.text, encoding="utf-8")
        about = next((point.case.about for point in study.points if point.case is not None), NOBODY)
        names = [*(file.name for file in folder.iterdir()), *([PDF] if with_pdf else [])]
        report = study_report(study, names, about=about)
        write_report(report, kept(folder, ("curves",), about), folder, with_pdf=with_pdf)
        return tuple(sorted(file.name for file in folder.iterdir()))
