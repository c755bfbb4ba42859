"""The results folder of a parameter study."""

from __future__ import annotations

from pathlib import Path

from rodwell.case.about import NOBODY
from rodwell.plots.study import plot_study
from rodwell.report.folders.points import Points, write_points
from rodwell.report.reports.study import study_report
from rodwell.studies.sweep.study import Study
from rodwell.studies.sweep.tables import study_table


def write_study(study: Study, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write all of a study to ``out``, or nothing: see :func:`rodwell.report.folders.points.write_points`."""
    about = next((point.case.about for point in study.points if point.case is not None), NOBODY)
    points = Points(
        draw=lambda: plot_study(study), table=study_table(study), data=study.as_dict(),
        file="case.toml", text=study.text, about=about,
        report=lambda names: study_report(study, names, about=about),
    )  # fmt: skip
    return write_points(points, out, with_pdf=with_pdf)
