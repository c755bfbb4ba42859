"""The results folder of a screened well."""

from __future__ import annotations

from pathlib import Path

from rodwell.plots.wells.survey import plot_screening
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import kept
from rodwell.report.pages.pdf import write_report
from rodwell.report.reports.well import screening_report
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json
from rodwell.studies.well.plain import screening_dict
from rodwell.studies.well.screening import Screening
from rodwell.studies.well.tables import screening_table


def write_screening(screening: Screening, out: Path) -> tuple[str, ...]:
    """Write report, figure, tables (CSV, XLSX) and data (JSON) to ``out``: all files, or none; return their names.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        table = screening_table(screening)
        write_csv(table, folder / "stations.csv")
        write_xlsx([table], folder / "stations.xlsx")
        write_json(screening_dict(screening), folder / "screening.json")
        save_figure(plot_screening(screening), folder / "limits")
        pictures = kept(folder, ("limits",), screening.case.about)
        names = [file.name for file in folder.iterdir()]
        write_report(screening_report(screening, names), pictures, folder)
        return tuple(sorted(file.name for file in folder.iterdir()))
