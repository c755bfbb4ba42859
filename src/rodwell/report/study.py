"""The results folder of a parameter study."""

from __future__ import annotations

import datetime
from pathlib import Path

from rodwell._version import __version__
from rodwell.plots.study import plot_study
from rodwell.practice.study import Study
from rodwell.practice.study_data import NOTES, cells, head, remarks, sentences, study_table
from rodwell.report.pictures import save_figure
from rodwell.report.templates import embedded, template
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json


def write_study(study: Study, out: Path) -> tuple[str, ...]:
    """Write report (HTML), curves (PNG, SVG), table (CSV, XLSX), data (JSON) and the file to ``out``: all, or none.

    Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        save_figure(plot_study(study), folder / "curves")
        page = render(study, (folder / "curves.svg").read_bytes())
        (folder / "report.html").write_text(page, encoding="utf-8")
        table = study_table(study)
        write_csv(table, folder / "points.csv")
        write_xlsx([table], folder / "points.xlsx")
        write_json(study.as_dict(), folder / "study.json", finite=True)
        (folder / "case.toml").write_text(study.text, encoding="utf-8")
        return tuple(sorted(file.name for file in folder.iterdir()))


def render(study: Study, picture: bytes) -> str:
    """Return the page, with the curves (SVG) inside it: it opens offline and prints."""
    worst = {point.number for name in ("critical", "lift_off") if (point := study.worst(name)) is not None}
    lines = [
        {"cells": cells(study, point), "remark": remarks(study, point), "worst": point.number in worst}
        for point in study.points
    ]
    lacking = [point for point in study.incomplete if set(point.reasons or {}) - {"contact"}]
    inputs = [
        (f"{section}.{key}", str(value))
        for section, values in study.given.items()
        for key, value in (values.items() if hasattr(values, "items") else [])
    ]
    return str(
        template("study.html.j2").render(
            study=study,
            text=sentences(study),
            missing=[f"{study.inputs(point)}: {remarks(study, point)}" for point in lacking],
            notes=NOTES,
            picture=embedded("svg", picture),
            head=head(study),
            rows=lines,
            inputs=inputs,
            version=__version__,
            date=datetime.date.today().isoformat(),
        )
    )
