"""The results folder of a case."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from rodwell.answers.data.along import along_table, along_tables
from rodwell.answers.data.plain import answer_dict
from rodwell.answers.data.tables import answer_tables
from rodwell.answers.result.answer import Answer
from rodwell.report.folders.beside import Drawing, drawing_beside
from rodwell.report.pages.pdf import PDF, report_folder, write_report
from rodwell.report.pages.templates import embedded
from rodwell.report.pages.viewer import view, viewer, write_viewer
from rodwell.report.reports.case import case_report
from rodwell.report.reports.front import LOGO
from rodwell.store.netcdf import write_answer
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json

Picture = tuple[str, bytes]
"""Type ("svg" or "png") and content of a picture, as a report takes it."""


def write_results(
    answer: Answer,
    out: str | Path,
    *,
    with_pdf: bool = False,
    path: bool = False,
    drawing: Drawing | None = None,
) -> tuple[str, ...]:
    """Write report, figures, tables, data and case to the folder ``out``: all files, or none.

    ``with_pdf`` adds the report as PDF; ``path`` what happens beyond lift-off, which is followed while figures of what
    is on the wall are drawn. ``drawing`` draws the pictures, where it was started already
    (:mod:`rodwell.report.folders.beside`). Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    with report_folder(out, with_pdf=with_pdf) as folder:
        with ExitStack() as stack:
            drawing = drawing or stack.enter_context(drawing_beside())
            drawn = drawing.case(answer)
            followed = _beyond(answer, folder, drawing) if path else dict
            write_json(answer_dict(answer, path=path), folder / "answer.json")
            tables, states = answer_tables(answer), along_tables(answer.assessment)
            write_csv(tables[0], folder / "key-figures.csv")
            write_csv(along_table(states), folder / "along-rod.csv")
            write_xlsx([*tables, *states], folder / "tables.xlsx")
            (folder / "case.toml").write_text(answer.case.text, encoding="utf-8")
            write_answer(answer, folder / "branches.nc")
            rod = view(answer.shown, answer.case.scales)
            pictures = _kept(drawn() | followed(), folder)
        if answer.case.about.logo is not None:
            pictures[LOGO] = answer.case.about.logo
        still = embedded(*pictures["rod-3d"]) if "rod-3d" in pictures else ""
        write_viewer(folder / "rod-3d.html", rod, answer.case.title, still=still)
        names = [*(file.name for file in folder.iterdir()), *([PDF] if with_pdf else [])]
        report = case_report(answer, names, path=path)
        write_report(report, pictures, folder, viewer(rod, still=still), with_pdf=with_pdf)
        return tuple(sorted(file.name for file in folder.iterdir()))


def _kept(drawn: dict[str, dict[str, bytes]], folder: Path) -> dict[str, Picture]:
    """Write the pictures as they were drawn, and return those that a report takes: SVG where there is one."""
    for name, formats in drawn.items():
        for suffix, content in formats.items():
            (folder / f"{name}.{suffix}").write_bytes(content)
    kinds = {name: "svg" if "svg" in formats else "png" for name, formats in drawn.items()}
    return {name: (kind, drawn[name][kind]) for name, kind in kinds.items()}


def _beyond(answer: Answer, folder: Path, drawing: Drawing) -> Callable[[], dict[str, dict[str, bytes]]]:
    """Follow the rod beyond lift-off, write what happens there, and return what waits for its picture."""
    from rodwell.report.folders.beyond import write_beyond  # noqa: PLC0415 - imports what follows rods off the wall

    return write_beyond(answer, folder, drawing)
