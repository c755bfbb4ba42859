"""The results folder of a case."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

from rodwell.answers.data.along import along_table, along_tables
from rodwell.answers.data.beyond import beyond_table
from rodwell.answers.data.plain import answer_dict
from rodwell.answers.data.tables import answer_tables
from rodwell.answers.result.answer import Answer
from rodwell.plots.paths.beyond import plot_beyond
from rodwell.plots.style import RC
from rodwell.report.folders.beside import done_beside
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import draw
from rodwell.report.pages.path import PAGE, write_path_page
from rodwell.report.pages.pdf import PDF, check_pdf, write_report
from rodwell.report.pages.templates import embedded
from rodwell.report.pages.viewer import view, viewer, write_viewer
from rodwell.report.reports.beyond import PICTURE
from rodwell.report.reports.case import case_report
from rodwell.store.folder import whole_folder
from rodwell.store.netcdf import write_answer
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json


def write_results(answer: Answer, out: str | Path, *, with_pdf: bool = False, path: bool = False) -> tuple[str, ...]:
    """Write report, figures, tables, data and case to the folder ``out``: all files, or none.

    ``with_pdf`` adds the report as PDF; ``path`` what happens beyond lift-off, which is followed while figures of what
    is on the wall are drawn. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    if with_pdf:
        check_pdf()
    with whole_folder(Path(out)) as folder:
        with done_beside(draw, answer, folder) as drawn:
            followed = _write_path(answer, folder) if path else {}
            write_json(answer_dict(answer, path=path), folder / "answer.json")
            tables, states = answer_tables(answer), along_tables(answer.assessment)
            write_csv(tables[0], folder / "key-figures.csv")
            write_csv(along_table(states), folder / "along-rod.csv")
            write_xlsx([*tables, *states], folder / "tables.xlsx")
            (folder / "case.toml").write_text(answer.case.text, encoding="utf-8")
            write_answer(answer, folder / "branches.nc")
            rod = view(answer.shown, answer.case.scales)
            pictures = drawn() | followed
        still = embedded(*pictures["rod-3d"]) if "rod-3d" in pictures else ""
        write_viewer(folder / "rod-3d.html", rod, answer.case.title, still=still)
        names = [*(file.name for file in folder.iterdir()), *([PDF] if with_pdf else [])]
        report = case_report(answer, names, path=path)
        write_report(report, pictures, folder, viewer(rod, still=still), with_pdf=with_pdf)
        return tuple(sorted(file.name for file in folder.iterdir()))


def _write_path(answer: Answer, folder: Path) -> dict[str, tuple[str, bytes]]:
    """Follow the rod beyond lift-off, write figure and table of it; return the picture for the report."""
    if answer.beyond.path is None:
        return {}
    with mpl.rc_context(RC):
        save_figure(plot_beyond(answer.case, answer.beyond), folder / PICTURE)
    write_path_page(folder / PAGE, answer.beyond.path, answer.case, answer.case.title)
    write_csv(beyond_table(answer.case, answer.beyond), folder / "load-path.csv")
    return {PICTURE: ("svg", (folder / f"{PICTURE}.svg").read_bytes())}
