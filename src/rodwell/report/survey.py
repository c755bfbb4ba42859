"""The results folder of a screened well."""

from __future__ import annotations

import json
from pathlib import Path

from rodwell.plots.survey import plot_screening
from rodwell.practice.screening import Screening
from rodwell.practice.screening_data import screening_dict, screening_table
from rodwell.report.pictures import PNG
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx


def write_screening(screening: Screening, out: Path) -> tuple[str, ...]:
    """Write figure (PNG, SVG), table (CSV, XLSX) and data (JSON) to ``out``: all files, or none. Returns their names.

    Raises
    ------
    InputError
        If ``out`` cannot be written.
    """
    with whole_folder(out) as folder:
        table = screening_table(screening)
        write_csv(table, folder / "stations.csv")
        write_xlsx([table], folder / "stations.xlsx")
        text = json.dumps(screening_dict(screening), indent=2, ensure_ascii=False, allow_nan=False)
        (folder / "screening.json").write_text(text + "\n", encoding="utf-8")
        figure = plot_screening(screening)
        figure.savefig(folder / "limits.png", **PNG)
        figure.set_layout_engine("none")
        figure.savefig(folder / "limits.svg", metadata={"Date": None})
        return tuple(sorted(file.name for file in folder.iterdir()))
