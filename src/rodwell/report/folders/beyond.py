"""What happens beyond lift-off, in the folder of a case."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from rodwell.answers.data.beyond import beyond_table
from rodwell.answers.result.answer import Answer
from rodwell.report.folders.beside import Drawing
from rodwell.report.pages.path import PAGE, write_path_page
from rodwell.store.tables import write_csv


def write_beyond(answer: Answer, folder: Path, drawing: Drawing) -> Callable[[], dict[str, dict[str, bytes]]]:
    """Follow the rod beyond lift-off, write page and table of it; return what waits for its picture."""
    if answer.beyond.path is None:
        return dict
    wait = drawing.beyond(answer)
    write_path_page(folder / PAGE, answer.beyond.path, answer.case, answer.case.title)
    write_csv(beyond_table(answer.case, answer.beyond), folder / "load-path.csv")
    return wait
