"""The results folder of torque and drag of a well."""

from __future__ import annotations

from pathlib import Path

from rodwell.plots.wells.drag import plot_calibration, plot_forces, plot_operation, plot_road_map
from rodwell.report.folders.figures import save_figure
from rodwell.report.folders.pictures import kept
from rodwell.report.pages.pdf import report_folder, write_report
from rodwell.report.reports.drag import drag_report, picture_of
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json
from rodwell.studies.drag.calibration import Calibration
from rodwell.studies.drag.drag import Drag
from rodwell.studies.drag.plain import drag_dict
from rodwell.studies.drag.tables import along_table, calibration_table, operations_table, road_map_table


def write_drag(
    found: Drag, out: str | Path, *, calibration: Calibration | None = None, with_pdf: bool = False
) -> tuple[str, ...]:
    """Write report (HTML), figures (PNG, SVG), tables (CSV, XLSX), data (JSON) and the file to ``out``: all, or none.

    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    with report_folder(out, with_pdf=with_pdf) as folder:
        figures = {"forces": plot_forces(found)}
        figures |= {picture_of(i): plot_operation(found, one) for i, one in enumerate(found.operations)}
        tables = {"operations": operations_table(found)}
        if found.road_map is not None:
            figures["road-map"] = plot_road_map(found.road_map)
            tables["road-map"] = road_map_table(found.road_map)
        if calibration is not None:
            figures["calibration"] = plot_calibration(calibration)
            tables["calibration"] = calibration_table(calibration)
        for name, figure in figures.items():
            save_figure(figure, folder / name)
        pictures = kept(folder, tuple(figures), found.well.about)
        write_report(drag_report(found, calibration), pictures, folder, with_pdf=with_pdf)
        for name, table in tables.items():
            write_csv(table, folder / f"{name}.csv")
        write_xlsx([*tables.values(), *(along_table(found, one) for one in found.operations)], folder / "drag.xlsx")
        write_json(drag_dict(found, calibration), folder / "drag.json")
        (folder / "well.toml").write_text(found.well.text, encoding="utf-8")
        return tuple(sorted(file.name for file in folder.iterdir()))
