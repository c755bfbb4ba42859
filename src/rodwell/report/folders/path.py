"""A load path as files."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl

from rodwell.analysis.off_wall.state import contact_state
from rodwell.analysis.path.load_path import LoadPath
from rodwell.case.case import Case
from rodwell.plots.paths.bridging import plot_bridging
from rodwell.plots.paths.path import plot_path
from rodwell.plots.style import RC
from rodwell.report.folders.figures import save_figure
from rodwell.report.pages.path import PAGE, write_path_page
from rodwell.store.folder import whole_folder
from rodwell.store.netcdf import write_load_path
from rodwell.store.text import write_json


def write_path(
    result: LoadPath, out: Path, at: Sequence[float] = (), case: Case | None = None, barriers: Sequence[float] = ()
) -> tuple[str, ...]:
    """Write figure (PNG, SVG), events, states at the end forces ``at`` (JSON), curve (CSV) and page to ``out``.

    In the JSON file too are ``barriers`` at other end forces.

    All states with what touches in them are in ``load-path.nc`` (NetCDF). The page shows the rod in its hole along the
    path, with a slider; of a string that bridges steps of its clearance a picture shows it from the side, at the last
    load, instead. Figure and page are in the units of ``case``.

    All files, or none; returns their names.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        with mpl.rc_context(RC):
            save_figure(plot_path(result, case=case).figure, folder / "load-path")
            if result.problem.bridges:
                last = result.legs[-1].runs[-1][-1]
                save_figure(plot_bridging(contact_state(last)).figure, folder / "bridging")
        write_json(result.as_dict(at, barriers), folder / "load-path.json")
        write_load_path(result, folder / "load-path.nc")
        if not result.problem.bridges:
            write_path_page(folder / PAGE, result, case)
        curve = result.curve
        with (folder / "load-path.csv").open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(("force_s1_tension_positive", "shortening", "energy", "run"))
            for row in zip(*curve.values(), strict=True):
                writer.writerow([*(repr(float(cell)) for cell in row[:3]), int(row[3])])
        return tuple(sorted(file.name for file in folder.iterdir()))
