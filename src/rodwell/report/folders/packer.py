"""The results folder of tubing in a packer."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

from rodwell.plots.style import RC
from rodwell.plots.wells.packer import plot_packer
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import kept
from rodwell.report.pages.pdf import check_pdf, write_report
from rodwell.report.reports.packer import packer_report
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json
from rodwell.studies.packer.packer import PackerAnswer
from rodwell.studies.packer.tables import packer_dict, packer_table


def write_packer(answer: PackerAnswer, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write report (HTML), figure (PNG, SVG), table (CSV, XLSX), data (JSON) and the case to ``out``: all, or none.

    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    if with_pdf:
        check_pdf()
    with whole_folder(Path(out)) as folder:
        with mpl.rc_context(RC):
            save_figure(plot_packer(answer).figure, folder / "packer")
        pictures = kept(folder, ("packer",), answer.case.about)
        write_report(packer_report(answer), pictures, folder, with_pdf=with_pdf)
        table = packer_table(answer)
        write_csv(table, folder / "packer.csv")
        write_xlsx([table], folder / "packer.xlsx")
        write_json(packer_dict(answer), folder / "packer.json", finite=True)
        (folder / "case.toml").write_text(answer.case.text, encoding="utf-8")
        return tuple(sorted(file.name for file in folder.iterdir()))
