"""The results folder of torque and drag of a well."""

from __future__ import annotations

from pathlib import Path

from rodwell.report.pages.pdf import check_pdf
from rodwell.store.folder import whole_folder
from rodwell.store.tables import write_csv, write_xlsx
from rodwell.store.text import write_json
from rodwell.studies.drag.drag import Drag
from rodwell.studies.drag.plain import drag_dict
from rodwell.studies.drag.tables import along_table, operations_table


def write_drag(found: Drag, out: str | Path, *, with_pdf: bool = False) -> tuple[str, ...]:
    """Write tables (CSV, XLSX), data (JSON) and the file of the well to ``out``: all, or none.

    ``with_pdf`` adds the report as PDF. Returns the names of the files.

    Raises
    ------
    InputError
        If ``out`` cannot be written, or what makes the PDF is not installed.
    """
    if with_pdf:
        check_pdf()
    with whole_folder(Path(out)) as folder:
        tables = [operations_table(found), *(along_table(found, one) for one in found.operations)]
        write_csv(tables[0], folder / "operations.csv")
        write_xlsx(tables, folder / "drag.xlsx")
        write_json(drag_dict(found), folder / "drag.json", finite=True)
        (folder / "well.toml").write_text(found.well.text, encoding="utf-8")
        return tuple(sorted(file.name for file in folder.iterdir()))
