"""The results folder of a parameter study of torque and drag."""

from __future__ import annotations

from pathlib import Path

from rodwell.plots.wells.drag_study import plot_drag_study
from rodwell.report.folders.points import Points, write_points
from rodwell.report.reports.drag_study import drag_study_report
from rodwell.studies.drag.sweep.study import DragStudy
from rodwell.studies.drag.sweep.tables import points_table


def write_drag_study(study: DragStudy, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write all of a study to ``out``, or nothing: see :func:`rodwell.report.folders.points.write_points`."""
    points = Points(
        draw=lambda: plot_drag_study(study), table=points_table(study), data=study.as_dict(),
        file="well.toml", text=study.well.text, about=study.well.about,
        report=lambda names: drag_study_report(study, names),
    )  # fmt: skip
    return write_points(points, out, with_pdf=with_pdf)
