"""What happens beyond lift-off, in the folder of a case."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

from rodwell.answers.data.beyond import beyond_table
from rodwell.answers.result.answer import Answer
from rodwell.plots.paths.beyond import plot_beyond
from rodwell.plots.style import RC
from rodwell.report.folders.figures import save_figure
from rodwell.report.pages.path import PAGE, write_path_page
from rodwell.report.reports.beyond import PICTURE
from rodwell.store.tables import write_csv


def write_beyond(answer: Answer, folder: Path) -> dict[str, tuple[str, bytes]]:
    """Follow the rod beyond lift-off, write figure, page and table of it; return the picture for the report."""
    if answer.beyond.path is None:
        return {}
    with mpl.rc_context(RC):
        save_figure(plot_beyond(answer.case, answer.beyond), folder / PICTURE)
    write_path_page(folder / PAGE, answer.beyond.path, answer.case, answer.case.title)
    write_csv(beyond_table(answer.case, answer.beyond), folder / "load-path.csv")
    return {PICTURE: ("svg", (folder / f"{PICTURE}.svg").read_bytes())}
