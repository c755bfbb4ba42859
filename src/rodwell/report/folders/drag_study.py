"""The results folder of a parameter study of torque and drag."""

from __future__ import annotations

from pathlib import Path

from rodwell.plots.wells.drag_study import plot_drag_study
from rodwell.report.folders.pictures import kept, save_figure
from rodwell.report.pages.pdf import PDF, check_pdf, write_report
from rodwell.report.reports.drag_study import drag_study_report
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json
from rodwell.studies.drag.sweep.study import DragStudy
from rodwell.studies.drag.sweep.tables import points_table


def write_drag_study(study: DragStudy, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report (HTML), figure (PNG, SVG), table (CSV, XLSX), data (JSON) and the file to ``out``: all, or none.

    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    if with_pdf:
        check_pdf()
    with whole_folder(Path(out)) as folder:
        save_figure(plot_drag_study(study), folder / "curves")
        table = points_table(study)
        write_csv(table, folder / "points.csv")
        write_xlsx([table], folder / "points.xlsx")
        write_json(study.as_dict(), folder / "study.json", finite=True)
        (folder / "well.toml").write_text(study.well.text, encoding="utf-8")
        names = [*(file.name for file in folder.iterdir()), *([PDF] if with_pdf else [])]
        about = study.well.about
        write_report(drag_study_report(study, names), kept(folder, ("curves",), about), folder, with_pdf=with_pdf)
        return tuple(sorted(file.name for file in folder.iterdir()))
