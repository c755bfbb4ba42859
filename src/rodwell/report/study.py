"""The results folder of a parameter study."""

from __future__ import annotations

import base64
import datetime
import io
import json
from pathlib import Path

import jinja2

from rodwell._version import __version__
from rodwell.plots.study import plot_study
from rodwell.practice.study import Study
from rodwell.practice.study_data import NOTES, cells, head, remarks, sentences, study_table
from rodwell.report.pictures import PNG
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx

TEMPLATE = Path(__file__).with_name("study.html.j2")


def write_study(study: Study, out: Path) -> tuple[str, ...]:
    """Write report (HTML), curves (PNG, SVG), table (CSV, XLSX), data (JSON) and the file to ``out``: all, or none.

    Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        figure = plot_study(study)
        figure.savefig(folder / "curves.png", **PNG)
        figure.set_layout_engine("none")
        buffer = io.BytesIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None})
        (folder / "curves.svg").write_bytes(buffer.getvalue())
        (folder / "report.html").write_text(render(study, buffer.getvalue()), encoding="utf-8")
        table = study_table(study)
        write_csv(table, folder / "points.csv")
        write_xlsx([table], folder / "points.xlsx")
        text = json.dumps(study.as_dict(), indent=2, ensure_ascii=False, allow_nan=False)
        (folder / "study.json").write_text(text + "\n", encoding="utf-8")
        (folder / "case.toml").write_text(study.text, encoding="utf-8")
        return tuple(sorted(file.name for file in folder.iterdir()))


def render(study: Study, picture: bytes) -> str:
    """Return the page, with the curves (SVG) inside it: it opens offline and prints."""
    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    template = environment.from_string(TEMPLATE.read_text(encoding="utf-8"))
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
    return template.render(
        study=study,
        text=sentences(study),
        missing=[f"{study.inputs(point)}: {remarks(study, point)}" for point in lacking],
        notes=NOTES,
        picture="data:image/svg+xml;base64," + base64.b64encode(picture).decode("ascii"),
        head=head(study),
        rows=lines,
        inputs=inputs,
        version=__version__,
        date=datetime.date.today().isoformat(),
    )
