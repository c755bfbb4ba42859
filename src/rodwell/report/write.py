"""The results folder of a case."""

from __future__ import annotations

import json
from pathlib import Path

from rodwell.practice.answer import Answer
from rodwell.report.html import render
from rodwell.report.pictures import draw
from rodwell.store.folder import whole_folder
from rodwell.store.netcdf import write_answer

FILES = {
    "report.html": "the report, self-contained",
    "answer.json": "key figures and special points",
    "branches.nc": "every field along every branch (NetCDF)",
    "case.toml": "the case as it was read",
}


def write_results(answer: Answer, out: Path) -> None:
    """Write report, figures, data and case to the folder ``out``: all files, or none.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        pictures = draw(answer, folder)
        (folder / "report.html").write_text(render(answer, pictures), encoding="utf-8")
        text = json.dumps(answer.as_dict(), indent=2, ensure_ascii=False)
        (folder / "answer.json").write_text(text + "\n", encoding="utf-8")
        (folder / "case.toml").write_text(answer.case.text, encoding="utf-8")
        write_answer(answer, folder / "branches.nc")
