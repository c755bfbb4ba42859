"""The results folder of a case whose clearance has steps."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

from rodwell.answers.data.bridged import bridged_dict, contact_table
from rodwell.answers.result.bridged import Bridged
from rodwell.plots.paths.bridging import plot_bridging
from rodwell.plots.style import RC
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import kept
from rodwell.report.pages.pdf import check_pdf, write_report
from rodwell.report.reports.bridged import PICTURE, bridged_report
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json


def write_bridged(found: Bridged, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report (HTML), figure (PNG, SVG), table (CSV, XLSX), data (JSON) and the case to ``out``: all, or none.

    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    if with_pdf:
        check_pdf()
    shown = found.alone if found.buckling is None else found.buckling[1]
    with whole_folder(Path(out)) as folder:
        with mpl.rc_context(RC):
            save_figure(plot_bridging(shown.state, scales=found.case.scales).figure, folder / PICTURE)
        pictures = kept(folder, (PICTURE,), found.case.about)
        write_report(bridged_report(found), pictures, folder, with_pdf=with_pdf)
        table = contact_table(found)
        write_csv(table, folder / "contact.csv")
        write_xlsx([table], folder / "contact.xlsx")
        write_json(bridged_dict(found), folder / "answer.json", finite=True)
        (folder / "case.toml").write_text(found.case.text, encoding="utf-8")
        return tuple(sorted(file.name for file in folder.iterdir()))
